//! A picture being painted.

use drypoint_scene::color::{Rgba, linear_to_srgb, premultiply, srgb_to_linear, unpremultiply};
use drypoint_scene::tables::BlendSpace;

/// Channels of a picture, linear and premultiplied before and after painting. While painting, touched pixels are in the
/// space of compositing ([VAL-3]).
pub(super) struct Canvas<'a> {
    channels: &'a mut [Vec<f64>],
    /// Encoded pixels, where compositing is in encoded colours. Untouched pixels keep their bits.
    encoded: Option<Vec<bool>>,
}

/// A straight colour in the space of compositing.
pub(super) struct BlendColor {
    color: [f64; 3],
    /// Opacity, from 0 to 1.
    pub(super) opacity: f64,
}

impl<'a> Canvas<'a> {
    /// Begins painting on four channels of equal length.
    pub(super) fn new(channels: &'a mut [Vec<f64>], blend: BlendSpace) -> Self {
        let pixels = channels[3].len();
        Self { channels, encoded: (blend == BlendSpace::Srgb).then(|| vec![false; pixels]) }
    }

    /// Returns a linear straight colour in the space of compositing.
    pub(super) fn ink(&self, [r, g, b, opacity]: Rgba) -> BlendColor {
        let color = if self.encoded.is_some() { [r, g, b].map(linear_to_srgb) } else { [r, g, b] };
        BlendColor { color, opacity }
    }

    /// Composites ink over a share of a pixel.
    pub(super) fn put(&mut self, pixel: usize, ink: &BlendColor, share: f64) {
        if let Some(encoded) = &mut self.encoded
            && !std::mem::replace(&mut encoded[pixel], true)
        {
            self.change(pixel, linear_to_srgb);
        }
        let a = share * ink.opacity;
        for (channel, c) in self.channels.iter_mut().zip(ink.color.into_iter().chain([1.0])) {
            channel[pixel] = c * a + channel[pixel] * (1.0 - a);
        }
    }

    /// Ends painting: encoded pixels become linear light.
    pub(super) fn finish(mut self) {
        for (pixel, _) in self.encoded.take().iter().flatten().enumerate().filter(|(_, encoded)| **encoded) {
            self.change(pixel, srgb_to_linear);
        }
    }

    /// Applies a function to the straight colour of a pixel.
    fn change(&mut self, pixel: usize, f: fn(f64) -> f64) {
        let [r, g, b, a] = unpremultiply([0, 1, 2, 3].map(|c| self.channels[c][pixel]));
        let changed = premultiply([f(r), f(g), f(b), a]);
        for (channel, value) in self.channels.iter_mut().zip(changed) {
            channel[pixel] = value;
        }
    }
}
