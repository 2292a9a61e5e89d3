//! `[hatching.directions]`: where a stroke's direction comes from ([HATCH-3], [HATCH-4]).

use crate::document::describe::{Key, Slot, Table};
use crate::document::kind::{Bounds, Choice, ChoiceOption, Number, Numbers, Rule};
use glam::DVec3;

/// The table `[hatching.directions]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Directions {
    /// Where there is one ([HATCH-3]).
    pub rule: DirectionRule,
    /// Where a stroke has its direction from ([HATCH-4]).
    pub from: DirectionSource,
    /// What becomes of stored directions between voxels ([HATCH-4]).
    pub interpolate: Interpolate,
    /// At which voxels they are stored ([HATCH-5]).
    pub grid: StoredAt,
    /// What a stroke's first sign follows ([HATCH-4]).
    pub reference: Reference,
    /// a, in world space; none: the volume's longest axis.
    pub axis: Option<DVec3>,
    /// c, in world space; none: the volume's centre.
    pub center: Option<DVec3>,
    /// ε: |κ₁ − κ₂| > ε(|κ₁| + |κ₂|).
    pub gap: f64,
    /// |κ₁ − κ₂|·‖g‖ > noise·q·w.
    pub noise: f64,
    /// The values' standard deviation; none: as it is measured.
    pub deviation: Option<f64>,
    /// The largest angle between the lines at σ and 1.5σ, in degrees.
    pub agree: f64,
}

/// `rule` ([HATCH-3]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DirectionRule {
    /// At the finest of σ = 1, 2, 4 voxels at which the data have one.
    Scaled,
    /// The formula at one scale: the paper's.
    Raw,
}

/// `from` ([HATCH-4]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DirectionSource {
    /// Computed at every place that is asked for.
    Hessian,
    /// Interpolated between those of voxels, which are computed once: the paper's.
    Stored,
}

/// `interpolate` ([HATCH-4]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolate {
    /// The mean of e eᵀ, which has no signs.
    Tensor,
    /// The mean of the directions, each turned to the stroke's own.
    Flipped,
}

/// `grid` ([HATCH-5]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StoredAt {
    /// At the corners of cells that a stroke enters.
    Visited,
    /// At all.
    All,
}

/// `reference` ([HATCH-4]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reference {
    /// a × (x − c).
    Cylindrical,
    /// a.
    Axial,
    /// x − c.
    Radial,
}

impl Default for Directions {
    fn default() -> Self {
        Self {
            rule: DirectionRule::Scaled,
            from: DirectionSource::Hessian,
            interpolate: Interpolate::Tensor,
            grid: StoredAt::Visited,
            reference: Reference::Cylindrical,
            axis: None,
            center: None,
            gap: 0.1,
            noise: 8.0,
            deviation: None,
            agree: 20.0,
        }
    }
}

