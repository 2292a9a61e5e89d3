//! Joints of outlines and creases on the page ([HATCH-22]). Ends that nearly meet are joined, and stubs are left out.

use super::gaps::{PageSegment, SegmentRaster, segments};
use drypoint_scene::glam::DVec2;
use drypoint_scene::marks::{Polyline, Vertex};
use drypoint_scene::view::View;

/// Cosine of the largest turn from a line's last direction to the end with which it is joined.
const TURN: f64 = 0.5;

/// Cosine of the largest turn from a line's last direction to the side of the line to which it is extended.
const TURN_ASIDE: f64 = 0.5;

/// The largest distance of an end from the line to which it is extended, in reaches. Across a small hole there is
/// another line, too.
const BESIDE: f64 = 0.67;

/// Length over which the direction of an end is taken, in reaches. The last segments may be short and turn.
const TAIL: f64 = 1.5;

/// The share of the least length that suffices for a line whose ends both meet others. A short edge between two corners
/// belongs to the drawing.
const TIED: f64 = 0.75;

/// Settings of joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joining {
    /// The largest distance of two ends on the page, in mm.
    pub reach: f64,
    /// The distance at which ends meet whatever their directions, in mm. Ink covers such a distance.
    pub touch: f64,
    /// The largest difference of the ends' depths, in world units.
    pub depth: f64,
    /// The least length of a line with a loose end, in mm.
    pub min_length: f64,
}

/// One of the two ends of an open line.
#[derive(Clone, Copy, Debug, PartialEq)]
struct LineEnd {
    line: usize,
    is_last: bool,
    vertex: Vertex,
    depth: f64,
    /// Direction on the page, away from the line.
    out: DVec2,
}

/// Joins the ends of lines: nearest pairs first, then the remaining ends to the lines beside them. Leaves out lines
/// shorter than the least length. Between two other lines, three quarters of the least length are enough.
pub fn joined(lines: Vec<Polyline>, view: &View, how: &Joining) -> Vec<Polyline> {
    let ends = ends(&lines, view, how);
    let lines = chained(lines, &ends, &pairs(&ends, how));
    let (mut lines, meets) = met(lines, view, how);
    let mut meets = meets.into_iter();
    lines.retain(|line| {
        let is_tied = meets.next() == Some([true; 2]);
        line.length() >= how.min_length * if is_tied { TIED } else { 1.0 }
    });
    lines.iter_mut().for_each(measure);
    lines
}

/// Sets t to the share of a line's length on the page. The parts of a joined line have shares of their own.
fn measure(line: &mut Polyline) {
    let length = line.length();
    let mut along = 0.0;
    for i in 1..line.vertices.len() {
        along += line.vertices[i - 1].at.distance(line.vertices[i].at);
        line.vertices[i].t = if length > 0.0 { (along / length).min(1.0) } else { 0.0 };
    }
    line.vertices.iter_mut().take(1).for_each(|first| first.t = 0.0);
}

/// The ends of all open lines, first and last of each in turn.
fn ends(lines: &[Polyline], view: &View, how: &Joining) -> Vec<LineEnd> {
    let of = |(line, polyline): (usize, &Polyline)| {
        let vertices = &polyline.vertices;
        let sides = if polyline.closed || vertices.len() < 2 { Vec::new() } else { vec![false, true] };
        let end = |is_last: bool| {
            let inward: Vec<&Vertex> =
                if is_last { vertices.iter().rev().collect() } else { vertices.iter().collect() };
            let from = inward.iter().find(|vertex| vertex.at.distance(inward[0].at) >= TAIL * how.reach);
            let from = from.unwrap_or(&inward[inward.len() - 1]);
            let (vertex, depth) = (*inward[0], -view.to_eye(inward[0].world).z);
            LineEnd { line, is_last, vertex, depth, out: (vertex.at - from.at).normalize_or_zero() }
        };
        sides.into_iter().map(end).collect::<Vec<_>>()
    };
    lines.iter().enumerate().flat_map(of).collect()
}

