//! Rules of `[contours]`: needs, keys without effect, knobs.

use super::halo::halos_in_effect;
use super::{Ladder, Rules};
use crate::picture::LayerKind;
use crate::quantity::Quantity;
use crate::tables::{Kappa, NormalSide, Scene, SeedBy, TransferKind};

/// The rules of `[contours]`.
pub(super) const RULES: Rules = Rules {
    asks: |scene, asks| {
        let Some(contours) = scene.contours.as_ref().filter(|_| asks.casts_rays() && has_styles(scene)) else { return };
        match contours.kappa {
            Kappa::Ray => asks.need(Quantity::PreviousNormal, "contours", "contours.kappa"),
            Kappa::Exact => asks.need(Quantity::Hessian, "contours", "contours.kappa"),
            Kappa::None { .. } => {}
        }
        if contours.fade.is_some() {
            asks.need(Quantity::GradientMagnitudeRange, "fading contours", "contours.fade");
        }
    },
    idle: |scene, _, idle| {
        let Some(contours) = &scene.contours else { return };
        if !has_styles(scene) {
            let layers = &scene.picture.layers;
            let shown = layers.contains(&LayerKind::Curvature) || layers.contains(&LayerKind::CurvatureAlongView);
            let why = "contours act on styles, and the function is regular";
            let seeds = halos_in_effect(scene).any(|(_, halo)| halo.seed.by == SeedBy::Curvature);
            if shown || seeds {
                let who = if shown { "a layer reads" } else { "halos read" };
                idle.key("contours", &format!("{why}; only {who} its kappa"));
            } else {
                idle.key("contours", why);
            }
            return;
        }
        match contours.kappa {
            Kappa::None { .. } => idle.key("contours.thickness", "kappa = \"none\": threshold counts"),
            Kappa::Ray | Kappa::Exact => idle.key("contours.threshold", "kappa is not \"none\": thickness counts"),
        }
        if contours.kappa != Kappa::Ray || scene.sampling.normal != NormalSide::Facing {
            idle.key("contours.sign_flip", "it acts with kappa = \"ray\" and sampling.normal = \"facing\"");
        }
    },
    knobs: &[("kappa", Ladder::to_field(|scene, _, _| if has_kappa(scene) { &["ray", "exact"] } else { &[] }))],
    ..Rules::new("contours")
};

/// Whether the scene's transfer function is one of styles, the only one that contours act on ([STF-8]).
fn has_styles(scene: &Scene) -> bool {
    scene.transfer.as_ref().is_some_and(|transfer| transfer.kind == TransferKind::Style)
}

/// Whether the scene's contours measure a κ_v.
fn has_kappa(scene: &Scene) -> bool {
    has_styles(scene) && scene.contours.as_ref().is_some_and(|c| matches!(c.kappa, Kappa::Ray | Kappa::Exact))
}
