//! The part of a scene that a job draws, with its plan.

use super::parts;
use crate::Failure;
use drypoint_scene::plan::{NodesPlan, Pass, Plan};
use drypoint_scene::tables::Scene;
use drypoint_scene::transfer::node_values;
use drypoint_scene::volume::Volume;

/// The part of a scene to draw.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RenderTarget {
    /// Everything that the scene draws.
    #[default]
    Picture,
    /// Points and lines alone, on their page. The volume itself is not drawn, and needs nothing.
    Marks,
    /// Stipples and outlines, on their page.
    Points,
    /// Hatching and outlines, on their page.
    Strokes,
}

impl RenderTarget {
    /// Whether the scene's stipples are drawn.
    pub fn has_points(self) -> bool {
        self != Self::Strokes
    }

    /// Whether the scene's hatching is drawn.
    pub fn has_hatching(self) -> bool {
        self != Self::Points
    }
}

/// Returns the values of the nodes of a scene's function over a volume, if they are in another unit. See [`NodesPlan`].
pub(super) fn values_of_nodes(scene: &Scene, volume: &Volume, key: String, within: Option<usize>) -> Option<NodesPlan> {
    let transfer = scene.transfer.as_ref()?;
    let range = scene.volume.range.unwrap_or_else(|| volume.range());
    let values = node_values(transfer, range, volume);
    (!values.is_empty()).then(|| NodesPlan { key, within, unit: transfer.unit.name(), values })
}

/// Returns the plan of a part of a scene.
pub(super) fn plan_for(scene: &Scene, target: RenderTarget) -> Plan {
    match target {
        RenderTarget::Picture => Plan::new(scene),
        RenderTarget::Marks => Plan::of_marks(scene),
        RenderTarget::Points => Plan::of_points(scene),
        RenderTarget::Strokes => Plan::of_strokes(scene),
    }
}

/// Whether the transfer function is needed: by rays, dots in its colours, strokes in its visible regions, or parts.
pub(super) fn calls_for_function(plan: &Plan, scene: &Scene) -> bool {
    let passes = [Pass::Rays, Pass::DotColors, Pass::SeenCells];
    passes.into_iter().any(|pass| plan.has_pass(pass)) || parts::reads_function(scene)
}

/// Checks that the scene draws something of the target.
pub(super) fn something_is_drawn(scene: &Scene, target: RenderTarget) -> Result<(), Failure> {
    let at = |key| scene.given.position(key);
    match target {
        RenderTarget::Marks | RenderTarget::Points
            if target == RenderTarget::Points && scene.stipples.is_none() || !scene.has_marks() =>
        {
            let remedy = "add a table [stipples], or write preset = \"stipple\"";
            Err(Failure::new("the scene has no stipples", at("stipples"), remedy))
        }
        RenderTarget::Strokes if !scene.has_strokes() => {
            let remedy = "add a table [hatching] or [outlines], or write preset = \"hatch\"";
            Err(Failure::new("the scene has no strokes", at("outlines"), remedy))
        }
        RenderTarget::Picture if !scene.has_marks() && !scene.draws_volume() => Err(Failure::new(
            "the scene draws nothing",
            at("transfer"),
            "add a [transfer] table, or a [surface] with a look",
        )),
        _ => Ok(()),
    }
}
