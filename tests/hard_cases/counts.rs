//! What is not called for is not done ([PLAN-1], [PLAN-2]): counts against a walk along every ray that asks each sample.

use crate::common::lattice::{Sighted, sighted};
use crate::common::{LAYERS, Stage, ball, on, perspective, plain};
use drypoint::scene::counts::Counts;
use drypoint::scene::glam::DVec3;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::plan::Pass;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{
    Contours, GradientEstimator, GradientRange, HessianEstimator, Kappa, Kernel, RaysPerPixel, Shading, Transparency,
};
use drypoint::scene::volume::{Volume, Voxels};

/// A ball with a constant outside, of which more than the ball is visible: samples with and without a normal, none of
/// them opaque.
fn regular() -> Stage {
    let centre = DVec3::splat(9.5);
    let field = crate::common::volume([20; 3], |p| (7.0 - (p - centre).length()).max(-1.0));
    Stage::regular(field, &[(-2.0, [0.5; 3], 0.0), (3.0, [0.9, 0.5, 0.2], 0.2)]).with(|s| {
        let direction = s.camera.direction;
        s.camera = perspective(50.0);
        s.camera.direction = direction;
    })
}

fn styled() -> Stage {
    let regular = regular();
    let styles = vec![plain("a", [0.2, 0.4, 0.6, 1.0]), plain("b", [0.7, 0.4, 0.1, 0.9])];
    let shot = Stage::styled(regular.volume, styles, &[(-2.0, "a", 0.0), (1.0, "a", 0.1), (3.0, "b", 0.2)]);
    Stage { scene: drypoint::scene::tables::Scene { transfer: shot.scene.transfer, ..regular.scene }, ..shot }
}

/// Visible samples: all above −2.
fn visible(shot: &Stage) -> u64 {
    sighted::<f64>(shot).iter().flatten().filter(|s| s.value > -2.0).count() as u64
}

fn counts(shot: &Stage) -> Counts {
    shot.render().counts
}

#[test]
fn an_unshaded_scene_computes_no_gradient() {
    let shot = regular();
    let c = counts(&shot);
    assert_eq!([c.gradients, c.hessians, c.style_lookups, c.halo_passes, c.without_normal, c.masked], [0; 6]);
    assert!(c.preprocess.is_empty());
    assert_eq!(c.rays, 256);
    // Everything in the box is visible: skipping saves nothing, and each sample is one value.
    let all: u64 = sighted::<f64>(&shot).iter().map(|ray| ray.len() as u64).sum();
    assert_eq!(c.samples, all);
    let missed = sighted::<f64>(&shot).iter().filter(|ray| ray.is_empty()).count() as u64;
    assert_eq!(c.rays_skipped, missed);
}

#[test]
fn shaded_and_style_scenes_compute_one_gradient_a_visible_sample() {
    let seen = visible(&regular());
    let flat = sighted::<f64>(&regular()).iter().flatten().filter(|s| s.gradient.is_none()).count() as u64;
    assert!(flat > 0 && flat < seen);
    let lit = counts(&regular().with(|s| s.shading = Some(Shading::default())));
    assert_eq!((lit.gradients, lit.hessians, lit.style_lookups, lit.without_normal), (seen, 0, 0, flat));
    let style = counts(&styled());
    assert_eq!((style.gradients, style.hessians, style.without_normal), (seen, 0, flat));
    // Below 1 both nodes have style a: one lookup; above it two, but at the last node itself.
    let mixed = sighted::<f64>(&styled()).iter().flatten().filter(|s| s.value > 1.0 && s.value < 3.0).count() as u64;
    assert_eq!(style.style_lookups, seen + mixed);
    assert!(style.preprocess.is_empty(), "the range of |g| was given");
}

