//! Volumetric halos.

use super::{errors, gpu, modules, random};
use drypoint::gpu::{Gpu, ShaderKernel};
use drypoint::reference::style_transfer_functions::contour;
use drypoint::reference::volumetric_halos::seed::{SeedNormal, SeedPlace, Seeding};
use drypoint::reference::volumetric_halos::{DirectionInfluence, FocusInfluence, HaloProfile};
use drypoint::scene::glam::DVec3;
use drypoint::scene::math;
use drypoint::scene::shot::{
    HaloAccumulation, HaloKind, HaloParams, HaloSeed, HaloSource, HaloSpread, ProfileNode, SeedDirection, SeedFocus,
    SeedSide, SeedValue,
};

/// Half a last place of 1 in f32: the error of one operation.
const U: f64 = 1.0 / (1u64 << 24) as f64;

/// Checks the errors of a table: those of f64 are rounding, those of f32 have a derived bound.
fn hold(name: &str, found: [f64; 2], single: f64) {
    println!("{name}: f64 {:.1e}, f32 {:.1e} of {single:.1e}", found[0], found[1]);
    assert!(found[0] <= 1e-12 && found[1] <= single, "{name}: {found:?}");
}

/// The list of one halo with some parameters, in the order of the shader's struct; the others are 0.
fn parameters(values: &[(&str, f64)]) -> Vec<f64> {
    let text = modules(&["volumetric_halos/halos"]);
    let fields = text.split("struct Halo {").nth(1).unwrap().split('}').next().unwrap();
    let names: Vec<&str> = fields.lines().filter_map(|line| line.trim().strip_suffix(": real,")).collect();
    assert!(values.iter().all(|(name, _)| names.contains(name)), "{names:?}");
    let value = |name: &str| values.iter().find(|(given, _)| *given == name).map_or(0.0, |(_, value)| *value);
    names.into_iter().map(value).collect()
}

fn params(seed: HaloSeed) -> HaloParams {
    HaloParams {
        name: "halo".into(),
        kind: HaloKind::Occlusive,
        seed,
        spread: HaloSpread { from: HaloSource::Gradient, passes: 4, delta: 0.8, stretch: 1.0, median: false },
        profile: Vec::new(),
        opacity: 1.0,
        floor: 0.0,
        every: 1,
        accumulate: HaloAccumulation::Max,
        tints: Vec::new(),
    }
}

fn seed(gradient_exponent: f64, side: SeedSide) -> HaloSeed {
    HaloSeed { value: None, direction: None, focus: None, labels: None, gradient_exponent, side }
}

/// The text of seeds' formulas, without what samples are asked for.
fn seed_formulas() -> String {
    let whole = modules(&["volumetric_halos/seed"]);
    let from = whole.find("// x^y for x in [0, 1]").unwrap();
    let functions = &whole[from..whole.find("// Adds the seeds of a sample").unwrap()];
    modules(&["number/arithmetic", "number/math", "volumetric_halos/halos"]) + functions
}

/// s: the error of 1 − |n·v| and of |g| is multiplied by their exponents; both powers have a logarithm and an exponential
/// of 4 last places each.
#[test]
fn strengths_of_seeds() {
    let Some(gpu) = gpu() else { return };
    for (a, b) in [(0.125, 32.0), (32.0, 0.125), (0.5, 3.0), (0.0, 0.0), (0.7, 4.3), (1.0, 100.0)] {
        strengths(&gpu, a, SeedSide::Power { exponent: b }, [0.0, b], (2.0 + b + a) * 2.0 + 40.0);
    }
    // τ has 6 roundings, the quotient at most 1 is 7 away from its own, relative to 1.
    for thickness in [0.5, 2.0] {
        strengths(&gpu, 0.5, SeedSide::Curvature { thickness }, [1.0, thickness], 40.0);
    }
}

fn strengths(gpu: &Gpu, a: f64, side: SeedSide, [by_curvature, side_number]: [f64; 2], roundings: f64) {
    let mut next = random(21);
    let mut table: Vec<[f64; 4]> = (0..2000).map(|_| [next(), next(), next(), 0.3 * next() + 0.05]).collect();
    // Seen from the side, from the front, without a gradient; κ = 0; a whole h.
    table.extend([[1.0, 0.0, 1.0, 0.2], [0.5, 1.0, 0.5, 0.2], [1.0, 0.25, 0.0, 0.2], [1.0, 0.0, 0.5, 0.0]]);
    table.push([1.0, 0.5, 1e-30, 0.1]);
    let list = parameters(&[
        ("gradient_exponent", a),
        ("by_curvature", by_curvature),
        ("side", side_number),
        ("most_frontal", 2.0),
    ]);
    let kernel = ShaderKernel {
        modules: seed_formulas(),
        lists: &[(30, &list)],
        results: &["seed_strength(0, x[0], x[1], x[2], x[3])"],
        ..ShaderKernel::default()
    };
    let seeding = Seeding::new(&params(seed(a, side))).unwrap();
    let truth = |&[h, n_dot_v, magnitude, kappa]: &[f64; 4]| {
        let tau = seeding.thickness().map_or(0.0, |t| contour::root(kappa * t));
        [seeding.strength(h, &SeedNormal { in_picture: [0.0, 1.0], n_dot_v, magnitude, tau })]
    };
    let found = errors(gpu, &kernel, &table, truth, |_, _, _| 1.0);
    hold(&format!("strengths, {a}, {side:?}"), found, roundings * U);
}

