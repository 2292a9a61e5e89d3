//! Values and derivatives at positions: the part of a field that the ray loop is compiled for.

use super::kernel::{Bspline, Bspline5, BsplineSmooth, CatmullRom, Trilinear};
use super::place::Place;
use super::{Field, GradientEstimator, Second, gradient, hessian};
use crate::number::{Real, Sym3, Vec3};
use crate::with_sampler;
use drypoint_scene::glam::DVec3;

/// A field at positions in index space, inside the box of [SPACE-1]. Derivatives are those of the world times 2^−e,
/// e = [`Field::scale_exponent`] ([SPACE-4]).
pub trait Sampler<R: Real>: Sync {
    /// The cell of a position and where in it, the same for every kernel ([REC-1]).
    fn place(&self, p: Vec3<R>) -> Place<R>;

    /// The value at a place, after slope and intercept.
    fn value_at(&self, at: Place<R>) -> R;

    /// [`value`](Self::value) at several positions, which may be computed in any order and side by side.
    #[inline(always)]
    fn values(&self, position: impl Fn(usize) -> Vec3<R>, values: &mut [R]) {
        for (i, value) in values.iter_mut().enumerate() {
            *value = self.value(position(i));
        }
    }

    /// Number of values worth computing at once: independent values hide latency, but those beyond the first ones
    /// wanted are computed in vain.
    const AT_ONCE: usize = 1;

    /// The gradient at a place by the field's estimator, in world space, times 2^−e.
    ///
    /// # Panics
    /// If the estimator is `regression` and the field was prepared for a lower rung than `Gradient`.
    fn gradient_at(&self, at: Place<R>) -> Vec3<R>;

    /// The gradient at a voxel: the bits of [`gradient_at`](Self::gradient_at) its place except for the signs of zeros.
    /// Faster for estimators that are defined on voxels.
    ///
    /// # Panics
    /// If the estimator is `regression` and the field was prepared for a lower rung than `Gradient`.
    #[inline]
    fn voxel_gradient(&self, voxel: [usize; 3]) -> Vec3<R> {
        self.gradient(Vec3::from_glam(DVec3::from_array(voxel.map(|i| i as f64))))
    }

    /// ‖g‖² at every voxel of a row, times 4^−e: the product of [`voxel_gradient`](Self::voxel_gradient) with itself.
    /// `rows` is working memory, and `squares` is as long as the row.
    ///
    /// # Panics
    /// See [`voxel_gradient`](Self::voxel_gradient).
    fn voxel_squares(&self, [y, z]: [usize; 2], _rows: &mut Vec<R>, squares: &mut [R]) {
        for (x, square) in squares.iter_mut().enumerate() {
            let gradient = self.voxel_gradient([x, y, z]);
            *square = gradient.dot(gradient);
        }
    }

    /// The Hessian at a place by the field's estimator, and the gradient of the field that it belongs to ([CUR-1]), in
    /// world space, times 2^−e.
    ///
    /// # Panics
    /// If the field was prepared for a lower rung than `Hessian`.
    fn hessian_at(&self, at: Place<R>) -> (Vec3<R>, Sym3<R>);

    /// Whether [`hessian_at`](Self::hessian_at) gives the gradient of [`gradient_at`](Self::gradient_at), bit for bit.
    #[inline(always)]
    fn has_one_gradient(&self) -> bool {
        false
    }

    /// The values at the corners of a cell, as pairs along x at (y, z) = (0, 0), (1, 0), (0, 1), (1, 1). None unless
    /// the field in the cell is their trilinear interpolation.
    #[inline(always)]
    fn corners(&self, _cell: [usize; 3]) -> Option<[[R; 2]; 4]> {
        None
    }

    /// The cell of a position.
    #[inline(always)]
    fn cell(&self, p: Vec3<R>) -> [usize; 3] {
        self.place(p).cell
    }

    /// [`value_at`](Self::value_at) the place of a position.
    #[inline(always)]
    fn value(&self, p: Vec3<R>) -> R {
        self.value_at(self.place(p))
    }

    /// [`gradient_at`](Self::gradient_at) the place of a position.
    #[inline(always)]
    fn gradient(&self, p: Vec3<R>) -> Vec3<R> {
        self.gradient_at(self.place(p))
    }

    /// [`hessian_at`](Self::hessian_at) the place of a position.
    ///
    /// # Panics
    /// If the field was prepared for a lower rung than `Hessian`.
    #[inline(always)]
    fn hessian(&self, p: Vec3<R>) -> (Vec3<R>, Sym3<R>) {
        self.hessian_at(self.place(p))
    }
}