/// [STF-5]: where the sample before is visible its normal is at hand, else one gradient more is evaluated, if the sample
/// before lies in the box and beyond `near` and this one has a normal at all.
#[test]
fn contours_along_the_ray_look_back_only_where_they_must() {
    // A shell in a constant surround, so that its first samples have invisible predecessors.
    let shell = styled().with_transfer(|t| {
        let nodes = t.nodes.as_mut().unwrap();
        for (node, at) in nodes.iter_mut().zip([0.0, 1.0, 3.0]) {
            node.at = at;
        }
    });
    let shot = shell.with(|s| s.contours = Some(Contours { kappa: Kappa::Ray, ..Contours::default() }));
    let (mut seen, mut back) = (0, 0);
    for ray in sighted::<f64>(&shot) {
        for (i, s) in ray.iter().enumerate().filter(|(_, s)| s.value > 0.0) {
            seen += 1;
            let before = i.checked_sub(1).map(|i| ray[i]);
            back += u64::from(s.gradient.is_some() && before.is_some_and(|b| b.value <= 0.0));
        }
    }
    let c = counts(&shot);
    assert!(back > 20);
    assert_eq!((c.gradients, c.hessians), (seen + back, 0));
    assert_eq!(counts(&shot.with(|s| s.sampling.skip_empty = false)).gradients, seen + back);
    // A constant threshold looks nowhere.
    let none =
        shell.with(|s| s.contours = Some(Contours { kappa: Kappa::None { threshold: 0.3 }, ..Contours::default() }));
    assert_eq!((counts(&none).gradients, counts(&none).hessians), (seen, 0));
    assert_eq!(counts(&shell).gradients, seen);
}

#[test]
fn hessians_are_for_exact_contours_and_the_layer_of_curvatures_alone() {
    let exact = styled().with(|s| s.contours = Some(Contours { kappa: Kappa::Exact, ..Contours::default() }));
    let c = counts(&exact);
    assert_eq!(c.gradients, visible(&exact));
    assert_eq!(c.hessians, c.gradients - c.without_normal, "no surface, no curvature");
    let layer = |shot: &Stage, kind| counts(&shot.layers(&[kind]));
    // κ₁ and κ₂ of a regular scene: Hessians, and the scene's κ, along the ray.
    let curvature = layer(&regular(), LayerKind::Curvature);
    assert_eq!(curvature.hessians, visible(&regular()) - curvature.without_normal);
    // κ_v alone: none.
    let along = layer(&regular(), LayerKind::CurvatureAlongView);
    assert_eq!(along.hessians, 0);
    assert!(along.gradients >= visible(&regular()));
    assert_eq!(layer(&exact, LayerKind::CurvatureAlongView).hessians, c.hessians);
    for kind in [LayerKind::Normal, LayerKind::Gradient] {
        let c = layer(&regular(), kind);
        assert_eq!((c.gradients, c.hessians), (visible(&regular()), 0));
    }
    for kind in [LayerKind::Z, LayerKind::Depth, LayerKind::First, LayerKind::Counts] {
        assert_eq!(layer(&regular(), kind).gradients, 0, "{kind}");
    }
}

