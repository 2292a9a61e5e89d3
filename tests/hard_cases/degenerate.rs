//! Gradients that are 0, or nearly ([PREC-3], [CUR-1], [CUR-2]).

use crate::common::{LAYERS, Stage, on, orthographic, perspective, plain, quadratic_ball};
use crate::stability::{Case, Theme, worse};
use drypoint::scene::glam::DVec3;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{
    Camera, Contours, GradientEstimator, GradientRange, HessianEstimator, Kappa, Kernel, Length, Number, Shading,
};

pub(crate) static THEME: Theme = Theme::new(
    "Degenerate gradients",
    &[
        Case {
            name: "slopes of 64 and 128 ulps a voxel at 1000",
            breaks: "rounding that is shaded, or a real flank that is not",
            done: "no normal where ‖g‖ ≤ 2⁻⁴⁶·max|value|/voxel [PREC-3]",
            of: "samples with a normal on the flatter one, or without on the steeper; central and Sobel",
            bound: 0.0,
            why: "the bound is 125 ulps; differences of dyadic numbers are exact",
            measure: || just_above_rounding(Number::F64),
        },
        Case {
            name: "slopes of 8 and 16 ulps of f32 a voxel at 1000, in f32",
            breaks: "as above",
            done: "no normal where ‖g‖ ≤ 2⁻²⁰·max|value|/voxel [PREC-3]",
            of: "samples with a normal on the flatter one, or without on the steeper; central and Sobel",
            bound: 0.0,
            why: "the bound is 15.6 ulps; differences of dyadic numbers are exact",
            measure: || just_above_rounding(Number::F32),
        },
        Case {
            name: "xy and x⁴ − 6x²y² + y⁴ about their axis",
            breaks: "0/0 for normals and curvatures at saddles",
            done: "N = v and κ = 0 there",
            of: "samples without a normal other than those on the axis, and numbers that are NaN; all layers",
            bound: 0.0,
            why: "∇f = 0 on the axis alone, where dyadic differences are exactly 0",
            measure: saddles,
        },
        Case {
            name: "a sphere seen along its normal",
            breaks: "the view has no tangential part: κ_v is 0/0",
            done: "the mean curvature where ‖Pv‖ ≤ 2⁻²⁶ [CUR-2]",
            of: "|κ_v ρ − 1|; pixels from 10⁻¹² to 10⁻³ voxels off the axis",
            bound: 1e-9,
            why: "at an umbilic every κ is 1/ρ; rounding of H: c ε M R, c = 48·422 of the quintic spline",
            measure: along_the_normal,
        },
        Case {
            name: "κ₁ = κ₂ on a sphere",
            breaks: "√(m² − K) loses half of the digits: 10⁻⁸",
            done: "κ = m ± hypot((a − c)/2, b) [CUR-1]",
            of: "|κ₁ρ − 1| and |κ₂ρ − 1|; all of an askew picture",
            bound: 1e-9,
            why: "as above",
            measure: umbilics,
        },
        Case {
            name: "gradient range of nothing: constant data, lo = hi",
            breaks: "|g| = 0/0",
            done: "|g| = 0 everywhere [VAL-2]",
            of: "|α − α_u^(3/2)·corrections| of eq. 2, and fades that are NaN",
            bound: 1e-14,
            why: "|N·v| = 1 and |g| = 0: one power and one correction",
            measure: no_range,
        },
    ],
);

#[test]
fn degenerate_gradients() {
    THEME.hold();
}

fn just_above_rounding(number: Number) -> f64 {
    let mut wrong = 0;
    let (ulp, around) = match number {
        Number::F64 => (2f64.powi(-43), [64.0, 128.0]),
        Number::F32 => (2f64.powi(-14), [8.0, 16.0]),
    };
    for (ulps, has_normal) in [(around[0], false), (around[1], true)] {
        let ramp = on(Grid::with_spacing([9, 9, 9], [1.0; 3]).unwrap(), |p| 1000.0 + ulps * ulp * p.y);
        for gradient in [GradientEstimator::Central, GradientEstimator::Sobel] {
            let shot = Stage::regular(ramp.clone(), &[(0.0, [0.5; 3], 0.1)]).with(|s| {
                s.shading = Some(Shading::default());
                s.sampling.gradient = gradient;
                s.sampling.number = number;
            });
            let counts = shot.render().counts;
            assert!(counts.gradients > 500);
            wrong += if has_normal { counts.without_normal } else { counts.gradients - counts.without_normal };
        }
    }
    wrong as f64
}

