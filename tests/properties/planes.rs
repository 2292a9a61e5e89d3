//! Plane order is ray order: no bit of the picture and no count tells them apart. With halos no part of it tells how it was
//! made.

use super::generator::{resized, scene};
use crate::common::Stage;
use crate::common::random::Random;
use drypoint::reference::ray::Renderer;
use drypoint::scene::counts::Counts;
use drypoint::scene::fragments::{Fragment, Fragments};
use drypoint::scene::tables::{
    Exponents, Halo, HaloAccumulation, HaloKind, RaysPerPixel, SeedBy, SeedValue, StepAlong,
};
use std::collections::BTreeMap;

/// The counts of samples and rays.
pub(super) fn counted(counts: &Counts) -> Vec<u64> {
    let c = counts;
    let of_samples = [c.samples, c.gradients, c.hessians, c.style_lookups, c.without_normal, c.masked];
    [of_samples.as_slice(), &[c.rays, c.rays_skipped, c.refined_pixels]].concat()
}

/// Random lines before, in and behind a scene's box, more than one on some rays and equal depths among them.
pub(super) fn lines(shot: &Stage, seed: u64) -> Fragments {
    let r = &mut Random(seed ^ 0x9e37);
    let (size, samples) = (shot.scene.picture.size, shot.resolved(shot.view()).rays_across);
    let view = shot.view();
    let depths = shot.volume.grid().world_corners().map(|corner| view.to_eye(corner).z.abs());
    let (near, far) = depths.iter().fold((f64::INFINITY, 0.0f64), |(a, b), d| (a.min(*d), b.max(*d)));
    let rays = size[0] * size[1] * samples * samples;
    let found: Vec<(usize, Fragment)> = (0..rays)
        .map(|_| {
            let anywhere = r.below(997) as f64 / 997.0;
            let depth = near + (far - near) * r.pick(&[-0.1, 0.25, 0.5, anywhere, 1.1]);
            let opacity = r.pick(&[0.1, 0.5, 1.0]);
            (r.below(rays), Fragment { depth, rgb: [0.9, 0.2, 0.1], opacity })
        })
        .collect();
    Fragments::new(size, samples, &found)
}

#[test]
fn planes_show_nowhere() {
    let (mut shown, mut surfaces, mut layers, mut lined, mut kinds) = (0, 0, 0, 0, BTreeMap::new());
    for seed in 7000..7400 {
        let shot = resized(&scene(seed), [21, 13]);
        let lines = (seed % 3 == 0).then(|| lines(&shot, seed));
        let by = |planes: bool| {
            shot.render_by(|mut renderer| {
                renderer.merge(lines.clone());
                if planes { renderer.plane_by_plane() } else { renderer.ray_by_ray() }
            })
        };
        let [rays, planes] = [false, true].map(by);
        assert_eq!(planes.bits(), rays.bits(), "seed {seed}: {:?}", shot.scene);
        assert_eq!(counted(&planes.counts), counted(&rays.counts), "seed {seed}: {:?}", shot.scene);
        if rays.counts.samples == 0 {
            continue;
        }
        shown += 1;
        surfaces += usize::from(shot.scene.surface.is_some());
        layers += usize::from(!shot.scene.picture.layers.is_empty());
        lined += usize::from(lines.is_some());
        *kinds.entry(format!("{:?} {:?}", shot.scene.sampling.number, shot.scene.sampling.kernel)).or_insert(0) += 1;
    }
    println!("{shown} scenes, {surfaces} with surfaces, {layers} with layers, {lined} with lines: {kinds:?}");
    assert!(shown > 150 && surfaces > 15 && layers > 40 && lined > 40 && kinds.len() == 10, "{kinds:?}");
}

/// Random halos, over groups of one to three planes.
fn halos(seed: u64) -> Vec<Halo> {
    let r = &mut Random(seed ^ 0x51ed);
    let one = |r: &mut Random| {
        let mut halo = Halo {
            kind: r.pick(&[HaloKind::Emissive, HaloKind::Occlusive]),
            exponents: r.pick(&[Exponents::Contour, Exponents::Printed, Exponents::Numbers([0.0, 0.0])]),
            every: 1 + r.below(3) as u64,
            accumulate: r.pick(&[HaloAccumulation::Max, HaloAccumulation::Mean]),
            ..Halo::default()
        };
        halo.profile[0].opacity = 0.3;
        halo.spread.passes = r.below(4) as u64;
        halo.spread.median = r.below(4) == 0;
        halo.seed.value =
            r.pick(&[None, Some(SeedValue::Opacity), Some(SeedValue::Nodes(vec![[0.3, 0.0], [0.3, 1.0]]))]);
        halo.seed.by = r.pick(&[SeedBy::Power, SeedBy::Power, SeedBy::Curvature]);
        halo
    };
    (0..1 + r.below(3)).map(|_| one(r)).collect()
}

/// A halo of opacity 0 changes no bit of any picture, whatever else is in it, though its seeds are computed.
#[test]
fn halos_that_are_not_seen_change_no_bit() {
    let mut seeded = 0;
    for seed in 7000..7200 {
        let stage = resized(&scene(seed), [21, 13]).with(|s| {
            s.sampling.step_along = StepAlong::Plane;
            s.picture.samples = RaysPerPixel::Across(s.picture.samples.across(false));
        });
        let lines = (seed % 3 == 0).then(|| lines(&stage, seed));
        let plain = stage.render_by(|mut renderer| {
            renderer.merge(lines.clone());
            renderer
        });
        let with = stage.with(|s| s.halos = halos(seed));
        let mut shot = with.resolved(with.view());
        shot.halos.list.iter_mut().for_each(|halo| halo.opacity = 0.0);
        let shown = with.render_shot(&shot, |mut renderer| {
            renderer.merge(lines.clone());
            renderer
        });
        assert_eq!(shown.bits(), plain.bits(), "seed {seed}: {:?}", with.scene);
        assert_eq!(shown.counts.samples, plain.counts.samples, "seed {seed}");
        seeded += usize::from(shown.counts.halo_passes > 0);
    }
    assert!(seeded > 60, "{seeded}");
}

/// Tiles, bands of rays and skipped bricks show nowhere in a picture with halos.
#[test]
fn halos_in_any_parts_of_the_picture() {
    let mut differ = 0;
    for seed in 7200..7320 {
        let plain = resized(&scene(seed), [21, 13]).with(|s| s.sampling.step_along = StepAlong::Plane);
        let stage = plain.with(|s| s.halos = halos(seed));
        let lines = (seed % 3 == 0).then(|| lines(&stage, seed));
        let by = |set: &dyn Fn(Renderer<'_>) -> Renderer<'_>| {
            stage.render_by(|mut renderer| {
                renderer.merge(lines.clone());
                set(renderer)
            })
        };
        let whole = by(&|renderer| renderer);
        for (what, other) in [
            ("tiles", by(&|renderer| renderer.with_tiles(5))),
            ("bands", by(&|renderer| renderer.with_tiles(3).with_band(1))),
            (
                "all bricks",
                stage.with(|s| s.sampling.skip_empty = !s.sampling.skip_empty).render_by(|mut renderer| {
                    renderer.merge(lines.clone());
                    renderer
                }),
            ),
        ] {
            assert_eq!(other.bits(), whole.bits(), "{what}, seed {seed}: {:?}", stage.scene);
        }
        differ += usize::from(plain.render().bits() != whole.bits());
    }
    assert!(differ > 30, "{differ}");
}
