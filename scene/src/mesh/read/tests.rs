use super::*;
use crate::source::Disk;
use glam::DVec3;

const HEADER: &str = "ply\nformat FORMAT 1.0\ncomment by hand\nelement vertex 4\nproperty float x\nproperty double y\n\
                      property short z\nproperty uchar red\nelement face 2\nproperty list uchar LIST vertex_indices\n\
                      end_header\n";

/// A quadrilateral and a triangle, in text.
fn ply() -> String {
    let header = HEADER.replace("FORMAT", "ascii").replace("LIST", "int");
    format!("{header}0 0 0 9\n+5.0E-1 0 -0 9\n0.5 1.25 0 9\n0 1 -3 9\n4 0 1 2 3\n3 0 2 3\n")
}

/// The square as binary PLY, in either byte order.
fn binary_ply(big: bool) -> Vec<u8> {
    let format = if big { "binary_big_endian" } else { "binary_little_endian" };
    let mut bytes = HEADER.replace("FORMAT", format).replace("LIST", "ushort").into_bytes();
    let mut put = |le: &[u8]| {
        if big { bytes.extend(le.iter().rev()) } else { bytes.extend(le) }
    };
    for (x, y, z) in [(0f32, 0f64, 0i16), (0.5, 0.0, 0), (0.5, 1.25, 0), (0.0, 1.0, -3)] {
        put(&x.to_le_bytes());
        put(&y.to_le_bytes());
        put(&z.to_le_bytes());
        put(&[9]);
    }
    for face in [&[0u16, 1, 2, 3][..], &[0, 2, 3]] {
        put(&[face.len() as u8]);
        face.iter().for_each(|corner| put(&corner.to_le_bytes()));
    }
    bytes
}

fn read_bytes(name: &str, bytes: &[u8]) -> Result<TriangleMesh, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    read(&Disk, &path).map_err(|error| {
        assert!(error.path == path && !error.remedy().is_empty());
        error.to_string()
    })
}

#[test]
fn ply_of_every_order_and_type() {
    let mesh = read_bytes("a.ply", ply().as_bytes()).unwrap();
    let positions = [DVec3::ZERO, DVec3::new(0.5, 0.0, 0.0), DVec3::new(0.5, 1.25, 0.0), DVec3::new(0.0, 1.0, -3.0)];
    assert_eq!(mesh.positions(), positions);
    // The second face repeats a half of the first.
    assert_eq!((mesh.triangles(), mesh.normals()), (&[[0, 1, 2], [0, 2, 3]][..], None));
    for big in [false, true] {
        assert_eq!(read_bytes("a.PLY", &binary_ply(big)), Ok(mesh.clone()));
    }
}

#[test]
fn normals_of_vertices_are_read() {
    let text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty \
                float nx\nproperty float ny\nproperty float nz\nelement face 1\nproperty list uchar uint \
                vertex_index\nend_header\n0 0 0 0 0 1\n1 0 0 0 0 2\n0 1 0 0 1 1\n3 0 1 2\n";
    let normals = [DVec3::Z, DVec3::Z * 2.0, DVec3::new(0.0, 1.0, 1.0)];
    assert_eq!(read_bytes("a.ply", text.as_bytes()).unwrap().normals(), Some(&normals[..]));
    let obj = "o first\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 0 0 2\nvn 0 1 1\nf 1//1 2//2 3//3\n";
    let mesh = read_bytes("a.obj", obj.as_bytes()).unwrap();
    assert_eq!((mesh.normals(), mesh.triangles()), (Some(&normals[..]), &[[0, 1, 2]][..]));
    // An object without normals takes those of the others away.
    let more = format!("{obj}o second\nv 0 0 5\nv 1 0 5\nv 0 1 5\nv 1 1 5\nf 4 5 7 6\n");
    let mesh = read_bytes("a.obj", more.as_bytes()).unwrap();
    assert_eq!((mesh.normals(), mesh.triangles().len(), mesh.positions().len()), (None, 3, 7));
    assert_eq!(mesh.triangles()[1..], [[3, 4, 5], [3, 5, 6]]);
    assert_eq!(mesh.positions()[5], DVec3::new(1.0, 1.0, 5.0));
}

/// A facet of an STL of bytes: normal, corners, attribute.
fn facet(corners: [[f32; 3]; 3]) -> Vec<u8> {
    let numbers = [[0.0; 3]].into_iter().chain(corners).flatten();
    numbers.flat_map(f32::to_le_bytes).chain([0, 0]).collect()
}

fn binary_stl(header: &str, facets: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut bytes = header.as_bytes().to_vec();
    bytes.resize(80, b' ');
    bytes.extend((facets.len() as u32).to_le_bytes());
    bytes.extend(facets.iter().flat_map(|corners| facet(*corners)));
    bytes
}