/// Pairs of ends to be joined, each end at most once.
fn pairs(ends: &[LineEnd], how: &Joining) -> Vec<[usize; 2]> {
    let mut by_x: Vec<usize> = (0..ends.len()).collect();
    by_x.sort_by(|&i, &j| ends[i].vertex.at.x.total_cmp(&ends[j].vertex.at.x));
    let mut found: Vec<(f64, [usize; 2])> = Vec::new();
    for (k, &i) in by_x.iter().enumerate() {
        let near = by_x[k + 1..].iter().take_while(|&&j| ends[j].vertex.at.x - ends[i].vertex.at.x <= how.reach);
        found.extend(near.filter_map(|&j| {
            let distance = ends[i].vertex.at.distance(ends[j].vertex.at);
            fits(&ends[i], &ends[j], distance, how).then_some((distance, [i.min(j), i.max(j)]))
        }));
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut is_taken = vec![false; ends.len()];
    found.retain(|(_, [i, j])| {
        let free = !is_taken[*i] && !is_taken[*j];
        (is_taken[*i], is_taken[*j]) = (is_taken[*i] || free, is_taken[*j] || free);
        free
    });
    found.into_iter().map(|(_, pair)| pair).collect()
}

/// Whether two ends may be joined: each line goes on towards the other.
fn fits(a: &LineEnd, b: &LineEnd, distance: f64, how: &Joining) -> bool {
    let between = (b.vertex.at - a.vertex.at).normalize_or_zero();
    let onwards = a.out.dot(between) >= TURN && b.out.dot(-between) >= TURN;
    let touches = distance <= how.touch && a.out.dot(b.out) < TURN;
    distance <= how.reach && (a.depth - b.depth).abs() <= how.depth && (onwards || touches)
}

/// Lines whose paired ends are joined, in the order of their first line.
fn chained(lines: Vec<Polyline>, ends: &[LineEnd], pairs: &[[usize; 2]]) -> Vec<Polyline> {
    // For each end of a line, the end that follows it: the line's index, and whether it is the line's last end.
    let mut follows: Vec<[Option<(usize, bool)>; 2]> = vec![[None; 2]; lines.len()];
    for &[i, j] in pairs {
        let [a, b] = [ends[i], ends[j]];
        follows[a.line][usize::from(a.is_last)] = Some((b.line, b.is_last));
        follows[b.line][usize::from(b.is_last)] = Some((a.line, a.is_last));
    }
    let mut rest: Vec<Option<Polyline>> = lines.into_iter().map(Some).collect();
    let mut chained = Vec::new();
    for start in 0..rest.len() {
        if rest[start].is_none() {
            continue;
        }
        // Goes back to the first line of the chain; a ring begins with the smallest line.
        let (mut line, mut enters_last) = (start, false);
        while let Some((before, is_last)) = follows[line][usize::from(enters_last)] {
            (line, enters_last) = (before, !is_last);
            if line == start {
                break;
            }
        }
        let mut whole: Option<Polyline> = None;
        while let Some(mut next) = rest[line].take() {
            if enters_last {
                next.vertices.reverse();
            }
            match &mut whole {
                Some(whole) => whole.vertices.append(&mut next.vertices),
                None => whole = Some(next),
            }
            match follows[line][usize::from(!enters_last)] {
                Some((after, is_last)) if rest[after].is_some() => (line, enters_last) = (after, is_last),
                // The chain closes to a ring.
                Some(_) => whole.iter_mut().for_each(|whole| whole.closed = true),
                None => {}
            }
        }
        chained.extend(whole);
    }
    chained
}

/// Extends loose ends to the lines beside them. Returns for each line whether its ends meet others. The ends of a ring
/// do.
fn met(mut lines: Vec<Polyline>, view: &View, how: &Joining) -> (Vec<Polyline>, Vec<[bool; 2]>) {
    let all: Vec<PageSegment> =
        lines.iter().enumerate().flat_map(|(number, line)| segments(line, number, view)).collect();
    let grid = SegmentRaster::new(&all, how.reach);
    let mut meets: Vec<[bool; 2]> = lines.iter().map(|line| [line.closed; 2]).collect();
    let mut added: Vec<(LineEnd, Vertex)> = Vec::new();
    for end in ends(&lines, view, how) {
        let own = PageSegment { ends: [end.vertex; 2], depths: [end.depth; 2], line: end.line };
        let place = |i: usize| {
            let other = &all[i];
            let s = other.nearest(end.vertex.at);
            let between = other.at(s) - end.vertex.at;
            let distance = between.length();
            let onwards = distance <= how.touch || end.out.dot(between / distance) >= TURN_ASIDE;
            let fits = distance <= BESIDE * how.reach && (other.depth(s) - end.depth).abs() <= how.depth && onwards;
            (other.line != end.line && fits).then_some((distance, i, s))
        };
        let nearest =
            grid.near(&own, how.reach).filter_map(place).min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        if let Some((distance, i, s)) = nearest {
            meets[end.line][usize::from(end.is_last)] = true;
            if distance > 0.0 {
                // An end that runs into a line at a small angle meets the line farther on.
                let s = if distance > how.touch { all[i].nearest(end.vertex.at + distance * end.out) } else { s };
                let on_line = all[i].ends[0].between(&all[i].ends[1], s);
                added.push((end, Vertex { at: on_line.at, world: on_line.world, ..end.vertex }));
            }
        }
    }
    for (end, vertex) in added {
        let vertices = &mut lines[end.line].vertices;
        vertices.insert(if end.is_last { vertices.len() } else { 0 }, vertex);
    }
    (lines, meets)
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::glam::DVec3;
    use drypoint_scene::space::Grid;
    use drypoint_scene::tables::{Camera, Projection};

    const HOW: Joining = Joining { reach: 1.0, touch: 0.2, depth: 3.0, min_length: 2.0 };

    /// A line through places of the page, at a height towards the eye.
    fn line(height: f64, places: &[[f64; 2]]) -> Polyline {
        let vertex = |&[x, y]: &[f64; 2]| {
            let (at, world) = (DVec2::new(x, y), DVec3::new(x, y, height));
            Vertex { at, world, radius: 0.1, opacity: 1.0, t: 0.0, color: None }
        };
        Polyline { vertices: places.iter().map(vertex).collect(), closed: false }
    }

    fn places(lines: &[Polyline]) -> Vec<Vec<[f64; 2]>> {
        lines.iter().map(|line| line.vertices.iter().map(|vertex| vertex.at.to_array()).collect()).collect()
    }

    fn join(lines: &[Polyline]) -> Vec<Polyline> {
        let grid = Grid::with_spacing([3; 3], [1.0; 3]).unwrap();
        let (projection, eye, target) =
            (Projection::Orthographic { height: None }, Some(DVec3::new(0.0, 0.0, 50.0)), Some(DVec3::ZERO));
        let camera = Camera { projection, eye, target, up: DVec3::Y, ..Camera::default() };
        joined(lines.to_vec(), &View::new(&camera, &grid, [100, 100]).unwrap(), &HOW)
    }

    #[test]
    fn ends_that_go_towards_each_other_are_joined() {
        let [a, b] = [line(0.0, &[[0.0, 0.0], [5.0, 0.0]]), line(1.0, &[[10.0, 0.0], [5.8, 0.1]])];
        let whole = join(&[a.clone(), b.clone()]);
        assert_eq!(places(&whole), [[[0.0, 0.0], [5.0, 0.0], [5.8, 0.1], [10.0, 0.0]]]);
        // Too far apart on the page, or in depth, or side by side: nothing changes.
        for other in [
            line(0.0, &[[10.0, 0.0], [6.1, 0.0]]),
            line(4.0, &[[10.0, 0.0], [5.8, 0.1]]),
            line(0.0, &[[0.0, 0.8], [5.0, 0.8]]),
        ] {
            let both = [a.clone(), other];
            assert_eq!(places(&join(&both)), places(&both));
        }
    }

    #[test]
    fn a_ring_of_parts_is_closed() {
        let half = |sign: f64| line(0.0, &[[0.1 * sign, 0.0], [4.0 * sign, 0.0], [4.0 * sign, 8.0], [0.1 * sign, 8.0]]);
        let ring = join(&[half(1.0), half(-1.0)]);
        assert_eq!((ring.len(), ring[0].closed, ring[0].vertices.len()), (1, true, 8));
    }

    #[test]
    fn ends_beside_a_line_are_drawn_up_to_it_and_stubs_are_left_out() {
        let long = line(0.0, &[[0.0, 0.0], [10.0, 0.0]]);
        let below = line(0.0, &[[5.0, 4.0], [5.0, 0.4]]);
        let met = join(&[long.clone(), below]);
        assert_eq!(places(&met)[1], [[5.0, 4.0], [5.0, 0.4], [5.0, 0.0]]);
        // 1.2 mm with a loose end are too short, 1.6 mm between two lines are not.
        let stub = line(0.0, &[[5.0, 1.4], [5.0, 0.2]]);
        assert_eq!(places(&join(&[long.clone(), stub])), [[[0.0, 0.0], [10.0, 0.0]]]);
        let other = line(0.0, &[[0.0, 1.8], [10.0, 1.8]]);
        let tie = line(0.0, &[[5.0, 1.7], [5.0, 0.1]]);
        assert_eq!(join(&[long, other, tie]).len(), 3);
    }
}
