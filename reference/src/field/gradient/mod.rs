//! The gradient estimators of [REC-2] that read the voxels, one file each. Each estimate is in index space and in
//! stored units, interpolated trilinearly between the estimates at the corners of the cell. The fourth estimator,
//! `analytic`, is the derivative of each kernel and stands in the kernel's file.

pub(super) mod central;
mod integers;
pub(super) mod regression;
pub(super) mod sobel;
mod squares;

use super::{Field, GradientEstimator};
use crate::number::{Real, Vec3};
use drypoint_scene::with_access;

/// The estimate at a voxel that has neighbours on all sides. It equals the interpolated estimate, in which the other
/// corners have weight 0. Returns none at the border, for numbers that are scaled as they are read, and for `analytic`.
#[inline(never)]
pub(super) fn at_voxel<R: Real>(field: &Field<'_, R>, x: usize, y: usize, z: usize) -> Option<Vec3<R>> {
    if !field.stencils.surrounds([x, y, z]) {
        return None;
    }
    with_access!(field.volume, |a| match (field.how.gradient, &field.regression) {
        (GradientEstimator::Central, _) => Some(central::at_voxel(a, [x, y, z])),
        (GradientEstimator::Sobel, _) => Some(sobel::at_voxel(a, [x, y, z])),
        (GradientEstimator::Regression, Some(regression)) => Some(regression.at_voxel(a, [x, y, z])),
        _ => None,
    })
}
