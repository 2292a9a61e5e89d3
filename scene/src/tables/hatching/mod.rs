//! `[hatching]`: strokes along the lines of curvature of an iso-surface ([HATCH-1] … [HATCH-21]).

mod directions;
mod lighting;
mod presets;
mod stroke;
mod table;

pub use directions::{DirectionRule, DirectionSource, Directions, Interpolate, Reference, StoredAt};
pub use lighting::LineLighting;
pub(crate) use presets::HatchPreset;
pub use stroke::StrokeStyle;
pub(crate) use table::TABLE;

use crate::color::Rgba;
use crate::tables::{Iso, Length};

/// The table `[hatching]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Hatching {
    /// Of which surface.
    pub iso: HatchIso,
    /// Of a stroke, in the world ([HATCH-8]).
    pub length: Length,
    /// The most that a step may err by, in the world ([HATCH-8]).
    pub tolerance: Length,
    /// Which cells strokes begin in ([HATCH-6]).
    pub seeds: SeedsBy,
    /// Key of the random numbers ([RAY-4]).
    pub seed: u64,
    /// The angle between normal and light beyond which a second stroke crosses the first, in degrees ([HATCH-11]); none:
    /// no stroke is crossed.
    pub cross: Option<f64>,
    /// Its length, as a share of `length`.
    pub cross_length: f64,
    /// Of the widest strokes, on the page ([HATCH-13]).
    pub width: Length,
    /// Linear, straight.
    pub color: Rgba,
    /// A pen of `[[pen]]`, which draws in place of `width` and `color`.
    pub pen: Option<String>,
    /// The pen that draws what crosses.
    pub cross_pen: Option<String>,
    /// What a seed's κ is ([HATCH-5], [HATCH-6]).
    pub measure: Measure,
    /// C₀ ([HATCH-6]).
    pub min_curvature: f64,
    /// C₁ ([HATCH-6]).
    pub min_gradient: f64,
    /// Which of the two directions strokes follow ([HATCH-8]).
    pub family: Family,
    /// How far a stroke may turn from its first direction, in degrees ([HATCH-8]).
    pub max_angle: f64,
    /// The smallest step, in the world ([HATCH-8]).
    pub min_step: Length,
    /// δ, how far strokes lie before the surface, in the world ([HATCH-7]).
    pub offset: Length,
    /// c, the most that straight segments may leave the stroke by, in the world ([HATCH-10]).
    pub chord: Length,
    /// Whether vector files have cubic Béziers in place of straight segments ([HATCH-10]).
    pub beziers: bool,
    /// How far strokes are apart on the page ([HATCH-19]).
    pub spacing: Spacing,
    /// How far on the page strokes stay from a nearer line that crosses them ([HATCH-20]); none: they do not.
    pub gap: Option<Length>,
    /// How much nearer it has to be, in the world.
    pub gap_depth: Length,
    /// What becomes of what a surface hides ([HATCH-14]).
    pub hidden: Hidden,
    /// What it looks like ([HATCH-13]); `stroke` goes over it.
    pub style: HatchStyle,
    /// How a stroke is drawn ([HATCH-13]).
    pub stroke: StrokeStyle,
    /// Where directions come from ([HATCH-3], [HATCH-4]).
    pub directions: Directions,
    /// Light on the strokes ([HATCH-12]); none: they have one colour.
    pub lighting: Option<LineLighting>,
}

/// `iso` ([HATCH-16]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HatchIso {
    /// Strokes lie on one surface.
    Surface(Iso),
    /// They lie wherever the transfer function shows something, each on the surface through its seed.
    Transfer,
}

/// `seeds` ([HATCH-6]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SeedsBy {
    /// By chance, the more the more the surface bends and the steeper it is.
    Curvature,
    /// Every cell of the surface.
    Dense,
}

/// `measure` ([HATCH-6]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// |κ₁ + κ₂|/2, the paper's.
    Mean,
    /// √((κ₁² + κ₂²)/2), which minimal surfaces have, too.
    Curvedness,
}

/// `family` ([HATCH-8]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// That of the larger |κ| at the seed.
    Larger,
    /// That of κ₁, the larger by value.
    Max,
    /// That of κ₂.
    Min,
}

/// `hidden` ([HATCH-14]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hidden {
    /// It is cut off.
    Cut,
    /// It is drawn: strokes alone, seen from both sides, the nearer ones over the others.
    Drawn,
    /// It is seen through what lies before it: strokes are inside the picture of the volume, at their depths.
    Merged,
}

/// `style` ([HATCH-13]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HatchStyle {
    /// As wide as the shade is dark, with thin ends.
    Ink,
    /// As dense as the shade is dark, on grainy paper.
    Pencil,
    /// As wide as the shade is dark, with blunt ends.
    Engraving,
}

/// `spacing` ([HATCH-19]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spacing {
    /// As the seeds fall: the paper's.
    Random,
    /// A pen's width over the tone.
    Tone,
    /// The same everywhere, on the page.
    Length(Length),
}

impl Default for Hatching {
    fn default() -> Self {
        Self {
            iso: HatchIso::Surface(Iso::Auto),
            length: Length::Voxels(40.0),
            tolerance: Length::Voxels(0.01),
            seeds: SeedsBy::Curvature,
            seed: 1,
            cross: None,
            cross_length: 0.5,
            width: Length::Millimetres(0.25),
            color: [0.0, 0.0, 0.0, 1.0],
            pen: None,
            cross_pen: None,
            measure: Measure::Mean,
            min_curvature: 0.02,
            min_gradient: 0.05,
            family: Family::Larger,
            max_angle: 90.0,
            min_step: Length::Voxels(0.01),
            offset: Length::Voxels(0.15),
            chord: Length::Voxels(0.1),
            beziers: false,
            spacing: Spacing::Random,
            gap: None,
            gap_depth: Length::Voxels(2.0),
            hidden: Hidden::Cut,
            style: HatchStyle::Ink,
            stroke: StrokeStyle::default(),
            directions: Directions::default(),
            lighting: None,
        }
    }
}
