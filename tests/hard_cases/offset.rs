//! Data with an offset ([PREC-3], [REC-1]): rounding must not shade what is constant, and whole numbers lose nothing.

use crate::common::strip::ramp;
use crate::common::{LAYERS, Stage, on, perspective, plain, volume};
use crate::stability::{Case, Theme, differing};
use drypoint::scene::glam::DVec3;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{
    Contours, GradientEstimator, GradientRange, HessianEstimator, Kappa, Kernel, Number, Shading,
};
use drypoint::scene::volume::{Volume, Voxels};

pub(crate) static THEME: Theme = Theme::new(
    "Data with an offset",
    &[
        Case {
            name: "a constant at 1000.3, 10⁶ + 0.1, −1024.7",
            breaks: "rounding becomes a normal: speckle in flat regions; the value moves across a step at it",
            done: "sums of differences, a + w(b − a), and a bound below which there is no normal [PREC-3]",
            of: "samples with a normal, and pixels of another colour; 5 kernels, 4 gradients, f64 and f32",
            bound: 0.0,
            why: "differences of equal numbers are 0, and 0 is below the bound",
            measure: constants,
        },
        Case {
            name: "2^k added to whole numbers, k = 10, 20, 30",
            breaks: "Hounsfield units around 1000 lose digits in derivatives",
            done: "numbers are read as stored, the offset never enters a difference",
            of: "numbers with another bit in depth, normals, gradients, curvatures; 5 kernels, 4 estimators",
            bound: 0.0,
            why: "differences of whole numbers are exact",
            measure: whole_numbers,
        },
        Case {
            name: "values up to 10^±300",
            breaks: "squares overflow or vanish",
            done: "scaling by a power of two [SPACE-4]",
            of: "numbers with another bit than at 1; shaded, with normals and curvatures",
            bound: 0.0,
            why: "a power of two changes no mantissa",
            measure: ends_of_the_number_type,
        },
    ],
);

#[test]
fn data_with_an_offset() {
    THEME.hold();
}

const KERNELS: [Kernel; 5] =
    [Kernel::Trilinear, Kernel::Bspline, Kernel::BsplineSmooth, Kernel::Bspline5, Kernel::CatmullRom];
const GRADIENTS: [GradientEstimator; 4] =
    [GradientEstimator::Central, GradientEstimator::Analytic, GradientEstimator::Sobel, GradientEstimator::Regression];

/// No reconstruction of a constant makes a normal or moves the value across a step at that value: the picture of a box
/// seen along an axis is one colour, and all samples are without a normal.
fn constants() -> f64 {
    let mut wrong = 0.0;
    for value in [1000.3, 1e6 + 0.1, -1024.7] {
        for (number, single) in [(Number::F64, false), (Number::F32, false), (Number::F32, true), (Number::F64, true)] {
            let stored = if single { f64::from(value as f32) } else { value };
            let grid = Grid::with_spacing([7, 9, 7], [1.0, 0.7, 1.3]).unwrap();
            let voxels = if single { Voxels::F32(vec![value as f32; 441]) } else { Voxels::F64(vec![value; 441]) };
            let flat = Volume::new(grid, voxels, 1.0, 0.0).unwrap();
            // Visible from the value itself on.
            let nodes = [(stored, "ramp", 0.0), (stored, "ramp", 0.3)];
            for kernel in KERNELS {
                for gradient in GRADIENTS {
                    let shot = Stage::styled(flat.clone(), vec![ramp()], &nodes).layers(&LAYERS).with(|s| {
                        (s.sampling.kernel, s.sampling.gradient, s.sampling.number) = (kernel, gradient, number);
                        s.contours = Some(Contours { kappa: Kappa::Exact, ..Contours::default() });
                        s.volume.gradient_range = GradientRange::Quantile(0.999);
                        s.camera.projection = crate::common::orthographic(Some(6.0)).projection;
                        s.picture.size = [5, 5];
                    });
                    let shown = shot.render();
                    let pixels = shown.pixels();
                    let place = format!("{value} {number:?} {kernel:?} {gradient:?}");
                    assert!(pixels[0][3] > 0.5, "{place}: {:?}", pixels[0]);
                    assert!(shown.counts.gradients > 0, "{place}");
                    wrong += pixels.iter().filter(|p| **p != pixels[0]).count() as f64;
                    wrong += (shown.counts.gradients - shown.counts.without_normal + shown.counts.hessians) as f64;
                    // N = v: the middle of the style.
                    assert!((pixels[0][0] / pixels[0][3] - 0.5).abs() < 1e-6, "{place}");
                }
            }
        }
    }
    wrong
}

