//! Random scenes: the picture of numbers with errors is the picture, and that in f32 is within their bounds.

use super::generator::scene;
use crate::common::random::Random;
use crate::common::{Shown, Stage};
use drypoint::reference::ray::bounds::RayOrigin;
use drypoint::scene::fragments::{Fragment, Fragments};
use drypoint::scene::picture::{LayerKind, Picture};
use drypoint::scene::tables::{GradientEstimator, GradientRange, HessianEstimator, Kernel, Number};
use std::collections::BTreeMap;

/// A random scene without what has no bounds.
fn bounded(seed: u64) -> Stage {
    scene(seed).with(|s| {
        s.sampling.number = Number::F64;
        s.picture.layers.retain(|layer| !matches!(layer, LayerKind::Counts | LayerKind::Halo(_)));
        for layer in &mut s.picture.layers {
            match layer {
                LayerKind::Curvature => *layer = LayerKind::CurvatureAlongView,
                LayerKind::FirstCurvature => *layer = LayerKind::FirstCurvatureAlongView,
                _ => {}
            }
        }
        s.halos.clear();
    })
}

/// Lines on the rays of some scenes, opaque ones among them: anywhere in the box, and where the steps of two samples meet
/// or nearly so.
fn lines(stage: &Stage, seed: u64) -> Option<Fragments> {
    let (r, shot) = (&mut Random(seed ^ 0x9e37), stage.resolved(stage.view()));
    let (view, n, step) = (&shot.view, shot.rays_across, shot.lattice.step);
    let depths = stage.volume.grid().world_corners().map(|corner| -view.to_eye(corner).z);
    let [near, far] = depths.iter().fold([f64::INFINITY, 0.0f64], |[a, b], d| [a.min(*d), b.max(*d)]);
    let rays = view.size[0] * view.size[1] * n * n;
    let found = |r: &mut Random| {
        let anywhere = r.between(near, far);
        let whole = (anywhere / step).floor() * step;
        let depth = r.pick(&[anywhere, anywhere, whole, whole * (1.0 + 1e-8), whole * (1.0 - 1e-8)]);
        (r.below(rays), Fragment { depth, rgb: [0.9, 0.2, 0.1], opacity: r.pick(&[0.1, 0.5, 1.0]) })
    };
    let found: Vec<_> = (0..2 * rays).map(|_| found(r)).collect();
    seed.is_multiple_of(3).then(|| Fragments::new(view.size, n, &found))
}

fn drawn(stage: &Stage, lines: &Option<Fragments>) -> Shown {
    lines.as_ref().map_or_else(|| stage.render(), |lines| stage.render_among(lines))
}

/// The channels of each layer.
fn channels(picture: &Picture) -> impl Iterator<Item = (LayerKind, &Vec<f64>)> {
    picture.layers.iter().flat_map(|layer| layer.channels.iter().map(|channel| (layer.kind, channel)))
}

#[test]
fn the_values_are_the_picture_bit_for_bit() {
    let (mut shown_something, mut pixels, mut undecided) = (0, 0, 0);
    for seed in 0..400 {
        let stage = bounded(seed);
        let lines = lines(&stage, seed);
        let bounds = stage.bounds_among(lines.clone(), RayOrigin::Middle).unwrap();
        let picture = drawn(&stage, &lines).picture;
        for ((kind, values), (_, numbers)) in channels(&bounds.values).zip(channels(&picture)) {
            let mut pairs = values.iter().zip(numbers).enumerate();
            let differ = pairs.find(|(_, (a, b))| a != b && !(a.is_nan() && b.is_nan()));
            assert_eq!(differ, None, "seed {seed}, {kind}: {:?}", stage.scene);
        }
        assert!(channels(&bounds.errors).all(|(_, errors)| errors.iter().all(|e| *e >= 0.0)), "seed {seed}");
        shown_something += usize::from(channels(&picture).any(|(_, numbers)| numbers.iter().any(|&c| c != 0.0)));
        pixels += bounds.undecided.len();
        undecided += bounds.undecided.iter().flatten().count();
    }
    assert!(shown_something > 120, "{shown_something}");
    println!("undecided: {undecided} of {pixels}");
}

#[test]
fn pictures_in_f32_are_within_the_bounds() {
    let (mut compared, mut undecided, mut pixels) = (BTreeMap::new(), 0, 0);
    for seed in 400..2000 {
        // The reference makes coefficients in f32, a renderer takes those of the reference.
        let stage = bounded(seed);
        let [lo, hi] = stage.volume.range();
        let stage = stage.with(|s| {
            // So is a quantile of gradients.
            s.volume.gradient_range = GradientRange::Fixed([0.0, (hi - lo).max(1.0)]);
            if matches!(s.sampling.kernel, Kernel::Bspline | Kernel::Bspline5) {
                s.sampling.kernel = Kernel::BsplineSmooth;
            }
            if s.sampling.gradient == GradientEstimator::Regression {
                s.sampling.gradient = GradientEstimator::Central;
            }
            if s.sampling.hessian == HessianEstimator::Gaussian {
                s.sampling.hessian = HessianEstimator::Auto;
            }
        });
        let lines = lines(&stage, seed);
        let bounds = stage.bounds_among(lines.clone(), RayOrigin::Eye).unwrap();
        let single = drawn(&stage.in_number(Number::F32), &lines).picture;
        let bounded = channels(&bounds.values).zip(channels(&bounds.errors));
        for (((kind, values), (_, errors)), (_, single)) in bounded.zip(channels(&single)) {
            let decided = (0..values.len()).filter(|&i| bounds.undecided[i].is_none());
            for (i, (value, error, x)) in decided.map(|i| (i, (values[i], errors[i], single[i]))) {
                let (found, open) = compared.entry(kind).or_insert((0, 0));
                (*found, *open) = (*found + 1, *open + usize::from(error == f64::INFINITY));
                assert!(
                    x == value || (x - value).abs() <= error || error == f64::INFINITY,
                    "seed {seed}, {kind}, pixel {i}: {x} {value} ± {error:e}, off by {:e}\n{:?} {:?}",
                    (x - value).abs(),
                    stage.scene,
                    stage.volume.grid()
                );
            }
        }
        pixels += bounds.undecided.len();
        undecided += bounds.undecided.iter().flatten().count();
    }
    println!("undecided: {undecided} of {pixels}; compared, and without a bound: {compared:?}");
    assert!(compared[&LayerKind::Beauty].0 > 50_000, "{compared:?}");
    assert!(undecided * 20 < pixels, "{undecided} of {pixels}");
    for (kind, (found, open)) in compared {
        assert!(open * 10 < found, "{kind}: {open} of {found}");
    }
}
