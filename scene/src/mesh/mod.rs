//! Meshes of triangles: opaque geometry beside a volume ([VS-12]).

mod box_node;
pub mod read;

pub use box_node::BoxNode;
use glam::{DAffine3, DVec3};
use std::collections::HashSet;

/// A mesh of triangles, in world units.
#[derive(Clone, Debug, PartialEq)]
pub struct TriangleMesh {
    positions: Vec<DVec3>,
    normals: Option<Vec<DVec3>>,
    triangles: Vec<[u32; 3]>,
}

/// Numbers that make no mesh. Vertices and triangles count from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeshFault {
    /// There is nothing to see.
    #[error("the mesh has no triangle")]
    Empty,
    /// A corner of a triangle is not in the list of vertices.
    #[error("triangle {triangle} has the vertex {index}, and the mesh has {vertices}")]
    NoVertex {
        /// The triangle.
        triangle: usize,
        /// The corner as the file gives it.
        index: i64,
        /// The number of vertices.
        vertices: usize,
    },
    /// A position or a normal is NaN, infinite, or so large that its products overflow.
    #[error("vertex {vertex} has a coordinate that is no finite number below 1e75")]
    NotFinite {
        /// The vertex.
        vertex: usize,
    },
}

/// Coordinates stay below this, so that no product of four of them overflows.
const LARGEST: f64 = 1e75;

impl TriangleMesh {
    /// Makes a mesh of vertices and triangles, which are triples of vertices. Normals belong to vertices and have any
    /// length; without normals, triangles are flat.
    ///
    /// # Errors
    /// No triangle, a corner that is no vertex, a number that is not finite.
    pub fn new(
        positions: Vec<DVec3>,
        normals: Option<Vec<DVec3>>,
        triangles: Vec<[u32; 3]>,
    ) -> Result<Self, MeshFault> {
        let vertices = positions.len();
        for (triangle, corners) in triangles.iter().enumerate() {
            if let Some(&index) = corners.iter().find(|&&corner| corner as usize >= vertices) {
                return Err(MeshFault::NoVertex { triangle, index: i64::from(index), vertices });
            }
        }
        let normals = normals.filter(|normals| normals.len() == vertices);
        let is_wrong = |v: &DVec3| v.is_nan() || v.abs().max_element() >= LARGEST;
        if let Some(vertex) =
            positions.iter().position(is_wrong).or_else(|| normals.as_ref()?.iter().position(is_wrong))
        {
            return Err(MeshFault::NotFinite { vertex });
        }
        if triangles.is_empty() { Err(MeshFault::Empty) } else { Ok(Self { positions, normals, triangles }) }
    }

    /// The vertices.
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// The normals of the vertices, if the mesh has them.
    pub fn normals(&self) -> Option<&[DVec3]> {
        self.normals.as_deref()
    }

    /// The triangles: three vertices each.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The centre of the mesh's box.
    pub fn centre(&self) -> DVec3 {
        let lo = self.positions.iter().copied().reduce(DVec3::min).unwrap_or(DVec3::ZERO);
        let hi = self.positions.iter().copied().reduce(DVec3::max).unwrap_or(DVec3::ZERO);
        (lo + hi) / 2.0
    }

    /// Moves the mesh by an affine map of the world whose linear part is not singular. Normals turn with the surface.
    ///
    /// # Errors
    /// A vertex that moves out of range.
    pub fn moved(self, map: &DAffine3) -> Result<Self, MeshFault> {
        let positions = self.positions.iter().map(|&p| map.transform_point3(p)).collect();
        let of_normals = map.matrix3.inverse().transpose();
        let normals = self.normals.map(|normals| normals.iter().map(|&n| of_normals * n).collect());
        Self::new(positions, normals, self.triangles)
    }

    /// Leaves out each triangle that has the corners of an earlier triangle, in the same order. A line meets both at
    /// one place and sees the first. A tree over equal boxes would take quadratic time.
    fn without_repeated(mut self) -> Self {
        let positions = &self.positions;
        // The sum turns −0 into 0.
        let corner = |i: u32| positions[i as usize].to_array().map(|x| (x + 0.0).to_bits());
        let mut seen = HashSet::with_capacity(self.triangles.len());
        self.triangles.retain(|triangle| seen.insert(triangle.map(corner)));
        self
    }

    /// Size in bytes.
    pub fn bytes(&self) -> usize {
        let normals = self.normals.as_deref().map_or(0, size_of_val::<[DVec3]>);
        size_of_val(self.positions.as_slice()) + normals + size_of_val(self.triangles.as_slice())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corners() -> Vec<DVec3> {
        vec![DVec3::ZERO, DVec3::X, DVec3::Y]
    }

    #[test]
    fn faults_are_told_by_their_place() {
        let of = |positions: Vec<DVec3>, triangles: &[[u32; 3]]| {
            TriangleMesh::new(positions, None, triangles.to_vec()).unwrap_err().to_string()
        };
        assert_eq!(of(corners(), &[]), "the mesh has no triangle");
        assert_eq!(of(corners(), &[[0, 1, 2], [0, 3, 1]]), "triangle 1 has the vertex 3, and the mesh has 3");
        for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e80] {
            let mut positions = corners();
            positions[2].y = wrong;
            assert!(of(positions, &[[0, 1, 2]]).starts_with("vertex 2 has a coordinate that is no finite"), "{wrong}");
        }
        let normals = Some(vec![DVec3::Z, DVec3::splat(f64::NAN), DVec3::Z]);
        assert_eq!(TriangleMesh::new(corners(), normals, vec![[0, 1, 2]]), Err(MeshFault::NotFinite { vertex: 1 }));
    }

    #[test]
    fn normals_stay_perpendicular_when_a_mesh_is_moved() {
        // The plane x + y = 1, stretched along y.
        let normals = Some(vec![DVec3::new(1.0, 1.0, 0.0); 3]);
        let mesh = TriangleMesh::new(corners(), normals, vec![[0, 1, 2]]).unwrap();
        assert_eq!(mesh.centre(), DVec3::new(0.5, 0.5, 0.0));
        let map = DAffine3::from_translation(DVec3::X * 5.0) * DAffine3::from_scale(DVec3::new(1.0, 4.0, 1.0));
        let moved = mesh.moved(&map).unwrap();
        assert_eq!(
            moved.positions(),
            [DVec3::new(5.0, 0.0, 0.0), DVec3::new(6.0, 0.0, 0.0), DVec3::new(5.0, 4.0, 0.0)]
        );
        let edge = moved.positions()[2] - moved.positions()[1];
        assert!(moved.normals().unwrap().iter().all(|n| n.dot(edge) == 0.0 && n.length() > 0.5));
    }
}
