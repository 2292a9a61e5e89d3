//! One clip plane, in world and in index space.

use crate::space::Grid;
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// A plane that cuts away the side to which its normal points. Places on the plane itself are kept.
///
/// A plane's normal is covariant: world = D·index + origin turns n in world space into Dᵀn in index space.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ClipPlane {
    /// n, of length 1 in world space.
    pub normal: DVec3,
    /// n·p of the places p on the plane, in world units.
    pub offset: f64,
    /// m in index space, of any length.
    pub index_normal: DVec3,
    /// m·p of the places p on the plane.
    pub index_offset: f64,
    /// The cap that cuts show, by its index among the caps of the picture; none: cuts show the volume itself.
    pub cap: Option<usize>,
}

impl ClipPlane {
    /// The plane through a point with a normal, both in world space. The normal is not 0.
    pub fn in_world(point: DVec3, normal: DVec3, grid: &Grid) -> Self {
        let n = shortened(normal).normalize();
        let m = grid.axes().transpose() * n;
        Self {
            normal: n,
            offset: dot(n, point),
            index_normal: m,
            index_offset: dot(n, point - grid.origin()),
            cap: None,
        }
    }

    /// The plane through a point with a normal, both in index space. The normal is not 0.
    pub fn in_index(point: DVec3, normal: DVec3, grid: &Grid) -> Self {
        let m = shortened(normal);
        let n = (grid.inverse_axes().transpose() * m).normalize();
        Self {
            normal: n,
            offset: dot(n, grid.to_world(point)),
            index_normal: m,
            index_offset: dot(m, point),
            cap: None,
        }
    }

    /// Returns the plane in the index space of another grid.
    pub fn on(&self, grid: &Grid) -> Self {
        let index_offset = self.offset - dot(self.normal, grid.origin());
        Self { index_normal: grid.axes().transpose() * self.normal, index_offset, ..self.clone() }
    }

    /// m·p − m·q for a place p and the places q on the plane, in index space. It is above 0 on the cut side.
    #[inline]
    pub fn beyond(&self, index: DVec3) -> f64 {
        dot(self.index_normal, index) - self.index_offset
    }

    /// The signed distance of a place from the plane, in world units. It is above 0 on the cut side.
    #[inline]
    pub fn beyond_in_world(&self, world: DVec3) -> f64 {
        dot(self.normal, world) - self.offset
    }

    /// Whether the plane cuts away a part of a grid's box.
    ///
    /// Rounded products and sums are monotonic in each coordinate. So the corners of the box bound every place in it,
    /// to the last bit.
    pub fn cuts_box(&self, grid: &Grid) -> bool {
        let [lo, hi] = grid.index_box();
        let farthest = DVec3::select(self.index_normal.cmpgt(DVec3::ZERO), hi, lo);
        self.beyond(farthest) > 0.0
    }
}

/// A vector divided by its largest component, so that neither lengths nor products overflow.
fn shortened(v: DVec3) -> DVec3 {
    v / v.abs().max_element()
}

/// a·b, with the sums in the order of the axes.
#[inline]
fn dot(a: DVec3, b: DVec3) -> f64 {
    a.x * b.x + a.y * b.y + a.z * b.z
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DMat3;

    /// A sheared grid of spacing 2, 1 and 3 with an offset.
    fn sheared() -> Grid {
        let axes = DMat3::from_cols(DVec3::new(2.0, 0.0, 0.0), DVec3::new(0.5, 1.0, 0.0), DVec3::new(0.0, 0.25, 3.0));
        Grid::new([9, 7, 5], axes, DVec3::new(10.0, -4.0, 1.0)).unwrap()
    }

    /// In a sheared grid a plane of index space keeps its points, and its world normal is no axis of the grid.
    #[test]
    fn normals_are_covariant() {
        let grid = sheared();
        let plane = ClipPlane::in_index(DVec3::new(3.0, 0.0, 0.0), DVec3::new(5.0, 0.0, 0.0), &grid);
        for index in [[3.0, 0.0, 0.0], [3.0, 6.0, 0.0], [3.0, 2.5, 4.0]].map(DVec3::from_array) {
            assert_eq!(plane.beyond(index), 0.0);
            assert!(plane.beyond_in_world(grid.to_world(index)).abs() < 1e-13);
        }
        // By hand: the rows of D⁻¹ are (½, −¼, 1/48), …; the first one is the normal.
        let expected = DVec3::new(0.5, -0.25, 1.0 / 48.0).normalize();
        assert!((plane.normal - expected).length() < 1e-15, "{}", plane.normal);
        // The same plane given in the world.
        let world = ClipPlane::in_world(grid.to_world(DVec3::new(3.0, 1.0, 2.0)), expected * 7.0, &grid);
        assert!((world.offset - plane.offset).abs() < 1e-13);
        for index in [[2.0, 1.0, 1.0], [4.0, 6.0, 0.0], [8.0, 0.0, 3.0]].map(DVec3::from_array) {
            let distances = [world.beyond_in_world(grid.to_world(index)), plane.beyond_in_world(grid.to_world(index))];
            assert!((distances[0] - distances[1]).abs() < 1e-13, "{distances:?}");
            assert_eq!(world.beyond(index) > 0.0, plane.beyond(index) > 0.0, "{index}");
        }
    }

    #[test]
    fn a_plane_cuts_a_box_where_it_reaches_into_it() {
        let grid = Grid::with_spacing([5, 5, 5], [1.0; 3]).unwrap();
        let cuts = |x: f64, normal: f64| {
            ClipPlane::in_world(DVec3::new(x, 9.0, -3.0), DVec3::new(normal, 0.0, 0.0), &grid).cuts_box(&grid)
        };
        assert_eq!([cuts(4.0, 1.0), cuts(3.9, 1.0), cuts(-1.0, 1.0)], [false, true, true]);
        assert_eq!([cuts(0.0, -1.0), cuts(0.1, -1.0), cuts(5.0, -1.0)], [false, true, true]);
        // Normals and points of any size.
        let far = ClipPlane::in_world(DVec3::splat(1e308), DVec3::splat(1e308), &grid);
        assert!((far.normal.length() - 1.0).abs() < 1e-15 && !far.cuts_box(&grid));
        assert!(ClipPlane::in_index(DVec3::splat(-1e308), DVec3::splat(1e-320), &grid).cuts_box(&grid));
    }
}
