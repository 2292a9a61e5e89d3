//! Transcendental functions.

use super::{errors, gpu, modules, random};
use drypoint::gpu::ShaderKernel;
use drypoint::scene::color;
use drypoint::scene::math;

/// The last place of a number of f64 and of f32.
const ULP: [f64; 2] = [f64::EPSILON, f32::EPSILON as f64];

/// Opacities of all sizes, both ends among them.
fn opacities() -> Vec<f64> {
    let even = (0..=1000).map(|i| f64::from(i) / 1000.0);
    let tiny = (1..60).map(|e| 0.7 * 0.5f64.powi(e));
    even.chain(tiny).chain((1..24).map(|e| 1.0 - 0.5f64.powi(e))).collect()
}

#[test]
fn logarithms_of_transmittances_keep_their_digits() {
    let Some(gpu) = gpu() else { return };
    let table: Vec<[f64; 1]> = opacities().into_iter().filter(|&a| a < 1.0).map(|a| [a]).collect();
    let kernel = ShaderKernel {
        modules: modules(&["number/math"]),
        results: &["ln_one_minus(x[0])"],
        ..ShaderKernel::default()
    };
    let found = errors(&gpu, &kernel, &table, |&[a]| [(-a).ln_1p()], |_, t, _| t[0].abs().max(1e-300));
    println!("ln(1 − α): {found:?}");
    assert!(found[0] <= 4.0 * ULP[0] && found[1] <= 4.0 * ULP[1], "{found:?}");
}

#[test]
fn exponentials() {
    let Some(gpu) = gpu() else { return };
    let table: Vec<[f64; 1]> =
        (0..4000).map(|i| [-f64::from(i) * 0.0211]).chain((1..60).map(|e| [-0.5f64.powi(e)])).collect();
    let kernel = ShaderKernel {
        modules: modules(&["number/math"]),
        results: &["one_minus_exp(x[0])", "exp_of(x[0])"],
        ..ShaderKernel::default()
    };
    let truth = |&[y]: &[f64; 1]| [-y.exp_m1(), y.exp()];
    let found = errors(&gpu, &kernel, &table, truth, |_, t, i| t[i].abs().max(1e-37));
    println!("1 − e^y, e^y: {found:?}");
    // A compiler may take both parts of ln 2 as one number of f64, which is off by up to 2⁻⁵⁴: n ≤ 122 times, 31 last places.
    assert!(found[0] <= 35.0 * ULP[0] && found[1] <= 4.0 * ULP[1], "{found:?}");
}

/// x^y = e^(y ln x): the error of the product is |y ln x| last places of the result.
#[test]
fn powers() {
    let Some(gpu) = gpu() else { return };
    let mut next = random(7);
    let table: Vec<[f64; 2]> = (0..4000).map(|_| [next().powi(4) + 1e-9, 0.3 + 2.5 * next()]).collect();
    let kernel =
        ShaderKernel { modules: modules(&["number/math"]), results: &["power(x[0], x[1])"], ..ShaderKernel::default() };
    let scale = |&[x, y]: &[f64; 2], t: &[f64; 1], _| t[0] * (1.0 + (y * x.ln()).abs());
    let found = errors(&gpu, &kernel, &table, |&[x, y]| [x.powf(y)], scale);
    println!("x^y: {found:?}");
    assert!(found[0] <= 4.0 * ULP[0] && found[1] <= 4.0 * ULP[1], "{found:?}");
}

#[test]
fn logarithms_and_angles() {
    let Some(gpu) = gpu() else { return };
    let mut next = random(3);
    let kernel = ShaderKernel {
        modules: modules(&["number/math"]),
        results: &["log2_of(x[0])", "ln(x[0])"],
        ..ShaderKernel::default()
    };
    let table: Vec<[f64; 1]> = (0..4000).map(|_| [((next() - 0.5) * 60.0).exp()]).collect();
    let found = errors(&gpu, &kernel, &table, |&[x]| [math::log2(x), x.ln()], |_, t, i| t[i].abs().max(1.0));
    println!("log₂, ln: {found:?}");
    assert!(found[0] <= 4.0 * ULP[0] && found[1] <= 4.0 * ULP[1], "{found:?}");
    let kernel =
        ShaderKernel { modules: modules(&["number/math"]), results: &["angle(x[0], x[1])"], ..ShaderKernel::default() };
    let random = (0..4000).map(|_| [next().powi(5), next() - 0.5]);
    let hard = [[0.0, 0.0], [0.0, 1.0], [0.0, -1.0], [1.0, 0.0], [1.0, 1.0], [1.0, -1.0], [1e-30, 1.0], [1e-7, -1.0]];
    let table: Vec<[f64; 2]> = random.chain(hard).collect();
    let found = errors(&gpu, &kernel, &table, |&[s, c]| [math::atan2(s, c)], |_, t, _| t[0].abs().max(1e-37));
    println!("angles: {found:?}");
    assert!(found[0] <= 5.0 * ULP[0] && found[1] <= 5.0 * ULP[1], "{found:?}");
}

#[test]
fn the_curves_of_srgb() {
    let Some(gpu) = gpu() else { return };
    let kernel = ShaderKernel {
        modules: modules(&["number/math", "number/color"]),
        results: &["linear_to_srgb(x[0])", "srgb_to_linear(x[0])"],
        ..ShaderKernel::default()
    };
    // The kinks apart: f32 can fall on the other side.
    let table: Vec<[f64; 1]> =
        (0..=2000).map(|i| [f64::from(i) / 1000.0]).filter(|[c]| (c - 0.04).abs() > 1e-3).collect();
    let truth = |&[c]: &[f64; 1]| [color::linear_to_srgb(c), color::srgb_to_linear(c)];
    let found = errors(&gpu, &kernel, &table, truth, |_, t, i| t[i].abs().max(1e-3));
    println!("sRGB: {found:?}");
    assert!(found[0] <= 8.0 * ULP[0] && found[1] <= 8.0 * ULP[1], "{found:?}");
}
