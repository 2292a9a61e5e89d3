//! Small scenes among which every module of the shaders is: those of the validation, and further ones.

use crate::validation::scenes::{OF_LABELS, SCENES, scene};
use std::f64::consts::{PI, TAU};
use std::fmt::Write;
use std::path::Path;

/// A scene: its name, its text, and keys that are overridden.
pub(super) type SceneText = (&'static str, String, Vec<(&'static str, String)>);

/// Keys of a scene that are overridden, and their values.
type Keys = &'static [(&'static str, &'static str)];

/// Scenes beside those of the validation: a name, keys, and what a scene of it adds to the torus. The name decides the kind
/// of nodes. FOLDER stands for the folder of files in keys; in texts paths start there.
const FURTHER: &[(&str, Keys, &str)] = &[
    // The field between voxels, up to its border.
    ("the cubic B-spline's gradient", &[], "[shading]\n[sampling]\nkernel = \"bspline\"\ngradient = \"analytic\"\n"),
    ("the quintic B-spline's gradient", &[], "[shading]\n[sampling]\nkernel = \"bspline5\"\ngradient = \"analytic\"\n"),
    ("Catmull–Rom's gradient", &[], "[shading]\n[sampling]\nkernel = \"catmull-rom\"\ngradient = \"analytic\"\n"),
    ("the trilinear gradient", &[], "[shading]\n[sampling]\ngradient = \"analytic\"\n"),
    ("curvatures by central differences", CURVED, "[shading]\n[sampling]\nhessian = \"central\"\n"),
    ("curvatures by a Gaussian", CURVED, "[shading]\n[sampling]\nhessian = \"gaussian\"\n"),
    (
        "curvatures of the cubic B-spline",
        CURVED,
        "[shading]\n[sampling]\nkernel = \"bspline\"\nhessian = \"analytic\"\n",
    ),
    (
        "curvatures of the quintic B-spline",
        CURVED,
        "[shading]\n[sampling]\nkernel = \"bspline5\"\nhessian = \"analytic\"\n",
    ),
    ("Sobel's gradient at the border", BLOCK, "[shading]\n[sampling]\ngradient = \"sobel\"\n"),
    ("the gradient by regression at the border", BLOCK_LAYERS, "[shading]\n[sampling]\ngradient = \"regression\"\n"),
    ("curvatures at the border", BLOCK_CURVED, "[shading]\n[sampling]\nhessian = \"central\"\n"),
    (
        "contours of a sphere seen head-on",
        &[
            ("volume.phantom", "{ name = \"sphere\", size = 24 }"),
            ("camera.projection", "orthographic"),
            ("camera.direction", "[1, 0, 0]"),
            ("picture.size", "[25, 25]"),
            ("picture.layers", "[\"beauty\", \"curvature.KV\", \"first.curvature.KV\"]"),
        ],
        "[contours]\nthickness = \"1 voxel\"\nkappa = \"exact\"\n[sampling]\nhessian = \"central\"\n",
    ),
    ("voxels without a value", &[("volume", "{ file = \"FOLDER/holes.nrrd\" }")], "[shading]\n"),
    // Light and colours.
    ("a shininess that is no integer", &[], "[shading]\nshininess = 7.3\n"),
    (
        "a lighting function with layers",
        LAYERS,
        "[shading]\nmodel = \"lighting-function\"\npreset = \"metal-contours\"\n",
    ),
    ("mixed in sRGB", &[("picture.blend_space", "srgb"), ("picture.layers", "[\"beauty\", \"Z\"]")], "[shading]\n"),
    (
        "dark, mixed in sRGB",
        &[("picture.blend_space", "srgb"), ("picture.layers", "[\"beauty\", \"Z\"]")],
        "[shading]\nambient = 0.001\ndiffuse = 0.001\nspecular = 0\n",
    ),
    ("before a picture", &[("picture.background", "FOLDER/picture.png")], "[shading]\n"),
    (
        "a cap",
        &[],
        "[shading]\n[[clip]]\npoint = [23, 23, 23]\nnormal = [-0.1, 1, -0.2]\nspace = \"index\"\ncap = \"#ff3010c0\"\n",
    ),
    ("styles in the frame of the view", &[("transfer.sphere_frame", "view")], ""),
    (
        "styles that are seen through, with a cut",
        &[("styles.wax", "FOLDER/veil.png")],
        "[[clip]]\npoint = [23, 23, 23]\nnormal = [-0.1, 1, -0.2]\nspace = \"index\"\nstyle = \"wax\"\n",
    ),
    ("contours that fade", &[], "[contours]\nthickness = \"1.5 voxels\"\nfade = [0.2, 0.8]\n"),
    (
        "mip-maps with a cut, in wide steps",
        &[("sampling.step", "6 voxels"), ("styles.wax", "FOLDER/veil.png")],
        "[style_mipmaps]\n[[clip]]\npoint = [23, 23, 23]\nnormal = [-0.1, 1, -0.2]\nspace = \"index\"\n",
    ),
    ("mip-maps with biases", &[], "[contours]\n[style_mipmaps]\ngradient_bias = 3\ncurvature_bias = 4\n"),
    // Two quantities.
    ("over value and label", LABELS, ROWS_OF_LABELS),
    ("over value and smooth label", SMOOTH_LABELS, ROWS_OF_LABELS),
    ("over value and a volume with holes", &[("volume", "{ file = \"FOLDER/block.nrrd\" }")], ROWS_OF_HOLES),
    ("over label and value", LABELS, ROWS_ALONG_LABELS),
    ("over value and volume", &[], ROWS_OF_VOLUME),
    // Iso-surfaces, meshes and lines.
    (
        "an iso-surface of the cubic B-spline",
        &[],
        "[shading]\n[surface]\niso = 130\nlook = \"phong\"\n[sampling]\nkernel = \"bspline\"\n",
    ),
    (
        "an iso-surface in noise",
        &[
            ("volume", "{ file = \"FOLDER/block.nrrd\" }"),
            ("picture.size", "[64, 64]"),
            ("picture.layers", "[\"beauty\", \"Z\"]"),
        ],
        "[shading]\n[surface]\niso = 120\nlook = \"phong\"\n",
    ),
    (
        "an iso-surface with a cut",
        &[("picture.size", "[64, 64]")],
        "[shading]\n[surface]\niso = 130\nlook = \"phong\"\n[[clip]]\npoint = [30, 23, 23]\nnormal = [1, -0.1, 0.2]\n\
         space = \"index\"\ncap = \"#ff3010c0\"\n",
    ),
    (
        "curvatures along rays at an iso-surface",
        &[("picture.layers", "[\"beauty\", \"curvature.KV\", \"first.curvature.KV\"]")],
        "[shading]\n[surface]\niso = 130\nlook = \"phong\"\n",
    ),
    ("a mesh", LAYERS, "[shading]\n[[mesh]]\nfile = \"ball.ply\"\nscale = [11, 9, 12]\nmove = [24, 12, 24]\n"),
    // Boxes of triangles are entered far from the plane from which depths count.
    (
        "meshes far before and behind",
        &[(
            "transfer.nodes",
            "[{ at = 100, color = \"#804020\", opacity = 0 }, { at = 140, color = \"#88ccff\", opacity = 0.02 }]",
        )],
        "[shading]\n[[mesh]]\nfile = \"ball.ply\"\nscale = 5\nmove = [113, 59, 50]\n\
         [[mesh]]\nfile = \"ball.ply\"\nscale = 30\nmove = [-218, -73, 11]\n",
    ),
    (
        "meshes far before and behind, seen along falling coordinates",
        &[
            ("camera.projection", "orthographic"),
            ("camera.direction", "[-0.5, -0.6, -0.6]"),
            (
                "transfer.nodes",
                "[{ at = 100, color = \"#804020\", opacity = 0 }, { at = 140, color = \"#88ccff\", opacity = 0.02 }]",
            ),
        ],
        "[shading]\n[[mesh]]\nfile = \"ball.ply\"\nscale = 9\nmove = [-32, -37, -46]\n\
         [[mesh]]\nfile = \"ball.ply\"\nscale = 9\nmove = [79, 84, 93]\n",
    ),
    (
        "a mesh with normals",
        LAYERS,
        "[shading]\n[[mesh]]\nfile = \"smooth.ply\"\nscale = [11, 9, 12]\nmove = [24, 12, 24]\n\
         rotate = { axis = [1, 2, 0.5], angle = 40 }\n",
    ),
    ("strokes in the volume", LAYERS, "[shading]\n[hatching]\niso = 128\nhidden = \"merged\"\n"),
    (
        "strokes in the volume, with parts",
        &[("picture.layers", "[\"beauty\", \"part0\", \"part1\"]")],
        "[shading]\n[hatching]\niso = 128\nhidden = \"merged\"\n[[object]]\nname = \"half\"\n\
         value = [[120, 0], [134, 0.8]]\nmove = [2, 1, 0]\n",
    ),
    ("layers", LAYERS, "[shading]\n"),
    ("layers on shells", LAYERS, "[shading]\n[sampling]\nstep_along = \"ray\"\n"),
    // Objects.
    (
        "a selection on shells",
        &[("sampling.step_along", "ray")],
        "[shading]\n[[object]]\nname = \"half\"\nvalue = [[120, 0], [134, 1]]\nmove = [9, -12, 6]\nscale = [0.9, 1.2, 0.8]\n",
    ),
    (
        "a selection, orthographic",
        &[("camera.projection", "orthographic")],
        "[shading]\n[[object]]\nname = \"half\"\nvalue = [[120, 0], [134, 1]]\nmove = [9, -12, 6]\n",
    ),
    (
        "a selection by products",
        &[("combine.fuzzy", "product")],
        "[shading]\n[[object]]\nname = \"soft\"\nselection = \"soft.nrrd\"\n[[object]]\nname = \"half\"\n\
         value = [[110, 0], [134, 0.8]]\n[[object]]\nname = \"block\"\nvolume = \"block.nrrd\"\nmove = [9, 3, 0]\n",
    ),
    (
        "styles of objects",
        &[],
        "[[object]]\nname = \"half\"\nvalue = [[110, 0], [134, 0.8]]\nmove = [3, -2, 2]\nghosting = 0.6\n",
    ),
    (
        "a funnel on shells",
        &[("sampling.step_along", "ray"), ("volume", "{ file = \"FOLDER/block.nrrd\" }")],
        "[shading]\n[[object]]\nname = \"soft\"\nselection = \"soft.nrrd\"\nmove = [0, 3, 0]\nghosting = 0.7\nfunnel = \"3 px\"\n\
         cut = \"object\"\n",
    ),
    (
        "a funnel on shells, in fine steps",
        &[
            ("sampling.step_along", "ray"),
            ("sampling.step", "0.2 voxels"),
            ("picture.size", "[64, 64]"),
            ("volume", "{ file = \"FOLDER/block.nrrd\" }"),
        ],
        "[shading]\n[[object]]\nname = \"soft\"\nselection = \"soft.nrrd\"\nmove = [0, 3, 0]\nghosting = 0.7\nfunnel = \"8 px\"\n",
    ),
    ("presets of intersections", &[], PRESETS),
    ("further presets of intersections", &[], FURTHER_PRESETS),
    ("dabs on an intersection", &[], DABS),
    (
        "a picture of an intersection",
        &[],
        "[shading]\n[[object]]\nname = \"half\"\nvalue = [[110, 0], [134, 0.8]]\nmove = [3, -2, 2]\n\
         [[intersection]]\nobject = \"half\"\nwith = \"ghost\"\ncolor = \"picture.png\"\n",
    ),
    ("coverage of parts", &[("picture.layers", "[\"beauty\", \"part0\", \"part1\", \"part2\"]")], COVERING),
    // Halos.
    ("a halo of medians, with a floor", &[], "[shading]\n[[halo]]\nfloor = 0.1\nspread.median = true\n"),
    ("halos of both kinds", &[("picture.layers", "[\"beauty\", \"halo0\", \"depth\"]")], HALOS),
    (
        "halos by focus and direction",
        &[],
        "[shading]\n[[halo]]\nseed.direction = { toward = 120, width = 90, softness = 40 }\n[[halo]]\nkind = \"emissive\"\n\
         seed.focus = { at = [[20, 10, 15], [30, 20, 20]], inner = 4, falloff = 18 }\n",
    ),
    ("halos by value", &[], "[shading]\n[[halo]]\nseed.value = [[100, 0], [128, 1], [140, 0]]\n"),
    ("contours under a halo", &[], "[contours]\n[[halo]]\nseed = { by = \"curvature\", thickness = \"2 voxels\" }\n"),
];

