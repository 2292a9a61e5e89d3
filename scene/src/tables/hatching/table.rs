//! The description of `[hatching]`.

use super::directions::DIRECTIONS;
use super::lighting::LIGHTING;
use super::stroke::STROKE;
use super::{Directions, LineLighting, StrokeStyle};
use crate::color::Rgba;
use crate::document::check::Check;
use crate::document::declare::{choices, table};
use crate::document::describe::{Kind, Shape, Table};
use crate::document::item::Item;
use crate::document::kind::{Bounds, Colors, End, Flag, Lengths, Number, On, TableOf, Text, WORLD_LENGTH, Whole};
use crate::document::out::Out;
use crate::strokes::Measure;
use crate::tables::surface::IsoKind;
use crate::tables::{Iso, Length};
use serde_json::{Value as Json, json};

table! {
    /// The table `[hatching]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Hatching {
        /// The value of the surface; by itself that which an automatic transfer function makes opaque. "transfer":
        /// strokes wherever [transfer] shows something, as opaque as that, each on the surface through its seed.
        iso: HatchIso = HatchIso::Surface(Iso::Auto), key("HATCH-6", HatchIsoKind);
        /// Length of a stroke.
        ///
        /// In the world.
        length: Length = Length::Voxels(40.0), key("HATCH-8", WORLD_LENGTH);
        /// Largest error of a step of the integration.
        ///
        /// In the world.
        tolerance: Length = Length::Voxels(0.01), key("HATCH-8", WORLD_LENGTH);
        /// In which cells of the surface strokes begin.
        seeds: SeedsBy = SeedsBy::Curvature, key("HATCH-6", SeedsBy::KIND);
        /// Key of the random numbers.
        seed: u64 = 1, key("RAY-4", Whole { lo: 0, hi: i64::MAX as u64 });
        /// The angle between normal and light beyond which a second stroke crosses the first; where the tone is in the
        /// spacing, a tone above 0.6 does.
        ///
        /// In degrees.
        cross: Option<f64> = None, key("HATCH-11", ANGLE).absent("no stroke is crossed");
        /// Its length, as a share of `length`.
        cross_length: f64 = 0.5, key("HATCH-11", SHARE);
        /// Width of the widest strokes.
        ///
        /// In mm or px.
        width: Length = Length::Millimetres(0.25), key("HATCH-13", PAGE_LENGTH);
        /// Colour of the strokes.
        ///
        /// Linear, straight.
        color: Rgba = [0.0, 0.0, 0.0, 1.0], key("HATCH-13", Colors);
        /// The pen of `[[pen]]` that draws the strokes: its nib is their width.
        pen: Option<String> = None,
            key("HATCH-13", Text { what: "the name of a pen" }).absent("`color`, in strokes of any width");
        /// The pen of `[[pen]]` that draws what crosses.
        cross_pen: Option<String> = None,
            key("HATCH-11", Text { what: "the name of a pen" })
                .absent("what draws the others; without a `pen` a layer of its own, `cross`");
        /// The κ in p, times the smallest spacing and at most 1.
        measure: Measure = Measure::Mean, key("HATCH-6", Measure::KIND);
        /// C₀: p = 0 where κ is not above it.
        min_curvature: f64 = 0.02, key("HATCH-6", SHARE);
        /// C₁: p = 0 where |∇| is not above it.
        min_gradient: f64 = 0.05, key("HATCH-6", SHARE);
        /// Which of the two directions a stroke follows, from end to end.
        family: Family = Family::Larger, key("HATCH-8", Family::KIND);
        /// The largest turn of a stroke from its first direction; 180 is any way.
        ///
        /// In degrees.
        max_angle: f64 = 90.0, key("HATCH-8", TURN);
        /// The smallest step; a stroke that needs a smaller one ends.
        ///
        /// In the world.
        min_step: Length = Length::Voxels(0.01), key("HATCH-8", WORLD_LENGTH);
        /// δ, how far strokes lie before the surface.
        ///
        /// In the world.
        offset: Length = Length::Voxels(0.15), key("HATCH-7", NOT_NEGATIVE);
        /// c, the most that straight segments may leave a stroke by.
        ///
        /// In the world.
        chord: Length = Length::Voxels(0.1), key("HATCH-10", WORLD_LENGTH);
        /// Whether SVG and PDF have all lines of the page as cubic Béziers, smooth through the ends of their straight
        /// segments, instead of these.
        beziers: bool = false, key("HATCH-10", Flag);
        /// Distance of strokes on the page: as their seeds fall; so far that their width over it is the tone; or
        /// the same everywhere. On the mean: two may come as near as 0.6 of it.
        spacing: Spacing = Spacing::Random, key("HATCH-19", SpacingKind);
        /// Distance at which strokes end before a nearer line that crosses them, from middle to middle; outlines of the
        /// same page count, and are not cut themselves.
        ///
        /// In mm or px.
        gap: Option<Length> = None, key("HATCH-20", PAGE_LENGTH).absent("no gaps");
        /// How much nearer to the eye that line has to be.
        ///
        /// In the world.
        gap_depth: Length = Length::Voxels(2.0), key("HATCH-20", NOT_NEGATIVE);
        /// Treatment of the parts of strokes that a surface hides.
        hidden: Hidden = Hidden::Cut, key("HATCH-14", Hidden::KIND);
        /// Look of strokes; the keys of [hatching.stroke] go over it.
        style: HatchStyle = HatchStyle::Ink, key("HATCH-13", HatchStyle::KIND);
        /// How a stroke is drawn.
        stroke: StrokeStyle = StrokeStyle::default(), key("HATCH-13", TableOf(&STROKE));
        /// Directions on surfaces.
        directions: Directions = Directions::default(), key("HATCH-3", TableOf(&DIRECTIONS));
        /// Light on the strokes, in two colours.
        lighting: Option<LineLighting> = None, key("HATCH-12", TableOf(&LIGHTING)).absent("`color` everywhere");
    }
}

