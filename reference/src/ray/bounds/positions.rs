//! Errors of the positions of samples in f32, and the decisions that depend on them.

use super::moved_ray::MovedRay;
use crate::number::{Bounded, Vec3};
use crate::ray::lattice::IndexRay;
use drypoint_scene::clip::{ClipPlane, ClipPlanes};
use drypoint_scene::glam::DVec3;

/// Half a unit in the last place of 1, slightly increased to cover products of errors.
const ROUNDING: f64 = 0.5 * f32::EPSILON as f64 * (1.0 + f32::EPSILON as f64);

/// Margin about the box in which samples are considered, in voxels. Errors of positions are far smaller.
const BEYOND: f64 = 1.0 / 256.0;

/// The point from which an f32 renderer computes the positions on a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayOrigin {
    /// The eye. `sampling.number = "f32"` computes origin, direction and step in f64 and rounds each once. A distant
    /// eye costs digits.
    Eye,
    /// The plane through the middle of the volume. Shaders compute each pixel in f32 from there, so that all numbers
    /// are of the volume's size.
    Middle,
}

/// An answer to a question that errors may leave open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Answer {
    Yes,
    No,
    Open,
}

impl IndexRay<Bounded> {
    /// The ray with a bound of the errors of its positions, for all samples in or near the box [lo, hi]. With `moved`,
    /// these are the errors of `moved`.
    ///
    /// From the eye a position is o + a·t with t = (k + ½)Δ. o, a and Δ are rounded once, and so are two products and a
    /// sum: u(|o| + 4|a·t| + |o + a·t|), u = 2⁻²⁴, where k + ½ is exact. Errors are convex in the depth, so the larger
    /// one at the ends of the box holds for the whole ray.
    #[inline]
    pub(super) fn with_errors(mut self, ends: [Vec3<Bounded>; 2], moved: Option<&MovedRay>) -> Self {
        let Some(depths) = self.near_box(ends) else { return self };
        let [o, a] = [self.origin, self.along].map(Vec3::to_glam);
        let at = |depth: f64| match moved {
            Some(moved) => moved.errors_at(depth),
            None => (ROUNDING * (o.abs() + 4.0 * (a * depth).abs() + (o + a * depth).abs())).to_array(),
        };
        let [near, far] = depths.map(at);
        let bounded = |axis: usize| Bounded::new(o[axis], near[axis].max(far[axis]));
        self.origin = Vec3::new(bounded(0), bounded(1), bounded(2));
        self
    }

    /// The errors of positions, along each axis.
    pub(super) fn errors(&self) -> [f64; 3] {
        [self.origin.x, self.origin.y, self.origin.z].map(Bounded::error)
    }

    /// Eye depths at which the ray is in the box or next to it.
    fn near_box(&self, [lo, hi]: [Vec3<Bounded>; 2]) -> Option<[f64; 2]> {
        let moved = |v: Vec3<Bounded>, by: f64| Vec3::from_glam(v.to_glam() + by);
        self.depths(moved(lo, -BEYOND), moved(hi, BEYOND))
    }

    /// The samples that can lie in the box, as a closed range.
    pub(super) fn candidates(&self, ends: [Vec3<Bounded>; 2]) -> [i64; 2] {
        let Some(depths) = self.near_box(ends) else { return [1, 0] };
        let [first, last] = self.within(depths);
        [first.max(self.first), last]
    }

    /// Whether sample k lies in the closed box [lo, hi].
    pub(super) fn is_inside(&self, k: i64, ends: [Vec3<Bounded>; 2]) -> Answer {
        is_in_box(self.position(k), ends)
    }

