//! Rules of `[volume]`: needs, keys without effect, knobs.

use super::halo::halos_in_effect;
use super::{Pass, Rules};
use crate::quantity::Quantity;
use crate::tables::{GradientRange, NormalSide, Scene, Unit, VolumeSource};

/// The rules of `[volume]`.
pub(super) const RULES: Rules = Rules {
    asks: |scene, asks| {
        let Some(parts) = &scene.volume.parts else { return };
        asks.pass(Pass::Parts, "parts", "volume.parts");
        let is_automatic = scene.transfer.as_ref().is_some_and(|transfer| transfer.is_automatic());
        if parts.at_least.is_none() && is_automatic && !asks.casts_rays() {
            asks.pass(Pass::AutomaticTransfer, "parts", "transfer.nodes");
        }
    },
    serves: |scene, asks| {
        if let (GradientRange::Quantile(_), Some(need)) =
            (scene.volume.gradient_range, asks.first(Quantity::GradientMagnitudeRange))
        {
            let effect = need.effect.clone();
            asks.pass(Pass::GradientRange, &effect, "volume.gradient_range");
        }
    },
    idle: |scene, plan, idle| {
        if matches!(scene.volume.source, VolumeSource::Phantom(_)) {
            idle.key("volume.raw", "a phantom has no file");
        }
        let stippled = scene.stipples.is_some();
        if !stippled && scene.transfer.as_ref().is_some_and(|transfer| transfer.unit != Unit::Normalized) {
            idle.key("volume.range", "only transfer.unit = \"normalized\" is measured in it");
        }
        // Keys of a scene's own volume, in whose place another one stands.
        let other = "it describes the volume that the scene names, and another one is drawn";
        if scene.volume.subset.ranges.is_none() {
            idle.key("volume.box", other);
        }
        if matches!(scene.volume.source, VolumeSource::File { raw: None, .. }) {
            idle.key("volume.raw", other);
        }
        let why = match scene.volume.labels {
            Some(_) if plan.reads_labels() || selects_labels(scene) => None,
            Some(_) => Some("nothing reads a label"),
            None => Some("volume.labels names no label volume"),
        };
        if let Some(why) = why {
            idle.key("volume.labels", if scene.volume.labels.is_some() { why } else { other });
            idle.key("volume.label_names", why);
            idle.key("volume.label_lookup", why);
        }
        if !stippled && !plan.needs_anywhere(Quantity::GradientMagnitudeRange) {
            idle.key("volume.gradient_range", "nothing reads |g|");
        }
        let turned = scene.sampling.normal == NormalSide::Outward || plan.needs_at_first(Quantity::Hessian);
        // Seeds have |n·v|, whatever the side of the normal, except by a direction, a signed κ or the inside of a surface.
        let halos = || plan.has_pass(Pass::HaloSeeds).then(|| halos_in_effect(scene)).into_iter().flatten();
        let seeds = plan.needs_at_seeds(Quantity::Hessian)
            || halos().any(|(_, halo)| halo.seed.direction.is_some())
            || scene.transfer.is_none() && halos().any(|(_, halo)| halo.seed.is_by_opacity());
        let keeps_parts = scene.volume.parts.is_some();
        if !(stippled || keeps_parts || scene.has_strokes() || turned && plan.shows_gradients() || seeds) {
            idle.key("volume.outside", "nothing reads an outward normal or a signed curvature");
        }
    },
    ..Rules::new("volume")
};

/// Whether an object of the volume selects labels.
fn selects_labels(scene: &Scene) -> bool {
    scene.objects.iter().any(|object| object.volume.is_none() && object.label.is_some())
}
