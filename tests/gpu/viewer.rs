//! Frames in a viewer's texture, and those whose values the texture unit interpolates.

use crate::gpu;
use drypoint::frames::Frames;
use drypoint::gpu::{GpuFrames, GpuJob, Interpolation, Precision, wgpu};
use drypoint::job::Job;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::picture::{LayerKind, Picture};
use drypoint::scene::volume::Voxels;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};

/// A scene of which every voxel can be seen, so that first samples are those of the box.
const SCENE: &str = r##"
drypoint = 1
[volume]
phantom = { name = "torus", size = 21 }
[picture]
size = [67, 50]
samples = 1
background = "#203040"
layers = ["first", "beauty"]
[transfer]
kind = "regular"
nodes = [{ at = 0, color = "#804020", opacity = 0.05 }, { at = 128, color = "#ffcc88", opacity = 0.3 },
         { at = 140, color = "#88ccff", opacity = 0.9 }]
[shading]
"##;

fn job(text: &str) -> Job {
    let scene = parse(text, "scene.toml".as_ref(), &Overrides::default()).unwrap_or_else(|faults| panic!("{faults}"));
    Job::load(scene).unwrap_or_else(|failures| panic!("{failures}"))
}

/// The number of 16 bits: a sign, five bits of an exponent, ten of a fraction.
fn half(bits: u16) -> f64 {
    let fraction = f64::from(bits & 0x3ff) / 1024.0;
    let size = match (bits >> 10) & 0x1f {
        0 => fraction / 16384.0,
        exponent => (1.0 + fraction) * 2f64.powi(i32::from(exponent) - 15),
    };
    if bits >> 15 == 1 { -size } else { size }
}

/// Texels of a texture, four channels each.
fn texels(gpu: &drypoint::gpu::Gpu, texture: &wgpu::Texture) -> Vec<[f64; 4]> {
    let [width, height] = [texture.width(), texture.height()];
    let bytes_per_row = (width * 8).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = gpu.device().create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(bytes_per_row * height),
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let mut encoder = gpu.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.copy_texture_to_buffer(
        texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout: wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(bytes_per_row), rows_per_image: None },
        },
        texture.size(),
    );
    gpu.queue().submit([encoder.finish()]);
    buffer.slice(..).map_async(wgpu::MapMode::Read, |result| result.unwrap());
    gpu.wait().unwrap();
    let bytes = buffer.slice(..).get_mapped_range().unwrap().to_vec();
    let row = |y: u32| &bytes[(y * bytes_per_row) as usize..][..8 * width as usize];
    let number = |pair: &[u8; 2]| half(u16::from_le_bytes(*pair));
    (0..height)
        .flat_map(|y| row(y).as_chunks::<8>().0.iter().map(|t| [0, 2, 4, 6].map(|c| number(&[t[c], t[c + 1]]))))
        .collect()
}

/// A viewer's texture holds the beauty to the last place of its 16 bits, with one ray a pixel and with more, and with layers
/// beside it.
#[test]
fn a_viewer_sees_the_picture() {
    let Some(gpu) = gpu() else { return };
    for samples in ["1", "2", "\"auto\""] {
        let job = job(&SCENE.replace("samples = 1", &format!("samples = {samples}")));
        let mut frames = GpuFrames::new(&job, &gpu).unwrap_or_else(|failure| panic!("{failure}"));
        let (picture, _) = frames.frame(&|_| ()).unwrap_or_else(|failure| panic!("{failure}"));
        let seconds = frames.show().unwrap_or_else(|failure| panic!("{failure}"));
        assert!(seconds.is_none_or(|seconds| seconds > 0.0 && seconds < 60.0), "{seconds:?}");
        let shown = texels(&gpu, frames.shown().unwrap());
        let beauty = &picture.layer(LayerKind::Beauty).unwrap().channels;
        assert_eq!(shown.len(), beauty[0].len());
        for (i, texel) in shown.iter().enumerate() {
            for (c, &shown) in texel.iter().enumerate() {
                let drawn = beauty[c][i];
                assert!((shown - drawn).abs() <= drawn.abs() / 1024.0 + 1e-7, "pixel {i}: {shown} and {drawn}");
            }
        }
    }
}

