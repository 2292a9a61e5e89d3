//! Rays in index space, and the samples on them ([RAY-1]).

use super::brick_occupancy::RayIntervals;
use crate::number::{Real, Vec3};
use drypoint_scene::clip::ClipPlanes;
use drypoint_scene::glam::DVec3;
use drypoint_scene::shot::{Lattice, StepAlong};
use drypoint_scene::space::Grid;
use drypoint_scene::view::{Ray, View};

/// The largest number of samples of a picture. More keep a fast processor busy for months.
pub const MOST_SAMPLES: f64 = 1e14;

/// The largest number of steps across a volume. A ray of this many samples takes about a second.
pub const MOST_ACROSS: f64 = 1e7;

/// Distance of an origin, in 1/ε voxels, from which rounding could move positions by a hundredth of a voxel.
const FAR: f64 = 1.0 / 1024.0;

/// About how many samples the rays through all pixel centres have in a grid's box, if none is skipped. It is the mean
/// over a coarse grid of rays, times the number of pixels.
pub fn samples_in(lattice: &Lattice, view: &View, grid: &Grid) -> f64 {
    samples_in_box(lattice, view, grid, grid.index_box())
}

/// Like [`samples_in`], but in a box of a grid's index space.
pub(super) fn samples_in_box(lattice: &Lattice, view: &View, grid: &Grid, ends: [DVec3; 2]) -> f64 {
    const SIDE: usize = 16;
    let [width, height] = view.size.map(|n| n as f64);
    let [lo, hi] = ends.map(Vec3::from_glam);
    let of_ray = |i: usize| {
        let at = |i: usize, n: f64| (i as f64 + 0.5) / SIDE as f64 * n;
        let ray = IndexRay::<f64>::new(&view.ray(at(i % SIDE, width), at(i / SIDE, height)), view, lattice, grid);
        let near = if view.perspective { lattice.near } else { f64::NEG_INFINITY };
        ray.depths(lo, hi).map_or(0.0, |[from, to]| ((to - from.max(near)) / ray.depth_step).max(0.0))
    };
    width * height * (0..SIDE * SIDE).map(of_ray).sum::<f64>() / (SIDE * SIDE) as f64
}

/// One ray in index space, with samples at the integers k.
///
/// The position of sample k is `origin + along · ((k + ½)·Δ)`. It is a function of the pixel and k, and is never
/// accumulated.
#[derive(Clone, Copy, Debug)]
pub struct IndexRay<R> {
    pub(super) origin: Vec3<R>,
    pub(super) along: Vec3<R>,
    /// Eye depth between samples.
    pub(super) depth_step: R,
    /// Smallest k beyond `near`.
    pub(super) first: i64,
    /// Δ_ray: world distance between samples on this ray ([VAL-4]).
    pub step: f64,
}

impl<R: Real> IndexRay<R> {
    /// The samples of a ray in the index space of a grid.
    pub fn new(ray: &Ray, view: &View, lattice: &Lattice, grid: &Grid) -> Self {
        let by_ray = lattice.along == StepAlong::Ray;
        let depth_step = if by_ray { lattice.step * ray.cos_phi } else { lattice.step };
        Self {
            origin: Vec3::from_glam(grid.to_index(ray.origin)),
            along: Vec3::from_glam(grid.inverse_axes() * ray.along),
            depth_step: R::from_f64(depth_step),
            first: lattice.first(view),
            step: if by_ray { lattice.step } else { lattice.step / ray.cos_phi },
        }
    }

    /// The eye depth of sample k.
    #[inline(always)]
    pub fn depth(&self, k: i64) -> R {
        (R::from_f64(k as f64) + R::HALF) * self.depth_step
    }

    /// The last sample before an eye depth.
    pub(super) fn last_before(&self, depth: f64) -> i64 {
        let before = |k: i64| self.depth(k).to_f64() < depth;
        let mut k = (depth / self.depth_step.to_f64() - 0.5) as i64;
        while before(k + 1) {
            k += 1;
        }
        while !before(k) {
            k -= 1;
        }
        k
    }

