//! Clipping of marks to the frame ([STIP-16]): dots and text are kept whole or not at all, lines and areas are cut.

use super::{Marks, Polyline, Text, Vertex};
use glam::DVec2;

impl Marks {
    /// Clips the marks to the frame. A dot stays if all of its disc is inside. A line stays where its middle is at
    /// least half its width inside. A line that leaves and comes back becomes several lines, whose vertices keep their
    /// `t`.
    ///
    /// An area stays where it is inside. A line of text stays if its start is inside, even if its end is not, because
    /// this crate does not know its font.
    pub fn keep_inside(&mut self) {
        let frame = self.page.frame();
        for layer in &mut self.layers {
            layer.dots.retain(|dot| inside(frame, dot.at, dot.radius));
            let lines = std::mem::take(&mut layer.lines);
            let parts = lines.into_iter().flat_map(|line| {
                if line.vertices.iter().all(|v| inside(frame, v.at, v.radius)) {
                    return vec![line];
                }
                cut(&line, &|a, b| [range(frame, a, b, 1.0), None])
            });
            layer.lines = parts.collect();
            for area in &mut layer.areas {
                area.outlines.iter_mut().for_each(|outline| *outline = clip(frame, std::mem::take(outline)));
                area.outlines.retain(|outline| outline.len() > 2);
            }
            layer.areas.retain(|area| !area.outlines.is_empty());
            layer.texts.retain(|text| text.at.is_finite() && inside(frame, text.at, 0.0));
        }
    }

    /// Cuts a rectangle out of the marks. Dots and text that reach into it are removed, lines and areas are cut. Lines end
    /// half their width before it. `extent` gives the corners of a text. Returns the removed texts.
    pub fn cut_out(&mut self, hole: [DVec2; 2], extent: &dyn Fn(&Text) -> [DVec2; 2]) -> Vec<Text> {
        let [low, high] = hole;
        let [least, most] = [DVec2::NEG_INFINITY, DVec2::INFINITY];
        let strips = [
            [least, DVec2::new(low.x, most.y)],
            [DVec2::new(high.x, least.y), most],
            [DVec2::new(low.x, least.y), DVec2::new(high.x, low.y)],
            [DVec2::new(low.x, high.y), DVec2::new(high.x, most.y)],
        ];
        let crossed = |a: &Vertex, b: &Vertex| range(hole, a, b, -1.0);
        let mut removed = Vec::new();
        for layer in &mut self.layers {
            layer.dots.retain(|dot| !inside(hole, dot.at, -dot.radius));
            let lines = std::mem::take(&mut layer.lines).into_iter();
            let rest = lines.flat_map(|line| {
                if line.segments().all(|(a, b)| crossed(a, b).is_none()) {
                    return vec![line];
                }
                cut(&line, &|a, b| match crossed(a, b) {
                    Some([from, to]) => [(from > 0.0).then_some([0.0, from]), (to < 1.0).then_some([to, 1.0])],
                    None => [Some([0.0, 1.0]), None],
                })
            });
            layer.lines = rest.collect();
            for area in &mut layer.areas {
                let part = |strip: [DVec2; 2]| area.outlines.iter().map(move |outline| clip(strip, outline.clone()));
                if part(hole).any(|outline| outline.len() > 2) {
                    // One area, since the edges between two would be seen.
                    area.outlines = strips.into_iter().flat_map(part).filter(|outline| outline.len() > 2).collect();
                }
            }
            layer.areas.retain(|area| !area.outlines.is_empty());
            removed.extend(layer.texts.extract_if(.., |text| {
                let [start, end] = extent(text);
                start.cmplt(high).all() && end.cmpgt(low).all()
            }));
        }
        removed
    }

    /// Moves the marks on their page.
    pub fn shift(&mut self, way: DVec2) {
        for layer in &mut self.layers {
            layer.dots.iter_mut().for_each(|dot| dot.at += way);
            layer.lines.iter_mut().flat_map(|line| &mut line.vertices).for_each(|vertex| vertex.at += way);
            layer.areas.iter_mut().flat_map(|area| &mut area.outlines).flatten().for_each(|at| *at += way);
            layer.texts.iter_mut().for_each(|text| text.at += way);
        }
    }
}

/// The largest distance, in mm, of a place outside the frame that still counts as inside. It is less than half a step
/// of places.
const SLACK: f64 = 1e-9;

fn slackened([low, high]: [DVec2; 2]) -> [DVec2; 2] {
    [low - SLACK, high + SLACK]
}

