//! Differences from an iso-value that neither overflow nor vanish when they are multiplied.

use drypoint_scene::math;
use drypoint_scene::volume::Volume;

/// A value of a volume.
#[derive(Clone, Copy, Debug)]
pub(super) struct Level {
    iso: f64,
    /// A power of two by which differences come out below 2.
    scale: f64,
}

impl Level {
    pub(super) fn new(volume: &Volume, iso: f64) -> Self {
        let exponent = math::exponent(volume.largest_magnitude().max(iso.abs())).clamp(-1000, 1000);
        Self { iso, scale: math::scale_by_power_of_two(1.0, -exponent) }
    }

    /// f − iso, scaled.
    #[inline(always)]
    pub(super) fn over(&self, value: f64) -> f64 {
        value * self.scale - self.iso * self.scale
    }
}
