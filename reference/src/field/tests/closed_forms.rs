//! Curvatures against closed forms: sphere, cylinder, torus, triaxial ellipsoid and saddle ([CUR-1]), with the orders
//! that they must have.

use super::*;
use crate::field::{FieldError, probe};
use drypoint_scene::glam::DVec2;

/// A block of 28³ voxels around a point, sampled from a function of world space. Its border is 13 voxels away, where
/// the influence of a prefilter's end has fallen by 0.27¹³ (cubic) or 0.43¹³ (quintic), below 2·10⁻⁵ of what is off there.
fn around(p: DVec3, axes: DMat3, f: impl Fn(DVec3) -> f64) -> Volume {
    let dims = [28; 3];
    let grid = Grid::new(dims, axes, p - axes * DVec3::splat(13.5)).unwrap();
    let voxels = indices(dims).map(|i| f(grid.to_world(i))).collect();
    Volume::new(grid, Voxels::F64(voxels), 1.0, 0.0).unwrap()
}

fn probed(volume: &Volume, how: Reconstruction, p: DVec3) -> probe::Probe {
    let field = Field::<f64>::new(volume, how, Rung::Hessian).unwrap();
    probe::at_world(&field, p, None).unwrap()
}

fn analytic(kernel: Kernel) -> Reconstruction {
    Reconstruction {
        kernel,
        gradient: GradientEstimator::Analytic,
        hessian: HessianEstimator::Analytic,
        ..Default::default()
    }
}

/// Directions over the sphere and offsets in a cell, so that neither axes nor voxels are favoured.
fn directions() -> impl Iterator<Item = DVec3> {
    (0..24).map(|i| {
        let z = 1.0 - (2 * i + 1) as f64 / 24.0;
        let angle = 2.399963229728653 * i as f64;
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * angle.cos(), r * angle.sin(), z)
    })
}

/// The root mean square of |κr − 1| over both curvatures and all directions, on f(‖p‖) at ‖p‖ = r.
fn error_on_sphere(r: f64, how: Reconstruction, f: impl Fn(f64) -> f64) -> f64 {
    let mut sum = 0.0;
    for (i, u) in directions().enumerate() {
        let p = u * r;
        // The block's voxels lie off the point by parts of a voxel that differ from block to block.
        let shift = DVec3::new(i as f64 * 0.618, i as f64 * 0.414, i as f64 * 0.732).fract() - 0.5;
        let volume = around(p + shift, DMat3::IDENTITY, |q| f(q.length()));
        let c = probed(&volume, how, p);
        sum += (c.k1 * r - 1.0).powi(2) + (c.k2 * r - 1.0).powi(2);
    }
    (sum / 48.0).sqrt()
}

/// The slope of a line fitted to (ln r, −ln error).
fn order(radii: &[f64], errors: &[f64]) -> f64 {
    let points: Vec<_> = radii.iter().zip(errors).map(|(r, e)| (r.ln(), -e.ln())).collect();
    let n = points.len() as f64;
    let (mx, my) = (points.iter().map(|p| p.0).sum::<f64>() / n, points.iter().map(|p| p.1).sum::<f64>() / n);
    let (xy, xx) = points.iter().fold((0.0, 0.0), |s, p| (s.0 + (p.0 - mx) * (p.1 - my), s.1 + (p.0 - mx).powi(2)));
    xy / xx
}

const RADII: [f64; 4] = [8.0, 16.0, 32.0, 64.0];

/// The third and fourth derivatives of the distance field fall as 1/r² and 1/r³, while H falls as 1/r. The cubic
/// spline's second derivative, of order 2, is therefore off by O(1/r²) of itself.
#[test]
fn cubic_spline_on_the_distance_field_has_order_two() {
    let errors = RADII.map(|r| error_on_sphere(r, analytic(Kernel::Bspline), |d| r - d));
    let order = order(&RADII, &errors);
    assert!((order - 2.0).abs() <= 0.2, "order {order}, errors {errors:?}");
}

