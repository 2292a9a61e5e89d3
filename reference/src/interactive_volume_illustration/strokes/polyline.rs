//! The polyline of a stroke: as few vertices as the curve allows, and no part behind the surface ([HATCH-9],
//! [HATCH-10]).

use super::super::seeds::Seed;
use super::counts::HatchCounts;
use super::growth::StrokeGrower;
use super::integrator::{CubicSegment, point, vertices};
use super::stroke_field::{inside, normal};
use crate::field::Outside;
use crate::number::Vec3;
use drypoint_scene::glam::DVec3;
use drypoint_scene::strokes::{Stroke, StrokeVertex};

/// Number of halvings of a segment that dips behind the surface, before the stroke is cut there.
const HALVINGS: u32 = 8;

/// Distance from a vertex within which the surface is searched, in voxels; number of places to either side; number of
/// evaluations.
const REACH: f64 = 1.0;
const PLACES: u32 = 8;
const EVALUATIONS: u32 = 40;

const THIRD: f64 = 1.0 / 3.0;

/// A vertex of the polyline: its place on the curve, and its corrected place.
#[derive(Clone, Copy)]
struct FrontVertex {
    t: f64,
    world: DVec3,
}

/// Runs of vertices. The stroke is broken between two runs.
struct VertexRuns {
    each: Vec<Vec<FrontVertex>>,
    /// Buffer for the parameters at which a segment meets faces of cells.
    faces: Vec<f64>,
}

impl VertexRuns {
    fn push(&mut self, vertex: FrontVertex) {
        match self.each.last_mut() {
            Some(run) => run.push(vertex),
            None => self.each.push(vec![vertex]),
        }
    }

    fn cut(&mut self) {
        self.each.push(Vec::new());
    }
}

impl StrokeGrower<'_, '_> {
    /// Returns the stroke of a curve whose seed is the beginning of segment `at_seed`. If the curve is broken, only
    /// the run with the seed remains. Returns none if this run has fewer than two vertices.
    pub(super) fn polyline(
        &self,
        segments: &[CubicSegment],
        at_seed: usize,
        closed: bool,
        seed: &Seed,
        counts: &mut HatchCounts,
    ) -> Option<Stroke> {
        if segments.is_empty() {
            return None;
        }
        let at = vertices(segments, self.how().chord);
        let mut runs = VertexRuns { each: vec![Vec::with_capacity(2 * at.len())], faces: Vec::with_capacity(16) };
        // Chord vertices are put back onto the surface. `segment` adds vertices between them, or cuts the run.
        let mut before: Option<FrontVertex> = None;
        for t in at {
            let next = self.put_back(point(segments, t), seed.target).map(|world| FrontVertex { t, world });
            match (before, next) {
                (Some(a), Some(b)) => self.segment(segments, seed.target, [a, b], HALVINGS, &mut runs),
                (None, Some(b)) => runs.push(b),
                (_, None) => runs.cut(),
            }
            before = next;
        }
        // Only the run with the seed is kept.
        let broken = runs.each.len() > 1;
        counts.cut += u64::from(broken);
        let at = at_seed as f64;
        let holds =
            |run: &Vec<FrontVertex>| run.first().is_some_and(|v| v.t <= at) && run.last().is_some_and(|v| v.t >= at);
        let mut run = runs.each.into_iter().find(holds)?;
        let closed = closed && !broken;
        if closed {
            // The last vertex of a closed run equals its first.
            run.pop();
        }
        let places: Vec<_> = run.iter().map(|v| v.world).collect();
        self.finished(&places, closed, seed)
    }

    /// Adds the end of a segment, and the vertices before it that are needed for no part to lie behind the surface.
    fn segment(
        &self,
        segments: &[CubicSegment],
        target: f64,
        [a, b]: [FrontVertex; 2],
        halvings: u32,
        runs: &mut VertexRuns,
    ) {
        if self.stays_in_front([a.world, b.world], &mut runs.faces) {
            runs.push(b);
            return;
        }
        let t = 0.5 * (a.t + b.t);
        let middle = (halvings > 0).then(|| self.put_back(point(segments, t), target)).flatten();
        match middle.map(|world| FrontVertex { t, world }) {
            Some(middle) => {
                self.segment(segments, target, [a, middle], halvings - 1, runs);
                self.segment(segments, target, [middle, b], halvings - 1, runs);
            }
            None => {
                runs.cut();
                runs.push(b);
            }
        }
    }