/// A kernel: value and derivatives along the index axes, computed from the numbers that stencils read.
pub(super) trait Interpolant<R: Real>: Sync {
    /// The value.
    fn value(&self, field: &Field<'_, R>, at: Place<R>) -> R;

    /// [`Sampler::AT_ONCE`].
    const AT_ONCE: usize = 1;

    /// The values at several places.
    #[inline(always)]
    fn values(&self, field: &Field<'_, R>, place: impl Fn(usize) -> Place<R>, values: &mut [R]) {
        for (i, value) in values.iter_mut().enumerate() {
            *value = self.value(field, place(i));
        }
    }

    /// [`Sampler::corners`].
    #[inline(always)]
    fn corners(&self, _field: &Field<'_, R>, _cell: [usize; 3]) -> Option<[[R; 2]; 4]> {
        None
    }

    /// The derivative of the kernel: `analytic`.
    fn gradient(&self, field: &Field<'_, R>, at: Place<R>) -> Vec3<R>;

    /// First and second derivative of a kernel that is C²; for the others what `auto` takes, central differences.
    fn second(&self, field: &Field<'_, R>, at: Place<R>) -> (Vec3<R>, Sym3<R>) {
        (gradient::central::gradient(field, at), hessian::central::hessian(field, at))
    }
}

/// A field with the kernel that it is sampled with.
#[derive(Clone, Copy)]
pub struct Sampled<'f, 'v, R, K> {
    field: &'f Field<'v, R>,
    kernel: K,
}

impl<'f, 'v, R: Real, K> Sampled<'f, 'v, R, K> {
    pub(super) fn new(field: &'f Field<'v, R>, kernel: K) -> Self {
        Self { field, kernel }
    }
}

impl<R: Real> Field<'_, R> {
    /// The gradient of the numbers along the index axes by an estimator that is the same for every kernel.
    #[inline(always)]
    pub(super) fn estimated_gradient(&self, at: Place<R>) -> Vec3<R> {
        match (self.how.gradient, &self.regression) {
            (GradientEstimator::Sobel, _) => gradient::sobel::gradient(self, at),
            (GradientEstimator::Regression, Some(regression)) => regression.gradient(self, at),
            (GradientEstimator::Regression, None) => {
                panic!("a field prepared without Rung::Gradient was asked for a gradient")
            }
            _ => gradient::central::gradient(self, at),
        }
    }

    /// Gradient and Hessian of the numbers along the index axes by an estimator that is the same for every kernel.
    #[inline(always)]
    pub(super) fn estimated_second(&self, at: Place<R>) -> (Vec3<R>, Sym3<R>) {
        match &self.second {
            Second::Gaussian(coefficients) => coefficients.cubic_derivatives(at),
            Second::NotPrepared => panic!("a field prepared without Rung::Hessian was asked for a Hessian"),
            _ => (gradient::central::gradient(self, at), hessian::central::hessian(self, at)),
        }
    }
}

/// The number at a place, before slope and intercept.
#[inline(always)]
pub(super) fn number<R: Real, K: Interpolant<R>>(sampled: &Sampled<'_, '_, R, K>, at: Place<R>) -> R {
    sampled.kernel.value(sampled.field, at)
}

/// The gradient of the numbers along the index axes; by an estimator that is the same for every kernel, as `estimated` says.
#[inline(always)]
pub(super) fn index_gradient<'f, 'v, R: Real, K: Interpolant<R>>(
    sampled: &Sampled<'f, 'v, R, K>,
    at: Place<R>,
    estimated: impl Fn(&'f Field<'v, R>, Place<R>) -> Vec3<R>,
) -> Vec3<R> {
    match sampled.field.how.gradient {
        GradientEstimator::Analytic => sampled.kernel.gradient(sampled.field, at),
        _ => estimated(sampled.field, at),
    }
}

/// Gradient and Hessian of the numbers along the index axes, likewise.
#[inline(always)]
pub(super) fn index_second<'f, 'v, R: Real, K: Interpolant<R>>(
    sampled: &Sampled<'f, 'v, R, K>,
    at: Place<R>,
    estimated: impl Fn(&'f Field<'v, R>, Place<R>) -> (Vec3<R>, Sym3<R>),
) -> (Vec3<R>, Sym3<R>) {
    match sampled.field.second {
        Second::Analytic => sampled.kernel.second(sampled.field, at),
        _ => estimated(sampled.field, at),
    }
}

impl<R: Real, K: Interpolant<R>> Sampler<R> for Sampled<'_, '_, R, K> {
    #[inline(always)]
    fn place(&self, p: Vec3<R>) -> Place<R> {
        self.field.cells.locate(p)
    }

    #[inline(always)]
    fn value_at(&self, at: Place<R>) -> R {
        self.field.to_value(number(self, at))
    }

    const AT_ONCE: usize = K::AT_ONCE;

    #[inline(always)]
    fn values(&self, position: impl Fn(usize) -> Vec3<R>, values: &mut [R]) {
        self.kernel.values(self.field, |i| self.field.cells.locate(position(i)), values);
        for value in values {
            *value = self.field.to_value(*value);
        }
    }

    #[inline(always)]
    fn gradient_at(&self, at: Place<R>) -> Vec3<R> {
        self.field.to_world.apply(index_gradient(self, at, Field::estimated_gradient))
    }

