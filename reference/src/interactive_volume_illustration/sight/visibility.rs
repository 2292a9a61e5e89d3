//! Strokes on the page, without their hidden parts ([HATCH-14]).
//!
//! A straight segment of a stroke is straight on the page. Visibility is tested along it every half pixel, and each
//! change is narrowed down to a tenth of a pixel.

use super::projection::{ClippedSegment, PageProjection};
use super::styled::StyledStroke;
use crate::surface::IsoSurface;
use drypoint_scene::clip::{ClipPlanes, ClippedParts};
use drypoint_scene::color::Rgb;
use drypoint_scene::glam::{DVec2, DVec3};
use drypoint_scene::marks::{Page, Polyline, Vertex, color_between};
use drypoint_scene::parallel;
use drypoint_scene::strokes::{Stroke, StrokeVertex};
use drypoint_scene::view::View;

/// Distance of visibility tests along a segment, in pixels.
const APART: f64 = 0.5;

/// Accuracy of a change of visibility, in pixels.
const CHANGE: f64 = 0.1;

/// A camera with its page, and the surface that hides strokes from it.
#[derive(Clone, Copy, Debug)]
pub struct Sight<'a> {
    /// The camera.
    pub view: &'a View,
    /// The page onto which the camera projects.
    pub page: &'a Page,
    /// The near distance of a perspective camera, in world units. Nearer parts are not drawn.
    pub near: f64,
    /// The surface that hides strokes; none if nothing does.
    pub surface: Option<&'a IsoSurface<'a, 'a>>,
    /// Planes on which strokes end ([RAY-8]). Outlines are already cut by them.
    pub clip: &'a ClipPlanes,
    /// Offset of visibility tests along a stroke's normal, in world units. It is δ of [HATCH-7] for strokes on the
    /// surface, and 0 for strokes that already lie in front of it.
    pub offset: f64,
}

/// The pen at one place of a stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PenState {
    /// Half the width, in mm on the page.
    pub radius: f64,
    /// Opacity in (0, 1].
    pub opacity: f64,
    /// Colour that replaces the layer's.
    pub color: Option<Rgb>,
}

/// Strokes as lines on the page.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VisibleLines {
    /// Lines in the order of the strokes; the parts of a stroke in their order along it.
    pub lines: Vec<Polyline>,
    /// Number of queries of the surface.
    pub looks: u64,
}

impl Sight<'_> {
    /// The place on the page of a point of the world. Returns none outside the frame.
    pub fn place(&self, world: DVec3) -> Option<DVec2> {
        PageProjection::new(self.view, self.page, self.near).place(world)
    }

    /// Whether the surface does not hide a place.
    pub fn sees(&self, world: DVec3) -> bool {
        self.surface.is_none_or(|surface| !surface.hides(world, self.view, self.near))
    }

    /// Returns the visible parts of strokes inside the frame. `pen` gives the pen at each vertex.
    pub fn seen(&self, strokes: &[Stroke], pen: impl Fn(&Stroke, &StrokeVertex) -> PenState + Sync) -> VisibleLines {
        self.each(strokes, |stroke| {
            let ends = stroke.vertices.iter().map(|vertex| PennedVertex { vertex: *vertex, pen: pen(stroke, vertex) });
            (ends.collect(), stroke.closed)
        })
    }

    /// Like [`seen`](Self::seen), but for strokes that carry their pens.
    pub fn seen_drawn(&self, strokes: &[StyledStroke]) -> VisibleLines {
        self.each(strokes, |StyledStroke { stroke, pens }| {
            let ends =
                stroke.vertices.iter().zip(pens).map(|(vertex, pen)| PennedVertex { vertex: *vertex, pen: *pen });
            (ends.collect(), stroke.closed)
        })
    }

    /// Orders lines from the farthest to the nearest, by the depth of their middles. Later lines cover earlier ones.
    pub fn far_to_near(&self, lines: &mut [Polyline]) {
        let depth = |line: &Polyline| {
            let middle = line.vertices.get(line.vertices.len() / 2);
            middle.map_or(0.0, |vertex| self.view.to_eye(vertex.world).z)
        };
        lines.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
    }

    fn each<S: Sync>(&self, strokes: &[S], ends: impl Fn(&S) -> (Vec<PennedVertex>, bool) + Sync) -> VisibleLines {
        let front = self.surface.map_or(1.0, |surface| surface.front(self.view));
        let each = parallel::map_of(strokes.iter().collect(), &|_, stroke| {
            let mut walk = VisibilityTrace {
                sight: self,
                onto: PageProjection::new(self.view, self.page, self.near),
                front,
                looks: 0,
            };
            let (ends, closed) = ends(stroke);
            let lines = walk.lines(ends, closed);
            (lines, walk.looks)
        });
        let looks = each.iter().map(|(_, looks)| looks).sum();
        VisibleLines { lines: each.into_iter().flat_map(|(lines, _)| lines).collect(), looks }
    }
}

/// The visibility tests along a stroke.
struct VisibilityTrace<'a, 's> {
    sight: &'a Sight<'s>,
    onto: PageProjection<'a>,
    front: f64,
    looks: u64,
}

/// A vertex with its pen.
#[derive(Clone, Copy)]
struct PennedVertex {
    vertex: StrokeVertex,
    pen: PenState,
}

