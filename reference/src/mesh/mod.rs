//! The first intersection of a line with a mesh of triangles ([VS-12]).
//!
//! A tree of boxes in f32, rounded outwards, only selects the triangles to test. The test itself is in f64. Edges that
//! two triangles share are computed from the same products, so no line passes between them.

mod nearest;
mod possible;
mod tree;
mod triangle;

pub(crate) use nearest::{MeshHit, MeshSearch};
pub(crate) use possible::{LineErrors, PossibleHit};

#[cfg(test)]
mod tests;
