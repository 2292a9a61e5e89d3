//! The samples of a ray that clip planes do not cut away ([RAY-8]).

use super::lattice::IndexRay;
use crate::number::{Real, Vec3};
use drypoint_scene::clip::{ClipPlane, ClipPlanes};

/// The place where a ray leaves what planes cut away of a volume.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CutPlace {
    /// The first sample behind the cut.
    pub(super) k: i64,
    /// The index of the plane.
    pub(super) plane: usize,
    /// The eye depth at which the ray crosses the plane.
    pub(super) depth: f64,
}

impl<R: Real> IndexRay<R> {
    /// The samples of a run inside the box [lo, hi] that no plane cuts away, as the closed range first..=last.
    ///
    /// A sample is cut away if its position is. The remaining region is convex, so its samples form a run, whose ends
    /// are found by testing positions.
    pub(super) fn left_by(&self, clip: &ClipPlanes, ends: [Vec3<R>; 2], [first, last]: [i64; 2]) -> [i64; 2] {
        if clip.is_empty() || first > last {
            return [first, last];
        }
        let ([mut from, mut to], reach) = ([first, last], [self.depth(first), self.depth(last)]);
        for plane in &clip.0 {
            let (a, b) = self.beyond(plane);
            // The rounding of positions, relative to the numbers from which they are computed.
            let margin = 8.0 * R::EPSILON.to_f64() * self.scale(plane, ends);
            if b == 0.0 {
                if a > margin {
                    return [1, 0];
                }
                continue;
            }
            // The sample at the crossing, clamped to the run and one step beyond it.
            let [near, far] = reach.map(Real::to_f64);
            let step = self.depth_step.to_f64();
            let crossing = ((margin - a) / b).max(near - step).min(far + step);
            let [above, below] = self.within([crossing; 2]);
            if b < 0.0 { from = from.max(above) } else { to = to.min(below) }
        }
        let is_cut = |k: i64| clip.cut(self.position(k).to_glam());
        while from <= to && is_cut(from) {
            from += 1;
        }
        while to >= from && is_cut(to) {
            to -= 1;
        }
        [from, to]
    }

    /// The first sample behind a cut, and where the ray crosses the plane through which it reaches the sample: the last
    /// plane that it crosses. Returns none if no sample before it in the run is cut away.
    pub(super) fn cut_sample(&self, clip: &ClipPlanes, ends: [Vec3<R>; 2]) -> Option<CutPlace> {
        if clip.is_empty() {
            return None;
        }
        let run = self.inside(ends);
        let [first, last] = self.left_by(clip, ends, run);
        if first > last || first == run[0] {
            return None;
        }
        let before = self.position(first - 1).to_glam();
        let crossed = clip.0.iter().enumerate().filter(|(_, plane)| plane.beyond(before) > 0.0);
        let depths = crossed.map(|(i, plane)| {
            let (a, b) = self.beyond(plane);
            (i, -a / b)
        });
        // If several planes are crossed together, the first one in the list counts.
        let last = depths.reduce(|last, next| if next.1 > last.1 { next } else { last });
        last.map(|(plane, depth)| {
            // Against rounding: the ray comes out of the plane between both samples.
            let [before, at] = [first - 1, first].map(|k| self.depth(k).to_f64());
            CutPlace { k: first, plane, depth: depth.max(before).min(at) }
        })
    }

    /// a and b of a + b·depth, which is above 0 where the plane cuts the ray away.
    pub(super) fn beyond(&self, plane: &ClipPlane) -> (f64, f64) {
        let [origin, along] = self.line();
        (plane.beyond(origin), plane.index_normal.dot(along))
    }

