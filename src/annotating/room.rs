//! Room in the margin of a picture: the rectangles that a legend, a scale bar and directions take.

use drypoint_scene::glam::DVec2;
use drypoint_scene::marks::Page;
use drypoint_scene::tables::Corner;

/// The rectangles of a picture that are taken. No two of them overlap, and none leaves the picture.
pub(super) struct MarginRoom {
    /// Upper left and lower right corner of the picture, in mm.
    picture: [DVec2; 2],
    /// The upper left and the lower right corner of each rectangle, in mm.
    pub(super) taken: Vec<[DVec2; 2]>,
}

impl MarginRoom {
    pub(super) fn new(page: &Page) -> Self {
        Self { picture: page.frame(), taken: Vec::new() }
    }

    /// Takes a box in a corner, at a distance from the picture's edges. Where something stands already, the box stands
    /// beyond it, at the same distance, on the way down from an upper corner or up from a lower one.
    ///
    /// Returns the upper left corner of the box. Returns none if there is no room.
    pub(super) fn in_corner(&mut self, corner: Corner, size: DVec2, inset: f64) -> Option<DVec2> {
        let [lo, hi] = [self.picture[0] + inset, self.picture[1] - inset - size];
        let is_left = matches!(corner, Corner::TopLeft | Corner::BottomLeft);
        let is_top = matches!(corner, Corner::TopLeft | Corner::TopRight);
        let mut at = DVec2::new(if is_left { lo.x } else { hi.x }, if is_top { lo.y } else { hi.y });
        while at.cmpge(lo).all() && at.cmple(hi).all() {
            let Some([low, high]) = self.met([at, at + size]) else {
                self.taken.push([at, at + size]);
                return Some(at);
            };
            // Each step leads beyond one more rectangle.
            at.y = if is_top { high.y + inset } else { low.y - inset - size.y };
        }
        None
    }

    /// Takes a rectangle if it is free and inside the picture, and tells whether it does.
    pub(super) fn take(&mut self, rectangle: [DVec2; 2]) -> bool {
        let is_inside = rectangle[0].cmpge(self.picture[0]).all() && rectangle[1].cmple(self.picture[1]).all();
        let is_free = is_inside && self.met(rectangle).is_none();
        self.taken.extend(is_free.then_some(rectangle));
        is_free
    }

    /// A rectangle that is taken and overlaps another one.
    fn met(&self, [a, b]: [DVec2; 2]) -> Option<[DVec2; 2]> {
        self.taken.iter().copied().find(|[c, d]| a.cmplt(*d).all() && c.cmplt(b).all())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::philox::uniforms;

    const CORNERS: [Corner; 4] = [Corner::TopLeft, Corner::TopRight, Corner::BottomLeft, Corner::BottomRight];

    fn room() -> MarginRoom {
        MarginRoom::new(&Page::in_millimetres(DVec2::new(100.0, 80.0), 0.0, 100.0))
    }

    #[test]
    fn rectangles_of_the_margin_lie_apart_and_inside() {
        let mut without = 0;
        for scene in 0..2000 {
            let mut room = room();
            for i in 0..5 {
                let [width, height, corner, inset] = uniforms(12, [scene, i, 0], 0);
                let size = DVec2::new(1.0 + 70.0 * width, 1.0 + 40.0 * height);
                let is_free = match i {
                    4 => room.take([DVec2::new(45.0, 2.0), DVec2::new(45.0, 2.0) + size / 10.0]),
                    _ => room.in_corner(CORNERS[(4.0 * corner) as usize], size, 4.0 * inset).is_some(),
                };
                // The first thing has room wherever it fits.
                assert!(is_free || i > 0);
                without += usize::from(!is_free);
            }
            for (i, [a, b]) in room.taken.iter().enumerate() {
                assert!(a.cmpge(DVec2::ZERO).all() && b.cmple(DVec2::new(100.0, 80.0)).all(), "{scene}");
                let overlap = |[c, d]: &[DVec2; 2]| a.cmplt(*d).all() && c.cmplt(*b).all();
                assert!(!room.taken[..i].iter().any(overlap), "{scene}");
            }
        }
        assert!((500..4000).contains(&without), "{without}");
    }

    /// Three boxes of one corner stand on top of each other, from the corner on.
    #[test]
    fn boxes_of_one_corner_are_stacked() {
        let size = DVec2::new(20.0, 10.0);
        for (corner, heights) in
            CORNERS.into_iter().zip([[2.0, 14.0, 26.0], [2.0, 14.0, 26.0], [68.0, 56.0, 44.0], [68.0, 56.0, 44.0]])
        {
            let mut room = room();
            let x = if matches!(corner, Corner::TopLeft | Corner::BottomLeft) { 2.0 } else { 78.0 };
            assert_eq!(heights.map(|_| room.in_corner(corner, size, 2.0)), heights.map(|y| Some(DVec2::new(x, y))));
        }
    }

    #[test]
    fn boxes_that_are_too_large_take_nothing() {
        let mut room = room();
        for size in [[97.0, 10.0], [10.0, 77.0], [f64::INFINITY, 1.0], [1.0, f64::NAN]] {
            assert_eq!(room.in_corner(Corner::TopLeft, DVec2::from(size), 2.0), None);
        }
        assert!(!room.take([DVec2::new(-1.0, 2.0), DVec2::new(4.0, 4.0)]) && room.taken.is_empty());
        assert!(room.in_corner(Corner::TopLeft, DVec2::new(96.0, 76.0), 2.0).is_some());
    }
}
