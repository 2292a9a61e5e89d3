//! Measures |∇| and κ of a field, by which the seeds of its strokes are chosen ([HATCH-5], [HATCH-6]).

use super::super::strokes::StrokeGrower;
use super::measures::VoxelMeasure;
use super::pyramid::Pyramid;
use super::selection::{SeedRule, Seeds};
use crate::field::Field;
use crate::field::quantile_of_norms;
use crate::number::Vec3;
use drypoint_scene::math::scale_by_power_of_two;
use drypoint_scene::shot::GradientRange;
use drypoint_scene::strokes::Measure as Kind;

/// Gradient lengths that count as |∇| = 0 and 1 ([VAL-2]), times the power of two of [SPACE-4]. The number is that of
/// the voxels read to find them.
pub fn gradient_range(field: &Field<'_, f64>, range: GradientRange) -> ([f64; 2], u64) {
    match range {
        GradientRange::Fixed(range) => (range.map(|g| scale_by_power_of_two(g, -field.scale_exponent())), 0),
        GradientRange::Quantile(q) => {
            let (hi, voxels) = quantile_of_norms(field, q);
            ([0.0, hi], voxels)
        }
    }
}

impl StrokeGrower<'_, '_> {
    /// Returns |∇| and κ at a voxel. κ is 0 where the voxel has no direction, as on flat and on round surfaces.
    pub(super) fn measure(&self, voxel: [usize; 3], kind: Kind, [lo, hi]: [f64; 2]) -> VoxelMeasure {
        let ground = self.ground();
        let [x, y, z] = voxel.map(|i| i as f64);
        let at = Vec3::new(x, y, z);
        let norm = ground.gradient(at).length();
        let gradient = if hi > lo { ((norm - lo) / (hi - lo)).clamp(0.0, 1.0) } else { 0.0 };
        VoxelMeasure { gradient, curvature: self.kappa(voxel, kind) }
    }

    fn kappa(&self, voxel: [usize; 3], kind: Kind) -> f64 {
        let curvature = self.at_voxel(voxel).map_or(0.0, |c| match kind {
            Kind::Mean => (0.5 * (c.k1 + c.k2)).abs(),
            Kind::Curvedness => (0.5 * (c.k1 * c.k1 + c.k2 * c.k2)).sqrt(),
        });
        (curvature * self.ground().grid().voxel()).min(1.0)
    }

    /// Adds the largest curvature of each entry to a pyramid if the directions of all voxels are stored. Otherwise
    /// the pyramid comes back unchanged, and curvatures are measured at the surface's cells only ([HATCH-5]).
    pub fn with_curvature(&self, pyramid: Pyramid, kind: Kind) -> Pyramid {
        if !self.is_prepared() {
            return pyramid;
        }
        pyramid.with_curvature(self.ground().grid().dims(), |voxel| self.kappa(voxel, kind))
    }

    /// Returns the cells of the surface f = `iso`, with their probabilities. The strokes grow on this field. `range`
    /// scales |∇|; it has no effect if every cell has a seed.
    pub fn seeds(
        &self,
        pyramid: &Pyramid,
        field: &Field<'_, f64>,
        iso: f64,
        rule: SeedRule,
        (kind, range): (Kind, [f64; 2]),
    ) -> Seeds {
        Seeds::new(pyramid, field.volume(), iso, rule, |voxel| self.measure(voxel, kind, range))
    }
}