/// Below the floor a seed is 0, and beyond the largest |n·v| too.
#[test]
fn floors_of_seeds() {
    let Some(gpu) = gpu() else { return };
    let list = parameters(&[("side", 1.0), ("most_frontal", 0.9), ("floor", 0.25)]);
    let kernel = ShaderKernel {
        modules: seed_formulas(),
        lists: &[(30, &list)],
        results: &["seed_strength(0, x[0], x[1], 0.5, 0.0)"],
        ..ShaderKernel::default()
    };
    let table = [[1.0, 0.5], [1.0, 0.8], [0.5, 0.5], [0.25, 0.25], [1.0, 0.95], [0.75, 0.625]];
    let truth = |&[h, n_dot_v]: &[f64; 2]| {
        let s = h * (1.0 - n_dot_v);
        [if s < 0.25 || n_dot_v > 0.9 { 0.0 } else { s }]
    };
    hold("floors", errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0), 4.0 * U);
}

/// h_v over nodes: a quotient and a mix.
#[test]
fn influences_of_values() {
    let Some(gpu) = gpu() else { return };
    let nodes = [[0.125, 0.0], [0.25, 1.0], [0.5, 0.75], [0.5, 0.25], [0.875, 0.5]];
    let list: Vec<f64> = nodes
        .iter()
        .zip(nodes.iter().skip(1).chain(nodes.last()))
        .flat_map(|(&[at, h], &[next, next_h])| [at, next - at, h, next_h])
        .collect();
    let halo = parameters(&[("value", 2.0), ("nodes", 5.0)]);
    let opacity = "var<private> seed_alpha_u: real;\nstruct Sample { s: real, }\n";
    let kernel = ShaderKernel {
        modules: modules(&["number/arithmetic", "volumetric_halos/halos", "volumetric_halos/seed_value"]) + opacity,
        lists: &[(30, &halo), (31, &list)],
        before: "let sample = Sample(x[0]);",
        results: &["by_value(0, sample, 1.0)"],
        ..ShaderKernel::default()
    };
    let mut next = random(22);
    let mut table: Vec<[f64; 1]> = (0..1000).map(|_| [1.2 * next() - 0.1]).collect();
    table.extend([[0.125], [0.25], [0.5], [0.875], [0.499_999]]);
    let mut with_nodes = seed(0.0, SeedSide::Power { exponent: 0.0 });
    with_nodes.value = Some(SeedValue::Nodes(nodes.to_vec()));
    let seeding = Seeding::new(&params(with_nodes)).unwrap();
    let truth = |&[value]: &[f64; 1]| {
        [seeding.before_gradient(&SeedPlace { value, alpha_u: 0.0, world: DVec3::ZERO, label: 0 })]
    };
    // A value is within a rounding of 1 of itself; a segment has a slope of at most 8.
    hold("values", errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0), 16.0 * U);
}