    #[inline(always)]
    fn corners(&self, cell: [usize; 3]) -> Option<[[R; 2]; 4]> {
        let read = self.kernel.corners(self.field, cell)?;
        Some(read.map(|row| row.map(|c| self.field.to_value(c))))
    }

    #[inline]
    fn voxel_gradient(&self, voxel: [usize; 3]) -> Vec3<R> {
        let [x, y, z] = voxel;
        match gradient::at_voxel(self.field, x, y, z) {
            Some(index) => self.field.to_world.apply(index),
            None => self.gradient(Vec3::from_glam(DVec3::from_array(voxel.map(|i| i as f64)))),
        }
    }

    fn voxel_squares(&self, [y, z]: [usize; 2], rows: &mut Vec<R>, squares: &mut [R]) {
        if self.field.integer_squares([y, z], squares) {
            return;
        }
        let square = |x| {
            let gradient = self.voxel_gradient([x, y, z]);
            gradient.dot(gradient)
        };
        if self.field.squares_inside([y, z], rows, squares) {
            let last = squares.len() - 1;
            (squares[0], squares[last]) = (square(0), square(last));
        } else {
            squares.iter_mut().enumerate().for_each(|(x, at)| *at = square(x));
        }
    }

    #[inline(always)]
    fn has_one_gradient(&self) -> bool {
        self.field.has_one_gradient()
    }

    #[inline]
    fn hessian_at(&self, at: Place<R>) -> (Vec3<R>, Sym3<R>) {
        let (gradient, hessian) = index_second(self, at, Field::estimated_second);
        (self.field.to_world.apply(gradient), self.field.to_world_hessian(hessian))
    }
}

/// A field decides on its kernel at every call. That is slower than its [`Sampled`], and one type for fields of any kernel.
impl<R: Real> Sampler<R> for Field<'_, R> {
    #[inline]
    fn place(&self, p: Vec3<R>) -> Place<R> {
        self.cells.locate(p)
    }

    #[inline]
    fn value_at(&self, at: Place<R>) -> R {
        with_sampler!(self, |s| s.value_at(at))
    }

    #[inline]
    fn gradient_at(&self, at: Place<R>) -> Vec3<R> {
        with_sampler!(self, |s| s.gradient_at(at))
    }

    #[inline]
    fn hessian_at(&self, at: Place<R>) -> (Vec3<R>, Sym3<R>) {
        with_sampler!(self, |s| s.hessian_at(at))
    }

    #[inline]
    fn has_one_gradient(&self) -> bool {
        self.has_one_gradient()
    }
}

/// The sampler of one of the five kernels; [`with_sampler!`](crate::with_sampler) opens it.
pub enum AnySampler<'f, 'v, R> {
    /// Trilinear.
    Trilinear(Sampled<'f, 'v, R, Trilinear>),
    /// Cubic B-spline, prefiltered.
    Bspline(Sampled<'f, 'v, R, Bspline<'f, R>>),
    /// Cubic B-spline on the voxels.
    BsplineSmooth(Sampled<'f, 'v, R, BsplineSmooth>),
    /// Quintic B-spline, prefiltered.
    Bspline5(Sampled<'f, 'v, R, Bspline5<'f, R>>),
    /// Catmull–Rom.
    CatmullRom(Sampled<'f, 'v, R, CatmullRom>),
}

/// Runs an expression with a reference to a field's sampler bound to a name. The kernel is decided here, once, and the
/// expression is compiled for each kernel.
///
/// ```
/// use drypoint_reference::field::{Field, Reconstruction, Rung, Sampler};
/// use drypoint_reference::{number::Vec3, with_sampler};
/// use drypoint_scene::{space::Grid, volume::{Volume, Voxels}};
///
/// let grid = Grid::with_spacing([2; 3], [1.0; 3]).unwrap();
/// let volume = Volume::new(grid, Voxels::U8(vec![0, 8, 0, 8, 0, 8, 0, 8]), 1.0, 0.0).unwrap();
/// let field = Field::<f64>::new(&volume, Reconstruction::default(), Rung::Value).unwrap();
/// let sum: f64 = with_sampler!(field, |s| [0.25, 0.5].map(|x| s.value(Vec3::new(x, 0.5, 1.0))).iter().sum());
/// assert_eq!(sum, 6.0);
/// ```
#[macro_export]
macro_rules! with_sampler {
    ($field:expr, |$sampler:ident| $body:expr) => {
        match $field.sampler() {
            $crate::field::AnySampler::Trilinear(ref $sampler) => $body,
            $crate::field::AnySampler::Bspline(ref $sampler) => $body,
            $crate::field::AnySampler::BsplineSmooth(ref $sampler) => $body,
            $crate::field::AnySampler::Bspline5(ref $sampler) => $body,
            $crate::field::AnySampler::CatmullRom(ref $sampler) => $body,
        }
    };
}