/// A thing with a constant inside at 1000.3: in the inside lit and style pictures have no normal and no speckle, on the
/// rim they have one.
#[test]
fn flat_insides_of_offset_data_have_no_normal() {
    let centre = DVec3::splat(9.5);
    let thing = volume([20; 3], |p| 1000.3 + (3.0 * (8.0 - (p - centre).length())).clamp(-5.0, 3.0));
    let shot = Stage::regular(thing, &[(1000.0, [0.3; 3], 0.0), (1003.0, [0.9; 3], 0.2)]).with(|s| {
        s.shading = Some(Shading::default());
    });
    let c = shot.render().counts;
    assert!(c.without_normal > 200 && c.without_normal < c.gradients, "{} {}", c.without_normal, c.gradients);
    // A kernel's own rounding is under the bound too.
    for kernel in KERNELS {
        let spline = shot.with(|s| {
            (s.sampling.kernel, s.sampling.gradient) = (kernel, GradientEstimator::Sobel);
        });
        assert!(spline.render().counts.without_normal > 200, "{kernel:?}");
    }
}

/// f + 2^k on whole numbers: the same gradients, normals and κ, bit for bit; values within an ulp of 2^k. Opaque, so that
/// the layers are those of one sample, seen on the same plane.
fn whole_numbers() -> f64 {
    let mut differ = 0.0;
    let grid = Grid::with_spacing([12, 10, 11], [1.0, 1.3, 0.9]).unwrap();
    let base: Vec<i64> = crate::common::positions(&grid)
        .map(|p| (100.0 + 60.0 * (0.6 * p.x).sin() + 50.0 * (0.5 * p.y).cos() + 30.0 * (0.7 * p.z).sin()) as i64)
        .collect();
    for kernel in KERNELS {
        for (gradient, hessian) in [
            (GradientEstimator::Central, HessianEstimator::Auto),
            (GradientEstimator::Analytic, HessianEstimator::Central),
            (GradientEstimator::Sobel, HessianEstimator::Gaussian),
            (GradientEstimator::Regression, HessianEstimator::Central),
        ] {
            let seen = |offset: i64, by_intercept: bool| {
                let (stored, intercept) = if by_intercept { (0, offset as f64) } else { (offset, 0.0) };
                let voxels = Voxels::I32(base.iter().map(|v| (v + stored) as i32).collect());
                let volume = Volume::new(grid.clone(), voxels, 1.0, intercept).unwrap();
                let step = 120.3 + offset as f64;
                let nodes = [(step, "s", 0.0), (step, "s", 1.0)];
                let shot = Stage::styled(volume, vec![plain("s", [0.5, 0.5, 0.5, 1.0])], &nodes).layers(&LAYERS);
                shot.with(|s| {
                    s.camera = perspective(35.0);
                    s.camera.direction = DVec3::new(0.4, 0.8, -0.5);
                    (s.sampling.kernel, s.sampling.gradient, s.sampling.hessian) = (kernel, gradient, hessian);
                    s.contours = Some(Contours { kappa: Kappa::Exact, ..Contours::default() });
                })
                .render()
            };
            let plain = seen(0, false);
            assert!(plain.covered() > 40);
            for (k, by_intercept) in [(10, false), (20, false), (30, false), (20, true)] {
                let moved = seen(1 << k, by_intercept);
                let place = format!("{kernel:?} {gradient:?} {hessian:?} 2^{k}");
                for kind in [LayerKind::Z, LayerKind::Normal, LayerKind::Gradient, LayerKind::Curvature] {
                    differ += differing(&plain.layer_bits(kind), &moved.layer_bits(kind));
                }
                // The sums that make a value round to an ulp of it each, of which there are few.
                let ulp = f64::EPSILON * f64::from(1 << k);
                for ((a, b), p) in
                    plain.one(LayerKind::First).iter().zip(moved.one(LayerKind::First)).zip(plain.pixels())
                {
                    assert!(p[3] == 0.0 || (b - a - f64::from(1 << k)).abs() <= 4.0 * ulp, "{place}: {a} {b}");
                }
            }
        }
    }
    differ
}

/// The numbers of nodes reach as far as those of the data: a range of 10³⁰⁰ or 10⁻³⁰⁰ is drawn like one of 1.
fn ends_of_the_number_type() -> f64 {
    let mut differ = 0.0;
    let grid = Grid::with_spacing([9; 3], [1.0; 3]).unwrap();
    let shape = |p: DVec3| 3.5 - (p - DVec3::splat(4.0)).length();
    let seen = |scale: f64| {
        let volume = on(grid.clone(), |p| scale * shape(p));
        let nodes = [(0.0, [1.0, 0.5, 0.2], 0.0), (2.0 * scale, [0.2, 0.5, 1.0], 0.5)];
        let shot = Stage::regular(volume, &nodes).layers(&[LayerKind::Normal, LayerKind::Curvature]);
        shot.with(|s| s.shading = Some(Shading::default())).render()
    };
    let one = seen(1.0);
    // Powers of two, so that nothing is rounded on the way.
    for e in [-1000, -600, 600, 1000] {
        let other = seen(drypoint::scene::math::scale_by_power_of_two(1.0, e));
        for kind in [LayerKind::Beauty, LayerKind::Normal, LayerKind::Curvature] {
            differ += differing(&one.layer_bits(kind), &other.layer_bits(kind));
        }
    }
    differ
}
