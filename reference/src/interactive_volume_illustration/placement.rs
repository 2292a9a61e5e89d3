//! Where a stroke begins: from a cell's centre along its gradient to a place just in front of the surface ([HATCH-7]).

use super::counts::{HatchCounts, NoDirection, Rejected};
use super::ground::{Ground, inside, normal};
use super::search::Search;
use super::strokes::{Family, Hatching, Strokes};
use crate::field::Outside;
use crate::field::curvature::Curvature;
use crate::number::Vec3;
use drypoint_scene::glam::DVec3;
use drypoint_scene::math::scale_by_power_of_two;

/// Places to either side of the centre at which the value is looked at.
const PLACES: u32 = 12;

/// Evaluations of the value for a seed.
const EVALUATIONS: u32 = 60;

/// The largest share of the range of values that the target is away from the surface's value.
const LARGEST_SHARE: f64 = 0.1;

/// A place that a stroke grows from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seed {
    /// The cell that it was drawn in.
    pub cell: [usize; 3],
    /// In world space.
    pub world: DVec3,
    /// N there.
    pub normal: DVec3,
    /// The value whose surface the stroke stays on.
    pub target: f64,
    /// Per world unit, with both directions.
    pub curvature: Curvature<f64>,
    /// `Max` or `Min`, the family of the stroke.
    pub family: Family,
}

impl Hatching {
    /// The value in front of a surface by δ, where the gradient has the length ‖g‖, in the value's unit per world unit:
    /// iso ∓ min(δ‖g‖, 0.1 of the range).
    fn target(&self, ground: &dyn Ground, iso: f64, slope: f64) -> f64 {
        let [lo, hi] = ground.range();
        let by = (self.in_front(ground.grid()) * slope).min(LARGEST_SHARE * (hi - lo));
        match ground.outside() {
            Outside::Low => iso - by,
            Outside::High => iso + by,
        }
    }
}

impl<'f> Strokes<'f, '_> {
    /// The seed of a cell.
    ///
    /// # Errors
    /// The cell's line does not meet the surface, or there is no direction where it does.
    pub fn place(&self, cell: [usize; 3], counts: &mut HatchCounts) -> Result<Seed, Rejected> {
        let (world, target) = self.on_surface(cell, [0.5; 3])?;
        self.seed(cell, world, target, counts).map_err(Rejected::Direction)
    }

    /// Where the gradient's line through a place in a cell, each coordinate in [0, 1] of it, meets what strokes lie on, with
    /// the value there; the place itself where strokes go without a surface.
    ///
    /// # Errors
    /// It does not, or has no gradient.
    pub(super) fn on_surface(&self, cell: [usize; 3], within: [f64; 3]) -> Result<(DVec3, f64), Rejected> {
        let ground = self.ground();
        let grid = ground.grid();
        let dims = grid.dims();
        let along = |a: usize| if dims[a] == 1 { 0.0 } else { cell[a] as f64 + within[a] };
        let index = Vec3::new(along(0), along(1), along(2));
        if ground.masked(cell) {
            return Err(Rejected::NoSurface);
        }
        let (outward, slope) = normal(ground, index).ok_or(Rejected::Direction(NoDirection::Gradient))?;
        let from = grid.to_world(index.to_glam());
        let Some(iso) = self.iso() else { return Ok((from, ground.value(index))) };
        let slope = scale_by_power_of_two(slope, ground.exponent());
        let target = self.how().target(ground, iso, slope);
        // As far as the cell's diagonal is long, in voxels, so that no cell of a long spacing is passed over.
        let reach = 3f64.sqrt() / (grid.inverse_axes() * outward).length();
        let s = self.meets(from, outward, target, reach, PLACES, EVALUATIONS).ok_or(Rejected::NoSurface)?;
        Ok((from + outward * s, target))
    }

    /// A seed at a place in world space, of the stroke that stays at the value `target`.
    ///
    /// # Errors
    /// There is no direction.
    pub(super) fn seed(
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

    /// Where the line x + s·along, a unit vector of the world, has a value nearest to s = 0, |s| ≤ `reach`, as near as
    /// [`Self::near`].
    pub(super) fn meets(
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
        Search { over, tolerance: self.near(target), budget: evaluations }.nearest(reach, places)
    }

    /// |f − target| that counts as none: 2⁻⁴⁰ of the range of values, or the rounding of a large target, or what the values
    /// change by over the rounding of places far from the world's origin.
    pub(super) fn near(&self, target: f64) -> f64 {
        let [lo, hi] = self.ground().range();
        let places = self.rounding() * (hi - lo);
        scale_by_power_of_two(hi - lo, -40).max(4.0 * f64::EPSILON * target.abs()).max(places)
    }
}