/// h_p: distances of numbers up to 20, with about 8 roundings each, over a falloff.
#[test]
fn influences_of_places() {
    let Some(gpu) = gpu() else { return };
    let vertices = [[1.0, 0.0, 0.5], [10.0, 0.0, 2.0], [10.0, 10.0, 4.0], [10.0, 10.0, 4.0]];
    for (points, inner, falloff) in [(1, 2.0, 6.0), (2, 0.0, 4.0), (4, 1.5, 3.0)] {
        let at = &vertices[..points];
        let list: Vec<f64> = at.iter().flatten().copied().collect();
        let halo = parameters(&[("points", points as f64), ("inner", inner), ("falloff", falloff)]);
        let kernel = ShaderKernel {
            modules: modules(&["number/arithmetic", "volumetric_halos/halos", "volumetric_halos/focus"])
                + "struct Sample { position: vec3<real>, }",
            vectors: &[
                ("halo_axis_x", [1.0, 0.0, 0.0]),
                ("halo_axis_y", [0.0, 2.0, 0.0]),
                ("halo_axis_z", [0.5, 0.0, 1.0]),
            ],
            lists: &[(30, &halo), (31, &list)],
            before: "let sample = Sample(vec3<real>(x[0], x[1], x[2]));",
            results: &["by_focus(0, sample, 0.5)"],
            ..ShaderKernel::default()
        };
        let mut next = random(23);
        let mut table: Vec<[f64; 3]> = (0..2000).map(|_| std::array::from_fn(|_| 20.0 * next() - 5.0)).collect();
        table.extend([[1.0, 0.0, 0.0], [10.0, 0.0, 2.0], [5.0, 0.0, 1.0]]);
        let focus =
            FocusInfluence::new(&SeedFocus { at: at.iter().copied().map(DVec3::from_array).collect(), inner, falloff });
        let truth = |&[x, y, z]: &[f64; 3]| [0.5 * focus.at(DVec3::new(x + 0.5 * z, 2.0 * y, z))];
        let found = errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0);
        hold(&format!("{points} points"), found, 20.0 * 16.0 / falloff * U);
    }
}

/// h_d: an angle of 180 degrees has 8 last places; smoothstep grows by at most 3/2 per softness.
#[test]
fn influences_of_directions() {
    let Some(gpu) = gpu() else { return };
    let mut next = random(24);
    for (toward, width, softness) in [(90.0, 60.0, 20.0), (-200.0, 0.0, 180.0), (359.0, 200.0, 90.0)] {
        let turn = f64::to_radians(f64::rem_euclid(toward, 360.0));
        let whole = modules(&["volumetric_halos/direction"]);
        let kernel = ShaderKernel {
            modules: modules(&["number/math"]) + &whole[..whole.find("fn seed_direction").unwrap()],
            params: &[
                ("toward_x", math::sin(turn)),
                ("toward_y", math::cos(turn)),
                ("half_width", 0.5 * width),
                ("softness", softness),
            ],
            before: "let toward = vec2<real>(params.toward_x, params.toward_y);",
            results: &["direction_at(vec2<real>(x[0], x[1]), toward, params.half_width, params.softness)"],
            ..ShaderKernel::default()
        };
        let mut table: Vec<[f64; 2]> = (0..2000).map(|_| [2.0 * next() - 1.0, 2.0 * next() - 1.0]).collect();
        table.extend([[0.0, 1.0], [0.0, -1.0], [1.0, 0.0], [-1.0, 0.0], [0.0, 0.0], [1e-9, 0.0], [1e-5, 1e-5]]);
        let influence = DirectionInfluence::new(SeedDirection { toward, width, softness }).unwrap();
        let truth = |&n: &[f64; 2]| [influence.at(n)];
        let found = errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0);
        hold(&format!("toward {toward}"), found, 180.0 * 16.0 * 1.5 / softness * U);
    }
}

/// Profiles, linear and encoded: a quotient times differences of at most 1; an encoding of 6 last places and slope 13.
#[test]
fn profiles() {
    let Some(gpu) = gpu() else { return };
    let nodes = [
        ProfileNode { at: 0.125, rgb: [1.0, 0.25, 0.0], opacity: 0.0 },
        ProfileNode { at: 0.5, rgb: [0.0, 0.5, 1.0], opacity: 0.75 },
        ProfileNode { at: 0.5, rgb: [0.5, 0.5, 0.5], opacity: 0.25 },
        ProfileNode { at: 1.0, rgb: [0.125, 0.0, 0.25], opacity: 1.0 },
    ];
    let list: Vec<f64> = nodes.iter().flat_map(|n| [n.at, n.rgb[0], n.rgb[1], n.rgb[2], n.opacity]).collect();
    let halo = parameters(&[("profile", 4.0), ("opacity", 0.75)]);
    let mut next = random(25);
    let mut table: Vec<[f64; 1]> = (0..1000).map(|_| [next()]).collect();
    table.extend([[0.0], [0.125], [0.5], [1.0], [1e-20]]);
    for (blend, encode) in [("blend_linear", false), ("blend_srgb", true)] {
        let kernel = ShaderKernel {
            modules: modules(&["number/math", "number/color", "ray/accumulator", &format!("ray/{blend}")])
                + &modules(&["volumetric_halos/halos", "volumetric_halos/profile"]),
            lists: &[(30, &halo), (31, &list)],
            before: "let c = profile_at(0, x[0]);",
            results: &["select(real(0.0), c.r, c.a > 0.0)", "select(real(0.0), c.b, c.a > 0.0)", "c.a"],
            ..ShaderKernel::default()
        };
        let profile = HaloProfile::new(&nodes, 0.75, encode);
        let truth = |&[h]: &[f64; 1]| profile.at(h).map_or([0.0; 3], |(rgb, opacity)| [rgb[0], rgb[2], opacity]);
        let found = errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0);
        hold(blend, found, if encode { 160.0 } else { 12.0 } * U);
    }
}

