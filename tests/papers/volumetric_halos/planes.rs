//! Halos over many planes: closed forms that depend neither on the step nor on the size of groups ([HALO-7], [HALO-8]). The
//! tint of a wall is a hard case, in `tests/hard_cases/halos`.

use crate::common::rod::{of_the_rod, rod_before_a_wall};
use crate::common::{Stage, corrected, volume};
use drypoint::scene::glam::DVec3;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::tables::{Halo, HaloKind, ProfileNode};

/// Beside the rod the glow is as opaque as its H over the length of the rod, less the group that begins it.
#[test]
fn a_glow_is_as_opaque_as_its_length() {
    for (step, every) in [(1.0, 1), (0.5, 1), (0.5, 4), (0.25, 8)] {
        let mut glow = of_the_rod(HaloKind::Emissive, every);
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
    let mut dark = of_the_rod(HaloKind::Occlusive, 1);
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
