//! A frame: 256³ voxels, 512×512 pixels of one ray, steps of half a voxel; unshaded, Phong, style, and style with contours; and the
//! same ray by ray and plane by plane, without lanes; and halos, over groups of 1, 2, 4 and 8 planes. Table 1 of Bruckner and
//! Gröller 2007 has 15.9, 26.3, 35.0 and 42.9 % of the frame rate without halos for these groups.
//!
//! `cargo bench --bench frame`

use divan::Bencher;
use drypoint::job::Job;
use drypoint::reference::ray::Renderer;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::phantom;
use drypoint::scene::tables::VolumeSource;
use drypoint::scene::volume::Volume;
use std::path::Path;
use std::sync::OnceLock;

fn main() {
    divan::main();
}

/// The phantom of the embedded scene, in styles or in colours of the same opacities.
const SCENE: &str = r##"
drypoint = 1
[volume]
phantom = { name = "specimen", size = 256 }
[camera]
direction = [-0.55, 1.0, -0.35]
fov = 18
[sampling]
step = "0.5 voxels"
"##;

const STYLES: &str = r##"
[transfer]
kind = "style"
nodes = [
  { at = 12, style = "glass", opacity = 0.0 },
  { at = 26, style = "glass", opacity = 0.05 },
  { at = 40, style = "glass", opacity = 0.0 },
  { at = 165, style = "bone", opacity = 0.0 },
  { at = 200, style = "bone", opacity = 0.9 },
]
"##;

const COLOURS: &str = r##"
[transfer]
kind = "regular"
nodes = [
  { at = 12, color = "#cde4ea", opacity = 0.0 },
  { at = 26, color = "#cde4ea", opacity = 0.05 },
  { at = 40, color = "#cde4ea", opacity = 0.0 },
  { at = 165, color = "#ece2cc", opacity = 0.0 },
  { at = 200, color = "#ece2cc", opacity = 0.9 },
]
"##;

/// The scene with effects, with one ray a pixel or other `samples`.
fn job(effects: &[&str], samples: &str) -> Job {
    let text = format!("{SCENE}[picture]\nsamples = {samples}\n{}", effects.concat());
    let scene = parse(&text, Path::new("bench.toml"), &Overrides::default()).expect("the scene above");
    // The phantom takes longer than a frame: it is made once.
    static VOLUME: OnceLock<Volume> = OnceLock::new();
    let VolumeSource::Phantom(source) = &scene.volume.source else { unreachable!("the scene above has a phantom") };
    let volume = VOLUME.get_or_init(|| phantom::generate(source).expect("the phantom"));
    Job::with_volume(scene, volume.clone()).expect("the scene above")
}

fn frame(bencher: Bencher, effects: &[&str]) {
    frame_in_order(bencher, effects, |renderer| renderer);
}

fn frame_in_order(bencher: Bencher, effects: &[&str], order: fn(Renderer<'_>) -> Renderer<'_>) {
    let job = job(effects, "1");
    let renderer = order(job.renderer().expect("the scene above"));
    bencher.bench_local(|| renderer.frame(&|_| ()));
}

#[divan::bench(sample_count = 15)]
fn unshaded(bencher: Bencher) {
    frame(bencher, &[COLOURS]);
}

#[divan::bench(sample_count = 15)]
fn phong(bencher: Bencher) {
    frame(bencher, &[COLOURS, "[shading]\n"]);
}

#[divan::bench(sample_count = 15)]
fn style(bencher: Bencher) {
    frame(bencher, &[STYLES]);
}

#[divan::bench(sample_count = 15)]
fn style_with_contours(bencher: Bencher) {
    frame(bencher, &[STYLES, "[contours]\n"]);
}

/// One ray a pixel, and 3×3 at edges.
#[divan::bench(sample_count = 15)]
fn style_with_contours_auto(bencher: Bencher) {
    let job = job(&[STYLES, "[contours]\n"], "\"auto\"");
    let renderer = job.renderer().expect("the scene above");
    bencher.bench_local(|| renderer.frame(&|_| ()));
}

#[divan::bench(sample_count = 15)]
fn unshaded_ray_by_ray(bencher: Bencher) {
    frame_in_order(bencher, &[COLOURS], |renderer| renderer.ray_by_ray());
}

#[divan::bench(sample_count = 15)]
fn unshaded_plane_by_plane(bencher: Bencher) {
    frame_in_order(bencher, &[COLOURS], |renderer| renderer.plane_by_plane());
}

#[divan::bench(sample_count = 15)]
fn phong_ray_by_ray(bencher: Bencher) {
    frame_in_order(bencher, &[COLOURS, "[shading]\n"], |renderer| renderer.ray_by_ray());
}

#[divan::bench(sample_count = 15)]
fn phong_plane_by_plane(bencher: Bencher) {
    frame_in_order(bencher, &[COLOURS, "[shading]\n"], |renderer| renderer.plane_by_plane());
}

#[divan::bench(sample_count = 15)]
fn style_with_contours_ray_by_ray(bencher: Bencher) {
    frame_in_order(bencher, &[STYLES, "[contours]\n"], |renderer| renderer.ray_by_ray());
}

#[divan::bench(sample_count = 15)]
fn style_with_contours_plane_by_plane(bencher: Bencher) {
    frame_in_order(bencher, &[STYLES, "[contours]\n"], |renderer| renderer.plane_by_plane());
}

/// A picture with so many halos. In one of M planes to a group, seeds are spread once a group.
fn halos(bencher: Bencher, count: usize, every: u64) {
    let halo = format!("[[halo]]\nseed.value = [[150, 0], [180, 1]]\nevery = {every}\n");
    frame(bencher, &[COLOURS, "[shading]\n", &halo.repeat(count)]);
}

#[divan::bench(args = [1, 2, 4, 8], sample_count = 15)]
fn phong_with_a_halo(bencher: Bencher, every: u64) {
    halos(bencher, 1, every);
}

#[divan::bench(sample_count = 15)]
fn phong_with_four_halos_over_groups_of_four(bencher: Bencher) {
    halos(bencher, 4, 4);
}
