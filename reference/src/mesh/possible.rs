//! The triangles that a line in f32 may meet ([GPU-2]).
//!
//! The line in f32 is off by up to e along each axis, and so is a corner. In the coordinates of the sheared line a corner
//! then is off by δ, which also holds the roundings of these coordinates. An area from two corners p and q is off by
//! δ(|p| + |q|) + δ² and three roundings. Its sign decides the side of an edge. If the errors leave a sign open, the
//! triangle may be met or missed.

use super::MeshHit;
use super::nearest::MeshSearch;
use super::tree::Slabs;
use super::triangle::{Crossing, ShearedLine};
use crate::number::{Arithmetic, Bounded, Decision, Real, Vec3};
use drypoint_scene::glam::DVec3;

/// Half a unit in the last place of 1, with a little more for the products of errors.
const ROUNDING: f64 = 0.5 * f32::EPSILON as f64 * (1.0 + 1e-6);

/// Roundings of a coordinate along the sheared line, relative to the distance of a corner from the ray's start: one of
/// the difference, five of the shear, one of the product, one of the second difference.
const OF_COORDINATES: f64 = 8.0;

/// The errors of a line in f32.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LineErrors {
    /// The largest error of a position along an axis.
    pub(crate) position: f64,
    /// The parameter at which the line starts in f32.
    pub(crate) start: f64,
}

/// A place at which a line in f32 may meet a triangle first.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PossibleHit {
    pub(crate) hit: MeshHit,
    /// The largest error of the parameter.
    pub(crate) error: f64,
    /// The largest errors of the weights.
    weights: [f64; 3],
    /// Whether the triangle is met for certain.
    pub(crate) is_certain: bool,
}

impl MeshSearch<'_> {
    /// The box about all triangles.
    pub(crate) fn ends(&self) -> [DVec3; 2] {
        self.tree.nodes().first().map_or([DVec3::ZERO; 2], |root| [root.lo, root.hi])
    }

    /// All places at which a line in f32 may meet a triangle first, in a closed range of its parameter.
    #[inline]
    pub(crate) fn possible(&self, line: [DVec3; 2], errors: LineErrors, [from, to]: [f64; 2]) -> Vec<PossibleHit> {
        let Some(sheared) = ShearedLine::new(line) else { return Vec::new() };
        let start = line[0] + line[1] * errors.start;
        let mut found: Vec<PossibleHit> = Vec::new();
        let mut until = to;
        self.tree.visit(&Slabs::within(line, 2.0 * errors.position), to, |triangle| {
            let corners = self.corners[triangle as usize];
            let Some((crossing, error, weights, mut is_certain)) = may_cross(&sheared, corners, (start, errors)) else {
                return until;
            };
            let [least, most] = [crossing.t - error, crossing.t + error];
            if most >= from && least <= to {
                is_certain &= least >= from && most <= to;
                found.push(PossibleHit { hit: self.hit(crossing, triangle), error, weights, is_certain });
                until = if is_certain { until.min(most) } else { until };
            }
            until
        });
        found.retain(|possible| possible.hit.t - possible.error <= until);
        found
    }

    /// The normal at a possible hit, with its errors. Its value is that of [`normal`](Self::normal).
    #[inline]
    pub(crate) fn possible_normal(&self, possible: &PossibleHit, v: Vec3<Bounded>) -> Option<Vec3<Bounded>> {
        let hit = &possible.hit;
        let (flat, of_corners) = self.normals(hit);
        let flat = flat.map(Vec3::<Bounded>::from_glam);
        let smooth = of_corners.and_then(|corners| {
            let weight = |i: usize| Bounded::new(hit.weights[i], possible.weights[i]);
            let [a, b, c] = corners.map(Vec3::<Bounded>::from_glam);
            let sum = a * weight(0) + b * weight(1) + c * weight(2);
            let length = sum.length();
            (length > Bounded::ZERO).then(|| sum * (Bounded::ONE / length))
        });
        let normal = smooth.or(flat)?;
        // The same decisions as in f64, about numbers with errors.
        let toward = flat.map_or(normal.dot(v), |flat| {
            let side = flat.dot(normal).deciding(Decision::Facing) < Bounded::ZERO;
            if side { -flat.dot(v) } else { flat.dot(v) }
        });
        let normal = if toward.deciding(Decision::Facing) < Bounded::ZERO { -normal } else { normal };
        let exact = self.normal(hit, v.to_glam())?;
        let same = if normal.to_glam().dot(exact) < 0.0 { -exact } else { exact };
        // Shaders first divide by the largest component.
        let with = |a: f64, b: Bounded| Bounded::new(a, b.error() + (a - b.value()).abs() + 8.0 * ROUNDING * a.abs());
        Some(Vec3::new(with(same.x, normal.x), with(same.y, normal.y), with(same.z, normal.z)))
    }
}

