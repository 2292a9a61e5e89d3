//! Graphics cards without the feature `gpu`: there are none.

use crate::Failure;
use crate::job::Job;
use crate::stippling::PointTest;
use drypoint_reference::surface::IsoSurface;

/// A graphics card.
pub enum Gpu {}

/// The test for points that a surface hides.
pub(crate) fn point_test(_: &Job, gpu: &Gpu, _: &IsoSurface<'_, '_>, _: f64) -> Result<PointTest, Failure> {
    match *gpu {}
}