/// `iso` ([HATCH-16]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HatchIso {
    /// Strokes lie on one surface.
    Surface(Iso),
    /// They lie wherever the transfer function shows something, each on the surface through its seed.
    Transfer,
}

choices! {
    /// `seeds` ([HATCH-6]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum SeedsBy {
        /// By chance: p = ½(κ + |∇|), of their 2×2×2 cells.
        Curvature = "curvature",
        /// In every one.
        Dense = "dense",
    }
}

choices! {
    /// `family` ([HATCH-8]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Family {
        /// That of the larger |κ| where it begins.
        Larger = "larger",
        /// That of the larger κ, by value.
        Max = "max",
        /// That of the smaller κ.
        Min = "min",
    }
}

choices! {
    /// `hidden` ([HATCH-14]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Hidden {
        /// It is cut off.
        Cut = "cut",
        /// It is drawn, too: the nearer strokes over the others, as in Fig. 5.
        Drawn = "drawn",
        /// It is seen as far as what lies before it lets light through: strokes are inside the picture of the volume,
        /// each at its depth.
        Merged = "merged",
    }
}

choices! {
    /// `style` ([HATCH-13]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum HatchStyle {
        /// Width follows the darkness of the shade; thin ends.
        Ink = "ink",
        /// Density follows the darkness of the shade, on grainy paper: opacity τ times a random grain.
        Pencil = "pencil",
        /// Width follows the darkness of the shade; blunt ends.
        Engraving = "engraving",
    }
}

/// `spacing` ([HATCH-19]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spacing {
    /// Left to the seeds: the paper's.
    Random,
    /// A pen's width over the tone.
    Tone,
    /// One distance everywhere, on the page.
    Length(Length),
}

/// Degrees of an angle between two directions.
const ANGLE: Number = Number { bounds: Bounds::between(0.0, 180.0), unit: ", in degrees" };
const TURN: Number = Number { bounds: Bounds { lo: End::Out(0.0), hi: End::In(180.0) }, unit: ", in degrees" };
const SHARE: Number = Number { bounds: Bounds::UNIT, unit: "" };
const PAGE_LENGTH: Lengths = Lengths { on: On::Page, bounds: Bounds::POSITIVE };
pub(super) const NOT_NEGATIVE: Lengths = Lengths { on: On::World, bounds: Bounds::NOT_NEGATIVE };

/// A value of the volume, or what is in place of one.
struct HatchIsoKind;

const TRANSFER: &str = "transfer";

impl Shape for HatchIsoKind {
    fn expected(&self) -> String {
        format!("{}, or \"{TRANSFER}\"", IsoKind.expected().replace(", or", ","))
    }

    fn schema(&self) -> Json {
        json!({ "anyOf": [IsoKind.schema(), { "const": TRANSFER }] })
    }
}

impl Kind for HatchIsoKind {
    type Of = HatchIso;

    fn read(&self, item: &Item, check: &mut Check) -> Option<HatchIso> {
        match (item.text(), item.number()) {
            (Some(TRANSFER), _) => Some(HatchIso::Transfer),
            (Some("auto"), _) | (_, Some(_)) => IsoKind.read(item, check).map(HatchIso::Surface),
            _ => check.wrong(item, self.expected()),
        }
    }

    fn write(&self, value: &HatchIso) -> Out {
        match value {
            HatchIso::Surface(iso) => IsoKind.write(iso),
            HatchIso::Transfer => Out::Text(TRANSFER.into()),
        }
    }
}

/// A length on the page, or what is in place of one.
struct SpacingKind;

const WORDS: [(&str, Spacing); 2] = [("random", Spacing::Random), ("tone", Spacing::Tone)];

impl Shape for SpacingKind {
    fn expected(&self) -> String {
        format!("\"random\", \"tone\", or {}", PAGE_LENGTH.expected())
    }

    fn schema(&self) -> Json {
        json!({ "anyOf": [{ "enum": WORDS.map(|(word, _)| word) }, PAGE_LENGTH.schema()] })
    }
}

impl Kind for SpacingKind {
    type Of = Spacing;

    fn read(&self, item: &Item, check: &mut Check) -> Option<Spacing> {
        let text = item.text();
        match WORDS.iter().find(|(word, _)| text == Some(word)) {
            Some((_, spacing)) => Some(*spacing),
            None => PAGE_LENGTH.read_as(item, check, self.expected()).map(Spacing::Length),
        }
    }

    fn write(&self, value: &Spacing) -> Out {
        match value {
            Spacing::Length(length) => PAGE_LENGTH.write(length),
            word => Out::Text(WORDS.iter().find(|(_, w)| w == word).map_or("", |(word, _)| word).into()),
        }
    }
}

/// The description of `[hatching]`.
pub(crate) static TABLE: Table<Hatching> = Hatching::description(
    "[hatching]",
    "Strokes along the lines of curvature of an iso-surface. What the surface of [surface], or else their own, hides is \
         not drawn.",
);
