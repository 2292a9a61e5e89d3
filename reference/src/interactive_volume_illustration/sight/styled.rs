//! Strokes as a pen draws them: vertices are added where its width or colour changes, and parts that are too thin are
//! removed ([HATCH-12], [HATCH-13]).

use super::visibility::PenState;
use drypoint_scene::color::linear_to_srgb;
use drypoint_scene::glam::DVec3;
use drypoint_scene::philox::uniform;
use drypoint_scene::strokes::{Stroke, StrokeVertex};

/// The largest error of half the width between two vertices, in mm. With widths rounded to 0.005 mm it is less than
/// half a dot at 2400 dpi.
const RADIUS: f64 = 0.002;

/// The change of half the width over a segment, in mm, up to which testing the middle is enough.
const SMALL: f64 = 0.01;

/// The largest change of a colour channel between two vertices, in sRGB.
const CHANNEL: f64 = 0.06;

/// The largest change of the opacity between two vertices.
const OPACITY: f64 = 0.1;

/// The largest share of its opacity that a pencil stroke loses to the paper's grain.
const GRAIN: f64 = 0.6;

/// Size of a grain of the paper, in voxels.
const GRAIN_SIZE: f64 = 0.4;

/// The largest number of halvings of a segment.
const HALVINGS: u32 = 5;

/// A place on a stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrokePoint {
    /// Place, normal and u.
    pub vertex: StrokeVertex,
    /// T, of length 1; 0 where the stroke turns back on itself.
    pub tangent: DVec3,
}

/// A stroke, or a part of one, with the pen of each vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StyledStroke {
    /// The stroke or part.
    pub stroke: Stroke,
    /// One pen for each vertex.
    pub pens: Vec<PenState>,
}

/// Share of its opacity that a pencil stroke keeps on grainy paper, at a `length` along the stroke. `voxel` has the
/// same unit. Values at whole grains are random numbers of the stroke's key, and linear between them.
pub fn grain(seed: u64, key: u64, length: f64, voxel: f64) -> f64 {
    let along = length / (GRAIN_SIZE * voxel);
    let first = along.max(0.0).floor();
    let node = |n: f64| uniform(seed, [key as u32, (key >> 32) as u32, n as u32], 2);
    let (a, b) = (node(first), node(first + 1.0));
    1.0 - GRAIN * (a + (b - a) * (along - first).clamp(0.0, 1.0))
}

/// Returns the parts of a stroke that are at least `least` mm wide to either side. `pen` gives the pen at each place.
///
/// The pen is linear in the arc length between two vertices. Vertices are added where the width is not linear and
/// where the colour changes much. A part ends where the stroke becomes too thin.
pub fn drawn(stroke: &Stroke, least: f64, pen: impl Fn(&StrokePoint) -> PenState) -> Vec<StyledStroke> {
    let mut along = places(stroke).into_iter().map(|place| (place, pen(&place)));
    let mut all: Vec<(StrokePoint, PenState)> = along.next().into_iter().collect();
    for next in along {
        if let Some(last) = all.last().copied() {
            halve([last, next], HALVINGS, &pen, &mut all);
        }
        all.push(next);
    }
    thick(&all, least, stroke, &pen)
}

/// The vertices with their tangents. A closed stroke repeats its first vertex at u = 1.
fn places(stroke: &Stroke) -> Vec<StrokePoint> {
    let vertices = &stroke.vertices;
    let n = vertices.len();
    if n == 0 {
        return Vec::new();
    }
    let number = if stroke.closed { n + 1 } else { n };
    let at = |i: usize| {
        let vertex = vertices[i % n];
        StrokeVertex { u: if i == n { 1.0 } else { vertex.u }, ..vertex }
    };
    let tangent = |i: usize| {
        let (before, after) = match stroke.closed {
            true => ((i + n - 1) % n, (i + 1) % n),
            false => (i.saturating_sub(1), (i + 1).min(n - 1)),
        };
        (vertices[after].world - vertices[before].world).normalize_or_zero()
    };
    (0..number).map(|i| StrokePoint { vertex: at(i), tangent: tangent(i) }).collect()
}