    /// Moves a place along its normal to where the field has the value `target`. Returns none if there is no such
    /// place nearby.
    pub(super) fn put_back(&self, x: DVec3, target: f64) -> Option<DVec3> {
        let index = inside(self.ground(), x)?;
        if (self.ground().value(index) - target).abs() <= self.near(target) {
            return Some(x);
        }
        let (n, _) = normal(self.ground(), index)?;
        let reach = REACH / (self.ground().grid().inverse_axes() * n).length();
        let s = self.meets(x, n, target, reach, PLACES, EVALUATIONS)?;
        Some(x + n * s)
    }

    /// Whether a whole segment lies in front of the surface. Without a surface every segment does ([HATCH-16]).
    ///
    /// Between two faces of cells, trilinear values along a line are a cubic. Four values determine it, and its
    /// extremes lie at the ends or at zeros of its derivative. Values of other kernels have a higher degree along a
    /// line. For them the four places and the extremes of the cubic through them are tested.
    fn stays_in_front(&self, [a, b]: [DVec3; 2], faces: &mut Vec<f64>) -> bool {
        let Some(iso) = self.iso() else { return true };
        let (ground, grid) = (self.ground(), self.ground().grid());
        let (from, to) = (grid.to_index(a), grid.to_index(b));
        let (lo, hi) = (from.min(to), from.max(to));
        let [first, last] = grid.index_box();
        if !(lo.cmpge(first).all() && hi.cmple(last).all()) {
            return false;
        }
        let outside = ground.outside();
        // ±(f − iso), at least 0 in front of the surface. The clamp keeps rounding from leading out of the volume along
        // its border.
        let over = |s: f64| {
            let at = Vec3::from_glam((from + (to - from) * s).clamp(lo, hi));
            match outside {
                _ if ground.masked_at(at) => f64::NAN,
                Outside::Low => iso - ground.value(at),
                Outside::High => ground.value(at) - iso,
            }
        };
        faces.clear();
        faces.extend([0.0, 1.0]);
        for axis in 0..3 {
            let (first, last) = (lo[axis].floor() as i64 + 1, hi[axis].ceil() as i64 - 1);
            let at = |face: i64| ((face as f64 - from[axis]) / (to[axis] - from[axis])).clamp(0.0, 1.0);
            faces.extend((first..=last).map(at));
        }
        faces.sort_unstable_by(f64::total_cmp);
        let mut first = over(0.0);
        faces.windows(2).all(|cell| {
            let at = |u: f64| over(cell[0] + (cell[1] - cell[0]) * u);
            let values = [first, at(THIRD), at(2.0 * THIRD), over(cell[1])];
            first = values[3];
            is_positive(values)
                || values.iter().all(|v| *v >= 0.0) && extremes(values).into_iter().flatten().all(|u| at(u) >= 0.0)
        })
    }

    /// Returns the stroke of a polyline, with normals and u. Returns none if it has fewer than two vertices or if a
    /// vertex has no normal.
    fn finished(&self, places: &[DVec3], closed: bool, seed: &Seed) -> Option<Stroke> {
        if places.len() < 2 {
            return None;
        }
        let mut length = 0.0;
        let mut along = Vec::with_capacity(places.len());
        along.push(0.0);
        for pair in places.windows(2) {
            length += pair[0].distance(pair[1]);
            along.push(length);
        }
        let whole = if closed { length + places[places.len() - 1].distance(places[0]) } else { length };
        let vertex = |(&world, along): (&DVec3, f64)| {
            let (normal, _) = normal(self.ground(), inside(self.ground(), world)?)?;
            Some(StrokeVertex { world, normal, u: if whole > 0.0 { along / whole } else { 0.0 } })
        };
        let mut vertices = Vec::with_capacity(places.len());
        for each in places.iter().zip(along) {
            vertices.push(vertex(each)?);
        }
        let [nx, ny, _] = self.ground().grid().dims();
        let [x, y, z] = seed.cell;
        Some(Stroke { vertices, closed, key: ((z * ny + y) * nx + x) as u64 })
    }
}

