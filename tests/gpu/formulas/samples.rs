//! Functions of samples: opacity, compositing, light, nodes, the weights of kernels.

use super::{errors, gpu, modules, random};
use drypoint::gpu::ShaderKernel;
use drypoint::reference::number::Vec3;
use drypoint::reference::ray::opacity::Correction;
use drypoint::reference::shading::Phong;
use drypoint::reference::transfer::Piecewise;
use drypoint::scene::clip::{ClipPlane, ClipPlanes};
use drypoint::scene::glam::DVec3;
use drypoint::scene::shot::PhongParams;
use drypoint::scene::space::Grid;

/// Half a last place of 1 in f32: the error of one operation.
const U: f64 = 1.0 / (1u64 << 24) as f64;

/// The types of samples, as far as these functions read them.
const TYPES: &str = "struct Ray { v: vec3<real>, }\nstruct Sample { place: NodePlace, }
    struct Attributes { has_normal: bool, normal: vec3<real>, }\nstruct Shaded { rgb: vec3<real>, alpha: real, }\n";

/// The type of nodes' places, where the module that has it is not there.
const PLACE: &str = "struct NodePlace { node: i32, w: real, alpha_u: real, }\n";

/// Checks the errors of a table: those of f64 are rounding, those of f32 have a derived bound.
fn hold(name: &str, found: [f64; 2], single: f64) {
    println!("{name}: f64 {:.1e}, f32 {:.1e} of {single:.1e}", found[0], found[1]);
    assert!(found[0] <= 1e-13 && found[1] <= single, "{name}: {found:?}");
}

/// Unit vectors.
fn unit(next: &mut impl FnMut() -> f64) -> [f64; 3] {
    let v = DVec3::new(next() - 0.5, next() - 0.5, next() - 0.5);
    v.normalize().to_array()
}

/// A logarithm and an exponential of 4 last places each; a root and a division where the ratio is a half.
#[test]
fn opacities_are_corrected() {
    let Some(gpu) = gpu() else { return };
    let mut next = random(5);
    let ratio = |next: &mut dyn FnMut() -> f64| [1.0, 0.5, 2.0 * next() + 0.01][(3.0 * next()) as usize];
    let mut table: Vec<[f64; 2]> = (0..3000).map(|_| [next().powi(6), ratio(&mut next)]).collect();
    table.extend([[0.0, 0.3], [1.0, 0.3], [0.0, 0.5], [1.0, 0.5], [1e-20, 0.7], [0.999_999, 0.01]]);
    let kernel = ShaderKernel {
        modules: modules(&["number/math", "ray/opacity"]),
        results: &["corrected(x[0], x[1])"],
        ..ShaderKernel::default()
    };
    let truth = |&[alpha, ratio]: &[f64; 2]| [Correction::new(ratio).apply(alpha)];
    hold("correction", errors(&gpu, &kernel, &table, truth, |_, t, _| t[0].max(1e-37)), 16.0 * U);
}

/// Sums of at most two products each.
#[test]
fn colours_are_laid_over_each_other() {
    let Some(gpu) = gpu() else { return };
    let mut next = random(6);
    let table: Vec<[f64; 6]> = (0..2000).map(|_| std::array::from_fn(|_| next())).collect();
    let kernel = ShaderKernel {
        modules: modules(&["ray/accumulator"]),
        before: "let front = Front(vec3<real>(x[0], x[1], x[1]), x[2]);
            let a = over(front, vec3<real>(x[3], x[4], x[4]), x[5]);
            let b = over_premultiplied(front, vec4<real>(x[3], x[4], x[4], x[5]));
            let c = opaque_behind(front, vec3<real>(x[3], x[4], x[4]));",
        results: &["a.rgb.x", "a.rgb.z", "a.opacity", "b.rgb.x", "b.rgb.z", "b.opacity", "c.rgb.z", "c.opacity"],
        ..ShaderKernel::default()
    };
    let truth = |&[r, g, a, r1, g1, a1]: &[f64; 6]| {
        let (w, through) = ((1.0 - a) * a1, 1.0 - a);
        let behind = [r + through * r1, g + through * g1, a + through * a1];
        [r + w * r1, g + w * g1, a + w, behind[0], behind[1], behind[2], behind[1], 1.0]
    };
    hold("over", errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0), 8.0 * U);
}

