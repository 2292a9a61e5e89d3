//! Derivatives of a field smoothed by a Gaussian, made only where they are asked for ([REC-3], [HATCH-3]).
//!
//! Smoothing and the spline's prefilter are linear and separable: along an axis each coefficient is one sum over the samples
//! of its line, and its weights, found once from the responses to all single samples, hold the continuation beyond the border
//! too. So the coefficients around any cell can be had by themselves, whatever else was asked for and in whatever order. They
//! are those of the `gaussian` Hessian but for weights below 2⁻⁴⁰ of the largest, which are left out.

use super::coefficients::continue_lanes;
use super::hessian::gaussian;
use super::kernel::bspline;
use super::prefilter::Prefilter;
use super::{Field, tensor};
use crate::number::{Sym3, Vec3};
use drypoint_scene::math::scale_by_power_of_two;
use std::sync::OnceLock;

/// Cells along the side of a brick.
const BRICK: usize = 16;

/// Coefficients along the side of a brick: a cell reads from the one before it to two after it.
const SIDE: usize = BRICK + 3;

/// The weights of one coefficient: the first sample that has one, and its weight and those of the ones after it.
type Row = (usize, Vec<f64>);

/// First and second derivatives at one scale.
#[derive(Debug)]
pub struct Smoothed<'f, 'v> {
    field: &'f Field<'v, f64>,
    /// For each axis the rows of its coefficients, from the one before the first sample on.
    rows: [Vec<Row>; 3],
    /// Bricks along x, y, z.
    dims: [usize; 3],
    bricks: Vec<OnceLock<Box<[f64]>>>,
    noise: f64,
}

impl<'f, 'v> Smoothed<'f, 'v> {
    /// σ is in voxels, at most some tens; nothing is smoothed yet.
    pub fn new(field: &'f Field<'v, f64>, sigma: f64) -> Self {
        let grid = field.volume().grid();
        let (n, spacing) = (grid.dims(), grid.spacing());
        let along = |a: usize| if n[a] > 1 { sigma * grid.voxel() / spacing[a] } else { 0.0 };
        let rows = [0, 1, 2].map(|a| rows(n[a], &gaussian::half_taps(along(a))));
        let dims = n.map(|n| (n.max(2) - 1).div_ceil(BRICK));
        let bricks = (0..dims.iter().product()).map(|_| OnceLock::new()).collect();
        let mut smoothed = Self { field, rows, dims, bricks, noise: 0.0 };
        if field.volume().voxels().voxel_type().is_integer() {
            smoothed.noise = smoothed.response() * field.derivative.abs() / 12f64.sqrt();
        }
        smoothed
    }

    /// Gradient and Hessian at a position in index space inside the box of [SPACE-1], in world space, times 2^−e as those of a
    /// [`Sampler`](super::Sampler).
    pub fn derivatives(&self, index: Vec3<f64>) -> (Vec3<f64>, Sym3<f64>) {
        let at = self.field.cells.locate(index);
        let brick = at.cell.map(|c| c / BRICK);
        let [nx, ny, _] = self.dims;
        let i = (brick[2] * ny + brick[1]) * nx + brick[0];
        let data = self.bricks[i].get_or_init(|| self.brick(brick));
        let [x, y, z] = at.cell.map(|c| c % BRICK);
        let row = |j: usize, k: usize| -> [f64; 4] {
            let from = ((z + k) * SIDE + y + j) * SIDE + x;
            std::array::from_fn(|i| data[from + i])
        };
        let (gradient, hessian) = tensor::second(row, &at.w.map(bspline::taps));
        (self.field.to_world.apply(gradient), self.field.to_world_hessian(hessian))
    }

    /// q·w_σ of [HATCH-3]: the standard deviation of a second derivative, in the unit of [`derivatives`](Self::derivatives),
    /// where each stored number is off by one rounding to an integer; 0 for floating-point voxels.
    pub fn noise(&self) -> f64 {
        self.noise
    }

    /// Bytes of the bricks that were made.
    pub fn bytes(&self) -> u64 {
        self.bricks.iter().filter_map(OnceLock::get).map(|brick| size_of_val(&**brick) as u64).sum()
    }

    /// w_σ for index derivatives turned to world ones: the root sum of squares of the weights that a second derivative along
    /// an axis has at a voxel in the middle, the largest of the three axes.
    fn response(&self) -> f64 {
        let root_sum = |weights: Vec<f64>| weights.iter().map(|w| w * w).sum::<f64>().sqrt();
        let dims = self.field.volume().dims();
        let of = |taps: fn([f64; 3]) -> f64, a: usize| root_sum(combined(&self.rows[a], dims[a], taps));
        let values = [0, 1, 2].map(|a| of(|[l, m, r]| (l + 4.0 * m + r) / 6.0, a));
        let seconds = [0, 1, 2].map(|a| of(|[l, m, r]| l - 2.0 * m + r, a));
        let inverse = &self.field.inverse_transpose;
        let along = |a: usize| {
            let column = [0, 1, 2].map(|i| [inverse.rows[i].x, inverse.rows[i].y, inverse.rows[i].z][a]);
            let square: f64 = column.iter().map(|c| c * c).sum();
            seconds[a] * values[(a + 1) % 3] * values[(a + 2) % 3] * square
        };
        along(0).max(along(1)).max(along(2))
    }

