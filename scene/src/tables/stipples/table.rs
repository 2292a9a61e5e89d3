//! The description of `[stipples]`.

use super::curves::{CURVES, Curves};
use super::factors::{
    BOUNDARY, Boundary, DISTANCE, Distance, INTERIOR, Interior, LIGHTING, Lighting, RESOLUTION, Resolution, SILHOUETTE,
    Silhouette,
};
use super::kinds::{DotColor, DotColors, PointsPerPixel, PointsPerPixelKind, Threshold, ThresholdKind};
use crate::document::declare::{choices, table};
use crate::document::describe::Table;
use crate::document::kind::{Bounds, Flag, Lengths, On, TableOf, Text, Whole};
use crate::tables::surface::IsoKind;
use crate::tables::{Iso, Length};

table! {
    /// The table `[stipples]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Stipples {
        /// ‖∇V‖ above which a voxel gets points; a quantile is one of ‖g‖ over the voxels with a normal.
        threshold: Threshold = Threshold::Magnitude(0.1), key("STIP-4", ThresholdKind);
        /// Points of a voxel for each pixel, or square of side `size`, of its projection; "auto": as many as print a
        /// coverage of 0.9 where all factors are 1 (STIP-17).
        k_max: PointsPerPixel = PointsPerPixel::Number(1.0), key("STIP-3", PointsPerPixelKind);
        /// S_max, the diameter of the largest dots.
        ///
        /// In mm or px.
        size: Length = Length::Millimetres(0.35), key("STIP-6", Lengths { on: On::Page, bounds: Bounds::POSITIVE });
        /// Key of the random numbers.
        seed: u64 = 1, key("RAY-4", Whole { lo: 0, hi: i64::MAX as u64 });
        /// Voxels along the side of the boxes that points are made in; an axis has two boxes at least. Larger ones have
        /// more dots each, and show patterns; smaller ones keep what is thin.
        box_side: Option<u64> = None,
            key("STIP-2", Whole { lo: 1, hi: 1 << 20 })
                .named("box").absent("as many as a projection of 5×5 pixels, or squares of side `size`, asks for");
        /// Colour of the dots. `"transfer"`: the colour of `[transfer]` at their voxel's value, of a style
        /// where it faces the eye; `"label"`: that of their label's row. With `[[pen]]` each dot goes to the pen of the
        /// nearest colour; without, to one of at most 16 layers.
        color: DotColor = DotColor::Fixed([0.0, 0.0, 0.0, 1.0]), key("STIP-16", DotColors);
        /// The pen of `[[pen]]` that draws: dots have its colour and its nib's size, and where they should be smaller
        /// there are fewer.
        pen: Option<String> = None,
            key("STIP-6", Text { what: "the name of a pen" }).absent("`color`, in dots of any size");
        /// How V and ∇V of a voxel are estimated.
        gradient: StippleGradient = StippleGradient::Regression, key("STIP-1", StippleGradient::KIND);
        /// The largest distance of points that do not snap from the tangent plane through the voxel's centre.
        ///
        /// In the world.
        slab: Length = Length::Voxels(0.5), key("STIP-4", Lengths { on: On::World, bounds: Bounds::NOT_NEGATIVE });
        /// Which points are seen when a voxel's are spread and put in order.
        order: StippleOrder = StippleOrder::Neighbours, key("STIP-4", StippleOrder::KIND);
        /// Whether points leave their voxel for the edge.
        snap: Snap = Snap::None, key("STIP-4", Snap::KIND);
        /// Whether only voxels whose ‖∇V‖ is largest along the normal get points: one layer a face.
        thin: bool = false, key("STIP-4", Flag);
        /// How factors are brought into [0, 1].
        factors: FactorRange = FactorRange::Clamp, key("STIP-5", FactorRange::KIND);
        /// Treatment of a fraction of a point.
        ink: Ink = Ink::Fade, key("STIP-5", Ink::KIND);
        /// An iso-value, or "auto": points lie on that surface alone, whose V and ‖∇V‖ are 1, and `threshold` has no
        /// effect.
        iso: Option<Iso> = None, key("STIP-20", IsoKind).absent("points lie on all boundaries above `threshold`");
        /// An iso-value: points behind that surface are not drawn.
        hide_behind: Option<Iso> = None, key("STIP-15", IsoKind).absent("points are transparent");
        /// The area that the density of dots is counted on.
        density: DotDensity = DotDensity::Face, key("STIP-21", DotDensity::KIND);
        /// Which points are drawn where there is a choice.
        even: Even = Even::None, key("STIP-19", Even::KIND);
        /// T_b.
        boundary: Option<Boundary> = None, key("STIP-7", TableOf(&BOUNDARY)).absent("1");
        /// T_s.
        silhouette: Option<Silhouette> = None, key("STIP-8", TableOf(&SILHOUETTE)).absent("1");
        /// T_r.
        resolution: Option<Resolution> = None, key("STIP-9", TableOf(&RESOLUTION)).absent("1");
        /// T_d.
        distance: Option<Distance> = None, key("STIP-10", TableOf(&DISTANCE)).absent("1");
        /// T_t.
        interior: Option<Interior> = None, key("STIP-11", TableOf(&INTERIOR)).absent("1");
        /// T_l.
        lighting: Option<Lighting> = None, key("STIP-12", TableOf(&LIGHTING)).absent("1");
        /// Silhouette curves.
        curves: Option<Curves> = None, key("STIP-13", TableOf(&CURVES)).absent("no curves");
    }
}