/// The background's colour is encoded, laid behind, and the sum decoded: three powers of 6 last places and a division.
#[test]
fn encoded_colours_are_laid_over_a_background() {
    let Some(gpu) = gpu() else { return };
    let mut next = random(16);
    let table: Vec<[f64; 4]> =
        (0..2000).map(|_| [next(), next(), 0.05 + 0.95 * next(), 0.05 + 0.95 * next()]).collect();
    let kernel = ShaderKernel {
        modules: modules(&["number/math", "number/color", "ray/accumulator", "ray/blend_srgb"]),
        before: "let c = over_background(Front(vec3<real>(x[0] * x[2]), x[2]), premultiply(vec4<real>(x[1], x[1], x[1], x[3])));",
        results: &["c.r", "c.a"],
        ..ShaderKernel::default()
    };
    let truth = |&[front, behind, a, b]: &[f64; 4]| {
        use drypoint::scene::color::{linear_to_srgb, srgb_to_linear};
        let opacity = a + (1.0 - a) * b;
        let sum = front * a + (1.0 - a) * linear_to_srgb(behind) * b;
        [srgb_to_linear(sum / opacity) * opacity, opacity]
    };
    hold("encoded", errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0), 64.0 * U);
}

/// Highlights of exponent s multiply the error of N·Ĥ by s.
#[test]
fn phong() {
    let Some(gpu) = gpu() else { return };
    for shininess in [0.0, 1.0, 10.0, 10.25] {
        let mut next = random(7);
        let light = unit(&mut next).map(|c| f64::from(c as f32));
        let mut table: Vec<[f64; 7]> = (0..2000)
            .map(|_| {
                let ([a, b, c], [d, e, f]) = (unit(&mut next), unit(&mut next));
                [a, b, c, d, e, f, next()]
            })
            .collect();
        // The terminator apart: highlights jump there.
        table.retain(|row| (row[0] * light[0] + row[1] * light[1] + row[2] * light[2]).abs() > 1e-4);
        let params =
            PhongParams { ambient: 0.25, diffuse: 0.5, specular: 0.375, shininess, light: DVec3::from_array(light) };
        let whole = format!("const WHOLE_SHININESS = {};\n", shininess.fract() == 0.0);
        let kernel = ShaderKernel {
            modules: format!(
                "{whole}{TYPES}{PLACE}{}",
                modules(&["number/arithmetic", "number/math", "shading/shading", "shading/shading_of_samples"])
            ),
            params: &[("ambient", 0.25), ("diffuse", 0.5), ("specular", 0.375), ("shininess", shininess)],
            vectors: &[("light", light)],
            before: "var ray: Ray; var sample: Sample;\nray.v = vec3<real>(x[3], x[4], x[5]);
                let a = Attributes(true, vec3<real>(x[0], x[1], x[2]));
                let lit = shade_phong(ray, sample, a, Shaded(vec3<real>(x[6]), 1.0));
                let unlit = shade_phong(ray, sample, Attributes(), Shaded(vec3<real>(x[6]), 1.0));",
            results: &["lit.rgb.y", "unlit.rgb.y"],
            ..ShaderKernel::default()
        };
        let phong = Phong::<f64>::new(&params);
        let truth = |&[a, b, c, d, e, f, color]: &[f64; 7]| {
            let (n, v) = (Vec3::new(a, b, c), Vec3::new(d, e, f));
            [phong.shade([color; 3], n, phong.half_vector(v))[1], color]
        };
        let found = errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0);
        hold("Phong", found, (16.0 + 24.0 * shininess) * U);
    }
}

