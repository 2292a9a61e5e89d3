//! Reconstructions asked at places, with the bounds that their formulas have ([REC-4]): what several themes need.
//!
//! The bounds are c ε M for values, c ε M ‖D⁻¹‖ for gradients and c ε M ‖D⁻¹‖² for Hessians, M the largest |value|: a sum
//! of n terms in a fixed order is off by at most n ε/2 times its magnitudes; stencils have up to 4 terms an axis whose
//! magnitudes add up to at most 4, c = 3·4·4. Prefiltering multiplies by 3 an axis (cubic) or 7.5 (quintic). All of it
//! holds for exact voxels: whole coefficients at dyadic places.

use crate::common::random::Random;
use crate::stability::worse;
use drypoint::reference::field::{
    Field, GradientEstimator, HessianEstimator, Kernel, Reconstruction, Rung, Sampler, curvature,
};
use drypoint::reference::number::{Real, Sym3, Vec3};
use drypoint::reference::with_sampler;
use drypoint::scene::glam::DVec3;
use drypoint::scene::math::scale_by_power_of_two;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::Outside;
use drypoint::scene::volume::Volume;

pub(crate) const KERNELS: [Kernel; 5] =
    [Kernel::Trilinear, Kernel::Bspline, Kernel::BsplineSmooth, Kernel::Bspline5, Kernel::CatmullRom];
pub(crate) const GRADIENTS: [GradientEstimator; 4] =
    [GradientEstimator::Central, GradientEstimator::Analytic, GradientEstimator::Sobel, GradientEstimator::Regression];

/// Every reconstruction that there is.
pub(crate) fn all(scale: f64) -> Vec<Reconstruction> {
    let hessians = [HessianEstimator::Central, HessianEstimator::Gaussian, HessianEstimator::Analytic];
    let smooth = |k: Kernel| !matches!(k, Kernel::Trilinear | Kernel::CatmullRom);
    let mut all = Vec::new();
    for kernel in KERNELS {
        for gradient in GRADIENTS {
            for hessian in hessians.into_iter().filter(|h| *h != HessianEstimator::Analytic || smooth(kernel)) {
                all.push(Reconstruction { kernel, gradient, hessian, scale, outside: Outside::Low });
            }
        }
    }
    all
}

/// c ε.
fn rounding<R: Real>(kernel: Kernel) -> f64 {
    let prefilter = match kernel {
        Kernel::Bspline => 27.0,
        Kernel::Bspline5 => 422.0,
        _ => 1.0,
    };
    48.0 * prefilter * R::EPSILON.to_f64()
}

/// Places in the box of a grid: its corners, on its faces, on voxels and between them.
pub(crate) fn places(grid: &Grid, count: usize) -> Vec<DVec3> {
    let [lo, hi] = grid.index_box();
    let r = &mut Random(7);
    let mut coordinate = |lo: f64, hi: f64| match r.below(5) {
        0 => lo,
        1 => hi,
        2 => r.between(lo, hi).floor().max(lo),
        _ => r.between(lo, hi),
    };
    let scattered =
        (0..count).map(|_| DVec3::new(coordinate(lo.x, hi.x), coordinate(lo.y, hi.y), coordinate(lo.z, hi.z)));
    let corner = |i: usize| DVec3::new([lo.x, hi.x][i & 1], [lo.y, hi.y][i >> 1 & 1], [lo.z, hi.z][i >> 2]);
    (0..8).map(corner).chain(scattered).collect()
}

/// What a reconstruction says at a place: value, gradient, the gradient of H's own field, H.
struct Asked {
    value: f64,
    gradient: DVec3,
    own: DVec3,
    hessian: Sym3<f64>,
    /// 2^e of [SPACE-4], which the derivatives lack.
    exponent: i32,
}

fn ask<R: Real>(field: &Field<'_, R>, p: Vec3<R>) -> Asked {
    let (value, gradient, (own, h)) = with_sampler!(field, |s| (s.value(p), s.gradient(p), s.hessian(p)));
    let [xx, xy, xz, yy, yz, zz] = [h.xx, h.xy, h.xz, h.yy, h.yz, h.zz].map(Real::to_f64);
    Asked {
        value: value.to_f64(),
        gradient: gradient.to_glam(),
        own: own.to_glam(),
        hessian: Sym3 { xx, xy, xz, yy, yz, zz },
        exponent: field.scale_exponent(),
    }
}