fn inside([low, high]: [DVec2; 2], at: DVec2, radius: f64) -> bool {
    let near = at - low - (radius - SLACK);
    let far = high - (radius - SLACK) - at;
    near.min_element() >= 0.0 && far.min_element() >= 0.0
}

/// Returns an outline without its part outside the frame. An outline that lies inside stays as it is.
///
/// Sutherland and Hodgman cut one side of the frame after another. An outline that leaves and comes back stays one,
/// joined along the frame's edge, which adds no area. Winding numbers inside the frame stay.
fn clip(frame: [DVec2; 2], mut outline: Vec<DVec2>) -> Vec<DVec2> {
    let [lo, hi] = slackened(frame);
    let sides: [&dyn Fn(DVec2) -> f64; 4] = [&|p| p.x - lo.x, &|p| p.y - lo.y, &|p| hi.x - p.x, &|p| hi.y - p.y];
    for distance in sides {
        if outline.iter().all(|&p| distance(p) >= 0.0) {
            continue;
        }
        let mut kept = Vec::with_capacity(outline.len() + 2);
        for (i, &to) in outline.iter().enumerate() {
            let from = outline[if i == 0 { outline.len() - 1 } else { i - 1 }];
            let (start, end) = (distance(from), distance(to));
            if (start >= 0.0) != (end >= 0.0) {
                kept.push(from.lerp(to, start / (start - end)));
            }
            if end >= 0.0 {
                kept.push(to);
            }
        }
        outline = kept;
    }
    outline
}

/// Intervals of a segment, from 0 at its start to 1 at its end, in their order.
type Intervals = [Option<[f64; 2]>; 2];

/// The parts of a line that stay, open. `kept` gives those of a segment.
fn cut(line: &Polyline, kept: &dyn Fn(&Vertex, &Vertex) -> Intervals) -> Vec<Polyline> {
    let mut parts: Vec<Vec<Vertex>> = Vec::new();
    // Whether the last part ends where the next segment begins.
    let mut joins = false;
    for (a, b) in line.segments() {
        let intervals = kept(a, b);
        for [from, to] in intervals.into_iter().flatten() {
            let end = a.between(b, to);
            match parts.last_mut() {
                Some(part) if joins && from == 0.0 => part.push(end),
                _ => parts.push(vec![a.between(b, from), end]),
            }
            joins = to == 1.0;
        }
        joins &= intervals.iter().any(Option::is_some);
    }
    parts.into_iter().map(|vertices| Polyline { vertices, closed: false }).collect()
}

impl Polyline {
    /// The ends of the segments, in their order.
    fn segments(&self) -> impl Iterator<Item = (&Vertex, &Vertex)> {
        let first = self.vertices.first().filter(|_| self.closed);
        self.vertices.iter().zip(self.vertices.iter().skip(1).chain(first))
    }
}

