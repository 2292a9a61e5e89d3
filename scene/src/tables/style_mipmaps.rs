//! `[style_mipmaps]`: styles read at the level of detail that the picture can show ([STF-10]).

use crate::document::declare::table;
use crate::document::describe::Table;
use crate::document::kind::{Bounds, Number};
use crate::quantity::Quantity;

table! {
    /// The table `[style_mipmaps]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct StyleMipmaps {
        /// How much the curvature κ, `kappa` of [contours] or else "ray", raises the level; 0: not at all.
        curvature_bias: f64 = 1.0, key("STF-10", FACTOR).needs(&[Quantity::PreviousNormal, Quantity::Hessian]);
        /// By how many levels |g| = 0 raises the level; 0: not at all.
        gradient_bias: f64 = 1.0, key("STF-10", FACTOR).needs(&[Quantity::GradientMagnitudeRange]);
        /// ω₀, the turn of the normal per voxel that is assumed at the least.
        ///
        /// In radians.
        turn: f64 = 2.0 / 256.0, key("STF-10", Number { bounds: Bounds::NOT_NEGATIVE, unit: ", in radians" });
    }
}

/// A factor.
const FACTOR: Number = Number { bounds: Bounds::NOT_NEGATIVE, unit: "" };

/// The description of `[style_mipmaps]`.
pub(crate) static TABLE: Table<StyleMipmaps> = StyleMipmaps::description(
    "[style_mipmaps]",
    "Styles with more detail than the picture can show are read from their mip-maps. Without the table each lookup \
         reads the style itself.",
);
