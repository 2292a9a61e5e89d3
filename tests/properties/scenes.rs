//! Every scene: nothing undefined, opacities in [0, 1], one picture however it is made.

use super::generator::{resized, scene};
use crate::common::{Shown, Stage};
use drypoint::scene::picture::LayerKind;
use drypoint::scene::shot::Shot;

const SEEDS: std::ops::Range<u64> = 0..400;

/// No NaN in any layer; 0 ≤ A ≤ 1; colours not negative; finite but for depths.
fn sound(shown: &Shown, place: &str) {
    for layer in &shown.picture.layers {
        for v in layer.channels.iter().flatten() {
            assert!(!v.is_nan(), "{place}: {}", layer.kind);
            let may_be_infinite = matches!(layer.kind, LayerKind::Z | LayerKind::Depth);
            assert!(v.is_finite() || may_be_infinite && *v == f64::INFINITY, "{place}: {} {v}", layer.kind);
        }
    }
    for p in shown.pixels() {
        assert!(p.iter().all(|c| *c >= 0.0) && p[3] <= 1.0, "{place}: {p:?}");
    }
    if shown.picture.layer(LayerKind::Curvature).is_some() {
        for [k1, k2, _] in shown.layer::<3>(LayerKind::Curvature) {
            assert!(k1 >= k2, "{place}: {k1} {k2}");
        }
    }
    for n in shown.layer::<3>(LayerKind::Normal) {
        assert!(n.iter().map(|c| c * c).sum::<f64>() <= 1.0 + 1e-6, "{place}: {n:?}");
    }
}

/// [RAY-2]: skipping changes no bit of any layer but the count of samples.
fn skipping_shows_nowhere(shot: &Stage, shown: &Shown, place: &str) {
    let without = shot.with(|s| s.sampling.skip_empty = false).render();
    assert_eq!(shown.bits(), without.bits(), "{place}");
    assert!(shown.counts.samples <= without.counts.samples, "{place}");
    let done = |s: &Shown| (s.counts.gradients, s.counts.hessians, s.counts.style_lookups, s.counts.without_normal);
    assert_eq!(done(shown), done(&without), "{place}");
}

#[test]
fn every_scene_is_sound_and_skips_without_a_trace() {
    let (mut shown_something, mut skipped) = (0, 0);
    for seed in SEEDS {
        let shot = scene(seed);
        let place = format!("seed {seed}: {:?} {:?}", shot.scene, shot.volume.dims());
        let shown = shot.render();
        sound(&shown, &place);
        skipping_shows_nowhere(&shot, &shown, &place);
        shown_something += usize::from(shown.covered() > 0 && shown.one(LayerKind::First).iter().any(|v| *v != 0.0));
        skipped += usize::from(shown.counts.rays_skipped > 0);
    }
    // A generator whose scenes are empty would test nothing.
    assert!(shown_something > 120 && skipped > 50, "{shown_something} {skipped}");
}

/// The JSON of a shot is read as the same shot, and as the same text: zeros keep their signs.
#[test]
fn shots_read_back() {
    for seed in SEEDS {
        let stage = scene(seed);
        let shot = stage.resolved(stage.view());
        let text = shot.to_json().unwrap();
        let read = serde_json::from_str::<Shot>(&text).unwrap_or_else(|error| panic!("{seed}: {error}\n{text}"));
        assert!(read == shot && read.to_json().unwrap() == text, "{seed}: {text}");
    }
}

/// [RAY-3]: 1, 2 and 7 threads make the same bits, with tiles of 1, 5, 16 and 64 pixels, which the picture is a part of or
/// no multiple of. What bounds the rays of a tile together is another for each.
#[test]
fn threads_and_tiles_show_nowhere() {
    let pools: Vec<_> =
        [1, 2, 7].map(|n| rayon::ThreadPoolBuilder::new().num_threads(n).build().unwrap()).into_iter().collect();
    for seed in 1000..1040 {
        let shot = resized(&scene(seed), [37, 19]);
        let pictures: Vec<_> = pools
            .iter()
            .flat_map(|pool| [1, 5, 16, 64].map(|side| pool.install(|| shot.render_in_tiles(side))))
            .collect();
        for other in &pictures[1..] {
            assert_eq!(pictures[0].bits(), other.bits(), "seed {seed}: {:?}", shot.scene);
            assert_eq!(pictures[0].layer_bits(LayerKind::Counts), other.layer_bits(LayerKind::Counts), "seed {seed}");
            let counts = |s: &Shown| {
                let c = &s.counts;
                (c.samples, c.gradients, c.hessians, c.style_lookups, c.rays_skipped, c.masked, c.bytes.clone())
            };
            assert_eq!(counts(&pictures[0]), counts(other), "seed {seed}");
        }
    }
}

/// A frame is a function of its scene: the second of one renderer is the first.
#[test]
fn the_same_scene_gives_the_same_picture() {
    for seed in 2000..2010 {
        let shot = scene(seed);
        assert_eq!(shot.render().bits(), shot.render().bits(), "seed {seed}");
    }
}
