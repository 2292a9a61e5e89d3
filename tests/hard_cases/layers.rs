//! What layers mean ([IO-6]): in closed form on an opaque ball, by hand on a slab of three samples.

use crate::common::{LAYERS, Stage, ball, orthographic, perspective, plain, quadratic_ball, volume};
use drypoint::scene::glam::DVec3;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::tables::{
    Contours, GradientEstimator, HessianEstimator, Kappa, Kernel, Length, NormalSide, RaysPerPixel, StepAlong,
    Transparency,
};

const RADIUS: f64 = 8.0;
const STEP: f64 = 0.3;

/// An opaque ball: a quadratic, which the spline has to rounding.
fn opaque() -> Stage {
    let nodes = [(0.0, "grey", 0.0), (0.0, "grey", 1.0)];
    Stage::styled(quadratic_ball(26, RADIUS), vec![plain("grey", [0.5, 0.5, 0.5, 1.0])], &nodes).layers(&LAYERS).with(
        |s| {
            s.sampling.kernel = Kernel::Bspline5;
            s.sampling.gradient = GradientEstimator::Analytic;
            s.sampling.hessian = HessianEstimator::Analytic;
            s.sampling.step = Length::World(STEP);
            s.sampling.skip_empty = false;
        },
    )
}

/// The sample that a pixel sees is the first at radius ≤ R; from it all layers follow, to rounding. Where a sample lies
/// as near to the surface either may be seen.
#[test]
fn layers_of_an_opaque_ball_in_closed_form() {
    let direction = DVec3::new(0.4, 0.8, -0.3);
    for (camera, along) in [
        (orthographic(Some(20.0)), StepAlong::Plane),
        (perspective(60.0), StepAlong::Plane),
        (perspective(60.0), StepAlong::Ray),
    ] {
        let shot = opaque().with(|s| {
            s.camera = camera;
            s.camera.direction = direction;
            s.sampling.step_along = along;
            s.contours = Some(Contours { kappa: Kappa::Exact, ..Contours::default() });
        });
        let (view, grid) = (shot.view(), shot.volume.grid());
        let centre = view.to_eye(grid.centre());
        let [lo, hi] = grid.index_box();
        let shown = shot.render();
        let [z, first] = [LayerKind::Z, LayerKind::First].map(|kind| shown.one(kind));
        let depth = shown.layer::<3>(LayerKind::Depth);
        let [normal, gradient] = [LayerKind::Normal, LayerKind::Gradient].map(|kind| shown.layer::<3>(kind));
        let curvature = shown.layer::<3>(LayerKind::Curvature);
        let [first_normal, first_curvature] =
            [LayerKind::FirstNormal, LayerKind::FirstCurvature].map(|kind| shown.layer::<3>(kind));
        let counts = shown.one(LayerKind::Counts);
        let mut seen = 0;
        for (t, pixel) in shown.pixels().into_iter().enumerate() {
            let ray = view.ray((t % 16) as f64 + 0.5, (t / 16) as f64 + 0.5);
            let origin = view.to_eye(ray.origin);
            let per_depth = view.direction_to_eye(ray.along);
            let step = if along == StepAlong::Ray { STEP * ray.cos_phi } else { STEP };
            let at = |k: i64| origin + per_depth * ((k as f64 + 0.5) * step);
            let inside = |k: i64| {
                let world = view.eye + view.direction_to_world(at(k));
                let i = grid.to_index(world);
                i.cmpge(lo).all() && i.cmple(hi).all()
            };
            let radius = |k: i64| (at(k) - centre).length();
            let ks: Vec<i64> = (-300..300).filter(|&k| inside(k)).collect();
            let Some(&hit) = ks.iter().find(|&&k| radius(k) <= RADIUS) else {
                assert_eq!(pixel, [0.0; 4]);
                assert_eq!((z[t], depth[t]), (f64::INFINITY, [f64::INFINITY; 3]));
                assert_eq!((first[t], normal[t], gradient[t], curvature[t]), (0.0, [0.0; 3], [0.0; 3], [0.0; 3]));
                assert_eq!((first_normal[t], first_curvature[t]), ([0.0; 3], [0.0; 3]));
                assert_eq!(counts[t], ks.len() as f64, "pixel {t}");
                continue;
            };
            let near = |k: i64| (radius(k) - RADIUS).abs() < 1e-9;
            if near(hit) || near(hit - 1) {
                continue;
            }
            assert_eq!(pixel[3], 1.0);
            let s = (hit as f64 + 0.5) * step;
            assert!((z[t] - s).abs() < 1e-12 && depth[t].iter().all(|d| (d - z[t]).abs() < 1e-12), "{} {s}", z[t]);
            assert_eq!(depth[t][..2], [z[t]; 2]);
            let (n, r) = ((at(hit) - centre).normalize(), radius(hit));
            assert!((DVec3::from_array(normal[t]) - n).length() < 1e-12, "{:?} {n}", normal[t]);
            let world = view.direction_to_world(n) * (-r / RADIUS);
            assert!((DVec3::from_array(gradient[t]) - world).length() < 1e-12, "{:?} {world}", gradient[t]);
            assert!((first[t] - (RADIUS * RADIUS - r * r) / (2.0 * RADIUS)).abs() < 1e-12);
            assert!(curvature[t].iter().all(|k| (k * r - 1.0).abs() < 1e-11), "{:?} {}", curvature[t], 1.0 / r);
            // One sample is its own mean.
            let off = |a: [f64; 3], b: [f64; 3]| (DVec3::from_array(a) - DVec3::from_array(b)).length();
            assert!(off(first_normal[t], normal[t]) < 1e-15 && off(first_curvature[t], curvature[t]) < 1e-15);
            // Without skipping every sample up to the hit is evaluated, and none after it.
            assert_eq!(counts[t], ks.iter().filter(|&&k| k <= hit).count() as f64, "pixel {t}");
            seen += 1;
        }
        assert!(seen > 20, "{seen}");
    }
}

