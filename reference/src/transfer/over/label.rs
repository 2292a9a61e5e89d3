//! The part that a sample belongs to ([STF-13]).

use super::{Here, Measure};
use crate::labels::Labels;
use crate::number::Real;
use crate::transfer::Coordinate;

/// The id of the part, as the scene looks labels up.
pub struct Label<'a>(pub Labels<'a>);

impl<R: Real> Measure<R> for Label<'_> {
    fn at(&self, here: &Here<R>) -> Coordinate<R> {
        Coordinate::Id(self.0.id_at(here.position))
    }
}
