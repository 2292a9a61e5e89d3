//! The five kernels of [REC-1], one file each; the two cubic B-splines share one.

pub(super) mod bspline;
pub(super) mod bspline5;
pub(super) mod catmull_rom;
pub(crate) mod trilinear;

pub use bspline::{Bspline, BsplineSmooth};
pub use bspline5::Bspline5;
pub use catmull_rom::CatmullRom;
pub use trilinear::Trilinear;
