//! Lines of annotations on the page, and what hides them.

use drypoint_reference::ray::Renderer;
use drypoint_reference::volumeshop::conventions::CurvePoint;
use drypoint_scene::color::Rgb;
use drypoint_scene::glam::{DVec2, DVec3};
use drypoint_scene::marks::{Layer, Page, Polyline, Vertex};
use drypoint_scene::parallel;
use drypoint_scene::view::View;

/// The share of a line's light below which the line is not drawn.
const HIDDEN: f64 = 1.0 / 16.0;

/// The least number of parts of a line that labels keep off.
const PARTS: usize = 8;

/// The share of a line's light from which on the line has its own colour.
const CLEAR: f64 = 1.0 - 1.0 / 512.0;

/// The course of a line between its points.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Course {
    /// Along one straight line.
    Straight,
    /// Along a curve.
    Curved,
}

/// The look of lines of one pen behind the volume.
pub(super) struct Seen<'a> {
    pub(super) page: &'a Page,
    pub(super) view: &'a View,
    /// The renderer whose volume hides the lines; none: nothing does.
    pub(super) renderer: Option<&'a Renderer<'a>>,
    pub(super) rgb: Rgb,
    /// Width of the lines, in mm.
    pub(super) width: f64,
}

impl Seen<'_> {
    /// Returns the visible parts of a line through points of the picture. Behind half-transparent matter the line has the
    /// colour with which it is seen through that.
    pub(super) fn line(&self, points: &[CurvePoint], course: Course) -> Vec<Polyline> {
        let look = parallel::map(points.len(), &|i| self.look(&points[i]));
        let last = points.len().saturating_sub(1).max(1) as f64;
        let vertices = points.iter().zip(look).enumerate().map(|(i, (point, color))| {
            let ray = self.view.ray(point.at.x, point.at.y);
            color.map(|color| Vertex {
                at: self.page.place(point.at, self.view.size),
                world: ray.origin + ray.along * point.depth,
                radius: self.width / 2.0,
                opacity: 1.0,
                t: i as f64 / last,
                color,
            })
        });
        let vertices: Vec<Option<Vertex>> = vertices.collect();
        let runs = vertices.split(Option::is_none).filter(|run| run.len() > 1);
        let lines = runs.map(|run| {
            let run: Vec<Vertex> = run.iter().copied().flatten().collect();
            let is_kept = |i: usize| {
                let is_end = i == 0 || i + 1 == run.len();
                is_end || course == Course::Curved || run[i - 1..i + 2].iter().any(|vertex| vertex.color.is_some())
            };
            let vertices = (0..run.len()).filter(|&i| is_kept(i)).map(|i| run[i]).collect();
            Polyline { vertices, closed: false }
        });
        lines.collect()
    }

    /// Returns the colour of a small area at one depth, as the mean over its corners and its middle; the inner none is the
    /// pen's own colour. Returns none if the area is hidden.
    pub(super) fn area(&self, outline: &[DVec2; 4], depth: f64) -> Option<Option<Rgb>> {
        let Some(renderer) = self.renderer else { return Some(None) };
        let middle = outline.iter().sum::<DVec2>() / 4.0;
        let points = outline.iter().map(|corner| (*corner + middle) / 2.0).chain([middle]);
        let points = points.map(|at| renderer.line_point(at.to_array(), depth, self.rgb));
        let (rgb, visible) = points.fold(([0.0; 3], 0.0), |(rgb, visible), point| {
            let weight = point.visible;
            (std::array::from_fn(|c| rgb[c] + weight * point.rgb[c]), visible + weight)
        });
        let mean = visible / 5.0;
        (mean >= HIDDEN).then(|| (mean < CLEAR).then(|| rgb.map(|c| c / visible)))
    }

    /// Returns the colour of a point of the line; the inner none is the pen's own. Returns none if it is hidden.
    fn look(&self, point: &CurvePoint) -> Option<Option<Rgb>> {
        let Some(renderer) = self.renderer else { return Some(None) };
        let seen = renderer.line_point(point.at.to_array(), point.depth, self.rgb);
        (seen.visible >= HIDDEN).then(|| (seen.visible < CLEAR).then_some(seen.rgb))
    }
}

