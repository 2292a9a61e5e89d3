//! Parts of lines beside other lines: gaps where a nearer line crosses (Appel, Rohlf and Stein 1979; [HATCH-20]), and
//! creases that coincide with outlines ([HATCH-22]).

use drypoint_scene::glam::DVec2;
use drypoint_scene::marks::{Layer, Polyline, Vertex};
use drypoint_scene::parallel;
use drypoint_scene::view::View;

/// Lines with gaps, and the number of cuts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GappedLines {
    /// Lines in their order; the parts of a line in their order along it.
    pub lines: Vec<Polyline>,
    /// Number of cuts of segments.
    pub cuts: u64,
}

/// Cuts a gap into each line where a nearer line crosses it. A place is cut out if it lies within `gap` mm on the
/// page of another line, of `lines` or `others`, that is nearer to the eye. Where the two lines are closest, the
/// depths must differ by more than `deeper`, in world units along the view.
///
/// The gap is measured between centre lines. Each line is cut by all others as they were before cutting. A line never
/// cuts itself: a line that runs away from the eye would.
pub fn gapped(lines: &[Polyline], others: &[Polyline], view: &View, gap: f64, deeper: f64) -> GappedLines {
    let all: Vec<PageSegment> =
        lines.iter().chain(others).enumerate().flat_map(|(number, line)| segments(line, number, view)).collect();
    cut(lines, &all, view, gap, 0.0, CutBy::Nearer(deeper))
}

/// Cuts gaps of `gap` mm into the lines of the first `own` layers where nearer lines of any layer cross them, as
/// [`gapped`] does. Returns the number of cut segments. All gaps refer to the lines before any was cut.
pub fn cut_gaps([gap, deeper]: [f64; 2], layers: &mut [Layer], own: usize, view: &View) -> u64 {
    let before: Vec<Vec<Polyline>> = layers.iter().map(|layer| layer.lines.clone()).collect();
    let mut cuts = 0;
    for (i, layer) in layers.iter_mut().take(own).enumerate() {
        let others = before.iter().enumerate().filter(|(other, _)| *other != i);
        let others: Vec<Polyline> = others.flat_map(|(_, lines)| lines.iter().cloned()).collect();
        let found = gapped(&layer.lines, &others, view, gap, deeper);
        cuts += found.cuts;
        layer.lines = found.lines;
    }
    cuts
}

/// The least length of a stretch beside another line, in gaps, from which on it is a double of that line. On a shorter
/// stretch one line runs into the other.
const DOUBLE: f64 = 10.0;

/// Removes the parts of lines that run along another line on the page, at an angle of at most 45°. These are parts
/// within `touch` mm, which ink covers, and stretches of at least ten gaps within `gap` mm. Where both lines are
/// closest, their depths must differ by at most `depth`, in world units along the view.
pub fn without_doubles(
    lines: &[Polyline],
    others: &[Polyline],
    view: &View,
    [touch, gap]: [f64; 2],
    depth: f64,
) -> GappedLines {
    let numbered = others.iter().zip(lines.len()..);
    let all: Vec<PageSegment> = numbered.flat_map(|(line, number)| segments(line, number, view)).collect();
    let far = cut(lines, &all, view, gap, DOUBLE * gap, CutBy::Along(depth));
    let near = cut(&far.lines, &all, view, touch, 0.0, CutBy::Along(depth));
    GappedLines { lines: near.lines, cuts: far.cuts + near.cuts }
}

/// Removes intervals of segments that form stretches shorter than a length in mm.
fn without_short_ways(own: &[PageSegment], out: &mut [Vec<[f64; 2]>], least: f64) {
    let lengths: Vec<f64> = own.iter().map(|segment| segment.ends[0].at.distance(segment.ends[1].at)).collect();
    let starts: Vec<f64> = lengths
        .iter()
        .scan(0.0, |along, length| {
            *along += length;
            Some(*along - length)
        })
        .collect();
    let on_line = |i: usize, [from, to]: [f64; 2]| [starts[i] + from * lengths[i], starts[i] + to * lengths[i]];
    let mut pieces: Vec<[f64; 2]> =
        out.iter().enumerate().flat_map(|(i, out)| out.iter().map(move |&range| on_line(i, range))).collect();
    pieces.sort_by(|a, b| a[0].total_cmp(&b[0]));
    // Pieces that meet form one stretch.
    let mut ways: Vec<[f64; 2]> = Vec::new();
    for piece in pieces {
        match ways.last_mut() {
            Some(way) if piece[0] <= way[1] + MEET * least => way[1] = way[1].max(piece[1]),
            _ => ways.push(piece),
        }
    }
    for (i, out) in out.iter_mut().enumerate() {
        out.retain(|&range| {
            let from = on_line(i, range)[0];
            ways[..ways.partition_point(|way| way[0] <= from)].last().is_some_and(|way| way[1] - way[0] >= least)
        });
    }
}

