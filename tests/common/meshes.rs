//! Scenes with opaque meshes as texts.

// Each binary uses its own part.
#![allow(dead_code)]

use drypoint::scene::glam::DVec3;
use std::fmt::Write;
use std::path::PathBuf;

/// A torus with an opaque ball in it.
const SCENE: &str = r##"
drypoint = 1
[volume]
phantom = { name = "torus", size = 24 }
[camera]
direction = [0.4, 1, -0.3]
[picture]
size = [40, 32]
samples = 1
background = "#203040"
LAYERS
[transfer]
kind = "regular"
nodes = [{ at = 90, color = "#804020", opacity = 0 }, { at = 128, color = "#ffcc88", opacity = 0.1 },
         { at = 140, color = "#88ccff", opacity = 0.4 }]
"##;

/// Layers of all that a mesh has, and of what it has not.
pub(crate) const LAYERS: &str =
    "layers = [\"beauty\", \"Z\", \"depth\", \"normal\", \"first\", \"first.normal\", \"gradient\"]";

/// Meshes in PLY.
pub(crate) struct Meshes {
    folder: tempfile::TempDir,
}

impl Meshes {
    pub(crate) fn new() -> Self {
        let meshes = Self { folder: tempfile::tempdir().unwrap() };
        let (corners, faces) = ball(3);
        meshes.write("smooth.ply", &corners, true, &faces);
        meshes.write("flat.ply", &corners, false, &faces);
        let cube: Vec<DVec3> = (0..8)
            .map(|i| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)) * 2.0 - 1.0)
            .collect();
        // Corners go around each side, outwards or inwards.
        let sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 6, 7, 3], [0, 2, 6, 4], [1, 3, 7, 5]];
        meshes.write("cube.ply", &cube, false, &sides);
        meshes
    }

    fn write<const N: usize>(&self, name: &str, corners: &[DVec3], has_normals: bool, faces: &[[usize; N]]) {
        let normals = if has_normals { "property double nx\nproperty double ny\nproperty double nz\n" } else { "" };
        let (vertices, count) = (corners.len(), faces.len());
        let mut text = format!(
            "ply\nformat ascii 1.0\nelement vertex {vertices}\nproperty double x\nproperty double y\nproperty double \
             z\n{normals}element face {count}\nproperty list uchar int vertex_indices\nend_header\n"
        );
        for p in corners {
            let _ = write!(text, "{} {} {}", p.x, p.y, p.z);
            // A place on the unit sphere is its normal.
            let _ = if has_normals { writeln!(text, " {} {} {}", p.x, p.y, p.z) } else { writeln!(text) };
        }
        for face in faces {
            let _ = writeln!(text, "{N} {}", face.map(|i| i.to_string()).join(" "));
        }
        std::fs::write(self.path(name), text).unwrap();
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// A table of a mesh.
    pub(crate) fn mesh(&self, name: &str, more: &str) -> String {
        format!("[[mesh]]\nfile = {:?}\n{more}\n", self.path(name).display().to_string())
    }

    /// A ball that cuts the torus, and a cube beside it.
    pub(crate) fn both(&self) -> String {
        let ball = self.mesh("smooth.ply", "color = \"#d04030\"\nscale = 5\nmove = [11.2, 5.3, 9.7]");
        let cube = "scale = [3, 4, 2.5]\nrotate = { axis = [1, 2, 0.5], angle = 40 }\nmove = [6, 9, 14]";
        ball + &self.mesh("cube.ply", cube)
    }
}

/// The unit sphere as an octahedron whose triangles are cut in four so many times.
fn ball(level: usize) -> (Vec<DVec3>, Vec<[usize; 3]>) {
    let mut corners = vec![DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
    // Corners of each side go around it the same way, as seen from outside.
    let side = |i: usize| {
        let [a, b, c] = [3 * (i & 1), 1 + 3 * (i >> 1 & 1), 2 + 3 * (i >> 2)];
        if i.count_ones().is_multiple_of(2) { [a, b, c] } else { [a, c, b] }
    };
    let mut faces: Vec<[usize; 3]> = (0..8).map(side).collect();
    for _ in 0..level {
        let cut = |&[a, b, c]: &[usize; 3]| {
            let mut middle = |a: usize, b: usize| {
                let place = (corners[a] + corners[b]).normalize();
                corners.iter().position(|&corner| corner == place).unwrap_or_else(|| {
                    corners.push(place);
                    corners.len() - 1
                })
            };
            let [d, e, f] = [middle(a, b), middle(b, c), middle(c, a)];
            [[a, d, f], [d, b, e], [f, e, c], [d, e, f]]
        };
        faces = faces.iter().flat_map(cut).collect();
    }
    (corners, faces)
}

/// The scene with keys of its picture and further tables.
pub(crate) fn scene(keys: &str, more: &str) -> String {
    SCENE.replace("LAYERS\n", &format!("{keys}\n")) + more
}
