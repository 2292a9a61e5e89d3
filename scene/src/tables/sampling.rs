//! `[sampling]`: how the field is reconstructed and where it is sampled.

use crate::document::describe::{Key, Slot, Table};
use crate::document::fault::Problem;
use crate::document::kind::{Bounds, Choice, ChoiceOption, Flag, Number as AnyNumber, WORLD_LENGTH};
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
    /// ε: the transmittance below which a ray ends; 0: only where nothing more can show ([RAY-2]).
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
    ..Table::new(
        "[sampling]",
        "How the field is reconstructed and where it is sampled.",
        Sampling::default,
        &[
            Key::new(
                "step",
                "RAY-1",
                "Δ, the distance between sample planes.",
                &Slot { kind: WORLD_LENGTH, get: |s: &Sampling| Some(s.step), set: |s, v| s.step = v },
            ),
            Key::new(
                "step_along",
                "RAY-1",
                "What the step is measured along.",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new("plane", StepAlong::Plane, "View-aligned planes."),
                            ChoiceOption::new("ray", StepAlong::Ray, "Each ray: shells about the eye."),
                        ],
                        later: &[],
                    },
                    get: |s: &Sampling| Some(s.step_along),
                    set: |s, v| s.step_along = v,
                },
            ),
            Key::new(
                "kernel",
                "REC-1",
                "Reconstruction of values between voxels.",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new("trilinear", Kernel::Trilinear, "Three nested interpolations."),
                            ChoiceOption::new("bspline", Kernel::Bspline, "Cubic B-spline, prefiltered: interpolates."),
                            ChoiceOption::new("bspline-smooth", Kernel::BsplineSmooth, "Cubic B-spline: smooths."),
                            ChoiceOption::new("bspline5", Kernel::Bspline5, "Quintic B-spline, prefiltered."),
                            ChoiceOption::new("catmull-rom", Kernel::CatmullRom, "Interpolating cubic."),
                        ],
                        later: &[],
                    },
                    get: |s: &Sampling| Some(s.kernel),
                    set: |s, v| s.kernel = v,
                },
            ),
            Key::new(
                "gradient",
                "REC-2",
                "Gradient of shading.",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new(
                                "central",
                                GradientEstimator::Central,
                                "Central differences on the voxels, then trilinear.",
                            ),
                            ChoiceOption::new("analytic", GradientEstimator::Analytic, "The derivative of the kernel."),
                            ChoiceOption::new("sobel", GradientEstimator::Sobel, "Sobel 3×3×3, then trilinear."),
                            ChoiceOption::new(
                                "regression",
                                GradientEstimator::Regression,
                                "4D linear regression, then trilinear.",
                            ),
                        ],
                        later: &[],
                    },
                    get: |s: &Sampling| Some(s.gradient),
                    set: |s, v| s.gradient = v,
                },
            ),
            Key::new(
                "hessian",
                "REC-3",
                "Hessian of curvature.",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new(
                                "auto",
                                HessianEstimator::Auto,
                                "gaussian for integer files, else analytic where the kernel allows it, else central.",
                            ),
                            ChoiceOption::new(
                                "analytic",
                                HessianEstimator::Analytic,
                                "The second derivative of a B-spline kernel.",
                            ),
                            ChoiceOption::new(
                                "central",
                                HessianEstimator::Central,
                                "Central differences of the central gradient.",
                            ),
                            ChoiceOption::new(
                                "gaussian",
                                HessianEstimator::Gaussian,
                                "Derivatives of the grid smoothed by a Gaussian of width `scale`.",
                            ),
                        ],
                        later: &[],
                    },
                    get: |s: &Sampling| Some(s.hessian),
                    set: |s, v| s.hessian = v,
                },
            ),
            Key::new(
                "scale",
                "REC-3",
                "σ of the Gaussian.",
                &Slot { kind: WORLD_LENGTH, get: |s: &Sampling| Some(s.scale), set: |s, v| s.scale = v },
            ),
            Key::new(
                "normal",
                "NORM-1",
                "Which of the two unit normals shades.",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new("outward", NormalSide::Outward, "Outwards, as volume.outside says."),
                            ChoiceOption::new("facing", NormalSide::Facing, "Outwards, flipped towards the eye."),
                            ChoiceOption::new("gradient", NormalSide::Gradient, "Along the gradient, as printed."),
                        ],
                        later: &[],
                    },
                    get: |s: &Sampling| Some(s.normal),
                    set: |s, v| s.normal = v,
                },
            ),
            Key::new(
                "number",
                "PREC-1",
                "Number type of the samples.",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new("f64", Number::F64, "The truth."),
                            ChoiceOption::new("f32", Number::F32, "To see what single precision loses."),
                        ],
                        later: &[],
                    },
                    get: |s: &Sampling| Some(s.number),
                    set: |s, v| s.number = v,
                },
            ),
            Key::new(
                "skip_empty",
                "RAY-2",
                "Whether bricks that show nothing are left out; changes no bit.",
                &Slot { kind: Flag, get: |s: &Sampling| Some(s.skip_empty), set: |s, v| s.skip_empty = v },
            ),
            Key::new(
                "stop_below",
                "RAY-2",
                "Transmittance below which a ray ends; 0: only where nothing more can show.",
                &Slot {
                    kind: AnyNumber { bounds: Bounds::BELOW_ONE, unit: "" },
                    get: |s: &Sampling| Some(s.stop_below),
                    set: |s, v| s.stop_below = v,
                },
            ),
            Key::new(
                "reference_length",
                "VAL-4",
                "Δ₀, the length that opacities are given for.",
                &Slot {
                    kind: WORLD_LENGTH,
                    get: |s: &Sampling| Some(s.reference_length),
                    set: |s, v| s.reference_length = v,
                },
            ),
        ],
    )
};
