//! Rules of `[outlines]`: needs, keys without effect, knobs.

use super::{Pass, Rules};
use crate::tables::{Crease, Iso, SurfaceLook};

/// The rules of `[outlines]`.
pub(super) const RULES: Rules = Rules {
    asks: |scene, asks| {
        let Some(outlines) = &scene.outlines else { return };
        asks.pass(Pass::Outlines, "outlines", "outlines");
        if outlines.crease != Crease::Off {
            asks.pass(Pass::Creases, "creases", "outlines.crease");
        }
        asks.pass(Pass::HiddenStrokes, "hidden strokes", if scene.surface.is_some() { "surface" } else { "outlines" });
        if outlines.iso == Iso::Auto {
            asks.pass(Pass::AutomaticIso, "outlines", "outlines.iso");
        }
        let drawn = |look| look != SurfaceLook::None && asks.casts_rays();
        if scene.surface.as_ref().is_some_and(|surface| surface.iso == Iso::Auto && !drawn(surface.look)) {
            asks.pass(Pass::AutomaticIso, "hidden strokes", "surface.iso");
        }
    },
    idle: |scene, _, idle| {
        if scene.outlines.as_ref().is_some_and(|outlines| outlines.pen.is_some()) {
            idle.key("outlines.color", "outlines.pen says the colour");
            idle.key("outlines.width", "the nib of outlines.pen is the width");
        }
    },
    ..Rules::new("outlines")
};
