//! The data from which a shader is composed.

use crate::GpuError;
use drypoint_scene::inputs::{Inputs, ObjectData};
use drypoint_scene::measured::Measured;

/// The data that a shot names, with their measured facts and the indices of uploaded volumes.
#[derive(Clone, Copy, Debug)]
pub struct CardInputs<'a> {
    /// The data.
    pub data: &'a Inputs<'a>,
    /// The facts of each of [`Shot::objects`](drypoint_scene::shot::Shot::objects), in their order.
    pub measured: &'a [Measured],
    /// For each object, the index of its volume among the uploaded ones.
    pub places: &'a [usize],
    /// Whether frames can have lines inside the volume ([HATCH-14] d).
    pub has_lines: bool,
}

/// The data of one object of a shot.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ObjectInputs<'a> {
    /// The data.
    pub(crate) data: ObjectData<'a>,
    /// The facts of its volume.
    pub(crate) measured: &'a Measured,
    /// Index of its volume among the uploaded ones.
    pub(crate) place: usize,
}

impl<'a> CardInputs<'a> {
    /// The data of one of the shot's objects.
    ///
    /// # Errors
    /// The data were not handed over.
    pub(crate) fn object(&self, which: usize) -> Result<ObjectInputs<'a>, GpuError> {
        let data = match which.checked_sub(1) {
            None => Some(&self.data.main),
            Some(part) => self.data.parts.get(part),
        };
        match (data, self.measured.get(which), self.places.get(which)) {
            (Some(&data), Some(measured), Some(&place)) => Ok(ObjectInputs { data, measured, place }),
            _ => Err(GpuError::Material),
        }
    }
}
