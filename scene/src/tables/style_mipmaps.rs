//! `[style_mipmaps]`: styles read at the level of detail that the picture can show ([STF-10]).

use super::{Kappa, Scene, TransferKind};
use crate::file::describe::{Key, Slot, Table};
use crate::file::kind::{Bounds, Number};
use crate::knobs::Ladder;
use crate::plan::{Pass, Plan, Quantity};

/// The table `[style_mipmaps]`.
#[derive(Clone, Debug, PartialEq)]
pub struct StyleMipmaps {
    /// b_κ.
    pub curvature_bias: f64,
    /// b_g.
    pub gradient_bias: f64,
    /// ω₀, the turn of the normal per voxel that the level without a bias assumes, in radians.
    pub turn: f64,
}

impl Default for StyleMipmaps {
    fn default() -> Self {
        Self { curvature_bias: 1.0, gradient_bias: 1.0, turn: 2.0 / 256.0 }
    }
}

impl StyleMipmaps {
    /// b_κ as far as the scene has a κ: `kappa` of `[contours]` is the κ of the bias, too, so with `kappa = "none"`
    /// there is no curvature to be biased by. Without `[contours]` it is the one along the ray.
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

/// A factor.
const FACTOR: Number = Number { bounds: Bounds::NOT_NEGATIVE, unit: "" };

/// Whether there is a κ that a bias could be of.
fn has_kappa(scene: &Scene) -> bool {
    scene.contours.as_ref().is_none_or(|contours| !matches!(contours.kappa, Kappa::None { .. }))
}

/// Settings of a bias, where there are mip-maps: the larger, the coarser the level.
fn biases(_: &Scene, plan: &Plan) -> &'static [&'static str] {
    if plan.has_pass(Pass::StyleMipmaps) { &["4", "2", "1", "0"] } else { &[] }
}

/// The description of `[style_mipmaps]`.
pub(crate) static TABLE: Table<StyleMipmaps> = Table {
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
    ..Table::new(
        "[style_mipmaps]",
        "Styles with more detail than the picture can show are read from their mip-maps. Without the table each lookup \
         reads the style itself.",
        StyleMipmaps::default,
        &[
            Key::new(
                "curvature_bias",
                "STF-10",
                "How much the curvature κ, `kappa` of [contours] or else \"ray\", raises the level; 0: not at all.",
                &Slot {
                    kind: FACTOR,
                    get: |m: &StyleMipmaps| Some(m.curvature_bias),
                    set: |m, v| m.curvature_bias = v,
                },
            )
            .needs(&[Quantity::PreviousNormal, Quantity::Hessian])
            .knob(Ladder::to_finest(|scene, plan, _| if has_kappa(scene) { biases(scene, plan) } else { &[] })),
            Key::new(
                "gradient_bias",
                "STF-10",
                "By how many levels |g| = 0 raises the level; 0: not at all.",
                &Slot { kind: FACTOR, get: |m: &StyleMipmaps| Some(m.gradient_bias), set: |m, v| m.gradient_bias = v },
            )
            .needs(&[Quantity::GradientMagnitudeRange])
            .knob(Ladder::to_finest(|scene, plan, _| biases(scene, plan))),
            Key::new(
                "turn",
                "STF-10",
                "ω₀, the turn of the normal per voxel that is assumed at the least.",
                &Slot {
                    kind: Number { bounds: Bounds::NOT_NEGATIVE, unit: ", in radians" },
                    get: |m: &StyleMipmaps| Some(m.turn),
                    set: |m, v| m.turn = v,
                },
            ),
        ],
    )
};
