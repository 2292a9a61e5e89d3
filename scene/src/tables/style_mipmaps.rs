//! `[style_mipmaps]`: styles read at the level of detail that the picture can show ([STF-10]).

use crate::document::describe::{Key, Slot, Table};
use crate::document::kind::{Bounds, Number};
use crate::quantity::Quantity;

/// The table `[style_mipmaps]`.
#[derive(Clone, Debug, PartialEq)]
pub struct StyleMipmaps {
    /// b_κ.
    pub curvature_bias: f64,
    /// b_g.
    pub gradient_bias: f64,
    /// ω₀, the turn of the normal per voxel that the level without a bias assumes, in radians.
    pub turn: f64,
}

impl Default for StyleMipmaps {
    fn default() -> Self {
        Self { curvature_bias: 1.0, gradient_bias: 1.0, turn: 2.0 / 256.0 }
    }
}

/// A factor.
const FACTOR: Number = Number { bounds: Bounds::NOT_NEGATIVE, unit: "" };

/// The description of `[style_mipmaps]`.
pub(crate) static TABLE: Table<StyleMipmaps> = Table::new(
    "[style_mipmaps]",
    "Styles with more detail than the picture can show are read from their mip-maps. Without the table each lookup \
         reads the style itself.",
    StyleMipmaps::default,
    &[
        Key::new(
            "curvature_bias",
            "STF-10",
            "How much the curvature κ, `kappa` of [contours] or else \"ray\", raises the level; 0: not at all.",
            &Slot { kind: FACTOR, get: |m: &StyleMipmaps| Some(m.curvature_bias), set: |m, v| m.curvature_bias = v },
        )
        .needs(&[Quantity::PreviousNormal, Quantity::Hessian]),
        Key::new(
            "gradient_bias",
            "STF-10",
            "By how many levels |g| = 0 raises the level; 0: not at all.",
            &Slot { kind: FACTOR, get: |m: &StyleMipmaps| Some(m.gradient_bias), set: |m, v| m.gradient_bias = v },
        )
        .needs(&[Quantity::GradientMagnitudeRange]),
        Key::new(
            "turn",
            "STF-10",
            "ω₀, the turn of the normal per voxel that is assumed at the least.",
            &Slot {
                kind: Number { bounds: Bounds::NOT_NEGATIVE, unit: ", in radians" },
                get: |m: &StyleMipmaps| Some(m.turn),
                set: |m, v| m.turn = v,
            },
        ),
    ],
);
