//! Halos with what else is in a picture: opaque things, surfaces, lines, frames and several rays a pixel.

use super::{H, beauty, constant, crossing, dark, glow, largest};
use crate::common::rod::{of_the_rod, rod_before_a_wall};
use crate::common::{Stage, ball, largest_difference, orthographic, volume};
use crate::stability::{differing, worst};
use drypoint::scene::fragments::{Fragment, Fragments};
use drypoint::scene::glam::DVec3;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::tables::{
    Background, Halo, HaloKind, Iso, Length, Orbit, RaysPerPixel, SeedValue, Surface, SurfaceLook,
};

/// A slab of value −50 in front on the left, and a capsule of radius 4 behind it, of values up to 9, whose end is half
/// a voxel from the slab's edge.
fn capsule_behind_a_slab(opacity: f64) -> Stage {
    let field = volume([33, 25, 24], |p: DVec3| {
        if p.y <= 4.0 {
            return if p.x <= 12.0 { -50.0 } else { 0.0 };
        }
        let beyond = (p.x - 8.0).max(0.0);
        (5.0 + 4.0 - DVec3::new(beyond, p.y - 16.0, p.z - 11.5).length()).max(0.0)
    });
    let slab = [0.2, 0.5, 0.7];
    let nodes = [(-30.0, slab, opacity), (-30.0, slab, 0.0), (5.0, [0.7, 0.5, 0.3], 0.0), (6.0, [0.7, 0.5, 0.3], 0.3)];
    Stage::regular(field, &nodes).with(|s| {
        s.camera = orthographic(Some(24.0));
        s.camera.direction = DVec3::Y;
        s.picture.size = [66, 48];
        s.sampling.reference_length = s.sampling.step;
    })
}

pub(super) fn behind_a_slab() -> f64 {
    let seeds = |mut halo: Halo| {
        halo.seed.value = Some(SeedValue::Nodes(vec![[4.5, 0.0], [5.5, 1.0]]));
        halo
    };
    let of = |opacity: f64, epsilon: f64| {
        let stage = capsule_behind_a_slab(opacity).halos(&[seeds(glow()), seeds(dark())]);
        stage.with(|s| s.sampling.stop_below = epsilon).render()
    };
    let mut differ = 0.0;
    for epsilon in [0.0, 0.01] {
        let [opaque, clear] = [of(1.0, epsilon), of(0.1, epsilon)];
        // The slab reaches to x = 12.6, pixel 25, and all seeds to 12.5. Pixels from 26 on are beside both.
        let beside = |shown: &crate::common::Shown| {
            let channels = shown.picture.layers.iter().flat_map(|l| &l.channels);
            channels.flat_map(|c| (0..48 * 66).filter(|i| i % 66 >= 26).map(|i| c[i].to_bits())).collect::<Vec<_>>()
        };
        assert!(opaque.counts.samples < clear.counts.samples);
        let on_the_slab = |shown: &crate::common::Shown| shown.pixels()[24 * 66 + 10][3];
        assert!(on_the_slab(&opaque) == 1.0 && on_the_slab(&clear) < 1.0);
        let h = opaque.one(H)[24 * 66 + 26];
        assert!(h > 0.02, "{h}");
        differ += differing(&beside(&opaque), &beside(&clear));
    }
    differ
}

pub(super) fn cut_off() -> f64 {
    let stage = crossing().with(|s| {
        s.halos = vec![Halo { opacity: 0.8, ..glow() }, dark()];
        s.picture.background = Background::Color([1.0, 0.9, 0.8, 1.0]);
    });
    let whole = stage.render();
    let mut cut = 0;
    let worst = worst([1e-3, 0.01, 0.1, 0.5].map(|epsilon| {
        let shown = stage.with(|s| s.sampling.stop_below = epsilon).render();
        let difference = largest_difference(&whole, &shown);
        cut += usize::from(shown.counts.samples < whole.counts.samples && difference > 0.0);
        (difference - 1e-15).max(0.0) / epsilon
    }));
    assert!(cut >= 3, "{cut}");
    worst
}

