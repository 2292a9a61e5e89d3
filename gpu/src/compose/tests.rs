//! Shaders of all effects and their pairs, parsed and validated without an adapter ([GPU-4]).

use super::shader;
use crate::renderer::drawn_layers;
use crate::{CardInputs, GpuError, Hiding, Interpolation, Precision, volume_stippling};
use drypoint_scene::backdrop::Backdrop;
use drypoint_scene::clip::{ClipPlane, ClipPlanes};
use drypoint_scene::file::{Overrides, parse};
use drypoint_scene::glam::DVec3;
use drypoint_scene::inputs::{Inputs, ObjectData};
use drypoint_scene::intersection_picture::IntersectionPicture;
use drypoint_scene::measured::{Measured, PaddedNumbers};
use drypoint_scene::mesh::{BoxNode, TriangleMesh};
use drypoint_scene::plan::Plan;
use drypoint_scene::shot::{
    Axis, Clipping, GradientEstimator, Kernel, Object, PartFacts, Reconstruction, SelectionFacts, Shot, VolumeFacts,
};
use drypoint_scene::space::Grid;
use drypoint_scene::style::Style;
use drypoint_scene::tables::{Iso, Scene};
use drypoint_scene::transfer::Function;
use drypoint_scene::view::View;
use drypoint_scene::volume::labels::LabelVolume;
use drypoint_scene::volume::{Bricks, Selection, Volume, Voxels};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use wgpu::naga;

