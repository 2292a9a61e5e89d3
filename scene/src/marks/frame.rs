//! Clipping of marks to the frame ([STIP-16]): dots are kept whole or not at all, lines are cut.

use super::{Marks, Page, Polyline, Vertex};
use glam::DVec2;

impl Marks {
    /// Clips the marks to the frame. A dot stays if all of its disc is inside. A line stays where its middle is at
    /// least half its width inside. A line that leaves and comes back becomes several lines, whose vertices keep their
    /// `t`.
    pub fn keep_inside(&mut self) {
        let page = self.page;
        for layer in &mut self.layers {
            layer.dots.retain(|dot| inside(&page, dot.at, dot.radius));
            let lines = std::mem::take(&mut layer.lines);
            layer.lines = lines.into_iter().flat_map(|line| cut(&page, line)).collect();
        }
    }
}

/// The largest distance, in mm, of a place outside the frame that still counts as inside. It is less than half a step
/// of places.
const SLACK: f64 = 1e-9;

fn inside(page: &Page, at: DVec2, radius: f64) -> bool {
    let near = at - (page.margin + radius - SLACK);
    let far = page.size - (page.margin + radius - SLACK) - at;
    near.min_element() >= 0.0 && far.min_element() >= 0.0
}

/// The parts of a line that lie inside; the line itself if all of it does.
fn cut(page: &Page, line: Polyline) -> Vec<Polyline> {
    if line.vertices.iter().all(|v| inside(page, v.at, v.radius)) {
        return vec![line];
    }
    let mut vertices = line.vertices;
    if line.closed {
        vertices.extend(vertices.first().copied());
    }
    let mut parts: Vec<Vec<Vertex>> = Vec::new();
    // Whether the last part ends where the next segment begins.
    let mut joins = false;
    for pair in vertices.windows(2) {
        let Some([from, to]) = range(page, &pair[0], &pair[1]) else {
            joins = false;
            continue;
        };
        let end = pair[0].between(&pair[1], to);
        match parts.last_mut() {
            Some(part) if joins && from == 0.0 => part.push(end),
            _ => parts.push(vec![pair[0].between(&pair[1], from), end]),
        }
        joins = to == 1.0;
    }
    parts.into_iter().map(|vertices| Polyline { vertices, closed: false }).collect()
}

/// Returns the interval of a segment, from 0 to 1, in which the pen is inside the frame. Place and radius are linear
/// along the segment, so each side of the frame keeps one interval.
fn range(page: &Page, a: &Vertex, b: &Vertex) -> Option<[f64; 2]> {
    let (lo, hi) = (page.margin - SLACK, page.size - page.margin + SLACK);
    clipped([
        (a.at.x - a.radius - lo, b.at.x - b.radius - lo),
        (a.at.y - a.radius - lo, b.at.y - b.radius - lo),
        (hi.x - a.at.x - a.radius, hi.x - b.at.x - b.radius),
        (hi.y - a.at.y - a.radius, hi.y - b.at.y - b.radius),
    ])
}

/// The part of a segment, from 0 at its start to 1 at its end, that lies inside all of some lines. Each line is given
/// by the distances of start and end from it, positive inside.
pub fn clipped(distances: impl IntoIterator<Item = (f64, f64)>) -> Option<[f64; 2]> {
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for (start, end) in distances {
        match (start >= 0.0, end >= 0.0) {
            (true, true) => {}
            (false, false) => return None,
            (true, false) => to = to.min(start / (start - end)),
            (false, true) => from = from.max(start / (start - end)),
        }
    }
    (from < to).then_some([from, to])
}

#[cfg(test)]
mod tests {
    use super::super::{Dot, Layer, Pen};
    use super::*;
    use glam::DVec3;

    /// A page of 100 × 50 mm with margins of 10 mm.
    fn marks() -> Marks {
        let pen = Pen { number: 1, name: "black".into(), width: 0.3, color: [0.0, 0.0, 0.0, 1.0] };
        let page = Page::in_millimetres(DVec2::new(80.0, 30.0), 10.0, 300.0);
        Marks { page, layers: vec![Layer::new(pen)] }
    }

