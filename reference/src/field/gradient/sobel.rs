//! Sobel's operator on the voxels, then trilinear interpolation ([REC-2]).
//!
//! On a voxel: central differences along one axis, smoothed with (1, 2, 1)/4 along the two others. At the border of an
//! axis differences are one-sided, as the central ones, and the smoothing along that axis is dropped. Interpolated
//! between two voxels each of the two operations has four taps, as a kernel's.

use crate::field::Field;
use crate::field::place::Place;
use crate::field::tensor::{self, Taps};
use crate::number::{Real, Vec3};

/// The interpolated gradient at a place, along the index axes.
pub(in crate::field) fn gradient<R: Real>(field: &Field<'_, R>, at: Place<R>) -> Vec3<R> {
    let dims = field.stencils.dims();
    let block = field.stencils.block::<R>(at.cell);
    let taps: [Taps<R, 4>; 3] = std::array::from_fn(|axis| taps(at.cell[axis], at.w[axis], dims[axis]));
    tensor::gradient(|j, k| block[k][j], &taps)
}

/// Weights of samples cell − 1 … cell + 2, those beyond the border continued.
fn taps<R: Real>(cell: usize, w: R, n: usize) -> Taps<R, 4> {
    let u = R::ONE - w;
    let (half, quarter) = (R::HALF, R::HALF * R::HALF);
    let mut value = [R::ZERO; 4];
    for (corner, weight) in [u, w].into_iter().enumerate() {
        let border = cell + corner == 0 || cell + corner + 1 >= n;
        let side = if border { R::ZERO } else { weight * quarter };
        value[corner] += side;
        value[corner + 1] += if border { weight } else { weight * half };
        value[corner + 2] += side;
    }
    Taps { value, first: [-(u * half), -(w * half), u * half, w * half], second: [R::ZERO; 4] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smoothing_inside_and_none_at_the_ends() {
        assert_eq!(taps(3, 0.5f64, 9).value, [0.125, 0.375, 0.375, 0.125]);
        assert_eq!(taps(0, 0.0f64, 9).value, [0.0, 1.0, 0.0, 0.0]);
        assert_eq!(taps(0, 0.5f64, 9).value, [0.0, 0.625, 0.25, 0.125]);
        assert_eq!(taps(7, 1.0f64, 9).value, [0.0, 0.0, 1.0, 0.0]);
        assert_eq!(taps(0, 0.5f64, 2).value, [0.0, 0.5, 0.5, 0.0]);
        assert_eq!(taps(3, 0.25f64, 9).first, [-0.375, -0.125, 0.375, 0.125]);
    }
}
