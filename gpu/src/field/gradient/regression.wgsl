// 4D linear regression on the voxels, then trilinear interpolation ([REC-2], [STIP-1]).
// Twin: reference/src/field/gradient/regression.rs

// Weights of the 27 voxels around one, x fastest, for the derivative along each index axis, for each of 64 cases. A case is
// what neighbours a voxel has along x, plus 4 times that along y, plus 16 times that along z.
@group(1) @binding(20) var<storage, read> regression_weights: array<real>;

// All neighbours on all axes.
const ALL_AROUND = 63;

// 1 if voxel i of an axis has one before it, plus 2 if it has one after it.
fn sides(i: i32, last: i32, is_long: bool) -> i32 {
    return select(0, 1, i > 0) + select(0, 2, is_long && i <= last);
}

// The weights of voxel t for the three derivatives.
fn weights_of(neighbours: i32, t: i32) -> vec3<real> {
    let from_x = neighbours * 81 + t;
    return vec3<real>(regression_weights[from_x], regression_weights[from_x + 27], regression_weights[from_x + 54]);
}

// The gradient fitted at a voxel, from differences to `first`.
fn fitted_at(voxel: vec3<i32>, first: real) -> vec3<real> {
    let last = vec3<i32>(last_cell());
    let is_long = long_axes() > vec3<real>();
    let neighbours = sides(voxel.x, last.x, is_long.x) + 4 * sides(voxel.y, last.y, is_long.y)
        + 16 * sides(voxel.z, last.z, is_long.z);
    var sum = vec3<real>();
    for (var t = 0; t < 27; t++) {
        let c = voxel_at(voxel + vec3(t % 3 - 1, t / 3 % 3 - 1, t / 9 - 1)) - first;
        sum += c * weights_of(neighbours, t);
    }
    return sum;
}

// A row of three voxels from i on, interpolated with the next one along x, less `first`.
fn interpolated_row(i: vec3<i32>, wx: real, first: real) -> vec3<real> {
    let x = vec3(1, 0, 0);
    let a = voxel_at(i) - first;
    let b = voxel_at(i + x) - first;
    let c = voxel_at(i + 2 * x) - first;
    let d = voxel_at(i + 3 * x) - first;
    return lerp3(vec3<real>(a, b, c), vec3<real>(b, c, d), wx);
}

// Inside all corners of the cell have the same weights, and the voxels are interpolated first.
fn fitted_inside(at: Place, first: real) -> vec3<real> {
    let corner = at.cell - vec3(1);
    var sum = vec3<real>();
    for (var k = 0; k < 3; k++) {
        for (var j = 0; j < 3; j++) {
            let i = corner + vec3(0, j, k);
            let y = vec3(0, 1, 0);
            let z = vec3(0, 0, 1);
            let near = lerp3(interpolated_row(i, at.w.x, first), interpolated_row(i + y, at.w.x, first), at.w.y);
            let far = lerp3(interpolated_row(i + z, at.w.x, first), interpolated_row(i + y + z, at.w.x, first), at.w.y);
            let row = lerp3(near, far, at.w.z);
            let t = 9 * k + 3 * j;
            sum += row.x * weights_of(ALL_AROUND, t);
            sum += row.y * weights_of(ALL_AROUND, t + 1);
            sum += row.z * weights_of(ALL_AROUND, t + 2);
        }
    }
    return sum;
}

fn index_gradient(at: Place) -> vec3<real> {
    let c = at.cell;
    let first = voxel_at(c);
    if (all(c > vec3(0)) && all(vec3<real>(c) < last_cell())) {
        return fitted_inside(at, first);
    }
    let a = lerp3(fitted_at(c, first), fitted_at(c + vec3(1, 0, 0), first), at.w.x);
    let b = lerp3(fitted_at(c + vec3(0, 1, 0), first), fitted_at(c + vec3(1, 1, 0), first), at.w.x);
    let e = lerp3(fitted_at(c + vec3(0, 0, 1), first), fitted_at(c + vec3(1, 0, 1), first), at.w.x);
    let f = lerp3(fitted_at(c + vec3(0, 1, 1), first), fitted_at(c + vec3(1, 1, 1), first), at.w.x);
    return lerp3(lerp3(a, b, at.w.y), lerp3(e, f, at.w.y), at.w.z);
}