/// Three samples of α = 0.2, 0.5, 0.6, values 1, 2, 3 at eye depths 2.5, 3.5, 4.5: weights 0.2, 0.8·0.5, 0.8·0.5·0.6.
/// A passes ½ at the second, where it is 0.6.
#[test]
fn layers_of_three_samples_by_hand() {
    let slab = volume([3, 3, 3], |p| p.y + 1.0);
    let shot = Stage::regular(slab, &[(1.0, [1.0; 3], 0.2), (2.0, [1.0; 3], 0.5), (3.0, [1.0; 3], 0.6)])
        .layers(&LAYERS)
        .step(1.0)
        .with(|s| {
            s.picture.size = [1, 1];
            s.camera = orthographic(Some(1.0));
            s.camera.direction = DVec3::Y;
            s.camera.direction_given = true;
            s.camera.eye = Some(DVec3::new(1.0, -2.5, 1.0));
        });
    let shown = shot.render();
    let weights = [0.2, 0.4, 0.24];
    let total: f64 = weights.iter().sum();
    assert!((shown.pixels()[0][3] - total).abs() < 1e-15);
    assert_eq!(shown.one(LayerKind::Z), [3.5]);
    let [first, half, mean] = shown.layer::<3>(LayerKind::Depth)[0];
    assert_eq!([first, half], [2.5, 3.5]);
    assert!((mean - (0.2 * 2.5 + 0.4 * 3.5 + 0.24 * 4.5) / total).abs() < 1e-14);
    assert_eq!(shown.one(LayerKind::First), [1.0]);
    assert_eq!(shown.one(LayerKind::Counts), [3.0]);
    // Values rise along the view: outwards is towards the eye. The gradient is that of the world.
    assert!((DVec3::from_array(shown.layer::<3>(LayerKind::Normal)[0]) - DVec3::Z).length() < 1e-15);
    assert!((DVec3::from_array(shown.layer::<3>(LayerKind::Gradient)[0]) - DVec3::Y).length() < 1e-15);
    assert_eq!(shown.layer::<3>(LayerKind::Curvature)[0], [0.0; 3]);
    // ½ itself is reached: A = ½ at the first sample.
    let half = shot.with_transfer(|t| t.nodes.as_mut().unwrap()[0].opacity = 0.5).render();
    assert_eq!(half.one(LayerKind::Z), [2.5]);
    // Half is never reached: no hit at ½, but a first and a mean.
    let clear = shot.with_transfer(|t| t.nodes.as_mut().unwrap().iter_mut().for_each(|n| n.opacity = 0.1));
    let shown = clear.render();
    assert_eq!(shown.one(LayerKind::Z), [f64::INFINITY]);
    let [first, half, mean] = shown.layer::<3>(LayerKind::Depth)[0];
    assert_eq!([first, half], [2.5, f64::INFINITY]);
    assert!(mean > 2.5 && mean < 4.5);
}