/// Adds the vertices between two places at which the pen changes much.
fn halve(
    [a, b]: [(StrokePoint, PenState); 2],
    left: u32,
    pen: &impl Fn(&StrokePoint) -> PenState,
    all: &mut Vec<(StrokePoint, PenState)>,
) {
    if left == 0 {
        return;
    }
    let middle = between(&a.0, &b.0, 0.5);
    let own = pen(&middle);
    let smooth = |a: &PenState, b: &PenState| {
        let channels = |pen: &PenState| pen.color.unwrap_or_default().map(|c| linear_to_srgb(c.max(0.0)));
        let (from, to) = (channels(a), channels(b));
        (a.opacity - b.opacity).abs() <= OPACITY && (0..3).all(|i| (from[i] - to[i]).abs() <= CHANNEL)
    };
    // At a corner of the width, the error is at most twice the error in the middle. If the width bends to different
    // sides before and behind the middle, the quarters show it.
    let bent =
        |s: f64, own: &PenState| (own.radius - (a.1.radius + (b.1.radius - a.1.radius) * s)).abs() > RADIUS / 2.0;
    let is_small = (a.1.radius - b.1.radius).abs() <= SMALL;
    let straight =
        !bent(0.5, &own) && (is_small || [0.25, 0.75].iter().all(|&s| !bent(s, &pen(&between(&a.0, &b.0, s)))));
    if straight && smooth(&a.1, &own) && smooth(&own, &b.1) && smooth(&a.1, &b.1) {
        return;
    }
    let middle = (middle, own);
    halve([a, middle], left - 1, pen, all);
    all.push(middle);
    halve([middle, b], left - 1, pen, all);
}

fn between(a: &StrokePoint, b: &StrokePoint, s: f64) -> StrokePoint {
    let vertex = StrokeVertex {
        world: a.vertex.world.lerp(b.vertex.world, s),
        normal: a.vertex.normal.lerp(b.vertex.normal, s).normalize_or(a.vertex.normal),
        u: a.vertex.u + (b.vertex.u - a.vertex.u) * s,
    };
    StrokePoint { vertex, tangent: a.tangent.lerp(b.tangent, s).normalize_or(a.tangent) }
}

/// The place between two neighbours at which the width is `least`, with the pen there.
fn edge(
    [a, b]: [&(StrokePoint, PenState); 2],
    least: f64,
    pen: &impl Fn(&StrokePoint) -> PenState,
) -> (StrokePoint, PenState) {
    let s = (a.1.radius - least) / (a.1.radius - b.1.radius);
    let place = between(&a.0, &b.0, s);
    let own = pen(&place);
    (place, PenState { radius: least, ..own })
}

