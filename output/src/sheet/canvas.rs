//! The picture on which others are laid.

use drypoint_scene::color::Rgba;
use drypoint_scene::picture::{Layer, LayerKind, Picture};

/// A linear premultiplied picture.
pub(super) struct Canvas {
    size: [usize; 2],
    channels: Vec<Vec<f64>>,
}

impl Canvas {
    /// A canvas of one linear straight colour.
    pub(super) fn new([width, height]: [usize; 2], [r, g, b, a]: Rgba) -> Self {
        Self { size: [width, height], channels: [r * a, g * a, b * a, a].map(|c| vec![c; width * height]).into() }
    }

    /// Composites premultiplied rows of `width` pixels, the first pixel at `corner`. Pixels beside the canvas are left out.
    pub(super) fn lay(&mut self, pixels: &[[f64; 4]], width: usize, [left, top]: [usize; 2]) {
        let [across, down] = self.size;
        for (y, row) in pixels.chunks_exact(width).enumerate().take(down.saturating_sub(top)) {
            let start = (top + y) * across + left;
            for (i, pixel) in (start..).zip(row).take(across.saturating_sub(left)) {
                for (channel, c) in self.channels.iter_mut().zip(pixel) {
                    channel[i] = c + (1.0 - pixel[3]) * channel[i];
                }
            }
        }
    }

    pub(super) fn into_picture(self) -> Picture {
        let [width, height] = self.size;
        Picture { width, height, layers: vec![Layer { kind: LayerKind::Beauty, channels: self.channels }] }
    }
}