/// A choice among alternatives: its name, and what each adds to a scene, by table.
type Choice = (&'static str, &'static [&'static [(&'static str, &'static str)]]);

const RED: &str = "kind = \"regular\"\n\
    nodes = [{ at = 1, color = \"#ff0000\", opacity = 0 }, { at = 9, color = \"#00ff00\", opacity = 0.5 }]";
/// Two styles, and three nodes of them.
const WAX: &str = "nodes = [{ at = 1, style = \"wax\", opacity = 0 }, { at = 9, style = \"ink\", opacity = 0.5 }]";
const WAX_TWICE: &str = "nodes = [{ at = 1, style = \"wax\", opacity = 0 }, \
    { at = 5, style = \"ink\", opacity = 0.5 }, { at = 9, style = \"wax\", opacity = 0.7 }]";
/// Rows of functions over two quantities.
const ROWS: &str = "rows = [{ at = 1, nodes = [{ at = 1, style = \"wax\", opacity = 0.1 }] }, \
    { at = 2, nodes = [{ at = 2, style = \"ink\", opacity = 0.4 }] }]";
const COLORED_ROWS: &str = "kind = \"regular\"\n\
    rows = [{ at = 1, nodes = [{ at = 1, color = \"#ff0000\", opacity = 0.1 }] }, \
    { at = 2, nodes = [{ at = 2, color = \"#00ff00\", opacity = 0.4 }] }]";

/// The choices of a scene.
const CHOICES: &[Choice] = &[
    (
        "kernel",
        &[
            &[("sampling", "kernel = \"trilinear\"")],
            &[("sampling", "kernel = \"bspline\"")],
            &[("sampling", "kernel = \"bspline-smooth\"")],
            &[("sampling", "kernel = \"bspline5\"")],
            &[("sampling", "kernel = \"catmull-rom\"")],
        ],
    ),
    (
        "gradient",
        &[
            &[("sampling", "gradient = \"analytic\"")],
            &[("sampling", "gradient = \"central\"")],
            &[("sampling", "gradient = \"sobel\"")],
            &[("sampling", "gradient = \"regression\"")],
        ],
    ),
    (
        "Hessian",
        &[
            &[("sampling", "hessian = \"auto\"")],
            &[("sampling", "hessian = \"analytic\"")],
            &[("sampling", "hessian = \"central\"")],
            &[("sampling", "hessian = \"gaussian\"")],
        ],
    ),
    ("planes", &[&[], &[("sampling", "step_along = \"ray\"")]]),
    ("normal", &[&[], &[("sampling", "normal = \"facing\"")], &[("sampling", "normal = \"gradient\"")]]),
    ("skipping", &[&[], &[("sampling", "skip_empty = false")]]),
    ("outside", &[&[], &[("volume", "outside = \"high\"")]]),
    ("camera", &[&[], &[("camera", "projection = \"orthographic\"")]]),
    ("rays", &[&[("picture", "samples = 1")], &[("picture", "samples = 2")], &[("picture", "samples = \"auto\"")]]),
    ("blending", &[&[], &[("picture", "blend_space = \"srgb\"")]]),
    ("background", &[&[], &[("picture", "background = \"#203040\"")], &[("picture", "background = \"none\"")]]),
    (
        "layers",
        &[
            &[],
            &[("picture", "layers = [\"counts\", \"Z\", \"part0\"]")],
            &[("picture", "layers = [\"beauty\", \"normal\", \"depth\", \"first\", \"first.normal\", \"gradient\"]")],
            &[("picture", "layers = [\"beauty\", \"curvature\", \"first.curvature\"]")],
            &[("picture", "layers = [\"beauty\", \"curvature.KV\", \"first.curvature.KV\"]")],
        ],
    ),
    (
        "material",
        &[
            // Without a function: an iso-surface alone.
            &[],
            &[("transfer", RED)],
            &[("transfer", RED), ("transfer", "table = 16"), ("shading", "")],
            &[("transfer", RED), ("shading", "shininess = 7.5\nview_opacity = 0.5")],
            &[("transfer", RED), ("shading", "model = \"toon\""), ("shading.silhouette", "")],
            &[
                ("transfer", RED),
                ("shading", "model = \"lighting-function\"\npreset = \"metal-contours\"\nview_opacity = 0.5"),
            ],
            &[
                ("transfer", COLORED_ROWS),
                ("transfer", "over = [\"value\", \"gradient-magnitude\"]"),
                ("shading", "model = \"lighting-function\""),
                ("shading.silhouette", ""),
            ],
            &[("transfer", COLORED_ROWS), ("transfer", "over = [\"value\", \"gradient-magnitude\"]")],
            &[("transfer", COLORED_ROWS), ("transfer", "over = [\"k1\", \"mean\"]"), ("shading", "")],
            &[("transfer", WAX)],
            &[("transfer", WAX_TWICE)],
            &[("transfer", WAX), ("transfer", "table = 16"), ("transfer", "sphere_frame = \"view\"")],
            &[("transfer", WAX), ("contours", "thickness = \"1 voxel\"\nfade = [0.1, 0.4]"), ("style_mipmaps", "")],
            &[("transfer", WAX), ("contours", "kappa = \"exact\""), ("transfer", "mix = \"printed\"")],
            &[
                ("transfer", WAX),
                ("contours", "kappa = \"none\"\nthreshold = 0.3"),
                ("transfer", "transparency = \"plain\""),
            ],
            &[("transfer", ROWS), ("transfer", "over = [\"value\", { distance = [1, 2, 3] }]"), ("contours", "")],
            &[("transfer", ROWS), ("transfer", "over = [\"value\", \"label\"]"), ("volume", "labels = \"l.nrrd\"")],
            &[
                ("transfer", ROWS),
                ("transfer", "over = [\"label\", { volume = \"v.nrrd\" }]"),
                ("volume", "labels = \"l.nrrd\""),
                ("volume", "label_lookup = \"smooth\""),
            ],
            &[("transfer", ROWS), ("transfer", "over = [{ volume = \"v.nrrd\" }, { volume = \"w.nrrd\" }]")],
            &[
                ("transfer", ROWS),
                ("transfer", "over = [\"kv\", { distance_to_label = 1 }]"),
                ("volume", "labels = \"l.nrrd\""),
            ],
        ],
    ),
    (
        "surface",
        &[
            &[],
            &[("surface", "iso = 5\nlook = \"white\"")],
            &[("surface", "iso = 5\nlook = \"phong\"")],
            &[("surface", "iso = 5\nlook = \"toon\""), ("surface.silhouette", "")],
        ],
    ),
    (
        "cuts",
        &[
            &[],
            &[("[clip]", "point = [3, 3, 3]\nnormal = [1, 1, 0]\nspace = \"index\"")],
            &[("[clip]", "box = [[1, 4], [1, 5], [2, 3]]\nspace = \"index\"\ncap = \"#ff000080\"")],
            &[("[clip]", "point = [3, 3, 3]\nnormal = [1, 1, 0]\nspace = \"index\"\nstyle = \"glass\"")],
        ],
    ),
    (
        "halos",
        &[
            &[],
            &[("[halo]", "")],
            &[("[halo]", "kind = \"emissive\"\nevery = 3\nseed.by = \"curvature\"\nspread = { from = \"seeds\" }")],
            &[("[halo]", "spread.median = true\nseed.value = \"opacity\"")],
            &[(
                "[halo]",
                "seed.value = [[1, 0], [5, 1]]\nseed.direction = { toward = 30, width = 90, softness = 20 }\n\
                 seed.focus = { at = [[3, 3, 3], [5, 4, 3]], inner = 1, falloff = 2 }",
            )],
            &[("[halo]", "seed.labels = [1]"), ("volume", "labels = \"l.nrrd\"")],
        ],
    ),
    (
        "objects",
        &[
            &[],
            &[("[object]", "name = \"a\"\nselection = \"s.nrrd\"\nghosting = 0.5")],
            &[("[object]", "name = \"a\"\nselection = \"s.nrrd\"")],
            &[
                (
                    "[object]",
                    "name = \"a\"\nvalue = [[1, 0], [4, 1]]\nmove = [1, 0, 0]\nghosting = 0.5\ncut = \"object\"",
                ),
                ("combine", "fuzzy = \"product\""),
                ("[intersection]", "object = \"a\"\nwith = \"ghost\"\ncolor = \"i.png\""),
            ],
            &[
                (
                    "[object]",
                    "name = \"a\"\nvolume = \"b.nrrd\"\nscale = [1, 2, -1]\nghosting_of_ghost = 1\nfunnel = \"2 px\"",
                ),
                (
                    "[intersection]",
                    "object = \"a\"\nopacity = \"xor\"\ncolor = \"#ff0000\"\n\
                     dabs = [{ at = [1, 2], width = 3, color = \"red\" }]",
                ),
            ],
        ],
    ),
    ("meshes", &[&[], &[("[mesh]", "file = \"m.ply\"")]]),
    // Not of the scene's text.
    ("picture behind", &[&[], &[]]),
    ("labels elsewhere", &[&[], &[]]),
    ("mask", &[&[], &[]]),
    ("lines", &[&[], &[]]),
    ("number", &[&[], &[]]),
    ("texture unit", &[&[], &[]]),
];

/// The place of a choice.
fn place(name: &str) -> usize {
    CHOICES.iter().position(|choice| choice.0 == name).unwrap()
}

/// The text of a scene with one alternative of each choice.
fn text(chosen: &[usize]) -> String {
    let mut tables: Vec<(&str, Vec<&str>)> = vec![("volume", vec!["phantom = { name = \"torus\", size = 8 }"])];
    for (alternatives, &i) in CHOICES.iter().map(|choice| choice.1).zip(chosen) {
        for &(table, keys) in alternatives[i] {
            match tables.iter_mut().find(|(name, _)| *name == table) {
                // Two choices may need one key.
                Some((_, all)) => all.extend((!all.contains(&keys)).then_some(keys)),
                None => tables.push((table, vec![keys])),
            }
        }
    }
    let mut text = String::from("drypoint = 1\n");
    for (table, keys) in tables {
        text.push_str(&format!("[{table}]\n{}\n", keys.join("\n")));
    }
    text
}

/// Voxels on a grid, one of which may be no number.
fn volume(is_masked: bool) -> Volume {
    let grid = Grid::with_spacing([9, 8, 7], [1.0, 1.5, 2.0]).unwrap();
    let mut values: Vec<f32> = (0..grid.len()).map(|i| (i % 11) as f32).collect();
    if is_masked {
        values[100] = f32::NAN;
    }
    Volume::new(grid, Voxels::F32(values), 1.0, 0.0).unwrap()
}

/// Measured facts that fit the volume in their sizes alone.
fn measured(volume: &Volume, has_range: bool, has_bricks: bool) -> Measured {
    let numbers = || {
        let dims = volume.dims().map(|n| n + 4);
        PaddedNumbers::new(vec![1.0; dims.iter().product()], dims, 2)
    };
    let bricks = Bricks::new(volume.dims(), &|_| vec![[0.0, 10.0]; 2]);
    Measured {
        numbers: Arc::new(numbers()),
        voxels: Some(Arc::new(numbers())),
        smoothed: Some(Arc::new(numbers())),
        regression: Some(vec![0.0; 64 * 3 * 27]),
        base: 0.0,
        gradient_range: has_range.then_some([0.0, 1.0]),
        gradient_scale: 1.0,
        label_distances: [0, 1].map(|_| Some(vec![0.0; volume.grid().len()])),
        bricks: has_bricks.then_some(bricks),
        mesh_boxes: Arc::new([BoxNode { lo: DVec3::ZERO, hi: DVec3::ONE, first: 0, is_leaf: true }]),
    }
}

/// Inputs of a scene beside its volume.
#[derive(Clone, Copy, Debug)]
struct Beside {
    /// Whether a picture lies behind the volume.
    has_picture: bool,
    /// Whether labels have a grid of their own.
    labels_are_elsewhere: bool,
    has_lines: bool,
    interpolation: Interpolation,
}

/// The text of a scene's shader for a volume; none if the scene has an effect that no module draws.
fn composed(scene: &Scene, volume: &Volume, beside: Beside, precision: Precision) -> Result<Option<String>, String> {
    let Beside { has_picture, labels_are_elsewhere, has_lines, interpolation } = beside;
    let mut scene = scene.clone();
    if let Some(surface) = scene.surface.as_mut().filter(|surface| surface.iso == Iso::Auto) {
        surface.iso = Iso::Value(5.0);
    }
    let function = match &scene.transfer {
        Some(transfer) => Function::new(transfer, [0.0, 10.0], volume, &|_| Some(1)).map_err(|e| format!("{e:?}"))?,
        None => Some(Function::nothing()),
    };
    let function = Arc::new(function.ok_or("the function is to be found")?);
    let view = View::new(&scene.camera, volume.grid(), [16, 12]).map_err(|e| e.to_string())?;
    let facts = VolumeFacts { grid: volume.grid(), is_integer: false };
    let shot = Shot::resolve(&scene, &Plan::new(&scene), facts, function, view).map_err(|e| e.to_string())?;
    let of_labels = Grid::with_spacing([4, 3, 2], [2.0; 3]).unwrap();
    let of_labels = if labels_are_elsewhere { &of_labels } else { volume.grid() };
    let labels = LabelVolume::new(&ids(of_labels)).map_err(|e| e.to_string())?;
    let (shot, places) = with_objects(shot, &scene, volume)?;
    let styles_of = |object: &Object, clipping: &Clipping| -> Vec<Style> {
        let style = |name: &String| Style::from_straight(name, 2, &[[0.5; 4]; 4], true).unwrap();
        let of_function: &[String] = if let Function::Style { names, .. } = &*object.function { names } else { &[] };
        of_function.iter().chain(&clipping.styles).map(style).collect()
    };
    let background = if has_picture { Backdrop::Pixels(&[[0.5; 4]; 16 * 12]) } else { Backdrop::Color([0.5; 4]) };
    let of_parts = shot.parts().map(|(part, object)| (object, &part.clipping));
    let drawn: Vec<_> = std::iter::once((shot.background(), &shot.clipping)).chain(of_parts).collect();
    let measured =
        |(object, _): &(&Object, &Clipping)| measured(volume, object.gradient_range.is_some(), object.skip_empty);
    let measured: Vec<Measured> = drawn.iter().map(measured).collect();
    let styles: Vec<Vec<Style>> = drawn.iter().map(|(object, clipping)| styles_of(object, clipping)).collect();
    let data = drawn.iter().zip(&styles).map(|((object, _), styles)| {
        let further = [0, 1].map(|axis| {
            let over = object.function.nodes().2.map(|rows| &rows.over[axis]);
            matches!(over, Some(Axis::Volume(_))).then_some(volume)
        });
        ObjectData { volume, labels: Some(&labels), further, styles }
    });
    let [main, parts @ ..] = &*data.collect::<Vec<_>>() else { return Err("there is no object".into()) };
    let selection = Selection::from_labels(&labels, &[1]).map_err(|e| e.to_string())?;
    let picture = IntersectionPicture { size: [2, 1], pixels: vec![[0.5; 4]; 2], has_opacity: true };
    let triangle = TriangleMesh::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y], None, vec![[0, 1, 2]]).unwrap();
    let data = Inputs {
        main: *main,
        parts: parts.to_vec(),
        selections: scene.objects.iter().map(|object| object.selection.as_ref().map(|_| &selection)).collect(),
        pictures: shot.combination.iter().flat_map(|c| &c.intersections).map(|_| Some(&picture)).collect(),
        meshes: &vec![triangle; shot.meshes.len()],
        background,
    };
    let inputs = CardInputs { data: &data, measured: &measured, places: &places, has_lines };
    match shader(&shot, &drawn_layers(&shot), &inputs, precision, interpolation) {
        Ok((shader, _)) => Ok(Some(shader.text(precision))),
        Err(GpuError::Missing { .. }) => Ok(None),
        Err(error) => Err(error.to_string()),
    }
}

