//! Central differences of the grid gradient, then trilinear interpolation ([REC-3]).
//!
//! The grid gradient is the central one of [REC-2] for every value of `gradient`, with one-sided differences at the
//! border. It is differenced by the same rule. Along an axis, six voxels give the two numbers at the corners of the
//! cell, and w interpolates between them. The result has six taps, like a kernel.

use crate::field::Field;
use crate::field::place::CellPosition;
use crate::field::tensor::Taps;
use crate::number::{Real, Sym3};

/// The interpolated Hessian at a place, along the index axes.
pub(in crate::field) fn hessian<R: Real>(field: &Field<'_, R>, at: CellPosition<R>) -> Sym3<R> {
    let dims = field.stencils.dims();
    let block = field.stencils.large_block::<R>(at.cell);
    let [x, y, z]: [Taps<R, 6>; 3] = std::array::from_fn(|axis| taps(at.cell[axis], at.w[axis], dims[axis]));
    let first = block[2][2][2];
    let mut sum = Sym3::default();
    for (k, plane) in block.iter().enumerate() {
        for (j, row) in plane.iter().enumerate() {
            // Values have weights at taps 2 and 3, first differences at 1 to 4, second ones at all; the three orders of
            // one entry add up to 2.
            let spent = beside(j) + beside(k);
            if spent > 2 {
                continue;
            }
            let value = along_x::<R, 2>(&x.value, row, first);
            sum.yy += value * (y.second[j] * z.value[k]);
            sum.yz += value * (y.first[j] * z.first[k]);
            sum.zz += value * (y.value[j] * z.second[k]);
            if spent < 2 {
                let slope = along_x::<R, 4>(&x.first, row, first);
                sum.xy += slope * (y.first[j] * z.value[k]);
                sum.xz += slope * (y.value[j] * z.first[k]);
            }
            if spent == 0 {
                sum.xx += along_x::<R, 6>(&x.second, row, first) * (y.value[j] * z.value[k]);
            }
        }
    }
    sum
}

/// Σ w (c − first) over the `N` taps in the middle.
#[inline(always)]
fn along_x<R: Real, const N: usize>(taps: &[R; 6], row: &[R; 6], first: R) -> R {
    let mut sum = R::ZERO;
    for i in 3 - N / 2..3 + N / 2 {
        sum += taps[i] * (row[i] - first);
    }
    sum
}

/// Distance of a tap from the nearer corner of the cell: the order of difference that reaches the tap.
fn beside(tap: usize) -> usize {
    [2, 1, 0, 0, 1, 2][tap]
}

/// Weights of voxels cell − 2 … cell + 3 of a line of n; those beyond its ends have none.
fn taps<R: Real>(cell: usize, w: R, n: usize) -> Taps<R, 6> {
    if cell < 2 || cell + 4 > n {
        return taps_at_border(cell, w, n);
    }
    let (u, zero) = (R::ONE - w, R::ZERO);
    let ([half_u, half_w], quarter) = ([u * R::HALF, w * R::HALF], R::HALF * R::HALF);
    let [quarter_u, quarter_w] = [u * quarter, w * quarter];
    Taps {
        value: [zero, zero, u, w, zero, zero],
        first: [zero, -half_u, -half_w, half_u, half_w, zero],
        second: [quarter_u, quarter_w, -half_u, -half_w, quarter_u, quarter_w],
    }
}

/// Like [`taps`], by differences of differences, each one-sided at a border.
fn taps_at_border<R: Real>(cell: usize, w: R, n: usize) -> Taps<R, 6> {
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

/// The derivative at voxel i of a line of n, as voxels and their weights. It is the central difference, or (−3f₀ + 4f₁
/// − f₂)/2 at an end. It is the difference of two voxels if n = 2, and 0 if n = 1.
fn difference(i: usize, n: usize) -> [(usize, f64); 3] {
    match n {
        1 => [(i, 0.0); 3],
        2 => [(0, -1.0), (1, 1.0), (i, 0.0)],
        _ if i == 0 => [(0, -1.5), (1, 2.0), (2, -0.5)],
        _ if i == n - 1 => [(i, 1.5), (i - 1, -2.0), (i - 2, 0.5)],
        _ => [(i - 1, -0.5), (i + 1, 0.5), (i, 0.0)],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_inside_and_at_both_ends() {
        let inside = taps(5, 0.25f64, 20);
        assert_eq!(inside, taps_at_border(5, 0.25, 20));
        assert_eq!(inside.value, [0.0, 0.0, 0.75, 0.25, 0.0, 0.0]);
        assert_eq!(inside.first, [0.0, -0.375, -0.125, 0.375, 0.125, 0.0]);
        assert_eq!(inside.second, [0.1875, 0.0625, -0.375, -0.125, 0.1875, 0.0625]);
        // g₀ = (−3f₀ + 4f₁ − f₂)/2, g₁ = (f₂ − f₀)/2, g₂ = (f₃ − f₁)/2; (−3g₀ + 4g₁ − g₂)/2 by hand.
        assert_eq!(taps(0, 0.0f64, 9).second, [0.0, 0.0, 1.25, -2.75, 1.75, -0.25]);
        assert_eq!(taps(7, 1.0f64, 9).second, [-0.25, 1.75, -2.75, 1.25, 0.0, 0.0]);
        assert_eq!(taps(0, 0.0f64, 1).first, [0.0; 6]);
        assert_eq!(taps(0, 0.5f64, 2).first, [0.0, 0.0, -1.0, 1.0, 0.0, 0.0]);
        assert_eq!(taps(0, 0.5f64, 2).second, [0.0; 6]);
    }
}
