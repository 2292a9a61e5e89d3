//! Numbers of shaders: f32 and f64, and their elementary functions.

use crate::Precision;
use crate::module::{Module, module};

/// Functions of every scene.
pub(crate) const NUMBER: Module = module!("arithmetic");
/// Transcendental functions.
pub(crate) const ELEMENTARY: Module = module!("math");
/// Bilinear interpolation.
pub(crate) const BILINEAR: Module = module!("bilinear");
/// sRGB.
pub(crate) const COLOR: Module = module!("color");

/// Numbers of a precision: `real = f32` or `real = f64`.
pub(crate) fn of(precision: Precision) -> Module {
    match precision {
        Precision::Single => module!("single"),
        Precision::Double => module!("double"),
    }
}
