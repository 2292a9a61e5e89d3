//! A camera that frames the content of a volume.

use super::content::{ContentRange, VolumeContent};
use super::extent::reach;
use drypoint_scene::glam::DVec3;
use drypoint_scene::math;
use drypoint_scene::volume::Volume;

/// Share of the picture's shorter side that the content takes.
const FILL: f64 = 0.86;

/// The position and the field of view of a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CameraFit {
    pub eye: DVec3,
    pub target: DVec3,
    /// Height of the picture at the target, in world units.
    pub height: f64,
    /// Extent of the content across the picture, in world units.
    pub extent: f64,
}

/// Finds the nearest perspective camera in a direction that frames and centres all content, and the surface `seen`
/// around it. The content fills the share [`FILL`] of the frame.
///
/// Let the content's points be at (x, y) across and z along the view, and t the half width of the frame at depth 1.
/// Then |x − a| ≤ t(d + z) requires d ≥ (x − a)/t − z and d ≥ (a − x)/t − z. The best a balances the two maxima.
pub(super) fn fit(
    volume: &Volume,
    body: &VolumeContent,
    seen: ContentRange,
    direction: DVec3,
    up: DVec3,
    fov: f64,
    size: [usize; 2],
) -> CameraFit {
    let grid = volume.grid();
    let forward = direction.normalize();
    let right = forward.cross(up).normalize();
    let up = right.cross(forward);
    let [width, height] = size.map(|n| n as f64);
    let tan = math::tan(fov.to_radians() / 2.0);
    // Both directions are limited to the same share of the shorter side.
    let t = FILL * tan * (width / height).min(1.0);
    let across = [right / t, -right / t, up / t, -up / t].map(|sideways| sideways - forward);
    let most = reach(volume, body, seen, across);
    let [towards, away] = reach(volume, body, seen, [-forward, forward]);
    let distance = ((most[0] + most[1]) / 2.0).max((most[2] + most[3]) / 2.0);
    let (a, b) = (t * (most[0] - most[1]) / 2.0, t * (most[2] - most[3]) / 2.0);
    // The eye lies at depth −distance. It stays outside the content, with a margin for a thin surface.
    let margin = (towards + away).clamp(0.05 * grid.voxel(), grid.voxel());
    let depth = (-distance).min(-towards - margin);
    let eye = right * a + up * b + forward * depth;
    let ahead = (grid.centre() - eye).dot(forward).max(grid.voxel());
    let extent = 2.0 * t * ((away - towards) / 2.0 - depth);
    CameraFit { eye, target: eye + forward * ahead, height: 2.0 * tan * ahead, extent }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::space::Grid;
    use drypoint_scene::tables::{Camera, Outside, Projection};
    use drypoint_scene::view::View;
    use drypoint_scene::volume::{Volume, Voxels};

    #[test]
    fn the_content_touches_the_frame_of_the_fill_and_is_centred() {
        // A box off the centre of its volume, seen over a corner.
        let n = 24;
        let inside =
            |i: usize| (3..9).contains(&(i % n)) && (5..20).contains(&(i / n % n)) && (10..14).contains(&(i / (n * n)));
        let voxels = (0..n * n * n).map(|i| if inside(i) { 200 } else { 10 }).collect();
        let grid = Grid::with_spacing([n; 3], [1.0, 1.0, 2.5]).unwrap();
        let volume = Volume::new(grid, Voxels::U8(voxels), 1.0, 0.0).unwrap();
        let direction = DVec3::new(-0.6, 1.0, -0.45);
        // The surface at the content's own value passes through its outermost voxels.
        let seen = ContentRange { value: 200.0, outside: Outside::Low };
        let body = VolumeContent::of(&volume, seen).unwrap();
        for size in [[400, 400], [600, 400], [300, 500]] {
            let fit = fit(&volume, &body, seen, direction, DVec3::Z, 30.0, size);
            let camera = Camera {
                projection: Projection::Perspective { fov: 30.0 },
                eye: Some(fit.eye),
                target: Some(fit.target),
                ..Camera::default()
            };
            let view = View::new(&camera, volume.grid(), size).unwrap();
            let (mut lo, mut hi) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
            for i in (0..n * n * n).filter(|&i| inside(i)) {
                // From the middle of the picture, in pixels.
                let p = DVec3::new((i % n) as f64, (i / n % n) as f64, (i / (n * n)) as f64);
                let e = view.to_eye(volume.grid().to_world(p));
                for (axis, across) in [e.x, e.y].into_iter().enumerate() {
                    let at = across / (view.pixel * -e.z);
                    lo[axis] = lo[axis].min(at);
                    hi[axis] = hi[axis].max(at);
                }
            }
            let short = size[0].min(size[1]) as f64;
            let share = ((hi[0] - lo[0]) / short).max((hi[1] - lo[1]) / short);
            assert!((share - FILL).abs() < 0.01, "{size:?}: {share}");
            // The content is 5 by 14 by 7.5 units, 16.6 across its corners, and is seen over one.
            assert!((7.5..16.6).contains(&fit.extent), "{}", fit.extent);
            // The wider of the two directions is centred exactly; the other by its own balance.
            let off = |axis: usize| ((lo[axis] + hi[axis]) / 2.0).abs() / short;
            assert!(off(0) < 0.03 && off(1) < 0.03, "{size:?}: {lo:?} {hi:?}");
        }
    }

    #[test]
    fn an_empty_volume_is_framed_whole() {
        let volume =
            Volume::new(Grid::with_spacing([4; 3], [1.0; 3]).unwrap(), Voxels::U8(vec![0; 64]), 1.0, 0.0).unwrap();
        let inside = ContentRange { value: 10.0, outside: Outside::Low };
        let body = VolumeContent::of(&volume, inside).unwrap();
        let fit = fit(&volume, &body, inside, DVec3::Y, DVec3::Z, 30.0, [100, 100]);
        assert!(fit.eye.is_finite() && fit.eye.y < 0.0);
    }
}
