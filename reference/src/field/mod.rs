//! The field between voxels ([REC-1] … [REC-4], [CUR-1] … [CUR-3]).
//!
//! A [`Field`] holds what a reconstruction needs; its [`Sampler`] gives value, gradient and Hessian at positions in
//! index space. [`with_sampler!`](crate::with_sampler) chooses the sampler's type once, outside the loop over samples.

mod cell_ranges;
mod coefficients;
mod columns;
pub mod curvature;
mod error;
mod exact;
mod gradient;
mod gradient_range;
mod hessian;
mod interpolated;
pub mod kernel;
pub(crate) mod lanes;
mod measured;
pub mod normal;
mod place;
mod prefilter;
pub mod probe;
mod ranges;
mod sampler;
pub mod smoothed;
mod stencil;
mod tensor;
mod voxel_hessian;

#[cfg(test)]
mod tests;

pub(crate) use cell_ranges::CELLS;
pub(crate) use columns::Columns;
pub use drypoint_scene::shot::{GradientEstimator, HessianEstimator, Kernel, Outside, Reconstruction, Rung};
pub use error::FieldError;
pub(crate) use gradient_range::{quantile_of_norms, touches as touches_mask};
pub use place::CellPosition;
pub(crate) use place::Cells;
pub use sampler::{AnySampler, Sampler, TrilinearSampler};

use crate::number::{Mat3, Real, Sym3, Vec3};
use coefficients::Coefficients;
use drypoint_scene::glam::{DMat3, DVec3};
use drypoint_scene::math;
use drypoint_scene::phantom::Phantom;
use drypoint_scene::volume::{Bricks, Volume};
use exact::Exact;
use gradient::regression::Regression;
use std::collections::BTreeMap;
use std::sync::Arc;
use stencil::Stencils;

/// A volume with a reconstruction, from which samples are evaluated. Clones share the prepared data.
#[derive(Clone, Debug)]
pub struct Field<'v, R> {
    volume: &'v Volume,
    how: Reconstruction,
    stencils: Stencils<'v>,
    cells: Cells<R>,
    /// value = slope · number read + intercept.
    slope: R,
    intercept: R,
    /// D⁻ᵀ with 0 for axes of length 1, times `derivative`. It converts derivatives of the numbers read along the index
    /// axes to world derivatives of the value, times 2^−e.
    to_world: Mat3<R>,
    /// D⁻ᵀ with 0 for axes of length 1.
    inverse_transpose: Mat3<R>,
    derivative: R,
    /// e of [SPACE-4].
    exponent: i32,
    no_normal_below: R,
    kernel: KernelData<R>,
    /// Present only for the `regression` gradient.
    regression: Option<Regression<R>>,
    second: Second<R>,
    /// The formula that replaces the voxels ([COST-2]), if there is one.
    formula: Option<Exact<'v>>,
}

/// The kernel with its data.
#[derive(Clone, Debug)]
enum KernelData<R> {
    Trilinear,
    Bspline(Arc<Coefficients<R>>),
    BsplineSmooth,
    Bspline5(Arc<Coefficients<R>>),
    CatmullRom,
}

/// The estimator of the Hessian with its data.
#[derive(Clone, Debug)]
enum Second<R> {
    NotPrepared,
    Analytic,
    Central,
    Gaussian(Arc<Coefficients<R>>),
}

impl<'v, R: Real> Field<'v, R> {
    /// Prepares a volume for a reconstruction, up to the derivatives of a rung.
    ///
    /// # Errors
    /// Returns any error of [`FieldError`], whatever the rung.
    pub fn new(volume: &'v Volume, how: Reconstruction, rung: Rung) -> Result<Self, FieldError> {
        let is_integer = volume.is_integer();
        let how = Reconstruction { hessian: how.hessian.resolved(how.kernel, is_integer)?, ..how };
        let grid = volume.grid();
        let stencils = Stencils::new::<R>(volume);

        // 2^e brings max|value| / voxel into [½, 1). Mantissas and exponents are divided apart, because the quotient
        // may overflow.
        let (largest, voxel) = (volume.largest_magnitude(), grid.smallest_singular_value());
        let (a, b) = (math::exponent(largest), math::exponent(voxel));
        let quotient = math::scale_by_power_of_two(largest, -a) / math::scale_by_power_of_two(voxel, -b);
        let c = math::exponent(quotient);
        let exponent = a - b + c;
        let no_normal_below = R::from_f64(math::scale_by_power_of_two(quotient, -c)) * R::NO_NORMAL;

        // Numbers are read times a power of two, which the slope cancels.
        let read = math::exponent(stencils.scale()) - 1;
        let derivative = math::scale_by_power_of_two(volume.slope(), -read - exponent);
        let slope = R::from_f64(math::scale_by_power_of_two(volume.slope(), -read));
        let fits = |x: R| x.to_f64().is_finite();
        if !(fits(R::from_f64(largest)) && fits(slope) && fits(R::from_f64(volume.intercept()))) {
            return Err(FieldError::TooLarge { largest });
        }
        let live = DVec3::from_array(grid.dims().map(|n| if n == 1 { 0.0 } else { 1.0 }));
        let inverse_transpose = grid.inverse_axes().transpose() * DMat3::from_diagonal(live);

        let gaussian = how.hessian == HessianEstimator::Gaussian;
        let smoothed = if gaussian { hessian::gaussian::taps(grid, how.scale)? } else { Default::default() };
        Ok(Self {
            volume,
            how,
            stencils,
            cells: Cells::new(volume.dims()),
            slope,
            intercept: R::from_f64(volume.intercept()),
            to_world: Mat3::from_glam(inverse_transpose * derivative),
            inverse_transpose: Mat3::from_glam(inverse_transpose),
            derivative: R::from_f64(derivative),
            exponent,
            no_normal_below,
            kernel: match how.kernel {
                Kernel::Trilinear => KernelData::Trilinear,
                Kernel::Bspline => KernelData::Bspline(Arc::new(Coefficients::of_voxels(&stencils, 1).prefilter())),
                Kernel::BsplineSmooth => KernelData::BsplineSmooth,
                Kernel::Bspline5 => KernelData::Bspline5(Arc::new(Coefficients::of_voxels(&stencils, 2).prefilter())),
                Kernel::CatmullRom => KernelData::CatmullRom,
            },
            regression: (how.gradient == GradientEstimator::Regression && rung >= Rung::Gradient)
                .then(|| Regression::new(grid)),
            second: match how.hessian {
                _ if rung < Rung::Hessian => Second::NotPrepared,
                HessianEstimator::Gaussian => {
                    Second::Gaussian(Arc::new(hessian::gaussian::smoothed(&stencils, &smoothed)))
                }
                HessianEstimator::Analytic => Second::Analytic,
                HessianEstimator::Auto | HessianEstimator::Central => Second::Central,
            },
            formula: None,
        })
    }

