//! `[hatching.directions]`: where a stroke's direction comes from ([HATCH-3], [HATCH-4]).

use super::table::NOT_NEGATIVE;
use crate::document::declare::{choices, table};
use crate::document::describe::Table;
use crate::document::kind::{Bounds, Number, Numbers, Rule};
use crate::length::Length;
use glam::DVec3;

table! {
    /// The table `[hatching.directions]`.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Directions {
        /// The rule by which a place has a direction.
        rule: DirectionRule = DirectionRule::Scaled, key("HATCH-3", DirectionRule::KIND);
        /// Source of a stroke's direction.
        from: DirectionSource = DirectionSource::Hessian, key("HATCH-4", DirectionSource::KIND);
        /// Interpolation of stored directions between voxels.
        interpolate: Interpolate = Interpolate::Tensor, key("HATCH-4", Interpolate::KIND);
        /// At which voxels directions are stored.
        grid: StoredAt = StoredAt::Visited, key("HATCH-5", StoredAt::KIND);
        /// How far directions are smoothed along a surface, so that neighbours agree: where the data are not sure of
        /// a direction, those around it decide. Directions are stored then. 0: not at all.
        ///
        /// In the world.
        smooth: Length = Length::World(0.0), key("HATCH-3", NOT_NEGATIVE);
        /// Which way strokes run, so that neighbours taper alike.
        reference: Reference = Reference::Cylindrical, key("HATCH-4", Reference::KIND);
        /// Axis of the reference, in world space.
        axis: Option<DVec3> = None,
            key("HATCH-4", Numbers::<3> { what: "a direction [x, y, z]", bounds: Bounds::ANY, rule: Rule::Direction })
                .absent("the volume's longest axis");
        /// Centre of the reference, in world space.
        center: Option<DVec3> = None,
            key("HATCH-4", Numbers::<3> { what: "a point [x, y, z]", bounds: Bounds::ANY, rule: Rule::Free })
                .absent("the volume's centre");
        /// ε: |κ₁ − κ₂| > ε(|κ₁| + |κ₂|).
        gap: f64 = 0.1, key("HATCH-3", Number { bounds: Bounds::BELOW_ONE, unit: "" });
        /// How many standard deviations of the data's error |κ₁ − κ₂|·‖g‖ has to be.
        noise: f64 = 8.0, key("HATCH-3", Number { bounds: Bounds::NOT_NEGATIVE, unit: "" });
        /// The standard deviation of a value's error. That of rounding to the stored type is the least; with 0 it is
        /// all.
        deviation: Option<f64> = None,
            key("HATCH-3", Number { bounds: Bounds::NOT_NEGATIVE, unit: ", in the volume's unit" })
                .absent("measured on the surface");
        /// The largest angle between the lines at σ and at 1.5σ.
        ///
        /// In degrees.
        agree: f64 = 20.0, key("HATCH-3", Number { bounds: Bounds::between(0.0, 90.0), unit: ", in degrees" });
    }
}

impl Directions {
    /// Whether directions are smoothed along the surface.
    pub fn smooths(&self) -> bool {
        self.smooth.of_voxel(1.0).is_some_and(|length| length > 0.0)
    }

    /// Whether directions are stored at voxels.
    pub fn is_stored(&self) -> bool {
        self.from == DirectionSource::Stored || self.smooths()
    }
}

choices! {
    /// `rule` ([HATCH-3]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum DirectionRule {
        /// Only where the data are sure of one.
        Scaled = "scaled",
        /// The formula with the scene's own derivatives, wherever the curvatures differ at all: the paper's.
        Raw = "raw",
    }
}

choices! {
    /// `from` ([HATCH-4]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum DirectionSource {
        /// The derivatives at every place of it: as exact as they are.
        Hessian = "hessian",
        /// Between those of voxels, which are made once: the paper's, and faster where strokes are many.
        Stored = "stored",
    }
}

choices! {
    /// `interpolate` ([HATCH-4]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Interpolate {
        /// The dominant eigenvector of the mean of e eᵀ, which knows no signs; none where the mean has none.
        Tensor = "tensor",
        /// The mean of the directions, each with the sign that is nearer to the stroke's own: the paper's.
        Flipped = "flipped",
    }
}

choices! {
    /// `grid` ([HATCH-5]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum StoredAt {
        /// At the corners of the cells that strokes enter, when they do, and where seeds are measured.
        Visited = "visited",
        /// At all, before the first stroke; the strokes are the same.
        All = "all",
    }
}

choices! {
    /// `reference` ([HATCH-4]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Reference {
        /// Around `axis`.
        Cylindrical = "cylindrical",
        /// Along `axis`.
        Axial = "axial",
        /// Away from `center`.
        Radial = "radial",
    }
}

/// The description of `[hatching.directions]`.
pub(super) static DIRECTIONS: Table<Directions> = Directions::description(
    "[hatching.directions]",
    "Where surfaces have principal directions, and which way strokes run along them. With rule = \"scaled\" derivatives are \
     Gaussian, at σ = 1, 2, 4 voxels, and the first σ counts at which the two curvatures differ by more than their share, \
     by more than the data's noise, and the direction is that of 1.5σ, too.",
);
