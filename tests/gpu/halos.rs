//! Volumetric halos (Bruckner and Gröller 2007): shaders in f64 equal the reference to 10⁻⁹.

use crate::double::{agrees, load};
use crate::halo_scenes::TORUS;
pub(crate) use crate::halo_scenes::{FIVE, scene};
use crate::two_quantities::{labels, styles, torus};
use crate::{field, gpu};
use drypoint::frames::Frames;
use drypoint::gpu::{GpuFrames, GpuJob, Precision};
use drypoint::job::Job;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::space::Grid;

/// Compares scenes: a name, keys of the picture, further tables.
fn check(scenes: &[(&str, &str, &str)]) {
    for (name, picture, tables) in scenes {
        agrees(name, &scene(picture, tables));
    }
}

#[test]
fn one_occlusive_halo() {
    check(&[("occlusive", "", "[[halo]]\n")]);
}

#[test]
fn emissive_halos() {
    check(&[
        ("emissive, M = 4", "", "[[halo]]\nkind = \"emissive\"\nevery = 4\n"),
        ("encoded", "blend_space = \"srgb\"", "[[halo]]\nkind = \"emissive\"\n[[halo]]\nseed.by = \"curvature\"\n"),
        ("coarse", "", "[[halo]]\nkind = \"emissive\"\nevery = 3\n[sampling]\nstep = \"0.8 voxel\"\n"),
    ]);
}

#[test]
fn groups_of_planes() {
    check(&[
        ("M = 4, mean", "", "[[halo]]\nevery = 4\naccumulate = \"mean\"\n"),
        ("M = 7, maximum", "", "[[halo]]\nkind = \"emissive\"\nevery = 7\naccumulate = \"max\"\n"),
        (
            "groups that end apart",
            "",
            "[[halo]]\nevery = 3\n[[halo]]\nkind = \"emissive\"\nevery = 4\n[[halo]]\nkind = \"emissive\"\n",
        ),
    ]);
}

#[test]
fn several_halos() {
    check(&[
        (
            "two occlusive ones",
            "",
            "[[halo]]\nprofile = [{ at = 0, color = \"red\", opacity = 0.5 }]\n[[halo]]\nseed.by = \"curvature\"\n",
        ),
        ("five, encoded", "blend_space = \"srgb\"", FIVE),
    ]);
}

#[test]
fn seeds_of_halos() {
    check(&[
        ("printed exponents", "", "[[halo]]\nexponents = \"printed\"\n"),
        ("exponents", "", "[[halo]]\nexponents = [0.7, 4]\n"),
        (
            "curvature from Hessians",
            "",
            "[[halo]]\nseed = { by = \"curvature\", thickness = \"2 voxels\" }\n[contours]\nkappa = \"exact\"\n",
        ),
        ("nodes", "", "[[halo]]\nseed.value = [[100, 0], [128, 1], [128, 0.5], [150, 0]]\n"),
        ("every value", "", "[[halo]]\nseed.by = \"curvature\"\nseed.value = [[0, 1]]\n"),
        ("direction", "", "[[halo]]\nseed.direction = { toward = 135, width = 90, softness = 40 }\n"),
        (
            "direction without softness, and a focus",
            "",
            "[[halo]]\nseed.direction = { toward = -20, width = 120, softness = 0 }\n\
             [[halo]]\nseed.focus = { at = [[20, 10, 15]], inner = 4, falloff = 8 }\n",
        ),
        (
            "polyline",
            "",
            "[[halo]]\nkind = \"emissive\"\nseed.focus = { at = [[5, 6, 7], [20, 10, 15], [20, 30, 15]], inner = 2, falloff = 5 }\n",
        ),
        ("focus with a step", "", "[[halo]]\nseed.focus = { at = [[20, 10, 15]], inner = 7, falloff = 0 }\n"),
        ("no floor", "", "[[halo]]\nfloor = 0\n"),
    ]);
}

#[test]
fn spreading_of_halos() {
    check(&[
        ("seeds", "", "[[halo]]\nspread.from = \"seeds\"\n"),
        (
            "median of one of two",
            "",
            "[[halo]]\nspread.median = true\nexponents = [0.2, 2]\n[[halo]]\nkind = \"emissive\"\n",
        ),
        ("delta 1", "", "[[halo]]\nspread.delta = 1\n"),
        ("reach", "", "[[halo]]\nspread.reach = \"31 %\"\n"),
        ("print", "dpi = 300", "[[halo]]\nspread.reach = \"3 mm\"\n"),
        ("automatic rays", "samples = \"auto\"", "[[halo]]\n"),
        ("nine rays and reach", "samples = 3", "[[halo]]\nspread.reach = \"11 %\"\nkind = \"emissive\"\n"),
    ]);
}

