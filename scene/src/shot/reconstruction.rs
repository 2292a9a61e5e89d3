//! How a field is reconstructed from voxels ([REC-1] … [REC-3]), with nothing left to the volume.

use super::{GradientEstimator, HessianEstimator, Kernel, Outside, ShotError, in_world};
use crate::plan::{Plan, Quantity};
use crate::space::Grid;
use crate::tables::{Sampling, Scene};
use serde::{Deserialize, Serialize};

/// How the field is reconstructed. The default is the papers': trilinear, central differences.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
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

impl Reconstruction {
    /// Returns the reconstruction of a scene. A Hessian that is left to the volume stays so.
    ///
    /// # Errors
    /// A length on the page.
    pub fn of(scene: &Scene, grid: &Grid) -> Result<Self, ShotError> {
        let &Sampling { kernel, gradient, hessian, scale, .. } = &scene.sampling;
        let scale = in_world(scale, "sampling.scale", grid)?;
        Ok(Self { kernel, gradient, hessian, scale, outside: scene.volume.outside })
    }
}

impl Default for Reconstruction {
    fn default() -> Self {
        Self {
            kernel: Kernel::Trilinear,
            gradient: GradientEstimator::Central,
            hessian: HessianEstimator::Auto,
            scale: 1.0,
            outside: Outside::Low,
        }
    }
}

/// The highest derivative that will be asked of a field. The others are not allocated ([PLAN-1]).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Rung {
    /// Values.
    Value,
    /// Values and gradients.
    Gradient,
    /// Values, gradients and Hessians.
    Hessian,
}

impl Rung {
    /// The rung that the effects of a plan ask for.
    pub fn of(plan: &Plan) -> Self {
        if plan.needs_anywhere(Quantity::Hessian) {
            Self::Hessian
        } else if plan.reads_gradients() {
            Self::Gradient
        } else {
            Self::Value
        }
    }
}

/// An analytic Hessian of a kernel that has no second derivatives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("hessian = \"analytic\" needs a kernel that is twice differentiable: \"{kernel}\" is not, \"bspline\" is")]
pub struct NotSmooth {
    /// The kernel's name in a scene.
    pub kernel: &'static str,
}

impl HessianEstimator {
    /// The estimator with `auto` decided ([REC-3]): Gaussian for files of integers, else analytic for kernels that have second
    /// derivatives and central for those that have none.
    ///
    /// # Errors
    /// `analytic` with a kernel that has no second derivatives.
    pub fn resolved(self, kernel: Kernel, is_integer: bool) -> Result<Self, NotSmooth> {
        let rough = match kernel {
            Kernel::Trilinear => Some("trilinear"),
            Kernel::CatmullRom => Some("catmull-rom"),
            Kernel::Bspline | Kernel::BsplineSmooth | Kernel::Bspline5 => None,
        };
        match (self, rough) {
            (Self::Auto, _) if is_integer => Ok(Self::Gaussian),
            (Self::Auto, Some(_)) => Ok(Self::Central),
            (Self::Auto, None) => Ok(Self::Analytic),
            (Self::Analytic, Some(kernel)) => Err(NotSmooth { kernel }),
            (named, _) => Ok(named),
        }
    }
}