/// The largest distance of two pieces of one stretch, as a share of the least length. It covers rounding.
const MEET: f64 = 1e-6;

/// The rule for lines that cut, by their depths.
#[derive(Clone, Copy)]
enum CutBy {
    /// Lines nearer by more than this.
    Nearer(f64),
    /// Lines of nearly the same direction whose depths differ by at most this.
    Along(f64),
}

impl CutBy {
    /// Whether a segment may cut another one.
    fn may(self, own: &PageSegment, other: &PageSegment) -> bool {
        match self {
            Self::Nearer(deeper) => own.depths[0].max(own.depths[1]) - other.depths[0].min(other.depths[1]) > deeper,
            Self::Along(_) => {
                let [a, b] = [own, other].map(|segment| segment.ends[1].at - segment.ends[0].at);
                a.dot(b).abs() >= a.perp_dot(b).abs()
            }
        }
    }

    /// Whether a place cuts another one that is deeper by `deeper`.
    fn cuts(self, deeper: f64) -> bool {
        match self {
            Self::Nearer(least) => deeper > least,
            Self::Along(most) => deeper.abs() <= most,
        }
    }
}

/// Removes the stretches of at least `least` mm within `gap` mm of segments from lines.
fn cut(lines: &[Polyline], all: &[PageSegment], view: &View, gap: f64, least: f64, by: CutBy) -> GappedLines {
    let grid = SegmentRaster::new(all, gap);
    let each = parallel::map_of(lines.iter().collect(), &|number, line: &Polyline| {
        let own: Vec<PageSegment> = segments(line, number, view).collect();
        let mut out: Vec<Vec<[f64; 2]>> = own
            .iter()
            .map(|segment| {
                let near = grid.near(segment, gap).map(|i| &all[i]).filter(|other| other.line != number);
                segment.beside_each(near, gap, by)
            })
            .collect();
        if least > 0.0 {
            without_short_ways(&own, &mut out, least);
        }
        let cuts = out.iter().filter(|out| !out.is_empty()).count() as u64;
        (if cuts == 0 { vec![line.clone()] } else { left(&own, &out, line.closed) }, cuts)
    });
    let cuts = each.iter().map(|(_, cuts)| cuts).sum();
    GappedLines { lines: each.into_iter().flat_map(|(lines, _)| lines).collect(), cuts }
}

/// A straight segment of a line.
pub(super) struct PageSegment {
    pub(super) ends: [Vertex; 2],
    pub(super) depths: [f64; 2],
    pub(super) line: usize,
}

pub(super) fn segments<'a>(
    line: &'a Polyline,
    number: usize,
    view: &'a View,
) -> impl Iterator<Item = PageSegment> + 'a {
    let again = line.vertices.first().filter(|_| line.closed).map(|first| Vertex { t: 1.0, ..*first });
    let vertices: Vec<Vertex> = line.vertices.iter().copied().chain(again).collect();
    let depth = |vertex: &Vertex| -view.to_eye(vertex.world).z;
    (1..vertices.len()).map(move |i| {
        let ends = [vertices[i - 1], vertices[i]];
        PageSegment { depths: [depth(&ends[0]), depth(&ends[1])], ends, line: number }
    })
}

impl PageSegment {
    pub(super) fn at(&self, s: f64) -> DVec2 {
        self.ends[0].at.lerp(self.ends[1].at, s)
    }

    pub(super) fn depth(&self, s: f64) -> f64 {
        self.depths[0] + (self.depths[1] - self.depths[0]) * s
    }

