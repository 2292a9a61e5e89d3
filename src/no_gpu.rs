//! Graphics cards of a library without the feature `gpu`: there is none.

use crate::Failure;
use crate::job::Job;
use crate::stippling::PointTest;
use drypoint_reference::surface::IsoSurface;

/// A graphics card.
pub enum Gpu {}

/// The test of which points a surface hides.
pub(crate) fn point_test(_: &Job, gpu: &Gpu, _: &IsoSurface<'_, '_>, _: f64) -> Result<PointTest, Failure> {
    match *gpu {}
}