fn saddles() -> f64 {
    let mut wrong = 0;
    let fields: [fn(f64, f64) -> f64; 2] = [|x, y| x * y, |x, y| x * x * x * x - 6.0 * x * x * y * y + y * y * y * y];
    for (i, field) in fields.into_iter().enumerate() {
        let volume = on(Grid::with_spacing([9, 9, 9], [1.0; 3]).unwrap(), |p| field(p.x - 4.0, p.y - 4.0));
        for kappa in [Kappa::Ray, Kappa::Exact] {
            let glass = plain("glass", [0.2, 0.5, 0.8, 0.7]);
            let shot = Stage::styled(volume.clone(), vec![glass], &[(0.0, "glass", 0.1)]).layers(&LAYERS).with(|s| {
                s.camera = Camera { direction: DVec3::Z, up: DVec3::Y, ..orthographic(Some(5.0)) };
                s.contours = Some(Contours { kappa, ..Contours::default() });
                s.volume.gradient_range = GradientRange::Quantile(0.99);
                s.picture.size = [5, 5];
            });
            let shown = shot.render();
            // Pixels are voxels: the middle one looks along the axis. Central differences of the quartic are 4x(x² + 1 − 3y²)
            // and its like, 0 at the axis alone: no square is 2 more than a multiple of 3.
            let on_the_axis = shown.one(LayerKind::Counts)[12] as u64;
            assert!(on_the_axis > 10, "{i}");
            wrong += shown.counts.without_normal.abs_diff(on_the_axis);
            let values = shown.picture.layers.iter().flat_map(|l| l.channels.iter().flatten());
            wrong += values.filter(|v| v.is_nan()).count() as u64;
            let middle = shown.layer::<3>(LayerKind::Curvature)[12];
            wrong += u64::from(middle != [0.0; 3]) + u64::from(shown.layer::<3>(LayerKind::Normal)[12][2] <= 0.999);
        }
    }
    wrong as f64
}

/// An opaque ball with exact curvatures.
fn ball() -> Stage {
    let nodes = [(0.0, "grey", 0.0), (0.0, "grey", 1.0)];
    Stage::styled(quadratic_ball(26, 8.0), vec![plain("grey", [0.5, 0.5, 0.5, 1.0])], &nodes)
        .layers(&[LayerKind::Curvature, LayerKind::First])
        .with(|s| {
            s.sampling.kernel = Kernel::Bspline5;
            s.sampling.gradient = GradientEstimator::Analytic;
            s.sampling.hessian = HessianEstimator::Analytic;
            s.contours = Some(Contours { kappa: Kappa::Exact, ..Contours::default() });
        })
}

/// The radius of the surface with that value.
fn radius(value: f64) -> f64 {
    (64.0 - 16.0 * value).sqrt()
}

fn along_the_normal() -> f64 {
    let mut largest = 0.0;
    for side in [1e-12, 1e-9, 1e-8, 1e-6, 1e-3] {
        let shown = ball()
            .with(|s| {
                s.camera.projection = orthographic(Some(5.0 * side)).projection;
                s.picture.size = [5, 5];
            })
            .render();
        let values = shown.one(LayerKind::First);
        for (value, [.., kv]) in values.into_iter().zip(shown.layer::<3>(LayerKind::Curvature)) {
            largest = worse(largest, (kv * radius(value) - 1.0).abs());
        }
    }
    largest
}

fn umbilics() -> f64 {
    let shown =
        ball().with(|s| s.camera = Camera { direction: DVec3::new(0.4, 0.8, -0.3), ..perspective(50.0) }).render();
    let mut largest = 0.0;
    let values = shown.one(LayerKind::First).into_iter().zip(shown.layer::<3>(LayerKind::Curvature));
    for ((value, kappas), pixel) in values.zip(shown.pixels()) {
        if pixel[3] > 0.0 {
            kappas.iter().for_each(|k| largest = worse(largest, (k * radius(value) - 1.0).abs()));
        }
    }
    assert!(shown.covered() > 20);
    largest
}

fn no_range() -> f64 {
    let alpha_u = 0.3f64;
    let mut largest = 0.0;
    for range in [GradientRange::Quantile(0.999), GradientRange::Quantile(0.0), GradientRange::Fixed([2.0, 2.0])] {
        for fade in [None, Some([0.0, 0.0]), Some([0.1, 0.1])] {
            let flat = on(Grid::with_spacing([5, 5, 5], [1.0; 3]).unwrap(), |_| 7.0);
            let shot = Stage::styled(flat, vec![plain("s", [0.5, 0.5, 0.5, 1.0])], &[(0.0, "s", alpha_u)]).with(|s| {
                s.volume.gradient_range = range;
                s.contours = Some(Contours { fade, thickness: Length::World(1.0), ..Contours::default() });
                s.camera.projection = orthographic(Some(2.0)).projection;
                s.picture.size = [2, 2];
                // One plane, through the middle.
                s.sampling.step = Length::World(32.0);
                s.sampling.reference_length = Length::World(64.0);
                s.camera.eye = Some(DVec3::new(2.0, 2.0 - 16.0, 2.0));
                s.camera.direction_given = true;
            });
            let expected = 1.0 - (1.0 - alpha_u.powf(1.5)).sqrt();
            shot.render().pixels().iter().for_each(|p| largest = worse(largest, (p[3] - expected).abs()));
        }
    }
    largest
}
