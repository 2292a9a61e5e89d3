//! Derivatives of a field smoothed by a Gaussian, computed only in the bricks that are asked for ([REC-3], [HATCH-3]).
//!
//! The grid is smoothed as for the `gaussian` Hessian. Its derivatives are first and second central differences,
//! interpolated linearly. They respond less to detail finer than the grid than a spline through the smoothed samples.
//! At σ = 1 voxel the root sum of squares of their weights is 0.066, that of the spline's 0.158. With the spline, an
//! oblique plane of bytes gets principal directions at 17 % of its voxels.
//!
//! Smoothing is separable. Along an axis each sample is one sum over its line, whose weights include the continuation
//! beyond the border. The samples around any cell can therefore be computed on their own, in any order.

mod rows;
mod sums;

use super::Field;
use super::hessian::gaussian;
use super::interpolated::{SampleWindow, TAPS};
use super::voxel_hessian::{bends, slopes};
use crate::number::{Sym3, Vec3};
use rows::{Row, reads, responses, rows};
use std::sync::OnceLock;
use sums::Sums;

/// Cells along the side of a brick. For σ beyond [`WIDE`] bricks are larger: each brick computes its own sums, and
/// neighbours would repeat more of them.
const BRICK: usize = 16;
const WIDE_BRICK: usize = 32;
const WIDE: f64 = 1.5;

/// First and second derivatives at one scale.
#[derive(Debug)]
pub struct Smoothed<'f, 'v> {
    field: &'f Field<'v, f64>,
    /// Weights of the smoothed samples of each axis, from two samples before the first on.
    rows: [Vec<Row>; 3],
    /// Cells along the side of a brick.
    side: usize,
    /// Bricks along x, y, z.
    dims: [usize; 3],
    bricks: Vec<OnceLock<SmoothedBox>>,
    /// Root sums of squares of the weights of a value and of a second derivative, for each voxel along each axis.
    responses: [Vec<[f64; 2]>; 3],
    /// Squared length of each column of D⁻ᵀ, which converts second derivatives to the world's unit.
    squares: [f64; 3],
    /// The lowest number, as numbers are read. Sums run over the differences to it.
    base: f64,
    /// The standard deviation of one rounding, as numbers are read, in the unit of the derivatives; 0 without rounding.
    rounding: f64,
}

/// Smoothed samples of a box, x fastest: all samples that the box's cells read.
#[derive(Debug)]
pub struct SmoothedBox {
    /// The first cell. The first sample lies two before it.
    first: [usize; 3],
    /// Samples along each axis.
    sides: [usize; 3],
    data: Box<[f64]>,
}

impl SmoothedBox {
    /// Index of a sample in `data`; each axis counts from two samples before the grid.
    #[inline(always)]
    fn place(&self, sample: [usize; 3]) -> usize {
        let ([x, y, z], [x0, y0, z0]) = (sample, self.first);
        ((z - z0) * self.sides[1] + (y - y0)) * self.sides[0] + (x - x0)
    }
}

impl<'f, 'v> Smoothed<'f, 'v> {
    /// Prepares smoothing by σ, in voxels, at most some tens. Nothing is smoothed yet.
    pub fn new(field: &'f Field<'v, f64>, sigma: f64) -> Self {
        let grid = field.volume().grid();
        let (n, spacing) = (grid.dims(), grid.spacing());
        let along = |a: usize| if n[a] > 1 { sigma * grid.voxel() / spacing[a] } else { 0.0 };
        let rows = [0, 1, 2].map(|a| rows(n[a], &gaussian::half_taps(along(a))));
        let side = if sigma > WIDE { WIDE_BRICK } else { BRICK };
        let dims = n.map(|n| (n.max(2) - 1).div_ceil(side));
        let bricks = (0..dims.iter().product()).map(|_| OnceLock::new()).collect();
        let responses = [0, 1, 2].map(|a| responses(&rows[a], n[a]));
        let inverse = &field.inverse_transpose;
        let squares = [0, 1, 2].map(|a| {
            let column = [0, 1, 2].map(|i| [inverse.rows[i].x, inverse.rows[i].y, inverse.rows[i].z][a]);
            column.iter().map(|c| c * c).sum::<f64>()
        });
        let integers = field.volume().is_integer();
        let rounding = if integers { field.derivative.abs() / 12f64.sqrt() } else { 0.0 };
        Self { field, rows, side, dims, bricks, responses, squares, base: field.stencils.lowest(), rounding }
    }

