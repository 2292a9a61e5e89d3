//! The start of a stroke: from a cell's centre along its gradient to a place just in front of the surface
//! ([HATCH-7]).

use super::super::strokes::{
    CurvatureFamily, HatchCounts, HatchParams, NoDirection, RejectCause, StrokeField, StrokeGrower, inside, normal,
};
use super::root_search::RootSearch;
use crate::field::Outside;
use crate::field::curvature::Curvature;
use crate::number::Vec3;
use drypoint_scene::glam::DVec3;
use drypoint_scene::math::scale_by_power_of_two;

/// Number of places to either side of the centre at which the value is evaluated.
const PLACES: u32 = 12;

/// Number of evaluations of the value for a seed.
const EVALUATIONS: u32 = 60;

/// The largest distance of the target from the surface's value, as a share of the range of values.
const LARGEST_SHARE: f64 = 0.1;

/// A place from which a stroke grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seed {
    /// The cell that contains the seed.
    pub cell: [usize; 3],
    /// Place in world space.
    pub world: DVec3,
    /// N at the place.
    pub normal: DVec3,
    /// The value of the iso-surface on which the stroke stays.
    pub target: f64,
    /// Curvatures per world unit, with both directions.
    pub curvature: Curvature<f64>,
    /// The stroke's family: `Max` or `Min`.
    pub family: CurvatureFamily,
}

impl HatchParams {
    /// Returns the value at the distance δ in front of a surface: iso ∓ min(δ‖g‖, 0.1 of the range). `slope` is ‖g‖,
    /// in the value's unit per world unit.
    fn target(&self, ground: &dyn StrokeField, iso: f64, slope: f64) -> f64 {
        let [lo, hi] = ground.range();
        let by = (self.in_front(ground.grid()) * slope).min(LARGEST_SHARE * (hi - lo));
        match ground.outside() {
            Outside::Low => iso - by,
            Outside::High => iso + by,
        }
    }
}

impl<'f> StrokeGrower<'f, '_> {
    /// Returns the seed of a cell.
    ///
    /// # Errors
    /// The cell's line does not meet the surface, or there is no direction at the crossing.
    pub fn place(&self, cell: [usize; 3], counts: &mut HatchCounts) -> Result<Seed, RejectCause> {
        let (world, target) = self.on_surface(cell, [0.5; 3])?;
        self.seed(cell, world, target, counts).map_err(RejectCause::Direction)
    }

    /// Follows the gradient's line through a place in a cell to the surface of the strokes. Returns the crossing and
    /// the value there. `within` holds coordinates in [0, 1] of the cell. Without a surface the place itself is
    /// returned.
    ///
    /// # Errors
    /// The line does not meet the surface, or the place has no gradient.
    pub(in super::super) fn on_surface(&self, cell: [usize; 3], within: [f64; 3]) -> Result<(DVec3, f64), RejectCause> {
        let ground = self.ground();
        let grid = ground.grid();
        let dims = grid.dims();
        let along = |a: usize| if dims[a] == 1 { 0.0 } else { cell[a] as f64 + within[a] };
        let index = Vec3::new(along(0), along(1), along(2));
        if ground.masked(cell) {
            return Err(RejectCause::NoSurface);
        }
        let (outward, slope) = normal(ground, index).ok_or(RejectCause::Direction(NoDirection::Gradient))?;
        let from = grid.to_world(index.to_glam());
        let Some(iso) = self.iso() else { return Ok((from, ground.value(index))) };
        let slope = scale_by_power_of_two(slope, ground.exponent());
        let target = self.how().target(ground, iso, slope);
        // The search reaches as far as the cell's diagonal, in voxels, so that cells with a long spacing are searched
        // as well.
        let reach = 3f64.sqrt() / (grid.inverse_axes() * outward).length();
        let s = self.meets(from, outward, target, reach, PLACES, EVALUATIONS).ok_or(RejectCause::NoSurface)?;
        Ok((from + outward * s, target))
    }

    /// Returns the seed at a place in world space, for a stroke that stays at the value `target`.
    ///
    /// # Errors
    /// The place has no direction.
    pub(in super::super) fn seed(
        &self,
        cell: [usize; 3],
        world: DVec3,
        target: f64,
        counts: &mut HatchCounts,
    ) -> Result<Seed, NoDirection> {
        let at = inside(self.ground(), world).ok_or(NoDirection::Volume)?;
        let (normal, _) = normal(self.ground(), at).ok_or(NoDirection::Gradient)?;
        let curvature = self.curvature(at, &mut counts.scales)?;
        let family = self.how().family.of(&curvature);
        Ok(Seed { cell, world, normal, target, curvature, family })
    }

    /// Finds the place nearest to s = 0, |s| ≤ `reach`, at which the line x + s·along has a value. `along` is a unit
    /// vector of the world. [`Self::near`] is the tolerance.
    pub(in super::super) fn meets(
        &self,
        x: DVec3,
        along: DVec3,
        target: f64,
        reach: f64,
        places: u32,
        evaluations: u32,
    ) -> Option<f64> {
        let ground = self.ground();
        let over = |s: f64| Some(ground.value(inside(ground, x + along * s)?) - target);
        RootSearch { over, tolerance: self.near(target), budget: evaluations }.nearest(reach, places)
    }

    /// Tolerance of |f − target|. It is 2⁻⁴⁰ of the range of values, but at least the rounding of a large target. Far
    /// from the world's origin, it is at least the change of values over the rounding of places.
    pub(in super::super) fn near(&self, target: f64) -> f64 {
        let [lo, hi] = self.ground().range();
        let places = self.rounding() * (hi - lo);
        scale_by_power_of_two(hi - lo, -40).max(4.0 * f64::EPSILON * target.abs()).max(places)
    }
}