    /// Parameter of the place on the segment that is nearest to a point of the page.
    pub(super) fn nearest(&self, to: DVec2) -> f64 {
        let along = self.ends[1].at - self.ends[0].at;
        let square = along.length_squared();
        if square == 0.0 { 0.0 } else { ((to - self.ends[0].at).dot(along) / square).clamp(0.0, 1.0) }
    }

    /// Parameters of both segments where they are closest: at a crossing, or at an end of one of them.
    fn closest(&self, other: &Self) -> [f64; 2] {
        let (a, b) = (self.ends[1].at - self.ends[0].at, other.ends[1].at - other.ends[0].at);
        let (between, cross) = (other.ends[0].at - self.ends[0].at, a.perp_dot(b));
        let crossing = [between.perp_dot(b) / cross, between.perp_dot(a) / cross];
        if cross != 0.0 && crossing.iter().all(|s| (0.0..=1.0).contains(s)) {
            return crossing;
        }
        let own = [0.0, 1.0].map(|s| [s, other.nearest(self.at(s))]);
        let its = [0.0, 1.0].map(|t| [self.nearest(other.at(t)), t]);
        let square = |[s, t]: [f64; 2]| self.at(s).distance_squared(other.at(t));
        own.into_iter().chain(its).min_by(|&p, &q| square(p).total_cmp(&square(q))).unwrap_or_default()
    }

    /// Parts of this segment that lie within `gap` of others that cut it. The search stops when the whole segment is
    /// cut out.
    fn beside_each<'a>(&self, others: impl Iterator<Item = &'a Self>, gap: f64, by: CutBy) -> Vec<[f64; 2]> {
        let mut out = Vec::new();
        // Most segments nearby belong to the same surface and have the same depth.
        for other in others.filter(|other| by.may(self, other)) {
            out.extend(self.beside(other, gap, by));
            if out.last() == Some(&[0.0, 1.0]) {
                break;
            }
        }
        out
    }

    /// Part of this segment that lies within `gap` of another that cuts it.
    fn beside(&self, other: &Self, gap: f64, by: CutBy) -> Option<[f64; 2]> {
        let range = self.within(other, gap)?;
        let [s, t] = self.closest(other);
        by.cuts(self.depth(s) - other.depth(t)).then_some(range)
    }

    /// Part of this segment whose distance from another is at most `gap`. The neighbourhood of a segment is convex,
    /// two discs and the strip between them, so there is one part at most.
    fn within(&self, other: &Self, gap: f64) -> Option<[f64; 2]> {
        let along = self.ends[1].at - self.ends[0].at;
        let ends = other.ends.map(|end| in_disc(self.ends[0].at - end.at, along, gap));
        let axis = other.ends[1].at - other.ends[0].at;
        let length = axis.length();
        let beside = (length > 0.0).then(|| axis / length).and_then(|axis| {
            let from = self.ends[0].at - other.ends[0].at;
            let lengthwise = in_strip(from.dot(axis), along.dot(axis), [0.0, length])?;
            let across = in_strip(axis.perp_dot(from), axis.perp_dot(along), [-gap, gap])?;
            both(lengthwise, across)
        });
        let found = ends.into_iter().chain([beside]).flatten().filter_map(|range| both(range, [0.0, 1.0]));
        found.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
    }
}

fn both(a: [f64; 2], b: [f64; 2]) -> Option<[f64; 2]> {
    let range = [a[0].max(b[0]), a[1].min(b[1])];
    (range[0] < range[1]).then_some(range)
}

/// Parameters s for which from + s·along lies within `gap` of the origin.
fn in_disc(from: DVec2, along: DVec2, gap: f64) -> Option<[f64; 2]> {
    let (a, b, c) = (along.length_squared(), from.dot(along), from.length_squared() - gap * gap);
    let root = b * b - a * c;
    (a > 0.0 && root > 0.0).then(|| [(-b - root.sqrt()) / a, (-b + root.sqrt()) / a])
}

/// Parameters s for which from + s·slope lies between two numbers.
fn in_strip(from: f64, slope: f64, [lo, hi]: [f64; 2]) -> Option<[f64; 2]> {
    if slope == 0.0 {
        return (lo..=hi).contains(&from).then_some([f64::NEG_INFINITY, f64::INFINITY]);
    }
    let ends = [(lo - from) / slope, (hi - from) / slope];
    Some([ends[0].min(ends[1]), ends[0].max(ends[1])])
}

