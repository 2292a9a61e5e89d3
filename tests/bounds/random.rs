//! Random scenes: the picture of numbers with errors is the picture, and that in f32 is within their bounds.

use super::generator::scene;
use crate::common::{Shown, Stage};
use drypoint::reference::ray::bounds::{Bounds, BoundsError, RayOrigin};
use drypoint::scene::picture::LayerKind;
use drypoint::scene::tables::{
    GradientEstimator, GradientRange, HessianEstimator, Kernel, Number, RaysPerPixel, Table,
};

/// A random scene without what has no bounds.
fn bounded(seed: u64) -> Stage {
    scene(seed).with(|s| {
        s.sampling.number = Number::F64;
        s.picture.layers = vec![LayerKind::Beauty];
        if s.picture.samples == RaysPerPixel::Auto {
            s.picture.samples = RaysPerPixel::Across(2);
        }
        if !s.clips.is_empty() || s.sampling.kernel != Kernel::Trilinear {
            s.surface = None;
        }
        s.halos.clear();
        if let Some(transfer) = &mut s.transfer {
            transfer.table = Table::Exact;
        }
    })
}

/// The bounds; none of a function over a volume that lies elsewhere.
fn known(stage: &Stage, origin: RayOrigin) -> Option<Bounds> {
    match stage.bounds(origin) {
        Err(BoundsError::Unknown { what }) if what.contains("further volume") => None,
        bounds => Some(bounds.unwrap()),
    }
}

/// Every number of a picture's beauty, pixel by pixel.
fn numbers(shown: &Shown) -> Vec<f64> {
    shown.pixels().into_iter().flatten().collect()
}

fn beauty(bounds: &Bounds) -> [Vec<f64>; 2] {
    [&bounds.values, &bounds.errors].map(|picture| {
        let channels = &picture.layer(LayerKind::Beauty).unwrap().channels;
        (0..channels[0].len()).flat_map(|i| [0, 1, 2, 3].map(|c: usize| channels[c][i])).collect()
    })
}

#[test]
fn the_values_are_the_picture_bit_for_bit() {
    let (mut shown_something, mut pixels, mut undecided) = (0, 0, 0);
    for seed in 0..400 {
        let stage = bounded(seed);
        let Some(bounds) = known(&stage, RayOrigin::Middle) else { continue };
        let [values, errors] = beauty(&bounds);
        let picture = numbers(&stage.render());
        let bits = |numbers: &[f64]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&values), bits(&picture), "seed {seed}: {:?}", stage.scene);
        assert!(errors.iter().all(|&error| error >= 0.0), "seed {seed}");
        shown_something += usize::from(picture.iter().any(|&c| c != 0.0));
        pixels += bounds.undecided.len();
        undecided += bounds.undecided.iter().flatten().count();
    }
    assert!(shown_something > 120, "{shown_something}");
    println!("undecided: {undecided} of {pixels}");
}

#[test]
fn pictures_in_f32_are_within_the_bounds() {
    let (mut compared, mut undecided, mut pixels) = (0, 0, 0);
    for seed in 400..2000 {
        // The reference makes coefficients in f32, a renderer takes those of the reference.
        let stage = bounded(seed);
        let [lo, hi] = stage.volume.range();
        let stage = stage.with(|s| {
            // So is a quantile of gradients.
            s.volume.gradient_range = GradientRange::Fixed([0.0, (hi - lo).max(1.0)]);
            if matches!(s.sampling.kernel, Kernel::Bspline | Kernel::Bspline5) {
                s.sampling.kernel = Kernel::BsplineSmooth;
            }
            if s.sampling.gradient == GradientEstimator::Regression {
                s.sampling.gradient = GradientEstimator::Central;
            }
            if s.sampling.hessian == HessianEstimator::Gaussian {
                s.sampling.hessian = HessianEstimator::Auto;
            }
        });
        let Some(bounds) = known(&stage, RayOrigin::Eye) else { continue };
        let [values, errors] = beauty(&bounds);
        let single = numbers(&stage.in_number(Number::F32).render());
        for (i, (&x, (&value, &error))) in single.iter().zip(values.iter().zip(&errors)).enumerate() {
            if bounds.undecided[i / 4].is_none() {
                compared += 1;
                assert!(
                    (x - value).abs() <= error,
                    "seed {seed}, pixel {}, channel {}: {x} {value} ± {error:e}, off by {:e}\n{:?} {:?}",
                    i / 4,
                    i % 4,
                    (x - value).abs(),
                    stage.scene,
                    stage.volume.grid()
                );
            }
        }
        pixels += bounds.undecided.len();
        undecided += bounds.undecided.iter().flatten().count();
    }
    println!("undecided: {undecided} of {pixels}; compared {compared}");
    assert!(compared > 50_000, "{compared}");
}
