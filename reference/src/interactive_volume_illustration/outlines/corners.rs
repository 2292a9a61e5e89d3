//! Corners, at which creases meet ([HATCH-22]).
//!
//! At a corner both principal curvatures are equal, and no crease reaches it. Edges rounded by r end at a distance of r
//! from each other. If a crease turns into another one near the corner, it is cut there, and both parts end before the
//! corner.

use crate::surface::IsoSurface;
use drypoint_scene::glam::DVec3;
use drypoint_scene::strokes::{Stroke, StrokeVertex};

/// Cosine of the largest angle between a crease's last direction and the end of another crease that it meets.
const TURN: f64 = 0.3;

/// Length over which the direction of an end is taken, in voxels. The last voxel may bend towards the corner.
const TAIL: f64 = 3.0;

/// Length of the parts before and after a corner, in voxels.
const ARM: f64 = 3.0;

/// Cosine of the angle by which a crease turns at a corner, between the parts of [`ARM`] before and after it.
const CORNER: f64 = 0.5;

/// Length left out on either side of a corner where a crease is cut, in voxels.
const CUT: f64 = 1.0;

/// An end of an open stroke.
struct CreaseEnd {
    stroke: usize,
    is_last: bool,
    at: DVec3,
    normal: DVec3,
    /// Direction away from the stroke.
    out: DVec3,
}

/// Joins ends that lie within `reach` world units of each other and point towards each other. Each of them gets the
/// same place on the surface as a new end.
pub(super) fn with_corners(surface: &IsoSurface<'_, '_>, mut strokes: Vec<Stroke>, reach: f64) -> Vec<Stroke> {
    let grid = surface.field().volume().grid();
    strokes = strokes.iter().flat_map(|stroke| without_corners(stroke, grid.voxel())).collect();
    let mut ends = ends(&strokes, TAIL * grid.voxel());
    ends.sort_by(|a, b| a.at.x.total_cmp(&b.at.x));
    let mut is_rest = vec![false; strokes.len()];
    for group in groups(&ends, reach) {
        // A short piece between two ends of one corner belongs to the corner itself.
        let of = |stroke: usize| group.iter().filter(|&&i| ends[i].stroke == stroke).count();
        let short = |stroke: usize| of(stroke) == 2 && strokes[stroke].length() <= reach;
        let rests: Vec<usize> = group.iter().map(|&i| ends[i].stroke).filter(|&stroke| short(stroke)).collect();
        rests.into_iter().for_each(|stroke| is_rest[stroke] = true);
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
    let mut is_rest = is_rest.into_iter();
    strokes.retain(|_| is_rest.next() == Some(false));
    strokes
}

/// A stroke's vertex at an arc length from its first vertex. The range ends with the stroke.
fn along(vertices: &[StrokeVertex], lengths: &[f64], s: f64) -> StrokeVertex {
    let i = lengths.partition_point(|&length| length < s).clamp(1, lengths.len() - 1);
    let (a, b, whole) = (&vertices[i - 1], &vertices[i], lengths[i] - lengths[i - 1]);
    let t = if whole > 0.0 { ((s - lengths[i - 1]) / whole).clamp(0.0, 1.0) } else { 0.0 };
    let normal = a.normal.lerp(b.normal, t).normalize_or(a.normal);
    StrokeVertex { world: a.world.lerp(b.world, t), normal, u: a.u + (b.u - a.u) * t }
}

/// Cuts a stroke where it turns sharply.
fn without_corners(stroke: &Stroke, voxel: f64) -> Vec<Stroke> {
    let again = stroke.vertices.first().filter(|_| stroke.closed).map(|first| StrokeVertex { u: 1.0, ..*first });
    let vertices: Vec<StrokeVertex> = stroke.vertices.iter().copied().chain(again).collect();
    let mut lengths = vec![0.0];
    for pair in vertices.windows(2) {
        lengths.push(lengths[lengths.len() - 1] + pair[0].world.distance(pair[1].world));
    }
    let whole = lengths[lengths.len() - 1];
    let at = |s: f64| along(&vertices, &lengths, s).world;
    let cosine = |s: f64| {
        let [a, b, c] = [s - ARM * voxel, s, s + ARM * voxel].map(at);
        (b - a).normalize_or_zero().dot((c - b).normalize_or_zero())
    };
    // The sharpest place of each stretch that turns by more than a corner, in steps of a quarter of a voxel.
    let places = ((whole - ARM * voxel) / (0.25 * voxel)).max(0.0) as u32;
    let (mut corners, mut sharpest): (Vec<f64>, Option<(f64, f64)>) = (Vec::new(), None);
    for s in (0..=places).map(|k| f64::from(k) * 0.25 * voxel).filter(|&s| s >= ARM * voxel) {
        let turn = cosine(s);
        if turn < CORNER {
            sharpest = sharpest.filter(|(least, _)| *least <= turn).or(Some((turn, s)));
        } else {
            corners.extend(sharpest.take().map(|(_, s)| s));
        }
    }
    corners.extend(sharpest.map(|(_, s)| s));
    if corners.is_empty() {
        return vec![stroke.clone()];
    }
    let cut = CUT * voxel;
    let from = [0.0].into_iter().chain(corners.iter().map(|s| s + cut));
    let to = corners.iter().map(|s| s - cut).chain([whole]);
    let part = |(from, to): (f64, f64)| {
        let inside = vertices.iter().zip(&lengths).filter(|(_, s)| (from..to).contains(*s)).map(|(vertex, _)| *vertex);
        let ends = [from, to].map(|s| along(&vertices, &lengths, s));
        let vertices: Vec<StrokeVertex> =
            [ends[0]].into_iter().chain(inside.skip_while(|v| v.world == ends[0].world)).chain([ends[1]]).collect();
        (to > from).then_some(Stroke { vertices, closed: false, key: stroke.key })
    };
    let mut parts: Vec<Stroke> = from.zip(to).filter_map(part).collect();
    if let (true, [first, .., last]) = (stroke.closed, parts.as_mut_slice())
        && first.vertices[0].world == last.vertices[last.vertices.len() - 1].world
    {
        // The last part of a ring continues in the first.
        last.vertices.pop();
        last.vertices.append(&mut first.vertices);
        parts.remove(0);
    }
    parts
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