/// What only the first visible sample of a ray has to know is computed there alone ([IO-6]); what every sample knows
/// anyway, not again.
#[test]
fn layers_of_the_first_sample_cost_one_sample_a_ray() {
    use LayerKind::{Curvature, FirstCurvature, FirstCurvatureAlongView, FirstNormal, Normal};
    let layers = |shot: &Stage, kinds: &[LayerKind]| counts(&shot.layers(kinds));
    let shot = regular();
    let rays = sighted::<f64>(&shot);
    // All above −2, which is all of the box: the first sample is the first of the ray, and has none before it.
    let firsts: Vec<_> = rays.iter().filter_map(|ray| ray.iter().find(|s| s.value > -2.0)).collect();
    let (hit, flat) = (firsts.len() as u64, firsts.iter().filter(|s| s.gradient.is_none()).count() as u64);
    assert!(hit > 50 && visible(&shot) > 5 * hit);
    let c = layers(&shot, &[FirstNormal]);
    assert_eq!((c.gradients, c.hessians, c.without_normal), (hit, 0, flat));
    let c = layers(&shot, &[FirstCurvature]);
    assert_eq!((c.gradients, c.hessians), (hit, hit - flat));
    let c = layers(&shot, &[FirstCurvatureAlongView]);
    assert_eq!((c.gradients, c.hessians), (hit, 0), "nothing lies before the first sample of the box");
    // With the surround clear, the sample before the first has no normal at hand: one gradient more.
    let ball = shot.with_transfer(|t| t.nodes.as_mut().unwrap()[0].at = 0.0);
    let seen = |s: &&Sighted| s.value > 0.0;
    let hit = rays.iter().filter(|ray| ray.iter().any(|s| seen(&s))).count() as u64;
    let c = layers(&ball, &[FirstCurvature]);
    assert_eq!((c.gradients, c.hessians), (2 * hit, hit));
    // A style scene has the gradients; with exact contours the Hessian of κ_v, but not κ₁ and κ₂.
    let style = styled();
    assert_eq!(layers(&style, &[FirstNormal]).gradients, counts(&style).gradients);
    let exact = style.with(|s| s.contours = Some(Contours { kappa: Kappa::Exact, ..Contours::default() }));
    let (c, first) = (counts(&exact), layers(&exact, &[FirstCurvatureAlongView]));
    assert_eq!((first.gradients, first.hessians), (c.gradients, c.hessians));
    // Beside the means they cost nothing.
    let means = layers(&shot, &[Normal, Curvature]);
    let all = layers(&shot, &[Normal, Curvature, FirstNormal, FirstCurvature]);
    assert_eq!((all.gradients, all.hessians), (means.gradients, means.hessians));
}

/// The range of |g| is looked for only if something reads |g| and the scene does not give it.
#[test]
fn the_range_of_gradients_is_found_only_if_it_is_read() {
    let with = |shot: &Stage, range| counts(&shot.with(|s| s.volume.gradient_range = range)).preprocess;
    let quantile = GradientRange::Quantile(0.999);
    let voxels = 20 * 20 * 20;
    assert_eq!(with(&styled(), quantile).get("gradients"), Some(&voxels));
    assert!(with(&styled(), GradientRange::Fixed([0.0, 1.0])).is_empty());
    let plain = styled().with_transfer(|t| t.transparency = Transparency::Plain);
    assert!(with(&plain, quantile).is_empty());
    assert!(with(&regular(), quantile).is_empty());
    assert!(with(&regular().with(|s| s.shading = Some(Shading::default())), quantile).is_empty());
    let fade = plain.with(|s| s.contours = Some(Contours { fade: Some([0.1, 0.2]), ..Contours::default() }));
    assert_eq!(with(&fade, quantile).get("gradients"), Some(&voxels));
    let contours = plain.with(|s| s.contours = Some(Contours::default()));
    assert!(with(&contours, quantile).is_empty());
}

#[test]
fn rays_that_see_nothing_evaluate_nothing() {
    let nothing = regular().with_transfer(|t| t.nodes.as_mut().unwrap()[1].opacity = 0.0);
    let c = counts(&nothing);
    assert_eq!((c.samples, c.rays_skipped, c.rays), (0, 256, 256));
    let n = counts(&nothing.with(|s| s.picture.samples = RaysPerPixel::Across(3)));
    assert_eq!((n.samples, n.rays_skipped, n.rays), (0, 9 * 256, 9 * 256));
    let all = counts(&nothing.with(|s| s.sampling.skip_empty = false));
    assert!(all.samples > 0);
    // Skipping leaves out what a small thing does not fill.
    let small = Stage::regular(ball(40, 3.0), &[(0.0, [1.0; 3], 0.0), (0.0, [1.0; 3], 0.5)]);
    let (with, without) = (counts(&small), counts(&small.with(|s| s.sampling.skip_empty = false)));
    assert!(with.samples * 4 < without.samples && with.rays_skipped > 0, "{} {}", with.samples, without.samples);
}

/// The layer counts.SAMPLES sums to the count.
#[test]
fn the_layer_of_counts_is_the_count() {
    let shown = styled().layers(&[LayerKind::Counts]).render();
    assert_eq!(shown.one(LayerKind::Counts).iter().sum::<f64>(), shown.counts.samples as f64);
}

