//! Values and derivatives at positions: the part of a field that the ray loop is compiled for.

use super::place::Place;
use super::{Field, GradientEstimator, gradient};
use crate::number::{Real, Sym3, Vec3};

/// A field at positions in index space, inside the box of [SPACE-1]. Derivatives are those of the world times 2^−e,
/// e = [`Field::scale_exponent`] ([SPACE-4]).
pub trait Sampler<R: Real>: Sync {
    /// The cell of a position, the same for every kernel ([REC-1]).
    fn cell(&self, p: Vec3<R>) -> [usize; 3];

    /// The value, after slope and intercept.
    fn value(&self, p: Vec3<R>) -> R;

    /// The gradient by the field's estimator, in world space, times 2^−e.
    fn gradient(&self, p: Vec3<R>) -> Vec3<R>;

    /// The Hessian by the field's estimator and the gradient of the field that it belongs to ([CUR-1]), in world
    /// space, times 2^−e.
    ///
    /// # Panics
    /// If the field was prepared for a lower rung than `Hessian`.
    fn hessian(&self, p: Vec3<R>) -> (Vec3<R>, Sym3<R>);
}

/// What a kernel computes, along the index axes and from the numbers that stencils read.
pub trait Interpolant<R: Real>: Sync {
    /// The value.
    fn value(&self, field: &Field<'_, R>, at: Place<R>) -> R;

    /// The derivative of the kernel: `analytic`.
    fn gradient(&self, field: &Field<'_, R>, at: Place<R>) -> Vec3<R>;
}

/// A field with the kernel that it is sampled with.
#[derive(Clone, Copy)]
pub struct Sampled<'f, 'v, R, K> {
    field: &'f Field<'v, R>,
    kernel: K,
}

impl<'f, 'v, R: Real, K: Interpolant<R>> Sampled<'f, 'v, R, K> {
    pub(super) fn new(field: &'f Field<'v, R>, kernel: K) -> Self {
        Self { field, kernel }
    }
}

impl<R: Real, K: Interpolant<R>> Sampler<R> for Sampled<'_, '_, R, K> {
    #[inline(always)]
    fn cell(&self, p: Vec3<R>) -> [usize; 3] {
        self.field.cells.locate(p).cell
    }

    #[inline(always)]
    fn value(&self, p: Vec3<R>) -> R {
        let read = self.kernel.value(self.field, self.field.cells.locate(p));
        self.field.to_value(read)
    }

    #[inline(always)]
    fn gradient(&self, p: Vec3<R>) -> Vec3<R> {
        let at = self.field.cells.locate(p);
        let index = match self.field.how.gradient {
            GradientEstimator::Analytic => self.kernel.gradient(self.field, at),
            _ => gradient::central::gradient(self.field, at),
        };
        self.field.to_world_gradient(index)
    }

    fn hessian(&self, p: Vec3<R>) -> (Vec3<R>, Sym3<R>) {
        (self.gradient(p), Sym3::default())
    }
}

/// The sampler of one of the five kernels; [`with_sampler!`](crate::with_sampler) opens it.
pub enum AnySampler<'f, 'v, R> {
    /// Trilinear.
    Trilinear(Sampled<'f, 'v, R, super::kernel::Trilinear>),
}

/// Runs an expression with a reference to a field's sampler bound to a name: the kernel is decided here, once, and the
/// expression is compiled for each.
///
/// ```ignore
/// let sum = with_sampler!(field, |s| positions.iter().map(|&p| s.value(p)).sum());
/// ```
#[macro_export]
macro_rules! with_sampler {
    ($field:expr, |$sampler:ident| $body:expr) => {
        match $field.sampler() {
            $crate::field::AnySampler::Trilinear(ref $sampler) => $body,
        }
    };
}
