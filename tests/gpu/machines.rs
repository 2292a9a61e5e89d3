//! Faults of machines: devices that are lost, weaker ones, and volumes and pictures that they cannot hold.

use crate::gpu;
use drypoint::frames::Frames;
use drypoint::gpu::{Gpu, GpuFrames, GpuJob, Precision, wgpu};
use drypoint::job::Job;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::picture::Picture;
use drypoint::validate::{Verdict, validate};

/// A torus of 25³ voxels under Phong's light.
const SCENE: &str = r##"
drypoint = 1
[volume]
phantom = { name = "torus", size = 25 }
[picture]
size = [64, 48]
samples = 1
[transfer]
kind = "regular"
nodes = [{ at = 100, color = "#804020", opacity = 0 }, { at = 140, color = "#88ccff", opacity = 0.9 }]
[shading]
"##;

fn job(more: &str) -> Job {
    job_of(&format!("{SCENE}{more}"))
}

fn job_of(text: &str) -> Job {
    let scene = parse(text, "scene.toml".as_ref(), &Overrides::default()).unwrap_or_else(|faults| panic!("{faults}"));
    Job::load(scene).unwrap_or_else(|failures| panic!("{failures}"))
}

/// A weaker device of the same adapter.
fn weaker(features: wgpu::Features, limits: impl FnOnce(wgpu::Limits) -> wgpu::Limits) -> Gpu {
    Gpu::limited(features, limits).unwrap_or_else(|error| panic!("{error}"))
}

fn frame(job: &Job, gpu: &Gpu) -> Result<Picture, String> {
    let frames = GpuFrames::new(job, gpu).and_then(|mut frames| frames.frame(&|_| ()));
    frames.map(|(picture, _)| picture).map_err(|failure| failure.to_string())
}

/// A device that is lost between frames gives an error with its name; a new device draws the picture again.
#[test]
fn a_lost_device_is_an_error() {
    let Some(gpu) = gpu() else { return };
    let job = job("");
    let mut frames = GpuFrames::new(&job, &gpu).unwrap_or_else(|failure| panic!("{failure}"));
    let (before, _) = frames.frame(&|_| ()).unwrap_or_else(|failure| panic!("{failure}"));
    gpu.device().destroy();
    for failure in [frames.frame(&|_| ()).map(drop), frames.show().map(drop), GpuFrames::new(&job, &gpu).map(drop)] {
        let failure = failure.expect_err("the device is lost").to_string();
        assert!(failure.contains(&format!("{} was lost", gpu.name())), "{failure}");
    }
    assert_eq!(frame(&job, &crate::gpu().unwrap()).unwrap(), before);
}

/// A driver may end all loops of a shader that looped too often, without a word. Then there is an error, and no
/// picture of rays that end where nothing is.
#[test]
fn a_driver_that_ends_loops() {
    let Some(gpu) = gpu() else { return };
    let (alone, _) = SCENE.split_once("[transfer]").unwrap_or_default();
    let many = "samples = 24\nlayers = [\"beauty\", \"depth\"]";
    let many = alone.replace("samples = 1", many).replace("[64, 48]", "[16, 12]");
    let job = job_of(&format!("{many}[shading]\n[surface]\niso = 120\n[sampling]\nkernel = \"bspline-smooth\"\n"));
    match frame(&job, &gpu) {
        Err(failure) => assert!(gpu.is_software() && failure.contains("ended rays"), "{failure}"),
        Ok(picture) => {
            let (truth, _) = job.renderer().unwrap_or_else(|failure| panic!("{failure}")).frame(&|_| ());
            let [drawn, truth] = [&picture, &truth].map(|picture| picture.layers[0].channels.concat());
            assert!(drawn.iter().zip(truth).all(|(a, b)| (a - b).abs() < 1e-3));
        }
    }
}