#[test]
fn halos_beside_other_effects() {
    let layers = "layers = [\"beauty\", \"halo0\", \"Z\", \"normal\", \"gradient\", \"depth\", \"first\", \"first.normal\", \"halo1\"]";
    check(&[
        (
            "layers of four rays",
            &format!("samples = 2\n{layers}"),
            "[[halo]]\n[[halo]]\nkind = \"emissive\"\nevery = 2\n",
        ),
        (
            "cut",
            "",
            "[[halo]]\nseed.by = \"curvature\"\n[[halo]]\nkind = \"emissive\"\n[[clip]]\npoint = [15, 15, 15]\nnormal = [0.2, -1, 0]\nspace = \"index\"\ncap = \"#ff3010c0\"\n",
        ),
        ("no background", "background = \"none\"", "[[halo]]\nkind = \"emissive\"\n"),
        ("silhouettes", "", "[[halo]]\n[shading.silhouette]\n"),
        (
            "kernel",
            "",
            "[[halo]]\nseed.by = \"curvature\"\n[sampling]\nkernel = \"bspline-smooth\"\ngradient = \"sobel\"\n",
        ),
        (
            "cut surface",
            "",
            "[[halo]]\n[[halo]]\nkind = \"emissive\"\n[surface]\niso = 132\nlook = \"toon\"\n\
             [[clip]]\npoint = [15.3, 15.2, 15.1]\nnormal = [0.2, -1, 0.1]\nspace = \"index\"\ncap = \"#ff3010c0\"\n",
        ),
        (
            "κ at a surface",
            "layers = [\"beauty\", \"curvature.KV\", \"first.curvature.KV\"]",
            "[[halo]]\n[surface]\niso = 132\nlook = \"phong\"\n",
        ),
        ("counts", "layers = [\"beauty\", \"counts\"]\nsamples = 1", "[[halo]]\nevery = 3\n"),
    ]);
}

/// The volume is met at once in parallel projection, and planes lie on both sides of the eye.
#[test]
fn cameras() {
    for (name, camera) in
        [("orthographic", "projection = \"orthographic\"\nheight = 40\n"), ("inside", "eye = [16, 10, 15]\n")]
    {
        let scene = scene("", "[[halo]]\nevery = 2\n[[halo]]\nkind = \"emissive\"\nevery = 2\n");
        agrees(name, &scene.replace("[camera]\n", &format!("[camera]\n{camera}")));
    }
}

/// h_v and κ of functions of styles and over two quantities; h_l.
#[test]
fn functions_and_labels() {
    let halos = "[[halo]]\n[[halo]]\nkind = \"emissive\"\nseed = { by = \"curvature\", value = \"opacity\" }\n";
    let cut = "[[clip]]\npoint = [20, 18, 16]\nnormal = [1, 0.7, 0.4]\nspace = \"index\"\n";
    let rows = styles([2.0, 10.0, 20.0]);
    let gradients = format!("over = [\"value\", \"gradient-magnitude\"]\n{rows}");
    let along_view = format!("over = [\"value\", \"kv\"]\n{}", styles([0.0, 0.1, 0.3]));
    let nodes = "nodes = [{ at = 100, style = \"wax\", opacity = 0 }, { at = 128, style = \"glass\", opacity = 0.5 }]";
    let by_value = "[[halo]]\nseed.value = [[100, 0], [128, 1]]\n";
    let path = labels("halos", &Grid::with_spacing([32; 3], [1.0; 3]).unwrap(), "uint8", 77);
    let labelled = format!("labels = {path:?}");
    let over_labels = format!("over = [\"value\", \"label\"]\n{}", styles([1.0, 2.0, 77.0]));
    let of_labels = "[[halo]]\nseed.labels = [2, 77]\n[[halo]]\nkind = \"emissive\"\nseed.labels = [1]\n";
    for (name, volume, transfer, tables) in [
        ("styles and a table", "", &format!("table = 64\n{nodes}"), halos.to_owned()),
        ("styles and a cut", "", &nodes.to_owned(), format!("{halos}{cut}[contours]\nthickness = \"1.5 voxels\"\n")),
        ("gradients, seeds of values", "", &gradients, by_value.to_owned()),
        ("curvatures", "", &along_view, format!("{halos}[contours]\n{cut}")),
        ("labels twice", &labelled, &over_labels, of_labels.to_owned()),
    ] {
        agrees(name, &torus(volume, transfer, &format!("{tables}[sampling]\nstep = \"1 voxel\"\n")));
    }
}

#[test]
fn fields_of_halos() {
    let halos = "[shading]\n[[halo]]\nseed.by = \"curvature\"\n[[halo]]\nkind = \"emissive\"\nevery = 2\n";
    field::compare("halos", &[([11, 9, 8], "uchar"), ([11, 9, 8], "masked"), ([14, 12, 1], "uchar")], halos);
    let surface = format!("{halos}[surface]\niso = 150\nlook = \"phong\"\n");
    field::compare("halos and a surface", &[([11, 9, 8], "uchar"), ([11, 9, 8], "masked")], &surface);
}

