//! The field between voxels ([REC-1] … [REC-4], [CUR-1] … [CUR-3]).
//!
//! A [`Field`] holds what a reconstruction needs; its [`Sampler`] gives value, gradient and Hessian at positions in
//! index space. [`with_sampler!`](crate::with_sampler) chooses the sampler's type once, outside the loop over samples.

mod error;
mod gradient;
mod kernel;
pub mod normal;
mod place;
mod ranges;
mod sampler;
mod stencil;

pub use drypoint_scene::tables::{GradientEstimator, HessianEstimator, Kernel, Outside};
pub use error::FieldError;
pub use place::Place;
pub use sampler::{AnySampler, Interpolant, Sampled, Sampler};

use crate::number::{Mat3, Real, Vec3};
use drypoint_scene::math;
use drypoint_scene::volume::{Bricks, Volume};
use place::Cells;
use std::collections::BTreeMap;
use stencil::Stencils;

/// How the field is reconstructed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reconstruction {
    /// Kernel of the values ([REC-1]).
    pub kernel: Kernel,
    /// Estimator of the gradient ([REC-2]).
    pub gradient: GradientEstimator,
    /// Estimator of the Hessian ([REC-3]).
    pub hessian: HessianEstimator,
    /// σ of the `gaussian` Hessian, in world units.
    pub scale: f64,
    /// Which values lie outside ([NORM-1]).
    pub outside: Outside,
}

/// What will be asked of a field. What is not asked for is not allocated ([PLAN-1]).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rung {
    /// Values.
    Value,
    /// Values and gradients.
    Gradient,
    /// Values, gradients and Hessians.
    Hessian,
}

/// A volume with a reconstruction: what the samples read.
pub struct Field<'v, R> {
    volume: &'v Volume,
    how: Reconstruction,
    stencils: Stencils<'v>,
    cells: Cells<R>,
    /// value = slope · number read + intercept.
    slope: R,
    intercept: R,
    /// From derivatives along the index axes of the numbers read to world derivatives of the value times 2^−e.
    to_world: Mat3<R>,
    /// e of [SPACE-4].
    exponent: i32,
    no_normal_below: R,
}

impl<'v, R: Real> Field<'v, R> {
    /// Prepares a volume for a reconstruction.
    ///
    /// # Errors
    /// An estimator that the kernel does not have, or a scale that is no length.
    pub fn new(volume: &'v Volume, how: Reconstruction, rung: Rung) -> Result<Self, FieldError> {
        let stencils = Stencils::new::<R>(volume);
        // 2^e brings max|value| / voxel into [½, 1). Mantissas and exponents apart: the quotient may overflow.
        let (largest, voxel) = (volume.largest_magnitude(), volume.grid().smallest_singular_value());
        let (a, b) = (math::exponent(largest), math::exponent(voxel));
        let mantissa = math::scale_by_power_of_two(largest, -a) / math::scale_by_power_of_two(voxel, -b);
        let c = math::exponent(mantissa);
        let exponent = a - b + c;
        let bound = R::NO_NORMAL.to_f64() * math::scale_by_power_of_two(mantissa, -c);

        let read = math::exponent(stencils.scale()) - 1;
        let derivative = math::scale_by_power_of_two(volume.slope(), -read - exponent);
        let _ = rung;
        Ok(Self {
            volume,
            how,
            stencils,
            cells: Cells::new(volume.dims()),
            slope: R::from_f64(math::scale_by_power_of_two(volume.slope(), -read)),
            intercept: R::from_f64(volume.intercept()),
            to_world: Mat3::from_glam(volume.grid().inverse_axes().transpose() * derivative),
            exponent,
            no_normal_below: R::from_f64(bound),
        })
    }

    /// The estimator that Hessians come from: never `auto` ([REC-3]).
    pub fn hessian_estimator(&self) -> HessianEstimator {
        self.how.hessian
    }

    /// The volume that the field reconstructs.
    pub fn volume(&self) -> &'v Volume {
        self.volume
    }

    /// How it does.
    pub fn reconstruction(&self) -> Reconstruction {
        self.how
    }

    /// For each brick of cells a range of values that no sample in it leaves ([RAY-2]).
    pub fn bricks(&self) -> Bricks {
        Bricks::new(self.volume.dims(), |first, end| {
            let stored = ranges::voxels_of_cells(self.volume, first, end).map(|v| v * self.stencils.scale());
            let [a, b] = ranges::widened::<R>(stored).map(|v| self.to_value(R::from_f64(v)).to_f64());
            ranges::widened::<R>([a.min(b), a.max(b)])
        })
    }

    /// Bytes of what the field holds beside the volume, by name.
    pub fn bytes(&self) -> BTreeMap<String, u64> {
        BTreeMap::new()
    }

    /// e of [SPACE-4]: gradients and Hessians are those of the world times 2^−e.
    pub fn scale_exponent(&self) -> i32 {
        self.exponent
    }

    /// The bound of [PREC-3] for gradients as the samplers give them, times 2^−e: at or below it there is no normal.
    pub fn no_normal_below(&self) -> R {
        self.no_normal_below
    }

    /// The sampler of the field's kernel.
    pub fn sampler(&self) -> AnySampler<'_, 'v, R> {
        AnySampler::Trilinear(Sampled::new(self, kernel::Trilinear))
    }

    #[inline(always)]
    fn to_value(&self, read: R) -> R {
        self.slope * read + self.intercept
    }

    #[inline(always)]
    fn to_world_gradient(&self, index: Vec3<R>) -> Vec3<R> {
        self.to_world.mul(index)
    }
}
