//! The quantities of a plan.

/// A quantity that a sample may be asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Quantity {
    /// f.
    Value,
    /// g and the normal ([REC-2], [NORM-1]).
    Gradient,
    /// The normal of the previous sample on the ray ([STF-5]).
    PreviousNormal,
    /// H, with the gradient of its own field ([REC-3], [CUR-1]).
    Hessian,
    /// |g|: ‖g‖ mapped to [0, 1] by its range ([VAL-2]).
    GradientMagnitudeRange,
    /// The id of the part that a sample belongs to ([STF-13]).
    Label,
    /// The distance to a point ([STF-4]).
    Distance,
    /// The distance to a label ([STF-4]).
    LabelDistance,
    /// The value of a further volume ([STF-4]).
    FurtherVolume,
    /// The place where a ray first meets the iso-surface ([HATCH-14]).
    Surface,
    /// The normal of the iso-surface at that place.
    SurfaceNormal,
    /// The place where a ray first meets a mesh ([VS-12]).
    Mesh,
}

impl Quantity {
    /// Every quantity.
    pub const ALL: [Self; 12] = [
        Self::Value,
        Self::Gradient,
        Self::PreviousNormal,
        Self::Hessian,
        Self::GradientMagnitudeRange,
        Self::Label,
        Self::Distance,
        Self::LabelDistance,
        Self::FurtherVolume,
        Self::Surface,
        Self::SurfaceNormal,
        Self::Mesh,
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Value => "value",
            Self::Gradient => "gradient",
            Self::PreviousNormal => "previous normal",
            Self::Hessian => "Hessian",
            Self::GradientMagnitudeRange => "|g|",
            Self::Label => "label",
            Self::Distance => "distance",
            Self::LabelDistance => "distance to a label",
            Self::FurtherVolume => "further volume",
            Self::Surface => "first root",
            Self::SurfaceNormal => "its normal",
            Self::Mesh => "nearest triangle",
        }
    }

    /// The work that the quantity adds to a picture.
    pub fn adds(self) -> &'static str {
        match self {
            Self::Value => "one reconstruction a sample",
            Self::Gradient => "one gradient a visible sample",
            Self::PreviousNormal => "one gradient where the sample before has none yet",
            Self::Hessian => "one Hessian a visible sample",
            Self::GradientMagnitudeRange => "a norm and a division a visible sample",
            Self::Label => "one look at the labels a visible sample",
            Self::Distance => "one norm a visible sample",
            Self::LabelDistance | Self::FurtherVolume => "one trilinear reconstruction a visible sample",
            Self::Surface => "one search a ray, through the bricks that can hold the value",
            Self::SurfaceNormal => "one gradient a ray that meets the surface",
            Self::Mesh => "one search a ray, through a tree of the triangles",
        }
    }

    /// The work that the quantity adds if only the first visible sample of each ray needs it.
    pub(crate) fn adds_at_first(self) -> &'static str {
        match self {
            Self::Gradient | Self::PreviousNormal => "one gradient a ray",
            Self::Hessian => "one Hessian a ray",
            _ => self.adds(),
        }
    }

    /// The work that the quantity adds if samples that may seed halos need it.
    pub(crate) fn adds_at_seeds(self) -> &'static str {
        match self {
            Self::Gradient => "one gradient a seed sample",
            Self::PreviousNormal => "one more gradient a seed sample",
            Self::Hessian => "one Hessian a seed sample",
            Self::GradientMagnitudeRange => "a norm and a division a seed sample",
            Self::Label => "one look at the labels a seed sample",
            Self::Distance => "one norm a seed sample",
            Self::LabelDistance | Self::FurtherVolume => "one trilinear reconstruction a seed sample",
            Self::Value | Self::Surface | Self::SurfaceNormal | Self::Mesh => self.adds(),
        }
    }

    /// The quantity that this one is made of.
    pub(crate) fn prerequisite(self) -> Option<Self> {
        match self {
            Self::Value | Self::Label | Self::Distance | Self::LabelDistance | Self::FurtherVolume => None,
            Self::Surface | Self::Mesh => None,
            Self::SurfaceNormal => Some(Self::Surface),
            Self::Gradient => Some(Self::Value),
            // A sample without a normal has no curvature, and that is tested on `sampling.gradient` too ([PREC-3]).
            Self::PreviousNormal | Self::Hessian | Self::GradientMagnitudeRange => Some(Self::Gradient),
        }
    }
}
