// The cubic B-spline as the kernel: of prefiltered coefficients, or of the voxels, which it smooths ([REC-1]).
// Twin: reference/src/field/kernel/bspline.rs

const KERNEL_TAPS = 4;

fn kernel_taps(t: real) -> Taps {
    return bspline_taps(t);
}
