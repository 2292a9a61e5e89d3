//! Meshes of triangles, where rays end ([VS-12]).

use crate::inputs::ObjectInputs;
use crate::module::module;
use crate::shader::{Constant, Data, Shader};
use crate::{GpuError, Precision, shading};
use drypoint_scene::glam::DVec3;
use drypoint_scene::mesh::{BoxNode, TriangleMesh};
use drypoint_scene::shot::{Lighting, Shot};
use drypoint_scene::space::Grid;

/// The largest index coordinate of a vertex. With it no area of a triangle overflows in f32.
const FARTHEST: f64 = 1e9;

/// Adds the meshes of a shot, before an iso-surface is added. `value` is the value 0 in the shader's numbers.
pub(crate) fn add(
    shader: &mut Shader,
    shot: &Shot,
    (meshes, inputs): (&[TriangleMesh], &ObjectInputs<'_>),
    value: f64,
    precision: Precision,
) -> Result<(), GpuError> {
    let boxes = &inputs.measured.mesh_boxes;
    let first = shot.meshes.first().ok_or(GpuError::Material)?;
    let triangles: usize = meshes.iter().map(|mesh| mesh.triangles().len()).sum();
    // Each leaf has one triangle. All meshes of a scene have one light.
    let fits = shot.meshes.len() == meshes.len() && boxes.len() + 1 == 2 * triangles;
    let (true, Lighting::Phong(phong)) = (fits, &first.lit.lighting) else { return Err(GpuError::Material) };
    if shot.meshes.iter().any(|mesh| mesh.lit != first.lit) {
        return Err(GpuError::Material);
    }
    let vertices = vertices(meshes, inputs.data.volume.grid());
    if vertices.iter().any(|vertex| vertex.abs().max_element() > FARTHEST) {
        return Err(GpuError::Missing { what: "meshes so far from the volume", key: "mesh" });
    }
    let (bounds, mut words) = flattened(boxes);
    words.extend(corners(meshes));
    shader.constant("MESH_BOXES", Constant::Int(boxes.len() as i64));
    shader.constant("MESH_TRIANGLES", Constant::Int(triangles as i64));
    shader.constant("MESH_VERTICES", Constant::Int(vertices.len() as i64));
    let colors = shot.meshes.iter().map(|mesh| DVec3::from_array(mesh.rgb));
    let vectors = vertices.into_iter().chain(normals(meshes)).chain(flat_normals(meshes)).chain(colors);
    shader.bind(27, "the boxes of meshes", Data::Reals(bounds));
    shader.bind(28, "the triangles of meshes", Data::Words(words));
    shader.bind(29, "the vertices of meshes", Data::Reals(vectors.flat_map(|v| v.to_array()).collect()));
    // Relative errors of boxes, of differences and products with them, and of the test of a triangle are a few ε.
    let epsilon = match precision {
        Precision::Single => f64::from(f32::EPSILON),
        Precision::Double => f64::EPSILON,
    };
    shader.block.number("mesh_slack", 64.0 * epsilon);
    shader.block.number("mesh_value", value);
    shading::add_to_meshes(shader, phong);
    shader.add(&[module!("triangle"), module!("tree"), module!("nearest"), module!("nearest_normal"), module!("end")]);
    shader.stages.ends.push("meet_mesh");
    Ok(())
}

/// Adds the search for the nearest mesh, after the search for an iso-surface.
pub(crate) fn add_search(shader: &mut Shader) {
    shader.stages.begin_ray.push("find_mesh");
}

/// The vertices of all meshes in the index space of a grid.
fn vertices(meshes: &[TriangleMesh], grid: &Grid) -> Vec<DVec3> {
    meshes.iter().flat_map(TriangleMesh::positions).map(|&p| grid.to_index(p)).collect()
}

/// The unit normals of all vertices; 0 if a vertex has none.
fn normals(meshes: &[TriangleMesh]) -> impl Iterator<Item = DVec3> {
    meshes.iter().flat_map(|mesh| {
        let normal = |i: usize| mesh.normals().map_or(DVec3::ZERO, |normals| unit(normals[i]));
        (0..mesh.positions().len()).map(normal)
    })
}

/// The unit normals of all triangles; 0 if a triangle has none.
fn flat_normals(meshes: &[TriangleMesh]) -> impl Iterator<Item = DVec3> {
    meshes.iter().flat_map(|mesh| {
        mesh.triangles().iter().map(|triangle| {
            let [a, b, c] = triangle.map(|i| mesh.positions()[i as usize]);
            unit((b - a).cross(c - a))
        })
    })
}

/// A vector scaled to length 1; 0 for a vector without direction.
fn unit(v: DVec3) -> DVec3 {
    (v / v.abs().max_element()).try_normalize().unwrap_or(DVec3::ZERO)
}

/// The corners of all triangles as indices of vertices of all meshes, and the triangles' meshes.
fn corners(meshes: &[TriangleMesh]) -> impl Iterator<Item = u32> {
    let mut before = 0;
    let numbered = (0..).zip(meshes).map(move |(number, mesh)| {
        let first = before;
        before += mesh.positions().len() as u32;
        (number, first, mesh)
    });
    numbered.flat_map(|(number, first, mesh)| {
        mesh.triangles().iter().flat_map(move |&[a, b, c]| [first + a, first + b, first + c, number])
    })
}

/// The bounds of the boxes of a tree, each box before those inside it. For each box there is the index after its last
/// inner box, then the triangle of a leaf.
fn flattened(boxes: &[BoxNode]) -> (Vec<f64>, Vec<u32>) {
    let (mut order, mut open) = (Vec::with_capacity(boxes.len()), vec![0]);
    while let Some(node) = open.pop() {
        order.push(node);
        let BoxNode { first, is_leaf, .. } = boxes[node];
        open.extend([1, 0].map(|child| first as usize + child).iter().filter(|_| !is_leaf));
    }
    // The boxes inside each one follow it, so counting from the end has theirs first.
    let mut counts = vec![1; boxes.len()];
    for &node in order.iter().rev().filter(|&&node| !boxes[node].is_leaf) {
        let first = boxes[node].first as usize;
        counts[node] += counts[first] + counts[first + 1];
    }
    let bounds = order.iter().flat_map(|&node| [boxes[node].lo, boxes[node].hi]).flat_map(|v| v.to_array()).collect();
    let word = |(place, &node): (usize, &usize)| [(place + counts[node]) as u32, boxes[node].first];
    (bounds, order.iter().enumerate().flat_map(word).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn node(at: f64, first: u32, is_leaf: bool) -> BoxNode {
        BoxNode { lo: DVec3::splat(at), hi: DVec3::splat(at + 1.0), first, is_leaf }
    }

    /// The root has the children 3 and 4, and 3 has the leaves 1 and 2.
    #[test]
    fn boxes_stand_before_those_inside_them() {
        let boxes =
            [node(0.0, 3, false), node(1.0, 7, true), node(2.0, 8, true), node(3.0, 1, false), node(4.0, 9, true)];
        let (bounds, words) = flattened(&boxes);
        let lows: Vec<f64> = bounds.iter().step_by(6).copied().collect();
        assert_eq!(lows, [0.0, 3.0, 1.0, 2.0, 4.0]);
        assert_eq!(words.chunks(2).map(|word| word[0]).collect::<Vec<_>>(), [5, 4, 3, 4, 5]);
        assert_eq!([words[5], words[7], words[9]], [7, 8, 9]);
        assert_eq!(flattened(&boxes[1..2]), (vec![1.0, 1.0, 1.0, 2.0, 2.0, 2.0], vec![1, 7]));
    }

    #[test]
    fn triangles_count_the_vertices_of_all_meshes() {
        let mesh = |n: u32| {
            let corners = (0..n).map(|i| DVec3::new(f64::from(i), f64::from(i * i), 0.0)).collect();
            TriangleMesh::new(corners, None, vec![[0, 1, n - 1]]).unwrap()
        };
        let meshes = [mesh(4), mesh(3)];
        assert_eq!(corners(&meshes).collect::<Vec<_>>(), [0, 1, 3, 0, 4, 5, 6, 1]);
        assert_eq!(normals(&meshes).collect::<Vec<_>>(), [DVec3::ZERO; 7]);
        assert_eq!(flat_normals(&meshes).collect::<Vec<_>>(), [DVec3::Z; 2]);
        assert_eq!([unit(DVec3::ZERO), unit(DVec3::X * 1e-200)], [DVec3::ZERO, DVec3::X]);
    }
}
