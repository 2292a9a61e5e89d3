//! The factors' tables: `[stipples.boundary]`, … ([STIP-7] … [STIP-12]).

use super::kinds::{EXPONENT, SHARE, SIGNED};
use crate::document::describe::{Key, Slot, Table};
use crate::document::kind::{Bounds, Flag, Number};
use crate::tables::LightDirection;
use crate::tables::shading::Light;

/// T_b of eq. 5.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Boundary {
    /// k_gc.
    pub gc: f64,
    /// k_gs.
    pub gs: f64,
    /// k_ge.
    pub ge: f64,
}

/// T_s of eq. 6.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Silhouette {
    /// k_sc.
    pub sc: f64,
    /// k_ss.
    pub ss: f64,
    /// k_se.
    pub se: f64,
    /// Whether the gradient itself stands in the bars, as printed.
    pub literal: bool,
}

/// T_r of eq. 7.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// k_re.
    pub re: f64,
    /// D₀, in world units; none: the reference camera's.
    pub reference: Option<f64>,
}

/// T_d of eq. 8.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distance {
    /// k_de; below 0 the far parts are enhanced, 0 is off.
    pub de: f64,
}

/// T_t of eq. 9.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interior {
    /// k_te.
    pub te: f64,
}

/// T_l of eq. 10.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lighting {
    /// k_le; 0 is off.
    pub le: f64,
    /// Towards the light; none: the scene's.
    pub light: Option<LightDirection>,
}

impl Default for Boundary {
    fn default() -> Self {
        Self { gc: 0.39, gs: 0.51, ge: 1.0 }
    }
}

impl Default for Silhouette {
    fn default() -> Self {
        Self { sc: 0.279, ss: 0.45, se: 1.11, literal: false }
    }
}

impl Default for Resolution {
    fn default() -> Self {
        Self { re: 1.1, reference: None }
    }
}

/// The description of `[stipples.boundary]`.
pub(super) static BOUNDARY: Table<Boundary> = Table::new(
    "[stipples.boundary]",
    "More points where the gradient is large: T_b = V (gc + gs ‖∇V‖^ge).",
    Boundary::default,
    &[
        Key::new(
            "gc",
            "STIP-7",
            "k_gc, the value's own share.",
            &Slot { kind: SHARE, get: |t: &Boundary| Some(t.gc), set: |t, v| t.gc = v },
        ),
        Key::new(
            "gs",
            "STIP-7",
            "k_gs, what a boundary adds at most.",
            &Slot { kind: SHARE, get: |t: &Boundary| Some(t.gs), set: |t, v| t.gs = v },
        ),
        Key::new(
            "ge",
            "STIP-7",
            "k_ge, how sharply it does.",
            &Slot { kind: EXPONENT, get: |t: &Boundary| Some(t.ge), set: |t, v| t.ge = v },
        ),
    ],
);

/// The description of `[stipples.silhouette]`.
pub(super) static SILHOUETTE: Table<Silhouette> = Table::new(
    "[stipples.silhouette]",
    "More points where surfaces turn away: T_s = V (sc + ss (1 − |n·E|)^se).",
    Silhouette::default,
    &[
        Key::new(
            "sc",
            "STIP-8",
            "k_sc, the value's own share.",
            &Slot { kind: SHARE, get: |t: &Silhouette| Some(t.sc), set: |t, v| t.sc = v },
        ),
        Key::new(
            "ss",
            "STIP-8",
            "k_ss, what a silhouette adds at most.",
            &Slot { kind: SHARE, get: |t: &Silhouette| Some(t.ss), set: |t, v| t.ss = v },
        ),
        Key::new(
            "se",
            "STIP-8",
            "k_se, how sharply it does.",
            &Slot { kind: EXPONENT, get: |t: &Silhouette| Some(t.se), set: |t, v| t.se = v },
        ),
        Key::new(
            "literal",
            "STIP-8",
            "Whether ∇V itself stands in the bars, as printed, in place of n.",
            &Slot { kind: Flag, get: |t: &Silhouette| Some(t.literal), set: |t, v| t.literal = v },
        ),
    ],
);

/// The description of `[stipples.resolution]`.
pub(super) static RESOLUTION: Table<Resolution> = Table::new(
    "[stipples.resolution]",
    "Fewer and smaller points where the volume is far away: T_r = min(1, (D₀/D)^re), one number a frame.",
    Resolution::default,
    &[
        Key::new(
            "re",
            "STIP-9",
            "k_re; 0 has no effect, with 2 the dots per screen area stay equal.",
            &Slot { kind: EXPONENT, get: |t: &Resolution| Some(t.re), set: |t, v| t.re = v },
        ),
        Key::new(
            "reference",
            "STIP-9",
            "D₀, the eye depth of the volume's centre at which the factor is 1, in world units; for an orthographic \
             camera its height.",
            &Slot {
                kind: Number { bounds: Bounds::POSITIVE, unit: "" },
                get: |t: &Resolution| t.reference,
                set: |t, v| t.reference = Some(v),
            },
        )
        .absent("the reference camera's"),
    ],
);

/// The description of `[stipples.distance]`.
pub(super) static DISTANCE: Table<Distance> = Table::new(
    "[stipples.distance]",
    "Fewer and smaller points in the volume's far parts: T_d = ½(1 + sign(de) sign(z) |z/a|^|de|).",
    || Distance { de: 1.5 },
    &[Key::new(
        "de",
        "STIP-10",
        "k_de; below 0 the far parts are enhanced, 0 has no effect.",
        &Slot { kind: SIGNED, get: |t: &Distance| Some(t.de), set: |t, v| t.de = v },
    )],
);

/// The description of `[stipples.interior]`.
pub(super) static INTERIOR: Table<Interior> = Table::new(
    "[stipples.interior]",
    "Transparency of what has a small gradient: T_t = ‖∇V‖^te.",
    || Interior { te: 0.5 },
    &[Key::new(
        "te",
        "STIP-11",
        "k_te; 0 has no effect.",
        &Slot { kind: EXPONENT, get: |t: &Interior| Some(t.te), set: |t, v| t.te = v },
    )],
);

/// The description of `[stipples.lighting]`.
pub(super) static LIGHTING: Table<Lighting> = Table::new(
    "[stipples.lighting]",
    "Fewer points where light falls: T_l = 1 − max(0, L·n)^le, and none on what faces away from the eye.",
    || Lighting { le: 2.7, light: None },
    &[
        Key::new(
            "le",
            "STIP-12",
            "k_le; 0 has no effect.",
            &Slot { kind: EXPONENT, get: |t: &Lighting| Some(t.le), set: |t, v| t.le = v },
        ),
        Key::new(
            "light",
            "STIP-12",
            "Towards the light.",
            &Slot { kind: Light, get: |t: &Lighting| t.light, set: |t, v| t.light = Some(v) },
        )
        .absent("the scene's `light`"),
    ],
);