/// The place at which a line may cross a triangle, with the errors of its parameter and its weights, and whether it
/// does for certain. Returns none if it misses the triangle for certain.
fn may_cross(
    line: &ShearedLine,
    corners: [DVec3; 3],
    (start, errors): (DVec3, LineErrors),
) -> Option<(Crossing, f64, [f64; 3], bool)> {
    let size = corners.iter().fold(0.0, |size: f64, corner| size.max(corner.abs().max_element()));
    let away = corners.iter().fold(0.0, |away: f64, corner| away.max((*corner - start).abs().max_element()));
    let delta = 2.0 * (errors.position + ROUNDING * size) + OF_COORDINATES * ROUNDING * away;
    let [a, b, c] = corners.map(|corner| line.of(corner));
    let area = |p: [f64; 3], q: [f64; 3]| {
        let [p0, p1, q0, q1] = [p[0], p[1], q[0], q[1]];
        let error = delta * (p0.abs() + p1.abs() + q0.abs() + q1.abs()) + 2.0 * delta * delta;
        (q0 * p1 - q1 * p0, error + 3.0 * ROUNDING * ((q0 * p1).abs() + (q1 * p0).abs() + error))
    };
    let areas = [area(b, c), area(c, a), area(a, b)];
    let [is_below, is_above] = [areas.iter().any(|&(w, e)| w < -e), areas.iter().any(|&(w, e)| w > e)];
    if is_below && is_above {
        return None;
    }
    let sum: f64 = areas.iter().map(|(w, _)| w).sum();
    let sum_error: f64 = areas.iter().map(|(w, e)| e + 2.0 * ROUNDING * w.abs()).sum();
    let depths = [a[2], b[2], c[2]];
    let scale = line.shear[2].abs();
    let [lo, hi] = depths.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], &z| [lo.min(z), hi.max(z)]);
    // Quotients and sums of the parameter, relative to the distance from the start.
    let rounded = delta + 16.0 * ROUNDING * away;
    if sum.abs() <= 2.0 * sum_error {
        // An edge is turned to the line.
        let t = 0.5 * (lo + hi) * line.shear[2];
        let weights = [1.0 / 3.0; 3];
        return Some((Crossing { t, weights }, (0.5 * (hi - lo) + rounded) * scale, [1.0; 3], false));
    }
    let weights = areas.map(|(w, _)| w / sum);
    let of_weights: [f64; 3] = std::array::from_fn(|i| {
        (areas[i].1 + weights[i].abs() * sum_error) / (sum.abs() - sum_error) + 6.0 * ROUNDING * weights[i].abs()
    });
    let depth = weights[0] * depths[0] + weights[1] * depths[1] + weights[2] * depths[2];
    let of_depth: f64 = (0..3).map(|i| of_weights[i] * (depths[i] - depth).abs()).sum();
    let is_certain = areas.iter().all(|&(w, e)| w > e) || areas.iter().all(|&(w, e)| w < -e);
    let crossing = Crossing { t: depth * line.shear[2], weights };
    Some((crossing, (of_depth + rounded) * scale, of_weights, is_certain))
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::glam::DMat3;
    use drypoint_scene::mesh::TriangleMesh;
    use drypoint_scene::philox::uniform;
    use drypoint_scene::space::Grid;

    /// A crumpled sheet of 9 × 9 corners.
    fn sheet() -> TriangleMesh {
        let height = |i: u32| uniform(3, [i, 0, 0], 0);
        let corner = |i: u32| DVec3::new(f64::from(i % 9), f64::from(i / 9), 3.0 * height(i));
        let face = |i: u32| {
            let at = i / 8 * 9 + i % 8;
            [[at, at + 1, at + 10], [at, at + 10, at + 9]]
        };
        TriangleMesh::new((0..81).map(corner).collect(), None, (0..64).flat_map(face).collect()).unwrap()
    }

    /// Lines that differ by up to the error meet possible triangles, at depths within their errors. A line that no
    /// triangle is certain for may meet none.
    #[test]
    fn lines_nearby_meet_possible_triangles() {
        let meshes = [sheet()];
        let grid = Grid::new([2; 3], DMat3::IDENTITY, DVec3::ZERO).unwrap();
        let search = MeshSearch::new(&meshes, &grid).unwrap();
        let unit = |draw: u32, which: u32| uniform(7, [draw, which, 0], 0);
        let (mut met, mut open) = (0, 0);
        for draw in 0..3000 {
            let position = [1e-3, 1e-5][draw as usize % 2];
            let about = |which: u32| 2.0 * unit(draw, which) - 1.0;
            let origin = DVec3::new(9.0 * unit(draw, 0) - 0.5, 9.0 * unit(draw, 1) - 0.5, 12.0);
            let line = [origin, DVec3::new(0.3 * about(2), 0.3 * about(3), -1.0)];
            let range = [0.0, 40.0];
            let possible = search.possible(line, LineErrors { position, start: 10.0 }, range);
            open += usize::from(possible.iter().all(|possible| !possible.is_certain) && !possible.is_empty());
            for other in 0..4 {
                let shift = DVec3::new(about(4 + 3 * other), about(5 + 3 * other), about(6 + 3 * other)) * position;
                let found = search.nearest([line[0] + shift, line[1]], range);
                let Some(hit) = found else {
                    assert!(possible.iter().all(|possible| !possible.is_certain), "{draw}: {possible:?}");
                    continue;
                };
                met += 1;
                let possible = possible.iter().find(|possible| possible.hit.is_in_triangle_of(&hit));
                let possible = possible.unwrap_or_else(|| panic!("{draw}: {hit:?} is not expected"));
                let off = (possible.hit.t - hit.t).abs();
                assert!(off <= possible.error, "{draw}: off by {off:e}, bound {:e}", possible.error);
                for i in 0..3 {
                    let off = (possible.hit.weights[i] - hit.weights[i]).abs();
                    assert!(off <= possible.weights[i], "{draw}: a weight is off by {off:e}");
                }
            }
        }
        assert!(met > 6000 && open > 3 && open < 100, "{met} hits, {open} open lines");
    }
}
