//! Strokes without an iso-value, at all values that count ([HATCH-16]).

use super::super::strokes::{StrokeGrower, inside};
use super::pyramid::Pyramid;
use super::selection::{SeedRule, Seeds};
use crate::field::Field;
use drypoint_scene::glam::DVec3;
use drypoint_scene::strokes::Measure as Kind;

impl StrokeGrower<'_, '_> {
    /// Like [`seeds`](Self::seeds), for the cells in whose closed range of values one counts.
    pub fn seeds_among(
        &self,
        pyramid: &Pyramid,
        field: &Field<'_, f64>,
        counts: impl Fn([f64; 2]) -> bool + Sync,
        rule: SeedRule,
        (kind, range): (Kind, [f64; 2]),
    ) -> Seeds {
        Seeds::among(pyramid, field.volume(), counts, rule, |voxel| self.measure(voxel, kind, range))
    }

    /// The value at a place of the world. Returns none outside the volume.
    pub fn value(&self, world: DVec3) -> Option<f64> {
        inside(self.ground(), world).map(|index| self.ground().value(index))
    }
}
