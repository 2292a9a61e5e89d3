//! Values and derivatives at positions. The ray loop is compiled for the types of this file.

use super::kernel::{Bspline, Bspline5, BsplineSmooth, CatmullRom, Interpolant, Trilinear};
use super::place::CellPosition;
use super::{Field, GradientEstimator, KernelData, Second, gradient, hessian};
use crate::number::{Real, Sym3, Vec3};
use drypoint_scene::glam::DVec3;

/// Evaluates a field at positions in index space, inside the box of [SPACE-1]. Derivatives are world derivatives times
/// 2^−e, e = [`Field::scale_exponent`] ([SPACE-4]).
pub trait Sampler<R: Real>: Sync {
    /// The cell of a position and the fractions in it, the same for every kernel ([REC-1]).
    fn place(&self, p: Vec3<R>) -> CellPosition<R>;

    /// The value at a place, after slope and intercept.
    fn value_at(&self, at: CellPosition<R>) -> R;

    /// [`value`](Self::value) at several positions, which may be computed in any order and side by side.
    #[inline(always)]
    fn values(&self, position: impl Fn(usize) -> Vec3<R>, values: &mut [R]) {
        for (i, value) in values.iter_mut().enumerate() {
            *value = self.value(position(i));
        }
    }

    /// Number of values worth computing at once. Independent values hide latency, but some of them may not be needed.
    #[inline(always)]
    fn at_once(&self) -> usize {
        1
    }

    /// The gradient at a place by the field's estimator, in world space, times 2^−e.
    ///
    /// # Panics
    /// If the estimator is `regression` and the field was prepared for a lower rung than `Gradient`.
    fn gradient_at(&self, at: CellPosition<R>) -> Vec3<R>;

    /// The gradient at a voxel. It has the bits of [`gradient_at`](Self::gradient_at) except for the signs of zeros,
    /// and is faster for estimators that are defined on voxels.
    ///
    /// # Panics
    /// If the estimator is `regression` and the field was prepared for a lower rung than `Gradient`.
    #[inline]
    fn voxel_gradient(&self, voxel: [usize; 3]) -> Vec3<R> {
        self.gradient(Vec3::from_glam(DVec3::from_array(voxel.map(|i| i as f64))))
    }

    /// The Hessian at a place by the field's estimator, and the gradient of the field that the Hessian belongs to
    /// ([CUR-1]). Both are in world space, times 2^−e. The gradient comes first.
    ///
    /// # Panics
    /// If the field was prepared for a lower rung than `Hessian`.
    fn hessian_at(&self, at: CellPosition<R>) -> (Vec3<R>, Sym3<R>);

    /// Whether [`hessian_at`](Self::hessian_at) returns the gradient of [`gradient_at`](Self::gradient_at), bit for
    /// bit.
    #[inline(always)]
    fn has_one_gradient(&self) -> bool {
        false
    }

    /// The values at the corners of a cell, as pairs along x at (y, z) = (0, 0), (1, 0), (0, 1), (1, 1). Returns none
    /// unless the field in the cell is their trilinear interpolation.
    #[inline(always)]
    fn corners(&self, _cell: [usize; 3]) -> Option<[[R; 2]; 4]> {
        None
    }

    /// The cell of a position.
    #[inline(always)]
    fn cell(&self, p: Vec3<R>) -> [usize; 3] {
        self.place(p).cell
    }

    /// The value at a position. See [`value_at`](Self::value_at).
    #[inline(always)]
    fn value(&self, p: Vec3<R>) -> R {
        self.value_at(self.place(p))
    }

    /// The gradient at a position. See [`gradient_at`](Self::gradient_at).
    #[inline(always)]
    fn gradient(&self, p: Vec3<R>) -> Vec3<R> {
        self.gradient_at(self.place(p))
    }

    /// The Hessian at a position. See [`hessian_at`](Self::hessian_at).
    ///
    /// # Panics
    /// If the field was prepared for a lower rung than `Hessian`.
    #[inline(always)]
    fn hessian(&self, p: Vec3<R>) -> (Vec3<R>, Sym3<R>) {
        self.hessian_at(self.place(p))
    }
}

/// A field whose kernel is trilinear and that has no formula. Loops over samples are compiled separately for it. Eight
/// voxels are read so quickly that decisions and calls at each sample would take most of the time.
#[derive(Clone, Copy)]
pub struct TrilinearSampler<'f, 'v, R>(pub(super) &'f Field<'v, R>);

/// Runs an expression with a field's kernel bound to a name. The expression is compiled for each kernel.
macro_rules! with_kernel {
    ($field:expr, |$kernel:ident| $body:expr) => {
        match &$field.kernel {
            KernelData::Trilinear => {
                let $kernel = Trilinear;
                $body
            }
            KernelData::Bspline(coefficients) => {
                let $kernel = Bspline(coefficients);
                $body
            }
            KernelData::BsplineSmooth => {
                let $kernel = BsplineSmooth;
                $body
            }
            KernelData::Bspline5(coefficients) => {
                let $kernel = Bspline5(coefficients);
                $body
            }
            KernelData::CatmullRom => {
                let $kernel = CatmullRom;
                $body
            }
        }
    };
}
pub(super) use with_kernel;

