//! Every estimator reproduces what it should, up to the border ([REC-4]).
//!
//! The polynomials have whole coefficients and the voxels lie at dyadic positions, so the samples are exact and all
//! error is the estimator's own rounding. The bound is c ε M for values, c ε M ‖D⁻¹‖ for gradients and c ε M ‖D⁻¹‖² for
//! Hessians, M the largest sample: ‖D⁻¹‖ = cond(D)/‖D‖. A sum of n terms in a fixed order is off by at most n ε/2 times the
//! sum of magnitudes; stencils have up to 4 terms an axis whose magnitudes add up to at most 4 (a one-sided difference),
//! which gives c = 3 · 4 · 4. Prefiltering multiplies what its solution is off by 3 an axis (cubic) or 7.5 (quintic), by
//! 27 and by 422 in space.

use super::*;

/// c of the bound, by what the estimate is made from.
fn factor(kernel: Kernel) -> f64 {
    match kernel {
        Kernel::Bspline => 48.0 * 27.0,
        Kernel::Bspline5 => 48.0 * 422.0,
        _ => 48.0,
    }
}

fn linear(p: DVec3) -> f64 {
    5.0 + 3.0 * p.x - 2.0 * p.y + 7.0 * p.z
}

const SLOPE: DVec3 = DVec3::new(3.0, -2.0, 7.0);

fn quadratic(p: DVec3) -> f64 {
    1.0 - p.x + 2.0 * p.z + 3.0 * p.x * p.x - 2.0 * p.x * p.y + p.x * p.z + 2.0 * p.y * p.y + 4.0 * p.y * p.z
        - p.z * p.z
}

/// The second derivatives of [`quadratic`]: xx, xy, xz, yy, yz, zz.
const SECOND: [f64; 6] = [6.0, -2.0, 1.0, 4.0, 4.0, -2.0];

fn quadratic_gradient(p: DVec3) -> DVec3 {
    DVec3::new(
        -1.0 + 6.0 * p.x - 2.0 * p.y + p.z,
        -2.0 * p.x + 4.0 * p.y + 4.0 * p.z,
        2.0 + p.x + 4.0 * p.y - 2.0 * p.z,
    )
}

/// Value and derivatives of a field at a position, with the factor 2^−e undone.
fn ask(field: &Field<'_, f64>, p: DVec3) -> (f64, DVec3, DVec3, [f64; 6]) {
    let up = 2f64.powi(field.scale_exponent());
    let p = Vec3::from_glam(p);
    with_sampler!(field, |s| {
        let (g, h) = s.hessian(p);
        (s.value(p), s.gradient(p).to_glam() * up, g.to_glam() * up, entries(h).map(|x| x * up))
    })
}

fn largest(volume: &Volume) -> f64 {
    volume.largest_magnitude()
}

#[test]
fn values_and_gradients_of_linear_fields_by_all() {
    for axes in frames() {
        for dims in [[7, 6, 5], [2, 3, 4], [3, 2, 3]] {
            let volume = sampled(dims, axes, linear);
            let (m, inverse) = (largest(&volume), inverse_norm(volume.grid()));
            for how in all() {
                let field = Field::<f64>::new(&volume, how, Rung::Hessian).unwrap();
                for p in positions(volume.grid(), 60) {
                    let (value, gradient, own, _) = ask(&field, p);
                    let bound = factor(how.kernel) * f64::EPSILON * m;
                    let want = linear(volume.grid().to_world(p));
                    assert!((value - want).abs() <= bound, "{how:?} at {p}: {value}, not {want}");
                    // Regression solves a system of condition up to cond(D)²; the fit is exact for linear fields.
                    let bound = bound * inverse;
                    assert!((gradient - SLOPE).length() <= bound, "{how:?} at {p}: {gradient}");
                    let bound = factor(Kernel::Bspline).max(factor(how.kernel)) * f64::EPSILON * m * inverse;
                    assert!((own - SLOPE).length() <= bound, "{how:?} at {p}: {own}");
                }
            }
        }
    }
}

