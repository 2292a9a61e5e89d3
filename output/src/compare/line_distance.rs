//! Distances of two lists of lines in the world (Hausdorff's and RMS), and angles between two lines ([COST-1]).

use drypoint_scene::glam::DVec3;
use drypoint_scene::marks::Polyline;
use drypoint_scene::math::atan2;
use drypoint_scene::strokes::Stroke;

/// A line through the world.
#[derive(Clone, Debug, PartialEq)]
pub struct WorldLine {
    /// Vertices, in order.
    pub places: Vec<DVec3>,
    /// Whether the last vertex is joined to the first.
    pub closed: bool,
}

impl From<&Polyline> for WorldLine {
    fn from(line: &Polyline) -> Self {
        Self { places: line.vertices.iter().map(|vertex| vertex.world).collect(), closed: line.closed }
    }
}

impl From<&Stroke> for WorldLine {
    fn from(stroke: &Stroke) -> Self {
        Self { places: stroke.vertices.iter().map(|vertex| vertex.world).collect(), closed: stroke.closed }
    }
}

/// Distance of two lists of lines, symmetric, in world units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineDistance {
    /// Root mean square over points of both lists of the distance to the other list.
    pub rms: f64,
    /// Largest distance of a point to the other list: Hausdorff's distance.
    pub max: f64,
}

/// A straight piece of a line, as its two ends.
type WorldSegment = [DVec3; 2];

/// Returns the distance of two lists of lines; none if a list has no line.
///
/// All lines are cut into pieces of at most `step`. Each end of a piece has a distance to the other list's pieces,
/// taken as segments. Equal curves with different vertices therefore have distance 0.
pub fn line_distance<L: Into<WorldLine>>(
    a: impl Iterator<Item = L>,
    b: impl Iterator<Item = L>,
    step: f64,
) -> Option<LineDistance> {
    let (mut a, mut b) = (pieces(a, step), pieces(b, step));
    if a.is_empty() || b.is_empty() {
        return None;
    }
    sort(&mut a, 0);
    sort(&mut b, 0);
    let (mut sum, mut most, mut places) = (0.0, 0.0_f64, 0_u64);
    for (from, to) in [(&a, &b), (&b, &a)] {
        for place in from.iter().flatten() {
            let mut best = f64::INFINITY;
            nearest(to, 0, *place, step / 2.0, &mut best);
            (sum, most, places) = (sum + best, most.max(best), places + 1);
        }
    }
    Some(LineDistance { rms: (sum / places as f64).sqrt(), max: most.sqrt() })
}

/// Returns the angles between two lines, in radians from 0 to π/2, at the arc lengths `step`, 2·`step` … from their
/// first vertices. The list ends where the shorter line ends.
pub fn angles(a: &WorldLine, b: &WorldLine, step: f64) -> Vec<f64> {
    let [along_a, along_b] = [a, b].map(|line| directions(line, step));
    along_a.iter().zip(&along_b).map(|(p, q)| atan2(p.cross(*q).length(), p.dot(*q).abs())).collect()
}

/// Returns the directions of a line at the arc lengths `step`, 2·`step` and so on.
fn directions(WorldLine { places, closed }: &WorldLine, step: f64) -> Vec<DVec3> {
    let next = places.iter().skip(1).chain(places.first().filter(|_| *closed));
    let (mut directions, mut gone) = (Vec::new(), 0.0);
    for (a, b) in places.iter().zip(next) {
        gone += a.distance(*b);
        while (directions.len() + 1) as f64 * step <= gone {
            directions.push((*b - *a).normalize_or_zero());
        }
    }
    directions
}

/// Cuts lines into pieces of at most `step`.
fn pieces<L: Into<WorldLine>>(lines: impl Iterator<Item = L>, step: f64) -> Vec<WorldSegment> {
    let mut pieces = Vec::new();
    for line in lines {
        let WorldLine { places, closed } = line.into();
        let next = places.iter().skip(1).chain(places.first().filter(|_| closed));
        for (&a, &b) in places.iter().zip(next) {
            let n = (a.distance(b) / step).ceil().max(1.0) as usize;
            let at = |i: usize| if i == n { b } else { a.lerp(b, i as f64 / n as f64) };
            pieces.extend((0..n).map(|i| [at(i), at(i + 1)]));
        }
    }
    pieces
}

/// Largest number of pieces that are searched one by one.
const FEW: usize = 8;

fn middle(piece: &WorldSegment, axis: usize) -> f64 {
    0.5 * (piece[0][axis] + piece[1][axis])
}

/// Sorts pieces into an implicit k-d tree by their midpoints. The median by one coordinate stands in the middle.
/// Smaller pieces stand before the median, larger pieces after it. Each half is sorted by the next coordinate.
fn sort(pieces: &mut [WorldSegment], axis: usize) {
    if pieces.len() <= FEW {
        return;
    }
    let at = pieces.len() / 2;
    pieces.select_nth_unstable_by(at, |a, b| middle(a, axis).total_cmp(&middle(b, axis)));
    let (before, rest) = pieces.split_at_mut(at);
    sort(before, (axis + 1) % 3);
    sort(&mut rest[1..], (axis + 1) % 3);
}