    /// The estimator of Hessians. It is never `auto` ([REC-3]).
    pub fn hessian_estimator(&self) -> HessianEstimator {
        self.how.hessian
    }

    /// The volume that the field reconstructs.
    pub fn volume(&self) -> &'v Volume {
        self.volume
    }

    /// The reconstruction, with the Hessian's estimator as [`hessian_estimator`](Self::hessian_estimator) gives it.
    pub fn reconstruction(&self) -> Reconstruction {
        self.how
    }

    /// Ranges that contain every sample of the field, one range for each brick of cells ([RAY-2]).
    pub fn bricks(&self) -> Bricks {
        Bricks::new(self.volume.dims(), &|row| {
            let read = match &self.kernel {
                KernelData::Trilinear => ranges::corners(&self.stencils, row),
                KernelData::BsplineSmooth => ranges::supports::<R>(&self.stencils, row),
                KernelData::CatmullRom => {
                    ranges::supports::<R>(&self.stencils, row).into_iter().map(ranges::overshot).collect()
                }
                KernelData::Bspline(c) | KernelData::Bspline5(c) => {
                    row.cells().map(|[first, end]| c.range(first, end)).collect()
                }
            };
            // Bounds are rounded like the values of samples, which keeps the order.
            let rounded = |range| ranges::widened::<R>(range).map(|v| self.to_value(R::from_f64(v)).to_f64());
            read.into_iter().map(rounded).map(|[a, b]| [a.min(b), a.max(b)]).collect()
        })
    }

    /// Bytes of the field's data beside the volume, by name.
    pub fn bytes(&self) -> BTreeMap<String, u64> {
        let mut bytes = BTreeMap::new();
        if let KernelData::Bspline(c) | KernelData::Bspline5(c) = &self.kernel {
            bytes.insert("coefficients".to_owned(), c.bytes());
        }
        if let Some(regression) = &self.regression {
            bytes.insert("regression".to_owned(), regression.bytes());
        }
        if let Second::Gaussian(c) = &self.second {
            bytes.insert("smoothed".to_owned(), c.bytes());
        }
        bytes
    }

    /// e of [SPACE-4]. Samplers return world gradients and Hessians times 2^−e.
    pub fn scale_exponent(&self) -> i32 {
        self.exponent
    }

    /// The bound of [PREC-3] for gradients as samplers return them, times 2^−e. A gradient of at most this length has
    /// no normal.
    pub fn no_normal_below(&self) -> R {
        self.no_normal_below
    }

    /// Replaces the voxels by the formula of a phantom and its derivatives. Reconstructions converge to this field
    /// ([COST-2]). Ranges of bricks remain those of the voxels.
    pub fn with_formula(self, phantom: &'v dyn Phantom) -> Self {
        let exact = Exact::new(phantom, self.volume.grid(), self.exponent);
        Self { formula: Some(exact), ..self }
    }

    /// Whether samplers give gradients. Only a field with `regression`, prepared for values alone, has none.
    pub(crate) fn has_gradient(&self) -> bool {
        self.how.gradient != GradientEstimator::Regression || self.regression.is_some()
    }

    /// See [`Sampler::has_one_gradient`].
    #[inline(always)]
    pub(crate) fn has_one_gradient(&self) -> bool {
        self.how.gradient == GradientEstimator::Analytic && matches!(self.second, Second::Analytic)
    }

    /// The cell of a position in index space, inside the box of [SPACE-1]. It is the same for every kernel.
    #[inline]
    pub(crate) fn cell_of(&self, index: Vec3<R>) -> [usize; 3] {
        self.cells.locate(index).cell
    }

    #[inline(always)]
    fn to_value(&self, read: R) -> R {
        self.slope * read + self.intercept
    }

    /// D⁻ᵀ H D⁻¹ in the value's units, times 2^−e. H is scaled first, so that nothing overflows.
    fn to_world_hessian(&self, index: Sym3<R>) -> Sym3<R> {
        self.inverse_transpose.congruence(index.scaled(self.derivative))
    }
}