/// Parts of a line that remain when the intervals `out` of each segment are removed.
fn left(segments: &[PageSegment], out: &[Vec<[f64; 2]>], closed: bool) -> Vec<Polyline> {
    let mut parts: Vec<Vec<Vertex>> = vec![Vec::new()];
    for (segment, out) in segments.iter().zip(out) {
        let mut out = out.clone();
        out.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut from = 0.0;
        for [start, end] in out.into_iter().chain([[1.0, 1.0]]) {
            if start > from {
                let ends = [from, start].map(|s| segment.ends[0].between(&segment.ends[1], s));
                match parts.last_mut() {
                    Some(part) if from == 0.0 && !part.is_empty() => part.push(ends[1]),
                    _ => parts.push(ends.to_vec()),
                }
            }
            if start < 1.0 {
                // The next part starts anew.
                parts.push(Vec::new());
            }
            from = f64::max(from, end);
        }
    }
    parts.retain(|part| part.len() > 1);
    let seam = segments.first().map(|segment| segment.ends[0].at);
    if let (true, [first, .., last]) = (closed, parts.as_mut_slice())
        && [first.first(), last.last()].iter().all(|end| end.map(|vertex| vertex.at) == seam)
    {
        // The last part continues in the first.
        last.pop();
        last.append(first);
        parts.remove(0);
    }
    parts.into_iter().map(|vertices| Polyline { vertices, closed: false }).collect()
}

/// The largest number of buckets along a side.
const MOST: f64 = 1024.0;

/// A raster over the page that lists the segments touching each square.
pub(super) struct SegmentRaster {
    first: DVec2,
    side: f64,
    dims: [usize; 2],
    /// Start of each square's entries.
    starts: Vec<usize>,
    numbers: Vec<usize>,
}

impl SegmentRaster {
    pub(super) fn new(segments: &[PageSegment], gap: f64) -> Self {
        let places = || segments.iter().flat_map(|segment| segment.ends.map(|end| end.at));
        let first = places().reduce(DVec2::min).unwrap_or_default();
        let size = places().reduce(DVec2::max).unwrap_or_default() - first;
        let side = gap.max(size.max_element() / MOST).max(f64::MIN_POSITIVE);
        let dims = [size.x, size.y].map(|length| (length / side) as usize + 1);
        let mut buckets = Self { first, side, dims, starts: vec![0; dims[0] * dims[1] + 1], numbers: Vec::new() };
        let mut counts = vec![0; dims[0] * dims[1]];
        segments.iter().for_each(|segment| buckets.touched(segment, 0.0).for_each(|square| counts[square] += 1));
        for (square, count) in counts.iter().enumerate() {
            buckets.starts[square + 1] = buckets.starts[square] + count;
        }
        let mut next = buckets.starts.clone();
        buckets.numbers = vec![0; buckets.starts[counts.len()]];
        for (number, segment) in segments.iter().enumerate() {
            for square in buckets.touched(segment, 0.0) {
                buckets.numbers[next[square]] = number;
                next[square] += 1;
            }
        }
        buckets
    }

    /// Squares that a segment's bounding rectangle touches, grown by `around`.
    fn touched(&self, segment: &PageSegment, around: f64) -> impl Iterator<Item = usize> + use<> {
        let [a, b] = segment.ends.map(|end| end.at - self.first);
        let square = |at: DVec2, axis: usize| ((at[axis].max(0.0) / self.side) as usize).min(self.dims[axis] - 1);
        let (lo, hi) = (a.min(b) - around, a.max(b) + around);
        let (columns, rows, width) = (square(lo, 0)..=square(hi, 0), square(lo, 1)..=square(hi, 1), self.dims[0]);
        rows.flat_map(move |y| columns.clone().map(move |x| x + y * width))
    }

