//! Painting: 200 dabs into 256³ voxels, by their radius in voxels; a grown region and two basins of 128³ voxels; and
//! memberships between voxels beside values of a dense volume of the same positions.
//!
//! `cargo bench --bench painting`

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use drypoint::reference::field::{Field, Reconstruction, Rung, Sampler};
use drypoint::reference::number::Vec3;
use drypoint::reference::volumeshop::Memberships;
use drypoint::reference::volumeshop::painting::{Dab, Growth, Painter, Seed};
use drypoint::reference::with_sampler;
use drypoint::scene::glam::DVec3;
use drypoint::scene::phantom;
use drypoint::scene::tables::{Brush, Connectivity, PaintMode, PhantomSource};
use drypoint::scene::volume::{Selection, Volume, VoxelType};

fn main() {
    divan::main();
}

/// A torus, bright inside.
fn volume(size: usize) -> Volume {
    let source = PhantomSource {
        name: "torus".into(),
        size: [size; 3],
        spacing: [1.0; 3],
        voxel_type: VoxelType::U8,
        params: Vec::new(),
    };
    phantom::generate(&source).expect("the torus has defaults for every size")
}

/// Dabs along a spiral on a sphere, as a person paints an organ.
#[divan::bench(args = [5.0, 8.0, 16.0], sample_count = 15)]
fn dabs(bencher: Bencher, radius: f64) {
    let volume = volume(256);
    let painter = Painter::new(&volume, &|_| true);
    bencher.counter(ItemsCount::new(200usize)).bench_local(|| {
        let mut selection = Selection::nothing(&volume);
        for i in 0..200 {
            let (height, turn) = (-0.9 + 1.8 * f64::from(i) / 200.0, 0.7 * f64::from(i));
            let out = (1.0 - height * height).sqrt();
            let at = DVec3::splat(128.0) + 90.0 * DVec3::new(out * turn.cos(), out * turn.sin(), height);
            let dab = Dab { at, radius, brush: Brush::Gaussian, mode: PaintMode::Add };
            painter.dab(&mut selection, &dab).expect("a few bricks");
        }
        selection
    });
}

#[divan::bench(sample_count = 5)]
fn a_grown_region(bencher: Bencher) {
    let volume = volume(128);
    let painter = Painter::new(&volume, &|_| true);
    let growth = Growth { at: DVec3::ZERO, tolerance: 60.0, connect: Connectivity::Corners, mode: PaintMode::Add };
    bencher.bench_local(|| {
        let mut selection = Selection::nothing(&volume);
        painter.grow(&mut selection, &growth).expect("the corner is shown");
        selection
    });
}

#[divan::bench(sample_count = 5)]
fn two_basins(bencher: Bencher) {
    let volume = volume(128);
    let painter = Painter::new(&volume, &|_| true);
    let seeds = [[0.0; 3], [64.0; 3]].map(|at| Seed { at: at.into(), mode: PaintMode::Add });
    bencher.bench_local(|| {
        let mut selection = Selection::nothing(&volume);
        painter.watershed(&mut selection, &seeds).expect("all is shown");
        selection
    });
}

/// Positions every half voxel along oblique rays.
fn positions() -> Vec<DVec3> {
    let start = |r: usize| DVec3::new((r % 25) as f64 * 0.9 + 5.3, (r / 25) as f64 * 0.9 + 20.7, 1.3);
    let ray = |r| (0..200).map(move |k| start(r) + DVec3::new(0.25, 0.3, 0.31) * f64::from(k));
    (0..500).flat_map(ray).collect()
}

#[divan::bench]
fn memberships(bencher: Bencher) {
    let volume = volume(128);
    let selection = Selection::from_volume(&volume).expect("a few bricks");
    let (memberships, at) = (Memberships::<f64>::new(&selection.memberships), positions());
    bencher
        .counter(ItemsCount::new(at.len()))
        .bench_local(|| at.iter().fold(0.0, |sum, &p| sum + memberships.at(Vec3::from_glam(black_box(p)))));
}

#[divan::bench]
fn values(bencher: Bencher) {
    let volume = volume(128);
    let field = Field::<f64>::new(&volume, Reconstruction::default(), Rung::Value).expect("trilinear has no limits");
    let at = positions();
    bencher.counter(ItemsCount::new(at.len())).bench_local(|| {
        with_sampler!(field, |s| at.iter().fold(0.0, |sum, &p| sum + s.value(black_box(Vec3::from_glam(p)))))
    });
}