/// A shot with the objects of a scene, all of the same volume, and for each object the place of its volume among those
/// uploaded.
fn with_objects(shot: Shot, scene: &Scene, volume: &Volume) -> Result<(Shot, Vec<usize>), String> {
    if scene.objects.is_empty() {
        return Ok((shot, vec![0]));
    }
    let grid = volume.grid();
    let main = VolumeFacts { grid, is_integer: false };
    let index_box = Some([DVec3::ONE, DVec3::new(5.0, 4.0, 3.0)]);
    let selections: Vec<_> = scene.objects.iter().map(|_| SelectionFacts { grid: grid.clone(), index_box }).collect();
    let scenes: Vec<Scene> = scene.parts().map(|(object, role)| scene.of_part(object, role)).collect();
    let plans: Vec<Plan> = scenes.iter().map(Plan::new).collect();
    let facts = scenes.iter().zip(&plans).map(|(scene, plan)| {
        let function = match &scene.transfer {
            Some(transfer) => {
                Function::new(transfer, [0.0, 10.0], volume, &|_| Some(1)).map_err(|e| format!("{e:?}"))?
            }
            None => Some(Function::nothing()),
        };
        let function = Arc::new(function.ok_or("the function is to be found")?);
        Ok(PartFacts { scene, plan, function, grid, is_integer: false, range: [0.0, 10.0] })
    });
    let facts: Vec<PartFacts<'_>> = facts.collect::<Result<_, String>>()?;
    let parts = scene.parts().map(|(object, _)| usize::from(scene.objects[object].volume.is_some()));
    let places = std::iter::once(0).chain(parts).collect();
    let shot = shot.with_objects(scene, main, [0.0, 10.0], &selections, &facts).map_err(|e| e.to_string())?;
    Ok((shot, places))
}

