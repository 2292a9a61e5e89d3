//! Numbers of shaders: f32 and f64, and their elementary functions.

use crate::shader::{Module, module};

/// `real = f32`.
pub(crate) const SINGLE: Module = module!("single");
/// `real = f64`.
pub(crate) const DOUBLE: Module = module!("double");
/// Functions of every scene.
pub(crate) const NUMBER: Module = module!("number");
/// Transcendental functions.
pub(crate) const ELEMENTARY: Module = module!("elementary");
/// Bilinear interpolation.
pub(crate) const BILINEAR: Module = module!("bilinear");
/// sRGB.
pub(crate) const COLOR: Module = module!("color");