/// Tints: two products and a sum for each halo.
#[test]
fn tints() {
    let Some(gpu) = gpu() else { return };
    let whole = modules(&["volumetric_halos/halo_planes_tint"]);
    let kernel = ShaderKernel {
        modules: whole[..whole.find("// The tint of all occlusive halos").unwrap()].to_owned(),
        before: "let first = mix_in(Tint(1.0, vec3<real>()), vec3<real>(x[0]), x[1]);
            let both = mix_in(first, vec3<real>(x[2]), x[3]);",
        results: &["tinted(vec3<real>(x[4]), first).x", "tinted(vec3<real>(x[4]), both).y"],
        ..ShaderKernel::default()
    };
    let mut next = random(26);
    let table: Vec<[f64; 5]> = (0..1000).map(|_| std::array::from_fn(|_| next())).collect();
    let truth = |&[a, m, b, n, c]: &[f64; 5]| {
        let once = (1.0 - m) * c + m * a;
        [once, (1.0 - n) * once + n * b]
    };
    hold("tints", errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0), 12.0 * U);
}

/// H_i = δF_i + (1 − δF_i)H₀.
#[test]
fn spreading() {
    let Some(gpu) = gpu() else { return };
    let whole = modules(&["volumetric_halos/spreading"]);
    let from = whole.find("// H_i = delta F_i").unwrap();
    let kernel = ShaderKernel {
        modules: whole[from..whole.find("// A pass at a pixel").unwrap()].to_owned(),
        results: &["spread(x[0], x[1], x[2])"],
        ..ShaderKernel::default()
    };
    let mut next = random(27);
    let mut table: Vec<[f64; 3]> = (0..1000).map(|_| std::array::from_fn(|_| next())).collect();
    table.extend([[1.0, 1.0, 1.0], [0.0, 0.5, 1.0], [1.0, 0.25, 0.0]]);
    let truth = |&[f, h0, delta]: &[f64; 3]| [delta * f + (1.0 - delta * f) * h0];
    hold("spreading", errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0), 5.0 * U);
}

/// The median of nine is exact; zeros and ones in every order are enough for a filter of order.
#[test]
fn medians() {
    let Some(gpu) = gpu() else { return };
    let whole = modules(&["volumetric_halos/median"]);
    let from = whole.find("// A column of three in order").unwrap();
    let column = |i: usize| {
        let [a, b, c] = [3 * i, 3 * i + 1, 3 * i + 2];
        format!("ordered_column(x[{a}], x[{b}], x[{c}])")
    };
    let result = format!("median_of_nine({}, {}, {})", column(0), column(1), column(2));
    let kernel = ShaderKernel {
        modules: whole[from..whole.find("fn seed_column").unwrap()].to_owned(),
        results: &[&result],
        ..ShaderKernel::default()
    };
    let mut table: Vec<[f64; 9]> = (0..512u32).map(|bits| std::array::from_fn(|i| f64::from(bits >> i & 1))).collect();
    let mut next = random(28);
    table.extend((0..500).map(|_| std::array::from_fn::<f64, 9, _>(|_| next())));
    let truth = |row: &[f64; 9]| {
        let mut sorted = *row;
        sorted.sort_by(f64::total_cmp);
        [sorted[4]]
    };
    hold("medians", errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0), 0.0);
}

/// Groups of M planes on both sides of the eye.
#[test]
fn ends_of_groups() {
    let Some(gpu) = gpu() else { return };
    let whole = modules(&["volumetric_halos/halo_planes_images"]);
    let from = whole.find("// The group of M planes").unwrap();
    let kernel = ShaderKernel {
        modules: whole[from..whole.find("// The group of a halo").unwrap()].to_owned(),
        results: &[
            "select(real(0.0), real(1.0), group_ends(i32(x[0]), i32(x[1])))",
            "real(group_of(i32(x[0]), i32(x[1])))",
        ],
        ..ShaderKernel::default()
    };
    let table: Vec<[f64; 2]> =
        (-20..20).flat_map(|k| [1, 2, 3, 7].map(|every| [f64::from(k), f64::from(every)])).collect();
    let truth = |&[k, every]: &[f64; 2]| {
        let ends = (k as i64 + 1).rem_euclid(every as i64) == 0;
        [f64::from(u8::from(ends)), (k / every).floor()]
    };
    hold("groups", errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0), 0.0);
}