/// A tree over boxes would take hours to join those of so many equal triangles.
#[test]
fn repeated_triangles_are_left_out() {
    let one = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let (mut other, mut signed) = (one, one);
    other.rotate_left(1);
    signed[0][2] = -0.0;
    let facets: Vec<[[f32; 3]; 3]> = (0..100_000).map(|i| [one, signed, other][i % 3]).collect();
    let mesh = read_bytes("a.stl", &binary_stl("equal", &facets)).unwrap();
    // The order of the corners decides how rounding goes, so that a turned triangle is another one.
    assert_eq!(mesh.triangles(), [[0, 1, 2], [6, 7, 8]]);
}

#[test]
fn stl_of_text_and_of_bytes_whatever_its_header_says() {
    let corners = [[0.0, 0.0, 0.0], [1.5, 0.0, 0.0], [0.0, 2.0, 0.25]];
    let text = "solid plate\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1.5 0 0\n   vertex 0 2 \
                0.25\n  endloop\n endfacet\nendsolid plate\n";
    let mesh = read_bytes("a.stl", text.as_bytes()).unwrap();
    assert_eq!(mesh.positions(), corners.map(|corner| DVec3::from_array(corner.map(f64::from))));
    for header in ["", "solid plate"] {
        assert_eq!(read_bytes("a.stl", &binary_stl(header, &[corners])), Ok(mesh.clone()), "{header:?}");
    }
}

#[test]
fn broken_files_are_told() {
    let (stl, ply) = (binary_stl("", &[[[0.0; 3], [1.0, 0.0, f32::NAN], [0.0; 3]]]), ply());
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (name, bytes, expected) in [
        ("a.off", b"OFF".to_vec(), "the suffix is none of a mesh"),
        ("a.stl", stl, "vertex 1 has a coordinate that is no finite number below 1e75"),
        ("a.stl", binary_stl("", &[]), "the mesh has no triangle"),
        ("a.stl", b"solid x\nfacet normal 0 0 1\n".to_vec(), "the file is no mesh: EOF while expecting"),
        (
            "a.stl",
            binary_stl("", &[[[0.0; 3]; 3]; 2])[..120].to_vec(),
            "the file is no mesh: failed to fill whole buffer",
        ),
        ("a.obj", format!("{obj}f 1 2 4\n").into_bytes(), "the file is no mesh: face vertex index out of bounds"),
        ("a.obj", obj.as_bytes().to_vec(), "the mesh has no triangle"),
        ("a.obj", b"v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".to_vec(), "vertex 0 has a coordinate"),
        ("a.ply", ply.replace("3 0 2 3", "3 0 2 4").into_bytes(), "triangle 2 has the vertex 4, and the mesh has 4"),
        ("a.ply", ply.replace("3 0 2 3", "3 0 2 -1").into_bytes(), "triangle 1 has the vertex -1, and the mesh has 4"),
        ("a.ply", ply.replace("0.5 1.25", "0.5 inf").into_bytes(), "the file is no mesh: Line 14: "),
        (
            "a.ply",
            ply.replace("float x", "float u").into_bytes(),
            "the file is no mesh: its vertices have no x, y and z",
        ),
        (
            "a.ply",
            ply.replace("face 2", "face 4000000000").into_bytes(),
            "the file is no mesh: it claims 4000000000 elements",
        ),
        (
            "a.ply",
            b"ply\nformat ascii 1.0\nelement a 3\nend_header\n".to_vec(),
            "the file is no mesh: it claims 3 elements",
        ),
        ("a.ply", b"plx\n".to_vec(), "the file is no mesh: "),
    ] {
        let text = read_bytes(name, &bytes).unwrap_err();
        assert!(text.starts_with(expected) && !text.contains('\n'), "{name}: {expected}\n{text}");
    }
    assert!(read(&Disk, Path::new("none.ply")).unwrap_err().to_string().starts_with("the mesh cannot be read: "));
}

/// A file that is cut anywhere is an error, and never a panic or a part of a mesh.
#[test]
fn a_file_that_is_cut_short_is_no_mesh() {
    let corners = [[0.0, 0.0, 0.0], [1.5, 0.0, 0.0], [0.0, 2.0, 0.25]];
    // The line break behind the last number may be missing.
    let text = ply().trim_end().to_owned().into_bytes();
    for (name, bytes) in [
        ("a.ply", text),
        ("a.ply", binary_ply(false)),
        ("a.ply", binary_ply(true)),
        ("a.stl", binary_stl("", &[corners; 3])),
    ] {
        for end in 0..bytes.len() {
            assert!(read_bytes(name, &bytes[..end]).is_err(), "{name}, {end} of {} bytes", bytes.len());
        }
    }
}
