// Sobel's operator on the voxels, then trilinear interpolation ([REC-2]).
// Twin: reference/src/field/gradient/sobel.rs

// Weights of voxels cell - 1 ... cell + 2: a central difference, and smoothing with (1, 2, 1)/4, which is dropped at the
// border of an axis.
fn sobel_taps(cell: i32, last: i32, w: real) -> Taps {
    let u = 1.0 - w;
    let at_start = cell == 0;
    let at_end = cell >= last;
    let side_u = select(0.25 * u, real(0.0), at_start);
    let side_w = select(0.25 * w, real(0.0), at_end);
    let middle_u = select(0.5 * u, u, at_start);
    let middle_w = select(0.5 * w, w, at_end);
    let zero = real(0.0);
    return Taps(
        array<real, 6>(side_u, middle_u + side_w, side_u + middle_w, side_w, zero, zero),
        array<real, 6>(-(0.5 * u), -(0.5 * w), 0.5 * u, 0.5 * w, zero, zero),
        array<real, 6>(),
    );
}

fn index_gradient(at: Place) -> vec3<real> {
    let last = vec3<i32>(last_cell());
    let taps = array<Taps, 3>(
        sobel_taps(at.cell.x, last.x, at.w.x),
        sobel_taps(at.cell.y, last.y, at.w.y),
        sobel_taps(at.cell.z, last.z, at.w.z),
    );
    return tensor_gradient(voxels, at.cell + vec3(VOXELS_PAD), 4, taps);
}
