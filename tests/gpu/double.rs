//! The algorithm without rounding: the same shaders in f64 equal the reference to 10⁻⁹.

use crate::gpu;
use drypoint::gpu::{Gpu, GpuJob, Precision};
use drypoint::job::Job;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::fragments::Fragments;

/// Checks that the shader of a scene in f64 draws what the reference draws, to 10⁻⁹. In f32 bounds hold it.
pub(crate) fn agrees(name: &str, scene: &str) {
    agrees_among(name, scene, |_| None);
}

/// This check with lines inside the picture.
pub(crate) fn agrees_among(name: &str, scene: &str, lines: impl Fn(&Job) -> Option<Fragments>) {
    let Some(difference) = difference_among_with(scene, lines, None) else { return };
    println!("{name}: {difference:.1e}");
    assert!(difference < 1e-9, "{name}: {difference:e}");
}

/// The job of a scene's text.
pub(crate) fn load(scene: &str) -> Job {
    let scene = parse(scene, "scene.toml".as_ref(), &Overrides::default()).unwrap_or_else(|faults| panic!("{faults}"));
    Job::load(scene).unwrap_or_else(|failures| panic!("{failures}"))
}

/// Checks that a renderer that is turned from one job's camera to another's draws what a new one draws.
pub(crate) fn follows_the_camera(gpu: &Gpu, [first, second]: [&Job; 2]) {
    let [on_first, on_second] = [first, second].map(|job| GpuJob::new(job, gpu, Precision::Single).unwrap());
    let mut turned = on_first.renderer().unwrap();
    let before = turned.frame(&|_| ()).unwrap();
    turned.turn(&second.shot().unwrap(), first.volume.grid()).unwrap();
    let fresh = on_second.renderer().unwrap().frame(&|_| ()).unwrap();
    assert_eq!(turned.frame(&|_| ()).unwrap().layers, fresh.layers);
    assert_ne!(before.layers, fresh.layers);
}

/// The largest difference between the reference and shaders in f64 with a fault: a text in the place of another one.
pub(crate) fn difference_with(scene: &str, fault: (&str, &str)) -> Option<f64> {
    difference_among_with(scene, |_| None, Some(fault))
}

/// This difference with lines inside the picture, and a fault if there is one.
pub(crate) fn difference_among_with(
    scene: &str,
    lines: impl Fn(&Job) -> Option<Fragments>,
    fault: Option<(&str, &str)>,
) -> Option<f64> {
    let gpu = gpu()?;
    let job = load(scene);
    let lines = lines(&job);
    let mut reference = job.renderer().unwrap_or_else(|failure| panic!("{failure}"));
    reference.merge(lines.clone());
    let (truth, _) = reference.frame(&|_| ());
    let drawn = GpuJob::new(&job, &gpu, Precision::Double).unwrap_or_else(|failure| panic!("{failure}"));
    let edit = |text: String| {
        let Some((old, new)) = fault else { return text };
        assert_eq!(text.matches(old).count(), 1, "{old}");
        text.replace(old, new)
    };
    let mut renderer = drawn.edited(&edit).unwrap_or_else(|failure| panic!("{failure}"));
    let drawn = renderer.merge(lines).and_then(|()| renderer.frame(&|_| ())).unwrap_or_else(|error| panic!("{error}"));
    let pairs = truth.layers.iter().zip(&drawn.layers).flat_map(|(a, b)| a.channels.iter().zip(&b.channels));
    // Depths of nothing are +∞ in both, and what is no number is far from every one.
    let apart = |(a, b): (&f64, &f64)| match (a - b).abs() {
        _ if a == b => 0.0,
        apart if apart.is_nan() => f64::INFINITY,
        apart => apart,
    };
    Some(pairs.flat_map(|(a, b)| a.iter().zip(b)).map(apart).fold(0.0, f64::max))
}

const TORUS: &str = r##"
drypoint = 1
[volume]
phantom = { name = "torus", size = 32 }
[picture]
size = [64, 48]
samples = 1
background = "#203040"
[transfer]
kind = "regular"
nodes = [{ at = 100, color = "#804020", opacity = 0 }, { at = 128, color = "#ffcc88", opacity = 0.3 },
         { at = 140, color = "#88ccff", opacity = 0.9 }]
"##;

/// Compares variants of the torus: tables, and keys to replace.
fn compare(variants: &[(&str, &str)]) {
    for (name, more) in variants {
        agrees(name, &format!("{TORUS}{more}"));
    }
}