    /// The index position of sample k.
    #[inline(always)]
    pub fn position(&self, k: i64) -> Vec3<R> {
        let (o, a, t) = (self.origin, self.along, self.depth(k));
        Vec3::new(R::on_ray(o.x, a.x, t), R::on_ray(o.y, a.y, t), R::on_ray(o.z, a.z, t))
    }

    /// The index position at an eye depth that need not be a sample's.
    pub(super) fn position_at(&self, depth: R) -> Vec3<R> {
        let (o, a) = (self.origin, self.along);
        // An error of the depth moves the position along the ray.
        let error = depth - R::from_f64(depth.to_f64());
        let on_axis = |o: R, a: R| R::on_ray(o, a, depth) + a * error;
        Vec3::new(on_axis(o.x, a.x), on_axis(o.y, a.y), on_axis(o.z, a.z))
    }

    /// The samples inside the closed box [lo, hi] of index space and beyond `near`, as the closed range first..=last.
    /// The range is empty if first > last.
    ///
    /// A sample is inside if its rounded position is. Rounding is monotonic, so each coordinate is a monotonic function
    /// of k. The samples inside are therefore a contiguous run, whose ends are found by testing positions.
    pub fn inside(&self, [lo, hi]: [Vec3<R>; 2]) -> [i64; 2] {
        let Some(depths) = self.depths(lo, hi) else { return [1, 0] };
        let [mut first, mut last] = self.within(depths);
        first = first.max(self.first);
        let within = |k: i64| contains(lo, hi, self.position(k));
        while first <= last && !within(first) {
            first += 1;
        }
        while last >= first && !within(last) {
            last -= 1;
        }
        [first, last]
    }

    /// The samples that no plane cuts away and that can lie in visible bricks, as closed ranges first..=last in order.
    /// The depths of the bricks are [`RayIntervals::intervals`]. Without boxes, all samples that no plane cuts away are
    /// returned. The first sample behind a cut is always among them, since it is evaluated on the plane ([RAY-8]).
    ///
    /// The bounds of intervals are rounded outwards to samples, so that neighbouring intervals can overlap. No sample
    /// is in two ranges, and none is outside the volume.
    #[inline(always)]
    pub(super) fn visits<'b>(
        &self,
        ends: [Vec3<R>; 2],
        clip: &ClipPlanes,
        intervals: Option<&'b [[f64; 2]]>,
    ) -> impl Iterator<Item = [i64; 2]> + use<'b, R> {
        let (whole, intervals) = (intervals.is_none(), intervals.unwrap_or(&[]));
        let is_met = whole || !intervals.is_empty();
        let inside = if is_met { self.inside(ends) } else { [1, 0] };
        let [first, last] = self.left_by(clip, ends, inside);
        let of_cut = first + i64::from(first > inside[0]);
        let begin = if whole { [first, last] } else { [first, last.min(of_cut - 1)] };
        Some(begin).into_iter().filter(|[first, last]| first <= last).chain(self.parts([of_cut, last], intervals))
    }

    /// The samples at some depths, limited to a range.
    #[inline(always)]
    pub(super) fn parts<'b>(
        &self,
        [mut next, end]: [i64; 2],
        intervals: &'b [[f64; 2]],
    ) -> impl Iterator<Item = [i64; 2]> + use<'b, R> {
        let ray = *self;
        let parts = intervals.iter().map(move |&depths| {
            let [first, last] = ray.within(depths);
            let part = [first.max(next), last.min(end)];
            next = next.max(part[1] + 1);
            part
        });
        parts.filter(|[first, last]| first <= last)
    }

    /// Whether sample k is beyond `near` and inside the box.
    #[inline]
    pub fn has(&self, k: i64, [lo, hi]: [Vec3<R>; 2]) -> bool {
        k >= self.first && contains(lo, hi, self.position(k))
    }

    /// The samples whose eye depth lies in a closed range, as the closed range first..=last. Rounding may add one more
    /// at each end.
    pub fn within(&self, depths: [f64; 2]) -> [i64; 2] {
        let [near, far] = depths.map(|depth| depth / self.depth_step.to_f64() - 0.5);
        // The quotient and the difference are rounded.
        let slack = |k: f64| 2.0 * f64::EPSILON * (k.abs() + 1.0);
        [ceil(near - slack(near)), -ceil(-far - slack(far))]
    }

    /// The depths at which the ray is in visible bricks.
    #[inline(always)]
    pub(super) fn intervals<'b>(&self, boxes: Option<&'b mut RayIntervals>) -> Option<&'b [[f64; 2]]> {
        boxes.map(|boxes| boxes.intervals(self.line(), R::EPSILON.to_f64()))
    }

    /// Origin and displacement for one unit of depth, in index space.
    pub fn line(&self) -> [DVec3; 2] {
        self.rounded().map(|v| v.to_glam())
    }

    /// Origin and displacement for one unit of depth, in the numbers of positions.
    pub(super) fn rounded(&self) -> [Vec3<R>; 2] {
        [self.origin, self.along]
    }

    /// Eye depths at which the ray enters and leaves a box, widened by the rounding of positions.
    pub(super) fn depths(&self, lo: Vec3<R>, hi: Vec3<R>) -> Option<[f64; 2]> {
        let [o, d] = self.line();
        let (lo, hi) = (lo.to_glam(), hi.to_glam());
        let mut range = [f64::NEG_INFINITY, f64::INFINITY];
        for axis in 0..3 {
            let (o, d) = (o[axis], d[axis]);
            // A margin for the rounding of o + d·s in R, relative to the largest number in it.
            let margin = 8.0 * R::EPSILON.to_f64() * (o.abs() + lo[axis].abs() + hi[axis].abs());
            let (lo, hi) = (lo[axis] - margin, hi[axis] + margin);
            if d == 0.0 {
                if o < lo || o > hi {
                    return None;
                }
                continue;
            }
            let (a, b) = ((lo - o) / d, (hi - o) / d);
            range = [range[0].max(a.min(b)), range[1].min(a.max(b))];
        }
        (range[0] <= range[1] && range[0].is_finite() && range[1].is_finite()).then_some(range)
    }
}

