//! The part that a sample belongs to ([STF-13]).

use super::{Here, Measure};
use crate::number::{Real, Vec3};
use crate::transfer::Coordinate;

/// Something that knows the id of the part at a position in the data volume's index space.
pub trait IdAt: Send + Sync {
    /// The id there.
    fn id_at(&self, position: Vec3<f64>) -> u32;
}

/// The id of the part.
pub struct Label<'a>(pub &'a dyn IdAt);

impl<R: Real> Measure<R> for Label<'_> {
    fn at(&self, here: &Here<R>) -> Coordinate<R> {
        Coordinate::Id(self.0.id_at(Vec3::from_glam(here.position.to_glam())))
    }
}
