//! Rules of `[hatching]`: needs, keys without effect, knobs; and what other tables mean for strokes.

use super::{Asks, Idle, Ladder, Pass, Rules, Settings};
use crate::plan::Plan;
use crate::tables::{
    DirectionRule, GradientRange, HatchIso, HatchStyle, Hatching, Hidden, Iso, LineLighting, Scene, SeedsBy, Spacing,
    StoredAt,
};

/// The rules of `[hatching]`.
pub(super) const RULES: Rules = Rules {
    asks,
    idle,
    knobs: &[
        ("tolerance", Ladder::to_finest(|_, plan, _| of_strokes(plan, TOLERANCES))),
        ("chord", Ladder::to_finest(|_, plan, _| of_strokes(plan, CHORDS))),
        (
            "directions.rule",
            Ladder::to_finest(|_, plan, _| if plan.has_pass(Pass::Strokes) { DIRECTION_RULES } else { &[] }),
        ),
        ("directions.from", Ladder::to_finest(|_, plan, _| if plan.has_pass(Pass::Strokes) { SOURCES } else { &[] })),
    ],
    ..Rules::new("hatching")
};

/// Settings of `tolerance` and of `chord`.
const TOLERANCES: &[&str] = &["0.1 voxels", "0.03 voxels", "0.01 voxels", "0.003 voxels", "0.001 voxels"];

const CHORDS: &[&str] = &["0.4 voxels", "0.2 voxels", "0.1 voxels", "0.05 voxels", "0.01 voxels"];

fn of_strokes(plan: &Plan, settings: Settings) -> Settings {
    if plan.has_pass(Pass::Strokes) { settings } else { &[] }
}

/// Settings of `rule` and of `from`.
const DIRECTION_RULES: &[&str] = &["raw", "scaled"];

const SOURCES: &[&str] = &["stored", "hessian"];

impl Hatching {
    /// Whether every stroke has one width: the pen's, or the width that the spacing assumes.
    pub fn has_one_width(&self) -> bool {
        self.pen.is_some() || self.spacing != Spacing::Random
    }

    /// Whether strokes read the Hessians of `[sampling]`: those of the default rule have scales of their own ([HATCH-3]).
    pub fn reads_hessians(&self) -> bool {
        self.directions.rule == DirectionRule::Raw
    }

    /// The lighting of strokes; none if strokes have one colour, as with a pen or with tone by spacing.
    pub fn lighting(&self, scene: &Scene) -> Option<LineLighting> {
        self.lighting.filter(|_| !self.has_one_width() && !has_plotter(scene))
    }

    /// a of [HATCH-13].
    pub fn tone(&self) -> f64 {
        self.stroke.tone.unwrap_or(if self.style == HatchStyle::Pencil { 0.0 } else { 1.0 })
    }

    /// b of [HATCH-13].
    pub fn taper(&self) -> f64 {
        self.stroke.taper.unwrap_or(if self.style == HatchStyle::Engraving { 0.0 } else { 0.15 })
    }

    /// Whether the tone sets the opacity of strokes. The opacity of a pen's ink is 1.
    pub fn is_pencil(&self, scene: &Scene) -> bool {
        self.style == HatchStyle::Pencil && !self.has_one_width() && !has_plotter(scene)
    }

    /// Whether strokes are inside the picture of the volume. A plotter draws no picture.
    pub fn is_merged(&self, scene: &Scene) -> bool {
        self.hidden == Hidden::Merged && scene.draws_volume() && !has_plotter(scene)
    }

    /// Whether the light shows in the strokes of a scene.
    pub fn is_lit(&self, scene: &Scene) -> bool {
        self.lighting(scene).is_some()
            || self.spacing == Spacing::Tone
            || self.cross.is_some()
            || (!self.has_one_width() && (self.tone() > 0.0 || self.is_pencil(scene)))
    }
}

/// Whether a plotter draws the page, with one nib and one colour a layer ([HATCH-21]).
fn has_plotter(scene: &Scene) -> bool {
    scene.page.as_ref().is_some_and(|page| page.plotter)
}