const LAYERS: &[(&str, &str)] =
    &[("picture.layers", "[\"beauty\", \"Z\", \"depth\", \"normal\", \"gradient\", \"first\", \"first.normal\"]")];
const CURVED: &[(&str, &str)] = &[("picture.layers", "[\"beauty\", \"curvature\", \"first.curvature\"]")];
/// A volume that shows up to its border.
const BLOCK: &[(&str, &str)] = &[("volume", "{ file = \"FOLDER/block.nrrd\" }")];
const BLOCK_LAYERS: &[(&str, &str)] =
    &[("volume", "{ file = \"FOLDER/block.nrrd\" }"), ("picture.layers", "[\"beauty\", \"gradient\"]")];
const BLOCK_CURVED: &[(&str, &str)] =
    &[("volume", "{ file = \"FOLDER/block.nrrd\" }"), ("picture.layers", "[\"beauty\", \"curvature\"]")];
const LABELS: &[(&str, &str)] = &[("volume.labels", "FOLDER/labels.nrrd")];
const SMOOTH_LABELS: &[(&str, &str)] = &[("volume.labels", "FOLDER/labels.nrrd"), ("volume.label_lookup", "smooth")];

const ROWS_OF_LABELS: &str = "over = [\"value\", \"label\"]\nrows = [
  { at = 1, nodes = [{ at = 100, color = \"#804020\", opacity = 0 }, { at = 128, color = \"#ffcc88\", opacity = 0.4 }] },
  { at = 2, nodes = [{ at = 90, color = \"#3366cc\", opacity = 0 }, { at = 120, color = \"#88ccff\", opacity = 0.5 }] },
]\n";
const ROWS_ALONG_LABELS: &str = "over = [\"label\", \"value\"]\nrows = [
  { at = 105, nodes = [{ at = 1, color = \"#804020\", opacity = 0.05 }, { at = 2, color = \"#ffcc88\", opacity = 0.4 }] },
  { at = 135, nodes = [{ at = 2, color = \"#3366cc\", opacity = 0.3 }] },
]\n";
const ROWS_OF_VOLUME: &str = "over = [\"value\", { volume = \"block.nrrd\" }]\nrows = [
  { at = 100, nodes = [{ at = 100, color = \"#804020\", opacity = 0 }, { at = 128, color = \"#ffcc88\", opacity = 0.4 }] },
  { at = 140, nodes = [{ at = 90, color = \"#3366cc\", opacity = 0 }, { at = 120, color = \"#88ccff\", opacity = 0.5 }] },
]\n";
const ROWS_OF_HOLES: &str = "over = [\"value\", { volume = \"holes.nrrd\" }]\nrows = [
  { at = 100, nodes = [{ at = 100, color = \"#804020\", opacity = 0 }, { at = 128, color = \"#ffcc88\", opacity = 0.4 }] },
  { at = 140, nodes = [{ at = 90, color = \"#3366cc\", opacity = 0 }, { at = 120, color = \"#88ccff\", opacity = 0.5 }] },
]\n";
const PRESETS: &str = "[shading]\n[[object]]\nname = \"half\"\nvalue = [[110, 0], [134, 0.8]]\nmove = [3, -2, 2]\n\
    [[intersection]]\nobject = \"half\"\nwith = \"ghost\"\nopacity = \"in\"\n\
    [[intersection]]\nobject = \"half\"\nwith = \"background\"\nopacity = \"over\"\n";
const FURTHER_PRESETS: &str = "[shading]\n[[object]]\nname = \"half\"\nvalue = [[110, 0], [134, 0.8]]\nmove = [3, -2, 2]\n\
    [[intersection]]\nobject = \"half\"\nwith = \"ghost\"\nopacity = \"xor\"\ncolor = \"#ff4010c0\"\n\
    [[intersection]]\nobject = \"half\"\nwith = \"background\"\nopacity = \"out\"\n";
const DABS: &str = "[shading]\n[[object]]\nname = \"half\"\nvalue = [[110, 0], [134, 0.8]]\nmove = [3, -2, 2]\n\
    [[intersection]]\nobject = \"half\"\nwith = \"ghost\"\ncolor = \"#ff4010c0\"\n\
    dabs = [{ at = [120, 120], width = [20, 15], color = \"#20ff40c0\" }, { at = [130, 110], width = 12, color = \"#4020ff\" }]\n";
const COVERING: &str = "[shading]\n[[object]]\nname = \"half\"\nvalue = [[110, 0], [134, 0.8]]\nmove = [3, -2, 2]\nghosting = 0.6\n\
    [[intersection]]\nobject = \"half\"\nwith = \"background\"\nopacity = \"plus\"\nswap = true\n\
    [[intersection]]\nobject = \"half\"\nwith = \"ghost\"\ncolor = \"#ff4010c0\"\nopacity = \"over\"\n";
const HALOS: &str = "[shading]\n[[halo]]\nname = \"rim\"\nkind = \"emissive\"\nseed.by = \"curvature\"\nevery = 2\n\
    profile = [{ at = 0.1, color = \"white\", opacity = 0 }, { at = 0.3, color = \"white\" }]\n\
    [[halo]]\nexponents = [0.5, 3]\ntints = [\"rim\"]\nopacity = 0.5\nspread = { passes = 2, delta = 0.95, reach = \"31 %\" }\n\
    profile = [{ at = 0, color = \"red\", opacity = 0.1 }, { at = 0.5, color = \"blue\", opacity = 0.8 }]\n\
    [[halo]]\nevery = 4\naccumulate = \"mean\"\nprofile = [{ at = 0, color = \"#209040\", opacity = 0 }, { at = 1, color = \"#209040\" }]\n";

/// All scenes, after the files that they name have been written to a folder.
///
/// # Errors
/// The system's failure to write a file.
pub(super) fn all(folder: &Path, size: [usize; 2]) -> std::io::Result<Vec<SceneText>> {
    write_files(folder)?;
    let meshes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/meshes");
    let known = SCENES.iter().map(|&(name, more)| (name, if name == OF_LABELS { LABELS } else { &[] }, more));
    let of = |(name, keys, more): (_, &[(_, &str)], _)| {
        let keys = keys.iter().map(|&(key, value)| (key, value.replace("FOLDER", &folder.display().to_string())));
        let text = scene(name, more, size).replace("data/meshes", &meshes.display().to_string());
        (name, text, keys.collect())
    };
    Ok(known.chain(FURTHER.iter().copied()).map(of).collect())
}

fn write_files(folder: &Path) -> std::io::Result<()> {
    // Values of a volume that shows everywhere; labels in blocks, on turned axes; memberships of a ball.
    let value = |[x, y, z]: [usize; 3]| 100 + (29 * x + 31 * y + 37 * z + 5 * x * y * z) % 41;
    let skewed = ["(4.5,0,0) (0.6,5.2,0) (0,-1.2,6.1)", "(3,-2,1)"];
    write_volume(folder, "block.nrrd", "float", skewed, &|at| value(at) as f64)?;
    let is_hole = |[x, y, z]: [usize; 3]| (x + 2 * y + 3 * z) % 11 == 5;
    write_volume(folder, "holes.nrrd", "float", skewed, &|at| if is_hole(at) { f64::NAN } else { value(at) as f64 })?;
    let turned = ["(4.3,1.3,0) (-1.6,5.1,0) (0,0,5.6)", "(6,-1,2)"];
    write_volume(folder, "labels.nrrd", "uint8", turned, &|[x, y, z]| ((x / 2 + y / 3 + z / 2) % 3) as f64)?;
    let away = |at: [usize; 3]| at.map(|i| (i as f64 - 4.2).powi(2)).iter().sum::<f64>().sqrt();
    let middle = ["(4,0,0) (0,4,0) (0,0,4)", "(6,3,5)"];
    write_volume(folder, "soft.nrrd", "float", middle, &|at| (1.6 - away(at) / 3.5).clamp(0.0, 1.0))?;
    for (name, has_normals) in [("ball.ply", false), ("smooth.ply", true)] {
        std::fs::write(folder.join(name), ball(has_normals))?;
    }
    write_veil(&folder.join("veil.png"))?;
    let pictures = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/pictures");
    std::fs::copy(pictures.join("halo-seeds.png"), folder.join("picture.png")).map(|_| ())
}

/// Writes a style that is seen through everywhere, of 16 × 16 pixels that differ.
fn write_veil(path: &Path) -> std::io::Result<()> {
    let mut encoder = png::Encoder::new(std::fs::File::create(path)?, 16, 16);
    encoder.set_color(png::ColorType::Rgba);
    let bytes: Vec<u8> =
        (0..256u32).flat_map(|i| [i, 37 * i, 91 * i, 90 + 53 * i % 80].map(|c| (c % 256) as u8)).collect();
    encoder.write_header()?.write_image_data(&bytes)?;
    Ok(())
}

/// Writes 10 × 9 × 8 numbers as text.
fn write_volume(
    folder: &Path,
    name: &str,
    kind: &str,
    [axes, origin]: [&str; 2],
    value: &dyn Fn([usize; 3]) -> f64,
) -> std::io::Result<()> {
    let mut text = format!(
        "NRRD0005\ntype: {kind}\ndimension: 3\nspace dimension: 3\nsizes: 10 9 8\nencoding: ascii\n\
         space directions: {axes}\nspace origin: {origin}\n\n"
    );
    for i in 0..10 * 9 * 8 {
        let _ = writeln!(text, "{}", value([i % 10, i / 10 % 9, i / 90]));
    }
    std::fs::write(folder.join(name), text)
}

/// A ball of 24 rings of 48 triangles in PLY.
fn ball(has_normals: bool) -> String {
    const ACROSS: usize = 24;
    const DOWN: usize = 25;
    let normals = if has_normals { "property float nx\nproperty float ny\nproperty float nz\n" } else { "" };
    let mut text = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n{normals}element face {}\n\
         property list uchar int vertex_indices\nend_header\n",
        ACROSS * DOWN,
        2 * ACROSS * (DOWN - 1)
    );
    for i in 0..ACROSS * DOWN {
        let (down, across) = ((i / ACROSS) as f64 / (DOWN - 1) as f64 * PI, (i % ACROSS) as f64 / ACROSS as f64 * TAU);
        let corner = format!("{} {} {}", down.sin() * across.cos(), down.sin() * across.sin(), down.cos());
        let _ = writeln!(text, "{corner}{}", if has_normals { format!(" {corner}") } else { String::new() });
    }
    for i in 0..ACROSS * (DOWN - 1) {
        let next = i / ACROSS * ACROSS + (i + 1) % ACROSS;
        let _ = writeln!(text, "3 {i} {} {next}\n3 {next} {} {}", i + ACROSS, i + ACROSS, next + ACROSS);
    }
    text
}
