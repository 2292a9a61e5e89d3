//! Limits of every parameter, and pictures in which nothing or everything seeds.

use super::{H, beauty, constant, crossing, dark, glow, largest, linear};
use crate::common::{Stage, corrected, on, orthographic, volume};
use crate::stability::{differing, worst};
use drypoint::scene::glam::DVec3;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{Exponents, GradientRange, Halo, HaloSource, Length, SeedValue};

pub(super) fn underflow() -> f64 {
    let halo = Halo { exponents: Exponents::Printed, floor: 0.0, profile: constant(0.5), ..glow() };
    let of = |range: f64| {
        crossing()
            .with(|s| s.volume.gradient_range = GradientRange::Fixed([0.0, range]))
            .halos(std::slice::from_ref(&halo))
    };
    let outside = |stage: &Stage| {
        let shown = stage.render();
        let numbers = shown.picture.layers.iter().flat_map(|l| l.channels.iter().flatten());
        numbers.filter(|v| !(0.0..=1.0).contains(*v)).count() as f64
    };
    assert!(largest(&of(1.0).render().one(H)) > 1e-3);
    let plain = crossing().render();
    let (vanished, tiny) = (of(1e12), of(1e10));
    differing(&beauty(&vanished.render()), &beauty(&plain)) + outside(&vanished) + outside(&tiny)
}

pub(super) fn no_normal() -> f64 {
    let grid = Grid::with_spacing([12; 3], [1.0; 3]).unwrap();
    let ulps = 64.0 * 2f64.powi(-43);
    let flat = [on(grid.clone(), |_| 1000.0), on(grid, |p| 1000.0 + ulps * p.x)];
    flat.into_iter()
        .map(|flat| {
            let stage = Stage::regular(flat, &[(0.0, [0.5, 0.4, 0.3], 0.2)]);
            let halo = |halo: Halo| Halo { exponents: Exponents::Numbers([0.0, 0.0]), floor: 0.0, ..halo };
            let shown = stage.halos(&[halo(glow()), halo(dark())]).render();
            assert!(shown.counts.halo_samples > 0 && shown.counts.gradients > 0);
            differing(&beauty(&shown), &beauty(&stage.render())) + shown.counts.halo_passes as f64
        })
        .sum()
}

/// A ball of radius 4, 8 pixels, in the middle of 64 × 64, on one plane through its middle.
fn one_plane(step: f64) -> Stage {
    let centre = DVec3::splat(7.5);
    let ball = volume([16; 3], |p| 4.0 - (p - centre).length());
    Stage::regular(ball, &[(0.0, [0.5; 3], 0.0), (1.0, [0.5; 3], 0.3)]).step(step).with(|s| {
        s.camera = orthographic(Some(32.0));
        s.camera.direction = DVec3::Y;
        s.camera.direction_given = true;
        // The plane k = 0 passes at y = 7.5.
        s.camera.eye = Some(centre - DVec3::Y * (0.5 * step));
        s.picture.size = [64, 64];
    })
}

/// A field of which every sample seeds with the same strength, in the guard band of up to 9 pixels too.
fn evenly(seed: f64) -> (Stage, Halo) {
    let ramp = volume([24; 3], |p| p.x);
    let mut halo = Halo { exponents: Exponents::Numbers([0.0, 0.0]), floor: 0.0, opacity: 1.0, ..glow() };
    halo.seed.value = Some(SeedValue::Nodes(vec![[0.0, seed]]));
    halo.spread.from = HaloSource::Seeds;
    let stage = Stage::regular(ramp, &[(0.0, [0.5; 3], 0.1)]).with(|s| {
        s.camera = orthographic(Some(8.0));
        s.camera.direction = DVec3::Y;
        s.sampling.step = Length::World(0.5);
        s.sampling.reference_length = Length::World(1.0);
    });
    (stage, halo)
}

pub(super) fn all_of_delta() -> f64 {
    let mut off = 0.0;
    for (seed, delta) in [(0.01, 1.0), (0.3, 1.0), (0.9, 1.0), (1.0, 1.0), (0.3, 0.8), (0.5, 0.0)] {
        for passes in 0..=3 {
            let (stage, mut halo) = evenly(seed);
            (halo.spread.passes, halo.spread.delta) = (passes, delta);
            let expected: f64 = (0..=passes as i32).map(|j| seed * (delta * (1.0 - seed)).powi(j)).sum();
            let h = stage.halos(&[halo]).render().one(H);
            off = worst([off, worst(h.iter().map(|h| (h - expected).abs()))]);
        }
    }
    let of = |delta: f64| {
        let mut halo = Halo { floor: 0.0, ..glow() };
        halo.spread.delta = delta;
        crossing().halos(&[halo]).render().one(H)
    };
    let images = [0.0, 0.3, 0.7, 1.0].map(of);
    assert!(largest(&images[3]) > 0.3);
    let outside = images.iter().flatten().filter(|h| !(0.0..=1.0).contains(*h)).count();
    let falls = images.windows(2).flat_map(|pair| pair[0].iter().zip(&pair[1])).filter(|(a, b)| a > b).count();
    off + (outside + falls) as f64
}