impl PennedVertex {
    /// The vertex at a share of the way from one to the next.
    fn between(a: &Self, b: &Self, t: f64) -> Self {
        let mix = |x: f64, y: f64| x + (y - x) * t;
        Self {
            vertex: StrokeVertex {
                world: a.vertex.world.lerp(b.vertex.world, t),
                normal: a.vertex.normal.lerp(b.vertex.normal, t).normalize_or_zero(),
                u: mix(a.vertex.u, b.vertex.u),
            },
            pen: PenState {
                radius: mix(a.pen.radius, b.pen.radius),
                opacity: mix(a.pen.opacity, b.pen.opacity),
                color: color_between(a.pen.color, b.pen.color, t),
            },
        }
    }
}

impl VisibilityTrace<'_, '_> {
    fn lines(&mut self, mut ends: Vec<PennedVertex>, closed: bool) -> Vec<Polyline> {
        // A closed stroke repeats its first vertex.
        if let (true, Some(first)) = (closed, ends.first().copied()) {
            ends.push(PennedVertex { vertex: StrokeVertex { u: 1.0, ..first.vertex }, ..first });
        }
        if self.sight.clip.is_empty() {
            return self.seen_parts(&ends, closed);
        }
        match self.sight.clip.cut_line(ends, closed, |end| end.vertex.world, PennedVertex::between) {
            ClippedParts::Whole(ends) => self.seen_parts(&ends, closed),
            ClippedParts::Parts(parts) => parts.iter().flat_map(|ends| self.seen_parts(ends, false)).collect(),
        }
    }

    /// The visible parts of a line that no plane cuts. A closed one repeats its first vertex.
    fn seen_parts(&mut self, ends: &[PennedVertex], closed: bool) -> Vec<Polyline> {
        let mut parts: Vec<Vec<Vertex>> = Vec::new();
        // Whether the last part ends where the next segment begins, and the visibility at that place if it is known.
        let (mut joins, mut known) = (false, None);
        let mut begins_seen = false;
        for (i, pair) in ends.windows(2).enumerate() {
            let segment = [pair[0], pair[1]];
            let cut = self.onto.cut([segment[0].vertex.world, segment[1].vertex.world], segment[0].pen.radius);
            let Some(cut) = cut else {
                (joins, known) = (false, None);
                continue;
            };
            // The visible ranges of the segment. The visibility at its start is known if the segment before was not
            // clipped.
            let (ranges, last) = self.ranges(&segment, &cut, known.filter(|_| cut.range[0] == 0.0));
            known = (cut.range[1] == 1.0).then_some(last);
            let mut ends_seen = false;
            for [from, to] in ranges {
                let at_start = cut.is_start(from);
                begins_seen |= i == 0 && at_start;
                ends_seen = cut.is_end(to);
                let end = between(&segment, &cut, to);
                match parts.last_mut() {
                    Some(part) if joins && at_start => part.push(end),
                    _ => parts.push(vec![between(&segment, &cut, from), end]),
                }
            }
            joins = ends_seen;
        }
        // A ring that is visible at its seam: one part is the whole ring, several parts join across the seam.
        let meets = closed && begins_seen && joins;
        if let (true, [whole]) = (meets, parts.as_mut_slice()) {
            whole.pop();
            return vec![Polyline { vertices: parts.pop().unwrap_or_default(), closed: true }];
        }
        if meets {
            // The last part continues in the first.
            let mut last = parts.pop().unwrap_or_default();
            last.pop();
            last.append(&mut parts[0]);
            parts[0] = last;
        }
        parts.into_iter().map(|vertices| Polyline { vertices, closed: false }).collect()
    }

    /// Returns the visible parameter ranges of a segment, and whether its end is visible.
    fn ranges(
        &mut self,
        segment: &[PennedVertex; 2],
        cut: &ClippedSegment,
        known: Option<bool>,
    ) -> (Vec<[f64; 2]>, bool) {
        let [from, to] = cut.range;
        if self.sight.surface.is_none() {
            return (vec![[from, to]], true);
        }
        let mut before = known.unwrap_or_else(|| self.is_seen(segment, cut, from));
        let pixels = cut.length * self.sight.page.pixels_per_mm();
        let steps = (pixels * (to - from) / APART).ceil().max(1.0) as u32;
        let (mut ranges, mut start, mut last) = (Vec::new(), before.then_some(from), from);
        for step in 1..=steps {
            let at = if step == steps { to } else { from + (to - from) * f64::from(step) / f64::from(steps) };
            let now = self.is_seen(segment, cut, at);
            if now != before {
                let (mut lo, mut hi) = (last, at);
                while (hi - lo) * pixels > CHANGE {
                    let middle = 0.5 * (lo + hi);
                    if self.is_seen(segment, cut, middle) == before { lo = middle } else { hi = middle }
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

    fn is_seen(&mut self, segment: &[PennedVertex; 2], cut: &ClippedSegment, s: f64) -> bool {
        let Some(surface) = self.sight.surface else { return true };
        self.looks += 1;
        let [a, b] = segment.map(|end| end.vertex);
        let u = cut.along_world(s);
        let normal = a.normal.lerp(b.normal, u).normalize_or_zero();
        let at: DVec3 = a.world.lerp(b.world, u) + normal * (self.sight.offset * self.front);
        !surface.hides(at, self.sight.view, self.sight.near)
    }
}

/// The vertex at the parameter s of a segment on the page.
fn between([a, b]: &[PennedVertex; 2], cut: &ClippedSegment, s: f64) -> Vertex {
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