    /// Gradient and Hessian at a position in index space inside the box of [SPACE-1]. They are in world space, times
    /// 2^−e, like those of a [`Sampler`](super::Sampler).
    pub fn derivatives(&self, index: Vec3<f64>) -> (Vec3<f64>, Sym3<f64>) {
        let at = self.field.cells.locate(index);
        let region = self.brick_of(at.cell);
        let [from, plane] = [region.place(at.cell), region.sides[0] * region.sides[1]];
        let around = SampleWindow { samples: &region.data[from..], strides: [region.sides[0], plane] };
        let (gradient, hessian) = around.second(at.w);
        (self.field.to_world.apply(gradient), self.field.to_world_hessian(hessian))
    }

    /// Like [`derivatives`](Self::derivatives), but at a voxel and faster: only 19 of the 216 samples around a cell
    /// count there. The results agree up to rounding. Returns none if the gradient is no longer than `bound`. `region`
    /// holds the voxel's samples. Without a region they are taken from the voxel's brick.
    #[inline]
    pub fn at_voxel(
        &self,
        voxel: [usize; 3],
        bound: f64,
        region: Option<&SmoothedBox>,
    ) -> Option<(Vec3<f64>, Sym3<f64>)> {
        let region = region.unwrap_or_else(|| self.brick_of(self.cell_of(voxel)));
        let [y, z] = [region.sides[0], region.sides[0] * region.sides[1]];
        let from = region.place(voxel);
        let window = &region.data[from..from + 4 * (1 + y + z) + 1];
        let first = window[2 * (1 + y + z)];
        let d = |i: usize, j: usize, k: usize| window[i + j * y + k * z] - first;
        let gradient = self.field.to_world.apply(slopes(d));
        // Scans are mostly empty around the object, so the Hessian is left out there.
        (gradient.length() > bound).then(|| (gradient, self.field.to_world_hessian(bends(d))))
    }

    /// The cell of a voxel.
    #[inline]
    pub fn cell_of(&self, [x, y, z]: [usize; 3]) -> [usize; 3] {
        let [nx, ny, nz] = self.field.volume.dims();
        [x.min(nx.max(2) - 2), y.min(ny.max(2) - 2), z.min(nz.max(2) - 2)]
    }

    /// The samples that the cell's brick reads, computed on the first request.
    #[inline]
    fn brick_of(&self, [x, y, z]: [usize; 3]) -> &SmoothedBox {
        let (side, [nx, ny, _]) = (self.side, self.dims);
        let (x, y, z) = (x / side, y / side, z / side);
        self.bricks[(z * ny + y) * nx + x].get_or_init(|| self.region([x * side, y * side, z * side], [side; 3]))
    }

    /// q·w_σ of [HATCH-3]: the standard deviation of a second derivative in a cell, in the unit of
    /// [`derivatives`](Self::derivatives). Each value times 2^−e has the standard deviation `deviation`, but at least
    /// that of one rounding to an integer. Floating-point voxels have no rounding. Near the border, where samples are
    /// continued, the result is larger.
    pub fn noise(&self, index: Vec3<f64>, deviation: f64) -> f64 {
        self.noise_in(self.field.cells.locate(index).cell, deviation)
    }

    /// Like [`noise`](Self::noise), for a cell.
    #[inline]
    pub fn noise_in(&self, cell: [usize; 3], deviation: f64) -> f64 {
        let q = self.rounding.max(deviation);
        if q == 0.0 { 0.0 } else { q * self.response(cell) }
    }

    /// Bytes of the bricks that were computed.
    pub fn bytes(&self) -> u64 {
        self.bricks.iter().filter_map(OnceLock::get).map(|brick| size_of_val(&*brick.data) as u64).sum()
    }

