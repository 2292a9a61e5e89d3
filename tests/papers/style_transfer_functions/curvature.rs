//! κ_v in pictures ([STF-5], [STF-6], [CUR-2]): what the layer `curvature.KV` shows against closed forms.

use super::{planes, smooth};
use crate::common::{Stage, ball, orthographic, plain, quadratic_ball, volume};
use drypoint::scene::glam::DVec3;
use drypoint::scene::picture::LayerKind::{CurvatureAlongView, First, Normal, Z};
use drypoint::scene::tables::{Contours, Kappa, Length, NormalSide, SignFlip};
use drypoint::scene::volume::Volume;
use std::f64::consts::PI;

/// Opaque from value 0 on, with κ of that kind in a layer.
fn opaque(volume: Volume, kappa: Kappa) -> Stage {
    let grey = plain("grey", [0.5, 0.5, 0.5, 1.0]);
    Stage::styled(volume, vec![grey], &[(0.0, "grey", 0.0), (0.0, "grey", 1.0)])
        .layers(&[CurvatureAlongView, Normal, First, Z])
        .with(|s| s.contours = Some(Contours { kappa, ..Contours::default() }))
}

/// The radius of a quadratic ball's iso-surface.
fn at_value(radius: f64, value: f64) -> f64 {
    (radius * radius - 2.0 * radius * value).sqrt()
}

/// What the layers say of a pixel.
#[derive(Clone, Copy, Debug)]
struct Seen {
    kappa: f64,
    normal: [f64; 3],
    value: f64,
    depth: f64,
}

/// The covered pixels.
fn covered(shot: &Stage) -> Vec<Seen> {
    let shown = shot.render();
    let (kappa, normal) = (shown.one(CurvatureAlongView), shown.layer::<3>(Normal));
    let (value, depth) = (shown.one(First), shown.one(Z));
    let seen = |i: usize| Seen { kappa: kappa[i], normal: normal[i], value: value[i], depth: depth[i] };
    let pixels = shown.pixels();
    (0..pixels.len()).filter(|&i| pixels[i][3] > 0.0).map(seen).collect()
}

/// At radius r and angle θ to the view the normal of a ball turns by atan2(Δ sinθ, r + Δ cosθ) on the way from the plane
/// before; exact κ is 1/r. The field is a quadratic, which the spline has to rounding.
#[test]
fn curvature_of_a_ball_in_closed_form() {
    let radius = 9.0;
    let view = |kappa, delta| {
        let shot = planes(&smooth(&opaque(quadratic_ball(28, radius), kappa)), delta).seen_along([0.4, 0.7, -0.3]);
        covered(&shot.with(|s| s.camera.projection = orthographic(Some(20.0)).projection))
    };
    for delta in [1.0, 0.5, 0.25] {
        let pixels = view(Kappa::Ray, delta);
        assert!(pixels.len() > 100);
        for Seen { kappa: k, normal: [nx, ny, nz], value, .. } in pixels {
            let (r, sin) = (at_value(radius, value), nx.hypot(ny));
            let turn = (delta * sin).atan2(r + delta * nz) / delta;
            assert!((k - turn).abs() < 1e-12 / delta, "{k} {turn}");
        }
        for Seen { kappa: k, value, .. } in view(Kappa::Exact, delta) {
            assert!((k * at_value(radius, value) - 1.0).abs() < 1e-12, "{k} at {value}");
        }
    }
}