/// Splits a stroke into the parts that are wide enough.
fn thick(
    all: &[(StrokePoint, PenState)],
    least: f64,
    stroke: &Stroke,
    pen: &impl Fn(&StrokePoint) -> PenState,
) -> Vec<StyledStroke> {
    let is_thick = |at: &(StrokePoint, PenState)| at.1.radius >= least;
    let drawn = |part: Vec<(StrokePoint, PenState)>, closed: bool| {
        let (vertices, pens) = part.into_iter().map(|(place, pen)| (place.vertex, pen)).unzip();
        StyledStroke { stroke: Stroke { vertices, closed, key: stroke.key }, pens }
    };
    // A closed stroke that is wide everywhere stays closed, without the repeated vertex.
    if stroke.closed && all.iter().all(is_thick) {
        return match all {
            [whole @ .., _] => vec![drawn(whole.to_vec(), true)],
            [] => Vec::new(),
        };
    }
    // A part begins and ends where the width crosses `least`.
    let mut parts: Vec<Vec<(StrokePoint, PenState)>> = Vec::new();
    let mut part: Vec<(StrokePoint, PenState)> =
        all.first().filter(|first| is_thick(first)).copied().into_iter().collect();
    for pair in all.windows(2) {
        let [from, to] = [&pair[0], &pair[1]];
        if is_thick(from) != is_thick(to) {
            part.push(edge([from, to], least, pen));
        }
        if is_thick(to) {
            part.push(*to);
        } else {
            parts.push(std::mem::take(&mut part));
        }
    }
    let ends = [all.first(), all.last()].map(|end| end.is_some_and(is_thick));
    if let (true, [true, true], Some(first)) = (stroke.closed, ends, parts.first_mut()) {
        // The last part continues in the first.
        part.pop();
        part.append(first);
        *first = part;
    } else {
        parts.push(part);
    }
    parts.retain(|part| part.len() > 1);
    parts.into_iter().map(|part| drawn(part, false)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A line along x from 0 to 10, with one vertex per unit.
    fn line(closed: bool) -> Stroke {
        let vertex = |i: u32| {
            let u = f64::from(i) / 10.0;
            StrokeVertex { world: DVec3::new(10.0 * u, 0.0, 0.0), normal: DVec3::Z, u }
        };
        Stroke { vertices: (0..=10).map(vertex).collect(), closed, key: 7 }
    }

    fn plain(radius: f64) -> PenState {
        PenState { radius, opacity: 1.0, color: None }
    }

    #[test]
    fn one_width_and_colour_add_no_vertex() {
        for closed in [false, true] {
            let parts = drawn(&line(closed), 0.1, |_| plain(0.1));
            assert_eq!(parts.len(), 1);
            assert_eq!((&parts[0].stroke, parts[0].pens.len()), (&line(closed), 11));
        }
        assert!(drawn(&Stroke::default(), 0.0, |_| plain(1.0)).is_empty());
        assert!(drawn(&Stroke { closed: true, ..Stroke::default() }, 0.0, |_| plain(1.0)).is_empty());
    }

    /// A taper 0.5·u/0.3 is 0.05 wide at u = 0.03, exactly within the linear interpolation of vertices. No vertex of
    /// the part is thinner.
    #[test]
    fn ends_are_where_the_width_is_the_least() {
        let taper =
            |place: &StrokePoint| plain(0.5 * (place.vertex.u / 0.3).min((1.0 - place.vertex.u) / 0.3).min(1.0));
        let parts = drawn(&line(false), 0.05, taper);
        let [part] = parts.as_slice() else { panic!("{}", parts.len()) };
        let (first, last) = (part.stroke.vertices[0], part.stroke.vertices[part.stroke.vertices.len() - 1]);
        assert!((first.world.x - 0.3).abs() < 1e-12 && (last.world.x - 9.7).abs() < 1e-12);
        assert!((first.u - 0.03).abs() < 1e-12 && part.stroke.key == 7);
        assert_eq!((part.pens[0].radius, part.pens[part.pens.len() - 1].radius), (0.05, 0.05));
        assert!(part.pens.iter().all(|pen| pen.radius >= 0.05));
        // The width is linear up to u = 0.3 and from 0.7 on. Vertices exist there already, so only the ends are
        // added.
        assert_eq!(part.pens.len(), 11);
        // Nothing is wide enough.
        assert!(drawn(&line(false), 0.6, taper).is_empty());
    }

    /// A parabola of the width, a swing about the middle of a segment, and a corner at any place are linear between two
    /// vertices within RADIUS.
    #[test]
    fn widths_are_linear_between_vertices() {
        let parabola = |u: f64| 0.3 * u * (1.0 - u) * 4.0;
        let corners = (0..40).map(|i| 0.3 + 0.01 * f64::from(i));
        let corner = |at: f64| move |u: f64| 0.5 * (u / at).min((1.0 - u) / (1.0 - at));
        let swing = |u: f64| {
            let t = ((u - 0.52) / 0.06).clamp(0.0, 1.0);
            0.1 + 0.2 * t * t * (3.0 - 2.0 * t)
        };
        let all = corners
            .map(|at| Box::new(corner(at)) as Box<dyn Fn(f64) -> f64>)
            .chain([Box::new(parabola) as _, Box::new(swing) as _]);
        for (k, width) in all.enumerate() {
            let parts = drawn(&line(false), 0.0, |place| plain(width(place.vertex.u)));
            let [part] = parts.as_slice() else { panic!("{}", parts.len()) };
            let ends = part.stroke.vertices.windows(2).zip(part.pens.windows(2));
            for (ends, pens) in ends {
                for s in (0..=32).map(|i| f64::from(i) / 32.0) {
                    let u = ends[0].u + (ends[1].u - ends[0].u) * s;
                    let linear = pens[0].radius + (pens[1].radius - pens[0].radius) * s;
                    assert!((width(u) - linear).abs() <= RADIUS + 1e-12, "{k} {u}");
                }
            }
            assert!(part.pens.len() < 30, "{k}: {}", part.pens.len());
        }
    }

    /// A thin stretch from x = 4.5 to 5.5 divides an open stroke into two parts. A closed stroke that passes it on
    /// the way back, too, has two parts, one of them through its seam.
    #[test]
    fn a_thin_stretch_cuts() {
        let thin = |place: &StrokePoint| plain(((place.vertex.world.x - 5.0).abs() * 0.2).min(0.3));
        let ends = |parts: &[StyledStroke]| {
            let x = |part: &StyledStroke| {
                let vertices = &part.stroke.vertices;
                [vertices[0].world.x, vertices[vertices.len() - 1].world.x].map(|x| (x * 1e9).round() / 1e9)
            };
            parts.iter().map(x).collect::<Vec<_>>()
        };
        assert_eq!(ends(&drawn(&line(false), 0.1, thin)), [[0.0, 4.5], [5.5, 10.0]]);
        let ring = drawn(&line(true), 0.1, thin);
        assert_eq!(ends(&ring), [[4.5, 4.5], [5.5, 5.5]]);
        assert!(ring.iter().all(|part| !part.stroke.closed && part.stroke.vertices.len() == part.pens.len()));
        assert!(ring[0].stroke.vertices.iter().any(|vertex| vertex.world.x == 0.0));
    }

    /// The grain is seeded, within its range and continuous. Another stroke has another grain.
    #[test]
    fn the_grain_of_paper() {
        let at = |key, i: u32| grain(5, key, f64::from(i) / 64.0, 1.0 / GRAIN_SIZE);
        let all: Vec<f64> = (0..64 * 200).map(|i| at(9, i)).collect();
        assert!(all.iter().all(|g| (1.0 - GRAIN..=1.0).contains(g)));
        assert!(all.windows(2).all(|pair| (pair[1] - pair[0]).abs() <= GRAIN / 64.0 + 1e-12));
        // The mean of 200 uniform numbers is ½ within five times 1/√(12·200).
        let mean = all.iter().sum::<f64>() / all.len() as f64;
        assert!((mean - 1.0 + GRAIN / 2.0).abs() < GRAIN * 5.0 / 2400f64.sqrt(), "{mean}");
        assert!(at(9, 77) == at(9, 77) && at(9, 77) != at(10, 77) && at(9, 77) != at(9 + (1 << 32), 77));
    }

    /// Red goes from 0 to 1 on the way. Neighbours differ by less than two steps, and T is the line's direction.
    #[test]
    fn vertices_come_where_colours_change() {
        let red = |place: &StrokePoint| {
            assert_eq!(place.tangent, DVec3::X);
            PenState { color: Some([place.vertex.u * place.vertex.u, 0.0, 0.5]), ..plain(0.1) }
        };
        let parts = drawn(&line(false), 0.0, red);
        let codes: Vec<f64> = parts[0].pens.iter().map(|pen| linear_to_srgb(pen.color.unwrap()[0])).collect();
        assert!(codes.windows(2).all(|pair| (pair[1] - pair[0]).abs() <= CHANNEL), "{codes:?}");
        assert!(codes.len() > 15 && codes.len() < 60, "{}", codes.len());
    }
}
