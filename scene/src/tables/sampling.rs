//! `[sampling]`: how the field is reconstructed and where it is sampled.

use crate::tables::Length;

/// The table `[sampling]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampling {
    /// Δ, the distance between sample planes ([RAY-1]).
    pub step: Length,
    /// Planes, or shells about the eye ([RAY-1]).
    pub step_along: StepAlong,
    /// Reconstruction of values ([REC-1]).
    pub kernel: Kernel,
    /// Gradient of shading ([REC-2]).
    pub gradient: GradientEstimator,
    /// Hessian of curvature ([REC-3]).
    pub hessian: HessianEstimator,
    /// σ of [`HessianEstimator::Gaussian`].
    pub scale: Length,
    /// Which of the two unit normals shades ([NORM-1]).
    pub normal: NormalSide,
    /// Number type of the samples ([PREC-1]).
    pub number: Number,
    /// Whether bricks that show nothing are left out ([RAY-2]).
    pub skip_empty: bool,
    /// ε: the transmittance below which a ray ends; 0 = never ([RAY-2]).
    pub stop_below: f64,
    /// Δ₀, the length that opacities are given for ([VAL-4]).
    pub reference_length: Length,
}

/// What the distance between samples is measured along.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepAlong {
    /// View-aligned planes.
    Plane,
    /// Each ray: shells about the eye.
    Ray,
}

/// Reconstruction kernels ([REC-1]).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kernel {
    /// Three nested interpolations; the papers'.
    Trilinear,
    /// Cubic B-spline, prefiltered: interpolates.
    Bspline,
    /// Cubic B-spline on the voxels themselves: smooths.
    BsplineSmooth,
    /// Quintic B-spline, prefiltered: interpolates.
    Bspline5,
    /// Catmull–Rom: interpolates, C¹.
    CatmullRom,
}

/// Gradient estimators ([REC-2]).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum GradientEstimator {
    /// Central differences on the voxels, then trilinear; the papers'.
    Central,
    /// The derivative of the kernel.
    Analytic,
    /// Sobel 3×3×3 on the voxels, then trilinear.
    Sobel,
    /// 4D linear regression on the voxels (Neumann et al. 2000), then trilinear.
    Regression,
}

/// Hessian estimators ([REC-3]).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum HessianEstimator {
    /// Gaussian for integer data, else analytic for B-splines and central for the others.
    Auto,
    /// The second derivative of a C² kernel.
    Analytic,
    /// Central differences of the central gradient, then trilinear.
    Central,
    /// Derivatives of the prefiltered cubic B-spline of the Gaussian-smoothed grid.
    Gaussian,
}

/// Which unit normal shades ([NORM-1]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NormalSide {
    /// Outwards.
    Outward,
    /// Outwards, flipped towards the eye.
    Facing,
    /// The papers' literal g/‖g‖.
    Gradient,
}

/// Number type of the samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Number {
    /// The truth.
    F64,
    /// For the price list.
    F32,
}

impl Default for Sampling {
    fn default() -> Self {
        Self {
            step: Length::Voxels(0.5),
            step_along: StepAlong::Plane,
            kernel: Kernel::Trilinear,
            gradient: GradientEstimator::Central,
            hessian: HessianEstimator::Auto,
            scale: Length::Voxels(1.0),
            normal: NormalSide::Outward,
            number: Number::F64,
            skip_empty: true,
            stop_below: 0.0,
            reference_length: Length::Voxels(1.0),
        }
    }
}