/// Tones and silhouettes jump: places near their steps are left out. The exponent of opacities is a quotient.
#[test]
fn tones_silhouettes_and_exponents() {
    let Some(gpu) = gpu() else { return };
    let mut next = random(8);
    let light = unit(&mut next).map(|c| f64::from(c as f32));
    let tones = [-9.0, 0.25, 0.5, 0.75, 0.25, 0.5, 0.25, 1.0, 0.625, 1.0, 0.5, 0.125];
    let dot = |row: &[f64; 3]| row[0] * light[0] + row[1] * light[1] + row[2] * light[2];
    let mut table: Vec<[f64; 3]> = (0..2000).map(|_| unit(&mut next)).collect();
    table.retain(|row| {
        let x = dot(row);
        [0.25 - 0.125, 0.625 - 0.125].iter().all(|step: &f64| (x - step).abs() > 1e-4) && (x * x - 0.25).abs() > 1e-4
    });
    let names = ["number/arithmetic", "number/math", "ray/opacity"];
    let rooms = ["toon", "toon_of_samples", "silhouette", "silhouette_of_samples", "view_opacity"]
        .map(|name| format!("interactive_volume_illustration/{name}"));
    let names: Vec<&str> = names.into_iter().chain(rooms.iter().map(String::as_str)).collect();
    let kernel = ShaderKernel {
        modules: format!("const TONES = 3;\n{TYPES}{PLACE}{}", modules(&names)),
        params: &[("toon_offset", 0.125), ("silhouette_offset", 0.25), ("view_opacity", 0.75)],
        vectors: &[("light", light)],
        lists: &[(6, &tones)],
        before: "var ray: Ray; var sample: Sample;\nray.v = light();
            let a = Attributes(true, vec3<real>(x[0], x[1], x[2]));
            let shaded = Shaded(vec3<real>(0.5), 0.25);
            let black = shade_silhouette(ray, sample, a, shaded);",
        results: &[
            "shade_toon(ray, sample, a, shaded).rgb.x",
            "black.rgb.x",
            "view_exponent(dot(a.normal, ray.v))",
            "grow_opacity(ray, sample, a, shaded).alpha",
        ],
        ..ShaderKernel::default()
    };
    let truth = |row: &[f64; 3]| {
        let x = dot(row);
        let tone = if x + 0.125 > 0.625 {
            1.0
        } else if x + 0.125 > 0.25 {
            0.5
        } else {
            0.25
        };
        let exponent = 1.0 + 0.75 * (1.0 / x.abs().clamp(1.0 / 64.0, 1.0) - 1.0);
        let black = x * x + 0.25 <= 0.5;
        [0.5 * tone, if black { 0.0 } else { 0.5 }, exponent, -(exponent * (0.75f64).ln()).exp_m1()]
    };
    // 1/|N·V| up to 64 multiplies the error of the product, twice.
    hold("tones", errors(&gpu, &kernel, &table, truth, |_, t, _| t[2]), 512.0 * U);
}

/// Values before, between and beyond nodes, and on them; steps of the function apart, where f32 may be on the other side.
#[test]
fn values_between_nodes() {
    let Some(gpu) = gpu() else { return };
    let (at, opacity) = ([-0.5, -0.25, 0.0, 0.0, 0.5, 0.75], [0.25, 1.0, 0.5, 0.125, 0.75, 0.5]);
    let node = |k: usize| {
        let next = (k + 1).min(5);
        [at[k], if k < 5 { at[next] - at[k] } else { 1.0 }, opacity[k], opacity[next], k as f64]
    };
    let list: Vec<f64> = (0..6).flat_map(node).collect();
    let mut next = random(9);
    let mut table: Vec<[f64; 1]> = (0..2000).map(|_| [2.0 * next() - 1.0]).collect();
    table.extend(at.map(|at| [at]));
    let kernel = ShaderKernel {
        modules: format!("const NODES = 6;\n{}", modules(&["number/arithmetic", "transfer/piecewise"])),
        lists: &[(2, &list)],
        before: "let place = locate_value(x[0]);",
        results: &["real(place.node) + place.w", "place.alpha_u"],
        ..ShaderKernel::default()
    };
    let function = Piecewise::<f64>::new(&at, &opacity).unwrap();
    let truth = |&[s]: &[f64; 1]| {
        let place = function.locate(s).unwrap();
        [place.node as f64 + place.w, place.alpha_u]
    };
    hold("nodes", errors(&gpu, &kernel, &table, truth, |_, _, i| [8.0, 1.0][i]), 16.0 * U);
}

