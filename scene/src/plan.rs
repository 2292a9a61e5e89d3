//! The plan of a scene: the work that it calls for, and why ([PLAN-1], [PLAN-3]). Nothing else is computed.
//!
//! The rules of a table stand in `plan::rules`, one file a table. They say what the table's effect needs, and which
//! line of the scene asked for it. This module collects the needs, and adds the quantities that needed quantities are
//! made of.

mod asks;
mod ladder;
mod need;
mod pass;
pub(crate) mod rules;

pub use crate::quantity::Quantity;
pub(crate) use asks::{Asks, At, Idle};
pub use ladder::Limit;
pub(crate) use ladder::{Ladder, Settings};
pub use need::{IdleKey, Need, NodesPlan, PassNeed, Plan, PointsPlan, Samples};
pub use pass::Pass;
pub use rules::halos_in_effect;

use crate::tables::{GradientEstimator, Kernel, Scene};
use asks::Drawn;
use rules::rules;

impl Plan {
    /// The plan of a scene. It depends on the scene alone. Work that the scene leaves to the volume stays in the plan
    /// until [`Plan::settle`].
    pub fn new(scene: &Scene) -> Self {
        Self::of(scene, Drawn { volume: scene.draws_volume(), points: true, strokes: true })
    }

    /// The plan of a scene's points and lines alone, whether or not it draws the volume too.
    pub fn of_marks(scene: &Scene) -> Self {
        Self::of(scene, Drawn { volume: false, points: true, strokes: true })
    }

    /// The plan of a scene's stipples and outlines alone.
    pub fn of_points(scene: &Scene) -> Self {
        Self::of(scene, Drawn { volume: false, points: true, strokes: false })
    }

    /// The plan of a scene's strokes alone, outlines among them.
    pub fn of_strokes(scene: &Scene) -> Self {
        Self::of(scene, Drawn { volume: false, points: false, strokes: true })
    }

    fn of(scene: &Scene, drawn: Drawn) -> Self {
        let mut asks = Asks { scene, drawn, at: At::default(), needs: Vec::new(), passes: Vec::new() };
        if drawn.volume {
            asks.pass(Pass::Rays, "picture", "picture.samples");
        }
        for (at, rules) in rules(scene) {
            asks.at = at;
            (rules.asks)(scene, &mut asks);
        }
        asks.close();
        for (at, rules) in rules(scene) {
            asks.at = at;
            (rules.serves)(scene, &mut asks);
        }
        asks.close();
        asks.needs.sort_by_key(|need| need.quantity);
        asks.passes.sort_by_key(|need| need.pass);
        let (idle_keys, nodes, points, warnings) = (Vec::new(), Vec::new(), None, Vec::new());
        let mut plan = Self { needs: asks.needs, passes: asks.passes, idle_keys, nodes, points, warnings };
        let mut idle = Idle { scene, at: At::default(), keys: Vec::new() };
        for (at, rules) in rules(scene) {
            idle.at = at;
            (rules.idle)(scene, &plan, &mut idle);
        }
        plan.idle_keys = idle.sorted();
        plan.warn_outlines(scene);
        plan
    }

    /// Removes work that the scene leaves to the volume and this volume does not need. This is smoothing with `hessian
    /// = "auto"`, which only files of integers need ([REC-3]).
    pub fn settle(&mut self, scene: &Scene, integer: bool) {
        if integer || !self.passes.iter().any(|need| need.integer_only) {
            return;
        }
        self.passes.retain(|need| !need.integer_only);
        let mut idle = Idle { scene, at: At::default(), keys: std::mem::take(&mut self.idle_keys) };
        idle.key("sampling.scale", "hessian = \"auto\" smooths integers only, and the file has none");
        self.idle_keys = idle.sorted();
    }

    /// Warns where outlines follow a gradient that jumps at the faces of cells, the derivative of the trilinear kernel:
    /// N·v changes its sign without being 0 ([HATCH-18], [REC-2]).
    fn warn_outlines(&mut self, scene: &Scene) {
        let sampling = &scene.sampling;
        if self.has_pass(Pass::Outlines)
            && (sampling.kernel, sampling.gradient) == (Kernel::Trilinear, GradientEstimator::Analytic)
        {
            let why = "sampling.gradient = \"analytic\" jumps at the faces of cells with sampling.kernel = \"trilinear\": \
                       outlines are broken there; another gradient or kernel closes them";
            self.warnings.push(why.into());
        }
    }
}

#[cfg(test)]
mod tests;
