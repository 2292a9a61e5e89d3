//! `[stipples]`: volume stippling ([STIP-1] … [STIP-19]). Each factor is a table of its own; one that is absent is 1.

mod curves;
mod factors;
mod kinds;
mod presets;
mod table;

pub use curves::{Curves, CurvesTest};
pub use factors::{Boundary, Distance, Interior, Lighting, Resolution, Silhouette};
pub(crate) use presets::StipplePreset;
pub(crate) use table::TABLE;

use crate::color::Rgba;
use crate::tables::{Iso, Length};

/// The table `[stipples]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Stipples {
    /// ‖∇V‖ above which voxels get points ([STIP-4]).
    pub threshold: Threshold,
    /// k_max of eq. 1 ([STIP-3]).
    pub k_max: PointsPerPixel,
    /// S_max of eq. 4, the largest dot's diameter: a length on the page ([STIP-6]).
    pub size: Length,
    /// Key of the random numbers ([RAY-4]).
    pub seed: u64,
    /// Voxels along the side of the boxes that points are made in; none: the least whose projection is 5×5 pixels or, where the
    /// picture is in millimetres, squares of side S_max ([STIP-2]).
    pub box_side: Option<u64>,
    /// What the dots are drawn in ([STIP-16]).
    pub color: DotColor,
    /// The pen of `[[pen]]` that draws, in its colour and size ([STIP-6]); none: dots of `color` and any size.
    pub pen: Option<String>,
    /// Estimator of V and ∇V ([STIP-1]).
    pub gradient: StippleGradient,
    /// Half the distance of the two planes, where points do not snap ([STIP-4]).
    pub slab: Length,
    /// Which points a voxel's order sees ([STIP-4]).
    pub order: StippleOrder,
    /// Whether points move onto the edge ([STIP-4]).
    pub snap: Snap,
    /// Whether a face has one layer of voxels with points ([STIP-4]).
    pub thin: bool,
    /// How factors come into [0, 1] ([STIP-5]).
    pub factors: FactorRange,
    /// What becomes of a fraction of a point ([STIP-5]).
    pub ink: Ink,
    /// What hides points: an iso-surface ([STIP-15]); none: they are transparent.
    pub hide_behind: Option<Iso>,
    /// Which points are drawn where there is a choice ([STIP-19]).
    pub even: Even,
    /// T_b; none: 1.
    pub boundary: Option<Boundary>,
    /// T_s; none: 1.
    pub silhouette: Option<Silhouette>,
    /// T_r; none: 1.
    pub resolution: Option<Resolution>,
    /// T_d; none: 1.
    pub distance: Option<Distance>,
    /// T_t; none: 1.
    pub interior: Option<Interior>,
    /// T_l; none: 1.
    pub lighting: Option<Lighting>,
    /// Silhouette curves; none: none.
    pub curves: Option<Curves>,
}

/// `color` ([STIP-16]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DotColor {
    /// One colour: linear, straight.
    Fixed(Rgba),
    /// That of the transfer function at the voxel's V; of a style where it faces the eye.
    Transfer,
    /// That of the voxel's label: of the most opaque node of its row in the transfer function.
    Label,
}

/// `threshold` ([STIP-4]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Threshold {
    /// A ‖∇V‖ of [VAL-2].
    Magnitude(f64),
    /// The quantile of ‖g‖ over the voxels with a normal.
    Quantile(f64),
}

/// `k_max` ([STIP-3], [STIP-17]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PointsPerPixel {
    /// Points of a voxel for each pixel, or square of side S_max, of its projection.
    Number(f64),
    /// As many as print the coverage 0.9 where T = 1.
    Auto,
}

/// `gradient` ([STIP-1]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StippleGradient {
    /// A linear fit to 3×3×3 voxels, which smooths the value too.
    Regression,
    /// Central differences, and the voxel's own value.
    Central,
}

/// `order` ([STIP-4]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StippleOrder {
    /// A voxel's order sees the 26 neighbours.
    Neighbours,
    /// It sees the voxel alone: the paper's.
    Voxel,
}

/// `snap` ([STIP-4]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Snap {
    /// Points stay about their voxel's centre: the paper's.
    None,
    /// Points lie where ‖∇V‖ is largest along the normal within one voxel.
    Edge,
}

/// `factors` ([STIP-5]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FactorRange {
    /// What leaves [0, 1] is clamped.
    Clamp,
    /// T_b and T_s are divided by the largest that their constants allow, where that is above 1.
    Normalize,
}

/// `ink` ([STIP-5]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ink {
    /// The next point is drawn with the fraction as its opacity.
    Fade,
    /// Whole points alone: a fraction is one of many voxels' points.
    Opaque,
}

/// `even` ([STIP-19]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Even {
    /// The first of each voxel's list.
    None,
    /// Those that lie evenly on the page.
    Page,
}

impl Default for Stipples {
    fn default() -> Self {
        Self {
            threshold: Threshold::Magnitude(0.1),
            k_max: PointsPerPixel::Number(1.0),
            size: Length::Millimetres(0.35),
            seed: 1,
            color: DotColor::Fixed([0.0, 0.0, 0.0, 1.0]),
            pen: None,
            gradient: StippleGradient::Regression,
            box_side: None,
            slab: Length::Voxels(0.5),
            order: StippleOrder::Neighbours,
            snap: Snap::None,
            thin: false,
            factors: FactorRange::Clamp,
            ink: Ink::Fade,
            hide_behind: None,
            even: Even::None,
            boundary: None,
            silhouette: None,
            resolution: None,
            distance: None,
            interior: None,
            lighting: None,
            curves: None,
        }
    }
}
