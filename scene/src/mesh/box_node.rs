//! Trees of boxes about triangles.

use glam::DVec3;

/// A node of a binary tree of boxes. A tree is a list of nodes, and begins with its root.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxNode {
    /// The lowest corner; −∞ where the box has no end.
    pub lo: DVec3,
    /// The highest corner.
    pub hi: DVec3,
    /// The index of the first of two adjacent children, or the triangle of a leaf.
    pub first: u32,
    /// Whether the node is a leaf, which has one triangle.
    pub is_leaf: bool,
}