/// An edge of fixed shape, 1/(1 + e^((‖p‖ − r)/w)), refined as a whole, w = r/8. At r = 8 the edge is one voxel wide,
/// too steep for an order yet, and is left out.
#[test]
fn cubic_spline_on_a_logistic_edge_has_order_two() {
    let errors =
        RADII.map(|r| error_on_sphere(r, analytic(Kernel::Bspline), |d| 1.0 / (1.0 + ((d - r) / (r / 8.0)).exp())));
    let order = order(&RADII[1..], &errors[1..]);
    assert!((order - 2.0).abs() <= 0.2, "order {order}, errors {errors:?}");
}

/// The quintic spline's second derivative has order 4. At r = 64 its error has met what the blocks' borders leave, 10⁻⁷,
/// and is left out.
#[test]
fn quintic_spline_on_a_logistic_edge_has_order_four() {
    let errors =
        RADII.map(|r| error_on_sphere(r, analytic(Kernel::Bspline5), |d| 1.0 / (1.0 + ((d - r) / (r / 4.0)).exp())));
    let order = order(&RADII[..3], &errors[..3]);
    assert!((order - 4.0).abs() <= 0.4, "order {order}, errors {errors:?}");
}

/// Central differences of the distance field at the voxels: within 1.2 h²/r² at every one.
#[test]
fn central_differences_of_the_distance_field() {
    let how = Reconstruction { hessian: HessianEstimator::Central, ..Default::default() };
    for r in RADII {
        for u in directions() {
            let p = u * r;
            let volume = around(p, DMat3::IDENTITY, |q| r - q.length());
            let field = Field::<f64>::new(&volume, how, Rung::Hessian).unwrap();
            for i in [DVec3::splat(13.0), DVec3::new(14.0, 13.0, 13.0), DVec3::splat(14.0)] {
                let c = probe::at_index(&field, i, None).unwrap();
                let d = volume.grid().to_world(i).length();
                for k in [c.k1, c.k2] {
                    assert!((k * d - 1.0).abs() <= 1.2 / (d * d), "r = {d}: κ r = {}", k * d);
                }
            }
        }
    }
}

/// A quadric f = qᵀ(p∘p)/2 + l·p with its curvatures at a point, on the surface through it.
struct Quadric {
    name: &'static str,
    q: DVec3,
    l: DVec3,
    p: DVec3,
    /// Mean and Gaussian curvature of the surface, positive where it bends away from the outside.
    mean: f64,
    gaussian: f64,
}

/// Ellipsoids bright inside: x²/a² + y²/b² + z²/c² = s², s the size of the one through p. With h² = x²/a⁴ + y²/b⁴ +
/// z²/c⁴ over s², K = 1/(s² a²b²c² h⁴) and H = (s²(a² + b² + c²) − ‖p‖²)/(2 s⁴ a²b²c² h³).
fn ellipsoid(name: &'static str, axes: DVec3, p: DVec3) -> Quadric {
    let square = axes * axes;
    let s2 = (p * p / square).element_sum();
    // The ellipsoid's own semi-axes.
    let own = square * s2;
    let h = (p * p / (own * own)).element_sum().sqrt();
    let product = own.x * own.y * own.z;
    let mean = (own.element_sum() - p.length_squared()) / (2.0 * product * h.powi(3));
    Quadric { name, q: -1.0 / square, l: DVec3::ZERO, p, mean, gaussian: 1.0 / (product * h.powi(4)) }
}

