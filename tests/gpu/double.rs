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

/// The largest difference between the reference and shaders in f64 with a fault: a text in the place of another one.
pub(crate) fn difference_with(scene: &str, (old, new): (&str, &str)) -> Option<f64> {
    let gpu = gpu()?;
    let scene = parse(scene, "scene.toml".as_ref(), &Overrides::default()).unwrap_or_else(|faults| panic!("{faults}"));
    let job = Job::load(scene).unwrap_or_else(|failures| panic!("{failures}"));
    let (truth, _) = job.renderer().unwrap_or_else(|failure| panic!("{failure}")).frame(&|_| ());
    let drawn = GpuJob::new(&job, &gpu, Precision::Double).unwrap_or_else(|failure| panic!("{failure}"));
    let edit = |text: String| {
        assert_eq!(text.matches(old).count(), 1, "{old}");
        text.replace(old, new)
    };
    let mut renderer = drawn.edited(&edit).unwrap_or_else(|failure| panic!("{failure}"));
    let drawn = renderer.frame(&|_| ()).unwrap_or_else(|error| panic!("{error}"));
    let pairs = truth.layers.iter().zip(&drawn.layers).flat_map(|(a, b)| a.channels.iter().zip(&b.channels));
    Some(pairs.flat_map(|(a, b)| a.iter().zip(b)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max))
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

#[test]
fn regular() {
    for (name, more) in [
        ("unshaded", ""),
        ("phong", "[shading]\n"),
        ("orthographic", "[shading]\n[camera]\nprojection = \"orthographic\"\n"),
        ("shells", "[shading]\n[sampling]\nstep_along = \"ray\"\n"),
        ("facing", "[shading]\n[sampling]\nnormal = \"facing\"\n"),
    ] {
        let Some(found) = differences(&format!("{TORUS}{more}")) else { return };
        println!("{name}: {found:?}");
        assert!(found[0] < 1e-9, "{name}: {found:?}");
    }
}