/// A cylinder whose axis is at ψ to the view plane: at its silhouette the turn along the ray is |cosψ|/r and exact κ
/// cos²ψ/r, so ray : exact = 1 : |cosψ|. Anywhere else, with θ from the normal to the view across the axis,
/// atan2(Δ cosψ sinθ, r + Δ cosψ cosθ)/Δ and cos²ψ sin²θ/(cos²ψ sin²θ + sin²ψ)/r.
#[test]
fn curvature_of_tilted_cylinders_in_closed_form() {
    let (radius, delta) = (7.0, 0.5);
    let centre = DVec3::splat(16.0);
    for psi in [0.0f64, 0.5, 1.1] {
        let (sin_psi, cos_psi) = psi.sin_cos();
        let axis = DVec3::new(cos_psi, sin_psi, 0.0);
        let distance = |p: DVec3| (p - centre).cross(axis).length_squared();
        let cylinder = || volume([33; 3], |p| (radius * radius - distance(p)) / (2.0 * radius));
        let view = |kappa| {
            let shot = planes(&smooth(&opaque(cylinder(), kappa)), delta);
            covered(&shot.with(|s| {
                s.picture.size = [40, 40];
                s.camera.projection = orthographic(Some(15.0)).projection;
            }))
        };
        let mut steepest = f64::INFINITY;
        for (seen, exact) in view(Kappa::Ray).into_iter().zip(view(Kappa::Exact)) {
            let Seen { kappa: ray, normal: [.., nz], value, depth } = seen;
            let exact = exact.kappa;
            // Where the box cuts the cylinder, 16 before its middle, the predecessor lies outside.
            if depth - delta < -16.0 {
                assert_eq!(ray, 0.0);
                continue;
            }
            let (r, cos) = (at_value(radius, value), nz / cos_psi);
            let sin = (1.0 - cos * cos).max(0.0).sqrt();
            let turn = (delta * cos_psi * sin).atan2(r + delta * cos_psi * cos) / delta;
            // sinθ from cosθ loses half the digits at θ = 0.
            assert!((ray - turn).abs() < 1e-7, "ψ {psi}: {ray} {turn}");
            let (along, across) = ((cos_psi * sin).powi(2), sin_psi * sin_psi);
            // Near n along v the direction t, and with it κ between 1/r and 0, hangs on those digits.
            if along + across > 0.01 {
                let kappa = along / (along + across) / r;
                assert!((exact - kappa).abs() < 1e-10, "ψ {psi}: {exact} {kappa}");
            }
            if nz < steepest {
                steepest = nz;
                // sinθ ≥ 1 − nz², and the turn's error is of first order in Δ cosθ/r.
                let off = 2.0 * nz * nz / (cos_psi * cos_psi) + delta * nz / r + 1e-3;
                if off < 0.2 {
                    assert!((exact / ray - cos_psi).abs() < off, "ψ {psi}: {}", exact / ray);
                }
            }
        }
        assert!(steepest < 0.2, "ψ {psi}: {steepest}");
    }
}

/// Where n is along v the direction is lost: the mean curvature, here 1/r of the ball, and nothing undefined.
#[test]
fn the_middle_of_a_ball_has_its_mean_curvature() {
    let shot = smooth(&opaque(quadratic_ball(21, 6.0), Kappa::Exact)).with(|s| s.picture.size = [1, 1]);
    let [seen] = covered(&shot)[..] else { panic!("one pixel") };
    assert!((seen.normal[2] - 1.0).abs() < 1e-12);
    assert!((seen.kappa * at_value(6.0, seen.value) - 1.0).abs() < 1e-12, "{seen:?}");
}

/// A flat wall turns no normal and has no curvature: the differences of a linear field are exact in whole and half
/// numbers, so κ along the ray is exactly 0, exact κ as far as the weights of second differences sum to 0: to a few ε of
/// the values, which are below 16. Contours change no bit.
#[test]
fn a_flat_wall_has_no_curvature() {
    for direction in [[0.0, 1.0, 0.0], [0.2, 0.9, -0.4]] {
        for kappa in [Kappa::Ray, Kappa::Exact] {
            let wall = volume([12; 3], |p| p.y + 0.5 * p.x - 6.0);
            let shot = opaque(wall, kappa).seen_along(direction);
            let pixels = covered(&shot);
            let rounding = if kappa == Kappa::Ray { 0.0 } else { 4.0 * 16.0 * f64::EPSILON };
            assert!(pixels.len() > 20 && pixels.iter().all(|p| p.kappa.abs() <= rounding), "{kappa:?} {pixels:?}");
            assert_eq!(shot.render().pixels(), shot.with(|s| s.contours = None).render().pixels());
        }
    }
}

/// A sheet thinner than the step: the value rises by 1 a voxel to two equal voxels, of value ½, and falls again. Central
/// differences point opposite ways at the two. Only they are visible, each with α = ½, so the layer's mean is that of
/// the second, which turned by π, in its share ¼ of ¾. A facing normal has not turned, and no contour comes of it.
#[test]
fn a_thin_sheet_turns_the_normal_round() {
    let sheet = || volume([7, 8, 7], |p| 1.0 - (p.y - 3.5).abs());
    let grey = plain("grey", [0.5, 0.5, 0.5, 1.0]);
    let shot = Stage::styled(sheet(), vec![grey], &[(0.4, "grey", 0.0), (0.4, "grey", 0.5)])
        .with_transfer(|t| t.transparency = drypoint::scene::tables::Transparency::Plain)
        .layers(&[CurvatureAlongView])
        .step(1.0)
        .with(|s| {
            s.contours = Some(Contours::default());
            // Planes at the voxels: the centre of the box is at depth 0, planes at half depths.
            s.picture.size = [3, 3];
            s.camera.projection = orthographic(Some(3.0)).projection;
        });
    for (normal, flip, turn) in [
        (NormalSide::Outward, SignFlip::TwoSided, PI),
        (NormalSide::Gradient, SignFlip::TwoSided, PI),
        (NormalSide::Facing, SignFlip::TwoSided, 0.0),
        // Both facing normals are v: the plain angle between them is 0 too.
        (NormalSide::Facing, SignFlip::Literal, 0.0),
    ] {
        let shown = shot
            .with(|s| {
                s.sampling.normal = normal;
                s.contours = Some(Contours { sign_flip: flip, ..Contours::default() });
            })
            .render();
        for k in shown.one(CurvatureAlongView) {
            assert!((k - turn * 0.25 / 0.75).abs() < 1e-15, "{normal:?} {flip:?}: {k}");
        }
    }
}

