//! Lines over a picture.

use super::Window;
use super::canvas::{Canvas, Ink};
use crate::raster::Cover;
use drypoint_scene::marks::{Piece, Polyline};

/// Draws a layer's lines.
pub(super) fn paint(lines: &[Polyline], window: &Window, [width, height]: [usize; 2], ink: &Ink, canvas: &mut Canvas) {
    let pieces: Vec<Piece> = lines.iter().flat_map(Polyline::pieces).collect();
    let (mut whole, faint): (Vec<Piece>, Vec<Piece>) =
        pieces.into_iter().partition(|piece| piece.opacity * ink.opacity == 1.0);
    // One outline of each width; a stable sort keeps the order of the others.
    whole.sort_by(|a, b| a.radius.total_cmp(&b.radius));
    if let Some(mut cover) = Cover::new(width, height).filter(|_| !whole.is_empty()) {
        for same in whole.chunk_by(|a, b| a.radius == b.radius) {
            let lines = same.iter().map(|piece| (piece.points.iter().map(|&p| window.place(p)), piece.closed));
            cover.draw(lines, 2.0 * window.length(same[0].radius));
        }
        put(&cover, ink, 1.0, canvas, |pixel| pixel);
    }
    for piece in faint {
        let radius = window.length(piece.radius);
        let points: Vec<[f64; 2]> = piece.points.iter().map(|&p| window.place(p)).collect();
        // The pixels that it can touch, and one more around.
        let ends = |axis: usize, cells: usize| {
            let lo = points.iter().map(|p| p[axis]).fold(f64::INFINITY, f64::min) - radius - 1.0;
            let hi = points.iter().map(|p| p[axis]).fold(f64::NEG_INFINITY, f64::max) + radius + 1.0;
            [(lo.floor() as usize).min(cells), (hi.ceil() as usize).min(cells)]
        };
        let ([left, right], [top, bottom]) = (ends(0, width), ends(1, height));
        let Some(mut cover) = Cover::new(right - left, bottom - top) else { continue };
        let moved = points.iter().map(|[x, y]| [x - left as f64, y - top as f64]);
        cover.draw(std::iter::once((moved, piece.closed)), 2.0 * radius);
        let columns = right - left;
        put(&cover, ink, piece.opacity, canvas, |pixel| (top + pixel / columns) * width + left + pixel % columns);
    }
}

/// Puts ink where `cover` is covered; `at` says which pixel of the picture one of its own is.
fn put(cover: &Cover, ink: &Ink, opacity: f64, canvas: &mut Canvas, at: impl Fn(usize) -> usize) {
    for (pixel, &covered) in cover.bytes().iter().enumerate() {
        if covered > 0 {
            canvas.put(at(pixel), ink, f64::from(covered) / 255.0 * opacity);
        }
    }
}
