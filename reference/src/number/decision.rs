//! The decisions of a picture: comparisons at which the picture jumps.

/// A comparison on which a picture depends. If its errors leave the comparison open, an f32 renderer may decide it
/// differently, and no bound holds there pixel by pixel ([GPU-2]).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Decision {
    /// A step of the function, or a cell, a node or a texel across which a formula jumps.
    #[default]
    Step,
    /// Whether a visible sample lies inside the volume's box.
    Inside,
    /// Whether a visible sample lies in the box of an object, or before the end of a cutaway.
    Object,
    /// Whether a clip plane cuts a visible sample away, or which sample is the first one behind a cut.
    Cut,
    /// Whether ‖g‖ exceeds the bound below which a sample has no normal.
    Normal,
    /// The side of a normal that is turned to the eye.
    Facing,
    /// Whether N·L exceeds 0, where a highlight ends at the terminator.
    Light,
    /// The tone of toon shading.
    Tone,
    /// Whether a silhouette is black.
    Silhouette,
    /// The label of a sample.
    Label,
    /// Whether a ray ends before it is opaque.
    End,
    /// The depth of the iso-surface, where the ray touches it or passes it by.
    Surface,
    /// Whether a pixel gets rays at an edge.
    Edge,
    /// More comparisons were open at one sample than can be followed.
    Many,
}

impl Decision {
    /// All decisions.
    pub const ALL: [Self; 14] = [
        Self::Step,
        Self::Inside,
        Self::Object,
        Self::Cut,
        Self::Normal,
        Self::Facing,
        Self::Light,
        Self::Tone,
        Self::Silhouette,
        Self::Label,
        Self::End,
        Self::Surface,
        Self::Edge,
        Self::Many,
    ];

    /// A sentence that describes the decision.
    pub fn sentence(self) -> &'static str {
        match self {
            Self::Step => "a step of the function, or a cell, a node or a texel across which a formula jumps",
            Self::Inside => "whether a visible sample lies inside the volume",
            Self::Object => "whether a visible sample lies in the box of an object or before the end of a cutaway",
            Self::Cut => "whether a clip plane cuts a visible sample away",
            Self::Normal => "whether the gradient is long enough for a normal",
            Self::Facing => "the side of a normal that is turned to the eye",
            Self::Light => "whether light reaches a surface that has a highlight at the terminator",
            Self::Tone => "the tone of toon shading",
            Self::Silhouette => "whether a silhouette is black",
            Self::Label => "the label of a sample",
            Self::End => "whether a ray ends before it is opaque",
            Self::Surface => "the depth of the iso-surface, where the ray touches it or passes it by",
            Self::Edge => "whether a pixel gets more rays, because it differs from a neighbour",
            Self::Many => "more comparisons than are followed, at one sample",
        }
    }
}
