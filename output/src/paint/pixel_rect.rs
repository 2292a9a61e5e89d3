//! The pixels that a mark can touch.

use super::PageWindow;
use crate::raster::CoverageMask;
use drypoint_scene::glam::DVec2;
use drypoint_scene::marks::Piece;

/// A rectangle of pixels that contains everything that pieces or outlines can touch, and one pixel around it.
pub(super) struct PixelRect {
    pub(super) left: usize,
    pub(super) top: usize,
    pub(super) columns: usize,
    pub(super) rows: usize,
    pub(super) picture: [usize; 2],
}

impl PixelRect {
    /// Returns the rectangle around pieces; none if it lies outside the picture.
    pub(super) fn around(pieces: &[Piece], window: &PageWindow, picture: [usize; 2]) -> Option<Self> {
        Self::of(pieces.iter().map(|piece| (&piece.points[..], piece.largest_radius())), window, picture)
    }

    /// Returns the rectangle around outlines; none if it lies outside the picture.
    pub(super) fn around_outlines(outlines: &[Vec<DVec2>], window: &PageWindow, picture: [usize; 2]) -> Option<Self> {
        Self::of(outlines.iter().map(|outline| (&outline[..], 0.0)), window, picture)
    }

    /// Returns the rectangle around points that each reach as far as a radius in mm.
    fn of<'a>(
        parts: impl Iterator<Item = (&'a [DVec2], f64)> + Clone,
        window: &PageWindow,
        picture: [usize; 2],
    ) -> Option<Self> {
        let ends = |axis: usize| {
            let mut range = [f64::INFINITY, f64::NEG_INFINITY];
            for (points, radius) in parts.clone() {
                let radius = window.length(radius) + 1.0;
                for at in points.iter().map(|&p| window.place(p)[axis]) {
                    range = [range[0].min(at - radius), range[1].max(at + radius)];
                }
            }
            [range[0].floor(), range[1].ceil()].map(|end| (end as usize).min(picture[axis]))
        };
        let ([left, right], [top, bottom]) = (ends(0), ends(1));
        let (columns, rows) = (right.saturating_sub(left), bottom.saturating_sub(top));
        (columns > 0 && rows > 0).then_some(Self { left, top, columns, rows, picture })
    }

    /// Returns the coverage by pieces within the rectangle, for ink of an opacity. Overlapping pieces cover once.
    pub(super) fn cover(&self, pieces: &[Piece], window: &PageWindow, ink: f64) -> Option<CoverageMask> {
        let outlines: Vec<_> = pieces.iter().flat_map(|piece| piece.outlines(ink)).collect();
        self.fill(&outlines, window)
    }

    /// Returns the coverage within the rectangle by outlines, filled by the nonzero rule.
    pub(super) fn fill(&self, outlines: &[Vec<DVec2>], window: &PageWindow) -> Option<CoverageMask> {
        let mut cover = CoverageMask::new(self.columns, self.rows)?;
        let corner = [self.left as f64, self.top as f64];
        cover.fill(outlines.iter().map(|outline| {
            outline.iter().map(|&p| {
                let [x, y] = window.place(p);
                [x - corner[0], y - corner[1]]
            })
        }));
        Some(cover)
    }

    /// Calls `put` for each covered pixel: its index in the rectangle, its index in the picture, the covered share.
    pub(super) fn each(&self, cover: &CoverageMask, mut put: impl FnMut(usize, usize, f64)) {
        for (i, &covered) in cover.bytes().iter().enumerate().filter(|(_, covered)| **covered > 0) {
            let pixel = (self.top + i / self.columns) * self.picture[0] + self.left + i % self.columns;
            put(i, pixel, f64::from(covered) / 255.0);
        }
    }

    /// Returns the index in the rectangle of a picture's pixel inside it.
    pub(super) fn index(&self, pixel: usize) -> usize {
        let [x, y] = [pixel % self.picture[0], pixel / self.picture[0]];
        (y - self.top) * self.columns + x - self.left
    }
}