fn quadrics() -> Vec<Quadric> {
    let p = DVec3::new(3.0, -2.0, 1.5);
    let around_z = 1.0 / DVec2::new(p.x, p.y).length();
    // z = (x² − y²)/(2c) seen from above, as a graph with slopes x/c, −y/c.
    let c = 4.0;
    let (a, b) = (p.x / c, -p.y / c);
    let w = 1.0 + a * a + b * b;
    let saddle_mean = -((1.0 + b * b) - (1.0 + a * a)) / (2.0 * c * w.powf(1.5));
    vec![
        ellipsoid("sphere", DVec3::splat(2.0), p),
        ellipsoid("triaxial ellipsoid", DVec3::new(4.0, 2.0, 1.0), p),
        Quadric {
            name: "cylinder",
            q: DVec3::new(-1.0, -1.0, 0.0),
            l: DVec3::ZERO,
            p,
            mean: around_z / 2.0,
            gaussian: 0.0,
        },
        Quadric {
            name: "saddle",
            q: DVec3::new(1.0 / c, -1.0 / c, 0.0),
            l: DVec3::NEG_Z,
            p: DVec3::new(p.x, p.y, (p.x * p.x - p.y * p.y) / (2.0 * c)),
            mean: saddle_mean,
            gaussian: -1.0 / (c * c * w * w),
        },
    ]
}

/// Every estimator reproduces gradient and Hessian of a quadratic, so on quadrics all curvatures are the closed form up
/// to rounding, on every grid: G = −PHP/‖g‖ is off by the bound of `reproduction` for H and for g, over ‖g‖.
#[test]
fn curvatures_of_quadrics_by_every_estimator_on_every_grid() {
    for surface in quadrics() {
        let f = |p: DVec3| 0.5 * (surface.q * p * p).element_sum() + surface.l.dot(p);
        let g = (surface.q * surface.p + surface.l).length();
        let h = surface.q.abs().max_element();
        for axes in frames() {
            let volume = around(surface.p, axes, f);
            let inverse = inverse_norm(volume.grid());
            for how in all().filter(|how| how.gradient == GradientEstimator::Central) {
                let field = Field::<f64>::new(&volume, how, Rung::Hessian).unwrap();
                let c = probe::at_world(&field, surface.p, None).unwrap();
                // 48: terms of a stencil; 422: a quintic prefilter; samples have a few ε of their own here.
                let off = 48.0 * 422.0 * f64::EPSILON * volume.largest_magnitude() * inverse;
                let bound = off * (inverse + 2.0 * h / g) / g;
                let (mean, k) = (c.mean - surface.mean, c.gaussian - surface.gaussian);
                assert!(mean.abs() <= bound, "{}, {how:?}: mean {} not {}", surface.name, c.mean, surface.mean);
                let largest = c.k1.abs().max(c.k2.abs());
                assert!(
                    k.abs() <= bound * 2.0 * largest,
                    "{}, {how:?}: {} not {}",
                    surface.name,
                    c.gaussian,
                    surface.gaussian
                );
                assert!(c.k1 >= c.k2);
                let outward = -(surface.q * surface.p + surface.l) / g;
                // `gradient` is central here: exact on quadratics too, inside a cell.
                assert!((c.normal.unwrap() - outward).length() <= 2.0 * off / g, "{}, {how:?}", surface.name);
            }
        }
    }
}