/// Asks for passes that run once, and for those of a frame.
fn asks(scene: &Scene, asks: &mut Asks) {
    let Some(hatching) = scene.hatching.as_ref().filter(|_| asks.draws_strokes()) else { return };
    if hatching.iso == HatchIso::Transfer {
        asks.pass(Pass::SeenCells, "strokes in what is seen", "hatching.iso");
    }
    if hatching.iso == HatchIso::Surface(Iso::Auto) {
        asks.pass(Pass::AutomaticIso, "hatching", "hatching.iso");
    }
    asks.pass(Pass::Pyramid, "hatching", "hatching");
    if hatching.seeds == SeedsBy::Curvature {
        asks.pass(Pass::SeedMeasures, "seeds by curvature", "hatching.seeds");
        if matches!(scene.volume.gradient_range, GradientRange::Quantile(_)) {
            asks.pass(Pass::GradientRange, "seeds by curvature", "hatching.seeds");
        }
    }
    let directions = &hatching.directions;
    if directions.is_stored() {
        let key = if directions.smooths() { "smooth" } else { "from" };
        match directions.grid {
            StoredAt::Visited => {
                asks.pass(Pass::StoredDirections, "stored directions", &format!("hatching.directions.{key}"));
            }
            StoredAt::All => asks.pass(Pass::AllDirections, "stored directions", "hatching.directions.grid"),
        }
    }
    asks.pass(Pass::Strokes, "hatching", "hatching.length");
    if hatching.cross.is_some() {
        asks.pass(Pass::CrossStrokes, "cross-hatching", "hatching.cross");
    }
    if hatching.lighting(scene).is_some() {
        asks.pass(Pass::LitStrokes, "lit lines", "hatching.lighting");
    }
    let is_merged = hatching.is_merged(scene) && asks.casts_rays();
    let is_cut = hatching.hidden == Hidden::Cut || (hatching.hidden == Hidden::Merged && !is_merged);
    if is_cut && (scene.surface.is_some() || hatching.iso != HatchIso::Transfer) {
        asks.pass(Pass::HiddenStrokes, "hidden strokes", if scene.surface.is_some() { "surface" } else { "hatching" });
    }
    if is_merged {
        asks.pass(Pass::MergedStrokes, "strokes inside the volume", "hatching.hidden");
    }
    if hatching.gap.is_some() {
        asks.pass(Pass::Gaps, "gaps where lines cross", "hatching.gap");
    }
    if hatching.spacing != Spacing::Random {
        asks.pass(Pass::Spacing, "strokes apart", "hatching.spacing");
    }
}

/// Lists the keys that other keys of the table make idle.
fn idle(scene: &Scene, plan: &Plan, idle: &mut Idle) {
    let Some(hatching) = &scene.hatching else { return };
    if hatching.pen.is_some() {
        idle.key("hatching.color", "hatching.pen says the colour");
        idle.key("hatching.width", "the nib of hatching.pen is the width");
    }
    if hatching.has_one_width() {
        idle.key("hatching.style", "strokes have one width and are opaque");
        for key in ["tone", "taper", "min_width", "depth"] {
            idle.key(&format!("hatching.stroke.{key}"), "strokes have one width");
        }
    }
    if hatching.lighting.is_some() {
        match hatching.lighting(scene) {
            Some(_) => idle.key("hatching.color", "hatching.lighting says the colours"),
            None if hatching.pen.is_some() => idle.key("hatching.lighting", "hatching.pen says the colour"),
            None if hatching.has_one_width() => {
                idle.key("hatching.lighting", "strokes that keep their distance have one colour");
            }
            None => idle.key("hatching.lighting", "a plotter's pen has one colour"),
        }
    }
    if !hatching.is_lit(scene) {
        for key in ["ambient", "light"] {
            idle.key(&format!("hatching.stroke.{key}"), "nothing of the strokes shows the light");
        }
    }
    if hatching.hidden == Hidden::Merged && !plan.has_pass(Pass::MergedStrokes) {
        let why = match hatching.is_merged(scene) {
            true => "the volume itself is not drawn",
            false => "there is no picture of the volume that strokes could be inside: what is hidden is cut off",
        };
        idle.key("hatching.hidden", why);
    }
    if hatching.gap.is_none() {
        idle.key("hatching.gap_depth", "no stroke has gaps");
    }
    if hatching.iso == HatchIso::Transfer {
        idle.key("hatching.offset", "strokes lie on the surfaces through their seeds");
    }
    if hatching.cross.is_none() {
        idle.key("hatching.cross_pen", "no stroke is crossed");
        idle.key("hatching.cross_length", "no stroke is crossed");
    }
    if hatching.seeds == SeedsBy::Dense {
        for key in ["measure", "min_curvature", "min_gradient", "seed"] {
            idle.key(&format!("hatching.{key}"), "every cell has a seed");
        }
    }
    if hatching.iso == HatchIso::Transfer && hatching.directions.smooths() {
        idle.key("hatching.directions.smooth", "there is no one surface along which directions could agree");
    }
    if !hatching.directions.is_stored() {
        for key in ["interpolate", "grid"] {
            idle.key(&format!("hatching.directions.{key}"), "no direction is stored");
        }
    }
    if hatching.directions.rule == DirectionRule::Raw {
        for key in ["gap", "noise", "agree", "deviation"] {
            idle.key(&format!("hatching.directions.{key}"), "rule = \"raw\" takes every direction");
        }
    }
}
