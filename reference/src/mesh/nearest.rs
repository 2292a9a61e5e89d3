//! The nearest intersection of a line with the meshes of a picture.

use super::tree::{BoxTree, Slabs};
use super::triangle::{Crossing, ShearedLine};
use drypoint_scene::glam::DVec3;
use drypoint_scene::mesh::{BoxNode, TriangleMesh};
use drypoint_scene::space::Grid;
use std::sync::Arc;

/// The meshes of a picture, prepared for intersection with lines.
pub(crate) struct MeshSearch<'a> {
    meshes: &'a [TriangleMesh],
    /// The number of triangles of all meshes before each mesh.
    first: Vec<usize>,
    /// Corners of the triangles of all meshes, in the index space of lines.
    pub(super) corners: Vec<[DVec3; 3]>,
    pub(super) tree: BoxTree,
}

/// A place at which a line meets a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct MeshHit {
    /// The parameter of the line.
    pub(crate) t: f64,
    /// The mesh, by its index in the list.
    pub(crate) mesh: usize,
    /// The triangle of the mesh.
    pub(super) triangle: usize,
    /// Barycentric weights of its corners, with the sum 1.
    pub(super) weights: [f64; 3],
}

impl<'a> MeshSearch<'a> {
    /// Prepares meshes for lines in the index space of a grid. None without a mesh.
    pub(crate) fn new(meshes: &'a [TriangleMesh], grid: &Grid) -> Option<Self> {
        let (mut first, mut corners) = (Vec::new(), Vec::new());
        for mesh in meshes {
            first.push(corners.len());
            let at: Vec<DVec3> = mesh.positions().iter().map(|&p| grid.to_index(p)).collect();
            corners.extend(mesh.triangles().iter().map(|triangle| triangle.map(|i| at[i as usize])));
        }
        let bounds = |[a, b, c]: &[DVec3; 3]| [a.min(*b).min(*c), a.max(*b).max(*c)];
        let boxes: Vec<[DVec3; 2]> = corners.iter().map(bounds).collect();
        (!boxes.is_empty()).then(|| Self { meshes, first, corners, tree: BoxTree::new(&boxes) })
    }

    /// The index of a hit triangle among those of all meshes.
    #[cfg(test)]
    pub(super) fn place(&self, hit: &MeshHit) -> usize {
        self.first[hit.mesh] + hit.triangle
    }

    /// The boxes about the triangles.
    pub(crate) fn boxes(&self) -> Arc<[BoxNode]> {
        self.tree.nodes()
    }

    /// Bytes in memory.
    pub(crate) fn bytes(&self) -> usize {
        let meshes: usize = self.meshes.iter().map(TriangleMesh::bytes).sum();
        meshes + size_of_val(self.corners.as_slice()) + self.tree.bytes()
    }

    /// The nearest place on a line origin + t·along in a closed range of t. If several triangles meet there, the first
    /// in the list is returned.
    pub(crate) fn nearest(&self, line: [DVec3; 2], [from, to]: [f64; 2]) -> Option<MeshHit> {
        let sheared = ShearedLine::new(line)?;
        let mut best: Option<(Crossing, u32)> = None;
        self.tree.visit(&Slabs::new(line), to, |triangle| {
            let until = best.map_or(to, |(crossing, _)| crossing.t);
            let Some(crossing) = sheared.crosses(self.corners[triangle as usize]) else { return until };
            let is_nearer =
                |(best, first): (Crossing, u32)| crossing.t < best.t || crossing.t == best.t && triangle < first;
            if from <= crossing.t && crossing.t <= to && best.is_none_or(is_nearer) {
                best = Some((crossing, triangle));
                return crossing.t;
            }
            until
        });
        best.map(|(crossing, triangle)| self.hit(crossing, triangle))
    }

    /// A place in a triangle, given by its index among those of all meshes.
    pub(super) fn hit(&self, Crossing { t, weights }: Crossing, triangle: u32) -> MeshHit {
        let mesh = self.first.partition_point(|&first| first <= triangle as usize) - 1;
        MeshHit { t, mesh, triangle: triangle as usize - self.first[mesh], weights }
    }

    /// The unit normal at a place, in world space. It is interpolated from the vertices' normals, or else the
    /// triangle's own, and lies on the side of v, which points to the eye. Returns none if the normal has no direction.
    pub(crate) fn normal(&self, hit: &MeshHit, v: DVec3) -> Option<DVec3> {
        let (flat, of_corners) = self.normals(hit);
        let smooth =
            of_corners.and_then(|[a, b, c]| unit(a * hit.weights[0] + b * hit.weights[1] + c * hit.weights[2]));
        let normal = smooth.or(flat)?;
        // The triangle decides which side is seen. A smooth normal can point away from the eye although the triangle
        // does not.
        let seen = flat.map_or(normal.dot(v), |flat| flat.dot(v) * if flat.dot(normal) < 0.0 { -1.0 } else { 1.0 });
        Some(if seen < 0.0 { -normal } else { normal })
    }
}

impl MeshSearch<'_> {
    /// The unit normal of a hit triangle, and the unit normals of its vertices, 0 for one without direction.
    pub(super) fn normals(&self, hit: &MeshHit) -> (Option<DVec3>, Option<[DVec3; 3]>) {
        let mesh = &self.meshes[hit.mesh];
        let corners = mesh.triangles()[hit.triangle].map(|i| i as usize);
        let [a, b, c] = corners.map(|i| mesh.positions()[i]);
        let of_corners = mesh.normals().map(|normals| corners.map(|i| unit(normals[i]).unwrap_or(DVec3::ZERO)));
        (unit((b - a).cross(c - a)), of_corners)
    }
}

impl MeshHit {
    /// Whether both places lie in one triangle.
    pub(crate) fn is_in_triangle_of(&self, other: &Self) -> bool {
        (self.mesh, self.triangle) == (other.mesh, other.triangle)
    }
}

/// A vector scaled to length 1. Returns none for a vector without direction.
fn unit(v: DVec3) -> Option<DVec3> {
    let largest = v.abs().max_element();
    (largest > 0.0 && largest.is_finite()).then(|| (v / largest).normalize())
}