/// The texts of tests of hidden points.
fn tests_of_points() -> Vec<String> {
    let kernels = [Kernel::Trilinear, Kernel::Bspline, Kernel::BsplineSmooth, Kernel::Bspline5, Kernel::CatmullRom];
    let gradients = [
        GradientEstimator::Analytic,
        GradientEstimator::Central,
        GradientEstimator::Sobel,
        GradientEstimator::Regression,
    ];
    let plane = ClipPlane::in_index(DVec3::splat(3.0), DVec3::X, volume(false).grid());
    let mut texts = Vec::new();
    for (i, (kernel, gradient)) in kernels.into_iter().flat_map(|k| gradients.map(|g| (k, g))).enumerate() {
        // Bits of the number of a pair choose the rest.
        let has = |bit: u32| (i + i / 4) >> bit & 1 == 1;
        let (volume, clip) = (volume(has(0)), ClipPlanes(if has(1) { vec![plane.clone()] } else { Vec::new() }));
        let hiding = Hiding {
            volume: &volume,
            measured: &measured(&volume, false, has(2)),
            reconstruction: Reconstruction { kernel, gradient, ..Reconstruction::default() },
            iso: 5.0,
            clip: &clip,
            perspective: has(0) != has(1),
            near: 0.1,
        };
        for precision in [Precision::Single, Precision::Double] {
            texts.push(volume_stippling::shader(&hiding, precision).text_of_search(precision));
        }
    }
    texts
}

