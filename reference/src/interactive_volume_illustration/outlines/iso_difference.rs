//! Scaled differences from an iso-value, whose products neither overflow nor underflow.

use drypoint_scene::math;
use drypoint_scene::volume::Volume;

/// An iso-value with a scale for differences from it.
#[derive(Clone, Copy, Debug)]
pub(super) struct IsoDifference {
    iso: f64,
    /// A power of two that brings all differences below 2.
    scale: f64,
}

impl IsoDifference {
    pub(super) fn new(volume: &Volume, iso: f64) -> Self {
        let exponent = math::exponent(volume.largest_magnitude().max(iso.abs())).clamp(-1000, 1000);
        Self { iso, scale: math::scale_by_power_of_two(1.0, -exponent) }
    }

    /// f − iso, times the scale.
    #[inline(always)]
    pub(super) fn over(&self, value: f64) -> f64 {
        value * self.scale - self.iso * self.scale
    }
}
