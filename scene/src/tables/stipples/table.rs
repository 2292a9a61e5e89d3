//! The description of `[stipples]`.

use super::kinds::{DotColors, PointsPerPixelKind, ThresholdKind};
use super::{
    Even, FactorRange, Ink, Snap, StippleGradient, StippleOrder, Stipples,
    curves::CURVES,
    factors::{BOUNDARY, DISTANCE, INTERIOR, LIGHTING, RESOLUTION, SILHOUETTE},
};
use crate::document::describe::{Key, Slot, Table};
use crate::document::kind::{Bounds, Choice, ChoiceOption, Flag, Lengths, On, TableOf, Text, Whole};
use crate::tables::surface::IsoKind;

/// The description of `[stipples]`.
pub(crate) static TABLE: Table<Stipples> = Table::new(
        "[stipples]",
        "Volume stippling: points on the volume's boundaries, made once, of which each frame draws as many as the \
         factors below say. A factor without a table is 1.",
        Stipples::default,
        &[
            Key::new(
                "threshold",
                "STIP-4",
                "‖∇V‖ above which a voxel gets points; a quantile is one of ‖g‖ over the voxels with a normal.",
                &Slot { kind: ThresholdKind, get: |s: &Stipples| Some(s.threshold), set: |s, v| s.threshold = v },
            ),
            Key::new(
                "k_max",
                "STIP-3",
                "Points of a voxel for each pixel, or square of side `size`, of its projection; \"auto\": as many as print a \
                 coverage of 0.9 where all factors are 1 (STIP-17).",
                &Slot { kind: PointsPerPixelKind, get: |s: &Stipples| Some(s.k_max), set: |s, v| s.k_max = v },
            ),
            Key::new(
                "size",
                "STIP-6",
                "S_max, the diameter of the largest dots.",
                &Slot {
                    kind: Lengths { on: On::Page, bounds: Bounds::POSITIVE },
                    get: |s: &Stipples| Some(s.size),
                    set: |s, v| s.size = v,
                },
            ),
            Key::new(
                "seed",
                "RAY-4",
                "Key of the random numbers.",
                &Slot {
                    kind: Whole { lo: 0, hi: i64::MAX as u64 },
                    get: |s: &Stipples| Some(s.seed),
                    set: |s, v| s.seed = v,
                },
            ),
            Key::new(
                "box",
                "STIP-2",
                "Voxels along the side of the boxes that points are made in; an axis has two boxes at least. Larger ones have \
                 more dots each, and show patterns; smaller ones keep what is thin.",
                &Slot {
                    kind: Whole { lo: 1, hi: 1 << 20 },
                    get: |s: &Stipples| s.box_side,
                    set: |s, v| s.box_side = Some(v),
                },
            )
            .absent("as many as a projection of 5×5 pixels, or squares of side `size`, asks for"),
            Key::new(
                "color",
                "STIP-16",
                "What the dots are drawn in. `\"transfer\"`: the colour of `[transfer]` at their voxel's value, of a style \
                 where it faces the eye; `\"label\"`: that of their label's row. With `[[pen]]` each dot goes to the pen of \
                 the nearest colour; without, to one of at most 16 layers.",
                &Slot { kind: DotColors, get: |s: &Stipples| Some(s.color), set: |s, v| s.color = v },
            ),
            Key::new(
                "pen",
                "STIP-6",
                "The pen of `[[pen]]` that draws: dots have its colour and its nib's size, and where they should be smaller there are fewer.",
                &Slot {
                    kind: Text { what: "the name of a pen" },
                    get: |s: &Stipples| s.pen.clone(),
                    set: |s, v| s.pen = Some(v),
                },
            )
            .absent("`color`, in dots of any size"),
            Key::new(
                "gradient",
                "STIP-1",
                "How V and ∇V of a voxel are estimated.",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new(
                                "regression",
                                StippleGradient::Regression,
                                "A linear fit to the 3×3×3 voxels around it.",
                            ),
                            ChoiceOption::new(
                                "central",
                                StippleGradient::Central,
                                "Central differences, and the voxel's own value.",
                            ),
                        ],
                        later: &[],
                    },
                    get: |s: &Stipples| Some(s.gradient),
                    set: |s, v| s.gradient = v,
                },
            ),
            Key::new(
                "slab",
                "STIP-4",
                "How far from the tangent plane through the voxel's centre points that do not snap may lie.",
                &Slot {
                    kind: Lengths { on: On::World, bounds: Bounds::NOT_NEGATIVE },
                    get: |s: &Stipples| Some(s.slab),
                    set: |s, v| s.slab = v,
                },
            ),
            Key::new(
                "order",
                "STIP-4",
                "Which points are seen when a voxel's are spread and put in order.",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new(
                                "neighbours",
                                StippleOrder::Neighbours,
                                "Its own and those of the 26 voxels around it.",
                            ),
                            ChoiceOption::new("voxel", StippleOrder::Voxel, "Its own: the paper's."),
                        ],
                        later: &[],
                    },
                    get: |s: &Stipples| Some(s.order),
                    set: |s, v| s.order = v,
                },
            ),
            Key::new(
                "snap",
                "STIP-4",
                "Whether points leave their voxel for the edge.",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new("none", Snap::None, "They stay in the voxel: the paper's."),
                            ChoiceOption::new(
                                "edge",
                                Snap::Edge,
                                "They lie where ‖∇V‖ is largest along the normal within one voxel: no stairs on \
                                 oblique faces.",
                            ),
                        ],
                        later: &[],
                    },
                    get: |s: &Stipples| Some(s.snap),
                    set: |s, v| s.snap = v,
                },
            ),
            Key::new(
                "thin",
                "STIP-4",
                "Whether only voxels whose ‖∇V‖ is largest along the normal get points: one layer a face.",
                &Slot { kind: Flag, get: |s: &Stipples| Some(s.thin), set: |s, v| s.thin = v },
            ),
            Key::new(
                "factors",
                "STIP-5",
                "How factors are brought into [0, 1].",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new("clamp", FactorRange::Clamp, "What lies above 1 is 1."),
                            ChoiceOption::new(
                                "normalize",
                                FactorRange::Normalize,
                                "boundary over gc + gs and silhouette over sc + ss, where the sum is above 1.",
                            ),
                        ],
                        later: &[],
                    },
                    get: |s: &Stipples| Some(s.factors),
                    set: |s, v| s.factors = v,
                },
            ),
            Key::new(
                "ink",
                "STIP-5",
                "What becomes of a fraction of a point.",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new("fade", Ink::Fade, "The opacity of the next point: the paper's."),
                            ChoiceOption::new(
                                "opaque",
                                Ink::Opaque,
                                "A whole point in that share of the voxels, for pens and 1-bit print.",
                            ),
                        ],
                        later: &[],
                    },
                    get: |s: &Stipples| Some(s.ink),
                    set: |s, v| s.ink = v,
                },
            ),
            Key::new(
                "hide_behind",
                "STIP-15",
                "An iso-value: points behind that surface are not drawn.",
                &Slot { kind: IsoKind, get: |s: &Stipples| s.hide_behind, set: |s, v| s.hide_behind = Some(v) },
            )
            .absent("points are transparent"),
            Key::new(
                "even",
                "STIP-19",
                "Which points are drawn where there is a choice.",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new(
                                "none",
                                Even::None,
                                "The first of each voxel's list: the paper's, and what moving pictures need.",
                            ),
                            ChoiceOption::new(
                                "page",
                                Even::Page,
                                "Of four times as many those that lie evenly on the page, over all faces that are seen \
                                 there; all are drawn whole.",
                            ),
                        ],
                        later: &[],
                    },
                    get: |s: &Stipples| Some(s.even),
                    set: |s, v| s.even = v,
                },
            ),
            Key::new(
                "boundary",
                "STIP-7",
                "T_b.",
                &Slot { kind: TableOf(&BOUNDARY), get: |s: &Stipples| s.boundary, set: |s, v| s.boundary = Some(v) },
            )
            .absent("1"),
            Key::new(
                "silhouette",
                "STIP-8",
                "T_s.",
                &Slot {
                    kind: TableOf(&SILHOUETTE),
                    get: |s: &Stipples| s.silhouette,
                    set: |s, v| s.silhouette = Some(v),
                },
            )
            .absent("1"),
            Key::new(
                "resolution",
                "STIP-9",
                "T_r.",
                &Slot {
                    kind: TableOf(&RESOLUTION),
                    get: |s: &Stipples| s.resolution,
                    set: |s, v| s.resolution = Some(v),
                },
            )
            .absent("1"),
            Key::new(
                "distance",
                "STIP-10",
                "T_d.",
                &Slot { kind: TableOf(&DISTANCE), get: |s: &Stipples| s.distance, set: |s, v| s.distance = Some(v) },
            )
            .absent("1"),
            Key::new(
                "interior",
                "STIP-11",
                "T_t.",
                &Slot { kind: TableOf(&INTERIOR), get: |s: &Stipples| s.interior, set: |s, v| s.interior = Some(v) },
            )
            .absent("1"),
            Key::new(
                "lighting",
                "STIP-12",
                "T_l.",
                &Slot { kind: TableOf(&LIGHTING), get: |s: &Stipples| s.lighting, set: |s, v| s.lighting = Some(v) },
            )
            .absent("1"),
            Key::new(
                "curves",
                "STIP-13",
                "Silhouette curves.",
                &Slot { kind: TableOf(&CURVES), get: |s: &Stipples| s.curves, set: |s, v| s.curves = Some(v) },
            )
            .absent("no curves"),
        ],
    );
