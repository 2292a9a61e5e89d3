//! The label of a sample ([STF-13]).

use super::{Here, Measure};
use crate::labels::Labels;
use crate::number::Real;
use crate::transfer::Coordinate;

/// The id of the sample's part, by the scene's lookup of labels.
pub struct Label<'a>(pub Labels<'a>);

impl<R: Real> Measure<R> for Label<'_> {
    fn at(&self, here: &Here<R>) -> Coordinate<R> {
        Coordinate::Id(self.0.id_at(here.position))
    }
}
