//! Strokes on surfaces, made by hatching and outlines and drawn by pictures (Nagy, Schneider and Westermann 2002, 3.2,
//! 4.1; [HATCH-10]).

use crate::document::declare::choices;
use glam::DVec3;

choices! {
    /// The measure of curvature by which seeds are chosen ([HATCH-6]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Measure {
        /// |κ₁ + κ₂|/2: the paper's.
        Mean = "mean",
        /// √((κ₁² + κ₂²)/2), which minimal surfaces have, too.
        Curvedness = "curvedness",
    }
}

/// A place on a stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrokeVertex {
    /// The position, in world units.
    pub world: DVec3,
    /// The outward normal N there, of length 1, in world space.
    pub normal: DVec3,
    /// u ∈ [0, 1]: the arc length from the tail over the whole length.
    pub u: f64,
}

/// A curve on an iso-surface, as straight segments between its vertices.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stroke {
    /// The vertices from the tail on, at least two. A closed stroke does not repeat its first vertex.
    pub vertices: Vec<StrokeVertex>,
    /// Whether the last vertex is joined to the first.
    pub closed: bool,
    /// The key of the stroke's random numbers ([RAY-4]): the index of the cell that the stroke grew from.
    pub key: u64,
}

impl Stroke {
    /// The stroke's length, in world units.
    pub fn length(&self) -> f64 {
        let along = self.vertices.windows(2).map(|pair| pair[0].world.distance(pair[1].world)).sum::<f64>();
        match self.vertices.as_slice() {
            [first, .., last] if self.closed => along + last.world.distance(first.world),
            _ => along,
        }
    }
}
