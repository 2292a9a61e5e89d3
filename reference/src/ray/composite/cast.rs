//! The result of a ray, from which pixels are made.

use super::layers::Sums;

/// The result of one ray.
pub(crate) struct Cast {
    /// Premultiplied colour and opacity in the blend space, without the background.
    pub(crate) rgba: [f64; 4],
    /// Sums for the other layers; none if there are no such layers or nothing was visible.
    pub(crate) sums: Option<Box<Sums>>,
    /// Samples evaluated.
    pub(crate) samples: u64,
    /// The largest intensities of the halos that layers show, in their order.
    pub(crate) intensities: Box<[f64]>,
}

impl Cast {
    /// The result of a ray without layers.
    pub(crate) fn of_samples(rgba: [f64; 4], samples: u64) -> Self {
        Self { rgba, sums: None, samples, intensities: Box::default() }
    }
}
