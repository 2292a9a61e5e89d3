//! Segments of curves joined to lines, for pens and vector files ([STIP-13]).

use super::curves::CurveSegment;
use super::frame::IndexToPage;
use drypoint_scene::glam::{DVec2, DVec3};
use drypoint_scene::marks::{Page, Polyline, Vertex};
use drypoint_scene::space::Grid;
use drypoint_scene::view::View;
use std::collections::BTreeMap;

/// cos 30°, for the largest angle of directions at a joint.
const STRAIGHT: f64 = 0.866_025_403_784_438_6;

/// One end of a segment on the page: its place, its point in the world, and the length of half a voxel there.
#[derive(Clone, Copy)]
struct SegmentEnd {
    at: DVec2,
    world: DVec3,
    reach: f64,
}

/// Joins segments to lines of width 2·`radius`, in mm. Two ends closer than half a voxel on the page become one
/// vertex between them if the line turns by at most 30°. Each end is joined once, nearest pairs first.
///
/// Segments with an end nearer than `near` in perspective are left out, as are those beyond one side of the picture.
/// Segments that cross the picture's edge stay whole; the page cuts them later
/// ([`Marks::keep_inside`](drypoint_scene::marks::Marks::keep_inside)).
pub fn joined(
    segments: &[CurveSegment],
    grid: &Grid,
    view: &View,
    page: &Page,
    near: f64,
    radius: f64,
) -> Vec<Polyline> {
    let place = IndexToPage::new(view, page, grid);
    let half = 0.5 * grid.voxel() / view.pixel * page.picture().x / view.size[0] as f64;
    let end = |world: DVec3| {
        let eye = view.to_eye(world);
        let reach = if view.perspective { half / -eye.z } else { half };
        place.off(eye, near).map(|off| (place.beyond(off), SegmentEnd { at: place.at(off), world, reach }))
    };
    let both = |segment: &CurveSegment| {
        let [(a, start), (b, last)] = [end(segment.ends[0])?, end(segment.ends[1])?];
        (0..2).all(|axis| a[axis] * b[axis] <= 0.0).then_some([start, last])
    };
    let ends: Vec<SegmentEnd> = segments.iter().filter_map(both).flatten().collect();
    let partner = partners(&ends);
    lines(&ends, &partner, radius)
}

/// The end to which each end is joined. Ends 2i and 2i + 1 belong to segment i.
fn partners(ends: &[SegmentEnd]) -> Vec<Option<usize>> {
    let largest = ends.iter().fold(0.0f64, |reach, end| reach.max(end.reach));
    let cell = |p: DVec2| [(p.x / largest).floor() as i64, (p.y / largest).floor() as i64];
    let mut cells: BTreeMap<[i64; 2], Vec<usize>> = BTreeMap::new();
    for (i, end) in ends.iter().enumerate() {
        cells.entry(cell(end.at)).or_default().push(i);
    }
    // The direction out of the segment, through the end.
    let out = |i: usize| (ends[i].at - ends[i ^ 1].at).normalize_or_zero();
    let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
    for (i, end) in ends.iter().enumerate() {
        let [x, y] = cell(end.at);
        let around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| [x + dx, y + dy]));
        for &j in around.filter_map(|key| cells.get(&key)).flatten().filter(|&&j| j > i && j != i ^ 1) {
            let apart = end.at.distance(ends[j].at);
            if apart < end.reach.min(ends[j].reach) && -out(i).dot(out(j)) >= STRAIGHT {
                pairs.push((apart, i, j));
            }
        }
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut partner = vec![None; ends.len()];
    for (_, i, j) in pairs {
        if partner[i].is_none() && partner[j].is_none() {
            (partner[i], partner[j]) = (Some(j), Some(i));
        }
    }
    partner
}

/// Follows the joints: first the lines with ends, then the rings.
fn lines(ends: &[SegmentEnd], partner: &[Option<usize>], radius: f64) -> Vec<Polyline> {
    let mut is_used = vec![false; ends.len() / 2];
    let mut lines = Vec::new();
    let free = (0..ends.len()).filter(|&i| partner[i].is_none());
    for start in free.chain(0..ends.len()) {
        if is_used[start / 2] {
            continue;
        }
        let closed = partner[start].is_some();
        let mut vertices: Vec<(DVec2, DVec3)> = Vec::new();
        let middle = |i: usize| {
            let (a, b) = (ends[i], partner[i].map_or(ends[i], |j| ends[j]));
            ((a.at + b.at) / 2.0, (a.world + b.world) / 2.0)
        };
        vertices.push(middle(start));
        let mut at = start;
        loop {
            is_used[at / 2] = true;
            vertices.push(middle(at ^ 1));
            match partner[at ^ 1] {
                Some(next) if !is_used[next / 2] => at = next,
                _ => break,
            }
        }
        if closed {
            // The joint of the last segment with the first came twice.
            vertices.pop();
        }
        lines.push(line(&vertices, closed, radius));
    }
    lines
}

