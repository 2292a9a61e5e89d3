//! Pictures in f32 within their derived bounds, effect by effect.

use crate::gpu;
use crate::halo_scenes;
use crate::mesh_scenes::{Meshes, scene};
use crate::object_scenes::{Files, MOVED, PRODUCT, object, shells, styled};
use drypoint::gpu::Gpu;
use drypoint::job::Job;
use drypoint::scene::file::{Overrides, parse};
use drypoint::validate::{Bounded, Verdict, validate};

/// The largest share of pixels at a decision or without a finite bound.
const MOST_UNDECIDED: f64 = 0.02;

/// A cut through the torus.
macro_rules! cut {
    () => {
        "[[clip]]\npoint = [12.3, 12.2, 12.1]\nnormal = [0.1, -1, 0.2]\nspace = \"index\"\n"
    };
}

/// The largest such share in scenes of objects and meshes, which have more edges.
const MOST_UNDECIDED_OF_OBJECTS: f64 = 0.03;

/// Holds a scene to its bounds. Returns its figures, and whether the layers of all stages have bounds.
fn kept(gpu: &Gpu, name: &str, text: &str) -> (Bounded, bool) {
    let scene = parse(text, "scene.toml".as_ref(), &Overrides::default()).unwrap_or_else(|e| panic!("{name}: {e}"));
    let job = Job::load(scene).unwrap_or_else(|failures| panic!("{name}: {failures}"));
    let found = validate(&job, gpu).unwrap_or_else(|failure| panic!("{name}: {failure}"));
    println!("{name}\n{found}");
    assert_eq!(found.verdict(), Verdict::Kept, "{name}: {found}");
    let shares = || found.stages.iter().map(|stage| stage.share);
    assert!(shares().flatten().all(|share| share < 1.0), "{name}: {found}");
    let has_layers = shares().all(|share| share.is_some());
    (found.bounded.unwrap_or_else(|| panic!("{name}: {:?}", found.unbounded)), has_layers)
}

#[test]
fn objects_and_meshes_keep_their_bounds() {
    let Some(gpu) = gpu() else { return };
    let (files, meshes) = (Files::new(), Meshes::new());
    let near = files.soft("move = [2, -1, 1]\nrotate = { axis = [1, 2, 0.5], angle = 30 }");
    let meet = "[[intersection]]\nobject = \"a\"\nwith = \"background\"\nopacity = \"plus\"\nswap = true\n";
    let behind = "move = [2, 3, 1]\nghosting = 0.8\nghosting_of_ghost = 0.3";
    let by_value = object("c", "value = [[90, 0], [130, 0.8], [200, 0.3]]\nmove = [3, 0, 0]");
    for (name, text) in [
        ("by products", shells(&(PRODUCT.to_owned() + &files.soft(MOVED) + &by_value + &files.own("")))),
        ("of styles", styled(&files.soft(MOVED))),
        ("an intersection", shells(&(near + meet))),
        ("a cutaway by a box", shells(&files.soft(behind))),
        ("meshes beside an iso-surface", scene("", &(meshes.both() + "[surface]\niso = 150\n"))),
    ] {
        let (bounded, _) = kept(&gpu, name, &text);
        assert!(bounded.undecided + bounded.endless <= MOST_UNDECIDED_OF_OBJECTS, "{name}: {:?}", bounded.decisions);
        assert!(bounded.median < 1e-3, "{name}: {}", bounded.median);
    }
}

