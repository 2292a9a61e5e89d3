//! Projection of world segments onto the page: in front of the camera and inside the frame.

use drypoint_scene::glam::{DVec2, DVec3};
use drypoint_scene::marks::Page;
use drypoint_scene::marks::frame::clipped;
use drypoint_scene::space::Grid;
use drypoint_scene::view::View;

/// A projection from the world to a page.
#[derive(Clone, Copy, Debug)]
pub(super) struct PageProjection<'a> {
    view: &'a View,
    page: &'a Page,
    near: f64,
}

/// The part of a segment inside the frame. The parameter s runs along the segment on the page, from 0 to 1 at its
/// ends. In perspective an end beyond the plane at depth `near` is replaced by the crossing of this plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct ClippedSegment {
    /// Places on the page for s = 0 and 1, in mm.
    ends: [DVec2; 2],
    /// Parameters along the world segment for s = 0 and 1.
    world: [f64; 2],
    /// Depths for s = 0 and 1; 1 where rays are parallel.
    depths: [f64; 2],
    /// The range of s inside the frame.
    pub(super) range: [f64; 2],
    /// The length on the page from s = 0 to 1, in mm.
    pub(super) length: f64,
}

/// Returns the largest scale of a view in the volume, in mm of the page a world unit. `near` is the near distance of a
/// perspective camera, in world units.
pub fn largest_scale(view: &View, page: &Page, near: f64, grid: &Grid) -> f64 {
    let pixel = (page.size.x - 2.0 * page.margin) / view.size[0] as f64;
    let depths = grid.world_corners().map(|corner| -view.to_eye(corner).z);
    let nearest = if view.perspective { depths.into_iter().fold(f64::INFINITY, f64::min).max(near) } else { 1.0 };
    pixel / (view.pixel * nearest)
}

impl<'a> PageProjection<'a> {
    /// `near` is the near distance of a perspective camera, in world units.
    pub(super) fn new(view: &'a View, page: &'a Page, near: f64) -> Self {
        Self { view, page, near }
    }

    /// The place on the page of a point in eye space. `depth` is 1 where rays are parallel.
    fn on_page(&self, eye: DVec3, depth: f64) -> DVec2 {
        let size = DVec2::from(self.view.size.map(|n| n as f64));
        let off = DVec2::new(eye.x, -eye.y) / (self.view.pixel * depth);
        self.page.place(size / 2.0 + off, self.view.size)
    }

    /// The place on the page of a point of the world. Returns none outside the frame.
    pub(super) fn place(&self, world: DVec3) -> Option<DVec2> {
        let eye = self.view.to_eye(world);
        if self.view.perspective && -eye.z < self.near {
            return None;
        }
        let at = self.on_page(eye, if self.view.perspective { -eye.z } else { 1.0 });
        let margin = DVec2::splat(self.page.margin);
        (at.cmpge(margin).all() && at.cmple(self.page.size - margin).all()).then_some(at)
    }

    /// Clips a world segment to the frame, grown by `beyond` mm.
    pub(super) fn cut(&self, segment: [DVec3; 2], beyond: f64) -> Option<ClippedSegment> {
        let eye = segment.map(|p| self.view.to_eye(p));
        let mut world = [0.0, 1.0];
        let mut depths = [1.0; 2];
        if self.view.perspective {
            let depth = eye.map(|p| -p.z);
            let reaches = depth.map(|d| d >= self.near);
            if !(reaches[0] || reaches[1]) {
                return None;
            }
            let crossing = (self.near - depth[0]) / (depth[1] - depth[0]);
            for i in 0..2 {
                (world[i], depths[i]) = if reaches[i] { (world[i], depth[i]) } else { (crossing, self.near) };
            }
        }
        let ends = [0, 1].map(|i| {
            let at = if world[i] == i as f64 { eye[i] } else { eye[0].lerp(eye[1], world[i]) };
            self.on_page(at, depths[i])
        });
        let margin = self.page.margin - beyond;
        let range = inside(ends, DVec2::splat(margin), self.page.size - margin)?;
        let length = ends[0].distance(ends[1]);
        (length.is_finite()).then_some(ClippedSegment { ends, world, depths, range, length })
    }
}

impl ClippedSegment {
    /// The parameter along the world segment.
    pub(super) fn along_world(&self, s: f64) -> f64 {
        let [from, to] = self.world;
        if s == 0.0 {
            return from;
        }
        if s == 1.0 {
            return to;
        }
        // 1/depth is linear on the page.
        let [near, far] = [self.depths[0] * s, self.depths[1] * (1.0 - s)];
        from + (to - from) * (near / (near + far))
    }

