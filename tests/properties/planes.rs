//! Plane order is ray order: no bit of the picture and no count tells them apart. And effects see what they are told.

use super::generator::{resized, scene};
use crate::common::random::Random;
use crate::common::{Shown, Stage, ball};
use drypoint::reference::ray::{PlaneEffect, RayOnPlane, SampleOnPlane};
use drypoint::scene::counts::Counts;
use drypoint::scene::fragments::{Fragment, Fragments};
use std::collections::BTreeMap;
use std::sync::Mutex;

/// The counts of samples and rays.
fn counted(counts: &Counts) -> [u64; 8] {
    let c = counts;
    [c.samples, c.gradients, c.hessians, c.style_lookups, c.without_normal, c.rays, c.rays_skipped, c.masked]
}

/// Random lines before, in and behind a scene's box, more than one on some rays and equal depths among them.
fn lines(shot: &Stage, seed: u64) -> Fragments {
    let r = &mut Random(seed ^ 0x9e37);
    let (size, samples) = (shot.scene.picture.size, shot.scene.picture.samples);
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
        // The same with an effect that does nothing, over groups of one to three planes.
        let mut nothing = Fog { planes: 1 + seed as i64 % 3, lays: seed % 2 == 0, ..Fog::new() };
        let grouped = with(&shot, lines.clone(), &mut nothing);
        assert_eq!(grouped.bits(), rays.bits(), "seed {seed}: {:?}", shot.scene);
        assert_eq!(counted(&grouped.counts), counted(&rays.counts), "seed {seed}: {:?}", shot.scene);
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

/// An effect that needs no halo: it tints samples, and each plane shines a little.
struct Fog {
    /// M.
    planes: i64,
    /// Groups that have ended, in their order.
    ended: Vec<i64>,
    /// Planes of samples that were seen after the end of their group.
    late: Mutex<Vec<i64>>,
    /// Σ of the samples' opacities by ray.
    sums: BTreeMap<[usize; 2], f64>,
    tint: Option<[f64; 3]>,
    shine: f64,
    /// Whether it is asked behind each plane.
    lays: bool,
    /// Groups that are due in any case.
    due: usize,
}

impl Fog {
    fn new() -> Self {
        let (ended, late, sums) = (Vec::new(), Mutex::default(), BTreeMap::new());
        Self { planes: 1, ended, late, sums, tint: None, shine: 0.0, lays: false, due: 0 }
    }
}

impl PlaneEffect for Fog {
    fn numbers(&self) -> usize {
        1
    }

    fn planes_per_group(&self) -> i64 {
        self.planes
    }

    fn before(&self, sample: &SampleOnPlane<'_>, rgb: [f64; 3]) -> [f64; 3] {
        if self.ended.last().is_some_and(|&last| last >= sample.k.div_euclid(self.planes)) {
            self.late.lock().unwrap().push(sample.k);
        }
        self.tint.unwrap_or(rgb)
    }

    fn after(&self, sample: &SampleOnPlane<'_>, own: &mut [f64]) {
        own[0] += sample.alpha;
    }

    fn lays_behind(&self, _: i64) -> bool {
        self.lays
    }

    fn behind(&self, _: i64, ray: RayOnPlane<'_>) {
        assert!(ray.is_open);
        if self.shine > 0.0 {
            ray.front.over([1.0; 3], self.shine);
        }
    }

    fn end_of_group(&mut self, group: i64, rays: &mut dyn Iterator<Item = RayOnPlane<'_>>) -> bool {
        for ray in rays {
            *self.sums.entry(ray.ray).or_default() += ray.own[0];
            ray.own[0] = 0.0;
        }
        self.ended.push(group);
        self.due = self.due.saturating_sub(1);
        self.due > 0
    }
}

/// A translucent ball, of which each sample inside has opacity 0.1.
fn translucent() -> Stage {
    let stage = Stage::regular(ball(16, 6.0), &[(0.0, [0.5, 0.25, 1.0], 0.0), (0.0, [0.5, 0.25, 1.0], 0.1)]);
    stage.step(0.5).with(|s| s.picture.size = [12, 9])
}

fn with(stage: &Stage, lines: Option<Fragments>, fog: &mut Fog) -> Shown {
    let mut shown = None;
    stage.render_by(|mut renderer| {
        renderer.merge(lines);
        let (picture, counts) = renderer.frame_with(fog, &|_| {});
        shown = Some(Shown { picture, counts });
        renderer
    });
    shown.unwrap()
}

/// An effect that changes nothing changes no bit and no count. It hears every group once, nearest first, after all of its
/// samples, and sees each visible sample of each ray.
#[test]
fn an_effect_sees_all_and_changes_nothing_by_itself() {
    for (stage, planes) in [(translucent(), 1), (translucent().with(|s| s.picture.samples = 2), 1), (translucent(), 4)]
    {
        let (mut fog, plain) = (Fog { planes, ..Fog::new() }, stage.render());
        let shown = with(&stage, None, &mut fog);
        assert_eq!(shown.bits(), plain.bits());
        assert_eq!(counted(&shown.counts), counted(&plain.counts));
        assert!(fog.late.lock().unwrap().is_empty());
        assert!(fog.ended.windows(2).all(|g| g[0] < g[1]), "{:?}", fog.ended);
        // (1 − 0.1)^n lets through what n samples leave, and Σα = 0.1·n.
        let n = stage.scene.picture.samples;
        let [width, height] = stage.scene.picture.size;
        for (i, pixel) in plain.pixels().iter().enumerate() {
            let parts = (0..n * n).map(|part| [i % width * n + part % n, i / width * n + part / n]);
            let opacity =
                parts.map(|ray| 1.0 - 0.9f64.powf(fog.sums.get(&ray).copied().unwrap_or(0.0) / 0.1)).sum::<f64>();
            assert!((pixel[3] - opacity / (n * n) as f64).abs() < 1e-12, "{i}: {} {opacity}", pixel[3]);
        }
        assert!(fog.sums.len() <= width * height * n * n);
        assert!(fog.sums.values().filter(|sum| **sum > 0.0).count() > 8 * n * n);
    }
}

/// The colour before a sample replaces its own; opacities stay.
#[test]
fn an_effect_tints_samples() {
    let (stage, mut fog) = (translucent(), Fog { tint: Some([0.0, 1.0, 0.0]), ..Fog::new() });
    let (plain, tinted) = (stage.render(), with(&stage, None, &mut fog));
    for (plain, tinted) in plain.pixels().iter().zip(tinted.pixels()) {
        assert_eq!(tinted, [0.0, plain[3], 0.0, plain[3]].map(|c| if c == 0.0 { 0.0 } else { tinted[3] }));
        assert_eq!(plain[3], tinted[3]);
    }
}

/// A plane that shines lies behind its samples, on rays without samples too. Groups beyond the last sample come as long as they
/// are due. Where the groups have as many planes in all, their size does not show.
#[test]
fn an_effect_lays_light_behind_planes() {
    let stage = translucent();
    let mut still = Fog::new();
    with(&stage, None, &mut still);
    for (planes, due) in [(1, 0), (1, 1000), (4, 250)] {
        let mut fog = Fog { planes, shine: 0.01, lays: true, due, ..Fog::new() };
        let shown = with(&stage, None, &mut fog);
        let groups = fog.ended.len();
        assert_eq!(groups, if due == 0 { still.ended.len() } else { due });
        assert!(fog.ended.windows(2).all(|g| g[1] == g[0] + 1));
        // In the corner nothing is but light: A = 1 − 0.99ⁿ, white.
        let corner = shown.pixels()[0];
        let wanted = 1.0 - 0.99f64.powi(groups as i32 * planes as i32);
        assert!(corner.iter().all(|c| (c - wanted).abs() < 1e-12), "{corner:?} {wanted}");
        // In the middle samples and light alternate.
        let middle = shown.pixels()[4 * 12 + 6];
        assert!(middle[3] > wanted && middle[1] < middle[2] && middle[1] > 0.0, "{middle:?}");
    }
}

/// A plane that shines so much that nothing behind it is seen ends its rays there: no sample behind it is taken.
#[test]
fn light_that_hides_all_ends_rays() {
    let stage = translucent();
    for planes in [1, 4] {
        let mut fog = Fog { planes, shine: 1.0, lays: true, ..Fog::new() };
        let shown = with(&stage, None, &mut fog);
        // Only rays with samples on the first plane take one.
        assert_eq!(fog.ended.len(), 1);
        assert!(shown.counts.samples < stage.render().counts.samples / 4, "{}", shown.counts.samples);
        assert!(shown.pixels().iter().all(|p| p[3] == 1.0));
    }
}