#[test]
fn regular() {
    compare(&[
        ("unshaded", ""),
        ("phong", "[shading]\n"),
        ("orthographic", "[shading]\n[camera]\nprojection = \"orthographic\"\n"),
        ("shells", "[shading]\n[sampling]\nstep_along = \"ray\"\n"),
        ("facing", "[shading]\n[sampling]\nnormal = \"facing\"\n"),
        ("broken shininess", "[shading]\nshininess = 7.3\n"),
        ("coarse", "[shading]\n[sampling]\nstep = \"0.8 voxel\"\n"),
    ]);
}

#[test]
fn tones_and_silhouettes() {
    compare(&[
        ("toon", "[shading]\nmodel = \"toon\"\n"),
        ("silhouettes", "[shading]\n[shading.silhouette]\n"),
        ("view opacity", "[shading]\nview_opacity = 0.7\n"),
    ]);
}

#[test]
fn lighting_functions() {
    let of = |preset: &str, more: &str| {
        format!("[shading]\nmodel = \"lighting-function\"\npreset = \"{preset}\"\nlight = [-0.5, 0.4, 0.7]\n{more}")
    };
    let names = ["blinn-phong", "blinn-phong-contours", "cartoon-contours", "metal-contours", "gradient", "tone"];
    let mut variants: Vec<(String, String)> = names.map(|name| (name.to_owned(), of(name, ""))).into();
    let more = |name: &str, more: &str| (name.to_owned(), of("metal-contours", more));
    variants.extend([
        more("printed", "contour = \"printed\"\n"),
        more("divisor at least 0.5", "divisor_floor = 0.5\n"),
        more("silhouettes and view opacity", "view_opacity = 0.7\n[shading.silhouette]\n"),
        more("orthographic", "[camera]\nprojection = \"orthographic\"\n"),
        more("cut", "[[clip]]\npoint = [15, 15, 15]\nnormal = [0, -1, 0]\nspace = \"index\"\n"),
    ]);
    compare(&variants.iter().map(|(name, more)| (&**name, &**more)).collect::<Vec<_>>());
}

/// Contours under light from the world depend on the camera: a renderer that is turned draws those of a new one.
#[test]
fn contours_follow_the_camera() {
    let Some(gpu) = gpu() else { return };
    let of = |direction: &str| {
        load(&format!(
            "{TORUS}[camera]\ndirection = {direction}\n[shading]\nmodel = \"lighting-function\"\n\
             preset = \"blinn-phong-contours\"\nlight = {{ world = [1, 0.2, 0.1] }}\n"
        ))
    };
    let [first, second] = ["[0.2, 1, -0.4]", "[-1, 0.2, -0.4]"].map(of);
    follows_the_camera(&gpu, [&first, &second]);
}

#[test]
fn clip_planes() {
    compare(&[
        ("plane", "[shading]\n[[clip]]\npoint = [15, 15, 15]\nnormal = [0, -1, 0]\nspace = \"index\"\n"),
        (
            "box with a cap",
            "[shading]\n[[clip]]\nbox = [[4, 20], [3, 17], [8, 30]]\nspace = \"index\"\ncap = \"#ff3010c0\"\n",
        ),
    ]);
}

#[test]
fn pictures() {
    let layers =
        "layers = [\"Z\", \"normal\", \"beauty\", \"gradient\", \"depth\", \"first\", \"first.normal\"]\n[shading]\n";
    let with = |keys: &str| TORUS.replace("samples = 1\n", keys);
    for (name, scene) in [
        ("encoded", format!("{}[shading]\n", with("samples = 1\nblend_space = \"srgb\"\n"))),
        ("four rays", format!("{}[shading]\n", with("samples = 2\n"))),
        ("rays at edges", format!("{}[shading]\n", with(""))),
        ("layers", format!("{}[shading]\n", with(&format!("samples = 1\n{}", &layers[..layers.len() - 10])))),
        ("layers of refined pixels", format!("{}[shading]\n", with(&layers[..layers.len() - 10]))),
        ("counts", format!("{}[shading]\n", with("samples = 2\nlayers = [\"counts\", \"beauty\"]\n"))),
        ("counts of refined pixels", format!("{}[shading]\n", with("layers = [\"counts\", \"beauty\", \"Z\"]\n"))),
        ("counts alone", with("layers = [\"counts\"]\n")),
        (
            "counts of all samples",
            format!("{}[sampling]\nkernel = \"bspline\"\nskip_empty = false\n", with("layers = [\"counts\"]\n")),
        ),
        ("no background", TORUS.replace("background = \"#203040\"", "background = \"none\"")),
        ("table", TORUS.replace("kind = \"regular\"", "kind = \"regular\"\ntable = 64")),
    ] {
        agrees(name, &scene);
    }
}
