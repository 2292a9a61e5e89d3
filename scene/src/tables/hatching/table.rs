//! The description of `[hatching]`.

use super::directions::DIRECTIONS;
use super::lighting::LIGHTING;
use super::stroke::STROKE;
use super::{Family, HatchIso, HatchStyle, Hatching, Hidden, Measure, SeedsBy, Spacing};
use crate::document::check::Check;
use crate::document::describe::{Key, Kind, Shape, Slot, Table};
use crate::document::item::Item;
use crate::document::kind::{
    Bounds, Choice, ChoiceOption, Colors, End, Flag, Lengths, Number, On, TableOf, Text, WORLD_LENGTH, Whole,
};
use crate::document::out::Out;
use crate::tables::surface::IsoKind;
use serde_json::{Value as Json, json};

/// Degrees of an angle between two directions.
const ANGLE: Number = Number { bounds: Bounds::between(0.0, 180.0), unit: ", in degrees" };
const TURN: Number = Number { bounds: Bounds { lo: End::Out(0.0), hi: End::In(180.0) }, unit: ", in degrees" };
const SHARE: Number = Number { bounds: Bounds::UNIT, unit: "" };
const PAGE_LENGTH: Lengths = Lengths { on: On::Page, bounds: Bounds::POSITIVE };
const NOT_NEGATIVE: Lengths = Lengths { on: On::World, bounds: Bounds::NOT_NEGATIVE };

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
pub(crate) static TABLE: Table<Hatching> = Table::new(
        "[hatching]",
        "Strokes along the lines of curvature of an iso-surface. What the surface of [surface], or else their own, hides is \
         not drawn.",
        Hatching::default,
        &[
            Key::new(
                "iso",
                "HATCH-6",
                "The value of the surface; by itself that which an automatic transfer function makes opaque. \"transfer\": \
                 strokes wherever [transfer] shows something, as opaque as that, each on the surface through its seed.",
                &Slot { kind: HatchIsoKind, get: |h: &Hatching| Some(h.iso), set: |h, v| h.iso = v },
            ),
            Key::new(
                "length",
                "HATCH-8",
                "Of a stroke.",
                &Slot { kind: WORLD_LENGTH, get: |h: &Hatching| Some(h.length), set: |h, v| h.length = v },
            ),
            Key::new(
                "tolerance",
                "HATCH-8",
                "How far a step of the integration may miss.",
                &Slot { kind: WORLD_LENGTH, get: |h: &Hatching| Some(h.tolerance), set: |h, v| h.tolerance = v },
            ),
            Key::new(
                "seeds",
                "HATCH-6",
                "In which cells of the surface strokes begin.",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new(
                                "curvature",
                                SeedsBy::Curvature,
                                "By chance: p = ½(κ + |∇|), of their 2×2×2 cells.",
                            ),
                            ChoiceOption::new("dense", SeedsBy::Dense, "In every one."),
                        ],
                        later: &[],
                    },
                    get: |h: &Hatching| Some(h.seeds),
                    set: |h, v| h.seeds = v,
                },
            ),
            Key::new(
                "seed",
                "RAY-4",
                "Key of the random numbers.",
                &Slot {
                    kind: Whole { lo: 0, hi: i64::MAX as u64 },
                    get: |h: &Hatching| Some(h.seed),
                    set: |h, v| h.seed = v,
                },
            ),
            Key::new(
                "cross",
                "HATCH-11",
                "The angle between normal and light beyond which a second stroke crosses the first; where the tone is in the \
                 spacing, a tone above 0.6 does.",
                &Slot { kind: ANGLE, get: |h: &Hatching| h.cross, set: |h, v| h.cross = Some(v) },
            )
            .absent("no stroke is crossed"),
            Key::new(
                "cross_length",
                "HATCH-11",
                "Its length, as a share of `length`.",
                &Slot { kind: SHARE, get: |h: &Hatching| Some(h.cross_length), set: |h, v| h.cross_length = v },
            ),
            Key::new(
                "width",
                "HATCH-13",
                "Of the widest strokes.",
                &Slot { kind: PAGE_LENGTH, get: |h: &Hatching| Some(h.width), set: |h, v| h.width = v },
            ),
            Key::new(
                "color",
                "HATCH-13",
                "Of the strokes.",
                &Slot { kind: Colors, get: |h: &Hatching| Some(h.color), set: |h, v| h.color = v },
            ),
            Key::new(
                "pen",
                "HATCH-13",
                "The pen of `[[pen]]` that draws the strokes: its nib is their width.",
                &Slot {
                    kind: Text { what: "the name of a pen" },
                    get: |h: &Hatching| h.pen.clone(),
                    set: |h, v| h.pen = Some(v),
                },
            )
            .absent("`color`, in strokes of any width"),
            Key::new(
                "cross_pen",
                "HATCH-11",
                "The pen of `[[pen]]` that draws what crosses.",
                &Slot {
                    kind: Text { what: "the name of a pen" },
                    get: |h: &Hatching| h.cross_pen.clone(),
                    set: |h, v| h.cross_pen = Some(v),
                },
            )
            .absent("what draws the others; without a `pen` a layer of its own, `cross`"),
            Key::new(
                "measure",
                "HATCH-6",
                "What κ of p is, times the smallest spacing and at most 1.",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new("mean", Measure::Mean, "|κ₁ + κ₂|/2: the paper's."),
                            ChoiceOption::new(
                                "curvedness",
                                Measure::Curvedness,
                                "√((κ₁² + κ₂²)/2), which minimal surfaces have, too.",
                            ),
                        ],
                        later: &[],
                    },
                    get: |h: &Hatching| Some(h.measure),
                    set: |h, v| h.measure = v,
                },
            ),
            Key::new(
                "min_curvature",
                "HATCH-6",
                "C₀: p = 0 where κ is not above it.",
                &Slot { kind: SHARE, get: |h: &Hatching| Some(h.min_curvature), set: |h, v| h.min_curvature = v },
            ),
            Key::new(
                "min_gradient",
                "HATCH-6",
                "C₁: p = 0 where |∇| is not above it.",
                &Slot { kind: SHARE, get: |h: &Hatching| Some(h.min_gradient), set: |h, v| h.min_gradient = v },
            ),
            Key::new(
                "family",
                "HATCH-8",
                "Which of the two directions a stroke follows, from end to end.",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new("larger", Family::Larger, "That of the larger |κ| where it begins."),
                            ChoiceOption::new("max", Family::Max, "That of the larger κ, by value."),
                            ChoiceOption::new("min", Family::Min, "That of the smaller κ."),
                        ],
                        later: &[],
                    },
                    get: |h: &Hatching| Some(h.family),
                    set: |h, v| h.family = v,
                },
            ),
            Key::new(
                "max_angle",
                "HATCH-8",
                "How far a stroke may turn from its first direction; 180 is any way.",
                &Slot { kind: TURN, get: |h: &Hatching| Some(h.max_angle), set: |h, v| h.max_angle = v },
            ),
            Key::new(
                "min_step",
                "HATCH-8",
                "The smallest step; a stroke that needs a smaller one ends.",
                &Slot { kind: WORLD_LENGTH, get: |h: &Hatching| Some(h.min_step), set: |h, v| h.min_step = v },
            ),
            Key::new(
                "offset",
                "HATCH-7",
                "δ, how far strokes lie before the surface.",
                &Slot { kind: NOT_NEGATIVE, get: |h: &Hatching| Some(h.offset), set: |h, v| h.offset = v },
            ),
            Key::new(
                "chord",
                "HATCH-10",
                "c, the most that straight segments may leave a stroke by.",
                &Slot { kind: WORLD_LENGTH, get: |h: &Hatching| Some(h.chord), set: |h, v| h.chord = v },
            ),
            Key::new(
                "beziers",
                "HATCH-10",
                "Whether SVG and PDF have all lines of the page as cubic Béziers, smooth through the ends of their straight \
                 segments, instead of these.",
                &Slot { kind: Flag, get: |h: &Hatching| Some(h.beziers), set: |h, v| h.beziers = v },
            ),
            Key::new(
                "spacing",
                "HATCH-19",
                "How far strokes are apart on the page: as their seeds fall; so far that their width over it is the tone; or \
                 the same everywhere. On the mean: two may come as near as 0.6 of it.",
                &Slot { kind: SpacingKind, get: |h: &Hatching| Some(h.spacing), set: |h, v| h.spacing = v },
            ),
            Key::new(
                "gap",
                "HATCH-20",
                "How far strokes end before a nearer line that crosses them, from middle to middle; outlines of the same page \
                 count, and are not cut themselves.",
                &Slot { kind: PAGE_LENGTH, get: |h: &Hatching| h.gap, set: |h, v| h.gap = Some(v) },
            )
            .absent("no gaps"),
            Key::new(
                "gap_depth",
                "HATCH-20",
                "How much nearer to the eye that line has to be.",
                &Slot { kind: NOT_NEGATIVE, get: |h: &Hatching| Some(h.gap_depth), set: |h, v| h.gap_depth = v },
            ),
            Key::new(
                "hidden",
                "HATCH-14",
                "What becomes of what a surface hides of strokes.",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new("cut", Hidden::Cut, "It is cut off."),
                            ChoiceOption::new(
                                "drawn",
                                Hidden::Drawn,
                                "It is drawn, too: the nearer strokes over the others, as in Fig. 5.",
                            ),
                            ChoiceOption::new(
                                "merged",
                                Hidden::Merged,
                                "It is seen as far as what lies before it lets light through: strokes are inside the \
                                 picture of the volume, each at its depth.",
                            ),
                        ],
                        later: &[],
                    },
                    get: |h: &Hatching| Some(h.hidden),
                    set: |h, v| h.hidden = v,
                },
            ),
            Key::new(
                "style",
                "HATCH-13",
                "What strokes look like; the keys of [hatching.stroke] go over it.",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new("ink", HatchStyle::Ink, "As wide as the shade is dark, with thin ends."),
                            ChoiceOption::new(
                                "pencil",
                                HatchStyle::Pencil,
                                "As dense as the shade is dark, on grainy paper: opacity τ times a random grain.",
                            ),
                            ChoiceOption::new(
                                "engraving",
                                HatchStyle::Engraving,
                                "As wide as the shade is dark, with blunt ends.",
                            ),
                        ],
                        later: &[],
                    },
                    get: |h: &Hatching| Some(h.style),
                    set: |h, v| h.style = v,
                },
            ),
            Key::new(
                "stroke",
                "HATCH-13",
                "How a stroke is drawn.",
                &Slot { kind: TableOf(&STROKE), get: |h: &Hatching| Some(h.stroke), set: |h, v| h.stroke = v },
            ),
            Key::new(
                "directions",
                "HATCH-3",
                "Where surfaces have directions.",
                &Slot {
                    kind: TableOf(&DIRECTIONS),
                    get: |h: &Hatching| Some(h.directions),
                    set: |h, v| h.directions = v,
                },
            ),
            Key::new(
                "lighting",
                "HATCH-12",
                "Light on the strokes, in two colours.",
                &Slot { kind: TableOf(&LIGHTING), get: |h: &Hatching| h.lighting, set: |h, v| h.lighting = Some(v) },
            )
            .absent("`color` everywhere"),
        ],
    );
