//! Strokes on the page, without what is hidden ([HATCH-14]).
//!
//! A straight piece of a stroke is a straight piece of the page, along which the surface in front is asked for every half
//! pixel; where the answer changes, the change is narrowed down to a tenth of one.

use super::project::{Cut, Onto};
use super::styled::Drawn;
use crate::surface::IsoSurface;
use drypoint_scene::color::Rgb;
use drypoint_scene::glam::{DVec2, DVec3};
use drypoint_scene::marks::{Page, Polyline, Vertex, color_between};
use drypoint_scene::strokes::{Stroke, StrokeVertex};
use drypoint_scene::view::View;
use rayon::prelude::*;

/// How far apart places are at which the surface is asked for, in pixels.
const APART: f64 = 0.5;

/// How exactly a change is known, in pixels.
const CHANGE: f64 = 0.1;

/// A camera with its page, and what hides strokes from it.
#[derive(Clone, Copy, Debug)]
pub struct Sight<'a> {
    /// The camera.
    pub view: &'a View,
    /// The page that it is seen on.
    pub page: &'a Page,
    /// `near` of a perspective camera, in world units: what is nearer is not drawn.
    pub near: f64,
    /// What hides strokes; none: nothing does.
    pub surface: Option<&'a IsoSurface<'a, 'a>>,
    /// How far in front of it a stroke is asked for, along its normal, in world units: δ of [HATCH-7] for strokes that lie
    /// on the surface, 0 for those that lie in front of it themselves.
    pub offset: f64,
}

/// What a stroke is drawn with at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pen {
    /// Half the width, in mm on the page.
    pub radius: f64,
    /// In (0, 1].
    pub opacity: f64,
    /// In place of the layer's.
    pub color: Option<Rgb>,
}

/// Strokes as lines on the page.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Seen {
    /// In the order of the strokes, the parts of one in their order along it.
    pub lines: Vec<Polyline>,
    /// How often the surface was asked for.
    pub looks: u64,
}

impl Sight<'_> {
    /// Where a place of the world is on the page; none outside the frame.
    pub fn place(&self, world: DVec3) -> Option<DVec2> {
        Onto::new(self.view, self.page, self.near).place(world)
    }

    /// Whether a place is not hidden.
    pub fn sees(&self, world: DVec3) -> bool {
        self.surface.is_none_or(|surface| !surface.hides(world, self.view, self.near))
    }

    /// What is seen of strokes, inside the frame, drawn with what `pen` says for each of their vertices.
    pub fn seen(&self, strokes: &[Stroke], pen: impl Fn(&Stroke, &StrokeVertex) -> Pen + Sync) -> Seen {
        self.each(strokes, |stroke| {
            let ends = stroke.vertices.iter().map(|vertex| End { vertex: *vertex, pen: pen(stroke, vertex) });
            (ends.collect(), stroke.closed)
        })
    }

    /// The same of strokes with their pens.
    pub fn seen_drawn(&self, strokes: &[Drawn]) -> Seen {
        self.each(strokes, |Drawn { stroke, pens }| {
            let ends = stroke.vertices.iter().zip(pens).map(|(vertex, pen)| End { vertex: *vertex, pen: *pen });
            (ends.collect(), stroke.closed)
        })
    }

    /// Orders lines from the farthest to the nearest, by the depth of their middles: what is drawn later lies over what was
    /// drawn before.
    pub fn far_to_near(&self, lines: &mut [Polyline]) {
        let depth = |line: &Polyline| {
            let middle = line.vertices.get(line.vertices.len() / 2);
            middle.map_or(0.0, |vertex| self.view.to_eye(vertex.world).z)
        };
        lines.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
    }

    fn each<S: Sync>(&self, strokes: &[S], ends: impl Fn(&S) -> (Vec<End>, bool) + Sync) -> Seen {
        let front = self.surface.map_or(1.0, |surface| surface.front(self.view));
        let each = strokes.par_iter().map(|stroke| {
            let mut walk = Walk { sight: self, onto: Onto::new(self.view, self.page, self.near), front, looks: 0 };
            let (ends, closed) = ends(stroke);
            let lines = walk.lines(ends, closed);
            (lines, walk.looks)
        });
        let each: Vec<(Vec<Polyline>, u64)> = each.collect();
        let looks = each.iter().map(|(_, looks)| looks).sum();
        Seen { lines: each.into_iter().flat_map(|(lines, _)| lines).collect(), looks }
    }
}

/// On the way along a stroke.
struct Walk<'a, 's> {
    sight: &'a Sight<'s>,
    onto: Onto<'a>,
    front: f64,
    looks: u64,
}

/// A vertex with what draws it.
#[derive(Clone, Copy)]
struct End {
    vertex: StrokeVertex,
    pen: Pen,
}