pub(super) fn wall() -> f64 {
    let tint = |step: f64, every: u64| rod_before_a_wall(step, of_the_rod(HaloKind::Occlusive, every)).render();
    let truth = tint(1.0, 1);
    let pixels = truth.pixels();
    assert!(pixels.iter().any(|p| p[0] > 0.8) && pixels.iter().any(|p| p[0] == 0.5));
    let others = [(0.5, 1), (0.25, 1), (0.125, 1), (0.0625, 1), (0.5, 4), (0.25, 8)];
    worst(others.map(|(step, every)| largest_difference(&truth, &tint(step, every))))
}

/// A ball before another one on its right, as a white iso-surface, or without it.
fn surfaces(halos: &[Halo]) -> Stage {
    let field = volume([32, 24, 24], |p: DVec3| {
        let ball = |x: f64, y: f64, radius: f64| radius - (p - DVec3::new(x, y, 11.5)).length();
        ball(11.0, 6.0, 4.0).max(ball(19.0, 17.0, 6.0))
    });
    let stage = Stage::regular(field, &[]).with(|s| {
        s.transfer = None;
        s.surface = Some(Surface { iso: Iso::Value(0.0), look: SurfaceLook::White, ..Surface::default() });
        s.camera = orthographic(Some(20.0));
        s.camera.direction = DVec3::Y;
        s.picture.size = [48, 32];
    });
    stage.halos(halos)
}

pub(super) fn surface() -> f64 {
    let m = 0.5;
    let mut red = Halo { profile: constant(m), ..dark() };
    red.exponents = drypoint::scene::tables::Exponents::Numbers([0.125, 8.0]);
    let (plain, shown) = (surfaces(&[]).layers(&[LayerKind::Depth]).render(), surfaces(&[red]).render());
    assert!(plain.covered() > 200);
    let depths = plain.layer::<3>(LayerKind::Depth);
    let front = depths.iter().map(|d| d[0]).fold(f64::INFINITY, f64::min);
    let (mut tinted, mut off) = (0, 0.0f64);
    let all = shown.pixels().into_iter().zip(plain.pixels()).zip(shown.one(H)).zip(depths);
    for (((with, without), h), [depth, ..]) in all {
        let expected: [f64; 4] = std::array::from_fn(|c| match (without[3] > 0.0 && h > 0.0, c) {
            (false, _) => without[c],
            (true, 3) => 1.0,
            (true, c) => (1.0 - m) * without[c] + if c == 0 { m } else { 0.0 },
        });
        off = off.max(worst((0..4).map(|c| (with[c] - expected[c]).abs())));
        // The front ball is before all seeds of the other, and its own seeds lie behind what is seen of it.
        let is_front = depth < front + 3.0;
        tinted += usize::from(with != without && !is_front);
        off += f64::from(u8::from(with != without && depth < front + 2.0));
    }
    assert!(tinted > 20, "{tinted}");
    off
}

