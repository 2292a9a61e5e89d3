//! The sums of a region of smoothed samples, one axis after the other.

use super::rows::Row;
use crate::number::lanes::widely;

/// Number of sums that are computed side by side.
const SUMS: usize = 16;

/// The sums of a region.
pub(super) struct Sums<'r> {
    /// The rows of each axis.
    pub(super) axes: [&'r [Row]; 3],
    pub(super) sides: [usize; 3],
    /// The stored numbers that rows read along each axis, as a half-open range, and their count in `lines`.
    pub(super) read: [[usize; 2]; 3],
    pub(super) lines: [usize; 3],
}

impl Sums<'_> {
    /// Sums along z at every stored x and y, one plane for each row of z. Returns none if all numbers are 0.
    pub(super) fn along_z(&self, read: impl Fn([usize; 3], &mut [f64])) -> Option<Vec<f64>> {
        let [nx, ny, nz] = self.lines;
        let [x, y, z] = self.read.map(|[from, _]| from);
        let mut sums = vec![0.0; self.sides[2] * ny * nx];
        let mut lines = vec![0.0; nz * nx];
        let mut is_empty = true;
        for j in 0..ny {
            for (k, line) in lines.chunks_mut(nx).enumerate() {
                read([x, y + j, z + k], line);
            }
            // Scans are mostly empty around the object.
            if lines.iter().all(|c| *c == 0.0) {
                continue;
            }
            is_empty = false;
            widely(
                #[inline(always)]
                || {
                    for (k, (first, weights)) in self.axes[2].iter().enumerate() {
                        let to = &mut sums[(k * ny + j) * nx..][..nx];
                        weighted(to, &lines[(first - z) * nx..], nx, weights);
                    }
                },
            );
        }
        (!is_empty).then_some(sums)
    }

    /// Sums each plane along y, then along x. Lines are transposed between, so that sums lie side by side.
    pub(super) fn across(&self, along_z: &[f64], data: &mut [f64]) {
        let [nx, ny, _] = self.lines;
        let [sx, sy, _] = self.sides;
        let [x, y, _] = self.read.map(|[from, _]| from);
        let (mut line, mut turned, mut along_x) = (vec![0.0; nx], vec![0.0; nx * sy], vec![0.0; sy]);
        for (plane, out) in along_z.chunks(ny * nx).zip(data.chunks_mut(sx * sy)) {
            widely(
                #[inline(always)]
                || {
                    for (j, (first, weights)) in self.axes[1].iter().enumerate() {
                        weighted(&mut line, &plane[(first - y) * nx..], nx, weights);
                        for (i, &sum) in line.iter().enumerate() {
                            turned[i * sy + j] = sum;
                        }
                    }
                    for (i, (first, weights)) in self.axes[0].iter().enumerate() {
                        weighted(&mut along_x, &turned[(first - x) * sy..], sy, weights);
                        for (j, &sum) in along_x.iter().enumerate() {
                            out[j * sx + i] = sum;
                        }
                    }
                },
            );
        }
    }
}

/// Weighted sums of lines that lie `stride` apart, place by place.
#[inline(always)]
fn weighted(sums: &mut [f64], lines: &[f64], stride: usize, weights: &[f64]) {
    let n = sums.len();
    if n < SUMS {
        for (i, sum) in sums.iter_mut().enumerate() {
            *sum = weights.iter().enumerate().map(|(k, &w)| lines[k * stride + i] * w).fold(0.0, |a, b| a + b);
        }
        return;
    }
    // The last sums are computed together too, some of them a second time.
    for from in (0..n - SUMS).step_by(SUMS).chain([n - SUMS]) {
        let mut sum = [0.0; SUMS];
        for (k, &w) in weights.iter().enumerate() {
            let line = &lines[k * stride + from..][..SUMS];
            for i in 0..SUMS {
                sum[i] += line[i] * w;
            }
        }
        sums[from..][..SUMS].copy_from_slice(&sum);
    }
}
