//! A rod along the view axis, whose seeds are the same on every plane, before a wall.

use super::{Stage, orthographic, volume};
use drypoint::scene::glam::DVec3;
use drypoint::scene::tables::{GradientRange, Halo, HaloKind, Length, ProfileNode, SeedValue};

/// A rod of radius 6 along y, towards which the camera looks, and a wall behind it; the rod's values end at 100, the
/// wall has 200.
pub(crate) fn rod_before_a_wall(step: f64, halo: Halo) -> Stage {
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
        s.volume.gradient_range = GradientRange::Fixed([0.0, 25.0]);
        s.halos = vec![halo];
    })
}

/// A halo of the rod alone: the wall's edge is passed between two voxels, and faces the camera.
pub(crate) fn of_the_rod(kind: HaloKind, every: u64) -> Halo {
    let node = |at, opacity| ProfileNode { at, rgb: [1.0, 0.0, 0.0], opacity };
    let mut halo = Halo { kind, every, profile: vec![node(0.0, 0.0), node(1.0, 1.0)], ..Halo::default() };
    halo.seed.value = Some(SeedValue::Nodes(vec![[20.0, 0.0], [30.0, 1.0], [70.0, 1.0], [80.0, 0.0]]));
    halo.accumulate = kind.accumulation();
    halo
}