/// The pieces of B-splines and of Catmull and Rom's spline, with derivatives, against their sums of powers.
#[test]
fn weights_of_kernels() {
    let Some(gpu) = gpu() else { return };
    let table: Vec<[f64; 1]> = (0..=1000).map(|i| [f64::from(i) / 1000.0]).collect();
    let plus = |x: f64, n: i32| if x > 0.0 { x.powi(n) } else { 0.0 };
    // Sums of truncated powers: derivative k of the spline of degree n at x.
    let spline = move |n: i32, k: i32, x: f64| {
        let binomial = |m: i32| (0..m).fold(1.0, |b, i| b * f64::from(n + 1 - i) / f64::from(i + 1));
        let factorial = (1..=n - k).fold(1.0, |f, i| f * f64::from(i));
        let half = f64::from(n + 1) / 2.0;
        let term = |m: i32| if m % 2 == 0 { 1.0 } else { -1.0 } * binomial(m) * plus(x + half - f64::from(m), n - k);
        (0..=n + 1).map(term).sum::<f64>() / factorial
    };
    let catmull_rom = |k: usize, x: f64| {
        let (a, s) = (x.abs(), x.signum());
        match (k, a < 1.0, a < 2.0) {
            (0, true, _) => 1.5 * a * a * a - 2.5 * a * a + 1.0,
            (0, false, true) => -0.5 * a * a * a + 2.5 * a * a - 4.0 * a + 2.0,
            (1, true, _) => s * (4.5 * a * a - 5.0 * a),
            (1, false, true) => s * (-1.5 * a * a + 5.0 * a - 4.0),
            _ => 0.0,
        }
    };
    let results = |n: usize, orders: &[&str]| -> Vec<String> {
        orders.iter().flat_map(|order| (0..n).map(move |i| format!("taps.{order}[{i}]"))).collect()
    };
    for (name, module, taps, orders) in [
        ("cubic", "field/kernel/bspline_kernel", 4, 3),
        ("Catmull-Rom", "field/kernel/catmull_rom", 4, 2),
        ("quintic", "field/kernel/bspline5", 6, 3),
    ] {
        let results = results(taps, &["value", "first", "second"][..orders]);
        let results: Vec<&str> = results.iter().map(String::as_str).collect();
        let taps_type = "struct Taps { value: array<real, 6>, first: array<real, 6>, second: array<real, 6>, }\n";
        let text = format!("{taps_type}{}", modules(&["field/kernel/bspline", module]));
        let found = gpu_errors(&gpu, &text, &results, &table, |t, i| {
            let (order, tap) = (i / taps, i % taps);
            let x = t - (tap as f64 - (taps / 2 - 1) as f64);
            match name {
                "cubic" => spline(3, order as i32, x),
                "quintic" => spline(5, order as i32, x),
                _ => catmull_rom(order, x),
            }
        });
        hold(name, found, 64.0 * U);
    }
}

/// The largest errors of results against a function of the row's number and the place of the result.
fn gpu_errors(
    gpu: &drypoint::gpu::Gpu,
    text: &str,
    results: &[&str],
    table: &[[f64; 1]],
    truth: impl Fn(f64, usize) -> f64,
) -> [f64; 2] {
    use drypoint::gpu::Precision;
    let flat: Vec<f64> = table.iter().flatten().map(|&t| f64::from(t as f32)).collect();
    let kernel = ShaderKernel {
        modules: text.to_owned(),
        before: "let taps = kernel_taps(x[0]);",
        results,
        ..ShaderKernel::default()
    };
    [Precision::Double, Precision::Single].map(|precision| {
        if precision == Precision::Double && !gpu.has_double() {
            return 0.0;
        }
        let found = kernel.run(gpu, precision, 1, &flat).unwrap_or_else(|error| panic!("{error}"));
        let rows = flat.iter().zip(found.chunks_exact(results.len()));
        rows.flat_map(|(&t, row)| row.iter().enumerate().map(move |(i, &number)| (t, i, number)))
            .map(|(t, i, number)| (number - truth(t, i)).abs())
            .fold(0.0, f64::max)
    })
}

