//! STL, of text or bytes.

use super::{MeshReason, malformed};
use crate::mesh::TriangleMesh;
use glam::DVec3;
use std::io::Cursor;

/// Bytes before the first triangle of a binary file: a header of 80 and a number.
const HEADER: usize = 84;

/// Bytes of a triangle.
const TRIANGLE: usize = 50;

/// Reads a file. Its normals are those of facets, which follow from the corners.
pub(super) fn parse(mut bytes: Vec<u8>) -> Result<TriangleMesh, MeshReason> {
    // Some programs begin the header of a binary file with the word of a text. Its length tells.
    let count = bytes.get(80..HEADER).map(|n| u32::from_le_bytes([n[0], n[1], n[2], n[3]]) as usize);
    if count.and_then(|n| n.checked_mul(TRIANGLE)?.checked_add(HEADER)) == Some(bytes.len()) {
        bytes[..80].fill(0);
    }
    let mut source = Cursor::new(bytes);
    let facets = stl_io::create_stl_reader(&mut source).map_err(malformed)?;
    let mut positions = Vec::new();
    for facet in facets {
        let corners = facet.map_err(malformed)?.vertices;
        positions.extend(corners.map(|corner| DVec3::from_array(corner.0.map(f64::from))));
    }
    let count = u32::try_from(positions.len() / 3).unwrap_or(u32::MAX / 3).min(u32::MAX / 3);
    let triangles = (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    Ok(TriangleMesh::new(positions, None, triangles)?)
}
