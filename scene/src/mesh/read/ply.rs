//! PLY, of text or bytes in either order.

use super::{MeshReason, fan, malformed};
use crate::mesh::{MeshFault, TriangleMesh};
use glam::DVec3;
use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::PropertyAccessResult::{self, Ignored, Set};
use ply_rs_bw::ply::{ElementDef, Header, PropertyAccess};
use std::io::Cursor;

/// Names of the vertex's position and normal.
const VERTEX: [&str; 6] = ["x", "y", "z", "nx", "ny", "nz"];

/// Names of the list of a face's vertices.
const CORNERS: [&str; 2] = ["vertex_indices", "vertex_index"];

/// A vertex: position and normal.
#[derive(Default)]
struct Vertex([f64; 6]);

/// A face: its vertices, as the file gives them.
#[derive(Default)]
struct Face(Vec<i64>);

/// An element of another kind.
struct Other;

/// Methods of [`PropertyAccess`] that all do the same for each type of number.
macro_rules! for_numbers {
    ($call:ident: $($method:ident $number:ty),+) => {
        $(fn $method(&mut self, name: &str, value: $number) -> PropertyAccessResult { self.$call(name, value) })+
    };
}

impl Vertex {
    fn set(&mut self, name: &str, value: impl Into<f64>) -> PropertyAccessResult {
        let Some(at) = VERTEX.iter().position(|known| *known == name) else { return Ignored };
        self.0[at] = value.into();
        Set
    }
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self::default()
    }

    for_numbers!(set: set_char i8, set_uchar u8, set_short i16, set_ushort u16, set_int i32, set_uint u32,
        set_float f32, set_double f64);
}

impl Face {
    fn set(&mut self, name: &str, corners: Vec<impl Into<i64>>) -> PropertyAccessResult {
        if !CORNERS.contains(&name) {
            return Ignored;
        }
        self.0 = corners.into_iter().map(Into::into).collect();
        Set
    }
}

impl PropertyAccess for Face {
    fn new() -> Self {
        Self::default()
    }

    for_numbers!(set: set_list_char Vec<i8>, set_list_uchar Vec<u8>, set_list_short Vec<i16>,
        set_list_ushort Vec<u16>, set_list_int Vec<i32>, set_list_uint Vec<u32>);
}

impl PropertyAccess for Other {
    fn new() -> Self {
        Self
    }
}

/// Reads a file.
pub(super) fn parse(bytes: Vec<u8>) -> Result<TriangleMesh, MeshReason> {
    let length = bytes.len();
    let mut source = Reader::new(Cursor::new(bytes));
    let header = Parser::<Other>::new().read_header(&mut source).map_err(malformed)?;
    let (mut vertices, mut faces): (Vec<Vertex>, Vec<Face>) = (Vec::new(), Vec::new());
    for (name, element) in &header.elements {
        holds(element, length)?;
        match name.as_str() {
            "vertex" => vertices = read(&mut source, element, &header)?,
            "face" => faces = read(&mut source, element, &header)?,
            _ => _ = read::<Other>(&mut source, element, &header)?,
        }
    }
    let has = |names: &[&str]| {
        let vertex = header.elements.iter().find(|(name, _)| name.as_str() == "vertex");
        vertex.is_some_and(|(_, vertex)| names.iter().all(|name| vertex.properties.contains_key(*name)))
    };
    if !has(&VERTEX[..3]) {
        return Err(malformed("its vertices have no x, y and z"));
    }
    let triple = |at: usize| vertices.iter().map(move |v| DVec3::new(v.0[at], v.0[at + 1], v.0[at + 2])).collect();
    let mut triangles = Vec::new();
    for (triangle, face) in faces.iter().enumerate() {
        let corner = |&index: &i64| {
            let vertices = vertices.len();
            u32::try_from(index).map_err(|_| MeshFault::NoVertex { triangle, index, vertices })
        };
        let polygon: Vec<u32> = face.0.iter().map(corner).collect::<Result<_, _>>()?;
        triangles.extend(fan(&polygon));
    }
    Ok(TriangleMesh::new(triple(0), has(&VERTEX[3..]).then(|| triple(3)), triangles)?)
}

/// Checks that a file of so many bytes can hold an element as often as its header claims.
fn holds(element: &ElementDef, bytes: usize) -> Result<(), MeshReason> {
    // A number, a list's length and a line of text take a byte each.
    if element.count > bytes || element.count > 0 && element.properties.is_empty() {
        let claim = format!("it claims {} elements {:?}, and has {bytes} bytes", element.count, element.name);
        return Err(malformed(claim));
    }
    Ok(())
}

/// Reads the elements of one kind, which come next.
fn read<E: PropertyAccess>(
    source: &mut Reader<Cursor<Vec<u8>>>,
    element: &ElementDef,
    header: &Header,
) -> Result<Vec<E>, MeshReason> {
    Parser::<E>::new().read_payload_for_element(source, element, header).map_err(malformed)
}
