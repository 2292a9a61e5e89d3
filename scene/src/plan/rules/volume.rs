//! Rules of `[volume]`: needs, keys without effect, knobs.

use super::{Pass, Rules};
use crate::quantity::Quantity;
use crate::tables::{GradientRange, NormalSide, Unit, VolumeSource};

/// The rules of `[volume]`.
pub(super) const RULES: Rules = Rules {
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
        let why = match scene.volume.labels {
            Some(_) if plan.reads_labels() => None,
            Some(_) => Some("nothing reads a label"),
            None => Some("volume.labels names no label volume"),
        };
        if let Some(why) = why {
            for key in ["volume.labels", "volume.label_names", "volume.label_lookup"] {
                idle.key(key, why);
            }
        }
        if !stippled && !plan.needs(Quantity::GradientMagnitudeRange) {
            idle.key("volume.gradient_range", "nothing reads |g|");
        }
        let turned = scene.sampling.normal == NormalSide::Outward || plan.needs_at_first(Quantity::Hessian);
        if !(stippled || scene.has_strokes() || turned && plan.reads_gradients()) {
            idle.key("volume.outside", "nothing reads an outward normal or a signed curvature");
        }
    },
    ..Rules::new("volume")
};
