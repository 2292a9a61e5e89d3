//! `[sampling]`: how the field is reconstructed and where it is sampled.

use crate::file::describe::{Key, Slot, Table};
use crate::file::fault::Problem;
use crate::file::kind::{Bounds, Choice, ChoiceOption, Flag, Number as AnyNumber, WORLD_LENGTH};
use crate::knobs::Ladder;
use crate::plan::{Pass, Plan, Quantity};
use crate::tables::{Length, Projection, Scene};
use serde::Serialize;

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
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum StepAlong {
    /// View-aligned planes.
    Plane,
    /// Each ray: shells about the eye.
    Ray,
}

/// Reconstruction kernels ([REC-1]).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
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

/// Why what only rays read does nothing.
const NOT_DRAWN: &str = "the volume itself is not drawn";

/// Settings of `step`.
const STEPS: &[&str] =
    &["4 voxels", "2 voxels", "1 voxel", "0.5 voxels", "0.25 voxels", "0.125 voxels", "0.0625 voxels"];

/// Settings of `scale`.
const SCALES: &[&str] = &["4 voxels", "2 voxels", "1 voxel", "0.5 voxels"];

/// Whether a kernel has second derivatives.
fn is_twice_differentiable(kernel: Kernel) -> bool {
    matches!(kernel, Kernel::Bspline | Kernel::BsplineSmooth | Kernel::Bspline5)
}

/// Settings of what only rays read.
fn of_rays(plan: &Plan, settings: &'static [&'static str]) -> &'static [&'static str] {
    if plan.has_pass(Pass::Rays) { settings } else { &[] }
}

/// What reads the field between voxels: points and lines without a surface lie on the voxels alone.
const BETWEEN_VOXELS: [Pass; 4] = [Pass::Rays, Pass::HiddenPoints, Pass::Outlines, Pass::Strokes];

/// Settings of `kernel`: where the Hessian is the kernel's own, those that have one.
fn kernels(scene: &Scene, plan: &Plan) -> &'static [&'static str] {
    match scene.sampling.hessian {
        _ if !BETWEEN_VOXELS.iter().any(|pass| plan.has_pass(*pass)) => &[],
        HessianEstimator::Analytic => &["bspline-smooth", "bspline", "bspline5"],
        _ => &["bspline-smooth", "trilinear", "catmull-rom", "bspline", "bspline5"],
    }
}

/// Settings of `gradient`, where there is one. The derivative of the trilinear kernel is of order one, central
/// differences are of order two; those of the other kernels are closer than central differences.
fn gradients(scene: &Scene, plan: &Plan) -> &'static [&'static str] {
    match scene.sampling.kernel {
        _ if !plan.reads_gradients() => &[],
        Kernel::Trilinear => &["sobel", "regression", "analytic", "central"],
        _ => &["sobel", "regression", "central", "analytic"],
    }
}

/// Whether anything reads a Hessian: a ray, or strokes by the paper's rule.
fn reads_hessians(scene: &Scene, plan: &Plan) -> bool {
    (plan.has_pass(Pass::Rays) && plan.needs_at_first(Quantity::Hessian))
        || strokes_read_hessians(scene, plan.has_pass(Pass::Strokes))
}

fn strokes_read_hessians(scene: &Scene, has_strokes: bool) -> bool {
    has_strokes && scene.hatching.as_ref().is_some_and(|hatching| hatching.reads_hessians())
}

/// Settings of `hessian`, where there is one. What rounds its values to integers is best smoothed ([REC-3]).
fn hessians(scene: &Scene, plan: &Plan) -> &'static [&'static str] {
    let smoothed = plan.has_pass(Pass::SmoothedCoefficients);
    match (is_twice_differentiable(scene.sampling.kernel), smoothed) {
        _ if !reads_hessians(scene, plan) => &[],
        (true, true) => &["central", "analytic", "gaussian"],
        (true, false) => &["gaussian", "central", "analytic"],
        (false, true) => &["central", "gaussian"],
        (false, false) => &["gaussian", "central"],
    }
}

