//! Stippling: the preprocess of a 256³ volume and the points of its faces, with how even they are ([STIP-18]), a frame of
//! them, and dots chosen on the page.

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use drypoint::reference::volume_stippling::{DotCandidate, FrameDots, FrameInputs, Frames, Preprocess, eliminate};
use drypoint::scene::counts::Counts;
use drypoint::scene::glam::{DVec2, DVec3, IVec3};
use drypoint::scene::marks::Page;
use drypoint::scene::philox;
use drypoint::scene::points::Points;
use drypoint::scene::shot::StippleParams;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{Boundary, Camera, PointsPerPixel, Scene, Silhouette, Stipples, Threshold, VolumeSource};
use drypoint::scene::view::View;
use drypoint::scene::volume::{Volume, Voxels};
use std::collections::HashMap;

fn main() {
    divan::main();
    // `cargo test` runs benches without it, to see that they work.
    if std::env::args().any(|argument| argument == "--bench") {
        for count in COUNTS {
            let volume = ball(count);
            let made = points(&params(&volume), &volume);
            let even = [1, 2, 4, 8, 16].map(|k| format!("{:.3}", evenness(&made, k, radius(count))));
            println!(
                "{} points, mean nearest distance × √density of the first 1, 2, 4, 8, 16: {}",
                made.len(),
                even.join(" ")
            );
        }
    }
}

/// How many points are made.
const COUNTS: [f64; 2] = [500_000.0, 2_000_000.0];

/// Of a ball whose face, 25 points a voxel, has about so many points.
fn radius(points: f64) -> f64 {
    (points / 25.0 / (4.0 * std::f64::consts::PI)).sqrt()
}

/// The mean distance of the first `k` points of each voxel to the nearest other, all moved onto the ball's face, times
/// √density: 0.5 of white noise, 0.87 of a maximal Poisson disc.
fn evenness(points: &Points, k: usize, radius: f64) -> f64 {
    let on_face = |at: DVec3| 127.5 + radius * (at - 127.5).normalize();
    let of = |i: usize| {
        let centre = points.voxels[i].centre();
        points.of(i)[..k].iter().map(move |o| on_face(centre + DVec3::from_array(o.map(f64::from))))
    };
    let all: Vec<DVec3> = (0..points.voxels.len()).flat_map(of).collect();
    let density = all.len() as f64 / (4.0 * std::f64::consts::PI * radius * radius);
    let cell = |p: DVec3| (p * density.sqrt() / 2.0).as_ivec3();
    let mut cells: HashMap<IVec3, Vec<DVec3>> = HashMap::new();
    for &p in &all {
        cells.entry(cell(p)).or_default().push(p);
    }
    let around = |p: DVec3| (0..27).map(move |i| cell(p) + IVec3::new(i % 3, i / 3 % 3, i / 9) - 1);
    let nearest = |&p: &DVec3| {
        let near = around(p).filter_map(|c| cells.get(&c)).flatten().filter(|q| **q != p);
        near.map(|q| q.distance(p)).fold(f64::INFINITY, f64::min)
    };
    all.iter().map(nearest).sum::<f64>() / all.len() as f64 * density.sqrt()
}

/// A ball whose face is so large that, 25 points a voxel, it has about this many.
fn ball(points: f64) -> Volume {
    const SIDE: usize = 256;
    let radius = radius(points);
    let value = |i: usize| {
        let p = DVec3::new((i % SIDE) as f64, (i / SIDE % SIDE) as f64, (i / SIDE / SIDE) as f64);
        (100.0 + 60.0 * (radius - (p - 127.5).length())).clamp(0.0, 200.0) as u8
    };
    let voxels = Voxels::U8((0..SIDE * SIDE * SIDE).map(value).collect());
    Volume::new(Grid::with_spacing([SIDE; 3], [1.0; 3]).unwrap(), voxels, 1.0, 0.0).unwrap()
}

fn stipples() -> Stipples {
    Stipples {
        threshold: Threshold::Magnitude(0.3),
        thin: true,
        boundary: Some(Boundary::default()),
        silhouette: Some(Silhouette::default()),
        ..Stipples::default()
    }
}

/// Returns parameters that make 25 points a voxel.
fn params(volume: &Volume) -> StippleParams {
    let view = View::new(&Camera::default(), volume.grid(), [1000, 1000]).unwrap();
    let scene = Scene::for_volume(VolumeSource::File { path: "ball.nrrd".into(), raw: None });
    let made = StippleParams::new(&scene, &stipples(), volume.grid(), view).unwrap();
    let made = StippleParams { near: 0.5, square: 0.3, ..made };
    let area = Preprocess::new(made.clone(), volume, None).unwrap().area;
    StippleParams { k_max: PointsPerPixel::Number(25.0 * 65_536.0 / area), ..made }
}

fn points(params: &StippleParams, volume: &Volume) -> Points {
    let preprocess = Preprocess::new(params.clone(), volume, None).unwrap();
    preprocess.points(&mut Counts::default(), &|_| {}).unwrap()
}

#[divan::bench(args = COUNTS, sample_count = 3, sample_size = 1)]
fn preprocess_and_points(bencher: Bencher<'_, '_>, count: f64) {
    let volume = ball(count);
    let params = params(&volume);
    bencher.bench_local(|| black_box(points(&params, &volume)).len());
}

/// White noise of which a quarter is kept, on one page.
#[divan::bench(args = [200_000, 2_000_000], sample_count = 3, sample_size = 1)]
fn sample_elimination(bencher: Bencher<'_, '_>, count: u32) {
    let candidate = |i: u32| {
        let [x, y, ..] = philox::uniforms(1, [i, 0, 0], 0);
        DotCandidate { at: 150.0 * DVec2::new(x, y), share: 0.25 }
    };
    let candidates: Vec<DotCandidate> = (0..count).map(candidate).collect();
    bencher.counter(ItemsCount::new(count)).bench_local(|| eliminate(black_box(&candidates)).len());
}

#[divan::bench(sample_count = 20)]
fn frame_of_two_millions(bencher: Bencher<'_, '_>) {
    let volume = ball(2e6);
    let params = params(&volume);
    let (points, grid, view) = (points(&params, &volume), volume.grid(), params.view.clone());
    let stipples = StippleParams { size: 0.35, ..params };
    let frames = Frames::new(FrameInputs { stipples, points: &points, grid, nib: None, surface: None, tone: None });
    let (page, mut drawn) = (Page::in_pixels(view.size, 0.0, 300.0), FrameDots::default());
    bencher.bench_local(|| {
        frames.draw(&view, &page, &mut drawn);
        drawn.len()
    });
}
