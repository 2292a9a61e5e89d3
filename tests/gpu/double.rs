//! The algorithm without rounding: the same shaders in f64 equal the reference to 10⁻⁹.

use crate::gpu;
use drypoint::gpu::{GpuJob, Precision};
use drypoint::job::Job;
use drypoint::scene::file::{Overrides, parse};

/// The largest differences between the reference and shaders in f64 and in f32.
pub(crate) fn differences(scene: &str) -> Option<[f64; 2]> {
    let gpu = gpu()?;
    let scene = parse(scene, "scene.toml".as_ref(), &Overrides::default()).unwrap_or_else(|faults| panic!("{faults}"));
    let job = Job::load(scene).unwrap_or_else(|failures| panic!("{failures}"));
    let (truth, _) = job.renderer().unwrap_or_else(|failure| panic!("{failure}")).frame(&|_| ());
    Some([Precision::Double, Precision::Single].map(|precision| {
        let drawn = GpuJob::new(&job, &gpu, precision).and_then(|drawn| drawn.frame(&|_| ()));
        let drawn = drawn.unwrap_or_else(|failure| panic!("{failure}"));
        let mut largest: f64 = 0.0;
        for (a, b) in truth.layers.iter().zip(&drawn.layers) {
            for (a, b) in a.channels.iter().flatten().zip(b.channels.iter().flatten()) {
                largest = largest.max((a - b).abs());
            }
        }
        largest
    }))
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

/// The differences for variants of the torus: tables, and keys to replace.
fn compare(variants: &[(&str, &str)]) {
    for (name, more) in variants {
        let Some([double, single]) = differences(&format!("{TORUS}{more}")) else { return };
        println!("{name}: f64 {double:.1e}, f32 {single:.1e}");
        assert!(double < 1e-9, "{name}: {double:e}");
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
fn clip_planes() {
    compare(&[
        ("plane", "[shading]\n[[clip]]\npoint = [15, 15, 15]\nnormal = [0, -1, 0]\nspace = \"index\"\n"),
        (
            "box with a cap",
            "[shading]\n[[clip]]\nbox = [[4, 20], [3, 17], [8, 30]]\nspace = \"index\"\ncap = \"#ff3010c0\"\n",
        ),
    ]);
}