/// The description of `[sampling]`.
pub(crate) static TABLE: Table<Sampling> = Table {
    check: |sampling, check| {
        if sampling.hessian == HessianEstimator::Analytic
            && !is_twice_differentiable(sampling.kernel)
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
    serves: |scene, asks| {
        let sampling = &scene.sampling;
        let has_strokes = asks.has_pass(Pass::Strokes);
        if !(asks.casts_rays() || asks.has_pass(Pass::Outlines) || has_strokes) {
            return;
        }
        if matches!(sampling.kernel, Kernel::Bspline | Kernel::Bspline5) {
            asks.pass(Pass::Coefficients, "prefiltered kernel", "sampling.kernel");
        }
        let of_rays = asks.first(Quantity::Hessian).filter(|_| asks.casts_rays()).map(|need| need.effect.clone());
        let of_strokes = strokes_read_hessians(scene, has_strokes).then(|| "hatching".into());
        let hessian = of_rays.or(of_strokes);
        if let (Some(effect), HessianEstimator::Gaussian | HessianEstimator::Auto) = (hessian, sampling.hessian) {
            let integer_only = sampling.hessian == HessianEstimator::Auto;
            let effect = if integer_only { format!("{effect}, integer voxels") } else { effect };
            asks.pass_where(Pass::SmoothedCoefficients, integer_only, &effect, "sampling.hessian");
        }
        if sampling.skip_empty && asks.casts_rays() {
            asks.pass(Pass::Bricks, "skipping what shows nothing", "sampling.skip_empty");
        }
    },
    idle: |scene, plan, idle| {
        let sampling = &scene.sampling;
        let draws = plan.has_pass(Pass::Rays);
        let hides = plan.has_pass(Pass::HiddenPoints) || plan.has_pass(Pass::HiddenStrokes);
        let hatches = plan.has_pass(Pass::Strokes);
        if !draws {
            for key in TABLE.keys {
                // The step is still the default of camera.near.
                let is_apart = matches!(key.name, "step" | "gradient" | "hessian" | "scale");
                if !is_apart && !(key.name == "kernel" && (hides || hatches)) {
                    idle.key(&format!("sampling.{}", key.name), NOT_DRAWN);
                }
            }
        }
        if draws && matches!(scene.camera.projection, Projection::Orthographic { .. }) {
            idle.key("sampling.step_along", "planes and shells are the same in an orthographic picture");
        }
        let lines = hides || hatches || (draws && plan.has_pass(Pass::Outlines));
        if !(lines || draws && plan.reads_gradients()) {
            idle.key("sampling.gradient", if draws { "nothing needs a gradient" } else { NOT_DRAWN });
        }
        if draws && !plan.reads_gradients() {
            idle.key("sampling.normal", "nothing needs a normal");
        }
        if !reads_hessians(scene, plan) {
            let why = match (hatches, draws) {
                (true, _) => "strokes by hatching.directions.rule = \"scaled\" have scales of their own",
                (false, true) => "nothing needs a Hessian",
                (false, false) => NOT_DRAWN,
            };
            idle.key("sampling.hessian", why);
            idle.key("sampling.scale", why);
        } else if !matches!(sampling.hessian, HessianEstimator::Auto | HessianEstimator::Gaussian) {
            idle.key("sampling.scale", "only hessian = \"gaussian\" smooths");
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
            )
            .knob(Ladder::to_field(|_, plan, _| of_rays(plan, STEPS))),
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
            )
            .knob(Ladder::to_field(|scene, plan, _| kernels(scene, plan))),
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
            )
            .knob(Ladder::to_field(|scene, plan, _| gradients(scene, plan))),
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
            )
            .knob(Ladder::to_field(|scene, plan, _| hessians(scene, plan))),
            Key::new(
                "scale",
                "REC-3",
                "σ of the Gaussian.",
                &Slot { kind: WORLD_LENGTH, get: |s: &Sampling| Some(s.scale), set: |s, v| s.scale = v },
            )
            .knob(Ladder::to_field(|_, plan, _| if plan.has_pass(Pass::SmoothedCoefficients) { SCALES } else { &[] })),
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
            )
            .knob(Ladder::to_finest(|_, plan, _| of_rays(plan, &["f32", "f64"]))),
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
            )
            .knob(Ladder::to_finest(|_, plan, _| {
                of_rays(plan, &["0.5", "0.2", "0.1", "0.05", "0.02", "0.01", "0.001", "0"])
            })),
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
