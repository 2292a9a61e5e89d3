//! The numbers of a field for another renderer.

use super::coefficients::Coefficients;
use super::gradient::regression::Regression;
use super::{Field, GradientEstimator, HessianEstimator, KernelData, Rung, Second};
use crate::number::Real;
use drypoint_scene::math;
use drypoint_scene::measured::{Measured, PaddedNumbers};
use std::sync::Arc;

/// Voxels beyond the border that a cell's estimators read.
const REACH: usize = 2;

/// A range counts as around 0 if it exceeds this share of its largest magnitude.
const FAR: f64 = 1.0 / 16.0;

impl<R: Real> Field<'_, R> {
    /// The numbers of the kernel and of the estimators, without ranges.
    pub(crate) fn measured(&self, rung: Rung) -> Measured {
        let slope = self.slope.to_f64();
        let coefficients = || Coefficients::<R>::of_voxels(&self.stencils, REACH).continued();
        let voxels = || coefficients().padded(slope);
        let (mut numbers, is_voxels): (PaddedNumbers, bool) = match &self.kernel {
            KernelData::Bspline(c) | KernelData::Bspline5(c) => (c.padded(slope), false),
            KernelData::Trilinear | KernelData::BsplineSmooth | KernelData::CatmullRom => (voxels(), true),
        };
        // Values in a range around 0 keep their digits as they are. Far from 0 the differences to the lowest value keep
        // them.
        let mut base = self.to_value(self.stencils.lowest()).to_f64();
        let [lo, hi] = self.volume.range();
        if is_voxels && hi - lo > FAR * lo.abs().max(hi.abs()) {
            let values = numbers.data.into_iter().map(|c| c + base).collect();
            (numbers, base) = (PaddedNumbers::new(values, numbers.dims, numbers.pad), 0.0);
        }
        let of_gradient = rung >= Rung::Gradient && self.how.gradient != GradientEstimator::Analytic;
        let of_hessian = rung >= Rung::Hessian && self.how.hessian == HessianEstimator::Central;
        let back = |g: R| math::scale_by_power_of_two(g.to_f64(), self.exponent);
        Measured {
            numbers: Arc::new(numbers),
            voxels: (!is_voxels && (of_gradient || of_hessian)).then(|| Arc::new(voxels())),
            smoothed: match &self.second {
                Second::Gaussian(c) => Some(Arc::new(c.padded(slope))),
                Second::NotPrepared | Second::Analytic | Second::Central => None,
            },
            regression: self.regression.as_ref().map(Regression::weights),
            base,
            gradient_range: None,
            gradient_scale: back(self.no_normal_below) / R::NO_NORMAL.to_f64(),
            label_distances: [None, None],
            bricks: None,
            mesh_boxes: Arc::default(),
        }
    }
}