impl Walk<'_, '_> {
    fn lines(&mut self, mut ends: Vec<End>, closed: bool) -> Vec<Polyline> {
        if let (true, Some(first)) = (closed, ends.first().copied()) {
            ends.push(End { vertex: StrokeVertex { u: 1.0, ..first.vertex }, ..first });
        }
        let mut parts: Vec<Vec<Vertex>> = Vec::new();
        // Whether the last part ends where the next piece begins, and what is known of that place.
        let (mut joins, mut known) = (false, None);
        let mut begins_seen = false;
        for (i, pair) in ends.windows(2).enumerate() {
            let piece = [pair[0], pair[1]];
            let cut = self.onto.cut([piece[0].vertex.world, piece[1].vertex.world], piece[0].pen.radius);
            let Some(cut) = cut else {
                (joins, known) = (false, None);
                continue;
            };
            let (ranges, last) = self.ranges(&piece, &cut, known.filter(|_| cut.range[0] == 0.0));
            known = (cut.range[1] == 1.0).then_some(last);
            let mut ends_seen = false;
            for [from, to] in ranges {
                let at_start = cut.is_start(from);
                begins_seen |= i == 0 && at_start;
                ends_seen = cut.is_end(to);
                let end = between(&piece, &cut, to);
                match parts.last_mut() {
                    Some(part) if joins && at_start => part.push(end),
                    _ => parts.push(vec![between(&piece, &cut, from), end]),
                }
            }
            joins = ends_seen;
        }
        let meets = closed && begins_seen && joins;
        if let (true, [whole]) = (meets, parts.as_mut_slice()) {
            whole.pop();
            return vec![Polyline { vertices: parts.pop().unwrap_or_default(), closed: true }];
        }
        if meets {
            // The last part goes on in the first.
            let mut last = parts.pop().unwrap_or_default();
            last.pop();
            last.append(&mut parts[0]);
            parts[0] = last;
        }
        parts.into_iter().map(|vertices| Polyline { vertices, closed: false }).collect()
    }

    /// The ranges of the way along a piece that are seen, and whether its end is.
    fn ranges(&mut self, piece: &[End; 2], cut: &Cut, known: Option<bool>) -> (Vec<[f64; 2]>, bool) {
        let [from, to] = cut.range;
        if self.sight.surface.is_none() {
            return (vec![[from, to]], true);
        }
        let mut before = known.unwrap_or_else(|| self.is_seen(piece, cut, from));
        let pixels = cut.length * self.sight.page.pixels_per_mm();
        let steps = (pixels * (to - from) / APART).ceil().max(1.0) as u32;
        let (mut ranges, mut start, mut last) = (Vec::new(), before.then_some(from), from);
        for step in 1..=steps {
            let at = if step == steps { to } else { from + (to - from) * f64::from(step) / f64::from(steps) };
            let now = self.is_seen(piece, cut, at);
            if now != before {
                let (mut lo, mut hi) = (last, at);
                while (hi - lo) * pixels > CHANGE {
                    let middle = 0.5 * (lo + hi);
                    if self.is_seen(piece, cut, middle) == before { lo = middle } else { hi = middle }
                }
                let change = 0.5 * (lo + hi);
                match start.take() {
                    Some(start) => ranges.push([start, change]),
                    None => start = Some(change),
                }
            }
            (before, last) = (now, at);
        }
        ranges.extend(start.map(|start| [start, to]));
        (ranges, before)
    }

    fn is_seen(&mut self, piece: &[End; 2], cut: &Cut, s: f64) -> bool {
        let Some(surface) = self.sight.surface else { return true };
        self.looks += 1;
        let [a, b] = piece.map(|end| end.vertex);
        let u = cut.along_world(s);
        let normal = a.normal.lerp(b.normal, u).normalize_or_zero();
        let at: DVec3 = a.world.lerp(b.world, u) + normal * (self.sight.offset * self.front);
        !surface.hides(at, self.sight.view, self.sight.near)
    }
}

/// The vertex so far along a piece of the page.
fn between([a, b]: &[End; 2], cut: &Cut, s: f64) -> Vertex {
    let u = cut.along_world(s);
    let mix = |x: f64, y: f64| if u == 1.0 { y } else { x + (y - x) * u };
    Vertex {
        at: cut.on_page(s),
        world: DVec3::from_array(std::array::from_fn(|i| mix(a.vertex.world[i], b.vertex.world[i]))),
        radius: mix(a.pen.radius, b.pen.radius),
        opacity: mix(a.pen.opacity, b.pen.opacity),
        t: mix(a.vertex.u, b.vertex.u),
        color: color_between(a.pen.color, b.pen.color, u),
    }
}

#[cfg(test)]
mod tests;
