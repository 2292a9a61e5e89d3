//! Opaque meshes on the card, as the reference draws them ([VS-12]).

use crate::double::{differences, differences_among, follows_the_camera, load};
use crate::gpu;
use crate::lines::lines;
use drypoint::gpu::{Gpu, GpuJob, Precision};
use drypoint::scene::glam::DVec3;
use drypoint::scene::picture::LayerKind;
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

/// An iso-surface without a function of its own, meshes, and an object with one.
pub(crate) fn alone_beside_an_object(meshes: &Meshes) -> String {
    let text = scene(LAYERS, "");
    let (picture, function) = text.split_once("[transfer]").unwrap();
    let surface = "[surface]\niso = 128\nlook = \"toon\"\n";
    format!("{picture}{surface}{}{OBJECT}[object.transfer]{function}", meshes.both())
}

/// A part of the torus, moved.
const OBJECT: &str = "[[object]]\nname = \"a\"\nvalue = [[90, 0], [130, 1]]\nmove = [0, -4, 2]\n";

const CUT: &str = r##"
[shading]
shininess = 7.3
[[clip]]
point = [11.3, 11.2, 11.1]
normal = [0.2, -1, 0.3]
space = "index"
cap = "#ff0000"
[surface]
iso = 150
look = "phong"
color = "#d8b4cc"
"##;

#[test]
fn meshes_are_drawn() {
    let meshes = Meshes::new();
    let both = meshes.both();
    let flat = meshes.mesh("flat.ply", "scale = [6, -4, 5]\nmove = [12, 7, 10]");
    // Two cubes, one before the volume and one behind it.
    let apart = meshes.mesh("cube.ply", "scale = [30, 1, 9]\nmove = [23, 41, 2]")
        + &meshes.mesh("cube.ply", "scale = [1, 2, 3]\nmove = [3, -14, 18]");
    let halos = "[[halo]]\nevery = 3\n[[halo]]\nkind = \"emissive\"\n";
    let parallel = |text: String| text.replace("[camera]\n", "[camera]\nprojection = \"orthographic\"\n");
    for (name, text) in [
        ("layers", scene(LAYERS, &format!("[shading]\n{both}"))),
        ("flat, rays at edges", scene("", &flat).replace("samples = 1\n", "")),
        ("along rays, encoded", scene("blend_space = \"srgb\"", &format!("[sampling]\nstep_along = \"ray\"\n{both}"))),
        ("cut beside a surface, parallel", parallel(scene(LAYERS, &format!("{CUT}{both}")))),
        ("beside an object", scene(LAYERS, &format!("{OBJECT}{both}"))),
        ("a surface alone, beside an object", alone_beside_an_object(&meshes)),
        ("under halos", scene("", &format!("{halos}{both}{apart}"))),
    ] {
        let Some([double, single]) = differences(&text) else { return };
        println!("{name}: f64 {double:.1e}, f32 {single:.1e}");
        assert!(double < 1e-9, "{name}: {double:e}");
    }
}

#[test]
fn lines_end_at_meshes() {
    let meshes = Meshes::new();
    let text = crate::lines::scene("samples = 1", &format!("[shading]\n{}", meshes.both()));
    let Some([double, single]) = differences_among(&text, lines) else { return };
    println!("lines: f64 {double:.1e}, f32 {single:.1e}");
    assert!(double < 1e-9, "{double:e}");
}

/// The number of rays that leave a closed mesh unmet, with an edited shader. The eye is in the middle, and looks at a corner:
/// the middle row and the middle column are edges of triangles.
pub(crate) fn rays_unmet(gpu: &Gpu, precision: Precision, edit: &dyn Fn(String) -> String) -> usize {
    let meshes = Meshes::new();
    let eye = "eye = [11.5, 11.5, 11.5]\ntarget = [11.5, 11.5, 60]\nup = [0, 1, 0]\nfov = 90\n";
    let text = scene("", &meshes.mesh("flat.ply", "scale = 100\ncenter = [0, 0, 0]\nmove = [11.5, 11.5, 11.5]"))
        .replace("direction = [0.4, 1, -0.3]\n", eye)
        .replace("background = \"#203040\"", "background = \"none\"")
        .replace("size = [40, 32]", "size = [255, 255]");
    let job = load(&text);
    let on_gpu = GpuJob::new(&job, gpu, precision).unwrap_or_else(|failure| panic!("{failure}"));
    let mut renderer = on_gpu.edited(edit).unwrap_or_else(|failure| panic!("{failure}"));
    let picture = renderer.frame(&|_| ()).unwrap_or_else(|failure| panic!("{failure}"));
    let opacities = &picture.layer(LayerKind::Beauty).unwrap().channels[3];
    opacities.iter().filter(|&&opacity| opacity < 0.99).count()
}

#[test]
fn no_ray_passes_between_triangles() {
    let Some(gpu) = gpu() else { return };
    assert_eq!(rays_unmet(&gpu, Precision::Single, &|text| text), 0);
    if gpu.has_double() {
        assert_eq!(rays_unmet(&gpu, Precision::Double, &|text| text), 0);
    }
}

/// A renderer that is turned draws what a new one draws: the light of meshes follows the camera.
#[test]
fn meshes_follow_the_camera() {
    let Some(gpu) = gpu() else { return };
    let meshes = Meshes::new();
    for more in ["", "[[halo]]\n"] {
        let of = |direction: &str| {
            let text = scene("", &format!("[shading]\n{}{more}", meshes.both()));
            load(&text.replace("[0.4, 1, -0.3]", direction))
        };
        let [first, second] = ["[0.4, 1, -0.3]", "[-1, 0.2, -0.4]"].map(of);
        follows_the_camera(&gpu, [&first, &second]);
    }
}

/// In f32 products of coordinates so far away are not numbers.
#[test]
fn meshes_that_are_too_far_away_are_refused() {
    let Some(gpu) = gpu() else { return };
    let meshes = Meshes::new();
    let job = load(&scene("", &meshes.mesh("flat.ply", "move = [0, 2e9, 0]")));
    let failure = GpuJob::new(&job, &gpu, Precision::Single).unwrap().renderer().map(|_| ()).unwrap_err().to_string();
    assert!(failure.contains("graphics cards cannot draw meshes so far from the volume yet"), "{failure}");
}
