//! The five kernels of [REC-1], one file each.

pub(super) mod trilinear;

pub use trilinear::Trilinear;
