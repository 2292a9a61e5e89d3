//! Rules of `[sampling]`: needs, keys without effect, knobs.

use super::{Ladder, Pass, Rules, Settings, halos_in_effect};
use crate::plan::Plan;
use crate::quantity::Quantity;
use crate::tables::{HessianEstimator, Kernel, Projection, Scene};

use crate::tables::sampling::TABLE;

/// The rules of `[sampling]`.
pub(super) const RULES: Rules = Rules {
    serves: |scene, asks| {
        let sampling = &scene.sampling;
        let has_strokes = asks.has_pass(Pass::Strokes);
        if !(asks.casts_rays() || asks.has_pass(Pass::Outlines) || has_strokes) {
            return;
        }
        if matches!(sampling.kernel, Kernel::Bspline | Kernel::Bspline5) {
            asks.pass(Pass::Coefficients, "prefiltered kernel", "sampling.kernel");
        }
        if sampling.kernel == Kernel::BsplineSmooth {
            asks.pass(Pass::SmoothingKernel, "reconstruction", "sampling.kernel");
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
        // A seed's direction and κ along its ray are those of shading normals.
        let by_direction = halos_in_effect(scene).any(|(_, halo)| halo.seed.direction.is_some());
        if draws && !plan.shows_gradients() && !plan.needs_at_seeds(Quantity::PreviousNormal) && !by_direction {
            idle.key("sampling.normal", "nothing needs a normal of that side");
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
    knobs: &[
        ("step", Ladder::to_field(|_, plan, _| of_rays(plan, STEPS))),
        ("kernel", Ladder::to_field(|scene, plan, _| kernels(scene, plan))),
        ("gradient", Ladder::to_field(|scene, plan, _| gradients(scene, plan))),
        ("hessian", Ladder::to_field(|scene, plan, _| hessians(scene, plan))),
        ("scale", Ladder::to_field(|_, plan, _| if plan.has_pass(Pass::SmoothedCoefficients) { SCALES } else { &[] })),
        ("number", Ladder::to_finest(|_, plan, _| of_rays(plan, &["f32", "f64"]))),
        (
            "stop_below",
            Ladder::to_finest(|_, plan, _| of_rays(plan, &["0.5", "0.2", "0.1", "0.05", "0.02", "0.01", "0.001", "0"])),
        ),
    ],
    ..Rules::new("sampling")
};

/// The reason why keys that only rays read have no effect.
const NOT_DRAWN: &str = "the volume itself is not drawn";

/// Settings of `step`.
const STEPS: &[&str] =
    &["4 voxels", "2 voxels", "1 voxel", "0.5 voxels", "0.25 voxels", "0.125 voxels", "0.0625 voxels"];

/// Settings of `scale`.
const SCALES: &[&str] = &["4 voxels", "2 voxels", "1 voxel", "0.5 voxels"];

/// Settings of a key that only rays read.
fn of_rays(plan: &Plan, settings: Settings) -> Settings {
    if plan.has_pass(Pass::Rays) { settings } else { &[] }
}

/// Passes that read the field between voxels: points and lines without a surface lie on the voxels alone.
const BETWEEN_VOXELS: [Pass; 4] = [Pass::Rays, Pass::HiddenPoints, Pass::Outlines, Pass::Strokes];

/// Settings of `kernel`. If the Hessian is the kernel's own, only kernels that have one are listed.
fn kernels(scene: &Scene, plan: &Plan) -> Settings {
    match scene.sampling.hessian {
        _ if !BETWEEN_VOXELS.iter().any(|pass| plan.has_pass(*pass)) => &[],
        HessianEstimator::Analytic => &["bspline-smooth", "bspline", "bspline5"],
        _ => &["bspline-smooth", "trilinear", "catmull-rom", "bspline", "bspline5"],
    }
}

/// Settings of `gradient`, if something reads a gradient. The derivative of the trilinear kernel is of order one,
/// central differences are of order two; those of the other kernels are closer than central differences.
fn gradients(scene: &Scene, plan: &Plan) -> Settings {
    match scene.sampling.kernel {
        _ if !plan.reads_gradients() => &[],
        Kernel::Trilinear => &["sobel", "regression", "analytic", "central"],
        _ => &["sobel", "regression", "central", "analytic"],
    }
}

/// Whether anything reads a Hessian: a ray, or strokes by the paper's rule.
fn reads_hessians(scene: &Scene, plan: &Plan) -> bool {
    (plan.has_pass(Pass::Rays) && plan.needs_anywhere(Quantity::Hessian))
        || strokes_read_hessians(scene, plan.has_pass(Pass::Strokes))
}

fn strokes_read_hessians(scene: &Scene, has_strokes: bool) -> bool {
    has_strokes && scene.hatching.as_ref().is_some_and(|hatching| hatching.reads_hessians())
}

/// Settings of `hessian`, if something reads a Hessian. Values that are rounded to integers are best smoothed
/// ([REC-3]).
fn hessians(scene: &Scene, plan: &Plan) -> Settings {
    let smoothed = plan.has_pass(Pass::SmoothedCoefficients);
    match (scene.sampling.kernel.is_twice_differentiable(), smoothed) {
        _ if !reads_hessians(scene, plan) => &[],
        (true, true) => &["central", "analytic", "gaussian"],
        (true, false) => &["gaussian", "central", "analytic"],
        (false, true) => &["central", "gaussian"],
        (false, false) => &["gaussian", "central"],
    }
}