/// Two planes at ±½Δ of a ball's middle, in a slab that holds no third: on the way from one to the other N·v changes its
/// sign. Facing normals are then nearly opposite, the plain angle is π less the turn; the angle between lines is the turn.
/// The first sample has no predecessor in the box: κ = 0, which takes ⅔ of the mean.
#[test]
fn facing_normals_at_a_silhouette() {
    let (radius, delta) = (8.0, 1.0);
    let centre = DVec3::new(12.0, 1.0, 12.0);
    let slab = || volume([25, 3, 25], |p| radius - (p - centre).length());
    let grey = plain("grey", [0.5, 0.5, 0.5, 1.0]);
    let shot = Stage::styled(slab(), vec![grey], &[(0.0, "grey", 0.5)])
        .with_transfer(|t| t.transparency = drypoint::scene::tables::Transparency::Plain)
        .layers(&[CurvatureAlongView])
        .step(delta)
        .with(|s| {
            s.sampling.normal = NormalSide::Facing;
            // Planes at depths ±½, the slab reaches to ±1.
            s.camera.projection = orthographic(Some(20.0)).projection;
        });
    let shot = smooth(&shot);
    let size = shot.scene.picture.size[0];
    let kappa = |flip| {
        let shot = shot.with(|s| s.contours = Some(Contours { sign_flip: flip, ..Contours::default() }));
        shot.render().one(CurvatureAlongView)
    };
    let (two_sided, literal) = (kappa(SignFlip::TwoSided), kappa(SignFlip::Literal));
    for (i, (two, plain)) in two_sided.into_iter().zip(literal).enumerate() {
        let at = |i: usize| (i as f64 + 0.5 - size as f64 / 2.0) * 20.0 / size as f64;
        let rho = at(i % size).hypot(at(i / size));
        // From (ρ, +½Δ) to (ρ, −½Δ). Along y three voxels hold a parabola, which misses the fourth order: h²/2ρ² of a
        // slope.
        if rho < 3.0 {
            continue;
        }
        let turn = 2.0 * (delta / 2.0).atan2(rho);
        let error = turn / (2.0 * rho * rho);
        assert!((two * 3.0 * delta - turn).abs() < error, "{two} {turn}");
        assert!((plain * 3.0 * delta - (PI - turn)).abs() < error, "{plain} {turn}");
    }
}

/// κ is 0 for a sample whose predecessor lies outside the box, or not beyond `near` ([STF-5]): a ball cut open by the
/// box's face, and one that the eye stands in.
#[test]
fn samples_without_a_predecessor_have_no_curvature() {
    let delta = 1.0;
    let cut = || volume([20, 6, 20], |p| 12.0 - (p - DVec3::new(9.5, 2.5, 9.5)).length());
    let shot = opaque(cut(), Kappa::Ray).with(|s| {
        s.sampling.step = Length::World(delta);
        s.camera.projection = orthographic(Some(8.0)).projection;
    });
    // Every pixel sees the face.
    let pixels = covered(&shot);
    assert_eq!(pixels.len(), 256);
    assert!(pixels.iter().all(|p| p.kappa == 0.0));
    let inside = opaque(ball(20, 9.0), Kappa::Ray).with(|s| {
        s.camera = crate::common::perspective(40.0);
        s.camera.eye = Some(DVec3::new(9.0, 5.0, 9.0));
        s.camera.target = Some(DVec3::new(9.5, 15.0, 9.5));
        s.sampling.step = Length::World(delta);
    });
    let pixels = covered(&inside);
    assert_eq!(pixels.len(), 256);
    assert!(pixels.iter().all(|p| p.kappa == 0.0));
    // One plane farther there is a predecessor: see through the first sample.
    let through = inside.with_transfer(|t| t.nodes.as_mut().unwrap()[1].opacity = 0.5);
    assert!(covered(&through).iter().all(|p| p.kappa > 0.0));
}
