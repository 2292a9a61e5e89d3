//! Points that an opaque iso-surface hides ([STIP-15]). The paper's points are transparent.

use super::curves::CurveSegment;
use super::ridge::across;
use crate::surface::IsoSurface;
use drypoint_scene::glam::DVec3;
use drypoint_scene::parallel;
use drypoint_scene::points::SurfacePoint;
use drypoint_scene::space::Grid;
use drypoint_scene::view::View;

/// The largest distance of a point from its foot on the surface, along the gradient of its voxel. The unit is the
/// extent of such a voxel along the gradient, which accounts for distant slices.
const REACH: f64 = 1.5;

/// δ of [HATCH-7]: the distance of the visibility test in front of the surface, in voxels of the volume.
const OFFSET: f64 = 0.15;

/// The reach of a point's foot, in world units. `of_points` is the grid in which points are made ([STIP-2]).
pub(super) fn reach(of_points: &Grid, normal: DVec3) -> f64 {
    REACH * across(of_points, normal)
}

/// Offset of tests from a surface in world units, signed towards the side of the eye.
pub(super) fn in_front(surface: &IsoSurface<'_, '_>, view: &View) -> f64 {
    OFFSET * surface.field().volume().grid().voxel() * surface.front(view)
}

/// A visibility test of points for one camera.
#[derive(Clone, Copy, Debug)]
pub(super) struct HiddenPoints<'a> {
    surface: &'a IsoSurface<'a, 'a>,
    view: &'a View,
    near: f64,
    /// See [`in_front`].
    offset: f64,
}

impl<'a> HiddenPoints<'a> {
    /// `near` is the near distance of a perspective camera.
    pub(super) fn new(surface: &'a IsoSurface<'a, 'a>, view: &'a View, near: f64) -> Self {
        Self { surface, view, near, offset: in_front(surface, view) }
    }

    /// Whether the surface hides a point.
    ///
    /// A point near the surface is tested at its foot, moved by δ in front. Otherwise its own distance would hide it
    /// behind the surface that it represents. A foot that a clip plane cuts away is none.
    pub(super) fn hides(&self, point: &SurfacePoint) -> bool {
        let &SurfacePoint { at, normal, reach } = point;
        let grid = self.surface.field().volume().grid();
        let foot = self.surface.foot(grid.to_index(at), normal, reach);
        let foot = foot.filter(|&foot| !self.surface.clip().cut(foot));
        let in_front = |foot| grid.to_world(foot) + self.surface.normal(foot).unwrap_or(normal) * self.offset;
        self.surface.hides(foot.map_or(at, in_front), self.view, self.near)
    }
}

/// Whether a surface hides a point, which is tested so far in front of its foot, in world units. `near` is the near distance
/// of a perspective camera.
pub fn hides(surface: &IsoSurface<'_, '_>, view: &View, near: f64, in_front: f64, point: &SurfacePoint) -> bool {
    HiddenPoints { surface, view, near, offset: in_front }.hides(point)
}

