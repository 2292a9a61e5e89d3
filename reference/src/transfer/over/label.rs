//! The label of a sample ([STF-13]).

use super::{AxisMeasure, SampleQuantities};
use crate::labels::Labels;
use crate::number::Real;
use crate::transfer::Coordinate;

/// The id of the sample's part, by the scene's lookup of labels.
pub struct SampleLabel<'a>(pub Labels<'a>);

impl<R: Real> AxisMeasure<R> for SampleLabel<'_> {
    fn at(&self, here: &SampleQuantities<R>) -> Coordinate<R> {
        Coordinate::Id(self.0.id_at(here.position))
    }
}