    /// Segments that may be within `gap` of a segment, possibly with repetitions.
    pub(super) fn near(&self, segment: &PageSegment, gap: f64) -> impl Iterator<Item = usize> {
        self.touched(segment, gap)
            .flat_map(|square| &self.numbers[self.starts[square]..self.starts[square + 1]])
            .copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::glam::DVec3;
    use drypoint_scene::philox::uniforms;
    use drypoint_scene::space::Grid;
    use drypoint_scene::tables::{Camera, Projection};

    /// A view along −z: depth is the eye's z minus the place's z.
    fn view() -> View {
        let grid = Grid::with_spacing([3; 3], [1.0; 3]).unwrap();
        let (projection, eye, target) =
            (Projection::Orthographic { height: None }, Some(DVec3::new(0.0, 0.0, 50.0)), Some(DVec3::ZERO));
        let camera = Camera { projection, eye, target, up: DVec3::Y, ..Camera::default() };
        View::new(&camera, &grid, [100, 100]).unwrap()
    }

    /// A line through two places of the page with these heights towards the eye, in `pieces` segments.
    fn line(from: [f64; 3], to: [f64; 3], pieces: usize) -> Polyline {
        let (from, to) = (DVec3::from(from), DVec3::from(to));
        let vertex = |i: usize| {
            let t = i as f64 / pieces as f64;
            let world = from.lerp(to, t);
            Vertex { at: world.truncate(), world, radius: 0.1, opacity: 1.0, t, color: None }
        };
        Polyline { vertices: (0..=pieces).map(vertex).collect(), closed: false }
    }

    fn ends(lines: &[Polyline]) -> Vec<[f64; 2]> {
        let x = |vertex: &Vertex| (vertex.at.x * 1e9).round() / 1e9;
        lines.iter().map(|line| [x(&line.vertices[0]), x(&line.vertices[line.vertices.len() - 1])]).collect()
    }

    /// A line along x at height 0 under one along y at height 3, x = 10, loses 0.5 mm to either side. At an angle of
    /// 30° it loses 0.5/sin 30°. The nearer line is never cut, however many segments the two have.
    #[test]
    fn the_farther_of_two_that_cross_has_a_gap() {
        let view = view();
        for pieces in [[1, 1], [7, 1], [1, 5], [20, 20]] {
            let far = line([0.0, 5.0, 0.0], [20.0, 5.0, 0.0], pieces[0]);
            let near = line([10.0, 0.0, 3.0], [10.0, 11.0, 3.0], pieces[1]);
            let found = gapped(&[far.clone(), near.clone()], &[], &view, 0.5, 2.0);
            assert_eq!(ends(&found.lines), [[0.0, 9.5], [10.5, 20.0], [10.0, 10.0]], "{pieces:?}");
            assert_eq!(found.lines[2], near);
            assert!(found.cuts > 0);
            // Lines in `others` only cut; they are not returned.
            let found = gapped(std::slice::from_ref(&far), &[near], &view, 0.5, 2.0);
            assert_eq!(ends(&found.lines), [[0.0, 9.5], [10.5, 20.0]]);
            let (sin, cos) = 30f64.to_radians().sin_cos();
            let slanted =
                line([10.0 - 6.0 * cos, 5.0 - 6.0 * sin, 3.0], [10.0 + 5.0 * cos, 5.0 + 5.0 * sin, 3.0], pieces[1]);
            assert_eq!(ends(&gapped(&[far], &[slanted], &view, 0.5, 2.0).lines), [[0.0, 9.0], [11.0, 20.0]]);
        }
    }

    /// A line that falls by 1 in 8 onto a long one is kept up to the ink of the other; a parallel one is its double.
    #[test]
    fn a_line_that_runs_into_another_one_is_no_double() {
        let (view, long) = (view(), line([0.0, 0.0, 0.0], [40.0, 0.0, 0.0], 7));
        let falling = line([2.0, 3.0, 0.0], [26.0, 0.0, 0.0], 5);
        let found = without_doubles(&[falling], std::slice::from_ref(&long), &view, [0.25, 1.0], 2.0);
        assert_eq!(ends(&found.lines), [[2.0, 24.0]]);
        let beside = line([2.0, 0.5, 0.0], [30.0, 0.5, 0.0], 5);
        assert_eq!(without_doubles(&[beside], &[long], &view, [0.25, 1.0], 2.0).lines, []);
    }

    /// The nearer line is nearer by 3. A `gap_depth` of 3 leaves the other whole; a slightly smaller one does not. A
    /// climbing line is cut only where it is deep enough.
    #[test]
    fn only_what_is_nearer_by_so_much() {
        let view = view();
        let far = line([0.0, 5.0, 0.0], [20.0, 5.0, 0.0], 3);
        let near = line([10.0, 0.0, 3.0], [10.0, 10.0, 3.0], 4);
        for (deeper, parts) in [(3.0, 1), (2.999, 2), (0.0, 2)] {
            let found = gapped(std::slice::from_ref(&far), std::slice::from_ref(&near), &view, 0.5, deeper);
            assert_eq!((found.lines.len(), found.cuts > 0), (parts, parts == 2), "{deeper}");
        }
        let climbs = line([0.0, 5.0, 0.0], [20.0, 5.0, 20.0], 1);
        let across = [4.0, 8.0, 16.0].map(|x| line([x, 0.0, 8.0], [x, 10.0, 8.0], 1));
        assert_eq!(ends(&gapped(&[climbs], &across, &view, 0.5, 2.0).lines), [[0.0, 3.5], [4.5, 20.0]]);
    }

    /// Beyond its end a line cuts a disc about the end, and nothing farther.
    #[test]
    fn beside_an_end() {
        let view = view();
        let far = line([0.0, 5.0, 0.0], [20.0, 5.0, 0.0], 2);
        let with =
            |y: f64| gapped(std::slice::from_ref(&far), &[line([8.0, y, 5.0], [8.0, 9.0, 5.0], 3)], &view, 0.5, 2.0);
        // 0.3 from it: √(0.25 − 0.09) = 0.4 to either side.
        assert_eq!(ends(&with(5.3).lines), [[0.0, 7.6], [8.4, 20.0]]);
        assert_eq!(with(5.51).cuts, 0);
    }

    /// A closed line that is cut becomes open; otherwise it stays closed. A line does not cut itself.
    #[test]
    fn rings() {
        let view = view();
        let vertex = |i: u32| {
            let (sin, cos) = (f64::from(i) * 15.0).to_radians().sin_cos();
            let world = DVec3::new(5.0 * cos, 5.0 * sin, 3.0 * cos);
            Vertex { at: world.truncate(), world, radius: 0.1, opacity: 1.0, t: f64::from(i) / 24.0, color: None }
        };
        let ring = Polyline { vertices: (0..24).map(vertex).collect(), closed: true };
        let alone = gapped(std::slice::from_ref(&ring), &[], &view, 3.0, 0.1);
        assert_eq!(alone.lines, std::slice::from_ref(&ring));
        let found = gapped(&[ring], &[line([0.0, -9.0, 9.0], [0.0, 9.0, 9.0], 1)], &view, 0.5, 1.0);
        assert!(found.lines.len() == 2 && found.lines.iter().all(|part| !part.closed), "{}", found.lines.len());
    }

    /// Remaining parts of random lines keep their distance from all nearer lines, to a hair: the grid misses none.
    #[test]
    fn what_is_left_keeps_its_distance() {
        let view = view();
        let random = |k: u32| {
            let [x, y, z, _] = uniforms(3, [k, 0, 0], 0);
            let [dx, dy, ..] = uniforms(3, [k, 1, 0], 0);
            let (x, y, z) = (30.0 * x, 30.0 * y, (10.0 * z).floor());
            line([x, y, z], [x + 12.0 * (dx - 0.5), y + 12.0 * (dy - 0.5), z], 1 + k as usize % 5)
        };
        let lines: Vec<Polyline> = (0..120).map(random).collect();
        let found = gapped(&lines, &[], &view, 0.4, 0.5);
        assert!(found.lines.len() > 150, "{}", found.lines.len());
        for part in &found.lines {
            for pair in part.vertices.windows(2) {
                for at in [0.25, 0.5, 0.75].map(|s| pair[0].at.lerp(pair[1].at, s)) {
                    for other in lines.iter().filter(|other| other.vertices[0].world.z > pair[0].world.z) {
                        for segment in segments(other, 0, &view) {
                            assert!(at.distance(segment.at(segment.nearest(at))) > 0.4 - 1e-9);
                        }
                    }
                }
            }
        }
    }
}
