//! `[contours]`: style contours of controlled thickness ([STF-6] … [STF-8]).

use crate::tables::Length;

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