/// The text of a shader in which the names of attached shaders are as their modules have them.
fn without_suffixes(text: &str) -> String {
    let mut text = text.replace("_of_selection", "");
    for part in 0..2 {
        let (mut plain, mut rest, suffix) = (String::new(), text.as_str(), format!("_{part}"));
        while let Some((before, after)) = rest.split_once(&suffix) {
            plain.push_str(before);
            if after.starts_with(|c: char| c.is_ascii_alphanumeric() || c == '_') {
                plain.push_str(&suffix);
            }
            rest = after;
        }
        text = plain + rest;
    }
    text
}

/// Ids on a grid.
fn ids(grid: &Grid) -> Volume {
    let ids = (0..grid.len()).map(|i| (i % 3) as u8).collect();
    Volume::new(grid.clone(), Voxels::U8(ids), 1.0, 0.0).unwrap()
}

/// Parses and validates a text, with numbers of 64 bits where it has them.
fn validate(text: &str) -> Result<(), String> {
    let module = naga::front::wgsl::parse_str(text).map_err(|error| error.emit_to_string(text))?;
    let mut validator =
        naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::FLOAT64);
    validator.validate(&module).map(drop).map_err(|error| error.emit_to_string(text))
}

/// The files below a folder of the crate with a suffix.
fn files(folder: impl AsRef<Path>, suffix: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let mut found: Vec<PathBuf> = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files(path, suffix));
        } else if path.extension().is_some_and(|found| found == suffix) {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// The modules of the crate, by their files.
fn modules() -> Vec<(PathBuf, String)> {
    files("src", "wgsl").into_iter().map(|path| (path.clone(), fs::read_to_string(path).unwrap())).collect()
}

/// The number of modules without a formula.
const GLUE: usize = 56;

/// Each module says which Rust file has the same formula, and has its stem or a variant of it; glue says what it is.
#[test]
fn each_module_names_its_twin() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let wrong: Vec<PathBuf> =
        modules().into_iter().filter(|(path, text)| !names_a_twin(path, text, &root)).map(|(path, _)| path).collect();
    assert!(wrong.is_empty(), "{wrong:?}");
    let glue = modules().iter().filter(|(_, text)| text.contains("// Glue: ")).count();
    assert!(glue <= GLUE, "{glue} files are glue: a formula has a twin");
}