/// The description of `[hatching.directions]`.
pub(super) static DIRECTIONS: Table<Directions> = Table::new(
    "[hatching.directions]",
    "Where surfaces have principal directions, and which way strokes run along them. With rule = \"scaled\" derivatives are \
     Gaussian, at σ = 1, 2, 4 voxels, and the first σ counts at which the two curvatures differ by more than their share, \
     by more than the data's noise, and the direction is that of 1.5σ, too.",
    Directions::default,
    &[
        Key::new(
            "rule",
            "HATCH-3",
            "Where there is a direction.",
            &Slot {
                kind: Choice {
                    options: &[
                        ChoiceOption::new("scaled", DirectionRule::Scaled, "Where the data have one."),
                        ChoiceOption::new(
                            "raw",
                            DirectionRule::Raw,
                            "The formula with the scene's own derivatives, wherever the curvatures differ at all: the paper's.",
                        ),
                    ],
                    later: &[],
                },
                get: |d: &Directions| Some(d.rule),
                set: |d, v| d.rule = v,
            },
        ),
        Key::new(
            "from",
            "HATCH-4",
            "Where a stroke has its direction from.",
            &Slot {
                kind: Choice {
                    options: &[
                        ChoiceOption::new(
                            "hessian",
                            DirectionSource::Hessian,
                            "The derivatives at every place of it: as exact as they are.",
                        ),
                        ChoiceOption::new(
                            "stored",
                            DirectionSource::Stored,
                            "Between those of voxels, which are made once: the paper's, and faster where strokes are many.",
                        ),
                    ],
                    later: &[],
                },
                get: |d: &Directions| Some(d.from),
                set: |d, v| d.from = v,
            },
        ),
        Key::new(
            "interpolate",
            "HATCH-4",
            "What stored directions make between voxels.",
            &Slot {
                kind: Choice {
                    options: &[
                        ChoiceOption::new(
                            "tensor",
                            Interpolate::Tensor,
                            "The dominant eigenvector of the mean of e eᵀ, which knows no signs; none where the mean has none.",
                        ),
                        ChoiceOption::new(
                            "flipped",
                            Interpolate::Flipped,
                            "The mean of the directions, each with the sign that is nearer to the stroke's own: the paper's.",
                        ),
                    ],
                    later: &[],
                },
                get: |d: &Directions| Some(d.interpolate),
                set: |d, v| d.interpolate = v,
            },
        ),
        Key::new(
            "grid",
            "HATCH-5",
            "At which voxels directions are stored.",
            &Slot {
                kind: Choice {
                    options: &[
                        ChoiceOption::new(
                            "visited",
                            StoredAt::Visited,
                            "At the corners of the cells that strokes enter, when they do, and where seeds are measured.",
                        ),
                        ChoiceOption::new("all", StoredAt::All, "At all, before the first stroke; the strokes are the same."),
                    ],
                    later: &[],
                },
                get: |d: &Directions| Some(d.grid),
                set: |d, v| d.grid = v,
            },
        ),
        Key::new(
            "reference",
            "HATCH-4",
            "Which way strokes run, so that neighbours taper alike.",
            &Slot {
                kind: Choice {
                    options: &[
                        ChoiceOption::new("cylindrical", Reference::Cylindrical, "Around `axis`."),
                        ChoiceOption::new("axial", Reference::Axial, "Along `axis`."),
                        ChoiceOption::new("radial", Reference::Radial, "Away from `center`."),
                    ],
                    later: &[],
                },
                get: |d: &Directions| Some(d.reference),
                set: |d, v| d.reference = v,
            },
        ),
        Key::new(
            "axis",
            "HATCH-4",
            "In world space.",
            &Slot {
                kind: Numbers::<3> { what: "a direction [x, y, z]", bounds: Bounds::ANY, rule: Rule::Direction },
                get: |d: &Directions| d.axis.map(|v| v.to_array()),
                set: |d, v| d.axis = Some(DVec3::from_array(v)),
            },
        )
        .absent("the volume's longest axis"),
        Key::new(
            "center",
            "HATCH-4",
            "In world space.",
            &Slot {
                kind: Numbers::<3> { what: "a point [x, y, z]", bounds: Bounds::ANY, rule: Rule::Free },
                get: |d: &Directions| d.center.map(|v| v.to_array()),
                set: |d, v| d.center = Some(DVec3::from_array(v)),
            },
        )
        .absent("the volume's centre"),
        Key::new(
            "gap",
            "HATCH-3",
            "ε: |κ₁ − κ₂| > ε(|κ₁| + |κ₂|).",
            &Slot {
                kind: Number { bounds: Bounds::BELOW_ONE, unit: "" },
                get: |d: &Directions| Some(d.gap),
                set: |d, v| d.gap = v,
            },
        ),
        Key::new(
            "noise",
            "HATCH-3",
            "How many standard deviations of the data's error |κ₁ − κ₂|·‖g‖ has to be.",
            &Slot {
                kind: Number { bounds: Bounds::NOT_NEGATIVE, unit: "" },
                get: |d: &Directions| Some(d.noise),
                set: |d, v| d.noise = v,
            },
        ),
        Key::new(
            "deviation",
            "HATCH-3",
            "The standard deviation of a value's error. That of rounding to the stored type is the least; with 0 it is all.",
            &Slot {
                kind: Number { bounds: Bounds::NOT_NEGATIVE, unit: ", in the volume's unit" },
                get: |d: &Directions| d.deviation,
                set: |d, v| d.deviation = Some(v),
            },
        )
        .absent("measured on the surface"),
        Key::new(
            "agree",
            "HATCH-3",
            "The largest angle between the lines at σ and at 1.5σ.",
            &Slot {
                kind: Number { bounds: Bounds::between(0.0, 90.0), unit: ", in degrees" },
                get: |d: &Directions| Some(d.agree),
                set: |d, v| d.agree = v,
            },
        ),
    ],
);