/// The mean normal is not renormalized: the thin sheet's two normals cancel by their weights.
#[test]
fn a_mean_normal_is_no_unit_vector() {
    let sheet = volume([5, 4, 5], |p| -(p.y - 1.5).abs());
    let shot = Stage::regular(sheet, &[(-1.0, [1.0; 3], 0.0), (-1.0, [1.0; 3], 0.5)])
        .layers(&[LayerKind::Normal])
        .step(1.0)
        .with(|s| {
            s.picture.size = [1, 1];
            s.camera.projection = orthographic(Some(1.0)).projection;
        });
    // The first of them is towards the eye.
    let first = shot.layers(&[LayerKind::FirstNormal]).render();
    assert_eq!(first.layer::<3>(LayerKind::FirstNormal), [[0.0, 0.0, 1.0]]);
    // Weights ½ and ¼, normals towards and away from the eye.
    let n = shot.render().layer::<3>(LayerKind::Normal)[0];
    assert!((DVec3::from_array(n) - DVec3::new(0.0, 0.0, 1.0 / 3.0)).length() < 1e-15, "{n:?}");
    let facing = shot.with(|s| s.sampling.normal = NormalSide::Facing).render();
    assert_eq!(facing.layer::<3>(LayerKind::Normal), [[0.0, 0.0, 1.0]]);
}

/// A sample without a normal counts with N = v and κ = 0; off the axis of a perspective picture v is not z.
#[test]
fn samples_without_a_normal_count_with_v() {
    let shot = Stage::regular(volume([6; 3], |_| 7.5), &[(0.0, [1.0; 3], 0.5)]).layers(&LAYERS).with(|s| {
        let direction = s.camera.direction;
        s.camera = perspective(90.0);
        s.camera.direction = direction;
    });
    let (view, shown) = (shot.view(), shot.render());
    let mut seen = 0;
    for (t, n) in shown.layer::<3>(LayerKind::Normal).into_iter().enumerate() {
        if shown.pixels()[t][3] > 0.0 {
            let v = view.ray((t % 16) as f64 + 0.5, (t / 16) as f64 + 0.5).v;
            assert!((DVec3::from_array(n) - v).length() < 1e-15);
            seen += 1;
        }
    }
    assert!(seen > 50);
    assert!(shown.layer::<3>(LayerKind::Curvature).iter().all(|k| *k == [0.0; 3]));
}

/// Layers beside the beauty change nothing of it, and one layer nothing of another.
#[test]
fn layers_do_not_disturb_each_other() {
    let glass = plain("glass", [0.2, 0.5, 0.8, 0.7]);
    let shot = Stage::styled(ball(14, 5.0), vec![glass], &[(-1.0, "glass", 0.0), (3.0, "glass", 0.5)])
        .with_transfer(|t| t.transparency = Transparency::Plain)
        .with(|s| s.contours = Some(Contours { kappa: Kappa::Exact, ..Contours::default() }));
    let all = shot.layers(&LAYERS).render();
    assert_eq!(shot.render().pixels(), all.pixels());
    for kind in LAYERS {
        let alone = shot.with(|s| s.picture.layers = vec![kind]).render();
        assert_eq!(alone.picture.layers.len(), 1);
        assert_eq!(alone.layer_bits(kind), all.layer_bits(kind), "{kind}");
    }
    let kv = shot.layers(&[LayerKind::CurvatureAlongView]).render().one(LayerKind::CurvatureAlongView);
    assert_eq!(kv, all.layer::<3>(LayerKind::Curvature).iter().map(|k| k[2]).collect::<Vec<_>>());
}

/// What is computed for the first sample alone is what every sample would have had there: with κ along the ray and exact,
/// before and behind what a style has with α_d = 0.
#[test]
fn the_first_sample_knows_the_same_when_only_it_is_asked() {
    use LayerKind::{Curvature, First, FirstCurvature, FirstNormal, Normal};
    let clear = plain("clear", [0.0; 4]);
    let glass = plain("glass", [0.2, 0.5, 0.8, 0.7]);
    let nodes = [(-3.0, "clear", 1.0), (1.0, "clear", 1.0), (1.0, "glass", 0.3)];
    for kappa in [Kappa::Ray, Kappa::Exact] {
        let regular = Stage::regular(ball(14, 5.0), &[(-1.0, [1.0; 3], 0.0), (3.0, [1.0; 3], 0.5)]);
        let styled = Stage::styled(ball(14, 5.0), vec![clear.clone(), glass.clone()], &nodes);
        for shot in [regular, styled] {
            let shot = shot.seen_along([0.3, 0.8, -0.5]).with(|s| {
                s.contours = Some(Contours { kappa, ..Contours::default() });
            });
            let all = shot.layers(&[Normal, Curvature, First, FirstNormal, FirstCurvature]).render();
            let alone = shot.layers(&[FirstNormal, FirstCurvature]).render();
            for kind in [LayerKind::Beauty, FirstNormal, FirstCurvature] {
                assert_eq!(all.layer_bits(kind), alone.layer_bits(kind), "{kind} {kappa:?}");
            }
            // The ball's own curvature at its first visible sample, to the error of central differences.
            let firsts = all.one(First).into_iter().zip(all.layer::<3>(FirstCurvature)).zip(all.pixels());
            for ((value, [k1, k2, _]), _) in firsts.filter(|(_, p)| p[3] > 0.0) {
                let expected = 1.0 / (5.0 - value);
                assert!(
                    (k1 - expected).abs() < 0.35 * expected && (k2 - expected).abs() < 0.35 * expected,
                    "{k1} {k2}"
                );
            }
        }
    }
}

