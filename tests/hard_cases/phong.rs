//! Blinn–Phong on a ball whose normals are known ([STF-11]).

use crate::common::{Stage, ball, orthographic, perspective, plain, quadratic_ball, volume};
use drypoint::scene::glam::DVec3;
use drypoint::scene::tables::{GradientEstimator, Kernel, Length, LightDirection, Outside, Shading};

const RADIUS: f64 = 8.0;
const COLOR: [f64; 3] = [0.8, 0.5, 0.2];

fn shaded(shading: Shading) -> Stage {
    Stage::regular(quadratic_ball(24, RADIUS), &[(0.0, COLOR, 0.0), (0.0, COLOR, 1.0)]).with(|s| {
        s.sampling.kernel = Kernel::Bspline5;
        s.sampling.gradient = GradientEstimator::Analytic;
        // Samples so near the surface that the pixel's own ray says where on the ball they are.
        s.sampling.step = Length::World(0.005);
        s.shading = Some(shading);
    })
}

/// c_u(k_a + k_d max(0, N·L)) + k_s max(0, N·Ĥ)^s, the specular term 0 where N·L ≤ 0.
fn blinn(m: &Shading, n: DVec3, l: DVec3, v: DVec3) -> [f64; 3] {
    let n_l = n.dot(l);
    let half = (l + v).try_normalize().map_or(0.0, |h| n.dot(h).max(0.0));
    let specular = if n_l > 0.0 { m.specular * half.powf(m.shininess) } else { 0.0 };
    COLOR.map(|c| c * (m.ambient + m.diffuse * n_l.max(0.0)) + specular)
}

/// Every pixel whose ray meets the ball off its rim, in orthographic and perspective pictures, with the light on the
/// head, in eye space, in world space and behind.
#[test]
fn a_lit_ball_in_closed_form() {
    let lights = [
        LightDirection::Head,
        LightDirection::Eye(DVec3::new(-2.0, 3.0, 1.5)),
        LightDirection::World(DVec3::new(0.5, -0.6, 0.9)),
        LightDirection::Eye(DVec3::new(0.2, -0.3, -1.0)),
    ];
    let direction = DVec3::new(0.3, 0.9, -0.2);
    for light in lights {
        for shininess in [1.0, 12.5] {
            let material = Shading {
                ambient: 0.2,
                diffuse: 0.7,
                specular: 0.4,
                shininess,
                light: Some(light),
                ..Shading::default()
            };
            for camera in [orthographic(Some(18.0)), perspective(80.0)] {
                let shot = shaded(material.clone()).with(|s| {
                    s.camera = camera;
                    s.camera.direction = direction;
                });
                let view = shot.view();
                let l = match light {
                    LightDirection::Head => DVec3::Z,
                    LightDirection::Eye(d) => d.normalize(),
                    LightDirection::World(d) => view.direction_to_eye(d.normalize()),
                };
                let centre = view.to_eye(shot.volume.grid().centre());
                let mut seen = 0;
                for (t, pixel) in shot.render().pixels().into_iter().enumerate() {
                    let ray = view.ray((t % 16) as f64 + 0.5, (t / 16) as f64 + 0.5);
                    let origin = view.to_eye(ray.origin);
                    let d = -ray.v;
                    let (b, c) = ((origin - centre).dot(d), (origin - centre).length_squared() - RADIUS * RADIUS);
                    let root = b * b - c;
                    if root < 0.0 {
                        assert_eq!(pixel[3], 0.0);
                        continue;
                    }
                    let n = (origin + d * (-b - root.sqrt()) - centre) / RADIUS;
                    // Up to Δ/cosφ past the surface the normal has turned by 0.009/8; the steepest term is the
                    // highlight's, k_s·s. Near a rim or the border of light a step decides.
                    if n.dot(ray.v) < 0.1 || n.dot(l).abs() < 0.01 {
                        continue;
                    }
                    assert_eq!(pixel[3], 1.0);
                    for (p, e) in pixel.iter().zip(blinn(&material, n, l, ray.v)) {
                        assert!((p - e).abs() < 0.0012 * (0.7 + 0.4 * shininess) + 1e-5, "{light:?} {t}: {p} {e}");
                    }
                    seen += 1;
                }
                assert!(seen > 12, "{seen}");
            }
        }
    }
}

/// A sample without a normal keeps its colour unshaded; the scene's light counts where the table has none.
#[test]
fn flat_interiors_are_unshaded() {
    let flat = Stage::regular(volume([6; 3], |_| 1000.3), &[(0.0, COLOR, 1.0)]);
    let lit = flat.with(|s| s.shading = Some(Shading::default())).render();
    assert_eq!(lit.bits(), flat.render().bits());
    assert!(lit.counts.without_normal > 0);
    let ball = shaded(Shading { light: None, ..Shading::default() });
    let side = LightDirection::Eye(DVec3::X);
    let by_scene = ball.with(|s| s.light = side).render().bits();
    let by_table = ball
        .with(|s| s.shading = Some(Shading { light: Some(side), ..Shading::default() }))
        .with(|s| s.light = LightDirection::Head)
        .render()
        .bits();
    assert_eq!(by_scene, by_table);
    assert_ne!(by_scene, ball.render().bits());
}

/// Opacity is not lit: shading changes no α. And a style function is not shaded at all.
#[test]
fn shading_changes_colours_alone() {
    let soft = Stage::regular(ball(16, 6.0), &[(-2.0, COLOR, 0.0), (2.0, COLOR, 0.4)]);
    let alphas = |shot: &Stage| shot.render().pixels().iter().map(|p| p[3].to_bits()).collect::<Vec<_>>();
    let lit = soft.with(|s| s.shading = Some(Shading::default()));
    assert_eq!(alphas(&lit), alphas(&soft));
    assert_ne!(lit.render().bits(), soft.render().bits());
    let styled =
        Stage::styled(ball(16, 6.0), vec![plain("s", [0.2, 0.4, 0.6, 1.0])], &[(-2.0, "s", 0.0), (2.0, "s", 0.4)]);
    assert_eq!(styled.with(|s| s.shading = Some(Shading::default())).render().bits(), styled.render().bits());
}

/// `outside = "high"` turns the light on the inside of a bright shell: N points the other way.
#[test]
fn outside_decides_which_side_is_lit() {
    let low = shaded(Shading::default());
    let high = low.with(|s| s.volume.outside = Outside::High).render().pixels();
    // Facing away from a head light everything is ambient.
    for p in high.iter().filter(|p| p[3] == 1.0) {
        let ambient = COLOR.map(|c| c * 0.3);
        assert!((0..3).all(|c| (p[c] - ambient[c]).abs() < 1e-15), "{p:?}");
    }
}