impl<'v, R: Real> Field<'v, R> {
    /// The field's sampler.
    pub fn sampler(&self) -> AnySampler<'_, 'v, R> {
        if self.is_trilinear() { AnySampler::Trilinear(self.trilinear()) } else { AnySampler::Any(self) }
    }

    /// Whether values are the voxels' trilinear interpolation.
    #[inline(always)]
    fn is_trilinear(&self) -> bool {
        matches!(self.kernel, KernelData::Trilinear) && self.formula.is_none()
    }

    /// The sampler of a field that [`is_trilinear`](Self::is_trilinear).
    #[inline(always)]
    fn trilinear(&self) -> TrilinearSampler<'_, 'v, R> {
        TrilinearSampler(self)
    }

    /// The value at a voxel. It is the formula's value if there is a formula. If a `regression` gradient was prepared,
    /// it is d of the fit ([STIP-1]). Otherwise it is the voxel's own value.
    pub fn smoothed_value(&self, voxel: [usize; 3]) -> R {
        match &self.regression {
            _ if self.formula.is_some() => self.value(Vec3::from_glam(DVec3::from_array(voxel.map(|i| i as f64)))),
            Some(regression) => self.to_value(regression.value_at_voxel(&self.stencils, voxel)),
            None => R::from_f64(self.volume.value(voxel)),
        }
    }

    /// The gradient of the numbers along the index axes by an estimator that is the same for every kernel.
    #[inline(always)]
    pub(super) fn estimated_gradient(&self, at: CellPosition<R>) -> Vec3<R> {
        match (self.how.gradient, &self.regression) {
            (GradientEstimator::Sobel, _) => gradient::sobel::gradient(self, at),
            (GradientEstimator::Regression, Some(regression)) => regression.gradient(&self.stencils, at),
            (GradientEstimator::Regression, None) => {
                panic!("a field prepared without Rung::Gradient was asked for a gradient")
            }
            _ => gradient::central::gradient(self, at),
        }
    }

    /// Gradient and Hessian of the numbers along the index axes by an estimator that is the same for every kernel.
    #[inline(always)]
    pub(super) fn estimated_second(&self, at: CellPosition<R>) -> (Vec3<R>, Sym3<R>) {
        match &self.second {
            Second::Gaussian(coefficients) => Bspline(coefficients).second(self, at),
            Second::NotPrepared => panic!("a field prepared without Rung::Hessian was asked for a Hessian"),
            _ => (gradient::central::gradient(self, at), hessian::central::hessian(self, at)),
        }
    }

    /// The number at a place, before slope and intercept. It is compiled once for each number type.
    #[inline(never)]
    fn number(&self, at: CellPosition<R>) -> R {
        with_kernel!(self, |kernel| kernel.value(self, at))
    }

    /// The gradient of the numbers along the index axes.
    #[inline(always)]
    pub(super) fn index_gradient(&self, at: CellPosition<R>) -> Vec3<R> {
        match self.how.gradient {
            GradientEstimator::Analytic => self.analytic_gradient(at),
            _ => self.estimated_gradient(at),
        }
    }

    /// The kernel's own derivative. It is compiled once for each number type.
    #[inline(never)]
    fn analytic_gradient(&self, at: CellPosition<R>) -> Vec3<R> {
        with_kernel!(self, |kernel| kernel.gradient(self, at))
    }

    /// Gradient and Hessian of the numbers along the index axes. They are compiled once for each number type.
    #[inline(never)]
    pub(super) fn index_second(&self, at: CellPosition<R>) -> (Vec3<R>, Sym3<R>) {
        match self.second {
            Second::Analytic => with_kernel!(self, |kernel| kernel.second(self, at)),
            _ => self.estimated_second(at),
        }
    }

    /// ‖g‖² at every voxel of a row, times 4^−e: the squared length of [`Sampler::voxel_gradient`]. `rows` is working
    /// memory, and `squares` is as long as the row.
    ///
    /// # Panics
    /// See [`Sampler::voxel_gradient`].
    pub(crate) fn voxel_squares(&self, [y, z]: [usize; 2], rows: &mut Vec<R>, squares: &mut [R]) {
        // A formula is evaluated at each voxel.
        let has_voxels = self.formula.is_none();
        if has_voxels && self.integer_squares([y, z], squares) {
            return;
        }
        let square = |x| {
            let gradient = self.voxel_gradient([x, y, z]);
            gradient.dot(gradient)
        };
        if has_voxels && self.squares_inside([y, z], rows, squares) {
            let last = squares.len() - 1;
            (squares[0], squares[last]) = (square(0), square(last));
        } else {
            squares.iter_mut().enumerate().for_each(|(x, at)| *at = square(x));
        }
    }
}

impl<R: Real> Sampler<R> for TrilinearSampler<'_, '_, R> {
    #[inline(always)]
    fn place(&self, p: Vec3<R>) -> CellPosition<R> {
        self.0.cells.locate(p)
    }

