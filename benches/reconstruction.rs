//! Samples a second by kernel and estimator: values, gradients and Hessians along coherent rays through 128³ voxels.
//!
//! `cargo bench --bench reconstruction`

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use drypoint::reference::field::{Field, GradientEstimator, HessianEstimator, Kernel, Reconstruction, Rung, Sampler};
use drypoint::reference::number::Vec3;
use drypoint::reference::with_sampler;
use drypoint::scene::phantom;
use drypoint::scene::tables::PhantomSource;
use drypoint::scene::volume::{Volume, VoxelType};
use std::sync::OnceLock;

fn main() {
    divan::main();
}

const SAMPLES: usize = 100_000;

/// A tangle of smooth edges, as 8-bit scans have them.
fn volume() -> &'static Volume {
    static VOLUME: OnceLock<Volume> = OnceLock::new();
    VOLUME.get_or_init(|| {
        let source = PhantomSource {
            name: "torus".into(),
            size: [128; 3],
            spacing: [1.0; 3],
            voxel_type: VoxelType::U8,
            params: Vec::new(),
        };
        phantom::generate(&source).expect("the torus has defaults for every size")
    })
}

/// Positions every half voxel along parallel, oblique rays, as a ray caster visits them.
fn positions() -> Vec<Vec3<f64>> {
    let rays = SAMPLES / 200;
    (0..rays)
        .flat_map(|r| {
            let start = Vec3::new((r % 25) as f64 * 0.9 + 5.3, (r / 25) as f64 * 0.9 + 20.7, 1.3);
            (0..200).map(move |k| start + Vec3::new(0.25, 0.3, 0.31) * f64::from(k))
        })
        .collect()
}

const KERNELS: [Kernel; 5] =
    [Kernel::Trilinear, Kernel::Bspline, Kernel::BsplineSmooth, Kernel::Bspline5, Kernel::CatmullRom];

fn field(how: Reconstruction, rung: Rung) -> Field<'static, f64> {
    Field::new(volume(), how, rung).expect("every estimator below fits its kernel")
}

#[divan::bench(args = KERNELS)]
fn value(bencher: Bencher, kernel: Kernel) {
    let field = field(Reconstruction { kernel, ..Reconstruction::default() }, Rung::Value);
    let at = positions();
    bencher
        .counter(ItemsCount::new(at.len()))
        .bench_local(|| with_sampler!(field, |s| at.iter().fold(0.0, |sum, &p| sum + s.value(black_box(p)))));
}

#[divan::bench(args = [GradientEstimator::Central, GradientEstimator::Analytic, GradientEstimator::Sobel, GradientEstimator::Regression])]
fn trilinear_gradient(bencher: Bencher, gradient: GradientEstimator) {
    gradients(bencher, Reconstruction { gradient, ..Reconstruction::default() });
}

#[divan::bench(args = KERNELS)]
fn analytic_gradient(bencher: Bencher, kernel: Kernel) {
    gradients(bencher, Reconstruction { kernel, gradient: GradientEstimator::Analytic, ..Reconstruction::default() });
}

fn gradients(bencher: Bencher, how: Reconstruction) {
    let field = field(how, Rung::Gradient);
    let at = positions();
    bencher
        .counter(ItemsCount::new(at.len()))
        .bench_local(|| with_sampler!(field, |s| at.iter().fold(0.0, |sum, &p| sum + s.gradient(black_box(p)).x)));
}

#[divan::bench(args = [HessianEstimator::Analytic, HessianEstimator::Central, HessianEstimator::Gaussian])]
fn bspline_hessian(bencher: Bencher, hessian: HessianEstimator) {
    let how = Reconstruction { kernel: Kernel::Bspline, hessian, ..Reconstruction::default() };
    let field = field(how, Rung::Hessian);
    let at = positions();
    bencher
        .counter(ItemsCount::new(at.len()))
        .bench_local(|| with_sampler!(field, |s| at.iter().fold(0.0, |sum, &p| sum + s.hessian(black_box(p)).1.xx)));
}
