//! Corners, at which creases meet ([HATCH-22]).
//!
//! At a corner both principal curvatures are equal, and no crease reaches it: edges rounded by r end r from each other.

use crate::surface::IsoSurface;
use drypoint_scene::glam::DVec3;
use drypoint_scene::strokes::{Stroke, StrokeVertex};

/// Cosine of the largest angle between a crease's last direction and the end of another crease that it meets.
const TURN: f64 = 0.5;

/// Length over which the direction of an end is taken, in voxels.
const TAIL: f64 = 1.5;

/// An end of an open stroke.
struct CreaseEnd {
    stroke: usize,
    is_last: bool,
    at: DVec3,
    normal: DVec3,
    /// Direction away from the stroke.
    out: DVec3,
}

/// Joins ends that lie within `reach` world units of each other and go towards each other. Each of them gets the same
/// place on the surface as a new end.
pub(super) fn with_corners(surface: &IsoSurface<'_, '_>, mut strokes: Vec<Stroke>, reach: f64) -> Vec<Stroke> {
    let grid = surface.field().volume().grid();
    let mut ends = ends(&strokes, TAIL * grid.voxel());
    ends.sort_by(|a, b| a.at.x.total_cmp(&b.at.x));
    for group in groups(&ends, reach) {
        let mean =
            |of: fn(&CreaseEnd) -> DVec3| group.iter().map(|&i| of(&ends[i])).sum::<DVec3>() / group.len() as f64;
        let (middle, normal) = (grid.to_index(mean(|end| end.at)), mean(|end| end.normal).normalize_or_zero());
        let Some(foot) = surface.foot(middle, normal, reach) else { continue };
        let Some(normal) = surface.normal(foot) else { continue };
        for end in group.iter().map(|&i| &ends[i]) {
            let vertices = &mut strokes[end.stroke].vertices;
            let (at, u) = if end.is_last { (vertices.len(), 1.0) } else { (0, 0.0) };
            vertices.insert(at, StrokeVertex { world: grid.to_world(foot), normal, u });
        }
    }
    strokes
}

fn ends(strokes: &[Stroke], tail: f64) -> Vec<CreaseEnd> {
    let of = |(number, stroke): (usize, &Stroke)| {
        let vertices = &stroke.vertices;
        let end = |is_last: bool| {
            let last = vertices.len() - 1;
            let inward = |i: usize| &vertices[if is_last { last - i } else { i }];
            let end = inward(0);
            let from = (1..last).find(|&i| inward(i).world.distance(end.world) >= tail).unwrap_or(last);
            let out = (end.world - inward(from).world).normalize_or_zero();
            CreaseEnd { stroke: number, is_last, at: end.world, normal: end.normal, out }
        };
        let is_open = !stroke.closed && vertices.len() > 1;
        [false, true].into_iter().filter(move |_| is_open).map(end).collect::<Vec<_>>()
    };
    strokes.iter().enumerate().flat_map(of).collect()
}

/// Groups of two or more ends, which are sorted by x, in the order of their first ends.
fn groups(ends: &[CreaseEnd], reach: f64) -> Vec<Vec<usize>> {
    let mut group: Vec<usize> = (0..ends.len()).collect();
    let root = |group: &[usize], mut i: usize| {
        while group[i] != i {
            i = group[i];
        }
        i
    };
    for i in 0..ends.len() {
        for j in (i + 1..ends.len()).take_while(|&j| ends[j].at.x - ends[i].at.x <= reach) {
            let way = ends[j].at - ends[i].at;
            let towards = way.normalize_or_zero();
            if way.length() <= reach && ends[i].out.dot(towards) >= TURN && ends[j].out.dot(-towards) >= TURN {
                let [a, b] = [root(&group, i), root(&group, j)];
                group[a.max(b)] = a.min(b);
            }
        }
    }
    let mut found: Vec<Vec<usize>> = vec![Vec::new(); ends.len()];
    (0..ends.len()).for_each(|i| found[root(&group, i)].push(i));
    found.retain(|group| group.len() > 1);
    found
}