#[test]
fn hessians_of_quadratics_by_all() {
    for axes in frames() {
        for dims in [[7, 6, 5], [3, 4, 5]] {
            let volume = sampled(dims, axes, quadratic);
            let (m, inverse) = (largest(&volume), inverse_norm(volume.grid()));
            for how in all() {
                let field = Field::<f64>::new(&volume, how, Rung::Hessian).unwrap();
                for p in positions(volume.grid(), 60) {
                    let (.., hessian) = ask(&field, p);
                    let kernel = if how.hessian == HessianEstimator::Gaussian { Kernel::Bspline } else { how.kernel };
                    let bound = factor(kernel) * f64::EPSILON * m * inverse * inverse;
                    for (got, want) in hessian.into_iter().zip(SECOND) {
                        assert!((got - want).abs() <= bound, "{how:?} at {p}: {hessian:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn values_of_quadratics_by_catmull_rom_and_the_prefiltered() {
    for axes in frames() {
        for dims in [[7, 6, 5], [3, 4, 5]] {
            let volume = sampled(dims, axes, quadratic);
            let (m, inverse) = (largest(&volume), inverse_norm(volume.grid()));
            for kernel in [Kernel::CatmullRom, Kernel::Bspline, Kernel::Bspline5] {
                let how = Reconstruction { kernel, gradient: GradientEstimator::Analytic, ..Default::default() };
                let field = Field::<f64>::new(&volume, how, Rung::Hessian).unwrap();
                for p in positions(volume.grid(), 60) {
                    let (value, gradient, ..) = ask(&field, p);
                    let world = volume.grid().to_world(p);
                    let bound = factor(kernel) * f64::EPSILON * m;
                    assert!((value - quadratic(world)).abs() <= bound, "{kernel:?} at {p}: {value}");
                    let off = (gradient - quadratic_gradient(world)).length();
                    assert!(off <= bound * inverse, "{kernel:?} at {p}: {gradient}");
                }
            }
        }
    }
}

/// The smoothing B-spline adds half the second difference times its variance, ⅓ a voxel and axis: x² + ⅓.
#[test]
fn the_smoothing_spline_adds_a_third() {
    let volume = sampled([9, 4, 4], DMat3::IDENTITY, |p| p.x * p.x);
    let how = Reconstruction { kernel: Kernel::BsplineSmooth, ..Default::default() };
    let field = Field::<f64>::new(&volume, how, Rung::Value).unwrap();
    for p in positions(volume.grid(), 60) {
        let x = volume.grid().to_world(p).x;
        let value = with_sampler!(field, |s| s.value(Vec3::from_glam(p)));
        assert!((value - x * x - 1.0 / 3.0).abs() <= 48.0 * f64::EPSILON * 49.0, "{p}: {value}");
    }
}

/// Central, Sobel and regression gradients are linear in the position between voxels of a quadratic, and right at
/// every voxel, border included, for the central ones.
#[test]
fn central_gradients_of_quadratics_at_voxels() {
    for axes in frames() {
        let dims = [5, 4, 3];
        let volume = sampled(dims, axes, quadratic);
        let field = Field::<f64>::new(&volume, Reconstruction::default(), Rung::Hessian).unwrap();
        for p in indices(dims) {
            let (_, gradient, ..) = ask(&field, p);
            let off = (gradient - quadratic_gradient(volume.grid().to_world(p))).length();
            assert!(off <= 48.0 * f64::EPSILON * largest(&volume) * inverse_norm(volume.grid()), "{p}: {gradient}");
        }
    }
}

/// An axis of length 1 is a field constant along it: its coordinate is ignored and its derivatives are exactly 0
/// ([SPACE-1]); those along the others are the slice's.
#[test]
fn axes_of_length_one_are_constant() {
    let axes = DMat3::from_diagonal(DVec3::new(1.0, 3.0, 0.5));
    for flat in 0..3 {
        let mut dims = [6, 6, 6];
        dims[flat] = 1;
        let volume = sampled(dims, axes, linear);
        for how in all() {
            let field = Field::<f64>::new(&volume, how, Rung::Hessian).unwrap();
            for p in positions(volume.grid(), 40) {
                let (value, gradient, own, hessian) = ask(&field, p);
                let mut middle = p;
                middle[flat] = 0.0;
                assert_eq!((value, gradient, own, hessian), ask(&field, middle), "{how:?} at {p}");
                assert_eq!((gradient[flat], own[flat]), (0.0, 0.0), "{how:?}");
                let rows = [[0, 1, 2], [1, 3, 4], [2, 4, 5]];
                assert!(rows[flat].iter().all(|&i| hessian[i] == 0.0), "{how:?}: {hessian:?}");
                let bound = factor(how.kernel) * f64::EPSILON * largest(&volume) * inverse_norm(volume.grid());
                let mut want = SLOPE;
                want[flat] = 0.0;
                assert!((gradient - want).length() <= bound, "{how:?}: {gradient}");
            }
        }
    }
}
