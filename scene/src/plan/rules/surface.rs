//! Rules of `[surface]`: needs, keys without effect, knobs.

use super::{Pass, Rules};
use crate::quantity::Quantity;
use crate::tables::{Iso, Surface, SurfaceLook};

/// The rules of `[surface]`.
pub(super) const RULES: Rules = Rules {
    asks: |scene, asks| {
        let drawn = |surface: &Surface| surface.look != SurfaceLook::None && asks.casts_rays();
        let Some(surface) = scene.surface.as_ref().filter(|surface| drawn(surface)) else { return };
        asks.need(Quantity::Surface, "iso-surface", "surface");
        if surface.iso == Iso::Auto {
            asks.pass(Pass::AutomaticIso, "iso-surface", "surface.iso");
        }
        if surface.look == SurfaceLook::Phong {
            asks.need(Quantity::SurfaceNormal, "lit iso-surface", "surface.look");
        }
        if surface.tones().is_some_and(|toon| toon.reads_normals()) {
            asks.need(Quantity::SurfaceNormal, "iso-surface in tones", "surface.look");
        }
        if surface.silhouette.is_some() {
            asks.need(Quantity::SurfaceNormal, "silhouettes of the iso-surface", "surface.silhouette");
        }
    },
    idle: |scene, _, idle| {
        let Some(surface) = &scene.surface else { return };
        if surface.look == SurfaceLook::None && !scene.has_strokes() {
            return idle.key("surface", "look = \"none\" hides strokes alone, and the scene has none");
        }
        if surface.look == SurfaceLook::White {
            idle.key("surface.color", "look = \"white\" is white");
        }
        if surface.look != SurfaceLook::Toon {
            idle.key("surface.toon", "look is not \"toon\"");
        }
        idle.key("surface.view_opacity", "the surface is opaque, and an opacity of 1 stays 1 from every side");
    },
    ..Rules::new("surface")
};
