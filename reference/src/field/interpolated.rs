//! First and second central differences of samples, interpolated linearly ([REC-3]).
//!
//! Along an axis a cell has six samples; the interpolation runs between the differences at its two corners. Written as
//! a kernel this has six taps. Two of them are nonzero for the value and four for the first derivative, so 112 of the
//! 216 samples count.

use super::tensor::{self, Rows, RowsFn, Taps};
use crate::number::lanes::wide;
use crate::number::{Sym3, Vec3};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x4};

/// Samples that a cell reads along an axis.
pub(super) const TAPS: usize = 6;

/// The samples that a cell reads, weighted for values and derivatives between the first two of the cell.
#[inline(always)]
pub(super) fn taps(w: f64) -> Taps<f64, TAPS> {
    let r = 1.0 - w;
    Taps {
        value: [0.0, 0.0, r, w, 0.0, 0.0],
        first: [0.0, -0.5 * r, -0.5 * w, 0.5 * r, 0.5 * w, 0.0],
        second: [0.25 * r, 0.25 * w, -0.5 * r, -0.5 * w, 0.25 * r, 0.25 * w],
    }
}

/// The samples around a cell: a slice from the first one on, and the steps from a row to the next along y and along z.
#[derive(Clone, Copy)]
pub(super) struct SampleWindow<'s> {
    pub samples: &'s [f64],
    pub strides: [usize; 2],
}

impl SampleWindow<'_> {
    /// Gradient and Hessian along the index axes at the fractions `w` in the cell.
    pub(super) fn second(self, w: [f64; 3]) -> (Vec3<f64>, Sym3<f64>) {
        match wide() {
            Some(simd) => simd.vectorize(
                #[inline(always)]
                || sums(&self, &MiddleRows { around: &self, simd }, w),
            ),
            None => {
                let [y, z] = self.strides;
                tensor::second(&RowsFn(|j, k| self.row::<TAPS>(k * z + j * y)), &w.map(taps))
            }
        }
    }

    #[inline(always)]
    fn row<const N: usize>(&self, from: usize) -> [f64; N] {
        let row = &self.samples[from..from + N];
        let mut numbers = [0.0; N];
        numbers.copy_from_slice(row);
        numbers
    }
}

/// The four samples in the middle of each row.
struct MiddleRows<'a, S> {
    around: &'a SampleWindow<'a>,
    simd: S,
}

impl<S: Simd> Rows<f64x4<S>> for MiddleRows<'_, S> {
    #[inline(always)]
    fn row(&self, j: usize, k: usize) -> f64x4<S> {
        let [y, z] = self.around.strides;
        self.around.row::<4>(k * z + j * y + 1).simd_into(self.simd)
    }

    #[inline(always)]
    fn zero(&self) -> f64x4<S> {
        f64x4::splat(self.simd, 0.0)
    }
}

/// The sums of [`tensor::second`] over all six taps, with the same results, but without the taps of weight 0.
#[inline(always)]
fn sums<S: Simd>(around: &SampleWindow<'_>, rows: &MiddleRows<'_, S>, [x, y, z]: [f64; 3]) -> (Vec3<f64>, Sym3<f64>) {
    let (x, y, z) = (taps(x), taps(y), taps(z));
    let at = |i: usize, j: usize, k: usize| k * around.strides[1] + j * around.strides[0] + i;
    let first = around.samples[at(2, 2, 2)];
    // sᵢⱼ: sums over y and z with the i-th derivative along y and the j-th along z, of the middle four samples of each
    // row. `outer` holds the two outer samples, which only f_xx reads.
    let [mut s00, mut s10, mut s01, mut s20, mut s11, mut s02] = [rows.zero(); 6];
    let mut outer = [0.0; 2];
    for k in 0..TAPS {
        // pᵢ: the sums over y in one plane, with the i-th derivative. Only taps 2 and 3 have a value, and taps 1 to 4 a
        // first derivative.
        let [mut p0, mut p1, mut p2] = [rows.zero(); 3];
        let middle = k == 2 || k == 3;
        let (from, end) = if middle { (0, TAPS) } else { (1, TAPS - 1) };
        for j in from..end {
            let inner = j == 2 || j == 3;
            if !inner && (k == 0 || k == TAPS - 1) {
                continue;
            }
            let c = rows.row(j, k) - first;
            if inner {
                p0 += c * y.value[j];
            }
            p1 += c * y.first[j];
            if middle {
                p2 += c * y.second[j];
            }
        }
        if middle {
            s00 += p0 * z.value[k];
            s10 += p1 * z.value[k];
            s20 += p2 * z.value[k];
            for (sum, i) in outer.iter_mut().zip([0, TAPS - 1]) {
                let [a, b] = [2, 3].map(|j| (around.samples[at(i, j, k)] - first) * y.value[j]);
                *sum += (a + b) * z.value[k];
            }
        }
        s01 += p0 * z.first[k];
        s11 += p1 * z.first[k];
        s02 += p0 * z.second[k];
    }
    // Sums over x; the order of the terms is that of `tensor::second`.
    let value = |s: [f64; 4]| s[1] * x.value[2] + s[2] * x.value[3];
    let slope = |s: [f64; 4]| (s[1] * x.first[2] + s[3] * x.first[4]) + (s[0] * x.first[1] + s[2] * x.first[3]);
    let [s00, s10, s01]: [[f64; 4]; 3] = [s00.into(), s10.into(), s01.into()];
    let [s20, s11, s02]: [[f64; 4]; 3] = [s20.into(), s11.into(), s02.into()];
    let even = outer[0] * x.second[0] + s00[1] * x.second[2] + s00[3] * x.second[4];
    let odd = s00[0] * x.second[1] + s00[2] * x.second[3] + outer[1] * x.second[5];
    let hessian =
        Sym3 { xx: even + odd, xy: slope(s10), xz: slope(s01), yy: value(s20), yz: value(s11), zz: value(s02) };
    (Vec3::new(slope(s00), value(s10), value(s01)), hessian)
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::philox::uniform;

    /// Comparison with the sums over all 216 taps, number by number, also on the voxels of the cell, where more weights
    /// are 0.
    #[test]
    fn taps_of_weight_0_change_nothing() {
        const SIDES: [usize; 3] = [9, 8, 7];
        let samples: Vec<f64> =
            (0..SIDES.iter().product::<usize>()).map(|i| uniform(3, [i as u32, 0, 0], 0) * 300.0 - 100.0).collect();
        let strides = [SIDES[0], SIDES[0] * SIDES[1]];
        for i in 0..200u32 {
            let r = |a: u32| uniform(5, [i, a, 0], 0);
            let from = [0, 1, 2].map(|a| (r(a as u32) * (SIDES[a] - TAPS + 1) as f64) as usize);
            let w = [3, 4, 5].map(|a| if i % 5 == 0 { r(a).round() } else { r(a) });
            let samples = &samples[(from[2] * SIDES[1] + from[1]) * SIDES[0] + from[0]..];
            let around = SampleWindow { samples, strides };
            let all = RowsFn(|j: usize, k: usize| around.row::<TAPS>(k * strides[1] + j * strides[0]));
            assert_eq!(around.second(w), tensor::second(&all, &w.map(taps)), "{from:?} {w:?}");
        }
    }
}
