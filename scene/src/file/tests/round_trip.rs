//! The scene with every default filled in is a scene file, and the same scene.

use super::*;
use crate::tables::{
    Background, Camera, Length, LightDirection, NodeColor, PhantomSource, PictureSettings, Projection, Sampling,
    Shading, Styles, VolumeSource,
};
use crate::volume::VoxelType;
use glam::DVec3;

/// A scene that says much.
pub(super) const FULL_OF_KEYS: &str = r##"drypoint = 1
light = { world = [1, 2, 3] }
[volume]
phantom = { name = "torus", size = [64, 64, 32], spacing = [1, 1, 2], type = "i16", param = { R = 20, r = 8 } }
range = [-1000, 3000.5]
gradient_range = "q0.99"
outside = "high"
[camera]
projection = "orthographic"
height = 256
eye = [1, 2, 3]
direction = [0, 1, 0]
up = [0, 0, 1]
[picture]
width = "180 mm"
height = "120 mm"
dpi = 72
samples = 2
background = "#10203040"
blend_space = "srgb"
bits = 16
layers = ["beauty", "Z", "curvature"]
[sampling]
step = 0.1
kernel = "bspline"
hessian = "analytic"
stop_below = 1e-3
[transfer]
kind = "regular"
unit = "normalized"
nodes = [
  { at = 0, color = "#c0804080", opacity = 0.3 },
  { at = 0.7, color = "rebeccapurple" },
]
table = "exact"
[styles]
wax = "wax.png"
"my wax" = { file = "my wax.png", linear = true }
[shading]
ambient = 0.1
light = [0, 0, 1]
[contours]
kappa = "none"
threshold = 0.25
fade = [0.02, 0.05]
"##;

#[test]
fn full_scenes_read_back_to_the_same_scene_and_text() {
    let mut scenes = vec![parse(FULL_OF_KEYS, Path::new("a/b.toml"), &Overrides::default()).unwrap()];
    scenes.extend(["", "[contours]\n", "[shading]\nlight = \"head\"\n", "[camera]\neye = [0, 0, 0]\n"].map(scene));
    scenes.push(Scene::for_volume(VolumeSource::File { path: "x \"y\"\\é.nrrd".into(), raw: None }));
    for scene in scenes {
        let full = write_full(&scene);
        let back =
            parse(&full, Path::new("full.toml"), &Overrides::default()).unwrap_or_else(|f| panic!("{full}\n{f}"));
        assert_eq!(back, scene, "{full}");
        assert_eq!(write_full(&back), full);
    }
}

#[test]
fn keys_mean_what_they_say() {
    let scene = parse(FULL_OF_KEYS, Path::new("a/b.toml"), &Overrides::default()).unwrap();
    assert_eq!(scene.light, LightDirection::World(DVec3::new(1.0, 2.0, 3.0)));
    assert_eq!(
        scene.volume.source,
        VolumeSource::Phantom(PhantomSource {
            name: "torus".into(),
            size: [64, 64, 32],
            spacing: [1.0, 1.0, 2.0],
            voxel_type: VoxelType::I16,
            params: vec![("R".into(), 20.0), ("r".into(), 8.0)],
        })
    );
    assert_eq!(scene.camera.projection, Projection::Orthographic { height: Some(Length::World(256.0)) });
    assert!(scene.camera.direction_given);
    // 180 mm at 72 dpi are 510.24 px, 120 mm are 340.16.
    assert_eq!(scene.picture.size, [510, 340]);
    let Background::Color([_, _, _, alpha]) = scene.picture.background else { panic!() };
    assert_eq!(alpha, 64.0 / 255.0);
    let nodes = scene.transfer.unwrap().nodes.unwrap();
    assert_eq!(nodes[0].opacity, 0.3 * (128.0 / 255.0), "the colour's opacity multiplies the node's");
    assert_eq!(nodes[1].opacity, 1.0);
    assert!(matches!(nodes[1].color, NodeColor::Color([_, g, _]) if (g - 0.033_104_767).abs() < 1e-9));
    assert_eq!(scene.styles.files[0].0, "my wax");
    assert!(scene.styles.files[0].1.linear && !scene.styles.files[1].1.linear);
    assert_eq!(scene.styles.files[1].1.path, Path::new("a/wax.png"));
}

#[test]
fn the_shortest_scene_has_every_default() {
    let short = scene("");
    assert_eq!(short, Scene::for_volume(VolumeSource::File { path: "a.nrrd".into(), raw: None }));
    assert_eq!(short.camera, Camera::default());
    assert_eq!(short, scene("[transfer]\n"), "the preset is an automatic function of styles");
    assert_eq!(short, scene("[camera]\n[styles]\n[sampling]\n[picture]\n"));
}