/// Whether the cubic with these values at 0, ⅓, ⅔ and 1 is certainly nowhere below 0 on [0, 1]. The cubic lies within
/// the hull of its Bernstein coefficients. This cheap test often makes the extremes unnecessary.
fn is_positive([v0, v1, v2, v3]: [f64; 4]) -> bool {
    let (b1, b2) = (18.0 * v1 - 9.0 * v2 - 5.0 * v0 + 2.0 * v3, 18.0 * v2 - 9.0 * v1 - 5.0 * v3 + 2.0 * v0);
    v0 >= 0.0 && b1 >= 0.0 && b2 >= 0.0 && v3 >= 0.0
}

/// Places within (0, 1) of the extremes of the cubic with these values at 0, ⅓, ⅔ and 1.
fn extremes([v0, v1, v2, v3]: [f64; 4]) -> [Option<f64>; 2] {
    // Its derivative is a + 2bu + cu².
    let a = -5.5 * v0 + 9.0 * v1 - 4.5 * v2 + v3;
    let b = 9.0 * v0 - 22.5 * v1 + 18.0 * v2 - 4.5 * v3;
    let c = 13.5 * (v3 - v0 + 3.0 * (v1 - v2));
    let root = (b * b - a * c).sqrt();
    // The sum without cancellation gives one root, the product of the roots gives the other. NaN is not within the
    // interval.
    let q = -(b + root.copysign(b));
    [q / c, a / q].map(|u| (u > 0.0 && u < 1.0).then_some(u))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (u − p)(u − q)(u − r) and a quadratic, by their derivatives' roots.
    #[test]
    fn extremes_of_cubics() {
        let of = |f: &dyn Fn(f64) -> f64| extremes([f(0.0), f(THIRD), f(2.0 * THIRD), f(1.0)]);
        let near = |found: [Option<f64>; 2], want: &[f64]| {
            let mut found: Vec<f64> = found.into_iter().flatten().collect();
            found.sort_by(f64::total_cmp);
            assert_eq!(found.len(), want.len(), "{found:?} {want:?}");
            assert!(found.iter().zip(want).all(|(f, w)| (f - w).abs() < 1e-12), "{found:?} {want:?}");
        };
        // 3u² − 3u + ½ = 0.
        let half = 3f64.sqrt() / 6.0;
        near(of(&|u| u * (u - 0.5) * (u - 1.0)), &[0.5 - half, 0.5 + half]);
        near(of(&|u| u * u * u - 0.75 * u), &[0.5]);
        near(of(&|u| 5.0 - (u - 0.3) * (u - 0.3)), &[0.3]);
        near(of(&|u| u * u * u + u), &[]);
        near(of(&|u| 3.0 * u - 1.0), &[]);
        near(of(&|_| 7.0), &[]);
    }

    /// Cubics whose Bernstein coefficients are all at or above 0 are certain. A coefficient below 0 makes a cubic
    /// uncertain, even if it is positive.
    #[test]
    fn cubics_that_are_certain_to_be_positive() {
        let of = |b: [f64; 4]| {
            let at = |u: f64| {
                let w = 1.0 - u;
                w * w * w * b[0] + 3.0 * w * w * u * b[1] + 3.0 * w * u * u * b[2] + u * u * u * b[3]
            };
            is_positive([at(0.0), at(THIRD), at(2.0 * THIRD), at(1.0)])
        };
        for i in 0..81 {
            let b = [i % 3, i / 3 % 3, i / 9 % 3, i / 27].map(|b| [-0.25, 0.5, 1.0][b]);
            assert_eq!(of(b), b.iter().all(|b| *b >= 0.0), "{b:?}");
        }
        assert!(!of([f64::NAN, 1.0, 1.0, 1.0]));
    }
}