/// The text of shaders, and how a picture is refused whose images do not fit.
#[test]
fn what_halos_add() {
    let Some(gpu) = gpu() else { return };
    let text = |tables: &str| {
        let scene = parse(&scene("", tables), "scene.toml".as_ref(), &Overrides::default()).unwrap();
        let job = Job::load(scene).unwrap_or_else(|failures| panic!("{failures}"));
        let text = std::cell::RefCell::new(String::new());
        let drawn = GpuJob::new(&job, &gpu, Precision::Single).unwrap();
        let keep = |whole: String| {
            text.replace(whole.clone());
            whole
        };
        drop(drawn.edited(&keep).unwrap_or_else(|failure| panic!("{failure}")));
        text.into_inner().to_lowercase()
    };
    assert!(!text("").contains("halo") && !text("").contains("seed"));
    assert!(!text("[[halo]]\nopacity = 0\n").contains("halo"));
    assert!(text("[[halo]]\n").contains("fn halo_planes"));
}

#[test]
fn a_picture_that_is_too_large() {
    let Some(gpu) = gpu() else { return };
    let large = TORUS.replace("size = [64, 48]", "size = [16000, 12000]").replace("PICTURE\n", "samples = 4\n");
    let scene = parse(&format!("{large}[[halo]]\n"), "scene.toml".as_ref(), &Overrides::default()).unwrap();
    let job = Job::load(scene).unwrap_or_else(|failures| panic!("{failures}"));
    let failure = GpuJob::new(&job, &gpu, Precision::Single).unwrap().renderer().err().unwrap().to_string();
    assert!(failure.contains("the list of rays takes 73728000000 bytes"), "{failure}");
}

/// A group of planes is a visit, and one dispatch for all stages of spreading if a workgroup has memory for them: two dispatches
/// that wait for each other. Groups whose bricks cannot seed are visited together.
#[test]
fn dispatches_of_a_frame() {
    let Some(gpu) = gpu() else { return };
    let camera = "direction = [0, 0, 1]\nup = [0, 1, 0]\nprojection = \"orthographic\"\nheight = 40";
    let count = |tables: &str| {
        let job = load(&scene("", tables).replace("direction = [0.3, 1, -0.4]", camera));
        let mut frames = GpuFrames::new(&job, &gpu).unwrap_or_else(|failure| panic!("{failure}"));
        let before = gpu.dispatches();
        frames.frame(&|_| ()).unwrap_or_else(|failure| panic!("{failure}"));
        gpu.dispatches() - before
    };
    assert_eq!(count(""), 1);
    // No value seeds: the start of rays, one visit, the pixels.
    let nothing = "[[halo]]\nseed.value = [[1000, 0], [1001, 1]]\n";
    assert_eq!(count(nothing), 3);
    // 31 cells from the first voxel to the last one are at most 36 planes with those beside them.
    let [one, four, far] = ["", "every = 4\n", "every = 4\nspread.reach = \"130 px\"\n"]
        .map(|keys| count(&format!("[[halo]]\nseed.value = [[0, 1]]\n{keys}")));
    println!("every plane {one}, every fourth {four}, far {far}");
    assert!((2 + 2 * 32..=2 + 2 * 36).contains(&one));
    assert!((2 + 2 * 8..=2 + 2 * 10).contains(&four));
    // H₀ and four passes on their own.
    assert_eq!(far - four, (four - 2) / 2 * 4);
    // The tube of the torus is a third of the volume's depth.
    let tube = count("[[halo]]\nseed.value = [[120, 0], [140, 1]]\nevery = 4\n");
    println!("of the tube {tube}");
    assert!(tube < four);
}

/// Frames of a camera that turns are those of a renderer of its own: other planes, the same images.
#[test]
fn frames() {
    let Some(gpu) = gpu() else { return };
    let job = |direction: &str| {
        let text = scene("", "[[halo]]\n[[halo]]\nkind = \"emissive\"\nevery = 3\n");
        let text = text.replace("direction = [0.3, 1, -0.4]", direction);
        let scene = parse(&text, "scene.toml".as_ref(), &Overrides::default()).unwrap();
        Job::load(scene).unwrap_or_else(|failures| panic!("{failures}"))
    };
    let (first, second) = (job("direction = [0.3, 1, -0.4]"), job("direction = [-1, 0.2, 0.4]"));
    let fresh = |job: &Job| GpuFrames::new(job, &gpu).and_then(|mut frames| frames.frame(&|_| ())).unwrap().0;
    let mut frames = GpuFrames::new(&first, &gpu).unwrap();
    assert_eq!(frames.frame(&|_| ()).unwrap().0, fresh(&first));
    frames.turn(&second.shot().unwrap()).unwrap();
    assert_eq!(frames.frame(&|_| ()).unwrap().0, fresh(&second));
    assert_ne!(fresh(&first), fresh(&second));
}