/// Without f64 bounds alone prove a picture, and nothing is proven where there are none.
#[test]
fn a_device_without_double_numbers() {
    if gpu().is_none() {
        return;
    }
    let gpu = weaker(wgpu::Features::empty(), |limits| limits);
    assert!(!gpu.has_double());
    let halos_of_objects = "[[object]]\nname = \"half\"\nvalue = [[120, 0], [134, 1]]\nmove = [3, -2, 2]\n[[halo]]\n";
    for (more, verdict) in [("", Verdict::Kept), ("[[halo]]\n", Verdict::Kept), (halos_of_objects, Verdict::NotProven)]
    {
        let job = job(more);
        let found = validate(&job, &gpu).unwrap_or_else(|failure| panic!("{failure}"));
        assert!(found.stages.iter().all(|stage| stage.double.is_none()) && found.parts_at.is_none());
        assert_eq!(found.verdict(), verdict, "{found}");
        let failure = GpuJob::new(&job, &gpu, Precision::Double).err().expect("there is no f64").to_string();
        assert!(failure.contains("has no numbers in f64"), "{failure}");
    }
    assert!(gpu.interpolating(drypoint::gpu::Interpolation::Fast).is_err());
}

/// A volume that is larger than a texture is an error with its size, before anything is uploaded.
#[test]
fn a_volume_larger_than_a_texture() {
    if gpu().is_none() {
        return;
    }
    let gpu = weaker(wgpu::Features::empty(), |limits| wgpu::Limits { max_texture_dimension_3d: 16, ..limits });
    let failure = frame(&job(""), &gpu).unwrap_err();
    assert!(failure.contains("29 × 29 × 29 numbers with its border") && failure.contains("at most 16"), "{failure}");
}

/// A picture that a buffer cannot hold is drawn in bands of rows, to the same bits, also where pixels at edges are drawn
/// again. A viewer and halos need it whole, and say so.
#[test]
fn a_picture_larger_than_a_buffer() {
    let Some(whole) = gpu() else { return };
    // Seven rows of 64 pixels with four channels of four bytes.
    let bytes = 7 * 64 * 16;
    let small = |limits| wgpu::Limits { max_storage_buffer_binding_size: bytes, ..limits };
    let gpu = weaker(wgpu::Features::empty(), small);
    for samples in ["1", "2", "\"auto\""] {
        let job = job_of(&SCENE.replace("samples = 1", &format!("samples = {samples}")));
        assert_eq!(frame(&job, &gpu).unwrap(), frame(&job, &whole).unwrap(), "{samples}");
        let mut frames = GpuFrames::new(&job, &gpu).unwrap_or_else(|failure| panic!("{failure}"));
        let failure = frames.show().unwrap_err().to_string();
        assert!(failure.contains("the picture takes 49152 bytes"), "{failure}");
    }
    let failure = frame(&job("[[halo]]\n"), &gpu).unwrap_err();
    assert!(failure.contains(&format!("reads at most {bytes}")), "{failure}");
}

/// A device with the limits of WebGPU draws the same bits, or says which limit the scene exceeds.
#[test]
fn a_device_with_the_limits_of_a_browser() {
    let Some(whole) = gpu() else { return };
    let gpu = weaker(wgpu::Features::empty(), |_| wgpu::Limits::default());
    let object = "[[object]]\nname = \"part\"\nvalue = [[150, 0], [180, 1]]\nmove = [0, 2, 0]\n[object.ghost]\n";
    let ghosted = object.replace("move", "ghosting = 0.6\nfunnel = \"6 px\"\nmove");
    let styles = SCENE.replace("kind = \"regular\"\n", "").replace("color = \"#804020\"", "style = \"wax\"");
    let styles = styles.replace("color = \"#88ccff\"", "style = \"chalk\"").replace("[shading]\n", "");
    let mut texts =
        ["", "[surface]\niso = 150\n", "[sampling]\nkernel = \"bspline\"\n", object, &ghosted, "[[halo]]\n"]
            .map(|more| format!("{SCENE}{more}"))
            .to_vec();
    texts.push(SCENE.replace("samples = 1", "samples = \"auto\""));
    texts.push(format!("{styles}[contours]\n[style_mipmaps]\n"));
    texts.push(format!("{styles}[contours]\nkappa = \"exact\"\n[surface]\niso = 150\n"));
    let (mut drawn, mut refused) = (0, 0);
    for text in &texts {
        let job = job_of(text);
        match frame(&job, &gpu) {
            Ok(picture) => {
                drawn += 1;
                assert_eq!(picture, frame(&job, &whole).unwrap(), "{text}");
            }
            Err(failure) => {
                println!("{failure}");
                refused += 1;
                assert!(failure.contains("lists for a shader"), "{text}: {failure}");
            }
        }
    }
    // A funnel and a halo have more lists.
    assert_eq!([drawn, refused], [texts.len() - 2, 2]);
}
