//! Rules of the top of a scene file: keys without effect.

use super::shading::{lit, lit_surface};
use super::{Pass, Rules};

/// The rules of the top of a scene file.
pub(super) const RULES: Rules = Rules {
    idle: |scene, plan, idle| {
        // What a preset supplies is there and was not said.
        let supplied = [
            (scene.transfer.is_some(), "transfer"),
            (scene.stipples.is_some(), "stipples"),
            (scene.hatching.is_some(), "hatching"),
            (scene.outlines.is_some(), "outlines"),
            (scene.shading.is_some(), "shading"),
            (!scene.halos.is_empty(), "halo"),
            (scene.surface.is_some(), "surface"),
        ];
        if !supplied.iter().any(|(is_there, table)| *is_there && !idle.says(table)) {
            idle.key("preset", "the scene has its tables itself");
        }
        let is_lit = lit(scene);
        match &scene.shading {
            Some(shading) if is_lit && shading.light.is_some() => idle.key("light", "shading.light wins"),
            Some(_) if is_lit => {}
            _ if lit_surface(scene) => {}
            _ if scene.stipples.as_ref().and_then(|s| s.lighting).is_some_and(|lighting| lighting.light.is_none()) => {}
            _ if scene.hatching.as_ref().is_some_and(|h| h.is_lit(scene) && h.stroke.light.is_none()) => {}
            _ => idle.key("light", "nothing is lit: a light acts on [shading] of a regular function"),
        }
        if !plan.has_pass(Pass::Rays) {
            for key in ["transfer", "styles", "shading", "contours", "style_mipmaps"] {
                let colors = plan.has_pass(Pass::DotColors) && matches!(key, "transfer" | "styles");
                if !colors {
                    idle.key(key, "the volume itself is not drawn");
                }
            }
        }
    },
    ..Rules::new("")
};
