//! Rules of `[shading]`: needs, keys without effect, knobs.

use super::{Idle, Rules};
use crate::quantity::Quantity;
use crate::tables::{Scene, Shading, ShadingModel, SurfaceLook, TransferKind};

/// The rules of `[shading]`.
pub(super) const RULES: Rules = Rules {
    asks: |scene, asks| {
        let Some(shading) = scene.shading.as_ref().filter(|_| is_regular(scene) && asks.casts_rays()) else { return };
        match shading.tones() {
            None => asks.need(Quantity::Gradient, "shading", "shading"),
            Some(toon) if toon.reads_normals() => asks.need(Quantity::Gradient, "toon shading", "shading.model"),
            Some(_) => {}
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

/// Whether its transfer function has colours, which light falls on.
fn is_regular(scene: &Scene) -> bool {
    scene.transfer.as_ref().is_some_and(|transfer| transfer.kind == TransferKind::Regular)
}

/// Whether a scene has something that `[shading]` acts on.
pub(super) fn lit(scene: &Scene) -> bool {
    is_regular(scene) || lit_surface(scene)
}

/// Which keys say nothing although something is lit.
fn idle_keys(scene: &Scene, shading: &Shading, idle: &mut Idle) {
    let regular = is_regular(scene);
    let toon = shading.model == ShadingModel::Toon;
    let has_meshes = !scene.meshes.is_empty();
    let glossy = has_meshes || scene.surface.as_ref().is_some_and(|surface| surface.look == SurfaceLook::Phong);
    if glossy || (regular && !toon) {
        if shading.specular == 0.0 {
            idle.key("shading.shininess", "specular is 0");
        }
    } else {
        for key in ["shading.ambient", "shading.diffuse", "shading.specular", "shading.shininess"] {
            idle.key(key, "nothing is lit by Blinn–Phong: tones are the table toon's");
        }
    }
    if !regular {
        for key in ["shading.model", "shading.toon", "shading.silhouette", "shading.view_opacity"] {
            idle.key(key, "it acts on a regular function; a surface has keys of its own");
        }
    } else if !toon {
        idle.key("shading.toon", "model is \"phong\"");
    }
}