/// A scene of everything that a user turns in a viewer.
const TURNED: &str = r##"
drypoint = 1
[volume]
phantom = { name = "torus", size = 21 }
[picture]
size = [37, 30]
samples = 1
background = "#203040"
layers = ["beauty"]
[camera]
direction = [1, 2, 3]
[transfer]
kind = "regular"
nodes = [{ at = 0, color = "#804020", opacity = 0.05 }, { at = 140, color = "#88ccff", opacity = 0.9 }]
[shading]
[[clip]]
normal = [-1, 0, 0]
point = [2, 0, 0]
"##;

/// After a change frames are those of the changed scene, bit for bit, in pictures and in the viewer's texture. What a user drags
/// compiles nothing: camera, light, nodes, clip planes, objects.
#[test]
fn a_changed_scene_is_drawn_as_if_it_were_new() {
    let Some(gpu) = gpu() else { return };
    let halo = "[[halo]]\nseed.value = [[150, 0], [180, 1]]\n";
    let object = "[[object]]\nname = \"part\"\nvalue = [[150, 0], [180, 1]]\nmove = [0, 2, 0]\n[object.ghost]\n";
    let table = "model = \"lighting-function\"\nlight = { world = [1, 2, 3] }\n";
    let styles = "[style_mipmaps]\n";
    // Tables after the scene's, a text and what it is changed to, whether pipelines stay.
    let edits = [
        ("", "direction = [1, 2, 3]", "direction = [3, -2, 1]", true),
        ("", "#88ccff", "#ff0000", true),
        ("", "at = 140", "at = 150.5", true),
        ("", "opacity = 0.9", "opacity = 0.4", true),
        ("", "point = [2, 0, 0]", "point = [4, 0, 0]", true),
        ("", "normal = [-1, 0, 0]", "normal = [-1, 1, 0]", true),
        ("", "[shading]", "[shading]\nlight = [1, 0, 0]\nspecular = 0.1", true),
        ("", "#203040", "#ffffff", true),
        ("", "[shading]", "[shading]\nmodel = \"toon\"", false),
        ("", "size = [37, 30]", "size = [20, 41]", true),
        ("", "samples = 1", "samples = \"auto\"", false),
        ("", "[shading]", "[sampling]\nkernel = \"bspline\"\n[shading]", false),
        (table, "direction = [1, 2, 3]", "direction = [3, -2, 1]", true),
        (styles, "direction = [1, 2, 3]", "direction = [1, 2, 3]\nfov = 12", true),
        (halo, "[[150, 0], [180, 1]]", "[[120, 0], [160, 1]]", true),
        (halo, "size = [37, 30]", "size = [20, 41]", true),
        (halo, "[[halo]]", "[[halo]]\nevery = 4\nspread.passes = 6", true),
        (object, "move = [0, 2, 0]", "move = [0, 3, 0]", true),
    ];
    for (tables, from, to, stays) in edits {
        let base = match tables {
            _ if tables == table => TURNED.replace("[shading]\n", &format!("[shading]\n{table}")),
            _ if tables == styles => {
                let nodes = "nodes = [{ at = 0, style = \"glass\", opacity = 0.05 }, { at = 140, style = \"bone\", opacity = 0.9 }]";
                let kept = |line: &&str| !line.starts_with("kind") && !line.starts_with("[shading]");
                let line = |line| if str::starts_with(line, "nodes") { nodes } else { line };
                TURNED.lines().filter(kept).map(line).collect::<Vec<_>>().join("\n") + "\n" + styles
            }
            tables => format!("{TURNED}{tables}"),
        };
        let first = job(&base);
        let changed = base.replacen(from, to, 1);
        assert_ne!(changed, base);
        let scene = parse(&changed, "scene.toml".as_ref(), &Overrides::default()).unwrap_or_else(|f| panic!("{f}"));
        let second = Job::with_volume(scene, first.volume.clone()).unwrap_or_else(|failures| panic!("{failures}"));
        let mut frames = GpuFrames::new(&first, &gpu).unwrap_or_else(|failure| panic!("{failure}"));
        let draw = |frames: &mut GpuFrames| {
            frames.show().unwrap_or_else(|failure| panic!("{failure}"));
            let shown = texels(&gpu, frames.shown().unwrap());
            (frames.frame(&|_| ()).unwrap_or_else(|failure| panic!("{failure}")).0, shown)
        };
        let fresh = [&first, &second].map(|job| draw(&mut GpuFrames::new(job, &gpu).unwrap()));
        assert!(fresh[0].0 != fresh[1].0, "the change is not seen: {changed}");
        draw(&mut frames);
        for (job, fresh) in [(&second, &fresh[1]), (&first, &fresh[0])] {
            let compiled = gpu.pipelines();
            frames.change(job).unwrap_or_else(|failure| panic!("{failure}"));
            assert_eq!(gpu.pipelines() == compiled, stays, "{} pipelines: {changed}", gpu.pipelines() - compiled);
            assert!(draw(&mut frames) == *fresh, "{changed}");
        }
    }
}

