//! `[contours]`: style contours of controlled thickness ([STF-6] … [STF-8]).

use crate::document::declare::{choices, table};
use crate::document::describe::Table;
use crate::document::kind::{Bounds, Lengths, Number, Numbers, On, Rule};
use crate::quantity::Quantity;
use crate::tables::{Length, Scene};
use serde::{Deserialize, Serialize};

table! {
    /// The table `[contours]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Contours {
        /// T, the width of a contour.
        thickness: Length = Length::Voxels(2.0),
            key("STF-7", Lengths { on: On::World, bounds: Bounds::NOT_NEGATIVE });
        /// The curvature along the view that thickness is controlled by.
        kappa: Kappa = Kappa::Ray, key("STF-6", KappaName::KIND,
            |c| {
                Some(match c.kappa {
                    Kappa::Ray => KappaName::Ray,
                    Kappa::Exact => KappaName::Exact,
                    Kappa::None { .. } => KappaName::None,
                })
            },
            |c, name| {
                c.kappa = match name {
                    KappaName::Ray => Kappa::Ray,
                    KappaName::Exact => Kappa::Exact,
                    KappaName::None => Kappa::None { threshold: THRESHOLD },
                }
            }).needs(&[Quantity::PreviousNormal, Quantity::Hessian]);
        /// τ of kappa = "none": |N·v| up to which a contour reaches.
        threshold: key("STF-6", Number { bounds: Bounds::UNIT, unit: "" },
            |c| match c.kappa {
                Kappa::None { threshold } => Some(threshold),
                Kappa::Ray | Kappa::Exact => None,
            },
            |c, v| {
                if let Kappa::None { threshold } = &mut c.kappa {
                    *threshold = v;
                }
            }).absent("0.3 with kappa = \"none\"");
        /// The angle of a flipped normal, with kappa = "ray" and sampling.normal = "facing".
        sign_flip: SignFlip = SignFlip::TwoSided, key("STF-5", SignFlip::KIND);
        /// lo and hi, of |g|, between which contours fade in.
        fade: Option<[f64; 2]> = None,
            key("STF-7", Numbers { what: "a range [lo, hi]", bounds: Bounds::ANY, rule: Rule::Ascending })
                .absent("no fade").needs(&[Quantity::GradientMagnitudeRange]);
    }
}

/// Which κ_v ([STF-6]).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
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

choices! {
    /// The angle between two normals ([STF-5]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum SignFlip {
        /// The angle between lines.
        TwoSided = "two-sided",
        /// The plain angle.
        Literal = "literal",
    }
}

choices! {
    /// `kappa` without its parameters.
    #[derive(Clone, Copy, PartialEq)]
    enum KappaName {
        /// From two normals along the ray.
        Ray = "ray",
        /// From the Hessian.
        Exact = "exact",
        /// None: a constant threshold.
        None = "none",
    }
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
pub(crate) static TABLE: Table<Contours> = Contours::description(
    "[contours]",
    "Style contours of controlled thickness. They act on a transfer function of styles.",
);
