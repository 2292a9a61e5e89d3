//! `[sampling]`: how the field is reconstructed and where it is sampled.

use crate::document::declare::{choices, table};
use crate::document::describe::Table;
use crate::document::fault::Problem;
use crate::document::kind::{Bounds, Flag, Number as AnyNumber, WORLD_LENGTH};
use crate::tables::Length;

table! {
    /// The table `[sampling]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Sampling {
        /// Δ, the distance between sample planes.
        step: Length = Length::Voxels(0.5), key("RAY-1", WORLD_LENGTH);
        /// Lines along which the step is measured.
        step_along: StepAlong = StepAlong::Plane, key("RAY-1", StepAlong::KIND);
        /// Reconstruction of values between voxels.
        kernel: Kernel = Kernel::Trilinear, key("REC-1", Kernel::KIND);
        /// Gradient of shading.
        gradient: GradientEstimator = GradientEstimator::Central, key("REC-2", GradientEstimator::KIND);
        /// Hessian of curvature.
        hessian: HessianEstimator = HessianEstimator::Auto, key("REC-3", HessianEstimator::KIND);
        /// σ of the Gaussian.
        scale: Length = Length::Voxels(1.0), key("REC-3", WORLD_LENGTH);
        /// Which of the two unit normals shades.
        normal: NormalSide = NormalSide::Outward, key("NORM-1", NormalSide::KIND);
        /// Number type of the samples.
        number: Number = Number::F64, key("PREC-1", Number::KIND);
        /// Whether bricks that show nothing are left out; changes no bit.
        skip_empty: bool = true, key("RAY-2", Flag);
        /// Transmittance below which a ray ends; 0: only where nothing more can show.
        stop_below: f64 = 0.0, key("RAY-2", AnyNumber { bounds: Bounds::BELOW_ONE, unit: "" });
        /// Δ₀, the length that opacities are given for.
        reference_length: Length = Length::Voxels(1.0), key("VAL-4", WORLD_LENGTH);
    }
}

choices! {
    /// Lines along which the distance between samples is measured.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
    pub enum StepAlong {
        /// View-aligned planes.
        Plane = "plane",
        /// Each ray: shells about the eye.
        Ray = "ray",
    }
}

choices! {
    /// Reconstruction kernels ([REC-1]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Deserialize)]
    pub enum Kernel {
        /// Three nested interpolations.
        Trilinear = "trilinear",
        /// Cubic B-spline, prefiltered: interpolates.
        Bspline = "bspline",
        /// Cubic B-spline: smooths.
        BsplineSmooth = "bspline-smooth",
        /// Quintic B-spline, prefiltered.
        Bspline5 = "bspline5",
        /// Interpolating cubic.
        CatmullRom = "catmull-rom",
    }
}

choices! {
    /// Gradient estimators ([REC-2]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Deserialize)]
    pub enum GradientEstimator {
        /// Central differences on the voxels, then trilinear.
        Central = "central",
        /// The derivative of the kernel.
        Analytic = "analytic",
        /// Sobel 3×3×3, then trilinear.
        Sobel = "sobel",
        /// 4D linear regression, then trilinear.
        Regression = "regression",
    }
}

choices! {
    /// Hessian estimators ([REC-3]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Deserialize)]
    pub enum HessianEstimator {
        /// gaussian for integer files, else analytic where the kernel allows it, else central.
        Auto = "auto",
        /// The second derivative of a B-spline kernel.
        Analytic = "analytic",
        /// Central differences of the central gradient.
        Central = "central",
        /// Derivatives of the grid smoothed by a Gaussian of width `scale`.
        Gaussian = "gaussian",
    }
}

choices! {
    /// Which unit normal shades ([NORM-1]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum NormalSide {
        /// Outwards, as volume.outside says.
        Outward = "outward",
        /// Outwards, flipped towards the eye.
        Facing = "facing",
        /// Along the gradient, as printed.
        Gradient = "gradient",
    }
}

choices! {
    /// Number type of the samples.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
    pub enum Number {
        /// The truth.
        F64 = "f64",
        /// To see what single precision loses.
        F32 = "f32",
    }
}

impl Kernel {
    /// Whether the kernel has second derivatives.
    pub(crate) fn is_twice_differentiable(self) -> bool {
        matches!(self, Self::Bspline | Self::BsplineSmooth | Self::Bspline5)
    }
}

/// The description of `[sampling]`.
pub(crate) static TABLE: Table<Sampling> = Table {
    check: |sampling, check| {
        if sampling.hessian == HessianEstimator::Analytic
            && !sampling.kernel.is_twice_differentiable()
            && check.sound(&["kernel", "hessian"])
        {
            check.fault_in(
                "hessian",
                Problem::Contradiction {
                    what: "sampling.hessian = \"analytic\" needs a kernel with second derivatives".into(),
                    remedy: "write kernel = \"bspline\", or hessian = \"central\" or \"gaussian\"".into(),
                },
            );
        }
    },
    ..Sampling::description("[sampling]", "How the field is reconstructed and where it is sampled.")
};