    /// w_σ in a cell: the root sum of squares of the weights of a second derivative along an axis, in the world's unit.
    /// The result is the largest over the axes and the cell's corners.
    #[inline]
    fn response(&self, cell: [usize; 3]) -> f64 {
        let at = |a: usize| {
            let of = &self.responses[a];
            let (p, q) = (of[cell[a]], of[(cell[a] + 1).min(of.len() - 1)]);
            [p[0].max(q[0]), p[1].max(q[1])]
        };
        let (x, y, z, s) = (at(0), at(1), at(2), self.squares);
        let along = [x[1] * y[0] * z[0] * s[0], y[1] * x[0] * z[0] * s[1], z[1] * x[0] * y[0] * s[2]];
        along[0].max(along[1]).max(along[2])
    }

    /// The samples that `cells` cells from `first` on read, up to the end of the grid. They are computed anew and not
    /// kept. Sums run along z, then y, then x. Each runs over all samples with a weight, in their order.
    pub fn region(&self, first: [usize; 3], cells: [usize; 3]) -> SmoothedBox {
        let of_axis = |a: usize| {
            let rows = &self.rows[a][first[a]..];
            &rows[..rows.len().min(cells[a] - 1 + TAPS)]
        };
        let axes = [0, 1, 2].map(of_axis);
        let sides = axes.map(<[Row]>::len);
        let read = axes.map(reads);
        let mut data = vec![0.0; sides.iter().product()];
        let sums = Sums { axes, sides, read, lines: read.map(|[from, to]| to - from) };
        let along_z = sums.along_z(|at, line| {
            self.field.stencils.read_run(at, line);
            line.iter_mut().for_each(|c| *c -= self.base);
        });
        if let Some(along_z) = along_z {
            sums.across(&along_z, &mut data);
        }
        SmoothedBox { first, sides, data: data.into_boxed_slice() }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{HessianEstimator, Reconstruction, Rung, Sampler};
    use super::*;
    use crate::with_sampler;
    use drypoint_scene::glam::DVec3;
    use drypoint_scene::math::scale_by_power_of_two;
    use drypoint_scene::philox::uniform;
    use drypoint_scene::space::Grid;
    use drypoint_scene::volume::{Volume, Voxels};

    fn noise(dims: [usize; 3], spacing: [f64; 3]) -> Volume {
        let grid = Grid::with_spacing(dims, spacing).unwrap();
        let voxels = (0..grid.len()).map(|i| (uniform(3, [i as u32, 0, 0], 0) * 256.0) as u8).collect();
        Volume::new(grid, Voxels::U8(voxels), 0.5, -20.0).unwrap()
    }

    /// Central derivatives of a volume of the smoothed samples, each summed by itself, at places at least two voxels
    /// from the border and on it. The bound is some hundred roundings of numbers below 128 over a spacing of ½ squared.
    #[test]
    fn bricks_are_the_smoothed_grid_s() {
        for (dims, spacing) in [([40, 21, 18], [1.0, 1.0, 1.0]), ([17, 9, 34], [0.5, 2.0, 0.75])] {
            let volume = noise(dims, spacing);
            for sigma in [1.0, 4.0] {
                let field = Field::<f64>::new(&volume, Reconstruction::default(), Rung::Gradient).unwrap();
                let smoothed = Smoothed::new(&field, sigma);
                let along = [0, 1, 2].map(|a| gaussian::half_taps(sigma * volume.grid().voxel() / spacing[a]));
                let line = |a: usize, i: usize| gaussian::row::<f64>(&along[a], i, dims[a]);
                let mut values: Vec<f64> = (0..volume.grid().len()).map(|i| volume.voxels().get(i)).collect();
                for (a, stride) in [1, dims[0], dims[0] * dims[1]].into_iter().enumerate() {
                    let before = values.clone();
                    for (i, value) in values.iter_mut().enumerate() {
                        let at = i / stride % dims[a];
                        let (first, weights) = line(a, at);
                        let start = i - at * stride;
                        let of = |(k, w): (usize, &f64)| w * before[start + (first + k) * stride];
                        *value = weights.iter().enumerate().map(of).sum();
                    }
                }
                let other = Volume::new(volume.grid().clone(), Voxels::F64(values), 0.5, -20.0).unwrap();
                let how = Reconstruction { hessian: HessianEstimator::Central, ..Default::default() };
                let direct = Field::<f64>::new(&other, how, Rung::Hessian).unwrap();
                let unit = scale_by_power_of_two(1.0, direct.scale_exponent() - field.scale_exponent());
                let [lo, hi] = volume.grid().index_box();
                for i in 0..400u32 {
                    let r = |a: u32| uniform(5, [i, a, 0], 0);
                    let p = (lo + 2.0) + (hi - lo - 4.0) * DVec3::new(r(0), r(1), r(2));
                    let p = Vec3::from_glam(if i % 5 == 0 { p.round() } else { p });
                    let (g, h) = smoothed.derivatives(p);
                    let (g0, h0) = with_sampler!(direct, |s| s.hessian(p));
                    let off = (g - g0 * unit).length();
                    let entries = |h: Sym3<f64>| [h.xx, h.xy, h.xz, h.yy, h.yz, h.zz];
                    let pairs = entries(h).into_iter().zip(entries(h0.scaled(unit)));
                    let worst = pairs.fold(off, |m, (a, b)| m.max((a - b).abs()));
                    let scale = scale_by_power_of_two(128.0 * 4.0, -field.scale_exponent());
                    assert!(worst <= 300.0 * f64::EPSILON * scale, "{dims:?} {sigma} {p:?}: {worst:e}");
                }
            }
        }
    }

    /// A quadratic keeps its Hessian up to the border. Axes of two samples keep the slope, and an axis of one sample
    /// nothing.
    #[test]
    fn quadratics_are_reproduced() {
        for dims in [[12, 9, 7], [11, 2, 1]] {
            let grid = Grid::with_spacing(dims, [1.0, 2.0, 0.5]).unwrap();
            let curved = |n: usize| if n > 2 { 1.0 } else { 0.0 };
            let at = |i: usize| {
                let p = grid.to_world(DVec3::new(
                    (i % dims[0]) as f64,
                    (i / dims[0] % dims[1]) as f64,
                    (i / dims[0] / dims[1]) as f64,
                ));
                0.5 * p.x * p.x - 0.25 * curved(dims[1]) * p.y * p.y + p.x * p.y + 3.0 * p.z
            };
            let volume = Volume::new(grid.clone(), Voxels::F64((0..grid.len()).map(at).collect()), 1.0, 0.0).unwrap();
            let field = Field::<f64>::new(&volume, Reconstruction::default(), Rung::Gradient).unwrap();
            let unit = scale_by_power_of_two(1.0, field.scale_exponent());
            let [lo, hi] = grid.index_box();
            for sigma in [1.0, 2.0] {
                let smoothed = Smoothed::new(&field, sigma);
                for i in 0..50u32 {
                    let r = |a: u32| (uniform(5, [i, a, 0], 0) * 1.4 - 0.2).clamp(0.0, 1.0);
                    let p = lo + (hi - lo) * DVec3::new(r(0), r(1), r(2));
                    let (g, h) = smoothed.derivatives(Vec3::from_glam(p));
                    let world = grid.to_world(p);
                    let slope = if dims[2] > 1 { 3.0 } else { 0.0 };
                    let want = DVec3::new(world.x + world.y, world.x - 0.5 * curved(dims[1]) * world.y, slope);
                    let off = (g.to_glam() * unit - want).length();
                    let entries = [h.xx - 1.0 / unit, h.xy - 1.0 / unit, h.xz, h.yz, h.zz];
                    let worst = entries.iter().fold(off, |m, e| m.max((e * unit).abs()));
                    // Extrapolated weights of up to 36 on each axis, of values below 300.
                    assert!(worst <= 36.0 * 36.0 * 300.0 * f64::EPSILON * 4.0, "{dims:?} {p}: {worst:e}");
                    assert!((h.yy * unit + 0.5 * curved(dims[1])).abs() <= 1e-9);
                }
            }
        }
    }

    /// w_σ as [HATCH-3] has it: responses sin² ω times the taps', integrated with another program.
    #[test]
    fn weights_of_the_second_derivative() {
        let volume = noise([64; 3], [1.0; 3]);
        let field = Field::<f64>::new(&volume, Reconstruction::default(), Rung::Gradient).unwrap();
        for (sigma, want) in [(1.0, 0.065_892_400), (2.0, 0.009_414_713), (4.0, 0.000_963_037)] {
            let smoothed = Smoothed::new(&field, sigma);
            assert!((smoothed.response([32; 3]) / want - 1.0).abs() < 1e-6, "{sigma}: {}", smoothed.response([32; 3]));
            let unit = scale_by_power_of_two(0.5, -field.scale_exponent());
            let noise = |x: f64| smoothed.noise(Vec3::new(x, 32.0, 32.0), 0.0) / (want / 12f64.sqrt() * unit);
            assert!((noise(32.5) - 1.0).abs() < 1e-6);
            // A parabola through three noisy samples goes on up to eight voxels beyond them and more.
            assert!(noise(0.0) > 2.0, "{}", noise(0.0));
        }
    }

    /// Derivatives at voxels, from bricks and from a region by itself, up to the border. They agree with
    /// [`Smoothed::derivatives`] up to some roundings of 128 over a spacing squared. Bricks and regions give the same
    /// bits.
    #[test]
    fn at_voxels_nineteen_samples_are_enough() {
        for (dims, spacing) in [([35, 18, 17], [1.0, 0.5, 2.0]), ([6, 2, 1], [1.0; 3])] {
            let volume = noise(dims, spacing);
            let field = Field::<f64>::new(&volume, Reconstruction::default(), Rung::Gradient).unwrap();
            let smoothed = Smoothed::new(&field, 1.5);
            let whole = smoothed.region([0; 3], dims);
            let scale = scale_by_power_of_two(128.0 * 4.0, -field.scale_exponent());
            for i in 0..dims.iter().product() {
                let voxel = [i % dims[0], i / dims[0] % dims[1], i / dims[0] / dims[1]];
                let at = smoothed.at_voxel(voxel, -1.0, None);
                assert_eq!(at, smoothed.at_voxel(voxel, -1.0, Some(&whole)));
                let at = at.unwrap();
                assert_eq!(smoothed.at_voxel(voxel, at.0.length(), None), None);
                let [x, y, z] = voxel.map(|i| i as f64);
                let (g, h) = smoothed.derivatives(Vec3::new(x, y, z));
                let entries = |h: Sym3<f64>| [h.xx, h.xy, h.xz, h.yy, h.yz, h.zz];
                let pairs = entries(h).into_iter().zip(entries(at.1));
                let worst = pairs.fold((g - at.0).length(), |m, (a, b)| m.max((a - b).abs()));
                assert!(worst <= 300.0 * f64::EPSILON * scale, "{voxel:?}: {worst:e}");
            }
        }
    }

    /// No brick is made before it is asked for. Then one of 21³ numbers is made, or of 37³ for a wide Gaussian.
    #[test]
    fn only_what_is_asked_for_is_made() {
        let volume = noise([40; 3], [1.0; 3]);
        let field = Field::<f64>::new(&volume, Reconstruction::default(), Rung::Gradient).unwrap();
        let smoothed = Smoothed::new(&field, 1.0);
        assert_eq!(smoothed.bytes(), 0);
        for x in [17.0, 31.9, 16.0] {
            smoothed.derivatives(Vec3::new(x, 20.0, 3.0));
            assert_eq!(smoothed.bytes(), 21 * 21 * 21 * 8);
        }
        // Up to the border there are twelve along x.
        smoothed.derivatives(Vec3::new(32.0, 20.0, 3.0));
        assert_eq!(smoothed.bytes(), (21 + 12) * 21 * 21 * 8);
        let wide = Smoothed::new(&field, 2.0);
        wide.derivatives(Vec3::new(17.0, 20.0, 3.0));
        assert_eq!(wide.bytes(), 37 * 37 * 37 * 8);
    }
}