/// Lowers `best` to the squared distance to the nearest piece. No piece reaches farther than `half` from its midpoint.
fn nearest(pieces: &[WorldSegment], axis: usize, place: DVec3, half: f64, best: &mut f64) {
    if pieces.len() <= FEW {
        pieces.iter().for_each(|piece| *best = best.min(squared(piece, place)));
        return;
    }
    let at = pieces.len() / 2;
    *best = best.min(squared(&pieces[at], place));
    // The half on the point's own side first. The other half lies at least |beyond| − half away.
    let beyond = place[axis] - middle(&pieces[at], axis);
    let (before, behind) = (&pieces[..at], &pieces[at + 1..]);
    let (near, far) = if beyond < 0.0 { (before, behind) } else { (behind, before) };
    nearest(near, (axis + 1) % 3, place, half, best);
    let least = (beyond.abs() - half).max(0.0);
    if least * least < *best {
        nearest(far, (axis + 1) % 3, place, half, best);
    }
}

/// Returns the squared distance of a point to a segment.
fn squared([a, b]: &WorldSegment, place: DVec3) -> f64 {
    let (along, from) = (*b - *a, place - *a);
    let length = along.length_squared();
    let t = if length > 0.0 { (from.dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
    (from - along * t).length_squared()
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::glam::DVec2;
    use drypoint_scene::marks::Vertex;

    fn line(closed: bool, places: impl IntoIterator<Item = [f64; 3]>) -> Polyline {
        let vertex = |world: [f64; 3]| Vertex {
            at: DVec2::ZERO,
            world: DVec3::from_array(world),
            radius: 1.0,
            opacity: 1.0,
            t: 0.0,
            color: None,
        };
        Polyline { vertices: places.into_iter().map(vertex).collect(), closed }
    }

    fn of(a: &[Polyline], b: &[Polyline], step: f64) -> Option<LineDistance> {
        line_distance(a.iter(), b.iter(), step)
    }

    #[test]
    fn the_same_line_with_other_vertices_is_not_apart() {
        let a = [line(false, [[0.0; 3], [10.0, 0.0, 0.0]])];
        let b = [line(false, (0..=7).map(|i| [f64::from(i) * 10.0 / 7.0, 0.0, 0.0]))];
        let found = of(&a, &b, 0.1).unwrap();
        // A few roundings of numbers up to 10.
        assert!(found.max < 1e-14, "{found:?}");
    }

    #[test]
    fn parallel_lines_and_a_longer_one_by_hand() {
        let a = [line(false, [[0.0; 3], [10.0, 0.0, 0.0]])];
        let shifted = [line(false, [[0.0, 0.3, 0.4], [10.0, 0.3, 0.4]])];
        let found = of(&a, &shifted, 0.1).unwrap();
        assert!((found.rms - 0.5).abs() < 1e-14 && (found.max - 0.5).abs() < 1e-14, "{found:?}");
        // The end that only one has is as far away as it is long, whichever list it is in.
        let longer = [line(false, [[0.0; 3], [12.5, 0.0, 0.0]])];
        for (a, b) in [(&a, &longer), (&longer, &a)] {
            let found = of(a, b, 0.1).unwrap();
            assert!((found.max - 2.5).abs() < 1e-12 && found.rms < 1.0, "{found:?}");
        }
    }

    #[test]
    fn a_closed_line_goes_back_to_its_first_vertex() {
        let square = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let found = of(&[line(true, square)], &[line(false, square)], 0.125).unwrap();
        // The middle of the fourth side is half a side from the corners.
        assert!((found.max - 0.5).abs() < 1e-14, "{found:?}");
    }

    #[test]
    fn the_tree_finds_what_looking_at_all_finds() {
        let mut state = 7_u64;
        let mut random = move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / 1e6
        };
        let mut list = || -> Vec<Polyline> {
            (0..40).map(|_| line(false, (0..4).map(|_| [random(), random(), random()]).collect::<Vec<_>>())).collect()
        };
        let (a, b) = (list(), list());
        let (all_a, all_b) = (pieces(a.iter(), 0.5), pieces(b.iter(), 0.5));
        let least =
            |place: DVec3, all: &[WorldSegment]| all.iter().map(|p| squared(p, place)).fold(f64::INFINITY, f64::min);
        let slow = all_a.iter().flatten().map(|&p| least(p, &all_b));
        let slow = slow.chain(all_b.iter().flatten().map(|&p| least(p, &all_a))).fold(0.0, f64::max);
        assert_eq!(of(&a, &b, 0.5).unwrap().max, slow.sqrt());
    }

    #[test]
    fn angles_at_equal_arc_lengths_by_hand() {
        let course = |closed, places: &[[f64; 3]]| WorldLine {
            places: places.iter().map(|p| DVec3::from_array(*p)).collect(),
            closed,
        };
        let straight = course(false, &[[0.0; 3], [10.0, 0.0, 0.0]]);
        // After two units up by 3:4, and back along it: a line has no sense of direction.
        let bent = course(false, &[[5.0, 5.0, 5.0], [7.0, 5.0, 5.0], [3.0, 8.0, 5.0]]);
        let found = angles(&straight, &bent, 1.0);
        let expected = [0.0, 0.0, 0.75_f64.atan(), 0.75_f64.atan(), 0.75_f64.atan(), 0.75_f64.atan(), 0.75_f64.atan()];
        assert_eq!(found.len(), expected.len());
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15), "{found:?}");
        // The fourth side of a square goes back.
        let square = course(true, &[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
        let quarter = std::f64::consts::FRAC_PI_2;
        assert_eq!(angles(&straight, &square, 1.0), [0.0, quarter, 0.0, quarter]);
        assert!(angles(&straight, &course(false, &[[1.0; 3]]), 1.0).is_empty());
    }

    #[test]
    fn nothing_is_no_distance() {
        assert_eq!(of(&[], &[line(false, [[0.0; 3], [1.0; 3]])], 0.1), None);
    }
}
