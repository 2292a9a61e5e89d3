//! Central differences of the grid gradient, then trilinear interpolation ([REC-3]).
//!
//! The grid gradient is [REC-2]'s central one whatever `gradient` says, with its one-sided differences at the border, and
//! it is differenced by the same rule. Along an axis this makes of six voxels two numbers, at the corners of the cell,
//! which w interpolates: weights of six taps, as a kernel's.

use crate::field::Field;
use crate::field::place::Place;
use crate::field::tensor::{self, Taps};
use crate::number::{Real, Sym3};

/// The interpolated Hessian at a place, along the index axes.
pub(in crate::field) fn hessian<R: Real>(field: &Field<'_, R>, at: Place<R>) -> Sym3<R> {
    let dims = field.stencils.dims();
    let block = field.stencils.large_block::<R>(at.cell);
    let taps: [Taps<R, 6>; 3] = std::array::from_fn(|axis| taps(at.cell[axis], at.w[axis], dims[axis]));
    tensor::second(|j, k| block[k][j], &taps).1
}

/// Weights of voxels cell − 2 … cell + 3 of a line of n; those beyond its ends have none.
fn taps<R: Real>(cell: usize, w: R, n: usize) -> Taps<R, 6> {
    let mut taps = Taps { value: [R::ZERO; 6], first: [R::ZERO; 6], second: [R::ZERO; 6] };
    // On an axis of length 1 the cell has one corner.
    for (corner, weight) in [(cell, R::ONE - w), (cell + 1, w)].into_iter().take(n) {
        taps.value[corner + 2 - cell] += weight;
        for (i, c) in difference(corner, n) {
            let c = R::from_f64(c);
            taps.first[i + 2 - cell] += weight * c;
            for (j, d) in difference(i, n) {
                taps.second[j + 2 - cell] += weight * c * R::from_f64(d);
            }
        }
    }
    taps
}

/// The derivative at voxel i of a line of n as voxels and their weights: the central difference, (−3f₀ + 4f₁ − f₂)/2 at
/// an end, the difference of two voxels, 0 of one.
fn difference(i: usize, n: usize) -> impl Iterator<Item = (usize, f64)> {
    let terms = match n {
        1 => [(i, 0.0); 3],
        2 => [(0, -1.0), (1, 1.0), (i, 0.0)],
        _ if i == 0 => [(0, -1.5), (1, 2.0), (2, -0.5)],
        _ if i == n - 1 => [(i, 1.5), (i - 1, -2.0), (i - 2, 0.5)],
        _ => [(i - 1, -0.5), (i + 1, 0.5), (i, 0.0)],
    };
    terms.into_iter()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_inside_and_at_both_ends() {
        let inside = taps(5, 0.25f64, 20);
        assert_eq!(inside.value, [0.0, 0.0, 0.75, 0.25, 0.0, 0.0]);
        assert_eq!(inside.first, [0.0, -0.375, -0.125, 0.375, 0.125, 0.0]);
        assert_eq!(inside.second, [0.1875, 0.0625, -0.375, -0.125, 0.1875, 0.0625]);
        // g₀ = (−3f₀ + 4f₁ − f₂)/2, g₁ = (f₂ − f₀)/2, g₂ = (f₃ − f₁)/2; (−3g₀ + 4g₁ − g₂)/2 by hand.
        assert_eq!(taps(0, 0.0f64, 9).second, [0.0, 0.0, 1.25, -2.75, 1.75, -0.25]);
        assert_eq!(taps(7, 1.0f64, 9).second, [-0.25, 1.75, -2.75, 1.25, 0.0, 0.0].map(|x| x));
        assert_eq!(taps(0, 0.0f64, 1).first, [0.0; 6]);
        assert_eq!(taps(0, 0.5f64, 2).first, [0.0, 0.0, -1.0, 1.0, 0.0, 0.0]);
        assert_eq!(taps(0, 0.5f64, 2).second, [0.0; 6]);
    }
}
