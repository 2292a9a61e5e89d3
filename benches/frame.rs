//! A frame: 256³ voxels, 512×512 pixels of one ray, steps of half a voxel; unshaded, Phong, style, and style with contours; and the
//! same ray by ray and plane by plane, without lanes; and halos, over groups of 1, 2, 4 and 8 planes. Table 1 of Bruckner and
//! Gröller 2007 has 15.9, 26.3, 35.0 and 42.9 % of the frame rate without halos for these groups.
//!
//! `cargo bench --bench frame`

mod specimen;

use divan::Bencher;
use drypoint::reference::ray::Renderer;
use specimen::{COLOURS, STYLES, job};

fn main() {
    divan::main();
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

/// One ray a pixel, and five or nine at edges.
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
