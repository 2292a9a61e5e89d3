//! The factors' tables: `[stipples.boundary]`, … ([STIP-7] … [STIP-12]).

use super::kinds::{EXPONENT, SHARE, SIGNED};
use crate::document::declare::table;
use crate::document::describe::Table;
use crate::document::kind::{Bounds, Flag, Number};
use crate::tables::LightDirection;
use crate::tables::shading::Light;

table! {
    /// T_b of eq. 5.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Boundary {
        /// k_gc, the value's own share.
        gc: f64 = 0.39, key("STIP-7", SHARE);
        /// k_gs, what a boundary adds at most.
        gs: f64 = 0.51, key("STIP-7", SHARE);
        /// k_ge, how sharply it does.
        ge: f64 = 1.0, key("STIP-7", EXPONENT);
    }
}

table! {
    /// T_s of eq. 6.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Silhouette {
        /// k_sc, the value's own share.
        sc: f64 = 0.279, key("STIP-8", SHARE);
        /// k_ss, what a silhouette adds at most.
        ss: f64 = 0.45, key("STIP-8", SHARE);
        /// k_se, how sharply it does.
        se: f64 = 1.11, key("STIP-8", EXPONENT);
        /// Whether ∇V itself stands in the bars, as printed, in place of n.
        literal: bool = false, key("STIP-8", Flag);
    }
}

table! {
    /// T_r of eq. 7.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Resolution {
        /// k_re; 0 has no effect, with 2 the dots per screen area stay equal.
        re: f64 = 1.1, key("STIP-9", EXPONENT);
        /// D₀, the eye depth of the volume's centre at which the factor is 1, in world units; for an orthographic
        /// camera its height.
        reference: Option<f64> = None,
            key("STIP-9", Number { bounds: Bounds::POSITIVE, unit: "" }).absent("the reference camera's");
    }
}

table! {
    /// T_d of eq. 8.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Distance {
        /// k_de; below 0 the far parts are enhanced, 0 has no effect.
        de: f64 = 1.5, key("STIP-10", SIGNED);
    }
}

table! {
    /// T_t of eq. 9.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Interior {
        /// k_te; 0 has no effect.
        te: f64 = 0.5, key("STIP-11", EXPONENT);
    }
}

table! {
    /// T_l of eq. 10.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Lighting {
        /// k_le; 0 has no effect.
        le: f64 = 2.7, key("STIP-12", EXPONENT);
        /// Towards the light.
        light: Option<LightDirection> = None, key("STIP-12", Light).absent("the scene's `light`");
    }
}

/// The description of `[stipples.boundary]`.
pub(super) static BOUNDARY: Table<Boundary> =
    Boundary::description("[stipples.boundary]", "More points where the gradient is large: T_b = V (gc + gs ‖∇V‖^ge).");

/// The description of `[stipples.silhouette]`.
pub(super) static SILHOUETTE: Table<Silhouette> = Silhouette::description(
    "[stipples.silhouette]",
    "More points where surfaces turn away: T_s = V (sc + ss (1 − |n·E|)^se).",
);

/// The description of `[stipples.resolution]`.
pub(super) static RESOLUTION: Table<Resolution> = Resolution::description(
    "[stipples.resolution]",
    "Fewer and smaller points where the volume is far away: T_r = min(1, (D₀/D)^re), one number a frame.",
);

/// The description of `[stipples.distance]`.
pub(super) static DISTANCE: Table<Distance> = Distance::description(
    "[stipples.distance]",
    "Fewer and smaller points in the volume's far parts: T_d = ½(1 + sign(de) sign(z) |z/a|^|de|).",
);

/// The description of `[stipples.interior]`.
pub(super) static INTERIOR: Table<Interior> =
    Interior::description("[stipples.interior]", "Transparency of what has a small gradient: T_t = ‖∇V‖^te.");

/// The description of `[stipples.lighting]`.
pub(super) static LIGHTING: Table<Lighting> = Lighting::description(
    "[stipples.lighting]",
    "Fewer points where light falls: T_l = 1 − max(0, L·n)^le, and none on what faces away from the eye.",
);
