//! The data that a shader is put together from.

use crate::GpuError;
use drypoint_scene::inputs::{Inputs, ObjectData};
use drypoint_scene::measured::Measured;

/// The data that a shot names, with what was measured of them and uploaded.
#[derive(Clone, Copy, Debug)]
pub struct CardInputs<'a> {
    /// The data.
    pub data: &'a Inputs<'a>,
    /// The facts of each of [`Shot::objects`](drypoint_scene::shot::Shot::objects), in their order.
    pub measured: &'a [Measured],
    /// For each of these the place of its volume among those that are uploaded.
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
    /// The place of its volume among those that are uploaded.
    pub(crate) place: usize,
}

impl<'a> CardInputs<'a> {
    /// The data of one of the shot's objects.
    ///
    /// # Errors
    /// Data that were not handed over.
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
