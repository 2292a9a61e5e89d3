//! Files of meshes: PLY, STL and OBJ, by their suffix. Crates of other authors parse the files; their results are
//! checked.

mod obj;
mod ply;
mod stl;

use super::{MeshFault, TriangleMesh};
use crate::memory;
use crate::source::Source;
use std::fmt;
use std::path::{Path, PathBuf};

/// The suffixes of mesh files.
pub const SUFFIXES: [&str; 3] = ["ply", "stl", "obj"];

/// A file that is no mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshError {
    /// The file.
    pub path: PathBuf,
    /// The reason.
    pub reason: MeshReason,
}

/// The reason why a file is no mesh.
#[derive(Clone, Debug, PartialEq)]
pub enum MeshReason {
    /// The system cannot read it.
    Unreadable(String),
    /// A suffix of no format that is read.
    Suffix,
    /// Text or bytes that the format does not allow, with the parser's message.
    Malformed(String),
    /// Numbers that make no mesh.
    Fault(MeshFault),
}

impl MeshError {
    /// The remedy.
    pub fn remedy(&self) -> &'static str {
        match self.reason {
            MeshReason::Unreadable(_) => "check the path, and that the file can be read",
            MeshReason::Suffix => "write the path of a .ply, .stl or .obj file",
            MeshReason::Malformed(_) => "get the file again, or export the mesh anew",
            MeshReason::Fault(MeshFault::Empty) => "name a mesh of triangles or polygons, not of points or lines",
            MeshReason::Fault(_) => "repair the mesh in the program that made it",
        }
    }
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.reason {
            MeshReason::Unreadable(reason) => write!(f, "the mesh cannot be read: {reason}"),
            MeshReason::Suffix => f.write_str("the suffix is none of a mesh"),
            MeshReason::Malformed(reason) => write!(f, "the file is no mesh: {reason}"),
            MeshReason::Fault(fault) => fault.fmt(f),
        }
    }
}

impl std::error::Error for MeshError {}

impl From<MeshFault> for MeshReason {
    fn from(fault: MeshFault) -> Self {
        Self::Fault(fault)
    }
}

/// Reads a mesh, as the suffix says. Polygons become fans of triangles about their first corner. Repeated triangles are
/// left out.
///
/// # Errors
/// A file that cannot be read, is cut short, has text or numbers that its format does not have, or no triangle.
pub fn read(source: &dyn Source, path: &Path) -> Result<TriangleMesh, MeshError> {
    /// Bytes in memory for each byte of a file, at most: the parsed text of a face of few digits.
    const EACH: u64 = 32;
    let read = || {
        let suffix = path.extension().map(|suffix| suffix.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
        let parse: fn(Vec<u8>) -> Result<TriangleMesh, MeshReason> = match suffix.as_str() {
            "ply" => ply::parse,
            "stl" => stl::parse,
            "obj" => obj::parse,
            _ => return Err(MeshReason::Suffix),
        };
        let unreadable = |error: std::io::Error| MeshReason::Unreadable(error.to_string());
        let bytes = memory::read(source, path).map_err(unreadable)?;
        memory::room_for(bytes.len() as u64, EACH).map_err(|no_room| unreadable(no_room.into()))?;
        parse(bytes).map(TriangleMesh::without_repeated)
    };
    read().map_err(|reason| MeshError { path: path.to_path_buf(), reason })
}

/// The triangles of a polygon of vertices of a mesh: a fan about the first.
fn fan(polygon: &[u32]) -> impl Iterator<Item = [u32; 3]> + '_ {
    polygon.windows(2).skip(1).map(|edge| [polygon[0], edge[0], edge[1]])
}

/// A parser's message on one line.
fn malformed(message: impl fmt::Display) -> MeshReason {
    let text = message.to_string();
    MeshReason::Malformed(text.split_whitespace().collect::<Vec<_>>().join(" "))
}

#[cfg(test)]
mod tests;