    /// The coefficients that the cells of a brick read, x fastest: sums along x, then y, then z.
    fn brick(&self, brick: [usize; 3]) -> Box<[f64]> {
        let of_axis = |a: usize| {
            let rows = &self.rows[a][brick[a] * BRICK..];
            &rows[..rows.len().min(SIDE)]
        };
        let [xs, ys, zs] = [0, 1, 2].map(of_axis);
        let [x_range, y_range, z_range] = [xs, ys, zs].map(reads);
        let stencils = &self.field.stencils;
        let base: f64 = stencils.lowest();
        let mut line = vec![0.0; x_range[1] - x_range[0]];
        let mut plane = vec![0.0; (y_range[1] - y_range[0]) * SIDE];
        let mut planes = vec![0.0; (z_range[1] - z_range[0]) * SIDE * SIDE];
        for (z, out) in (z_range[0]..).zip(planes.chunks_mut(SIDE * SIDE)) {
            for (y, out) in (y_range[0]..).zip(plane.chunks_mut(SIDE)) {
                stencils.read_run([x_range[0], y, z], &mut line);
                line.iter_mut().for_each(|c| *c -= base);
                for (out, (first, weights)) in out.iter_mut().zip(xs) {
                    let samples = &line[first - x_range[0]..][..weights.len()];
                    *out = samples.iter().zip(weights).map(|(c, w)| c * w).sum();
                }
            }
            sums(&plane, SIDE, ys, y_range[0], out);
        }
        let mut data = vec![0.0; SIDE * SIDE * SIDE];
        sums(&planes, SIDE * SIDE, zs, z_range[0], &mut data);
        data.into_boxed_slice()
    }
}

/// The samples that rows read: the first, and the one after the last.
fn reads(rows: &[Row]) -> [usize; 2] {
    let first = rows.iter().map(|(first, _)| *first).min().unwrap_or(0);
    [first, rows.iter().map(|(first, weights)| first + weights.len()).max().unwrap_or(first)]
}

/// For each row its weighted sum of the runs of `lanes` numbers, of which the first is that of sample `start`.
fn sums(samples: &[f64], lanes: usize, rows: &[Row], start: usize, out: &mut [f64]) {
    for (out, (first, weights)) in out.chunks_mut(lanes).zip(rows) {
        let runs = samples[(first - start) * lanes..].chunks(lanes);
        for (run, &w) in runs.zip(weights) {
            for (sum, &c) in out.iter_mut().zip(run) {
                *sum += c * w;
            }
        }
    }
}

/// The rows of a line of n samples, smoothed with half taps: the coefficients of all lines that have a single 1.
fn rows(n: usize, half: &[f64]) -> Vec<Row> {
    let count = n.max(2) + 2;
    // Coefficient i of the line whose sample j is 1 stands at i·n + j.
    let mut response = vec![0.0; count * n];
    for (i, out) in response[n..].chunks_mut(n).take(n).enumerate() {
        let (first, weights) = if n == 1 { (0, vec![1.0]) } else { gaussian::row(half, i, n) };
        out[first..first + weights.len()].copy_from_slice(&weights);
    }
    if let Some(filter) = Prefilter::new(n, 1) {
        filter.solve_lanes(&mut response[n..n + n * n], n);
    }
    continue_lanes(&mut response, n, n, 1);
    response.chunks(n).map(shortened).collect()
}

/// A row without the ends that are too small to matter.
fn shortened(weights: &[f64]) -> Row {
    let largest = weights.iter().fold(0.0, |m: f64, w| m.max(w.abs()));
    let small = scale_by_power_of_two(largest, -40);
    let first = weights.iter().position(|w| w.abs() > small).unwrap_or(0);
    let end = weights.iter().rposition(|w| w.abs() > small).map_or(first, |last| last + 1);
    (first, weights[first..end].to_vec())
}

/// The weights of a combination of the three coefficients about the middle of a line.
fn combined(rows: &[Row], n: usize, taps: fn([f64; 3]) -> f64) -> Vec<f64> {
    let middle = n / 2;
    let weight = |row: usize, sample: usize| {
        let (first, weights) = &rows[row];
        sample.checked_sub(*first).and_then(|i| weights.get(i)).copied().unwrap_or(0.0)
    };
    (0..n).map(|sample| taps([0, 1, 2].map(|i| weight(middle + i, sample)))).collect()
}