/// A masked sample is transparent and its value is not asked for: it counts as masked, not as a sample.
#[test]
fn masked_samples_are_counted_apart() {
    let grid = Grid::with_spacing([9; 3], [1.0; 3]).unwrap();
    let mut voxels = vec![1.0; 729];
    voxels[364] = f64::NAN;
    let volume = Volume::new(grid, Voxels::F64(voxels), 1.0, 0.0).unwrap();
    let shot = Stage::regular(volume, &[(0.0, [1.0; 3], 0.25)]);
    let masked = sighted::<f64>(&shot).iter().flatten().filter(|s| s.masked).count() as u64;
    let all = sighted::<f64>(&shot).iter().flatten().count() as u64;
    let c = counts(&shot);
    assert!(masked > 0);
    assert_eq!((c.masked, c.samples), (masked, all - masked));
}

/// Buffers exist only for what the scene calls for.
#[test]
fn buffers_are_those_that_are_called_for() {
    let names = |shot: &Stage| counts(shot).bytes.into_keys().collect::<Vec<_>>();
    let unskipped = |shot: &Stage| shot.with(|s| s.sampling.skip_empty = false);
    assert_eq!(names(&unskipped(&regular())), ["picture", "volume"]);
    assert_eq!(names(&regular()), ["bricks", "picture", "skip", "volume"]);
    // Cell by cell only where values are dear.
    let smooth = regular().with(|s| s.sampling.kernel = Kernel::BsplineSmooth);
    assert_eq!(names(&smooth), ["bricks", "cells", "picture", "skip", "volume"]);
    let spline = unskipped(&regular()).with(|s| s.sampling.kernel = Kernel::Bspline);
    assert_eq!(names(&spline), ["coefficients", "picture", "volume"]);
    let gaussian = |shot: &Stage| unskipped(shot).with(|s| s.sampling.hessian = HessianEstimator::Gaussian);
    assert_eq!(names(&gaussian(&regular())), ["picture", "volume"], "no Hessian is asked for");
    let layer = gaussian(&regular()).layers(&[LayerKind::Curvature]);
    assert_eq!(names(&layer), ["picture", "smoothed", "volume"]);
    // What is asked of the system before it is made covers it, but for the border that small volumes have.
    let bytes = |shot: &Stage, name: &str| counts(shot).bytes[name];
    for (pass, held) in [
        (Pass::Coefficients, bytes(&spline, "coefficients")),
        (Pass::SmoothedCoefficients, bytes(&gaussian(&regular()).layers(&[LayerKind::Curvature]), "smoothed")),
    ] {
        assert!((8000..=24 * 24 * 24).contains(&(held / 8)) && held <= pass.bytes_a_voxel() * 24 * 24 * 24, "{held}");
    }
    // Weights of an estimator that nothing asks for are not prepared either.
    let regression = unskipped(&regular()).with(|s| s.sampling.gradient = GradientEstimator::Regression);
    assert_eq!(names(&regression), ["picture", "volume"]);
    assert_eq!(names(&regression.with(|s| s.shading = Some(Shading::default()))), ["picture", "regression", "volume"]);
    assert_eq!(counts(&regular()).bytes["volume"], 8000 * 8);
    assert_eq!(
        counts(&regular().layers(&LAYERS)).bytes["picture"],
        256 * 8 * (4 + 1 + 3 + 3 + 3 + 3 + 1 + 3 + 3 + 1 + 1)
    );
}

/// A volume of u8 is read as it is stored.
#[test]
fn eight_bits_stay_one_byte() {
    let grid = Grid::with_spacing([5, 6, 7], [1.0; 3]).unwrap();
    let volume = Volume::new(grid.clone(), Voxels::U8(vec![3; 210]), 0.5, 0.0).unwrap();
    assert_eq!(counts(&Stage::regular(volume, &[(0.0, [1.0; 3], 0.5)])).bytes["volume"], 210);
    assert_eq!(counts(&Stage::regular(on(grid, |_| 1.5), &[(0.0, [1.0; 3], 0.5)])).bytes["volume"], 1680);
}
