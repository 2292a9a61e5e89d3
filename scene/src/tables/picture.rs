//! `[picture]`: what the picture is drawn on.

use crate::picture::LayerKind;
use std::path::PathBuf;

/// The table `[picture]`.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureSettings {
    /// Width and height in pixels.
    pub size: [usize; 2],
    /// Pixels per inch, which turns mm into px.
    pub dpi: f64,
    /// n of the n×n rays a pixel ([RAY-6]).
    pub samples: usize,
    /// What lies behind.
    pub background: Background,
    /// Light that is composited ([VAL-3]).
    pub blend_space: BlendSpace,
    /// Bits a channel of a PNG: 8 or 16.
    pub bits: u8,
    /// Layers of an EXR ([IO-6]).
    pub layers: Vec<LayerKind>,
}

/// What lies behind the volume.
#[derive(Clone, Debug, PartialEq)]
pub enum Background {
    /// Nothing: A is the coverage.
    None,
    /// A colour: linear, straight.
    Color([f64; 4]),
    /// A picture, stretched to the frame.
    Picture(PathBuf),
}

/// Which numbers are composited ([VAL-3]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BlendSpace {
    /// Linear light.
    Linear,
    /// sRGB-encoded values, as the papers' hardware did.
    Srgb,
}

impl Default for PictureSettings {
    fn default() -> Self {
        Self {
            size: [512, 512],
            dpi: 300.0,
            samples: 1,
            background: Background::Color([1.0; 4]),
            blend_space: BlendSpace::Linear,
            bits: 8,
            layers: vec![LayerKind::Beauty],
        }
    }
}
