//! What `[hatching]` needs of the rest of a scene, and what it makes of other tables.

use super::{DirectionRule, Hatching, SeedsBy, Spacing};
use crate::plan::{Asks, Idle, Pass};
use crate::tables::{GradientRange, Iso, Scene};

impl Hatching {
    /// Whether every stroke is drawn with one width: that of a pen, or what the spacing reckons with.
    pub fn has_one_width(&self) -> bool {
        self.pen.is_some() || self.spacing != Spacing::Random
    }

    /// Whether the light shows in the strokes.
    pub fn is_lit(&self) -> bool {
        self.spacing == Spacing::Tone || self.cross.is_some() || (!self.has_one_width() && self.stroke.tone > 0.0)
    }
}

/// What is made once, and what a frame does.
pub(super) fn asks(scene: &Scene, asks: &mut Asks) {
    let Some(hatching) = scene.hatching.as_ref().filter(|_| asks.draws_strokes()) else { return };
    if hatching.iso == Iso::Auto {
        asks.pass(Pass::AutomaticIso, "hatching", "hatching.iso");
    }
    asks.pass(Pass::Pyramid, "hatching", "hatching");
    if hatching.seeds == SeedsBy::Curvature {
        asks.pass(Pass::SeedMeasures, "seeds by curvature", "hatching.seeds");
        if matches!(scene.volume.gradient_range, GradientRange::Quantile(_)) {
            asks.pass(Pass::GradientRange, "seeds by curvature", "hatching.seeds");
        }
    }
    asks.pass(Pass::Strokes, "hatching", "hatching.length");
    if hatching.cross.is_some() {
        asks.pass(Pass::CrossStrokes, "cross-hatching", "hatching.cross");
    }
    asks.pass(Pass::HiddenStrokes, "hidden strokes", if scene.surface.is_some() { "surface" } else { "hatching" });
    if hatching.spacing != Spacing::Random {
        asks.pass(Pass::Spacing, "strokes apart", "hatching.spacing");
    }
}

/// Keys that its own neighbours make idle.
pub(super) fn idle(scene: &Scene, idle: &mut Idle) {
    let Some(hatching) = &scene.hatching else { return };
    if hatching.pen.is_some() {
        idle.key("hatching.color", "hatching.pen says the colour");
        idle.key("hatching.width", "the nib of hatching.pen is the width");
    }
    if hatching.has_one_width() {
        for key in ["tone", "taper", "min_width"] {
            idle.key(&format!("hatching.stroke.{key}"), "strokes have one width");
        }
    }
    if !hatching.is_lit() {
        for key in ["ambient", "light"] {
            idle.key(&format!("hatching.stroke.{key}"), "nothing of the strokes shows the light");
        }
    }
    if hatching.cross.is_none() {
        idle.key("hatching.cross_length", "no stroke is crossed");
    }
    if hatching.seeds == SeedsBy::Dense {
        for key in ["measure", "min_curvature", "min_gradient", "seed"] {
            idle.key(&format!("hatching.{key}"), "every cell has a seed");
        }
    }
    if hatching.directions.rule == DirectionRule::Raw {
        for key in ["gap", "noise", "agree"] {
            idle.key(&format!("hatching.directions.{key}"), "rule = \"raw\" takes every direction");
        }
    }
}
