//! Rules of `[style_mipmaps]`: needs, keys without effect, knobs.

use super::{Ladder, Pass, Rules, Settings};
use crate::plan::Plan;
use crate::quantity::Quantity;
use crate::tables::{Kappa, Scene, StyleMipmaps, TransferKind};

/// The rules of `[style_mipmaps]`.
pub(super) const RULES: Rules = Rules {
    asks: |scene, asks| {
        let Some(mipmaps) = scene.style_mipmaps.as_ref().filter(|_| asks.casts_rays() && has_styles(scene)) else {
            return;
        };
        asks.pass(Pass::StyleMipmaps, "style mip-maps", "style_mipmaps");
        if mipmaps.measured_curvature_bias(scene) != 0.0 {
            let exact = scene.contours.as_ref().is_some_and(|contours| contours.kappa == Kappa::Exact);
            let curvature = if exact { Quantity::Hessian } else { Quantity::PreviousNormal };
            asks.need(curvature, "style mip-maps", "style_mipmaps.curvature_bias");
        }
        if mipmaps.gradient_bias != 0.0 {
            asks.need(Quantity::GradientMagnitudeRange, "style mip-maps", "style_mipmaps.gradient_bias");
        }
    },
    idle: |scene, _, idle| {
        let Some(mipmaps) = &scene.style_mipmaps else { return };
        if !has_styles(scene) {
            idle.key("style_mipmaps", "mip-maps are made of styles, and the function is regular");
        } else if mipmaps.measured_curvature_bias(scene) != mipmaps.curvature_bias {
            idle.key("style_mipmaps.curvature_bias", "contours.kappa = \"none\": there is no curvature");
        }
    },
    knobs: &[
        (
            "curvature_bias",
            Ladder::to_finest(|scene, plan, _| if has_kappa(scene) { biases(scene, plan) } else { &[] }),
        ),
        ("gradient_bias", Ladder::to_finest(|scene, plan, _| biases(scene, plan))),
    ],
    ..Rules::new("style_mipmaps")
};

impl StyleMipmaps {
    /// b_κ as far as the scene has a κ: `kappa` of `[contours]` is the κ of the bias, too, so with `kappa = "none"`
    /// there is no curvature to be biased by. Without `[contours]`, the κ is the one along the ray.
    pub fn measured_curvature_bias(&self, scene: &Scene) -> f64 {
        match scene.contours.as_ref().map(|contours| contours.kappa) {
            Some(Kappa::None { .. }) => 0.0,
            Some(Kappa::Ray | Kappa::Exact) | None => self.curvature_bias,
        }
    }
}

/// Whether the scene's transfer function is one of styles.
fn has_styles(scene: &Scene) -> bool {
    scene.transfer.as_ref().is_some_and(|transfer| transfer.kind == TransferKind::Style)
}

/// Whether there is a κ that a bias could be of.
fn has_kappa(scene: &Scene) -> bool {
    scene.contours.as_ref().is_none_or(|contours| !matches!(contours.kappa, Kappa::None { .. }))
}

/// Settings of a bias, if there are mip-maps. A larger bias gives a coarser level.
fn biases(_: &Scene, plan: &Plan) -> Settings {
    if plan.has_pass(Pass::StyleMipmaps) { &["4", "2", "1", "0"] } else { &[] }
}