/// The part of a line that planes leave, by planes at random; one of them is parallel to some lines. A place between the
/// planes and beyond them.
#[test]
fn parts_that_planes_leave() {
    let Some(gpu) = gpu() else { return };
    let mut next = random(23);
    let grid = Grid::with_spacing([16; 3], [1.0; 3]).unwrap();
    let mut plane = |normal: [f64; 3]| {
        let point = DVec3::splat(6.0) + DVec3::from_array(unit(&mut next)) * 4.0;
        let plane = ClipPlane::in_index(point, DVec3::from_array(normal), &grid);
        let rounded = |x: f64| f64::from(x as f32);
        let index_normal = DVec3::from_array(plane.index_normal.to_array().map(rounded));
        ClipPlane { index_normal, index_offset: rounded(plane.index_offset), ..plane }
    };
    let planes = ClipPlanes(vec![plane([1.0, 0.5, -0.25]), plane([0.0, 0.0, 1.0]), plane([-0.75, 1.0, 0.5])]);
    let list: Vec<f64> = planes
        .0
        .iter()
        .flat_map(|plane| [plane.index_normal.to_array().as_slice(), &[plane.index_offset], &[0.0; 8]].concat())
        .collect();
    let mut next = random(24);
    let mut table: Vec<[f64; 6]> = Vec::new();
    for i in 0..3000 {
        let ([a, b, c], [d, e, f]) = (unit(&mut next), unit(&mut next));
        let along = if i % 5 == 0 { [d, e, 0.0] } else { [d, e, f] };
        table.push([6.0 + 6.0 * a, 6.0 + 6.0 * b, 6.0 + 6.0 * c, along[0], along[1], along[2]]);
    }
    let line = |&[a, b, c, d, e, f]: &[f64; 6]| [DVec3::new(a, b, c), DVec3::new(d, e, f)];
    // Lines almost parallel to a plane, and ends almost at one place, are decisions.
    let growths =
        |row: &[f64; 6]| planes.0.iter().map(|plane| plane.index_normal.dot(line(row)[1])).collect::<Vec<_>>();
    table.retain(|row| {
        let crossings: Vec<f64> =
            planes.0.iter().zip(growths(row)).map(|(plane, b)| -plane.beyond(line(row)[0]) / b).collect();
        let apart = |ends: [f64; 2]| (ends[0] - ends[1]).abs() > 1e-2;
        growths(row).iter().all(|b| *b == 0.0 || b.abs() > 0.05)
            && planes.0.iter().all(|plane| plane.beyond(line(row)[0]).abs() > 1e-2)
            && (0..3).all(|i| (0..i).all(|j| apart([crossings[i], crossings[j]])))
            && crossings.iter().all(|&t| !t.is_finite() || apart([t, -40.0]) && apart([t, 40.0]))
    });
    let kernel = ShaderKernel {
        modules: format!("const PLANES = 3;\n{}", modules(&["ray/ray", "ray/plane"])),
        vectors: &[("box_low", [0.0; 3]), ("box_high", [15.0; 3])],
        lists: &[(7, &list)],
        before: "var ray: Ray;
            ray.origin = vec3<real>(x[0], x[1], x[2]);
            ray.along = vec3<real>(x[3], x[4], x[5]);
            ray.depth_step = 1.0;
            let kept = kept_of(ray, -40.0, 40.0);
            let is_left = kept.start <= kept.end;",
        results: &[
            "select(real(0.0), real(1.0), is_left)",
            "select(real(0.0), kept.start, is_left)",
            "select(real(0.0), kept.end, is_left)",
            "select(real(-1.0), real(kept.entry), is_left)",
            "select(real(-1.0), real(kept.exit), is_left)",
            "select(real(0.0), real(1.0), is_cut(ray.origin))",
        ],
        ..ShaderKernel::default()
    };
    let truth = |row: &[f64; 6]| {
        let is_cut = f64::from(planes.cut(line(row)[0]));
        let place = |plane: Option<usize>| plane.map_or(-1.0, |plane| plane as f64);
        match planes.kept(line(row), [-40.0, 40.0]) {
            Some(kept) => [1.0, kept.range[0], kept.range[1], place(kept.entry), place(kept.exit), is_cut],
            None => [0.0, 0.0, 0.0, -1.0, -1.0, is_cut],
        }
    };
    // A distance of terms up to 40, over a growth of at least 1/20.
    hold("planes", errors(&gpu, &kernel, &table, truth, |_, _, _| 800.0), 16.0 * U);
}

/// A cap over a colour of its own.
#[test]
fn caps_over_colours() {
    let Some(gpu) = gpu() else { return };
    let mut next = random(25);
    let table: Vec<[f64; 3]> = (0..500).map(|_| [next(), next(), next()]).collect();
    let kernel = ShaderKernel {
        modules: format!("{TYPES}{PLACE}{}", modules(&["number/arithmetic", "surface/under_cap"])),
        before: "let covered = under_cap(Shaded(vec3<real>(x[0]), 1.0), Shaded(vec3<real>(x[1]), x[2]));",
        results: &["covered.rgb.y", "covered.alpha"],
        ..ShaderKernel::default()
    };
    let truth = |&[own, cap, opacity]: &[f64; 3]| [own + (cap - own) * opacity, 1.0];
    hold("caps", errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0), 4.0 * U);
}