pub(super) fn no_passes() -> f64 {
    let with = |passes: u64, delta: f64| {
        let mut halos = [glow(), dark()];
        for halo in &mut halos {
            (halo.spread.passes, halo.spread.delta) = (passes, delta);
        }
        crossing().halos(&halos).render()
    };
    let (none, still) = (with(0, 0.7), with(4, 0.0));
    assert!(largest(&none.one(H)) > 0.1);
    differing(&none.bits(), &still.bits())
}

pub(super) fn smaller_than_the_reach() -> f64 {
    let mut halos = [glow(), dark()];
    halos.iter_mut().for_each(|halo| halo.spread.passes = 5);
    let of = |height: f64, size: [usize; 2]| {
        let stage = crossing().halos(&halos).with(|s| {
            let direction = s.camera.direction;
            s.camera = orthographic(Some(height));
            s.camera.direction = direction;
            s.picture.size = size;
        });
        stage.render()
    };
    let (whole, crop) = (of(32.0, [64, 64]), of(1.0, [4, 2]));
    let mut differ = 0.0;
    for (large, small) in whole.picture.layers.iter().zip(&crop.picture.layers) {
        for (large, small) in large.channels.iter().zip(&small.channels) {
            let cut: Vec<f64> = (31..33).flat_map(|y| large[y * 64 + 30..y * 64 + 34].iter().copied()).collect();
            let [cut, small] = [&cut, small].map(|v| v.iter().map(|x| x.to_bits()).collect::<Vec<_>>());
            differ += differing(&cut, &small);
        }
    }
    assert!(largest(&crop.one(H)) > 0.05);
    differ
}

pub(super) fn all_zero() -> f64 {
    let mut differ = 0.0;
    for skip in [true, false] {
        let stage = crossing().with(|s| s.sampling.skip_empty = skip);
        for nodes in [vec![[0.0, 0.0]], vec![[1000.0, 0.0], [1001.0, 1.0]]] {
            let seedless = |mut halo: Halo| {
                halo.seed.value = Some(SeedValue::Nodes(nodes.clone()));
                halo
            };
            let shown = stage.halos(&[seedless(glow()), seedless(dark())]).render();
            assert_eq!(shown.counts.halo_samples > 0, !skip);
            differ += differing(&beauty(&shown), &beauty(&stage.render())) + shown.counts.halo_passes as f64;
            differ += (largest(&shown.one(H)) > 0.0) as u64 as f64;
        }
    }
    differ
}

pub(super) fn all_one() -> f64 {
    let alpha = 0.01;
    let (stage, halo) = evenly(1.0);
    let of = |from: HaloSource| {
        let mut halo = Halo { profile: linear(alpha), ..halo.clone() };
        (halo.spread.from, halo.spread.passes) = (from, 2);
        stage.halos(&[halo])
    };
    let with = of(HaloSource::Gradient).render();
    assert!(with.counts.halo_passes > 0);
    let differ = differing(&beauty(&with), &beauty(&stage.render()));
    // 46 planes lie in 23 voxels. Each but the first has a glow behind it, and so has the plane after the last.
    let alone = of(HaloSource::Seeds).render_halos_alone();
    let expected = corrected(alpha, 23.0);
    worst(alone.pixels().iter().map(|p| (p[3] - expected).abs())) + differ
}

pub(super) fn not_seen() -> f64 {
    let plain = crossing().render();
    let mut differ = 0.0;
    for every in [1, 3] {
        let stage = crossing().halos(&[Halo { every, ..glow() }, Halo { every, ..dark() }]);
        let mut shot = stage.resolved(stage.view());
        shot.halos.list.iter_mut().for_each(|halo| halo.opacity = 0.0);
        let shown = stage.render_shot(&shot, |renderer| renderer);
        assert!(shown.counts.halo_passes > 0);
        differ += differing(&beauty(&shown), &beauty(&plain));
        assert!(beauty(&stage.render()) != beauty(&plain));
    }
    differ
}

pub(super) fn far_apart() -> f64 {
    let a = 0.25_f64;
    let light = Halo { profile: constant(a), opacity: 1.0, ..glow() };
    let mut off = 0.0f64;
    // A plane through the ball, and none in the box.
    for moved in [0.0, 100.0] {
        let stage = one_plane(1000.0).with(|s| s.camera.eye = s.camera.eye.map(|eye| eye + DVec3::Y * moved));
        let plain = stage.render();
        let dark = stage.halos(&[Halo { profile: constant(a), ..dark() }]).render();
        off += differing(&beauty(&dark), &beauty(&plain));
        for every in [1, 4] {
            let shown = stage.halos(&[Halo { every: every as u64, ..light.clone() }]).render();
            let h = shown.one(H);
            assert_eq!(h.iter().any(|h| *h > 0.0), moved == 0.0, "{moved} {every}");
            // A group of one seeded plane glows behind each of the planes of the next one.
            let behind = 1.0 - (1.0 - a).powi(every);
            let pairs = shown.pixels().into_iter().zip(plain.pixels()).zip(h);
            off = off.max(worst(pairs.map(|((with, plain), h)| {
                let expected = if h > 0.0 { 1.0 - (1.0 - plain[3]) * (1.0 - behind) } else { plain[3] };
                (with[3] - expected).abs()
            })));
        }
        assert_eq!(plain.covered() > 0, moved == 0.0);
        assert_eq!(plain.picture.layer(LayerKind::Beauty).unwrap().channels.len(), 4);
    }
    off
}
