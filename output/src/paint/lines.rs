//! Lines over a picture.

use super::Window;
use super::canvas::{Canvas, Ink};
use crate::raster::Cover;
use drypoint_scene::color::Rgb;
use drypoint_scene::marks::{Piece, Polyline};

/// Draws a layer's lines: first those of the pen's colour, then those with colours of their own, in their order.
pub(super) fn paint(lines: &[Polyline], window: &Window, size: [usize; 2], ink: &Ink, canvas: &mut Canvas) {
    let pieces: Vec<Piece> = lines.iter().flat_map(Polyline::pieces).collect();
    let (colored, pieces): (Vec<Piece>, Vec<Piece>) = pieces.into_iter().partition(|piece| piece.color.is_some());
    let (whole, faint): (Vec<Piece>, Vec<Piece>) =
        pieces.into_iter().partition(|piece| piece.opacity * ink.opacity == 1.0);
    // One outline of each width, and one of those whose width changes; a stable sort keeps the order of the others.
    let (mut strokes, mut tapered) = (Vec::new(), Vec::new());
    for piece in &whole {
        match piece.stroke(1.0) {
            Some(radius) => strokes.push((radius, piece)),
            None => tapered.extend(piece.outlines(1.0)),
        }
    }
    strokes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let [width, height] = size;
    if let Some(mut cover) = Cover::new(width, height).filter(|_| !whole.is_empty()) {
        for same in strokes.chunk_by(|a, b| a.0 == b.0) {
            let lines = same.iter().map(|(_, piece)| (piece.points.iter().map(|&p| window.place(p)), piece.closed));
            cover.draw(lines, 2.0 * window.length(same[0].0));
        }
        cover.fill(tapered.iter().map(|outline| outline.iter().map(|&p| window.place(p))));
        for (pixel, &covered) in cover.bytes().iter().enumerate().filter(|(_, covered)| **covered > 0) {
            canvas.put(pixel, ink, f64::from(covered) / 255.0);
        }
    }
    for line in faint.chunk_by(goes_on).chain(colored.chunk_by(goes_on)) {
        if let Some(part) = Part::around(line, window, size) {
            paint_joined(line, &part, window, ink, canvas);
        }
    }
}

/// Whether a piece goes on where the one before ended: both are of one line, which covers once.
pub(super) fn goes_on(a: &Piece, b: &Piece) -> bool {
    a.points.last() == b.points.first()
}

/// Draws a line of pieces of different colours and opacities.
fn paint_joined(line: &[Piece], part: &Part, window: &Window, pen: &Ink, canvas: &mut Canvas) {
    each_of_joined(line, part, window, pen.opacity, |_, pixel, color, share| {
        let own = color.map(|[r, g, b]| canvas.ink([r, g, b, pen.opacity]));
        canvas.put(pixel, own.as_ref().unwrap_or(pen), share);
    });
}

/// Each pixel that a line of pieces covers, once where they overlap: its number in the part and in the picture, the pieces'
/// own colour, and the share times their opacity. Of several pieces a pixel has the mean, by how much of it each covers.
pub(super) fn each_of_joined(
    line: &[Piece],
    part: &Part,
    window: &Window,
    ink: f64,
    mut put: impl FnMut(usize, usize, Option<Rgb>, f64),
) {
    let Some(whole) = part.cover(line, window, ink) else { return };
    if let [only] = line {
        part.each(&whole, |i, pixel, covered| put(i, pixel, only.color, covered * only.opacity));
        return;
    }
    let mut sums = vec![[0.0; 5]; part.columns * part.rows];
    for piece in line {
        let color = piece.color.unwrap_or_default();
        let each = std::slice::from_ref(piece);
        let Some(own) = Part::around(each, window, part.picture) else { continue };
        let Some(cover) = own.cover(each, window, ink) else { continue };
        own.each(&cover, |_, pixel, covered| {
            let sum = &mut sums[part.index(pixel)];
            color.iter().enumerate().for_each(|(i, c)| sum[i] += covered * c);
            sum[3] += covered * piece.opacity;
            sum[4] += covered;
        });
    }
    part.each(&whole, |i, pixel, covered| {
        let [r, g, b, opacity, all] = sums[i];
        // A pixel of which each piece covers less than a step has no colour.
        if all > 0.0 {
            let own = line[0].color.map(|_| [r / all, g / all, b / all]);
            put(i, pixel, own, covered * (opacity / all));
        }
    });
}

/// The pixels that pieces can touch, and one more around.
pub(super) struct Part {
    pub(super) left: usize,
    pub(super) top: usize,
    pub(super) columns: usize,
    pub(super) rows: usize,
    picture: [usize; 2],
}

impl Part {
    pub(super) fn around(pieces: &[Piece], window: &Window, picture: [usize; 2]) -> Option<Self> {
        let ends = |axis: usize| {
            let mut range = [f64::INFINITY, f64::NEG_INFINITY];
            for piece in pieces {
                let radius = window.length(piece.largest_radius()) + 1.0;
                for at in piece.points.iter().map(|&p| window.place(p)[axis]) {
                    range = [range[0].min(at - radius), range[1].max(at + radius)];
                }
            }
            [range[0].floor(), range[1].ceil()].map(|end| (end as usize).min(picture[axis]))
        };
        let ([left, right], [top, bottom]) = (ends(0), ends(1));
        let (columns, rows) = (right.saturating_sub(left), bottom.saturating_sub(top));
        (columns > 0 && rows > 0).then_some(Self { left, top, columns, rows, picture })
    }

    /// What pieces cover of it in ink of an opacity, once where they overlap.
    fn cover(&self, pieces: &[Piece], window: &Window, ink: f64) -> Option<Cover> {
        let mut cover = Cover::new(self.columns, self.rows)?;
        let corner = [self.left as f64, self.top as f64];
        let outlines: Vec<_> = pieces.iter().flat_map(|piece| piece.outlines(ink)).collect();
        cover.fill(outlines.iter().map(|outline| {
            outline.iter().map(|&p| {
                let [x, y] = window.place(p);
                [x - corner[0], y - corner[1]]
            })
        }));
        Some(cover)
    }

    /// Each covered pixel: its number here, in the picture, and how much of it is covered.
    fn each(&self, cover: &Cover, mut put: impl FnMut(usize, usize, f64)) {
        for (i, &covered) in cover.bytes().iter().enumerate().filter(|(_, covered)| **covered > 0) {
            let pixel = (self.top + i / self.columns) * self.picture[0] + self.left + i % self.columns;
            put(i, pixel, f64::from(covered) / 255.0);
        }
    }

    /// The number here of a pixel of the picture that lies in it.
    fn index(&self, pixel: usize) -> usize {
        let [x, y] = [pixel % self.picture[0], pixel / self.picture[0]];
        (y - self.top) * self.columns + x - self.left
    }
}