fn line(vertices: &[(DVec2, DVec3)], closed: bool, radius: f64) -> Polyline {
    let mut along = vec![0.0];
    for pair in vertices.windows(2) {
        along.push(along[along.len() - 1] + pair[0].0.distance(pair[1].0));
    }
    let back = if closed { vertices[vertices.len() - 1].0.distance(vertices[0].0) } else { 0.0 };
    let whole = along[along.len() - 1] + back;
    let vertex = |(&(at, world), t): (&(DVec2, DVec3), f64)| Vertex {
        at,
        world,
        radius,
        opacity: 1.0,
        t: if whole > 0.0 { t / whole } else { 0.0 },
        color: None,
    };
    Polyline { vertices: vertices.iter().zip(along).map(vertex).collect(), closed }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ends(segments: &[[(f64, f64); 2]]) -> Vec<SegmentEnd> {
        let end = |&(x, y): &(f64, f64)| SegmentEnd { at: DVec2::new(x, y), world: DVec3::new(x, y, 0.0), reach: 0.5 };
        segments.iter().flatten().map(end).collect()
    }

    fn xs(line: &Polyline) -> Vec<f64> {
        line.vertices.iter().map(|v| v.at.x).collect()
    }

    /// A picture of 10 × 10 mm that shows 10 × 10 units. A segment across its edge is kept; one beyond it is not.
    #[test]
    fn a_segment_across_the_edge_is_cut_there() {
        use drypoint_scene::marks::{Layer, Marks, Pen};
        use drypoint_scene::tables::{Camera, Length, Projection};
        let grid = Grid::new([3; 3], drypoint_scene::glam::DMat3::IDENTITY, DVec3::splat(-1.0)).unwrap();
        let camera = Camera {
            projection: Projection::Orthographic { height: Some(Length::World(10.0)) },
            direction: DVec3::NEG_Z,
            up: DVec3::Y,
            ..Camera::default()
        };
        let view = View::new(&camera, &grid, [100, 100]).unwrap();
        let page = Page::in_millimetres(DVec2::splat(10.0), 0.0, 254.0);
        let segment = |ax: f64, ay: f64, bx: f64, by: f64| CurveSegment {
            cell: [0; 3],
            normal: DVec3::X,
            ends: [DVec3::new(ax, ay, 0.0), DVec3::new(bx, by, 0.0)],
        };
        let all = [segment(4.6, 0.0, 5.6, 0.0), segment(5.1, 2.0, 6.1, 2.0), segment(0.0, 4.95, 0.0, 5.95)];
        let lines = joined(&all, &grid, &view, &page, 0.0, 0.1);
        let pen = Pen { number: 1, name: "black".into(), width: 0.2, color: [0.0, 0.0, 0.0, 1.0] };
        let mut marks = Marks { page, layers: vec![Layer { lines, ..Layer::new(pen) }] };
        marks.settle();
        let kept: Vec<Vec<[f64; 2]>> =
            marks.layers[0].lines.iter().map(|l| l.vertices.iter().map(|v| v.at.to_array()).collect()).collect();
        // From 9.6 mm to half the pen's width before the edge; the third is nearer to it.
        assert_eq!(kept, [[[9.6, 5.0], [9.9, 5.0]]]);
    }

    #[test]
    fn segments_in_a_row_are_one_line() {
        // The second is given the other way round.
        let ends = ends(&[[(0.0, 0.0), (1.0, 0.0)], [(2.2, 0.0), (1.2, 0.0)], [(2.4, 0.0), (3.4, 0.0)]]);
        let lines = lines(&ends, &partners(&ends), 0.1);
        assert_eq!(lines.len(), 1);
        let want = [0.0, 1.1, 2.3, 3.4];
        assert!(xs(&lines[0]).iter().zip(want).all(|(x, want)| (x - want).abs() < 1e-12), "{:?}", xs(&lines[0]));
        assert!((lines[0].vertices[1].t - 1.1 / 3.4).abs() < 1e-12 && !lines[0].closed);
    }

    #[test]
    fn neither_far_ends_nor_sharp_turns_are_joined() {
        for other in [[(1.6, 0.0), (2.6, 0.0)], [(1.1, 0.0), (1.1, 1.0)], [(1.1, 0.0), (0.1, 0.1)]] {
            let ends = ends(&[[(0.0, 0.0), (1.0, 0.0)], other]);
            assert_eq!(lines(&ends, &partners(&ends), 0.1).len(), 2, "{other:?}");
        }
    }

    #[test]
    fn the_nearest_two_are_joined() {
        let ends = ends(&[[(0.0, 0.0), (1.0, 0.0)], [(1.4, 0.0), (2.4, 0.0)], [(1.1, 0.1), (2.1, 0.1)]]);
        let lines = lines(&ends, &partners(&ends), 0.1);
        assert_eq!(lines.iter().map(|l| l.vertices.len()).collect::<Vec<_>>(), [3, 2]);
        assert!((lines[0].vertices[2].at - DVec2::new(2.1, 0.1)).length() < 1e-12);
    }

    #[test]
    fn a_ring_closes() {
        let corner = |i: i32| {
            let t = f64::from(i) * std::f64::consts::TAU / 24.0;
            (4.0 * t.cos(), 4.0 * t.sin())
        };
        let ring: Vec<[(f64, f64); 2]> = (0..24).map(|i| [corner(i), corner(i + 1)]).collect();
        let ends = ends(&ring);
        let lines = lines(&ends, &partners(&ends), 0.1);
        assert_eq!((lines.len(), lines[0].vertices.len(), lines[0].closed), (1, 24, true));
        assert!((lines[0].vertices[23].t - 23.0 / 24.0).abs() < 1e-12);
    }
}