/// A coarse frame is that of the scene with its size and one ray a pixel, bit for bit, and so is the exact one after it. No
/// pipeline is compiled.
#[test]
fn a_coarse_frame_is_the_scene_in_its_size() {
    let Some(gpu) = gpu() else { return };
    let object =
        "[[object]]\nname = \"part\"\nvalue = [[150, 0], [180, 1]]\nmove = [0, 2, 0]\nghosting = 0.5\n[object.ghost]\n";
    let halo = "[[halo]]\nseed.value = [[150, 0], [180, 1]]\nkind = \"emissive\"\n";
    // A reach that takes fewer passes, and fewer dispatches, in a smaller picture.
    let far = "[[halo]]\nevery = 3\nspread = { passes = 5, reach = \"60 %\" }\n";
    for (samples, tables) in
        [("2", "[surface]\niso = 150\n"), ("\"auto\"", object), ("1", halo), ("\"auto\"", &format!("{halo}{far}"))]
    {
        let text = format!("{SCENE}{tables}").replace("samples = 1", &format!("samples = {samples}"));
        let small = text.replace("[67, 50]", "[23, 17]").replace(&format!("samples = {samples}"), "samples = 1");
        let [exact, small] = [&text, &small].map(|text| job(text));
        let draw = |frames: &mut GpuFrames| {
            frames.show().unwrap_or_else(|failure| panic!("{failure}"));
            let shown = texels(&gpu, frames.shown().unwrap());
            (frames.frame(&|_| ()).unwrap_or_else(|failure| panic!("{failure}")).0, shown)
        };
        let fresh = [&exact, &small].map(|job| draw(&mut GpuFrames::new(job, &gpu).unwrap()));
        let mut frames = GpuFrames::new(&exact, &gpu).unwrap_or_else(|failure| panic!("{failure}"));
        frames.show().unwrap();
        let compiled = gpu.pipelines();
        let shots = [exact.shot().unwrap(), exact.coarse_shot(NonZeroUsize::new(3).unwrap()).unwrap()];
        for (shot, fresh) in [1, 0, 1, 0].map(|i| (&shots[i], &fresh[i])) {
            frames.turn(shot).unwrap_or_else(|failure| panic!("{failure}"));
            assert!(draw(&mut frames) == *fresh, "{samples}: {tables}");
        }
        assert_eq!(gpu.pipelines(), compiled, "{samples}: {tables}");
    }
}

/// Maps of funnels have one size: the shot of a coarse frame is refused, and changes nothing.
#[test]
fn a_coarse_frame_with_funnels_is_refused() {
    let Some(gpu) = gpu() else { return };
    let part = "[[object]]\nname = \"part\"\nvalue = [[150, 0], [180, 1]]\nmove = [0, 2, 0]\nghosting = 0.6\nfunnel = \"6 px\"\n";
    let job = job(&format!("{SCENE}{part}[object.ghost]\n"));
    let mut frames = GpuFrames::new(&job, &gpu).unwrap_or_else(|failure| panic!("{failure}"));
    let whole = frames.frame(&|_| ()).unwrap_or_else(|failure| panic!("{failure}")).0;
    let failure = frames.turn(&job.coarse_shot(NonZeroUsize::new(2).unwrap()).unwrap()).unwrap_err().to_string();
    assert!(failure.contains("have one size on a graphics card"), "{failure}");
    assert_eq!(frames.frame(&|_| ()).unwrap().0, whole);
}