const SLOPE: DVec3 = DVec3::new(3.0, -2.0, 7.0);

/// A field of whole coefficients that is linear in the world.
pub(crate) fn linear(p: DVec3) -> f64 {
    5.0 + SLOPE.dot(p)
}

/// The largest error of value, gradient and Hessian of [`linear`] in units of their bounds, for every reconstruction.
/// Along axes of length 1 there is no slope; their D must be diagonal.
pub(crate) fn linear_errors<R: Real>(volume: &Volume, places: &[DVec3]) -> f64 {
    let grid = volume.grid();
    let (m, inverse) = (volume.largest_magnitude(), 1.0 / grid.smallest_singular_value());
    let slope = DVec3::from_array([0, 1, 2].map(|a| if grid.dims()[a] == 1 { 0.0 } else { SLOPE[a] }));
    let mut worst = 0.0;
    for how in all(grid.voxel()) {
        let field = Field::<R>::new(volume, how, Rung::Hessian).unwrap();
        for &p in places {
            let at = Vec3::<R>::from_glam(p);
            // The place that is asked at: a number of this type.
            let p = at.to_glam();
            let middle = DVec3::from_array([0, 1, 2].map(|a| if grid.dims()[a] == 1 { 0.0 } else { p[a] }));
            let got = ask(&field, at);
            let up = |x: f64| scale_by_power_of_two(x, got.exponent);
            let bound = rounding::<R>(how.kernel) * m;
            worst = worse(worst, (got.value - linear(grid.to_world(middle))).abs() / bound);
            let off = DVec3::from_array(got.gradient.to_array().map(up)) - slope;
            worst = worse(worst, off.length() / (bound * inverse));
            // The field of a Gaussian Hessian is a cubic spline's.
            let own = rounding::<R>(how.kernel).max(rounding::<R>(Kernel::Bspline)) * m;
            let off = DVec3::from_array(got.own.to_array().map(up)) - slope;
            worst = worse(worst, off.length() / (own * inverse));
            let h = got.hessian;
            for second in [h.xx, h.xy, h.xz, h.yy, h.yz, h.zz].map(up) {
                worst = worse(worst, second.abs() / (own * inverse * inverse));
            }
        }
    }
    worst
}

/// A field whose iso-surfaces are spheres about `centre`: (R² − ρ²)/2R, with κ₁ = κ₂ = 1/ρ.
pub(crate) fn spheres(centre: DVec3, radius: f64) -> impl Fn(DVec3) -> f64 {
    move |p| (radius * radius - (p - centre).length_squared()) / (2.0 * radius)
}

/// The largest error of the normal and of the curvatures of [`spheres`] in units of their bounds, by the prefiltered
/// splines, which have quadratics exactly. A gradient that is off by δ turns n by δ/‖g‖; κ = tᵀHt/‖g‖ is off by R·δ_H + δ/‖g‖
/// of itself.
pub(crate) fn sphere_errors(volume: &Volume, centre: DVec3, radius: f64, places: &[DVec3]) -> f64 {
    let grid = volume.grid();
    let (m, inverse) = (volume.largest_magnitude(), 1.0 / grid.smallest_singular_value());
    let mut worst = 0.0;
    for kernel in [Kernel::Bspline, Kernel::Bspline5] {
        let how = Reconstruction {
            kernel,
            gradient: GradientEstimator::Analytic,
            hessian: HessianEstimator::Analytic,
            ..Reconstruction::default()
        };
        let field = Field::<f64>::new(volume, how, Rung::Hessian).unwrap();
        for &p in places {
            let from = grid.to_world(p) - centre;
            let (rho, steepness) = (from.length(), from.length() / radius);
            let got = ask(&field, Vec3::from_glam(p));
            let turned = (got.gradient.normalize() + from / rho).length();
            let gradient = rounding::<f64>(kernel) * m * inverse / steepness;
            worst = worse(worst, turned / gradient);
            let c = curvature::principal(Vec3::from_glam(got.own), got.hessian, Outside::Low);
            let bound = gradient + radius * rounding::<f64>(kernel) * m * inverse * inverse;
            worst = worse(worst, (c.k1 * rho - 1.0).abs().max((c.k2 * rho - 1.0).abs()) / bound);
        }
    }
    worst
}