/// A torus bright inside, f = (a² − d²)/(2a), d the distance to its ring: κ₁ = 1/a around the tube; κ₂ =
/// cosθ/(R + a cosθ) around the axis, positive on the outer side, negative on the inner one; directions along and across
/// the tube.
///
/// The cubic spline's second derivative is off by at most h² f''''/12, here of the order h²/(R − a)² of f'' and less; the
/// quintic's order is 4. Constants below 1 are left as margin for grids that lie askew.
#[test]
fn both_curvatures_of_a_torus_on_every_grid() {
    let (ring, a) = (40.0, 16.0);
    let f = |p: DVec3| (a * a - (DVec2::new(p.x, p.y).length() - ring).powi(2) - p.z * p.z) / (2.0 * a);
    for axes in frames() {
        let h = Grid::new([2; 3], axes, DVec3::ZERO).unwrap().spacing().into_iter().fold(0.0, f64::max);
        for theta in [0.0, 0.7, 1.6, 2.3, std::f64::consts::PI, -2.0] {
            let (sin, cos) = f64::sin_cos(theta);
            let phi = 0.6f64;
            let out = DVec3::new(phi.cos(), phi.sin(), 0.0);
            let p = out * (ring + a * cos) + DVec3::Z * (a * sin);
            let volume = around(p + axes * DVec3::new(0.3, -0.2, 0.1), axes, f);
            let (tube, axis) = (1.0 / a, cos / (ring + a * cos));
            for (kernel, relative) in [(Kernel::Bspline, (h / 24.0).powi(2)), (Kernel::Bspline5, (h / 24.0).powi(4))] {
                let c = probed(&volume, analytic(kernel), p);
                let bound = relative * tube;
                assert!((c.k1 - tube).abs() <= bound && (c.k2 - axis).abs() <= bound, "{kernel:?}, {theta}: {c:?}");
                // The tangent along the ring; the two curvatures differ by 1/a − cosθ/(R + a cosθ).
                let along = DVec3::new(-phi.sin(), phi.cos(), 0.0);
                let apart = c.e2.unwrap().cross(along).length();
                assert!(apart <= 2.0 * bound / (tube - axis), "{kernel:?}, {theta}: e₂ off by {apart}");
                let normal = out * cos + DVec3::Z * sin;
                assert!((c.normal.unwrap() - normal).length() <= relative, "{kernel:?}, {theta}");
            }
        }
    }
}

/// `kv` is tᵀGt of the view, gradient and Hessian are in world units, and `outside` turns the signs.
#[test]
fn probes_are_in_world_units() {
    // f = 1000 − ‖p‖²/2 in a world of 0.25 units a voxel: g = −p, H = −I whatever the voxel.
    let axes = DMat3::from_diagonal(DVec3::splat(0.25));
    let p = DVec3::new(2.0, 1.0, -2.0);
    let volume = around(p, axes, |q| 1000.0 - 0.5 * q.length_squared());
    let field = Field::<f64>::new(&volume, analytic(Kernel::Bspline), Rung::Hessian).unwrap();
    let c = probe::at_world(&field, p, Some(DVec3::new(0.0, 5.0, 0.0))).unwrap();
    // As in `reproduction`: 48 · 27 ε M ‖D⁻¹‖², M = 1000, ‖D⁻¹‖ = 4.
    let bound = 48.0 * 27.0 * f64::EPSILON * 1000.0 * 16.0;
    assert!((c.value - 995.5).abs() <= bound && (c.gradient + p).length() <= bound);
    assert!((c.hessian + DMat3::IDENTITY).to_cols_array().iter().all(|x| x.abs() <= bound), "{c:?}");
    let third = 1.0 / 3.0;
    assert!([c.k1, c.k2, c.mean, c.kv.unwrap()].iter().all(|k| (k - third).abs() <= bound), "{c:?}");
    assert!((c.normal.unwrap() - p / 3.0).length() <= bound);
    let at_voxel = probe::at_index(&field, volume.grid().to_index(p), Some(DVec3::Y)).unwrap();
    assert_eq!(at_voxel, c);

    let dark = Reconstruction { outside: Outside::High, ..analytic(Kernel::Bspline) };
    let c = probed(&volume, dark, p);
    assert!((c.k1 + third).abs() <= bound && (c.normal.unwrap() + p / 3.0).length() <= bound && c.kv.is_none());

    assert_eq!(probe::at_index(&field, DVec3::new(-1e-9, 1.0, 1.0), None), None);
    assert_eq!(probe::at_index(&field, DVec3::splat(f64::NAN), None), None);
    let flat = Volume::new(volume.grid().clone(), Voxels::F64(vec![7.0; 28 * 28 * 28]), 1.0, 0.0).unwrap();
    let c = probed(&flat, Reconstruction::default(), p);
    assert_eq!((c.value, c.normal, c.e1, c.e2), (7.0, None, None, None));
    assert_eq!((c.k1, c.k2, c.mean, c.gaussian), (0.0, 0.0, 0.0, 0.0));
}