pub(super) fn lines() -> f64 {
    let line = Fragment { depth: 14.0, rgb: [0.1, 0.9, 0.2], opacity: 1.0 };
    let size = [48, 48];
    let found: Vec<_> = (0..48 * 48).map(|ray| (ray, line)).collect();
    let lines = Fragments::new(size, 1, &found);
    let m = 0.5;
    let of = |kind: HaloKind| {
        let halo = Halo { profile: constant(m), ..of_the_rod(kind, 1) };
        let halo = Halo { opacity: if kind == HaloKind::Emissive { 0.05 } else { 1.0 }, ..halo };
        // The wall is not shown.
        let stage = rod_before_a_wall(0.5, halo.clone()).halos(&[halo]).with_transfer(|t| {
            t.nodes.iter_mut().flatten().for_each(|node| node.opacity = 0.0);
        });
        (stage.render(), stage.render_among(&lines))
    };
    let (without, with) = of(HaloKind::Emissive);
    assert!(largest(&without.pixels().iter().map(|p| p[3]).collect::<Vec<_>>()) > 0.3);
    let covered = without.pixels().into_iter().zip(with.pixels()).map(|(without, with)| {
        let rest = 1.0 - without[3];
        worst((0..3).map(|c| (with[c] - (without[c] + rest * line.rgb[c])).abs())).max((with[3] - 1.0).abs())
    });
    let off = worst(covered);
    let (without, with) = of(HaloKind::Occlusive);
    assert!(without.covered() == 0 && without.one(H).iter().filter(|h| **h > 0.0).count() > 200);
    let tinted = with.pixels().into_iter().zip(with.one(H)).map(|(pixel, h)| {
        let m = if h > 0.0 { m } else { 0.0 };
        worst((0..3).map(|c| (pixel[c] - ((1.0 - m) * line.rgb[c] + if c == 0 { m } else { 0.0 })).abs()))
    });
    off.max(worst(tinted))
}

pub(super) fn orbit() -> f64 {
    let stage = crossing().halos(&[glow(), dark()]);
    let orbit = Orbit { frames: 5, degrees: 200.0, ..Orbit::default() };
    let views = [0, 1, 2, 3, 4].map(|i| orbit.view(&stage.view(), &stage.scene.camera, stage.volume.grid(), i));
    let shots = views.map(|view| stage.resolved(view));
    let turned = stage.render_turned(&shots);
    let mut differ = 0.0;
    for (shot, frame) in shots.iter().zip(&turned) {
        let alone = stage.render_shot(shot, |renderer| renderer);
        differ += differing(&alone.bits(), &frame.bits());
        differ += (alone.counts.halo_passes.abs_diff(frame.counts.halo_passes)) as f64;
        differ += (alone.counts.halo_samples.abs_diff(frame.counts.halo_samples)) as f64;
    }
    assert!(beauty(&turned[0]) != beauty(&turned[2]));
    differ
}

pub(super) fn several_rays() -> f64 {
    let of = |samples: usize, reach: f64, size: usize| {
        let mut halos = [glow(), dark()];
        halos.iter_mut().for_each(|halo| halo.spread.reach = Some(Length::Pixels(reach)));
        let stage = crossing().halos(&halos).with(|s| {
            s.picture.size = [size; 2];
            s.picture.samples = RaysPerPixel::Across(samples);
        });
        stage.render()
    };
    worst([2, 3].map(|n| {
        // q = 1.2: 18 pixels of N = 4, and n times as many of as many rays.
        let (several, single) = (of(n, 18.0, 16), of(1, 18.0 * n as f64, 16 * n));
        assert!(largest(&several.one(H)) > 0.1);
        let (pixels, rays) = (several.pixels(), single.pixels());
        worst((0..16 * 16).flat_map(|i| {
            let inside = |j: usize| (i / 16 * n + j / n) * 16 * n + i % 16 * n + j % n;
            let mean = |c: usize| (0..n * n).map(|j| rays[inside(j)][c]).sum::<f64>() / (n * n) as f64;
            (0..4).map(|c| (pixels[i][c] - mean(c)).abs()).collect::<Vec<_>>()
        }))
    }))
}

/// A ball that seeds has its own halo nowhere on what is seen of its front.
#[test]
fn a_ball_alone_is_not_tinted_where_it_faces_the_eye() {
    let stage = Stage::regular(ball(20, 6.0), &[(0.0, [0.5; 3], 0.0), (0.0, [0.5; 3], 1.0)]).with(|s| {
        s.camera = orthographic(Some(18.0));
        s.camera.direction = DVec3::Y;
        s.picture.size = [36, 36];
    });
    let (plain, dark) = (stage.render(), stage.halos(&[dark()]).render());
    let middle = |shown: &crate::common::Shown| shown.pixels()[18 * 36 + 18];
    assert_eq!(middle(&plain), middle(&dark));
}
