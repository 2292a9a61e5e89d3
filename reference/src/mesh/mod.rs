//! The place where a line first meets a mesh of triangles ([VS-12]).
//!
//! Boxes of triangles are a tree in f32, grown outwards, and only say which triangles are tested. The test itself is in
//! f64: edges that two triangles share are computed from the same products, so no line passes between them.

mod nearest;
mod tree;
mod triangle;

pub(crate) use nearest::{MeshHit, MeshSearch};

#[cfg(test)]
mod tests;