#[cfg(test)]
mod tests {
    use super::super::{HessianEstimator, Reconstruction, Rung, Sampler};
    use super::*;
    use crate::with_sampler;
    use drypoint_scene::philox::uniform;
    use drypoint_scene::space::Grid;
    use drypoint_scene::volume::{Volume, Voxels};

    fn noise(dims: [usize; 3], spacing: [f64; 3]) -> Volume {
        let grid = Grid::with_spacing(dims, spacing).unwrap();
        let voxels = (0..grid.len()).map(|i| (uniform(3, [i as u32, 0, 0], 0) * 256.0) as u8).collect();
        Volume::new(grid, Voxels::U8(voxels), 0.5, -20.0).unwrap()
    }

    /// The same numbers as from the whole grid, at the border, on voxels and between, whichever comes first; off by the weights
    /// that are left out, some hundred of 2⁻⁴⁰ on each axis, of numbers below 128 over a spacing of ½ squared.
    #[test]
    fn bricks_are_the_whole_grid_s() {
        let spacings =
            [([40, 21, 18], [1.0, 1.0, 1.0]), ([17, 3, 34], [0.5, 2.0, 0.75]), ([2, 19, 1], [1.0, 1.0, 0.01])];
        for (dims, spacing) in spacings {
            let volume = noise(dims, spacing);
            for sigma in [1.0, 1.5, 4.0] {
                let scale = sigma * volume.grid().voxel();
                if dims[2] == 1 && scale > 1.0 {
                    // What lies along an axis of one voxel does not matter, but taps are refused for it.
                    continue;
                }
                let how = Reconstruction { hessian: HessianEstimator::Gaussian, scale, ..Default::default() };
                let field = Field::<f64>::new(&volume, how, Rung::Hessian).unwrap();
                let smoothed = Smoothed::new(&field, sigma);
                let unit = scale_by_power_of_two(1.0, -field.scale_exponent());
                let [lo, hi] = volume.grid().index_box();
                for i in 0..300u32 {
                    let r = |a: u32| uniform(5, [i, a, 0], 0);
                    let mut p = lo + (hi - lo) * drypoint_scene::glam::DVec3::new(r(0), r(1), r(2));
                    p = if i % 5 == 0 { p.round().clamp(lo, hi) } else { p };
                    let p = Vec3::from_glam(p);
                    let (g, h) = smoothed.derivatives(p);
                    let (g0, h0) = with_sampler!(field, |s| s.hessian(p));
                    let off = (g - g0).length();
                    let entries = |h: Sym3<f64>| [h.xx, h.xy, h.xz, h.yy, h.yz, h.zz];
                    let worst = entries(h).into_iter().zip(entries(h0)).fold(off, |m, (a, b)| m.max((a - b).abs()));
                    assert!(worst <= 300.0 * 2f64.powi(-40) * 128.0 * 4.0 * unit, "{dims:?} {sigma} {p:?}: {worst:e}");
                }
            }
        }
    }

    /// w_σ of second derivatives of the prefiltered cubic on voxels: the response 6(1 − cos ω)/(2 + cos ω) times the taps',
    /// integrated with another program.
    #[test]
    fn weights_of_the_second_derivative() {
        let volume = noise([64; 3], [1.0; 3]);
        let field = Field::<f64>::new(&volume, Reconstruction::default(), Rung::Gradient).unwrap();
        for (sigma, want) in [(1.0, 0.157_877_709), (2.0, 0.012_088_055), (4.0, 0.001_027_159)] {
            let smoothed = Smoothed::new(&field, sigma);
            assert!((smoothed.response() / want - 1.0).abs() < 1e-6, "{sigma}: {}", smoothed.response());
            let unit = scale_by_power_of_two(0.5, -field.scale_exponent());
            assert!((smoothed.noise() / (want / 12f64.sqrt() * unit) - 1.0).abs() < 1e-6);
        }
    }

    /// Nothing is made before it is asked for, and then one brick of 19³ numbers.
    #[test]
    fn only_what_is_asked_for_is_made() {
        let volume = noise([40; 3], [1.0; 3]);
        let field = Field::<f64>::new(&volume, Reconstruction::default(), Rung::Gradient).unwrap();
        let smoothed = Smoothed::new(&field, 2.0);
        assert_eq!(smoothed.bytes(), 0);
        for x in [17.0, 31.9, 16.0] {
            smoothed.derivatives(Vec3::new(x, 20.0, 3.0));
            assert_eq!(smoothed.bytes(), 19 * 19 * 19 * 8);
        }
        smoothed.derivatives(Vec3::new(32.0, 20.0, 3.0));
        assert_eq!(smoothed.bytes(), 2 * 19 * 19 * 19 * 8);
    }
}
