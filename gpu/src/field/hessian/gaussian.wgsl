// Derivatives of the cubic B-spline through the smoothed voxels ([REC-3]).
// Twin: reference/src/field/hessian/gaussian.rs

@group(1) @binding(21) var smoothed: texture_3d<f32>;

fn index_second(at: Place) -> Second {
    let taps = array<Taps, 3>(bspline_taps(at.w.x), bspline_taps(at.w.y), bspline_taps(at.w.z));
    return tensor_second(smoothed, at.cell + vec3(SMOOTHED_PAD), 4, taps);
}
