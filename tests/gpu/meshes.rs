//! Opaque meshes on the card, as the reference draws them ([VS-12]).

use crate::double::{agrees, agrees_among, follows_the_camera, load};
use crate::gpu;
use crate::lines::lines;
pub(crate) use crate::mesh_scenes::{LAYERS, Meshes, scene};
use drypoint::gpu::{Gpu, GpuJob, Precision};
use drypoint::scene::picture::LayerKind;

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
        ("flat, rays at edges", scene("", &flat).replace("samples = 1\n", "")),
        ("along rays, encoded", scene("blend_space = \"srgb\"", &format!("[sampling]\nstep_along = \"ray\"\n{both}"))),
        ("cut beside a surface, parallel", parallel(scene(LAYERS, &format!("{CUT}{both}")))),
        ("a surface alone, beside an object", alone_beside_an_object(&meshes)),
        ("under halos", scene("", &format!("{halos}{both}{apart}"))),
    ] {
        agrees(name, &text);
    }
}

#[test]
fn lines_end_at_meshes() {
    let meshes = Meshes::new();
    let text = crate::lines::scene("samples = 1", &format!("[shading]\n{}", meshes.both()));
    agrees_among("lines", &text, lines);
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
    let of = |direction: &str| {
        let text = scene("", &format!("[shading]\n{}[[halo]]\n", meshes.both()));
        load(&text.replace("[0.4, 1, -0.3]", direction))
    };
    let [first, second] = ["[0.4, 1, -0.3]", "[-1, 0.2, -0.4]"].map(of);
    follows_the_camera(&gpu, [&first, &second]);
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