impl Stipples {
    /// Whether a face has one layer of voxels with points. A surface of `iso` always has one.
    pub fn is_thin(&self) -> bool {
        self.thin || self.iso.is_some()
    }
}

choices! {
    /// `gradient` ([STIP-1]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum StippleGradient {
        /// A linear fit to the 3×3×3 voxels around it.
        Regression = "regression",
        /// Central differences, and the voxel's own value.
        Central = "central",
    }
}

choices! {
    /// `order` ([STIP-4]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum StippleOrder {
        /// Its own and those of the 26 voxels around it.
        Neighbours = "neighbours",
        /// Its own: the paper's.
        Voxel = "voxel",
    }
}

choices! {
    /// `snap` ([STIP-4]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Snap {
        /// They stay in the voxel: the paper's.
        None = "none",
        /// They lie where ‖∇V‖ is largest along the normal within one voxel: no stairs on oblique faces.
        Edge = "edge",
    }
}

choices! {
    /// `factors` ([STIP-5]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum FactorRange {
        /// Values above 1 become 1.
        Clamp = "clamp",
        /// boundary over gc + gs and silhouette over sc + ss, where the sum is above 1.
        Normalize = "normalize",
    }
}

choices! {
    /// `ink` ([STIP-5]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Ink {
        /// The opacity of the next point: the paper's.
        Fade = "fade",
        /// A whole point in that share of the voxels, for pens and 1-bit print.
        Opaque = "opaque",
    }
}

choices! {
    /// `density` ([STIP-21]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum DotDensity {
        /// That of the face: the paper's. A face that turns away has its dots on less of the page, and becomes black.
        Face = "face",
        /// That of the face on the page: |n·E| times as many dots, so that the factors alone make the tone.
        Page = "page",
    }
}

choices! {
    /// `even` ([STIP-19]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Even {
        /// The first of each voxel's list: the paper's, and what moving pictures need.
        None = "none",
        /// The most evenly spread of four times as many, over all faces that are seen on the page; all are drawn
        /// whole.
        Page = "page",
    }
}

/// The description of `[stipples]`.
pub(crate) static TABLE: Table<Stipples> = Stipples::description(
    "[stipples]",
    "Volume stippling: points on the volume's boundaries, made once, of which each frame draws as many as the \
         factors below say. A factor without a table is 1.",
);