/// Of a pixel of several rays a mean is that over all their samples ([RAY-6]): each ray counts with its opacity, and one
/// that sees nothing, not at all.
#[test]
fn means_of_a_pixel_of_several_rays_by_hand() {
    // f = xz, which trilinear interpolation and central differences have exactly: ∇f = (z, 0, x).
    let field = volume([3, 3, 3], |p| p.x * p.z);
    // Rays at x and z of ½ and 3/2, from the upper left: values ¾, 2¼, ¼, ¾ with α = ½, ¼, 0, ½.
    let node = |at: f64, opacity| (at, [1.0; 3], opacity);
    let shot = Stage::regular(field, &[node(0.5, 0.0), node(0.5, 0.5), node(1.0, 0.5), node(1.0, 0.25)])
        .layers(&[LayerKind::Gradient, LayerKind::First, LayerKind::Depth])
        .step(5.0)
        .with(|s| {
            s.picture.size = [1, 1];
            s.picture.samples = RaysPerPixel::Across(2);
            s.camera = orthographic(Some(2.0));
            s.camera.direction = DVec3::Y;
            s.camera.direction_given = true;
            // One sample in the box, at y = 1 and depth 2.5: those before and behind lie outside.
            s.camera.eye = Some(DVec3::new(1.0, -1.5, 1.0));
        });
    let shown = shot.render();
    assert_eq!(shown.pixels()[0], [(0.5 + 0.25 + 0.5) / 4.0; 4]);
    // (½ (3/2, ½) + ¼ (3/2, 3/2) + ½ (½, 3/2)) / 1¼ = (1.1, 1.1).
    let [x, y, z] = shown.layer::<3>(LayerKind::Gradient)[0];
    assert!((x - 1.1).abs() < 1e-15 && y == 0.0 && (z - 1.1).abs() < 1e-15, "{x} {z}");
    // Depths and what is first are the first ray's, also where that sees nothing.
    assert_eq!((shown.layer::<3>(LayerKind::Depth)[0], shown.one(LayerKind::First)[0]), ([2.5; 3], 0.75));
    let blind = shot.with(|s| s.camera.up = -DVec3::Z).with(|s| s.camera.direction = -DVec3::Y);
    let blind = blind.with(|s| s.camera.eye = Some(DVec3::new(1.0, 3.5, 1.0))).render();
    assert_eq!((blind.layer::<3>(LayerKind::Depth)[0], blind.one(LayerKind::First)[0]), ([f64::INFINITY; 3], 0.0));
    assert_eq!(blind.pixels()[0], shown.pixels()[0]);
    let [x, _, z] = blind.layer::<3>(LayerKind::Gradient)[0];
    assert!((x - 1.1).abs() < 1e-15 && (z - 1.1).abs() < 1e-15, "{x} {z}");
}

/// Values so steep that gradients overflow in the world's units: the mean of infinities of both signs is not asked for,
/// and nothing is undefined.
#[test]
fn gradients_that_overflow_are_infinite_never_undefined() {
    let grid = drypoint::scene::space::Grid::with_spacing([5, 4, 5], [1e-9; 3]).unwrap();
    let sheet = crate::common::on(grid, |p| 1e303 * (1.0 - ((p.y - 1.5e-9) * 1e9).abs()));
    let shot = Stage::regular(sheet, &[(0.0, [1.0; 3], 0.5)]).layers(&LAYERS);
    let shown = shot.render();
    assert!(shown.covered() > 20);
    assert!(shown.picture.layers.iter().flat_map(|l| l.channels.iter().flatten()).all(|v| !v.is_nan()));
    assert!(shown.layer::<3>(LayerKind::Gradient).iter().any(|g| g[1].is_infinite()));
}