    #[inline(always)]
    fn value_at(&self, at: CellPosition<R>) -> R {
        self.0.to_value(Trilinear.value(self.0, at))
    }

    #[inline(always)]
    fn at_once(&self) -> usize {
        Trilinear::AT_ONCE
    }

    #[inline(always)]
    fn values(&self, position: impl Fn(usize) -> Vec3<R>, values: &mut [R]) {
        let field = self.0;
        Trilinear::values(field, |i| field.cells.locate(position(i)), values);
        for value in values {
            *value = field.to_value(*value);
        }
    }

    #[inline(always)]
    fn gradient_at(&self, at: CellPosition<R>) -> Vec3<R> {
        let index = match self.0.how.gradient {
            GradientEstimator::Analytic => Trilinear.gradient(self.0, at),
            _ => self.0.estimated_gradient(at),
        };
        self.0.to_world.apply(index)
    }

    #[inline(always)]
    fn voxel_gradient(&self, voxel: [usize; 3]) -> Vec3<R> {
        self.0.voxel_gradient(voxel)
    }

    #[inline(always)]
    fn corners(&self, cell: [usize; 3]) -> Option<[[R; 2]; 4]> {
        let field = self.0;
        let mut corners = Trilinear::corners(field, cell);
        for c in corners.as_flattened_mut() {
            *c = field.to_value(*c);
        }
        Some(corners)
    }

    #[inline(always)]
    fn has_one_gradient(&self) -> bool {
        self.0.has_one_gradient()
    }

    #[inline(always)]
    fn hessian_at(&self, at: CellPosition<R>) -> (Vec3<R>, Sym3<R>) {
        self.0.hessian_at(at)
    }
}

/// A field decides on its kernel at every call. This is slower than a [`TrilinearSampler`], but one type serves all
/// kernels.
impl<R: Real> Sampler<R> for Field<'_, R> {
    #[inline(always)]
    fn place(&self, p: Vec3<R>) -> CellPosition<R> {
        self.cells.locate(p)
    }

    #[inline]
    fn value_at(&self, at: CellPosition<R>) -> R {
        match &self.formula {
            Some(exact) => R::from_f64(exact.value_at(at.to_f64())),
            None => self.to_value(self.number(at)),
        }
    }

    #[inline]
    fn at_once(&self) -> usize {
        if self.is_trilinear() { Trilinear::AT_ONCE } else { 1 }
    }

    #[inline]
    fn values(&self, position: impl Fn(usize) -> Vec3<R>, values: &mut [R]) {
        if self.is_trilinear() {
            return self.trilinear().values(position, values);
        }
        for (i, value) in values.iter_mut().enumerate() {
            *value = self.value(position(i));
        }
    }

    #[inline]
    fn gradient_at(&self, at: CellPosition<R>) -> Vec3<R> {
        match &self.formula {
            Some(exact) => Vec3::from_glam(exact.gradient_at(at.to_f64()).to_glam()),
            None => self.to_world.apply(self.index_gradient(at)),
        }
    }

    #[inline]
    fn voxel_gradient(&self, voxel: [usize; 3]) -> Vec3<R> {
        let [x, y, z] = voxel;
        let read = if self.formula.is_none() { gradient::at_voxel(self, x, y, z) } else { None };
        match read {
            Some(index) => self.to_world.apply(index),
            None => self.gradient(Vec3::from_glam(DVec3::from_array(voxel.map(|i| i as f64)))),
        }
    }

    #[inline]
    fn corners(&self, cell: [usize; 3]) -> Option<[[R; 2]; 4]> {
        if self.is_trilinear() { self.trilinear().corners(cell) } else { None }
    }

    #[inline(always)]
    fn has_one_gradient(&self) -> bool {
        self.has_one_gradient()
    }

    #[inline]
    fn hessian_at(&self, at: CellPosition<R>) -> (Vec3<R>, Sym3<R>) {
        if let Some(exact) = &self.formula {
            let (g, Sym3 { xx, xy, xz, yy, yz, zz }) = exact.hessian_at(at.to_f64());
            let [xx, xy, xz, yy, yz, zz] = [xx, xy, xz, yy, yz, zz].map(R::from_f64);
            return (Vec3::from_glam(g.to_glam()), Sym3 { xx, xy, xz, yy, yz, zz });
        }
        let (gradient, hessian) = self.index_second(at);
        (self.to_world.apply(gradient), self.to_world_hessian(hessian))
    }
}

/// The sampler of a field, with a type of its own for the trilinear kernel. [`with_sampler!`](crate::with_sampler)
/// unpacks it.
pub enum AnySampler<'f, 'v, R> {
    /// Trilinear.
    Trilinear(TrilinearSampler<'f, 'v, R>),
    /// Any kernel.
    Any(&'f Field<'v, R>),
}

/// Runs an expression with a reference to a field's sampler bound to a name. The expression is compiled twice: for the
/// trilinear kernel, and for a field that decides on its kernel at every call.
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
            $crate::field::AnySampler::Any($sampler) => $body,
        }
    };
}
