//! The five kernels of [REC-1], one file each; the two cubic B-splines share one.

pub(super) mod bspline;
pub(super) mod bspline5;
pub(super) mod catmull_rom;
pub(crate) mod trilinear;

pub use bspline::{Bspline, BsplineSmooth};
pub use bspline5::Bspline5;
pub use catmull_rom::CatmullRom;
pub use trilinear::Trilinear;

use super::gradient::central;
use super::place::CellPosition;
use super::{Field, hessian};
use crate::number::{Real, Sym3, Vec3};

/// A kernel: value and derivatives along the index axes, computed from the numbers that stencils read.
pub(super) trait Interpolant<R: Real>: Sync {
    /// The value.
    fn value(&self, field: &Field<'_, R>, at: CellPosition<R>) -> R;

    /// The derivative of the kernel, for the estimator `analytic`.
    fn gradient(&self, field: &Field<'_, R>, at: CellPosition<R>) -> Vec3<R>;

    /// Gradient and Hessian of a C² kernel. For the other kernels they are central differences, which `auto` takes.
    fn second(&self, field: &Field<'_, R>, at: CellPosition<R>) -> (Vec3<R>, Sym3<R>) {
        (central::gradient(field, at), hessian::central::hessian(field, at))
    }
}
