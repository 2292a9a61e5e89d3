//! Rules of `[shading]`: needs, keys without effect, knobs.

use super::{Idle, Rules};
use crate::lighting::LightingPreset;
use crate::quantity::Quantity;
use crate::tables::{Scene, Shading, ShadingModel, SurfaceLook, TransferKind};

/// The rules of `[shading]`.
pub(super) const RULES: Rules = Rules {
    asks: |scene, asks| {
        let Some(shading) = scene.shading.as_ref().filter(|_| is_regular(scene) && asks.casts_rays()) else { return };
        match (shading.model, shading.tones()) {
            (ShadingModel::Function, _) => {
                asks.need(Quantity::Gradient, "lighting function", "shading.model");
                if shading.reads_magnitude() {
                    let key = if shading.table.is_some() { "shading.table" } else { "shading.preset" };
                    asks.need(Quantity::GradientMagnitudeRange, "opacity enhancement", key);
                }
            }
            (_, None) => asks.need(Quantity::Gradient, "shading", "shading"),
            (_, Some(toon)) if toon.reads_normals() => asks.need(Quantity::Gradient, "toon shading", "shading.model"),
            (_, Some(_)) => {}
        }
        if shading.silhouette.is_some() {
            asks.need(Quantity::Gradient, "silhouettes", "shading.silhouette");
        }
        if shading.view_opacity > 0.0 {
            asks.need(Quantity::Gradient, "view-dependent opacity", "shading.view_opacity");
        }
    },
    idle: |scene, _, idle| {
        let Some(shading) = &scene.shading else { return };
        let kind = scene.transfer.as_ref().map(|transfer| transfer.kind);
        if !lit_surface(scene) && kind == Some(TransferKind::Style) {
            idle.key("shading", "styles carry their own light: shading acts on a regular function");
        } else if !lit(scene) && scene.surface.is_some() {
            idle.key("shading", "nothing is lit: it acts on a regular function, and on a surface with a lit look");
        } else {
            idle_keys(scene, shading, idle);
        }
    },
    ..Rules::new("shading")
};

/// Whether the scene has an iso-surface or a mesh that is lit.
pub(super) fn lit_surface(scene: &Scene) -> bool {
    let lit = |look| matches!(look, SurfaceLook::Phong | SurfaceLook::Toon);
    !scene.meshes.is_empty() || scene.surface.as_ref().is_some_and(|surface| lit(surface.look))
}

/// Whether the scene's transfer function has colours, which are lit.
fn is_regular(scene: &Scene) -> bool {
    scene.transfer.as_ref().is_some_and(|transfer| transfer.kind == TransferKind::Regular)
}

/// Whether a scene has something that `[shading]` acts on.
pub(super) fn lit(scene: &Scene) -> bool {
    is_regular(scene) || lit_surface(scene)
}

/// Lists the keys that have no effect although something is lit.
fn idle_keys(scene: &Scene, shading: &Shading, idle: &mut Idle) {
    let regular = is_regular(scene);
    let glossy =
        !scene.meshes.is_empty() || scene.surface.as_ref().is_some_and(|surface| surface.look == SurfaceLook::Phong);
    if !glossy {
        idle_constants(shading, regular, idle);
    } else if shading.specular == 0.0 {
        idle.key("shading.shininess", "specular is 0");
    }
    const OF_FUNCTIONS: [&str; 4] = ["shading.preset", "shading.table", "shading.contour", "shading.divisor_floor"];
    if !regular {
        let keys = ["shading.model", "shading.toon", "shading.silhouette", "shading.view_opacity"];
        for key in keys.into_iter().chain(OF_FUNCTIONS) {
            idle.key(key, "it acts on a regular function; a surface has keys of its own");
        }
        return;
    }
    let model = match shading.model {
        ShadingModel::Phong => "model is \"phong\"",
        ShadingModel::Toon => "model is \"toon\"",
        ShadingModel::Function => "model is \"lighting-function\"",
    };
    if shading.model != ShadingModel::Toon {
        idle.key("shading.toon", model);
    }
    if shading.model != ShadingModel::Function {
        OF_FUNCTIONS.into_iter().for_each(|key| idle.key(key, model));
    } else {
        if !shading.lighting_preset().is_some_and(LightingPreset::has_contours) {
            idle.key("shading.contour", "the lighting function has no contours that are generated");
        }
        if !shading.reads_magnitude() {
            idle.key("shading.divisor_floor", "the preset does not enhance opacities");
        }
    }
}

/// Lists the constants of Blinn–Phong that nothing reads, if no surface reads them.
fn idle_constants(shading: &Shading, regular: bool, idle: &mut Idle) {
    const SHARES: [&str; 2] = ["shading.ambient", "shading.diffuse"];
    const HIGHLIGHT: [&str; 2] = ["shading.specular", "shading.shininess"];
    let mut say = |keys: [&str; 2], why: &str| keys.into_iter().for_each(|key| idle.key(key, why));
    if !regular || shading.model == ShadingModel::Toon {
        let why = "nothing is lit by Blinn–Phong: tones are the table toon's";
        say(SHARES, why);
        say(HIGHLIGHT, why);
        return;
    }
    if shading.lighting_file().is_some() {
        let why = "the lighting function is read from a file";
        say(SHARES, why);
        say(HIGHLIGHT, why);
        return;
    }
    let preset = shading.lighting_preset();
    if preset.is_some_and(|preset| !preset.reads_shares()) {
        say(SHARES, "the preset has shares of its own");
    }
    if preset.is_some_and(|preset| !preset.has_highlight()) {
        say(HIGHLIGHT, "the preset has no highlight");
    } else if shading.specular == 0.0 {
        idle.key("shading.shininess", "specular is 0");
    }
}