/// Returns the interval of a segment, from 0 to 1, in which the pen is inside the frame, or for `sign` = −1 in which it
/// touches the frame. Place and radius are linear along the segment, so each side of the frame keeps one interval.
fn range(frame: [DVec2; 2], a: &Vertex, b: &Vertex, sign: f64) -> Option<[f64; 2]> {
    let [lo, hi] = slackened(frame);
    let [from, to] = [a, b].map(|v| (v.at - lo - sign * v.radius, hi - v.at - sign * v.radius));
    clipped([(from.0.x, to.0.x), (from.0.y, to.0.y), (from.1.x, to.1.x), (from.1.y, to.1.y)])
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
    use super::super::{Area, Dot, Layer, Page, Pen, Text};
    use super::*;
    use glam::DVec3;
    use proptest::prelude::*;

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

    fn area(outlines: &[&[(f64, f64)]]) -> Area {
        let outline = |places: &&[(f64, f64)]| places.iter().copied().map(DVec2::from).collect();
        Area { outlines: outlines.iter().map(outline).collect(), opacity: 1.0, color: None }
    }

    fn kept_areas(areas: &[Area]) -> Vec<Area> {
        let mut marks = marks();
        marks.layers[0].areas = areas.to_vec();
        marks.keep_inside();
        marks.layers.remove(0).areas
    }

    /// Half the sum of cross products.
    fn signed_area(outline: &[DVec2]) -> f64 {
        outline.iter().zip(outline.iter().cycle().skip(1)).map(|(a, b)| a.perp_dot(*b) / 2.0).sum()
    }

    #[test]
    fn an_area_is_cut_at_the_frame() {
        let inside = area(&[&[(10.0, 10.0), (90.0, 10.0), (90.0, 40.0)], &[(20.0, 15.0), (20.0, 20.0), (25.0, 20.0)]]);
        let outside = area(&[&[(0.0, 0.0), (9.0, 0.0), (9.0, 50.0)], &[(91.0, 20.0), (95.0, 20.0), (95.0, 30.0)]]);
        assert_eq!(kept_areas(&[inside.clone(), outside]), [inside]);
        // The frame is [10, 90] × [10, 40]. A box over its corner keeps 10 × 5 mm, turned as before.
        let corner = kept_areas(&[area(&[&[(0.0, 0.0), (20.0, 0.0), (20.0, 15.0), (0.0, 15.0)]])]);
        assert!((signed_area(&corner[0].outlines[0]) - 50.0).abs() < 1e-6, "{corner:?}");
        // Two teeth of 10 × 10 mm, joined outside; the hole outside is gone.
        let teeth = [(20.0, 30.0), (30.0, 30.0), (30.0, 45.0), (40.0, 45.0), (40.0, 30.0), (50.0, 30.0), (50.0, 48.0)];
        let teeth: Vec<_> = teeth.into_iter().chain([(20.0, 48.0)]).collect();
        let found = kept_areas(&[area(&[&teeth, &[(32.0, 46.0), (32.0, 47.0), (33.0, 47.0)]])]);
        assert_eq!(found[0].outlines.len(), 1);
        assert!((signed_area(&found[0].outlines[0]) - 200.0).abs() < 1e-6, "{found:?}");
    }

    #[test]
    fn text_stays_if_its_start_is_inside() {
        let mut marks = marks();
        let text = |x, y| Text { characters: "label".into(), at: DVec2::new(x, y), size: 3.0, opacity: 1.0 };
        let stays = [text(10.0, 10.0), text(90.0, 40.0)];
        let goes = [text(9.999, 20.0), text(20.0, 40.001), text(f64::NAN, 20.0)];
        marks.layers[0].texts = stays.iter().chain(&goes).cloned().collect();
        marks.keep_inside();
        assert_eq!(marks.layers[0].texts, stays);
    }

    /// Turns of an outline around a point.
    fn winding(outline: &[DVec2], at: DVec2) -> i32 {
        let turn = |(a, b): (&DVec2, &DVec2)| {
            let left = (*b - *a).perp_dot(at - *a) > 0.0;
            i32::from(a.y <= at.y && b.y > at.y && left) - i32::from(a.y > at.y && b.y <= at.y && !left)
        };
        outline.iter().zip(outline.iter().cycle().skip(1)).map(turn).sum()
    }

    proptest! {
        /// Points inside the frame keep their winding number, and points outside have none.
        #[test]
        fn a_cut_area_keeps_its_winding_numbers(
            places in prop::collection::vec((-20.0..120.0, -20.0..70.0), 3..12),
            probes in prop::collection::vec((-20.0..120.0, -20.0..70.0), 30),
        ) {
            let outline: Vec<DVec2> = places.iter().copied().map(DVec2::from).collect();
            let kept = kept_areas(&[area(&[&places])]);
            let kept = kept.first().map_or(&[][..], |area| &area.outlines[0]);
            for at in probes.into_iter().map(DVec2::from) {
                // Rounding may move an edge by a little.
                let near = outline.iter().zip(outline.iter().cycle().skip(1)).any(|(a, b)| {
                    ((*b - *a).perp_dot(at - *a) / a.distance(*b)).abs() < 1e-6
                });
                if !near {
                    let within = inside(marks().page.frame(), at, 0.0);
                    prop_assert_eq!(winding(kept, at), if within { winding(&outline, at) } else { 0 });
                }
            }
        }
    }

    /// A rectangle takes its share of a line and of an area, and what begins in it.
    #[test]
    fn a_rectangle_is_cut_out() {
        let mut marks = marks();
        let hole = [DVec2::new(30.0, 15.0), DVec2::new(50.0, 30.0)];
        let layer = &mut marks.layers[0];
        layer.lines = vec![line(false, &[(20.0, 20.0), (80.0, 20.0)], 0.5)];
        layer.areas = vec![area(&[&[(20.0, 12.0), (60.0, 12.0), (60.0, 35.0), (20.0, 35.0)]])];
        let dot = |x, y| Dot { at: DVec2::new(x, y), world: DVec3::ZERO, radius: 0.1, opacity: 1.0 };
        layer.dots = vec![dot(40.0, 20.0), dot(40.0, 31.0)];
        let text = |x| Text { characters: "label".into(), at: DVec2::new(x, 20.0), size: 3.0, opacity: 1.0 };
        layer.texts = vec![text(21.0), text(19.0)];
        // Texts of 10 mm: one ends in the rectangle, one before it.
        let removed = marks.cut_out(hole, &|text| [text.at, text.at + DVec2::new(10.0, 1.0)]);
        let layer = &marks.layers[0];
        assert_eq!((removed, &*layer.texts), (vec![text(21.0)], &[text(19.0)][..]));
        let ends: Vec<f64> = layer.lines.iter().flat_map(|line| line.vertices.iter().map(|v| v.at.x)).collect();
        assert!(ends.iter().zip([20.0, 29.5, 50.5, 80.0]).all(|(a, b)| (a - b).abs() < 1e-6), "{ends:?}");
        let shoelace = |outline: &Vec<DVec2>| -> f64 {
            let turned = outline.iter().cycle().skip(1);
            outline.iter().zip(turned).map(|(a, b)| a.perp_dot(*b) / 2.0).sum::<f64>().abs()
        };
        let left: f64 = layer.areas.iter().flat_map(|area| &area.outlines).map(shoelace).sum();
        assert!((left - (40.0 * 23.0 - 20.0 * 15.0)).abs() < 1e-6, "{left}");
        assert_eq!(layer.dots, [dot(40.0, 31.0)]);
        marks.shift(DVec2::new(1.0, 2.0));
        assert_eq!(marks.layers[0].dots[0].at, DVec2::new(41.0, 33.0));
    }

    proptest! {
        /// A point of a line stays if the rectangle, grown by the line's radius, does not hold it. A point of an area
        /// stays if it lies beside the rectangle. A dot stays if its disc does.
        #[test]
        fn only_what_a_rectangle_covers_is_cut_out(
            corners in prop::array::uniform2((0.0..100.0, 0.0..50.0)),
            places in prop::collection::vec((-20.0..120.0, -20.0..70.0), 3..9),
            closed: bool,
            radius in 0.0..5.0,
            probes in prop::collection::vec((-20.0..120.0, -20.0..70.0), 30),
        ) {
            let [a, b] = corners.map(DVec2::from);
            let hole = [a.min(b), a.max(b)];
            let probes: Vec<DVec2> = probes.into_iter().map(DVec2::from).collect();
            let mut marks = marks();
            let dot = |at: &DVec2| Dot { at: *at, world: DVec3::ZERO, radius, opacity: 1.0 };
            let whole = line(closed, &places, radius);
            let layer = &mut marks.layers[0];
            layer.lines = vec![whole.clone()];
            layer.areas = vec![area(&[&places])];
            layer.dots = probes.iter().map(dot).collect();
            marks.cut_out(hole, &|text| [text.at; 2]);
            let Layer { lines, areas, dots, .. } = &marks.layers[0];
            // How far a place lies outside the rectangle along the axes.
            let outside = |at: DVec2| (hole[0] - at).max(at - hole[1]).max_element();
            let away = |at: DVec2, (a, b): (&Vertex, &Vertex)| {
                let share = ((at - a.at).dot(b.at - a.at) / a.at.distance_squared(b.at)).clamp(0.0, 1.0);
                at.distance(a.at.lerp(b.at, if share.is_nan() { 0.0 } else { share }))
            };
            for (i, (from, to)) in whole.segments().enumerate() {
                for at in (0..=50).map(|n| from.at.lerp(to.at, f64::from(n) / 50.0)) {
                    let stays = lines.iter().flat_map(Polyline::segments).any(|part| away(at, part) < 1e-6);
                    let crosses = whole.segments().enumerate().any(|(k, part)| k != i && away(at, part) < 1e-6);
                    if (outside(at) - radius).abs() > 1e-6 && !crosses {
                        prop_assert_eq!(stays, outside(at) > radius, "{}", at);
                    }
                }
            }
            let outline: Vec<DVec2> = places.iter().copied().map(DVec2::from).collect();
            let left = |at| areas.iter().flat_map(|area| &area.outlines).map(|outline| winding(outline, at)).sum::<i32>();
            for &at in probes.iter().filter(|&&at| outside(at).abs() > 1e-6) {
                prop_assert_eq!(left(at), if outside(at) > 0.0 { winding(&outline, at) } else { 0 }, "{}", at);
                if (outside(at) - radius).abs() > 1e-6 {
                    prop_assert_eq!(dots.contains(&dot(&at)), outside(at) > radius, "{}", at);
                }
            }
        }
    }
}
