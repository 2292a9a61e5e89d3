//! Lighting transfer functions at their edges ([VS-5]).

use crate::common::{Stage, ball, orthographic, volume};
use crate::stability::{Case, Theme, differing};
use drypoint::reference::number::Vec3;
use drypoint::reference::volumeshop::LightingFunction;
use drypoint::scene::glam::DVec3;
use drypoint::scene::lighting::{ContourRule, LightingFile, LightingModel, LightingPreset, LightingTable};
use drypoint::scene::math::scale_by_power_of_two;
use drypoint::scene::shot::{LightingParams, LightingSource};
use drypoint::scene::tables::{GradientRange, LightDirection, Shading, ShadingModel};
use std::sync::Arc;

pub(crate) static THEME: Theme = Theme::new(
    "Lighting functions",
    &[
        Case {
            name: "a table of (1, 0, 0, 1) in every cell, beside no shading at all",
            breaks: "an interpolation that does not return a constant; a divisor of 1 that rounds",
            done: "a + w(b − a), and min(1, s_α + (1 − |N|)) [VS-5]",
            of: "numbers with another bit",
            bound: 0.0,
            why: "(1 + 0)·c + 0 = c, and α/1 = α",
            measure: constant_table,
        },
        Case {
            name: "α_u = 10⁻³⁰⁰ where s_α = 0 and |N| = 1",
            breaks: "a division by 0: opaque speckle",
            done: "the divisor is at least s_min = 1/64 [VS-5]",
            of: "the largest opacity, in units of 64·10⁻³⁰⁰ a sample",
            bound: 1.0 + 1e-10,
            why: "opacities this small add, and the sum rounds",
            measure: nearly_nothing,
        },
        Case {
            name: "L·v of −1, −0.99, −0.5, 0, 0.7 and 1",
            breaks: "contours beside the silhouette, as with the printed factor 2",
            done: "c = ‖L + v‖ [VS-5]",
            of: "the largest |N·v| within one deviation of the contour, in units of 0.15 and a cell",
            bound: 1.0,
            why: "across a cell c·y − x changes by (1 + c)·2/256 at most",
            measure: light_from_everywhere,
        },
        Case {
            name: "values times 2^±100, metal with contours",
            breaks: "gradients that overflow or vanish in |N|",
            done: "gradients are scaled by a power of two [SPACE-4]",
            of: "numbers with another bit",
            bound: 0.0,
            why: "a power of two changes no mantissa",
            measure: values_by_two,
        },
        Case {
            name: "a constant volume, which has no normal, in all presets",
            breaks: "light and enhanced opacity of rounding noise",
            done: "without a normal c_u and α_u stay [PREC-3]",
            of: "numbers that differ from those of no shading",
            bound: 0.0,
            why: "one test decides for every sample",
            measure: without_normal,
        },
    ],
);

#[test]
fn lighting_functions() {
    THEME.hold();
}

const COLOR: [f64; 3] = [0.5, 0.25, 0.75];

fn scene(scale: f64) -> Stage {
    let soft = ball(16, 6.0);
    let of = volume([16; 3], |p| scale * soft.value([p.x as usize, p.y as usize, p.z as usize]));
    Stage::regular(of, &[(-2.0 * scale, COLOR, 0.0), (2.0 * scale, COLOR, 0.4)]).with(|s| {
        s.camera = orthographic(Some(15.0));
        s.camera.direction = DVec3::new(0.4, 0.8, -0.5);
    })
}

fn by_preset(preset: LightingPreset) -> Shading {
    let light = Some(LightDirection::Eye(DVec3::new(-1.0, 2.0, 1.5)));
    Shading { model: ShadingModel::Function, preset: Some(preset), light, ..Shading::default() }
}

fn constant_table() -> f64 {
    let plain = scene(1.0).render();
    assert!(plain.covered() > 80);
    let table = LightingTable::new(3, 2, vec![[1.0, 0.0, 0.0, 1.0]; 6]).map(Arc::new);
    let file = LightingFile { path: "constant.png".into(), table };
    let shading = Shading { model: ShadingModel::Function, table: Some(file), ..Shading::default() };
    differing(&plain.bits(), &scene(1.0).with(|s| s.shading = Some(shading)).render().bits())
}

fn nearly_nothing() -> f64 {
    // |N| = 1 throughout a slope whose range ends below its gradient.
    let slope = Stage::regular(volume([20; 3], |p| p.z), &[(0.0, COLOR, 1e-300)]).step(1.0).with(|s| {
        s.camera = orthographic(Some(4.0));
        s.camera.direction = DVec3::Y;
        s.camera.up = DVec3::Z;
        s.picture.size = [5, 5];
        s.sampling.stop_below = 0.0;
        s.volume.gradient_range = GradientRange::Fixed([0.0, 0.5]);
        s.shading = Some(by_preset(LightingPreset::Gradient));
    });
    let shown = slope.render();
    let most = shown.counts.samples as f64 / shown.counts.rays as f64 * 64e-300;
    let largest = shown.pixels().iter().map(|pixel| pixel[3]).fold(0.0, f64::max);
    assert!(largest > 64e-300, "{largest:e}");
    largest / most
}

fn light_from_everywhere() -> f64 {
    let mut largest: f64 = 0.0;
    for z in [-1.0, -0.99, -0.5, 0.0, 0.7, 1.0f64] {
        let light = DVec3::new((1.0 - z * z).sqrt(), 0.0, z);
        let contour_factor = ContourRule::Exact.factor(z);
        let preset = LightingPreset::BlinnPhongContours;
        let model = LightingModel { preset, ambient: 1.0, diffuse: 0.0, specular: 0.0, shininess: 1.0, contour_factor };
        let source = LightingSource::Preset(model);
        let function = LightingFunction::<f64>::new(&LightingParams { source, divisor_floor: 1.0, light });
        let half = function.half_vector(Vec3::new(0.0, 0.0, 1.0));
        let cell = (1.0 + contour_factor) * 2.0 / 256.0;
        for i in 0..20_000 {
            let n_z = 1.0 - f64::from(2 * i + 1) / 20_000.0;
            let (sin, cos) = (f64::from(i) * 2.399_963_229_728_653).sin_cos();
            let across = (1.0 - n_z * n_z).sqrt();
            let found = function.reflectance(Vec3::new(across * cos, across * sin, n_z), half);
            if found.opacity < 1.0 - (-0.5f64).exp() {
                largest = largest.max(n_z.abs() / (0.15 + cell));
            }
        }
    }
    assert!(largest > 0.9);
    largest
}

fn values_by_two() -> f64 {
    let bits = |scale: f64| {
        let shown = scene(scale).with(|s| {
            s.volume.gradient_range = GradientRange::Quantile(0.9);
            s.shading = Some(by_preset(LightingPreset::MetalContours));
        });
        let shown = shown.render();
        assert!(shown.covered() > 80);
        shown.bits()
    };
    let one = bits(1.0);
    [-100, -1, 37, 100].map(|k| differing(&one, &bits(scale_by_power_of_two(1.0, k)))).iter().sum()
}

fn without_normal() -> f64 {
    let flat = Stage::regular(volume([8; 3], |_| 3.0), &[(0.0, COLOR, 0.2), (6.0, COLOR, 0.4)]);
    let plain = flat.render().bits();
    let differs = |preset| differing(&plain, &flat.with(|s| s.shading = Some(by_preset(preset))).render().bits());
    LightingPreset::ALL.map(differs).iter().sum()
}