/// For rays that are cast in lanes, which compute in f64.
impl IndexRay<f64> {
    /// All samples beyond `near`, for a ray that is evaluated only in boxes half a voxel inside the volume. Returns
    /// none if rounding could move positions by that much.
    #[inline(always)]
    pub(super) fn all_beyond_near(&self) -> Option<[i64; 2]> {
        let [x, y, z] = self.origin.to_glam().to_array();
        (x.abs().max(y.abs()).max(z.abs()) < FAR / f64::EPSILON).then_some([self.first, i64::MAX])
    }
}

/// ⌈x⌉, saturating. `f64::ceil` calls a library function if the processor has no instruction for it.
#[inline(always)]
fn ceil(x: f64) -> i64 {
    let i = x as i64;
    i.saturating_add(i64::from((i as f64) < x))
}

/// Whether a position lies in a closed box.
#[inline(always)]
fn contains<R: Real>(lo: Vec3<R>, hi: Vec3<R>, p: Vec3<R>) -> bool {
    p.x >= lo.x && p.x <= hi.x && p.y >= lo.y && p.y <= hi.y && p.z >= lo.z && p.z <= hi.z
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::tables::{Camera, Projection};
    use proptest::prelude::*;

    /// A ray by its numbers.
    fn ray<R: Real>(origin: [f64; 3], along: [f64; 3], depth_step: f64) -> IndexRay<R> {
        let vector = |v| Vec3::from_glam(DVec3::from_array(v));
        let depth_step = R::from_f64(depth_step);
        IndexRay { origin: vector(origin), along: vector(along), depth_step, first: i64::MIN, step: 1.0 }
    }

    #[test]
    fn the_samples_within_depths_by_hand() {
        let ray = ray::<f64>([0.0; 3], [0.0, 0.0, 1.0], 1.0);
        assert_eq!(ray.within([10.25, 20.25]), [10, 19]);
        // Depths of samples themselves belong to the range, however the quotient rounds.
        assert_eq!(ray.within([10.5, 20.5]), [10, 20]);
        assert_eq!(ray.within([-3.5, -0.25]), [-4, -1]);
    }

    #[test]
    fn a_ray_beside_the_box_meets_it_nowhere() {
        let box_of_8 = [DVec3::ZERO, DVec3::splat(8.0)].map(Vec3::<f64>::from_glam);
        let depths = |y: f64| ray::<f64>([-4.0, y, 4.0], [1.0, 0.0, 0.0], 1.0).depths(box_of_8[0], box_of_8[1]);
        assert_eq!([depths(-1.0), depths(9.0)], [None, None]);
        // On its faces and inside, from 4 to 12.
        for y in [0.0, 4.0, 8.0] {
            let [near, far] = depths(y).unwrap();
            assert!((near - 4.0).abs() < 1e-13 && (far - 12.0).abs() < 1e-13, "{y}: {near} {far}");
        }
    }

    #[test]
    fn a_sample_is_there_beyond_near_and_inside() {
        let ends = [DVec3::ZERO, DVec3::splat(8.0)].map(Vec3::<f64>::from_glam);
        let ray = IndexRay { first: 6, ..ray::<f64>([-4.0, 4.0, 4.0], [1.0, 0.0, 0.0], 1.0) };
        let all: Vec<i64> = (-20..40).filter(|&k| ray.has(k, ends)).collect();
        // Depths 6½ to 11½; without `first` they begin at 4½.
        assert_eq!(all, (6..=11).collect::<Vec<_>>());
    }

    /// In f32, from so far away that positions are rounded to a hundredth of a voxel, and from inside: the rounded position
    /// decides.
    #[test]
    fn rounded_positions_are_inside_as_they_come() {
        let mut drawn = 0;
        let mut unit = || {
            drawn += 1;
            drypoint_scene::philox::uniform(7, [0; 3], drawn)
        };
        let ends = [DVec3::ZERO, DVec3::new(8.0, 6.0, 4.0)].map(Vec3::<f32>::from_glam);
        for i in 0..3000 {
            let away = [0.0, 100.0, 1e5][i % 3];
            let along = DVec3::new(unit() - 0.5, unit() - 0.5, unit() - 0.5).normalize();
            let target = DVec3::new(8.0 * unit(), 6.0 * unit(), 4.0 * unit());
            let ray = ray::<f32>((target - along * away).to_array(), along.to_array(), 0.0625);
            let [first, last] = ray.inside(ends);
            let middle = (away / 0.0625) as i64;
            let all: Vec<i64> = (middle - 400..middle + 400).filter(|&k| ray.has(k, ends)).collect();
            assert_eq!((all.first(), all.last()), (Some(&first), Some(&last)), "{i}");
        }
    }

    proptest! {
        #[test]
        fn the_run_is_exactly_what_is_inside(
            direction in prop::array::uniform3(-1.0..1.0f64),
            eye in prop::array::uniform3(-30.0..30.0f64),
            pixel in prop::array::uniform2(0.0..16.0f64),
            step in 0.05..2.0f64,
            perspective in any::<bool>(),
        ) {
            prop_assume!(DVec3::from_array(direction).length() > 0.1);
            let grid = Grid::with_spacing([9, 7, 5], [1.0, 2.0, 0.5]).unwrap();
            let projection =
                if perspective { Projection::Perspective { fov: 60.0 } } else { Projection::Orthographic { height: None } };
            let camera = Camera {
                projection,
                direction: DVec3::from_array(direction),
                direction_given: true,
                eye: Some(DVec3::from_array(eye)),
                ..Camera::default()
            };
            let view = View::new(&camera, &grid, [16, 16]).unwrap();
            let lattice = Lattice { step, along: StepAlong::Plane, near: step };
            let ray = IndexRay::<f64>::new(&view.ray(pixel[0], pixel[1]), &view, &lattice, &grid);
            let ends = grid.index_box().map(Vec3::from_glam);
            let [first, last] = ray.inside(ends);
            // By definition, over far more samples than the box can hold.
            let all: Vec<i64> = (-3000..3000)
                .filter(|&k| (!perspective || (k as f64 + 0.5) * step > step) && contains(ends[0], ends[1], ray.position(k)))
                .collect();
            let got: Vec<i64> = (first..=last).collect();
            prop_assert_eq!(got, all);
        }
    }
}