/// The segments of curves whose middle the surface does not hide. `of_points` is the grid in which they are made.
pub fn seen(
    mut segments: Vec<CurveSegment>,
    surface: &IsoSurface<'_, '_>,
    view: &View,
    near: f64,
    of_points: &Grid,
) -> Vec<CurveSegment> {
    let hidden = HiddenPoints::new(surface, view, near);
    let middle = |segment: &CurveSegment| SurfacePoint {
        at: (segment.ends[0] + segment.ends[1]) / 2.0,
        normal: segment.normal,
        reach: reach(of_points, segment.normal),
    };
    let hides = parallel::gather(segments.len(), 64, &|run, hides| {
        hides.extend(segments[run].iter().map(|segment| hidden.hides(&middle(segment))));
    });
    let mut hides = hides.into_iter();
    segments.retain(|_| hides.next() == Some(false));
    segments
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::{Field, Reconstruction, Rung};
    use drypoint_scene::clip::{ClipPlane, ClipPlanes};
    use drypoint_scene::math;
    use drypoint_scene::philox::uniform;
    use drypoint_scene::tables::{Camera, Projection};
    use drypoint_scene::volume::{Volume, Voxels};

    /// [STIP-15]'s oracle. All points within 1.5 voxels of a sphere with n·E > 0 are visible, and none with n·E <
    /// −√(2δ/R). E points towards the eye. With slices 2 apart the distance is 1.5 times a voxel's extent.
    #[test]
    fn a_sphere_shows_its_front() {
        shows_its_front(1);
        shows_its_front(2);
    }

    fn shows_its_front(slices: usize) {
        let (n, radius) = (41, 14.0);
        let centre = DVec3::splat(20.0);
        let grid = Grid::with_spacing([n, n, 40 / slices + 1], [1.0, 1.0, slices as f64]).unwrap();
        let at = |i: usize| DVec3::new((i % n) as f64, (i / n % n) as f64, (i / n / n * slices) as f64);
        let values = (0..grid.len()).map(|i| radius - (at(i) - centre).length()).collect();
        let volume = Volume::new(grid, Voxels::F64(values), 1.0, 0.0).unwrap();
        let field = Field::new(&volume, Reconstruction::default(), Rung::Gradient).unwrap();
        let surface = IsoSurface::new(&field, 0.0);
        let direction = DVec3::new(-0.3, 0.7, 0.4);
        let (mut front, mut back) = (0, 0);
        for projection in [Projection::Orthographic { height: None }, Projection::Perspective { fov: 40.0 }] {
            let camera = Camera { projection, direction, ..Camera::default() };
            let view = View::new(&camera, volume.grid(), [64, 64]).unwrap();
            let hidden = HiddenPoints::new(&surface, &view, 0.5);
            let near = |at, normal| SurfacePoint { at, normal, reach: reach(volume.grid(), normal) };
            // Between slices the surface lies below the sphere by as much as a chord does, more than between cubes.
            let below = (slices * slices - 1) as f64 / (8.0 * radius);
            let limit = -(2.0 * (OFFSET + below) / radius).sqrt();
            for i in 0..4000 {
                let draw = |k| 2.0 * uniform(11, [i, k, 0], 0) - 1.0;
                let n = DVec3::new(draw(0), draw(1), draw(2)).normalize();
                let point = centre + n * (radius + 1.3 * draw(3) * across(volume.grid(), n));
                let foot = centre + n * radius;
                let towards = if view.perspective { (view.eye - foot).normalize() } else { -view.forward };
                let hides = hidden.hides(&near(point, n));
                if n.dot(towards) > 0.0 {
                    assert!(!hides, "{}", n.dot(towards));
                    front += 1;
                } else if n.dot(towards) < limit {
                    assert!(hides, "{}", n.dot(towards));
                    back += 1;
                }
            }
            // A point without a foot is tested itself: inside the sphere it is hidden, in front of it it is visible.
            let hides = |along: f64| hidden.hides(&near(centre + direction.normalize() * along, DVec3::X));
            assert!(hides(1.0) && hides(18.0) && !hides(-18.0));
        }
        assert!(front > 2500 && back > 2500, "{front} {back}");
    }

    /// A ball is cut at x = 30 and seen along −x. A point of the solid behind the cut is hidden, although its foot on the
    /// ball lies before the cut. A point beside it, whose foot is left, is visible.
    #[test]
    fn a_foot_that_is_cut_away_is_none() {
        let (n, centre) = (41, DVec3::splat(20.0));
        let grid = Grid::with_spacing([n; 3], [1.0; 3]).unwrap();
        let at = |i: usize| DVec3::new((i % n) as f64, (i / n % n) as f64, (i / n / n) as f64);
        let values = (0..grid.len()).map(|i| 14.0 - (at(i) - centre).length()).collect();
        let volume = Volume::new(grid, Voxels::F64(values), 1.0, 0.0).unwrap();
        let field = Field::new(&volume, Reconstruction::default(), Rung::Gradient).unwrap();
        let planes = ClipPlanes(vec![ClipPlane::in_world(DVec3::splat(30.0), DVec3::X, volume.grid())]);
        let surface = IsoSurface::new(&field, 0.0).clipped(&planes);
        let projection = Projection::Orthographic { height: None };
        let camera = Camera { projection, direction: DVec3::NEG_X, ..Camera::default() };
        let view = View::new(&camera, volume.grid(), [64, 64]).unwrap();
        let hidden = HiddenPoints::new(&surface, &view, 0.5);
        let near = |at, normal| SurfacePoint { at, normal, reach: reach(volume.grid(), normal) };
        for (x, distance, expected) in [(29.9, 13.2, true), (29.0, 13.9, false)] {
            let across = f64::sqrt(distance * distance - (x - 20.0) * (x - 20.0));
            let out = DVec3::new(x - 20.0, across, 0.0);
            assert_eq!(hidden.hides(&near(centre + out, out.normalize())), expected, "{x}");
        }
    }

    /// A flat wall with the surface on both sides, 1.18 voxels from its middle. All points of voxels that face the
    /// eye are visible; none of the others are, although the other side may be nearer to a point.
    #[test]
    fn a_thin_wall_shows_one_side() {
        let (middle, iso) = (9.8, 0.5);
        let grid = Grid::with_spacing([5, 5, 20], [1.0; 3]).unwrap();
        let t = |z: f64| z - middle;
        let values = (0..grid.len()).map(|i| math::exp(-0.5 * t((i / 25) as f64).powi(2))).collect();
        let volume = Volume::new(grid, Voxels::F64(values), 1.0, 0.0).unwrap();
        let field = Field::new(&volume, Reconstruction::default(), Rung::Gradient).unwrap();
        let surface = IsoSurface::new(&field, iso);
        for direction in [DVec3::NEG_Z, DVec3::Z] {
            let camera =
                Camera { projection: Projection::Orthographic { height: None }, direction, ..Camera::default() };
            let view = View::new(&camera, volume.grid(), [64, 64]).unwrap();
            let hidden = HiddenPoints::new(&surface, &view, 0.5);
            let near = |at, normal| SurfacePoint { at, normal, reach: reach(volume.grid(), normal) };
            for i in 0..=40 {
                // Points of the voxels of the outer flanks lie up to half a voxel beyond their centres.
                let out = -0.25 + 2.5 * f64::from(i) / 40.0;
                for side in [1.0, -1.0] {
                    let (point, normal) = (DVec3::new(2.0, 2.0, middle + side * out), DVec3::Z * side);
                    assert_eq!(
                        hidden.hides(&near(point, normal)),
                        normal.dot(direction) > 0.0,
                        "{direction} {side} {out}"
                    );
                }
            }
        }
    }

    /// A surface that is a ridge without a gradient: its points lie in front of it along their voxels' normals.
    #[test]
    fn a_foot_without_a_normal_takes_the_voxels() {
        let grid = Grid::with_spacing([5, 5, 20], [1.0; 3]).unwrap();
        let values = (0..grid.len()).map(|i| 5.0 - ((i / 25) as f64 - 10.0).abs()).collect();
        let volume = Volume::new(grid, Voxels::F64(values), 1.0, 0.0).unwrap();
        let field = Field::new(&volume, Reconstruction::default(), Rung::Gradient).unwrap();
        let surface = IsoSurface::new(&field, 5.0);
        let camera = Camera {
            projection: Projection::Orthographic { height: None },
            direction: DVec3::NEG_Z,
            ..Camera::default()
        };
        let view = View::new(&camera, volume.grid(), [64, 64]).unwrap();
        let hidden = HiddenPoints::new(&surface, &view, 0.5);
        let near = |at, normal| SurfacePoint { at, normal, reach: reach(volume.grid(), normal) };
        assert!(surface.normal(DVec3::new(2.0, 2.0, 10.0)).is_none());
        for side in [1.0, -1.0] {
            let point = DVec3::new(2.0, 2.0, 10.0 + 0.3 * side);
            assert_eq!(hidden.hides(&near(point, DVec3::Z * side)), side < 0.0);
        }
    }
}
