//! Text and areas as strokes of a nib.

use crate::text::{CAP_HEIGHT, GAP, advance, font, strokes};
use drypoint_scene::glam::{DVec2, DVec3};
use drypoint_scene::marks::{Area, Dot, Polyline, Text, Vertex, on_step};

/// Returns a line of text as touches and strokes of a nib of that width. Capitals have the height, and the line the
/// width, of the same text in the font. The strokes stand from left to right, also for scripts that run to the left.
pub(super) fn letters(text: &Text, nib: f64) -> (Vec<Dot>, Vec<Polyline>) {
    let (mut dots, mut lines) = (Vec::new(), Vec::new());
    let characters = font::printable(&text.characters);
    let own = advance(&characters);
    let wide = font::extent(&characters, text.size).advance;
    if own <= 0.0 || wide <= 0.0 {
        return (dots, lines);
    }
    let scale = DVec2::new(wide / own, -font::cap_height(text.size) / CAP_HEIGHT);
    for stroke in strokes(&characters) {
        // Half the gap precedes a letter, and half follows it.
        let place = |[x, y]: [f64; 2]| on_step(text.at + DVec2::new(x + GAP / 2.0, y) * scale);
        let mut points: Vec<DVec2> = stroke.into_iter().map(place).collect();
        points.dedup();
        match points[..] {
            [at] => dots.push(Dot { at, world: DVec3::ZERO, radius: nib / 2.0, opacity: 1.0 }),
            _ => lines.extend(line(points, false, nib)),
        }
    }
    (dots, lines)
}

/// Returns the outlines of an area as lines of a nib of that width.
pub(super) fn outlines(area: &Area, nib: f64) -> impl Iterator<Item = Polyline> {
    area.outlines.iter().filter_map(move |outline| line(outline.clone(), true, nib))
}

/// Returns a line through points without repetitions; none if fewer than two are left.
fn line(mut points: Vec<DVec2>, closed: bool, nib: f64) -> Option<Polyline> {
    points.dedup();
    if closed && points.len() > 1 && points.first() == points.last() {
        points.pop();
    }
    let last = points.len().checked_sub(1).filter(|&last| last > 0)? as f64;
    let vertex = |(i, at): (usize, DVec2)| Vertex {
        at,
        world: DVec3::ZERO,
        radius: nib / 2.0,
        opacity: 1.0,
        t: i as f64 / last,
        color: None,
    };
    Some(Polyline { vertices: points.into_iter().enumerate().map(vertex).collect(), closed })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(characters: &str) -> Text {
        Text { characters: characters.into(), at: DVec2::new(10.0, 20.0), size: 4.0, opacity: 0.5 }
    }

    /// The font's capitals are 1462/2048 em high: 2.8555 mm of 4 mm.
    #[test]
    fn strokes_have_the_height_and_the_width_of_the_font() {
        let (dots, lines) = letters(&text("HELLO THERE"), 0.3);
        assert!(dots.is_empty());
        let places: Vec<DVec2> = lines.iter().flat_map(|line| &line.vertices).map(|vertex| vertex.at).collect();
        let low = places.iter().copied().fold(DVec2::INFINITY, DVec2::min);
        let high = places.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
        assert!((high.y - low.y - 4.0 * 1462.0 / 2048.0).abs() < 0.01 && (high.y - 20.0).abs() < 0.005, "{low} {high}");
        let advance = font::extent("HELLO THERE", 4.0).advance;
        // Margins are half a gap, 2.9 of about 19 units of a letter.
        assert!(low.x > 10.0 && high.x < 10.0 + advance && high.x - low.x > 0.95 * advance, "{low} {high} {advance}");
        assert!(lines.iter().flat_map(|line| &line.vertices).all(|v| (v.radius, v.opacity) == (0.15, 1.0)));
    }

    #[test]
    fn a_point_is_a_touch_or_a_stroke() {
        let (dots, lines) = letters(&text("ü é ☃"), 0.3);
        assert!(dots.is_empty() && lines.len() == 2 + 2 + 2 + 1, "{} {}", dots.len(), lines.len());
        // A full stop of less than 0.001 mm.
        let tiny = letters(&Text { size: 0.01, ..text(".") }, 0.3);
        assert_eq!((tiny.0.len(), tiny.1.len()), (1, 0));
        for characters in ["", " ", "\t", "\u{301}"] {
            letters(&text(characters), 0.3);
        }
    }

    #[test]
    fn an_area_is_its_outlines() {
        let corner = [(1.0, 1.0), (1.0, 1.0), (4.0, 1.0), (4.0, 3.0), (1.0, 1.0)].map(DVec2::from).to_vec();
        let area = Area { outlines: vec![corner, vec![DVec2::ONE; 3], vec![]], opacity: 0.5, color: None };
        let found: Vec<Polyline> = outlines(&area, 0.3).collect();
        assert_eq!(found.len(), 1);
        assert!(found[0].closed && found[0].vertices.len() == 3);
    }
}
