// Central differences of the central gradient on the voxels, then trilinear interpolation ([REC-3]). Along an axis the
// interpolated differences have six taps, like a kernel.
// Twin: reference/src/field/hessian/central.rs

// A derivative at a voxel, as voxels of its line and their weights.
struct Difference {
    at: vec3<i32>,
    weight: vec3<real>,
}

// The derivative at voxel i of a line of n: the central difference, (-3f0 + 4f1 - f2)/2 at an end, the difference of two
// voxels if there are two, and 0 of one.
fn difference(i: i32, n: i32) -> Difference {
    if (n == 1) {
        return Difference(vec3(i), vec3<real>());
    }
    if (n == 2) {
        return Difference(vec3(0, 1, i), vec3<real>(-1.0, 1.0, 0.0));
    }
    if (i == 0) {
        return Difference(vec3(0, 1, 2), vec3<real>(-1.5, 2.0, -0.5));
    }
    if (i == n - 1) {
        return Difference(vec3(i, i - 1, i - 2), vec3<real>(1.5, -2.0, 0.5));
    }
    return Difference(vec3(i - 1, i + 1, i), vec3<real>(-0.5, 0.5, 0.0));
}

// Weights of voxels cell - 2 ... cell + 3 of a line of n.
fn difference_taps(cell: i32, n: i32, w: real) -> Taps {
    var taps = Taps();
    if (cell >= 2 && cell + 4 <= n) {
        let u = 1.0 - w;
        let zero = real(0.0);
        taps.value = array<real, 6>(zero, zero, u, w, zero, zero);
        taps.first = array<real, 6>(zero, -(0.5 * u), -(0.5 * w), 0.5 * u, 0.5 * w, zero);
        taps.second = array<real, 6>(0.25 * u, 0.25 * w, -(0.5 * u), -(0.5 * w), 0.25 * u, 0.25 * w);
        return taps;
    }
    // Near a border, and on an axis of length 1, whose cell has one corner.
    for (var corner = cell; corner < min(cell + 2, n); corner++) {
        let weight = select(1.0 - w, w, corner > cell);
        taps.value[corner + 2 - cell] += weight;
        let slope = difference(corner, n);
        for (var i = 0; i < 3; i++) {
            let c = weight * slope.weight[i];
            taps.first[slope.at[i] + 2 - cell] += c;
            let bend = difference(slope.at[i], n);
            for (var j = 0; j < 3; j++) {
                taps.second[bend.at[j] + 2 - cell] += c * bend.weight[j];
            }
        }
    }
    return taps;
}

fn index_second(at: Place) -> Second {
    let n = select(vec3(1), vec3<i32>(last_cell()) + vec3(2), long_axes() > vec3<real>());
    let taps = array<Taps, 3>(
        difference_taps(at.cell.x, n.x, at.w.x),
        difference_taps(at.cell.y, n.y, at.w.y),
        difference_taps(at.cell.z, n.z, at.w.z),
    );
    var second = tensor_second(voxels, at.cell + vec3(VOXELS_PAD), 6, taps);
    second.gradient = central_gradient(at);
    return second;
}
