//! Painting of lines over a picture.

use super::PageWindow;
use super::canvas::{BlendColor, Canvas};
use super::pixel_rect::PixelRect;
use crate::raster::CoverageMask;
use drypoint_scene::color::Rgb;
use drypoint_scene::marks::{Piece, Polyline};

/// Draws a layer's lines: first those in the pen's colour, then those with their own colours, in order.
pub(super) fn paint(lines: &[Polyline], window: &PageWindow, size: [usize; 2], ink: &BlendColor, canvas: &mut Canvas) {
    let pieces: Vec<Piece> = lines.iter().flat_map(Polyline::pieces).collect();
    let (colored, pieces): (Vec<Piece>, Vec<Piece>) = pieces.into_iter().partition(|piece| piece.color.is_some());
    let (whole, faint): (Vec<Piece>, Vec<Piece>) =
        pieces.into_iter().partition(|piece| piece.opacity * ink.opacity == 1.0);
    // One outline for each width, and one for all lines of varying width. A stable sort keeps the order within a width.
    let (mut strokes, mut tapered) = (Vec::new(), Vec::new());
    for piece in &whole {
        match piece.stroke(1.0) {
            Some(radius) => strokes.push((radius, piece)),
            None => tapered.extend(piece.outlines(1.0)),
        }
    }
    strokes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let [width, height] = size;
    if let Some(mut cover) = CoverageMask::new(width, height).filter(|_| !whole.is_empty()) {
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
        if let Some(part) = PixelRect::around(line, window, size) {
            paint_joined(line, &part, window, ink, canvas);
        }
    }
}

/// Whether piece `b` begins where piece `a` ends. Such pieces belong to one line, whose ink covers a place only once.
pub(super) fn goes_on(a: &Piece, b: &Piece) -> bool {
    a.points.last() == b.points.first()
}

/// Draws a line whose pieces differ in colour and opacity.
fn paint_joined(line: &[Piece], part: &PixelRect, window: &PageWindow, pen: &BlendColor, canvas: &mut Canvas) {
    each_of_joined(line, part, window, pen.opacity, |_, pixel, color, share| {
        let own = color.map(|[r, g, b]| canvas.ink([r, g, b, pen.opacity]));
        canvas.put(pixel, own.as_ref().unwrap_or(pen), share);
    });
}

/// Calls `put` once for each pixel that a line of pieces covers. Arguments are the pixel's index in the rectangle and
/// in the picture, the pieces' own colour, and the share times opacity. Pieces that share a pixel are averaged by the
/// share that each covers.
pub(super) fn each_of_joined(
    line: &[Piece],
    part: &PixelRect,
    window: &PageWindow,
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
        let Some(own) = PixelRect::around(each, window, part.picture) else { continue };
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
        // A pixel that each piece covers by less than a step has no colour.
        if all > 0.0 {
            let own = line[0].color.map(|_| [r / all, g / all, b / all]);
            put(i, pixel, own, covered * (opacity / all));
        }
    });
}
