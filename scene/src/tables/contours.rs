//! `[contours]`: style contours of controlled thickness ([STF-6] … [STF-8]).

use crate::document::describe::{Key, Slot, Table};
use crate::document::kind::{Bounds, Choice, ChoiceOption, Lengths, Number, Numbers, On, Rule};
use crate::quantity::Quantity;
use crate::tables::{Length, Scene};

/// The table `[contours]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Contours {
    /// T.
    pub thickness: Length,
    /// κ_v.
    pub kappa: Kappa,
    /// What a flipped normal counts as, with `normal = "facing"` ([STF-5]).
    pub sign_flip: SignFlip,
    /// lo and hi, of |g|, between which contours fade in; none: no fade ([STF-7]).
    pub fade: Option<[f64; 2]>,
}

/// Which κ_v ([STF-6]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kappa {
    /// From two normals along the ray; the paper's.
    Ray,
    /// From the Hessian ([CUR-2]).
    Exact,
    /// No curvature: a constant threshold.
    None {
        /// τ.
        threshold: f64,
    },
}

/// The angle between two normals ([STF-5]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SignFlip {
    /// Between the lines that they span.
    TwoSided,
    /// Between the normals.
    Literal,
}

impl Default for Contours {
    fn default() -> Self {
        Self { thickness: Length::Voxels(2.0), kappa: Kappa::Ray, sign_flip: SignFlip::TwoSided, fade: None }
    }
}

/// `kappa` without what belongs to each.
#[derive(Clone, Copy, PartialEq)]
enum KappaName {
    Ray,
    Exact,
    None,
}

/// τ of `kappa = "none"` where the scene gives none.
const THRESHOLD: f64 = 0.3;

/// The κ_v of a scene that measures one ([STF-6]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measured {
    /// From two normals along the ray.
    AlongRay,
    /// From the Hessian.
    Exact,
}

/// The κ_v that a layer of curvature shows: that of `[contours]`, and the one along the ray where the scene has no
/// table or no κ.
pub fn measured_curvature(scene: &Scene) -> Measured {
    match scene.contours.as_ref().map(|contours| contours.kappa) {
        Some(Kappa::Exact) => Measured::Exact,
        Some(Kappa::Ray | Kappa::None { .. }) | None => Measured::AlongRay,
    }
}

/// The description of `[contours]`.
pub(crate) static TABLE: Table<Contours> = Table::new(
    "[contours]",
    "Style contours of controlled thickness. They act on a transfer function of styles.",
    Contours::default,
    &[
        Key::new(
            "thickness",
            "STF-7",
            "T, the width of a contour.",
            &Slot {
                kind: Lengths { on: On::World, bounds: Bounds::NOT_NEGATIVE },
                get: |c: &Contours| Some(c.thickness),
                set: |c, v| c.thickness = v,
            },
        ),
        Key::new(
            "kappa",
            "STF-6",
            "The curvature along the view that thickness is controlled by.",
            &Slot {
                kind: Choice {
                    options: &[
                        ChoiceOption::new("ray", KappaName::Ray, "From two normals along the ray."),
                        ChoiceOption::new("exact", KappaName::Exact, "From the Hessian."),
                        ChoiceOption::new("none", KappaName::None, "None: a constant threshold."),
                    ],
                    later: &[],
                },
                get: |c: &Contours| {
                    Some(match c.kappa {
                        Kappa::Ray => KappaName::Ray,
                        Kappa::Exact => KappaName::Exact,
                        Kappa::None { .. } => KappaName::None,
                    })
                },
                set: |c, name| {
                    c.kappa = match name {
                        KappaName::Ray => Kappa::Ray,
                        KappaName::Exact => Kappa::Exact,
                        KappaName::None => Kappa::None { threshold: THRESHOLD },
                    }
                },
            },
        )
        .needs(&[Quantity::PreviousNormal, Quantity::Hessian]),
        Key::new(
            "threshold",
            "STF-6",
            "τ of kappa = \"none\": |N·v| up to which a contour reaches.",
            &Slot {
                kind: Number { bounds: Bounds::UNIT, unit: "" },
                get: |c: &Contours| match c.kappa {
                    Kappa::None { threshold } => Some(threshold),
                    Kappa::Ray | Kappa::Exact => None,
                },
                set: |c, v| {
                    if let Kappa::None { threshold } = &mut c.kappa {
                        *threshold = v;
                    }
                },
            },
        )
        .absent("0.3 with kappa = \"none\""),
        Key::new(
            "sign_flip",
            "STF-5",
            "What a flipped normal counts as, with kappa = \"ray\" and sampling.normal = \"facing\".",
            &Slot {
                kind: Choice {
                    options: &[
                        ChoiceOption::new("two-sided", SignFlip::TwoSided, "The angle between lines."),
                        ChoiceOption::new("literal", SignFlip::Literal, "The plain angle."),
                    ],
                    later: &[],
                },
                get: |c: &Contours| Some(c.sign_flip),
                set: |c, v| c.sign_flip = v,
            },
        ),
        Key::new(
            "fade",
            "STF-7",
            "lo and hi, of |g|, between which contours fade in.",
            &Slot {
                kind: Numbers { what: "a range [lo, hi]", bounds: Bounds::ANY, rule: Rule::Ascending },
                get: |c: &Contours| c.fade,
                set: |c, v| c.fade = Some(v),
            },
        )
        .absent("no fade")
        .needs(&[Quantity::GradientMagnitudeRange]),
    ],
);