    /// A bound on the terms of m·p − c for positions p in the box [lo, hi].
    fn scale(&self, plane: &ClipPlane, [lo, hi]: [Vec3<R>; 2]) -> f64 {
        let [origin, _] = self.line();
        let largest = origin.abs() + 2.0 * lo.to_glam().abs().max(hi.to_glam().abs());
        plane.index_normal.abs().dot(largest) + plane.index_offset.abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::glam::{DMat3, DVec3};
    use drypoint_scene::shot::{Lattice, StepAlong};
    use drypoint_scene::space::Grid;
    use drypoint_scene::tables::{Camera, Projection};
    use drypoint_scene::view::View;
    use proptest::prelude::*;

    /// A ray along x from (−4, 4, 4) with samples at whole numbers and a half.
    fn along_x() -> IndexRay<f64> {
        let vector = |v| Vec3::from_glam(DVec3::from_array(v));
        IndexRay {
            origin: vector([-4.0, 4.0, 4.0]),
            along: vector([1.0, 0.0, 0.0]),
            depth_step: 1.0,
            first: 0,
            step: 1.0,
        }
    }

    #[test]
    fn cuts_by_hand() {
        let grid = Grid::with_spacing([9, 9, 9], [1.0; 3]).unwrap();
        let ends = grid.index_box().map(Vec3::from_glam);
        let plane = |point: f64, normal: [f64; 3]| {
            ClipPlane::in_index(DVec3::new(point, 4.0, 4.0), DVec3::from_array(normal), &grid)
        };
        let found = |planes: Vec<ClipPlane>| {
            let (ray, clip) = (along_x(), ClipPlanes(planes));
            let cut = ray.cut_sample(&clip, ends).map(|cut| (cut.k, cut.plane, cut.depth));
            (ray.left_by(&clip, ends, ray.inside(ends)), cut)
        };
        // The box has the samples 4 to 11, at x = ½ to 7½.
        assert_eq!(found(vec![]), ([4, 11], None));
        assert_eq!(found(vec![plane(2.0, [-1.0, 0.0, 0.0])]), ([6, 11], Some((6, 0, 6.0))));
        // A sample on the plane itself is left.
        assert_eq!(found(vec![plane(2.5, [-1.0, 0.0, 0.0])]), ([6, 11], Some((6, 0, 6.5))));
        assert_eq!(found(vec![plane(5.5, [1.0, 0.0, 0.0])]), ([4, 9], None));
        // A plane that ends before the first sample cuts none; the last plane that is crossed counts.
        assert_eq!(found(vec![plane(0.25, [-1.0, 0.0, 0.0])]), ([4, 11], None));
        let two = vec![plane(3.2, [-1.0, 0.5, 0.0]), plane(3.4, [-1.0, 0.0, 0.0])];
        assert_eq!(found(two), ([7, 11], Some((7, 1, 7.4))));
        // Of two planes of which one cuts the sample before, it is that one.
        let two = vec![plane(3.4, [-1.0, 0.0, 0.0]), plane(2.9, [-1.0, 0.0, 0.0])];
        assert_eq!(found(two), ([7, 11], Some((7, 0, 7.4))));
        // Beside the ray: all or nothing.
        assert_eq!(found(vec![plane(0.0, [0.0, 1.0, 0.0])]), ([4, 11], None));
        let below = ClipPlane::in_index(DVec3::new(0.0, 3.9, 0.0), DVec3::Y, &grid);
        assert_eq!(found(vec![below]).1, None);
    }

    proptest! {
        /// The samples left of a ray are exactly those that no plane cuts away.
        #[test]
        fn the_run_is_exactly_what_is_left(
            direction in prop::array::uniform3(-1.0..1.0f64),
            eye in prop::array::uniform3(-30.0..30.0f64),
            pixel in prop::array::uniform2(0.0..16.0f64),
            planes in prop::collection::vec(
                (prop::array::uniform3(-2.0..10.0f64), prop::array::uniform3(-1.0..1.0f64), any::<bool>()),
                1..4,
            ),
            step in 0.05..2.0f64,
            perspective in any::<bool>(),
        ) {
            prop_assume!(DVec3::from_array(direction).length() > 0.1);
            prop_assume!(planes.iter().all(|(_, normal, _)| DVec3::from_array(*normal).length() > 0.1));
            let axes = DMat3::from_cols(DVec3::new(1.0, 0.2, 0.0), DVec3::new(0.0, 2.0, 0.3), DVec3::new(0.1, 0.0, 0.5));
            let grid = Grid::new([9, 7, 5], axes, DVec3::new(1.0, 2.0, 3.0)).unwrap();
            let projection =
                if perspective { Projection::Perspective { fov: 60.0 } } else { Projection::Orthographic { height: None } };
            let direction = DVec3::from_array(direction);
            let eye = Some(DVec3::from_array(eye));
            let camera = Camera { projection, direction, direction_given: true, eye, ..Camera::default() };
            let view = View::new(&camera, &grid, [16, 16]).unwrap();
            let lattice = Lattice { step, along: StepAlong::Plane, near: step };
            let clip = ClipPlanes(planes.into_iter().map(|(point, normal, in_world)| {
                let [point, normal] = [point, normal].map(DVec3::from_array);
                if in_world {
                    ClipPlane::in_world(point, normal, &grid)
                } else {
                    ClipPlane::in_index(point, normal, &grid)
                }
            }).collect());
            let ends = grid.index_box();
            let ray = view.ray(pixel[0], pixel[1]);
            is_exact(&IndexRay::<f64>::new(&ray, &view, &lattice, &grid), &clip, ends.map(Vec3::from_glam))?;
            is_exact(&IndexRay::<f32>::new(&ray, &view, &lattice, &grid), &clip, ends.map(Vec3::from_glam))?;
        }
    }

    fn is_exact<R: Real>(ray: &IndexRay<R>, clip: &ClipPlanes, ends: [Vec3<R>; 2]) -> Result<(), TestCaseError> {
        let [first, last] = ray.inside(ends);
        let all: Vec<i64> = (first..=last).filter(|&k| !clip.cut(ray.position(k).to_glam())).collect();
        let [from, to] = ray.left_by(clip, ends, [first, last]);
        prop_assert_eq!((from..=to).collect::<Vec<_>>(), all);
        let cut = ray.cut_sample(clip, ends);
        prop_assert_eq!(cut.map(|cut| cut.k), (from <= to && from > first).then_some(from));
        if let Some(CutPlace { k, plane, depth }) = cut {
            prop_assert!(clip.0[plane].beyond(ray.position(k - 1).to_glam()) > 0.0);
            prop_assert!(ray.depth(k - 1).to_f64() <= depth && depth <= ray.depth(k).to_f64());
        }
        Ok(())
    }
}
