//! Objects on the card: selections, ghosts, intersections and cutaways (Bruckner and Gröller 2005), as the reference draws
//! them.

use crate::double::{agrees, follows_the_camera, load};
use crate::gpu;
use crate::meshes::Meshes;
pub(crate) use crate::object_scenes::{Files, MOVED, shells};
use crate::object_scenes::{PRODUCT, SHELLS, object, quoted, styled, two_quantities};
use drypoint::drawing::Drawing;
use drypoint::gpu::{GpuJob, Precision};
use drypoint::job::SceneVariant;
use drypoint::marking::Marking;
use drypoint::scene::counts::Counts;

/// Compares scenes: shaders in f64 with the reference.
fn compare(variants: Vec<(&str, String)>) {
    for (name, scene) in variants {
        agrees(name, &scene);
    }
}

#[test]
fn selections_and_ghosts() {
    let files = Files::new();
    let by_value = |more: &str| object("c", &format!("value = [[90, 0], [130, 0.8], [200, 0.3]]\n{more}"));
    compare(vec![
        ("not moved", shells(&files.soft(""))),
        (
            "everything mirrored, along rays",
            shells(&(object("a", "scale = [-1, 1, 1]\nmove = [14, 2, 0]") + "[sampling]\nstep_along = \"ray\"\n")),
        ),
        (
            "three by products, moved, orthographic",
            shells(
                &(PRODUCT.to_owned()
                    + &files.soft(MOVED)
                    + &by_value("")
                    + &files.own("move = [3, 0, 0]")
                    + "[camera]\nprojection = \"orthographic\"\n"),
            ),
        ),
    ]);
}

