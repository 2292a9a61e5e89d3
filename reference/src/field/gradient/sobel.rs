//! Sobel's operator on the voxels, then trilinear interpolation ([REC-2]).
//!
//! At a voxel the operator is a central difference along one axis, smoothed with (1, 2, 1)/4 along the two others. At
//! the border of an axis the difference is one-sided, as for central differences, and the smoothing along that axis is
//! dropped. Interpolated between two voxels, each of the two operations has four taps, like a kernel.

use crate::field::Field;
use crate::field::place::CellPosition;
use crate::field::tensor::{self, RowsFn, Taps};
use crate::number::{Arithmetic, Real, Vec3};
use drypoint_scene::volume::Access;

/// The interpolated gradient at a place, along the index axes.
pub(in crate::field) fn gradient<R: Real>(field: &Field<'_, R>, at: CellPosition<R>) -> Vec3<R> {
    let dims = field.stencils.dims();
    let block = field.stencils.block::<R>(at.cell);
    let taps: [Taps<R, 4>; 3] = std::array::from_fn(|axis| taps(at.cell[axis], at.w[axis], dims[axis]));
    tensor::gradient(&RowsFn(|j: usize, k: usize| block[k][j]), &taps)
}

/// The operator at a voxel that has neighbours on all sides: the sums of the interpolation, in their order.
#[inline(always)]
pub(super) fn at_voxel<R: Real>(voxels: impl Access, [x, y, z]: [usize; 3]) -> Vec3<R> {
    let (half, quarter) = (R::HALF, R::HALF * R::HALF);
    let (value, slope) = ([quarter, half, quarter], [-half, R::ZERO, half]);
    let a = voxels.window::<3>(x - 1, y - 1, z - 1);
    let first = R::from_voxel(a.at(1, 1, 1));
    // Sums over z and y, named by the derivatives in (y, z).
    let [mut s00, mut s10, mut s01] = [[R::ZERO; 3]; 3];
    for k in 0..3 {
        let [mut p0, mut p1] = [[R::ZERO; 3]; 2];
        for j in 0..3 {
            let row = a.row::<3>(0, j, k);
            for i in 0..3 {
                let c = R::from_voxel(row[i]) - first;
                p0[i] += c * value[j];
                p1[i] += c * slope[j];
            }
        }
        for i in 0..3 {
            s00[i] += p0[i] * value[k];
            s10[i] += p1[i] * value[k];
            s01[i] += p0[i] * slope[k];
        }
    }
    let smooth = |s: [R; 3]| (s[0] * quarter + s[2] * quarter) + s[1] * half;
    Vec3::new(s00[2] * half - s00[0] * half, smooth(s10), smooth(s01))
}

/// Weights of samples cell − 1 … cell + 2, those beyond the border continued.
fn taps<R: Real>(cell: usize, w: R, n: usize) -> Taps<R, 4> {
    if cell > 0 && cell + 2 < n {
        return taps_inside(w, R::ONE, R::ZERO);
    }
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

/// Like [`taps`], for a cell whose four voxels per axis all lie in the grid.
#[inline(always)]
pub(in crate::field) fn taps_inside<A: Arithmetic>(w: A, one: A, zero: A) -> Taps<A, 4> {
    let u = one - w;
    let [u_half, w_half] = [u.half(), w.half()];
    let [u_quarter, w_quarter] = [u_half.half(), w_half.half()];
    Taps {
        value: [u_quarter, u_half + w_quarter, u_quarter + w_half, w_quarter],
        first: [-u_half, -w_half, u_half, w_half],
        second: [zero; 4],
    }
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
