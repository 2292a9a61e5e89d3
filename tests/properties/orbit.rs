//! A camera that is turned ([STIP-4]): nothing of another frame is left in a picture.

use super::generator::scene;
use crate::common::{Stage, largest_difference, on};
use drypoint::scene::glam::{DMat3, DVec3};
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{LightDirection, Orbit, Shading};

/// Away and back again is the picture that never moved, to the bit, with its counts; what lies between is another one.
#[test]
fn a_camera_comes_back_to_its_picture() {
    let mut moved = 0;
    for seed in 0..120 {
        let shot = scene(seed);
        let (first, grid) = (shot.view(), shot.volume.grid());
        let orbit = Orbit { frames: 5, degrees: 200.0, ..Orbit::default() };
        let away = orbit.view(&first, &shot.scene.camera, grid, 2);
        let still = shot.render();
        let turned = shot.render_turned(&[first.clone(), away, first].map(|view| shot.resolved(view)));
        for back in [&turned[0], &turned[2]] {
            assert_eq!(back.bits(), still.bits(), "{seed}");
            assert_eq!(back.counts.samples, still.counts.samples, "{seed}");
        }
        moved += usize::from(turned[1].bits() != still.bits());
    }
    assert!(moved > 40, "{moved}");
}

/// A camera that goes round the volume by 90° sees what a camera that stays sees of a volume that goes round by −90°:
/// with the lights of the eye and the camera's own, all but the rounding of positions.
#[test]
fn a_turned_camera_sees_a_turned_volume() {
    let field = |p: DVec3| {
        60.0 - (p - DVec3::new(5.0, 6.5, 5.5)).length_squared() + 6.0 * (0.7 * p.x).sin() * (0.5 * p.y).cos()
    };
    let grid = Grid::with_spacing([12; 3], [1.0; 3]).unwrap();
    let volume = on(grid.clone(), field);
    // About z through the centre: (x, y) to (y, −x).
    let back = DMat3::from_cols(DVec3::NEG_Y, DVec3::X, DVec3::Z);
    let centre = grid.centre();
    let turned = Grid::new([12; 3], back * grid.axes(), centre + back * (grid.origin() - centre)).unwrap();
    let turned = drypoint::scene::volume::Volume::new(turned, volume.voxels().clone(), 1.0, 0.0).unwrap();
    for light in [LightDirection::Head, LightDirection::Eye(DVec3::new(1.0, 2.0, 3.0))] {
        let shading = Some(Shading { light: Some(light), ..Shading::default() });
        // Nothing is seen where the box ends, which rounding can move across a sample.
        let nodes = [(40.0, [0.2, 0.5, 0.9], 0.0), (60.0, [0.9, 0.4, 0.1], 0.4)];
        let shot = |volume| {
            Stage::regular(volume, &nodes).with(|s| {
                s.shading = shading.clone();
                s.camera = crate::common::perspective(35.0);
                s.camera.target = Some(centre);
            })
        };
        let (shot, other) = (shot(volume.clone()), shot(turned.clone()));
        let orbit = Orbit { frames: 4, degrees: 360.0, ..Orbit::default() };
        let view = orbit.view(&shot.view(), &shot.scene.camera, &grid, 1);
        let seen = shot.render_turned(&[shot.resolved(view)]).remove(0);
        let still = other.render();
        assert!(seen.covered() > 40);
        // Positions of 10 voxels are off by 10⁻¹⁵ or so, and nothing here is steeper than 100 a voxel.
        assert!(largest_difference(&seen, &still) < 1e-11, "{}", largest_difference(&seen, &still));
        assert!(largest_difference(&seen, &shot.render()) > 1e-3);
    }
}