    fn line(closed: bool, places: &[(f64, f64)], radius: f64) -> Polyline {
        let last = (places.len() - 1) as f64;
        let vertex = |(i, &(x, y)): (usize, &(f64, f64))| Vertex {
            at: DVec2::new(x, y),
            world: DVec3::new(x, 0.0, 0.0),
            radius,
            opacity: 1.0,
            t: i as f64 / last,
            color: None,
        };
        Polyline { vertices: places.iter().enumerate().map(vertex).collect(), closed }
    }

    fn kept(line: Polyline) -> Vec<Vec<[f64; 2]>> {
        let mut marks = marks();
        marks.layers[0].lines = vec![line];
        marks.keep_inside();
        let places =
            |l: &Polyline| l.vertices.iter().map(|v| v.at.to_array().map(|x| (x * 1e6).round() / 1e6)).collect();
        marks.layers[0].lines.iter().map(places).collect()
    }

    #[test]
    fn a_dot_is_whole_or_not_there() {
        let mut marks = marks();
        let dot = |x, y| Dot { at: DVec2::new(x, y), world: DVec3::ZERO, radius: 0.1, opacity: 1.0 };
        // The frame is [10, 90] × [10, 40]: a disc of 0.1 fits if its centre is in [10.1, 89.9] × [10.1, 39.9].
        let fits = [dot(10.1, 10.1), dot(89.9, 39.9), dot(50.0, 25.0)];
        let not = [dot(10.099, 20.0), dot(20.0, 10.099), dot(89.901, 20.0), dot(20.0, 39.901), dot(5.0, 20.0)];
        marks.layers[0].dots = fits.into_iter().chain(not).collect();
        marks.keep_inside();
        assert_eq!(marks.layers[0].dots, fits);
    }

    #[test]
    fn a_line_is_cut_half_its_width_before_the_edge() {
        assert_eq!(kept(line(false, &[(0.0, 20.0), (100.0, 20.0)], 0.5)), [[[10.5, 20.0], [89.5, 20.0]]]);
        assert_eq!(kept(line(false, &[(20.0, 0.0), (20.0, 60.0)], 0.5)), [[[20.0, 10.5], [20.0, 39.5]]]);
        assert_eq!(kept(line(false, &[(0.0, 5.0), (100.0, 5.0)], 0.5)), [[[0.0; 2]; 0]; 0]);
        assert_eq!(kept(line(false, &[(20.0, 20.0), (30.0, 30.0)], 0.5)), [[[20.0, 20.0], [30.0, 30.0]]]);
    }

    #[test]
    fn a_line_that_comes_back_is_two() {
        let parts = kept(line(false, &[(50.0, 30.0), (50.0, 60.0), (60.0, 60.0), (60.0, 20.0), (70.0, 20.0)], 0.5));
        assert_eq!(parts, [vec![[50.0, 30.0], [50.0, 39.5]], vec![[60.0, 39.5], [60.0, 20.0], [70.0, 20.0]]]);
        // A ring, open where it was cut.
        let parts = kept(line(true, &[(50.0, 30.0), (50.0, 60.0), (60.0, 60.0), (60.0, 30.0)], 0.5));
        assert_eq!(parts, [vec![[50.0, 30.0], [50.0, 39.5]], vec![[60.0, 39.5], [60.0, 30.0], [50.0, 30.0]]]);
    }

    #[test]
    fn what_was_cut_keeps_its_numbers() {
        let mut marks = marks();
        marks.layers[0].lines = vec![line(false, &[(20.0, 20.0), (100.0, 20.0)], 0.0)];
        marks.keep_inside();
        let end = marks.layers[0].lines[0].vertices[1];
        // 90 of the way from 20 to 100: 70/80.
        assert!((end.t - 0.875).abs() < 1e-9 && (end.world.x - 90.0).abs() < 1e-6, "{end:?}");
    }
}