/// Returns a line through points of the page, in mm.
pub(crate) fn plain(points: &[DVec2], width: f64, opacity: f64, closed: bool) -> Polyline {
    let last = points.len().saturating_sub(1).max(1) as f64;
    let vertex = |(i, &at): (usize, &DVec2)| Vertex {
        at,
        world: DVec3::ZERO,
        radius: width / 2.0,
        opacity,
        t: i as f64 / last,
        color: None,
    };
    Polyline { vertices: points.iter().enumerate().map(vertex).collect(), closed }
}

/// Returns rectangles around the parts of a layer's lines, and of the outlines of its areas.
pub(super) fn rectangles(layer: &Layer) -> Vec<[DVec2; 2]> {
    let points = |line: &Polyline| -> Vec<DVec2> {
        let first = line.vertices.first().filter(|_| line.closed);
        line.vertices.iter().chain(first).map(|vertex| vertex.at).collect()
    };
    let outlines = layer.areas.iter().flat_map(|area| &area.outlines);
    let closed = outlines.map(|outline| outline.iter().chain(outline.first()).copied().collect());
    let lines = layer.lines.iter().map(points).chain(closed);
    lines.flat_map(|points: Vec<DVec2>| around_parts(&points, layer.pen.width / 2.0)).collect()
}

/// Rectangles around the parts of a line, at a distance. They are at least [`PARTS`], and about twice as many at most.
fn around_parts(points: &[DVec2], distance: f64) -> Vec<[DVec2; 2]> {
    let step = points.windows(2).map(|ends| ends[0].distance(ends[1])).sum::<f64>() / PARTS as f64;
    let mut fine: Vec<DVec2> = points[..points.len().min(1)].to_vec();
    for ends in points.windows(2) {
        let n = (ends[0].distance(ends[1]) / step).ceil().clamp(1.0, PARTS as f64);
        fine.extend((1..=n as usize).map(|i| ends[0].lerp(ends[1], i as f64 / n)));
    }
    let last = fine.len().saturating_sub(1);
    let most = last.div_ceil(2 * PARTS).max(1);
    let parts = (0..last).step_by(most).map(|i| &fine[i..=(i + most).min(last)]);
    let around = |part: &[DVec2]| {
        let first = [part[0] - distance, part[0] + distance];
        part.iter().fold(first, |[lo, hi], &p| [lo.min(p - distance), hi.max(p + distance)])
    };
    parts.map(around).collect()
}

/// Returns a width on its step of 0.01 mm, so that half of it is on the step of radii.
pub(super) fn on_step(width: f64) -> f64 {
    (width * 100.0).round_ties_even().max(1.0) / 100.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each point of a line is in a rectangle, and all of them together cover little else.
    #[test]
    fn rectangles_follow_a_line() {
        let circle: Vec<DVec2> = (0..=200).map(|i| 10.0 * DVec2::from_angle(f64::from(i) * 0.03)).collect();
        let diagonal = vec![DVec2::ZERO, DVec2::new(30.0, 20.0)];
        let corner = vec![DVec2::ZERO, DVec2::new(30.0, 0.0), DVec2::new(30.0, 20.0)];
        for (points, most) in [(circle, 120.0), (diagonal, 600.0 / 8.0 + 30.0), (corner, 40.0)] {
            let found = around_parts(&points, 0.25);
            assert!((PARTS..=3 * PARTS).contains(&found.len()), "{}", found.len());
            for ends in points.windows(2) {
                for i in 0..=50 {
                    let p = ends[0].lerp(ends[1], f64::from(i) / 50.0);
                    assert!(found.iter().any(|[lo, hi]| lo.cmple(p - 0.249).all() && hi.cmpge(p + 0.249).all()), "{p}");
                }
            }
            let area: f64 = found.iter().map(|[lo, hi]| (hi - lo).element_product()).sum();
            assert!(area < most, "{area}");
        }
        assert!(around_parts(&[], 1.0).is_empty() && around_parts(&[DVec2::ONE], 1.0).is_empty());
    }
}
