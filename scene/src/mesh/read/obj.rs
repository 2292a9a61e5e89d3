//! Wavefront OBJ. Materials and texture coordinates are passed over.

use super::{MeshReason, malformed};
use crate::mesh::TriangleMesh;
use glam::DVec3;
use tobj::{LoadError, LoadOptions};

/// Reads a file; its objects and groups become one mesh. Normals are used if all of these parts have some.
pub(super) fn parse(bytes: Vec<u8>) -> Result<TriangleMesh, MeshReason> {
    // One index for positions and normals. Points and lines are no surface.
    let options = LoadOptions { single_index: true, triangulate: true, ignore_points: true, ignore_lines: true };
    let no_materials = |_: &std::path::Path| Err(LoadError::OpenFileFailed);
    let (models, _) = tobj::load_obj_buf(&mut bytes.as_slice(), &options, no_materials).map_err(malformed)?;
    let vectors = |numbers: &[f64]| -> Vec<DVec3> { numbers.chunks_exact(3).map(DVec3::from_slice).collect() };
    let (mut positions, mut normals, mut triangles) = (Vec::new(), Some(Vec::new()), Vec::new());
    for mesh in models.into_iter().map(|model| model.mesh).filter(|mesh| !mesh.indices.is_empty()) {
        let first = u32::try_from(positions.len()).map_err(malformed)?;
        let corner = |i: u32| first.checked_add(i).ok_or_else(|| malformed("it has more than 2³² vertices"));
        for triangle in mesh.indices.chunks_exact(3) {
            triangles.push([corner(triangle[0])?, corner(triangle[1])?, corner(triangle[2])?]);
        }
        positions.extend(vectors(&mesh.positions));
        let of_mesh = Some(vectors(&mesh.normals)).filter(|normals| 3 * normals.len() == mesh.positions.len());
        normals = normals.zip(of_mesh).map(|(mut all, more)| {
            all.extend(more);
            all
        });
    }
    Ok(TriangleMesh::new(positions, normals, triangles)?)
}
