//! ‖g‖ of the regression gradient at every voxel of a row, eight side by side: the operations of one, so the same bits.

use super::regression::Taps;
use crate::field::Field;
use crate::number::lanes::{LANES, widely};
use crate::number::{Mat3, Vec3};

/// Numbers of voxels side by side.
type Lane = [f64; LANES];

impl Field<'_, f64> {
    /// ‖g‖ times 2^−e of the voxels of a row but for its first and last, by the `regression` gradient: the bits of
    /// [`voxel_gradient`](crate::field::Sampler::voxel_gradient)'s length. `rows` is memory to work in, `norms` as long as the
    /// row. Whether it can: not in rows at a border or too short, nor where numbers are read with care, nor with another
    /// estimator.
    pub(crate) fn regression_norms(&self, [y, z]: [usize; 2], rows: &mut Vec<f64>, norms: &mut [f64]) -> bool {
        let (nx, inside) = (norms.len(), norms.len().saturating_sub(2));
        let Some(regression) = &self.regression else { return false };
        if inside < LANES || !self.stencils.surrounds([1, y, z]) {
            return false;
        }
        rows.resize(9 * nx, 0.0);
        for (i, row) in rows.chunks_exact_mut(nx).enumerate() {
            self.stencils.read_row(y - 1 + i % 3, z - 1 + i / 3, row);
        }
        let taps = regression.taps_inside();
        widely(
            #[inline(always)]
            || {
                for start in (0..inside).step_by(LANES) {
                    // The last eight once more where the row ends in fewer.
                    let start = start.min(inside - LANES);
                    let lane = norms_of_eight(rows, nx, start, taps, &self.to_world);
                    norms[start + 1..][..LANES].copy_from_slice(&lane);
                }
            },
        );
        true
    }
}

/// Those of eight voxels, the first of which lies behind the one at `start`.
#[inline(always)]
fn norms_of_eight(rows: &[f64], nx: usize, start: usize, taps: &Taps, to_world: &Mat3<f64>) -> Lane {
    let mut windows = [[0.0; LANES + 2]; 9];
    for (r, window) in windows.iter_mut().enumerate() {
        window.copy_from_slice(&rows[r * nx + start..][..LANES + 2]);
    }
    let mut first = [0.0; LANES];
    first.copy_from_slice(&windows[4][1..=LANES]);
    // Where nothing changes differences and sums are 0.
    let mut differs = [false; LANES];
    for window in &windows {
        for l in 0..LANES {
            differs[l] |= window[l] != first[0];
        }
        differs[0] |= window[LANES] != first[0] || window[LANES + 1] != first[0];
    }
    if differs == [false; LANES] {
        return [0.0; LANES];
    }
    let mut sums = [[0.0; LANES]; 3];
    for (sum, taps) in sums.iter_mut().zip(taps) {
        for &(t, weight) in taps {
            let window = &windows[t / 3];
            for l in 0..LANES {
                sum[l] += (window[t % 3 + l] - first[l]) * weight;
            }
        }
    }
    let mut norms = [0.0; LANES];
    for l in 0..LANES {
        norms[l] = to_world.apply(Vec3::new(sums[0][l], sums[1][l], sums[2][l])).length();
    }
    norms
}