#[test]
fn halos_keep_their_bounds() {
    let Some(gpu) = gpu() else { return };
    for (name, picture, tables) in [
        ("emissive", "", "[[halo]]\nkind = \"emissive\"\nevery = 4\n"),
        ("by curvature, encoded", "blend_space = \"srgb\"", "[[halo]]\nseed.by = \"curvature\"\n"),
        ("mean", "", "[[halo]]\nevery = 4\naccumulate = \"mean\"\n"),
        ("a median", "", "[[halo]]\nevery = 2\nspread = { passes = 3, median = true }\n"),
        ("by direction", "", "[[halo]]\nevery = 2\nseed.direction = { toward = 30, width = 120, softness = 40 }\n"),
        ("before an iso-surface", "", "[[halo]]\nevery = 2\n[surface]\niso = 145\n"),
    ] {
        let (bounded, _) = kept(&gpu, name, &halo_scenes::scene(picture, tables));
        assert!(bounded.undecided + bounded.endless <= MOST_UNDECIDED, "{name}: {:?}", bounded.decisions);
        assert!(bounded.median < 1e-3, "{name}: {}", bounded.median);
    }
}

#[test]
fn every_effect_keeps_its_bounds() {
    let Some(gpu) = gpu() else { return };
    let colors = "kind = \"regular\"\nnodes = [{ at = 100, color = \"#804020\", opacity = 0 }, \
                  { at = 128, color = \"#ffcc88\", opacity = 0.3 }, { at = 140, color = \"#88ccff\", opacity = 0.9 }]\n";
    let styles = "nodes = [{ at = 100, style = \"wax\", opacity = 0 }, { at = 140, style = \"wax\", opacity = 0.5 }]\n";
    for (name, function, more) in [
        ("orthographic", colors, "[shading]\n[camera]\nprojection = \"orthographic\"\n"),
        ("shells", colors, "[shading]\n[sampling]\nstep_along = \"ray\"\n"),
        ("tones and silhouettes", colors, "[shading]\nmodel = \"toon\"\n[shading.silhouette]\n"),
        ("view-dependent opacity", colors, "[shading]\nview_opacity = 0.7\n"),
        ("a cut", colors, concat!("[shading]\n", cut!())),
        ("a smooth kernel", colors, "[shading]\n[sampling]\nkernel = \"bspline-smooth\"\ngradient = \"sobel\"\n"),
        ("styles", styles, ""),
        ("contours", styles, "[contours]\nthickness = \"1 voxel\"\n"),
        ("contours of exact κ", styles, "[contours]\nthickness = \"1 voxel\"\nkappa = \"exact\"\n"),
        ("mip-maps", styles, "[contours]\nthickness = \"1 voxel\"\n[style_mipmaps]\n"),
        ("colours from a table", colors, "table = 256\n[shading]\n"),
        ("styles from a table", styles, "table = 64\n[contours]\nthickness = \"1 voxel\"\n"),
        ("rays at edges", colors, "[shading]\n"),
        ("an iso-surface, cut", colors, concat!("[surface]\niso = 134\nlook = \"phong\"\n", cut!())),
        (
            "an iso-surface alone",
            "",
            concat!("[surface]\niso = 128\nlook = \"phong\"\n", cut!(), "cap = \"#c0402080\"\n"),
        ),
        ("an iso-surface, smooth", "", "[surface]\niso = 128\nlook = \"phong\"\n[sampling]\nkernel = \"bspline\"\n"),
        (
            "an iso-surface, Catmull–Rom",
            colors,
            "[surface]\niso = 134\nlook = \"phong\"\n[sampling]\nkernel = \"catmull-rom\"\n",
        ),
        ("lines inside", colors, "[hatching]\niso = 128\nhidden = \"merged\"\n"),
    ] {
        let samples = if name == "rays at edges" { "\"auto\"" } else { "1" };
        let transfer = if function.is_empty() { "" } else { "[transfer]\n" };
        let text = format!(
            "drypoint = 1\n[volume]\nphantom = {{ name = \"torus\", size = 25 }}\n[picture]\nsize = [64, 48]\n\
             samples = {samples}\n{transfer}{function}{more}"
        );
        let (bounded, has_layers) = kept(&gpu, name, &text);
        assert!(has_layers, "{name}: a layer has no bound");
        assert!(bounded.undecided + bounded.endless <= MOST_UNDECIDED, "{name}: {:?}", bounded.decisions);
    }
}
