//! Halos over many planes: closed forms that depend neither on the step nor on the size of groups ([HALO-7], [HALO-8]).

use crate::common::{Stage, corrected, orthographic, volume};
use drypoint::scene::glam::DVec3;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::tables::{Halo, HaloKind, Length, ProfileNode, SeedValue};

/// A rod of radius 6 along y, towards which the camera looks, and a wall behind it; the rod's values end at 100, the
/// wall has 200.
fn rod_before_a_wall(step: f64, halo: Halo) -> Stage {
    let field = volume([49, 40, 49], |p: DVec3| {
        let rod = 50.0 + 25.0 * (6.0 - (p - DVec3::new(24.0, p.y, 24.0)).length());
        let wall = 200.0 * (p.y - 29.5).clamp(0.0, 1.0);
        if p.y < 29.0 { rod.clamp(0.0, 100.0) } else { wall }
    });
    let nodes = [(120.0, [0.5, 0.5, 0.5], 0.0), (120.0, [0.5, 0.5, 0.5], 1.0)];
    Stage::regular(field, &nodes).with(|s| {
        s.camera = orthographic(Some(48.0));
        s.camera.direction = DVec3::Y;
        s.picture.size = [48, 48];
        s.sampling.step = Length::World(step);
        s.sampling.reference_length = Length::World(1.0);
        s.volume.gradient_range = drypoint::scene::tables::GradientRange::Fixed([0.0, 25.0]);
        s.halos = vec![halo];
    })
}

fn halo(kind: HaloKind, every: u64) -> Halo {
    let node = |at, opacity| ProfileNode { at, rgb: [1.0, 0.0, 0.0], opacity };
    let mut halo = Halo { kind, every, profile: vec![node(0.0, 0.0), node(1.0, 1.0)], ..Halo::default() };
    // The rod alone: the wall's edge is passed between two voxels, and faces the camera.
    halo.seed.value = Some(SeedValue::Nodes(vec![[20.0, 0.0], [30.0, 1.0], [70.0, 1.0], [80.0, 0.0]]));
    halo.accumulate = kind.accumulation();
    halo
}

/// The tint of the wall is that of the rod's H, whatever the step and the size of groups.
#[test]
fn the_tint_of_a_wall_depends_on_no_step() {
    let tint = |step: f64, every: u64| rod_before_a_wall(step, halo(HaloKind::Occlusive, every)).render();
    let truth = tint(1.0, 1).pixels();
    assert!(truth.iter().any(|p| p[0] > 0.8) && truth.iter().any(|p| p[0] == 0.5));
    for (step, every) in [(0.5, 1), (0.25, 1), (0.0625, 1), (0.5, 4), (0.25, 8)] {
        let pixels = tint(step, every).pixels();
        let apart = pixels.iter().zip(&truth).flat_map(|(a, b)| (0..4).map(move |c| (a[c] - b[c]).abs()));
        let worst = apart.fold(0.0, f64::max);
        assert!(worst < 1e-3, "Δ = {step}, M = {every}: {worst}");
    }
}

/// Beside the rod the glow is as opaque as its H over the length of the rod, less the group that begins it.
#[test]
fn a_glow_is_as_opaque_as_its_length() {
    for (step, every) in [(1.0, 1), (0.5, 1), (0.5, 4), (0.25, 8)] {
        let mut glow = halo(HaloKind::Emissive, every);
        glow.profile = vec![ProfileNode { at: 0.0, rgb: [1.0, 0.0, 0.0], opacity: 0.01 }];
        let stage = rod_before_a_wall(step, glow);
        // Nothing but the glow: the function shows nothing.
        let mut shot = stage.resolved(stage.view());
        shot.objects[0].function = std::sync::Arc::new(drypoint::scene::transfer::Function::nothing());
        let shown = stage.render_shot(&shot, |renderer| renderer);
        let largest = shown.pixels().iter().map(|p| p[3]).fold(0.0, f64::max);
        // Voxels of the rod end at 28, and gradients turn towards its end from 27 on.
        let [least, most] = [27.0 - step * every as f64, 29.0 + step * every as f64].map(|l| corrected(0.01, l));
        assert!(least < largest && largest < most, "Δ = {step}, M = {every}: {largest}, from {least} to {most}");
        // A constant profile has a sharp border: all of it or nothing, but where H fades at the ends of the rod.
        let all = shown.pixels().iter().filter(|p| p[3] > 0.9 * largest).count();
        let some = shown.pixels().iter().filter(|p| p[3] > 0.0).count();
        assert!(all > 300 && all * 10 > some * 9, "{all} of {some}");
    }
}

/// An occlusive halo leaves every pixel behind which nothing lies, an emissive one every pixel beyond its reach, to the bit.
#[test]
fn pixels_that_a_halo_cannot_reach() {
    let stage = |halo: Option<Halo>| {
        let field = volume([33, 17, 33], |p: DVec3| 8.0 - (p - DVec3::new(16.0, p.y, 16.0)).length());
        Stage::regular(field, &[(0.0, [0.5; 3], 0.0), (0.0, [0.5; 3], 0.8)]).with(|s| {
            s.camera.direction = DVec3::Y;
            s.picture.size = [64, 64];
            s.halos = halo.into_iter().collect();
        })
    };
    let plain = stage(None).render();
    let (before, covered) = (plain.bits(), plain.covered());
    let mut dark = halo(HaloKind::Occlusive, 1);
    dark.seed.value = None;
    dark.spread.passes = 3;
    let shown = stage(Some(dark.clone())).layers(&[LayerKind::Halo(0)]).render();
    // Beside the rod there is H, and nothing to tint.
    let h = shown.one(LayerKind::Halo(0));
    let beside = plain.pixels().iter().zip(&h).filter(|(p, h)| p[3] == 0.0 && **h > 0.1).count();
    assert!(beside > 50, "{beside}");
    for (pixel, dark) in plain.pixels().iter().zip(shown.pixels()).filter(|(p, _)| p[3] == 0.0) {
        assert_eq!(*pixel, dark);
    }
    let glow = Halo { kind: HaloKind::Emissive, ..dark };
    let bright = stage(Some(glow)).render();
    let (mut beyond, mut changed) = (0, 0);
    let pixels = plain.pixels();
    for (i, (pixel, with)) in pixels.iter().zip(bright.pixels()).enumerate() {
        let [x, y] = [i % 64, i / 64].map(|c| c as i64);
        // Seeds lie in pixels of the rod or next to them; the gradient and N = 3 passes reach 8 pixels farther.
        let near = pixels.iter().enumerate().any(|(j, p)| {
            let [u, v] = [j % 64, j / 64].map(|c| c as i64);
            p[3] > 0.0 && (u - x).abs() <= 10 && (v - y).abs() <= 10
        });
        if near {
            changed += usize::from(*pixel != with);
        } else {
            beyond += 1;
            assert_eq!(*pixel, with);
        }
    }
    assert!(beyond > 200 && changed > 200 && covered > 200, "{beyond} {changed} {covered} {}", before.len());
}