fn names_a_twin(path: &Path, text: &str, root: &Path) -> bool {
    let head = text.lines().take_while(|line| line.starts_with("//"));
    let mut said = head
        .filter_map(|line| line.strip_prefix("// Twin: ").map(Some).or(line.strip_prefix("// Glue: ").map(|_| None)));
    match (said.next(), said.next()) {
        (Some(None), None) => true,
        (Some(Some(twin)), None) => {
            let [stem, own] = [Path::new(twin), path].map(|path| path.file_stem().unwrap().to_str().unwrap());
            let variant = own.strip_prefix(stem).is_some_and(|rest| rest.is_empty() || rest.starts_with('_'));
            variant && twin.ends_with(".rs") && root.join(twin).is_file()
        }
        _ => false,
    }
}

/// Each pair of alternatives that a scene can have occurs in one of the shaders, and so does each module; those for viewers
/// stand alone.
#[test]
fn every_pair_of_effects_has_a_valid_shader() {
    let sizes: Vec<usize> = CHOICES.iter().map(|(_, alternatives)| alternatives.len()).collect();
    let mut modules = modules();
    for precision in [Precision::Single, Precision::Double] {
        let shader = crate::ray::present::text(precision, 3, 5, 1);
        validate(&shader).unwrap_or_else(|error| panic!("{error}"));
        modules.retain(|(_, module)| !shader.contains(module));
    }
    let mut seen = BTreeSet::new();
    let [mut state, mut valid] = [1u64, 0];
    // Scenes at random, of which those with a new pair are kept.
    for _ in 0..20_000 {
        let chosen: Vec<usize> = sizes
            .iter()
            .map(|&size| {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                (state >> 33) as usize % size
            })
            .collect();
        let pairs: Vec<[usize; 4]> = (0..chosen.len())
            .flat_map(|a| (0..a).map(move |b| (a, b)))
            .map(|(a, b)| [a, chosen[a], b, chosen[b]])
            .collect();
        if pairs.iter().all(|pair| seen.contains(pair)) {
            continue;
        }
        let is = |name: &str| chosen[place(name)] == 1;
        let precision = if is("number") { Precision::Double } else { Precision::Single };
        let beside = Beside {
            has_picture: is("picture behind"),
            labels_are_elsewhere: is("labels elsewhere"),
            has_lines: is("lines"),
            interpolation: if is("texture unit") { Interpolation::Fast } else { Interpolation::Exact },
        };
        let text = text(&chosen);
        let Ok(scene) = parse(&text, Path::new("scene.toml"), &Overrides::default()) else { continue };
        let Ok(Some(shader)) = composed(&scene, &volume(is("mask")), beside, precision) else { continue };
        validate(&shader).unwrap_or_else(|error| panic!("{text}\n{error}"));
        let of_parts = without_suffixes(&shader);
        modules.retain(|(_, module)| !shader.contains(module) && !of_parts.contains(module.trim_end()));
        valid += 1;
        seen.extend(pairs);
    }
    // Pairs without a scene: analytic Hessians of kernels that are not smooth enough, neither a function nor a surface, halos
    // on shells and with lines.
    let impossible = [("Hessian", 1, "kernel", 0), ("Hessian", 1, "kernel", 4), ("surface", 0, "material", 0)];
    let of_halos = |a, b| (1..6).map(move |i| if a == "halos" { (a, i, b, 1) } else { (a, 1, b, i) });
    let impossible = impossible.into_iter().chain(of_halos("halos", "planes"));
    let impossible = impossible.chain(of_halos("lines", "halos"));
    let impossible: Vec<_> = impossible.map(|(a, i, b, j)| [place(a), i, place(b), j]).collect();
    let all = (0..sizes.len()).flat_map(|a| (0..a).map(move |b| (a, b)));
    let all = all
        .flat_map(|(a, b)| (0..sizes[a]).map(move |i| (a, i, b)))
        .flat_map(|(a, i, b)| (0..sizes[b]).map(move |j| [a, i, b, j]));
    let missing: Vec<_> = all.filter(|pair| !seen.contains(pair)).collect();
    println!("{valid} shaders with {} pairs of alternatives", seen.len());
    assert_eq!(missing, impossible);
    for shader in tests_of_points() {
        validate(&shader).unwrap_or_else(|error| panic!("{error}"));
        modules.retain(|(_, module)| !shader.contains(module));
    }
    let unused: Vec<_> = modules.iter().map(|(path, _)| path).collect();
    assert!(unused.is_empty(), "no scene has {unused:?}");
}

/// Scenes with a function and a surface of their own.
#[test]
fn the_scenes_of_the_repository_have_valid_shaders() {
    let mut valid = Vec::new();
    for path in files("../data/scenes", "toml") {
        let text = fs::read_to_string(&path).unwrap();
        let scene = parse(&text, &path, &Overrides::default()).unwrap_or_else(|error| panic!("{error}"));
        if !scene.draws_volume() {
            continue;
        }
        let interpolation = Interpolation::Exact;
        let beside = Beside { has_picture: false, labels_are_elsewhere: false, has_lines: true, interpolation };
        for precision in [Precision::Single, Precision::Double] {
            // A function or a focus that is found in the data has no shot yet.
            if let Ok(Some(shader)) = composed(&scene, &volume(false), beside, precision) {
                validate(&shader).unwrap_or_else(|error| panic!("{}\n{error}", path.display()));
                valid.push(path.clone());
            }
        }
    }
    println!("{} shaders", valid.len());
    assert!(valid.len() > 60, "{valid:?}");
}