/// The resolution of `auto`, and the error for a kernel without a Hessian, which names a kernel that has one ([REC-3]).
#[test]
fn the_automatic_hessian() {
    use drypoint_scene::volume::VoxelType;
    let grid = Grid::with_spacing([4; 3], [1.0, 1.0, 0.5]).unwrap();
    let of = |t| Volume::new(grid.clone(), Voxels::from_f64(&[1.0; 64], t), 1.5, 0.0).unwrap();
    let (whole, real) = (of(VoxelType::U16), of(VoxelType::F32));
    for kernel in KERNELS {
        let how = Reconstruction { kernel, ..Default::default() };
        let estimator = |v| Field::<f64>::new(v, how, Rung::Value).unwrap().hessian_estimator();
        assert_eq!(estimator(&whole), HessianEstimator::Gaussian);
        let rough = matches!(kernel, Kernel::Trilinear | Kernel::CatmullRom);
        assert_eq!(estimator(&real), if rough { HessianEstimator::Central } else { HessianEstimator::Analytic });
        let named = Reconstruction { hessian: HessianEstimator::Analytic, ..how };
        match Field::<f64>::new(&real, named, Rung::Value) {
            Ok(_) => assert!(!rough),
            Err(e) => assert!(rough && e.to_string().contains("\"bspline\""), "{e}"),
        }
    }
    for scale in [-1.0, f64::NAN, f64::INFINITY, 501.0] {
        let how = Reconstruction { hessian: HessianEstimator::Gaussian, scale, ..Default::default() };
        let error = Field::<f64>::new(&real, how, Rung::Value).unwrap_err();
        assert!(matches!(error, FieldError::Scale { longest: 500.0, .. }), "{error}");
    }
}

/// Numbers beyond f32 are refused there, and are no trouble in f64.
#[test]
fn values_that_the_number_does_not_hold() {
    let grid = Grid::with_spacing([2, 1, 1], [1.0; 3]).unwrap();
    let volume = Volume::new(grid, Voxels::F64(vec![0.0, 1e300]), 1.0, 0.0).unwrap();
    let how = Reconstruction::default();
    assert_eq!(Field::<f32>::new(&volume, how, Rung::Value).unwrap_err(), FieldError::TooLarge { largest: 1e300 });
    let field = Field::<f64>::new(&volume, how, Rung::Value).unwrap();
    assert_eq!(with_sampler!(field, |s| s.value(Vec3::new(0.5, 0.0, 0.0))), 5e299);
}

/// Data that no rung asks for are not allocated ([PLAN-1]).
#[test]
fn only_what_is_asked_for_is_allocated() {
    let grid = Grid::with_spacing([6; 3], [1.0; 3]).unwrap();
    let volume = Volume::new(grid, Voxels::U8(vec![3; 216]), 1.0, 0.0).unwrap();
    let bytes = |kernel, gradient, rung| {
        let how = Reconstruction { kernel, gradient, ..Default::default() };
        Field::<f64>::new(&volume, how, rung).unwrap().bytes()
    };
    let (central, trilinear) = (GradientEstimator::Central, Kernel::Trilinear);
    assert!(bytes(trilinear, central, Rung::Gradient).is_empty());
    assert_eq!(bytes(trilinear, central, Rung::Hessian)["smoothed"], 8 * 8 * 8 * 8);
    assert_eq!(bytes(Kernel::Bspline, central, Rung::Value)["coefficients"], 8 * 8 * 8 * 8);
    assert_eq!(bytes(Kernel::Bspline5, central, Rung::Value)["coefficients"], 10 * 10 * 10 * 8);
    // 27 cases of 27 weights for three derivatives.
    assert_eq!(bytes(trilinear, GradientEstimator::Regression, Rung::Gradient)["regression"], 27 * 27 * 4 * 8);
}