/// A frame that is stopped before it begins, or between its passes, has no picture, and the next one is whole.
#[test]
fn a_stopped_frame_has_no_picture() {
    let Some(gpu) = gpu() else { return };
    for (table, last) in [("", 0.5), ("[[halo]]\nseed.value = [[150, 0], [180, 1]]\n", 0.0)] {
        let job = job(&format!("{}{table}", TURNED.replace("samples = 1", "samples = \"auto\"")));
        let mut frames = GpuFrames::new(&job, &gpu).unwrap_or_else(|failure| panic!("{failure}"));
        let whole = frames.frame(&|_| ()).unwrap_or_else(|failure| panic!("{failure}")).0;
        let stop = AtomicBool::new(last == 0.0);
        let stopped = frames.frame_until(&|share| stop.store(share >= last, Ordering::Relaxed), &stop).unwrap();
        assert!(stopped.is_none() && stop.into_inner());
        assert_eq!(frames.frame(&|_| ()).unwrap().0, whole);
    }
}

fn drawn(job: &Job, gpu: &drypoint::gpu::Gpu, edit: &dyn Fn(String) -> String) -> Picture {
    let job = GpuJob::new(job, gpu, Precision::Single).unwrap_or_else(|failure| panic!("{failure}"));
    let mut renderer = job.edited(edit).unwrap_or_else(|failure| panic!("{failure}"));
    renderer.frame(&|_| ()).unwrap_or_else(|error| panic!("{error}"))
}

/// The largest difference of the first values of rays.
fn apart(a: &Picture, b: &Picture) -> f64 {
    let values = |picture: &Picture| picture.layer(LayerKind::First).unwrap().channels[0].clone();
    values(a).iter().zip(&values(b)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Values that the texture unit interpolates are off by no more than weights of 8 bits explain: three axes, each with a weight
/// that is off by 2⁻⁸ at most, of the largest difference between neighbours. Half a voxel aside is more.
#[test]
fn the_texture_unit_keeps_its_bound() {
    let Some(gpu) = gpu() else { return };
    let Ok(fast) = gpu.interpolating(Interpolation::Fast) else {
        println!("skipped: no texture unit for f32");
        return;
    };
    let job = job(SCENE);
    let Voxels::U8(voxels) = job.volume.voxels() else { panic!("the phantom has bytes") };
    let [x, y, z] = job.volume.grid().dims();
    let at = |i: usize, j: usize, k: usize| f64::from(voxels[(k * y + j) * x + i]);
    let mut steepest: f64 = 0.0;
    for (k, j, i) in (0..z - 1).flat_map(|k| (0..y - 1).flat_map(move |j| (0..x - 1).map(move |i| (k, j, i)))) {
        let own = at(i, j, k);
        for next in [at(i + 1, j, k), at(i, j + 1, k), at(i, j, k + 1)] {
            steepest = steepest.max((next - own).abs());
        }
    }
    let bound = 3.0 * steepest / 256.0;
    let exact = drawn(&job, &gpu, &|text| text);
    let by_unit = apart(&exact, &drawn(&job, &fast, &|text| text));
    println!("values off by {by_unit:.3}, bound {bound:.3}");
    assert!(by_unit <= bound, "{by_unit} of {bound}");
    let shifted = |text: String| {
        assert!(text.contains("(f32(pad) + 0.5)"));
        text.replace("(f32(pad) + 0.5)", "f32(pad)")
    };
    let off = apart(&exact, &drawn(&job, &fast, &shifted));
    assert!(off > bound, "half a voxel is not noticed: {off} of {bound}");
}