/// In a frame of `[orbit]` the selections are moved by M'. Frames that take the scene of each frame are those of new ones,
/// also where a ghost appears.
#[test]
fn selections_before_the_eye_or_pinned() {
    let Some(gpu) = gpu() else { return };
    let files = Files::new();
    for (state, motion) in [("decoupled", ""), ("pinned", MOVED)] {
        let orbit = "[orbit]\nframes = 3\ndegrees = 100\n";
        let job = load(&shells(&(files.soft(&format!("{motion}\ninteraction = \"{state}\"")) + orbit)));
        let views = (0..3)
            .map(|i| job.scene.orbit.unwrap().view(&job.view().unwrap(), &job.scene.camera, job.volume.grid(), i));
        let variants: Vec<SceneVariant> = views.map(|view| job.seen_from(view).unwrap()).collect();
        let drawn = |variant, precision| {
            let on_gpu = GpuJob::of(&job, &gpu, variant, precision).unwrap_or_else(|failure| panic!("{failure}"));
            on_gpu.frame(&|_| ()).unwrap_or_else(|failure| panic!("{failure}"))
        };
        let (truth, _) = job.renderer_of(&variants[1]).unwrap().frame(&|_| ());
        let pairs = [truth, drawn(&variants[1], Precision::Double)].map(|picture| picture.layers[0].channels.concat());
        let largest = pairs[0].iter().zip(&pairs[1]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(largest < 1e-9, "{state}, {motion}: {largest:e}");
        let mut counts = Counts::default();
        let marking = Marking::new(&job, &mut counts, &|_| ()).unwrap();
        let mut drawing = Drawing::on(&job, &marking, Some(&gpu), &mut counts).unwrap();
        for i in [0, 1, 2, 0] {
            let (frame, _) = drawing.frame(i, &|_| ()).unwrap_or_else(|failure| panic!("{failure}"));
            let fresh = drawn(&variants[i], Precision::Single);
            assert!(frame.picture.unwrap().layers == fresh.layers, "frame {i}: {state}, {motion}");
        }
    }
}

#[test]
fn intersections() {
    let files = Files::new();
    let picture = files.picture();
    let meet = |with: &str, more: &str| format!("[[intersection]]\nobject = \"a\"\nwith = \"{with}\"\n{more}\n");
    let near = files.soft("move = [2, -1, 1]\nrotate = { axis = [1, 2, 0.5], angle = 30 }");
    let mean = meet("background", "opacity = \"plus\"\nswap = true");
    let color = meet("ghost", "color = \"#ff4010c0\"\nopacity = \"over\"");
    let from_picture = meet("ghost", &format!("color = {}", quoted(&picture)));
    let dabs = "dabs = [{ at = [110, 90], width = [30, 50], color = \"#20ff40c0\" }, \
                { at = [140, 150], width = 40, color = \"#4020ff\" }]";
    // On a cut the background has the plane's normal, also where it meets something.
    let half = object("a", "value = [[0, 0.5], [255, 0.5]]\nmove = [2, 1, 0]");
    let clip = "[[clip]]\npoint = [12, 12, 12]\nnormal = [0.2, -1, 0.1]\nspace = \"index\"\napplies = [\"background\"]\n\
                [camera]\ndirection = [0, 1, 0]\n";
    // A band of values between those of any two voxels.
    let between = object("b", "value = [[101.3, 0], [101.4, 1], [101.5, 0]]\nmove = [3, 0, 0]");
    compare(vec![
        ("on a cut", shells(&(half + &mean + clip))),
        ("dabs on a colour, and on the mean", shells(&(near.clone() + &between + &color + dabs + "\n" + &mean + dabs))),
        (
            "a picture with dabs, by products, of styles",
            styled(&(PRODUCT.to_owned() + &near + &from_picture + dabs + "\n" + &mean)),
        ),
    ]);
}

#[test]
fn cutaways() {
    let files = Files::new();
    let behind = "move = [2, 3, 1]\nghosting = 0.8\nghosting_of_ghost = 0.3";
    let lighting = "[shading]\nmodel = \"lighting-function\"\npreset = \"metal-contours\"";
    let smooth = files.soft(&format!("{behind}\nfunnel = \"2 px\""))
        + &files.own("move = [3, 0, 0]\nghosting = 0.5\nfunnel = \"1.3 px\"\ncut = \"object\"");
    compare(vec![
        ("by boxes, of styles", styled(&files.soft(behind))),
        (
            "by objects, of a lighting function, with counts",
            SHELLS.replace("LAYERS", "layers = [\"beauty\", \"counts\"]").replace("[shading]", lighting)
                + &files.soft(&format!("{behind}\ncut = \"object\"")),
        ),
        ("smooth, two, along rays", shells(&(smooth + "[sampling]\nstep_along = \"ray\"\n"))),
    ]);
}

#[test]
fn looks_of_parts() {
    let files = Files::new();
    let own_look = "[object.transfer]\nkind = \"regular\"\n\
                    nodes = [{ at = 30, color = \"#30ff60\", opacity = 0.2 }, { at = 240, color = \"#ffffff\", opacity = 0.9 }]\n\
                    [object.shading]\nmodel = \"toon\"\n\
                    [object.ghost.shading]\nmodel = \"lighting-function\"\npreset = \"tone\"\n";
    let clip = "[[clip]]\npoint = [12, 12, 12]\nnormal = [0, -1, 0]\nspace = \"index\"\ncap = \"#ff3010c0\"\n\
                applies = [\"background\", \"a\"]\n";
    let layers = "layers = [\"beauty\", \"normal\", \"depth\", \"gradient\", \"first\", \"first.normal\", \"curvature\", \"counts\"]";
    compare(vec![
        (
            "of their own, with layers",
            SHELLS.replace("LAYERS", layers)
                + &files.soft(&format!("{MOVED}\n{own_look}"))
                + &files.own("move = [3, 0, 0]"),
        ),
        (
            "cut, before an iso-surface",
            shells(&(files.soft(MOVED) + clip + "[surface]\niso = 110\ncolor = \"#c0c0c0\"\n")),
        ),
        ("by exact κ", styled(&files.soft(MOVED)).replace("kappa = \"ray\"", "kappa = \"exact\"")),
        ("by gradient magnitudes", two_quantities(&files.soft(MOVED))),
    ]);
}

/// Two objects that meet each other and the background, with the coverage of each part.
pub(crate) fn covering(files: &Files) -> String {
    let near = files.soft("move = [2, -1, 1]\nrotate = { axis = [1, 2, 0.5], angle = 30 }\nghosting = 0.6");
    let meet = |with: &str, more: &str| format!("[[intersection]]\nobject = \"a\"\nwith = \"{with}\"\n{more}\n");
    let both = meet("background", "opacity = \"plus\"\nswap = true")
        + &meet("ghost", "color = \"#ff4010c0\"\nopacity = \"over\"");
    let layers = "layers = [\"beauty\", \"part0\", \"part2\", \"part4\", \"part1\", \"part3\"]";
    SHELLS.replace("LAYERS", layers) + &near + &both + &files.own("move = [3, 0, 0]")
}

/// The coverage of objects, of an iso-surface, and beside a mesh, which covers none.
#[test]
fn which_object_a_pixel_shows() {
    let files = Files::new();
    let all = covering(&files);
    let surface = "[surface]\niso = 110\ncolor = \"#c0c0c0\"\n";
    let meshes = Meshes::new();
    let alone = SHELLS.replace("LAYERS", "layers = [\"part0\"]") + surface;
    let two_across = |text: String| text.replace("samples = 1\n", "samples = 2\n");
    compare(vec![
        ("by products, rays at edges", (all.clone() + PRODUCT).replace("samples = 1\n", "")),
        ("before an iso-surface and a mesh", all.clone() + surface + &meshes.mesh("flat.ply", "")),
        ("with halos, two rays across", two_across(all + "[[halo]]\nevery = 3\n")),
        ("the volume alone", two_across(alone)),
    ]);
}

/// Each part seeds by its own sample, in the guard band too ([VS-2]).
#[test]
fn halos_of_parts() {
    let files = Files::new();
    let near = files.soft("move = [3, -2, 1]\nrotate = { axis = [1, 2, 0.5], angle = 30 }");
    let of = |part: &str, more: &str| format!("[[halo]]\nobject = \"{part}\"\n{more}\n");
    let bright = "kind = \"emissive\"\nevery = 2\nseed.value = [[60, 0], [120, 1], [200, 0.4]]";
    let focus = "seed = { focus = { at = [[16, 10, 12]], inner = 2, falloff = 9 }, direction = { toward = 30, width = 120, softness = 40 } }";
    let each = of("a", bright) + &of("a ghost", focus) + &of("background", "every = 3\naccumulate = \"mean\"");
    let cut = "move = [2, 3, 1]\nghosting = 0.8\nghosting_of_ghost = 0.3\nfunnel = \"2 px\"\ncut = \"object\"";
    let layers = "layers = [\"beauty\", \"normal\", \"depth\", \"first\", \"counts\", \"halo0\", \"halo1\"]";
    let clip = "[[clip]]\npoint = [12, 12, 12]\nnormal = [0, -1, 0]\nspace = \"index\"\ncap = \"#ff3010c0\"\n\
                applies = [\"background\", \"a\"]\n[surface]\niso = 110\ncolor = \"#c0c0c0\"\n";
    let by_value = object("c", "value = [[90, 0], [130, 0.8], [200, 0.3]]\nmove = [3, 0, 0]");
    let small = |(name, scene): (_, String)| (name, scene.replace("size = [40, 32]", "size = [20, 16]"));
    let variants = vec![
        ("each set a halo, by products", shells(&(PRODUCT.to_owned() + &near + &each))),
        (
            "in a funnel, with layers",
            SHELLS.replace("LAYERS", layers) + &files.soft(cut) + "[[halo]]\nfloor = 0.1\n" + &of("background", ""),
        ),
        (
            "by objects, of data of its own, two rays across",
            shells(
                &(files.own("move = [3, 0, 0]\nghosting = 0.6\ncut = \"object\"")
                    + &by_value
                    + "[[halo]]\nevery = 4\n"),
            )
            .replace("samples = 1\n", "samples = 4\n"),
        ),
        (
            "by curvature, of styles, cut, before an iso-surface",
            styled(&(near.clone() + clip + "[[halo]]\nseed.by = \"curvature\"\n")),
        ),
        (
            "by gradient magnitudes, beside values that show nothing",
            two_quantities(
                &(near + "[[halo]]\nkind = \"emissive\"\n[[halo]]\nseed.value = [[5, 0], [12, 1], [19, 0]]\n"),
            ),
        ),
    ];
    compare(variants.into_iter().map(small).collect());
}

/// A renderer that is turned draws what a new one draws: the rays of parts, light from the world, and planes of halos.
#[test]
fn objects_follow_the_camera() {
    let Some(gpu) = gpu() else { return };
    let files = Files::new();
    let of = |direction: &str| {
        let light = "[object.shading]\nmodel = \"lighting-function\"\npreset = \"blinn-phong-contours\"\nlight = { world = [1, 0.2, 0.1] }\n";
        load(&shells(
            &(format!("[camera]\ndirection = {direction}\n")
                + &files.soft(&format!("{MOVED}\nghosting = 0.7\nfunnel = \"2 px\"\n{light}[[halo]]\n"))),
        ))
    };
    let [first, second] = ["[0.2, 1, -0.4]", "[-1, 0.2, -0.4]"].map(of);
    follows_the_camera(&gpu, [&first, &second]);
}