    /// The place on the page.
    pub(super) fn on_page(&self, s: f64) -> DVec2 {
        if s == 1.0 { self.ends[1] } else { self.ends[0].lerp(self.ends[1], s) }
    }

    /// Whether s is the beginning of the unclipped segment.
    pub(super) fn is_start(&self, s: f64) -> bool {
        s == 0.0 && self.world[0] == 0.0
    }

    /// Whether s is the end of the unclipped segment.
    pub(super) fn is_end(&self, s: f64) -> bool {
        s == 1.0 && self.world[1] == 1.0
    }
}

/// The part of [0, 1] on which a segment lies in a rectangle.
fn inside([a, b]: [DVec2; 2], lo: DVec2, hi: DVec2) -> Option<[f64; 2]> {
    let sides = |axis: usize| [(a[axis] - lo[axis], b[axis] - lo[axis]), (hi[axis] - a[axis], hi[axis] - b[axis])];
    clipped((0..2).flat_map(sides))
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::space::Grid;
    use drypoint_scene::tables::{Camera, Projection};

    /// A view along −z on a page of 100 × 100 mm, an eye at z = 10 with a field of view of 90°.
    fn view(projection: Projection) -> View {
        let grid = Grid::with_spacing([3; 3], [1.0; 3]).unwrap();
        let (eye, target) = (Some(DVec3::new(0.0, 0.0, 10.0)), Some(DVec3::ZERO));
        let camera = Camera { projection, eye, target, up: DVec3::Y, ..Camera::default() };
        View::new(&camera, &grid, [100, 100]).unwrap()
    }

    fn page() -> Page {
        Page::in_millimetres(DVec2::splat(100.0), 5.0, 254.0)
    }

    #[test]
    fn a_piece_in_perspective() {
        let (view, page) = (view(Projection::Perspective { fov: 90.0 }), page());
        let onto = PageProjection::new(&view, &page, 1.0);
        // At depth 10 the frame is 20 wide, 5 mm a unit; at depth 5 it is 10 wide.
        let cut = onto.cut([DVec3::ZERO, DVec3::new(2.0, 1.0, 5.0)], 0.0).unwrap();
        let near = |a: DVec2, x: f64, y: f64| (a - DVec2::new(x, y)).length() < 1e-9;
        assert!(near(cut.on_page(0.0), 55.0, 55.0) && near(cut.on_page(1.0), 75.0, 45.0));
        // Halfway on the page: x/depth = 0.2 at x = 2t, depth = 10 − 5t, so that t = ⅔.
        assert!((cut.along_world(0.5) - 2.0 / 3.0).abs() < 1e-12);
        assert!(cut.is_start(0.0) && cut.is_end(1.0) && cut.range == [0.0, 1.0]);
        // A segment that passes the eye ends at depth 1, here three quarters along it.
        let cut = onto.cut([DVec3::new(0.0, 0.0, 7.0), DVec3::new(0.8, 0.0, 9.6)], 0.0);
        let cut = cut.unwrap();
        assert!(!cut.is_end(1.0) && (cut.along_world(1.0) - 2.0 / 2.6).abs() < 1e-12);
        assert!(near(cut.on_page(1.0), 55.0 + 50.0 * 0.8 * 2.0 / 2.6, 55.0));
        assert!(onto.cut([DVec3::new(0.0, 0.0, 9.5), DVec3::new(0.0, 0.0, 20.0)], 0.0).is_none());
    }

    #[test]
    fn the_frame_cuts() {
        let (view, page) = (view(Projection::Orthographic { height: None }), page());
        let onto = PageProjection::new(&view, &page, 1.0);
        let middle = onto.place(DVec3::new(0.0, 0.0, 50.0)).unwrap();
        assert!((middle - DVec2::splat(55.0)).length() < 1e-9);
        assert_eq!(onto.place(DVec3::new(f64::NAN, 0.0, 0.0)), None);
        let unit = 100.0 / (view.pixel * 100.0);
        let across = |x: f64| DVec3::new(x / unit, 0.0, 50.0);
        let cut = onto.cut([across(-100.0), across(100.0)], 0.0).unwrap();
        assert!((cut.range[0] - 0.25).abs() < 1e-12 && (cut.range[1] - 0.75).abs() < 1e-12);
        let cut = onto.cut([across(-100.0), across(100.0)], 20.0).unwrap();
        assert!((cut.range[0] - 0.15).abs() < 1e-12);
        assert!(onto.cut([across(60.0), across(80.0)], 0.0).is_none());
        assert!(onto.cut([across(f64::NAN), across(80.0)], 0.0).is_none());
    }
}
