//! Gradient and Hessian at voxels, faster than between them ([REC-3]).

use super::{Field, Sampler, Second};
use crate::number::{Real, Sym3, Vec3};
use drypoint_scene::glam::DVec3;
use drypoint_scene::volume::Access;
use drypoint_scene::with_access;

impl Field<'_, f64> {
    /// Gradient and Hessian at a voxel, equal to the sampler's up to rounding. Away from the border, central
    /// differences read 19 voxels and a smoothed spline reads 27 coefficients. Elsewhere, and for a formula, the
    /// sampler is called.
    ///
    /// # Panics
    /// If the field was prepared for a lower rung than `Hessian`.
    pub fn voxel_hessian(&self, voxel: [usize; 3]) -> (Vec3<f64>, Sym3<f64>) {
        let near = match &self.second {
            _ if self.formula.is_some() => None,
            Second::Central if self.stencils.surrounds_twice(voxel) => Some(self.central(voxel)),
            Second::Gaussian(coefficients) => Some(of_spline(coefficients.differences_around(voxel))),
            _ => None,
        };
        match near {
            Some((gradient, hessian)) => (self.to_world.apply(gradient), self.to_world_hessian(hessian)),
            None => {
                let at = Vec3::from_glam(DVec3::from_array(voxel.map(|i| i as f64)));
                self.hessian(at)
            }
        }
    }

    /// Central differences at a voxel two or more voxels from the border. Differences of integers are exact in any
    /// order.
    #[inline]
    fn central(&self, [x, y, z]: [usize; 3]) -> (Vec3<f64>, Sym3<f64>) {
        with_access!(self.volume, |a| {
            let a = a.window::<5>(x - 2, y - 2, z - 2);
            let read = |i, j, k| f64::from_voxel(a.at(i, j, k));
            let first = read(2, 2, 2);
            let d = |i, j, k| read(i, j, k) - first;
            (slopes(d), bends(d))
        })
    }
}

/// Central differences along the index axes. `d(i, j, k)` is the difference to the voxel's own number; tap 2 is the
/// voxel itself on each axis.
#[inline(always)]
pub(super) fn slopes(d: impl Fn(usize, usize, usize) -> f64) -> Vec3<f64> {
    Vec3::new(d(3, 2, 2) - d(1, 2, 2), d(2, 3, 2) - d(2, 1, 2), d(2, 2, 3) - d(2, 2, 1)) * 0.5
}

/// Central differences of central differences.
#[inline(always)]
pub(super) fn bends(d: impl Fn(usize, usize, usize) -> f64) -> Sym3<f64> {
    Sym3 {
        xx: 0.25 * (d(0, 2, 2) + d(4, 2, 2)),
        xy: 0.25 * ((d(3, 3, 2) - d(1, 3, 2)) - (d(3, 1, 2) - d(1, 1, 2))),
        xz: 0.25 * ((d(3, 2, 3) - d(1, 2, 3)) - (d(3, 2, 1) - d(1, 2, 1))),
        yy: 0.25 * (d(2, 0, 2) + d(2, 4, 2)),
        yz: 0.25 * ((d(2, 3, 3) - d(2, 1, 3)) - (d(2, 3, 1) - d(2, 1, 1))),
        zz: 0.25 * (d(2, 2, 0) + d(2, 2, 4)),
    }
}

/// Gradient and Hessian of a cubic B-spline at one of its coefficients, from the weights (1, 4, 1)/6 along each axis
/// and their derivatives. Tap 1 of `d` is the coefficient at the voxel.
#[inline(always)]
fn of_spline(d: impl Fn(usize, usize, usize) -> f64) -> (Vec3<f64>, Sym3<f64>) {
    let mean = |c: [f64; 3]| (c[0] + c[2]) * (1.0 / 6.0) + c[1] * (2.0 / 3.0);
    let first = |c: [f64; 3]| 0.5 * (c[2] - c[0]);
    let second = |c: [f64; 3]| (c[0] + c[2]) - 2.0 * c[1];
    // Along z at each (x, y): value, first and second derivative.
    let (mut values, mut slopes, mut bends) = ([[0.0; 3]; 3], [[0.0; 3]; 3], [[0.0; 3]; 3]);
    for i in 0..3 {
        for j in 0..3 {
            let c = [d(i, j, 0), d(i, j, 1), d(i, j, 2)];
            (values[i][j], slopes[i][j], bends[i][j]) = (mean(c), first(c), second(c));
        }
    }
    // Along y at each x.
    let [p, q, r] = values;
    let (value, slope, bend) =
        ([mean(p), mean(q), mean(r)], [first(p), first(q), first(r)], [second(p), second(q), second(r)]);
    let [p, q, r] = slopes;
    let (z_slope, yz) = ([mean(p), mean(q), mean(r)], [first(p), first(q), first(r)]);
    let [p, q, r] = bends;
    let z_bend = [mean(p), mean(q), mean(r)];
    let gradient = Vec3::new(first(value), mean(slope), mean(z_slope));
    let hessian = Sym3 {
        xx: second(value),
        xy: first(slope),
        xz: first(z_slope),
        yy: mean(bend),
        yz: mean(yz),
        zz: mean(z_bend),
    };
    (gradient, hessian)
}

#[cfg(test)]
mod tests {
    use super::super::{HessianEstimator, Kernel, Reconstruction, Rung};
    use super::*;
    use drypoint_scene::math::scale_by_power_of_two;
    use drypoint_scene::philox::uniform;
    use drypoint_scene::space::Grid;
    use drypoint_scene::volume::{Volume, Voxels};

    /// Agreement with the sampler at every voxel, up to the border, on noise on an anisotropic grid. The bound is some
    /// dozen roundings of 128 over the spacing squared.
    #[test]
    fn it_is_the_sampler_s() {
        for dims in [[9, 8, 7], [5, 2, 1]] {
            let grid = Grid::with_spacing(dims, [0.5, 1.0, 2.0]).unwrap();
            let noise = |i: usize| uniform(3, [i as u32, 0, 0], 0) * 128.0;
            for floats in [false, true] {
                let voxels = (0..grid.len()).map(noise);
                let voxels =
                    if floats { Voxels::F64(voxels.collect()) } else { Voxels::U8(voxels.map(|v| v as u8).collect()) };
                let volume = Volume::new(grid.clone(), voxels, 1.0, -20.0).unwrap();
                for hessian in [HessianEstimator::Central, HessianEstimator::Gaussian, HessianEstimator::Analytic] {
                    let how = Reconstruction { kernel: Kernel::Bspline, hessian, ..Default::default() };
                    let field = Field::<f64>::new(&volume, how, Rung::Hessian).unwrap();
                    let scale = scale_by_power_of_two(128.0 * 4.0, -field.scale_exponent());
                    for i in 0..grid.len() {
                        let voxel = [i % dims[0], i / dims[0] % dims[1], i / dims[0] / dims[1]];
                        let at = Vec3::from_glam(DVec3::from_array(voxel.map(|i| i as f64)));
                        let (g, h) = field.hessian(at);
                        let (g0, h0) = field.voxel_hessian(voxel);
                        let entries = |h: Sym3<f64>| [h.xx, h.xy, h.xz, h.yy, h.yz, h.zz];
                        let pairs = entries(h).into_iter().zip(entries(h0));
                        let worst = pairs.fold((g - g0).length(), |m, (a, b)| m.max((a - b).abs()));
                        assert!(worst <= 64.0 * f64::EPSILON * scale, "{hessian:?} {voxel:?}: {worst:e}");
                    }
                }
            }
        }
    }
}