    /// The parts of the closed range of depths at which planes surely keep the ray and at which they may keep it: the
    /// ranges of depths in which the kept part begins and ends. Returns none if planes surely cut all of the box away.
    ///
    /// A plane is met at t = −a/b. n·p − c is off by what the position is off along n, and by three products, two sums
    /// and a difference of numbers of the size of n·|o| + n·|a·t| + |c|. The quotient is rounded once more.
    #[inline]
    pub(super) fn kept_part(
        &self,
        clip: &ClipPlanes,
        range: [f64; 2],
        ends: [Vec3<Bounded>; 2],
    ) -> Option<[[f64; 2]; 2]> {
        let [mut from, mut to] = range.map(|end| [end; 2]);
        let Some(box_depths) = self.near_box(ends) else { return Some([from, to]) };
        let (errors, [origin, along]) = (self.errors(), self.line());
        let farthest = box_depths[0].abs().max(box_depths[1].abs());
        for plane in &clip.0 {
            let ((a, b), n) = (self.beyond(plane), plane.index_normal.abs());
            let size = n.dot(origin.abs() + 2.0 * along.abs() * farthest) + plane.index_offset.abs();
            let error = n.dot(DVec3::from_array(errors)) + 8.0 * ROUNDING * size;
            let over = box_depths.map(|t| a + b * t);
            if over.iter().all(|over| *over > error) {
                return None;
            }
            if over.iter().all(|over| *over < -error) {
                continue;
            }
            let (t, error) = (-a / b, error / b.abs());
            let around = if t.is_finite() && error.is_finite() { [t - error, t + error] } else { box_depths };
            if b < 0.0 {
                from = [from[0].max(around[0]), from[1].max(around[1])];
            } else {
                to = [to[0].min(around[0]), to[1].min(around[1])];
            }
        }
        Some([from, to])
    }

    /// The depth −a/b at which the ray crosses a plane, and a bound of its error. See [`Self::kept_part`].
    pub(super) fn crossing(&self, plane: &ClipPlane) -> (f64, f64) {
        let ((a, b), n, [origin, along]) = (self.beyond(plane), plane.index_normal.abs(), self.line());
        let t = -a / b;
        let size = n.dot(origin.abs() + 2.0 * along.abs() * t.abs()) + plane.index_offset.abs();
        let error = n.dot(DVec3::from_array(self.errors())) + 8.0 * ROUNDING * size;
        (t, error / b.abs())
    }

    /// Whether errors leave open which plane ends the cut part of the ray, or which side of the plane is seen.
    #[inline]
    pub(super) fn cut_is_open(&self, clip: &ClipPlanes, v: Vec3<Bounded>) -> bool {
        let entry = |plane: &ClipPlane| {
            let (t, error) = self.crossing(plane);
            let is_edge_on = plane.normal.dot(v.to_glam()).abs() < 64.0 * ROUNDING;
            (self.beyond(plane).1 < 0.0).then_some((t, error, is_edge_on))
        };
        let entries: Vec<_> = clip.0.iter().filter_map(entry).collect();
        let Some(last) = entries.iter().copied().reduce(|last, next| if next.0 > last.0 { next } else { last }) else {
            return false;
        };
        let near = entries.iter().filter(|other| last.0 - other.0 <= last.1 + other.1).count();
        near > 1 || last.2
    }

    /// Whether planes cut sample k away.
    pub(super) fn is_cut(&self, k: i64, clip: &ClipPlanes) -> Answer {
        let p = self.position(k);
        let errors = [p.x, p.y, p.z].map(Bounded::error);
        let by = |plane: &ClipPlane| {
            let (beyond, n) = (plane.beyond(p.to_glam()), plane.index_normal.abs());
            // Three products, two sums and the difference to the offset.
            let size = n.dot(p.to_glam().abs()) + plane.index_offset.abs();
            let error = n.x * errors[0] + n.y * errors[1] + n.z * errors[2] + 5.0 * ROUNDING * size;
            if beyond.abs() <= error {
                Answer::Open
            } else if beyond > 0.0 {
                Answer::Yes
            } else {
                Answer::No
            }
        };
        let answers = || clip.0.iter().map(by);
        if answers().any(|answer| answer == Answer::Yes) {
            Answer::Yes
        } else if answers().any(|answer| answer == Answer::Open) {
            Answer::Open
        } else {
            Answer::No
        }
    }
}

/// Whether a position lies in the closed box [lo, hi].
pub(super) fn is_in_box(p: Vec3<Bounded>, [lo, hi]: [Vec3<Bounded>; 2]) -> Answer {
    let along = |p: Bounded, lo: Bounded, hi: Bounded| {
        let ([from, to], [lo, hi]) = (p.ends(), [lo.value(), hi.value()]);
        if to < lo || from > hi {
            Answer::No
        } else if from >= lo && to <= hi {
            Answer::Yes
        } else {
            Answer::Open
        }
    };
    let axes = [along(p.x, lo.x, hi.x), along(p.y, lo.y, hi.y), along(p.z, lo.z, hi.z)];
    if axes.contains(&Answer::No) {
        Answer::No
    } else if axes.contains(&Answer::Open) {
        Answer::Open
    } else {
        Answer::Yes
    }
}