/// The values that the contract prints as defaults.
#[test]
fn defaults_are_those_of_the_contract() {
    let printed = scene(
        r#"gradient_range = "q0.999"
outside = "low"
[camera]
projection = "perspective"
fov = 30
direction = [-1, -0.4, -0.3]
up = [0, 0, 1]
[picture]
size = [512, 512]
dpi = 300
samples = "auto"
contrast = 0.0625
background = "white"
blend_space = "linear"
bits = 8
layers = ["beauty"]
[sampling]
step = "0.5 voxels"
step_along = "plane"
kernel = "trilinear"
gradient = "central"
hessian = "auto"
scale = "1 voxel"
normal = "outward"
number = "f64"
skip_empty = true
stop_below = 0.0
reference_length = "1 voxel"
[transfer]
kind = "style"
over = "value"
unit = "value"
transparency = "illustrative"
mix = "premultiplied"
sphere_frame = "eye"
table = "exact"
[styles]
theme = "textbook"
"#,
    );
    assert_eq!(printed, scene(""));
    assert_eq!(printed.picture, PictureSettings::default());
    assert_eq!(printed.sampling, Sampling::default());
    assert_eq!(printed.styles, Styles::default());
    let shading = "[shading]\nmodel = \"phong\"\nambient = 0.3\ndiffuse = 0.6\nspecular = 0.3\nshininess = 30\n";
    assert_eq!(scene(shading), scene("[shading]\n"));
    assert_eq!(scene(shading).shading, Some(Shading::default()));
    let contours = "[contours]\nthickness = \"2 voxels\"\nkappa = \"ray\"\nsign_flip = \"two-sided\"\n";
    assert_eq!(scene(contours), scene("[contours]\n"));
    assert_eq!(
        scene("[contours]\nkappa = \"none\"\nthreshold = 0.3\n"),
        scene("[contours]\nkappa = \"none\"\n"),
        "the only threshold that the contract prints"
    );
    let first = "drypoint = 1\npreset = \"style\"\nlight = \"head\"\n[volume]\nfile = \"a.nrrd\"\n";
    assert_eq!(parse(first, Path::new("s"), &Overrides::default()).unwrap(), scene(""));
}

/// The examples of the contract for what is built.
#[test]
fn the_contracts_examples_are_read() {
    scene("raw = { size = [256, 256, 128], type = \"u8\", endian = \"little\", spacing = [1, 1, 1], skip = 0 }\n");
    scene("[camera]\ntarget = [128, 128, 64]\nnear = \"0.5 voxels\"\nheight = 256\n");
    scene("[picture]\nlayers = [\"beauty\", \"Z\", \"normal\", \"curvature\", \"first\", \"counts\"]\n");
    scene(
        "[transfer]\nnodes = [\n  { at = 60,  style = \"wax\",   opacity = 0.0 },\n  { at = 90,  style = \"wax\",   \
         opacity = 0.1 },\n  { at = 180, style = \"metal\", opacity = 0.9 },\n]\n[styles]\ntheme = \"textbook\"\nmetal = \
         \"my-styles/brushed.png\"\n",
    );
    scene("[transfer]\nkind = \"regular\"\nnodes = [{ at = 60, color = \"#c08040\" }]\n[shading]\n");
    scene("[styles]\nmetal = { file = \"m.png\", linear = true }\n");
    let phantom = "drypoint = 1\n[volume]\nphantom = { name = \"torus\", size = 128, spacing = [1, 1, 1], type = \"u8\", \
                   param = { R = 40 } }\n";
    assert!(parse(phantom, Path::new("s"), &Overrides::default()).is_ok());
}

#[test]
fn the_identity_of_a_scene_does_not_depend_on_folders() {
    let read =
        |file| parse(&format!("{HEAD}[styles]\nmine = \"x/m.png\"\n"), Path::new(file), &Overrides::default()).unwrap();
    let (here, there) = (read("s.toml"), read("/else/where/s.toml"));
    assert_ne!(write_full(&here), write_full(&there));
    assert_eq!(identity(&here), identity(&there));
    assert!(identity(&here).contains("file = \"a.nrrd\"") && identity(&here).contains("mine = \"m.png\""));
    assert_ne!(identity(&here), identity(&scene("")));
}

/// The same scene must give the same bytes wherever its files lie ([IO-2]): beside it, found through `DRYPOINT_DATA`, or
/// written out in full from another folder. So folders do not count, and files of one name in two folders are not told
/// apart: the identity is the scene's, not its data's.
#[test]
fn the_identity_of_a_scene_has_names_without_folders() {
    let of = |file: &str| {
        let text = format!("drypoint = 1\n[volume]\nfile = \"{file}\"\n");
        identity(&parse(&text, Path::new("s.toml"), &Overrides::default()).unwrap())
    };
    assert_eq!(of("a/x.nrrd"), of("b/x.nrrd"));
    assert_eq!(of("a/x.nrrd"), of("/data/c/../x.nrrd"));
    assert_ne!(of("a/x.nrrd"), of("a/y.nrrd"));
    assert_ne!(of("a/x.nrrd"), of("a/x.nhdr"));
}
