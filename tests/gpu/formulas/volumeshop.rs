//! Sets, ghosting and intersections of objects.

use super::{errors, gpu, modules, random};
use drypoint::gpu::ShaderKernel;
use drypoint::reference::volumeshop::fuzzy::{difference as minus, intersection, union};
use drypoint::reference::volumeshop::ghosting::{enhancement as spared, factor};
use drypoint::reference::volumeshop::{ObjectSet, Shares, combined, intersections};
use drypoint::scene::intersection_picture::IntersectionPicture;
use drypoint::scene::shot::{Dab, Fuzzy, IntersectionOpacity};

/// Half a last place of 1 in f32: the error of one operation.
const U: f64 = 1.0 / (1u64 << 24) as f64;

/// The types of samples, as far as these functions read them.
const TYPES: &str = "struct Sample { k: i32, }\nstruct Attributes { has_normal: bool, }
    struct Shaded { rgb: vec3<real>, alpha: real, }\n";

/// The modules of sets by either operator, with room for four objects and their sets.
fn sets_by(operators: Fuzzy) -> String {
    let product = operators == Fuzzy::Product;
    let constants = format!("const PRODUCT = {product};\nconst OBJECTS = 4;\nconst SETS = 4;\n");
    let files = ["number/arithmetic", "volumeshop/fuzzy", "volumeshop/shares", "volumeshop/sets"];
    TYPES.to_owned() + &constants + &modules(&files)
}

/// Rows of memberships: random ones, and corners.
fn memberships() -> Vec<[f64; 6]> {
    let mut next = random(5);
    let mut table: Vec<[f64; 6]> = (0..3000).map(|_| std::array::from_fn(|_| next())).collect();
    for i in 0..64 {
        table.push(std::array::from_fn(|bit| f64::from(i >> bit & 1)));
    }
    table.push([0.5; 6]);
    table
}

/// The operators, the shares beside three selections, and four sets together, two of which share what is there. Each result
/// carries at most 12 roundings of numbers up to 3; colours are divided by a weight of at least 2⁻⁶.
#[test]
fn sets_by_either_operator() {
    let Some(gpu) = gpu() else { return };
    for operators in [Fuzzy::Zadeh, Fuzzy::Product] {
        let mut table = memberships();
        table.retain(|row| row[..4].iter().sum::<f64>() > 1.0 / 64.0);
        let kernel = ShaderKernel {
            modules: sets_by(operators),
            before: "memberships = array<real, OBJECTS>(0.0, x[0], x[1], x[2]);
                let shares = shares_beside();
                sets[0] = ObjectSet(vec3<real>(x[4]), x[0], true);
                sets[1] = ObjectSet(vec3<real>(0.25), x[2], false);
                sets[2] = ObjectSet(vec3<real>(x[5]), x[1], true);
                sets[3] = ObjectSet(vec3<real>(1.0), x[3], false);
                let all = combined();",
            results: &[
                "both(x[0], x[1])",
                "either(x[0], x[1])",
                "without(x[0], x[1])",
                "shares.background",
                "shares.of_each",
                "all.rgb.y",
                "all.alpha",
            ],
            ..ShaderKernel::default()
        };
        let truth = |&[a, b, c, d, e, f]: &[f64; 6]| {
            let shares = Shares::beside(operators, [a, b, c].into_iter());
            let set = |mu, color, shares| ObjectSet { rgb: [color; 3], mu, shares };
            let sets = [set(a, e, true), set(b, f, true), set(c, 0.25, false), set(d, 1.0, false)];
            let (rgb, alpha) = combined(operators, sets.into_iter());
            [
                intersection(operators, a, b),
                union(operators, a, b),
                minus(operators, a, b),
                shares.background,
                shares.of_each,
                rgb[1],
                alpha,
            ]
        };
        let found = errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0);
        println!("{operators:?}: f64 {:.1e}, f32 {:.1e} of {:.1e}", found[0], found[1], 36.0 * U);
        assert!(found[0] <= 1e-14 && found[1] <= 36.0 * U, "{operators:?}: {found:?}");
    }
}

/// Places without members are transparent.
#[test]
fn nothing_together_is_transparent() {
    let Some(gpu) = gpu() else { return };
    let kernel = ShaderKernel {
        modules: sets_by(Fuzzy::Zadeh),
        before: "sets[1] = ObjectSet(vec3<real>(x[0]), 0.0, true);
            sets[2] = ObjectSet(vec3<real>(x[0]), 0.0, false);
            let all = combined();",
        results: &["all.rgb.x", "all.alpha"],
        ..ShaderKernel::default()
    };
    let found = errors(&gpu, &kernel, &[[0.0], [0.5]], |_| [0.0; 2], |_, _, _| 1.0);
    assert_eq!(found, [0.0; 2]);
}

/// Ghosting with its enhancement, the opacities of all presets, and means of colours by opacities of at least 2⁻⁶.
#[test]
fn ghosting_and_intersections() {
    let Some(gpu) = gpu() else { return };
    let mut table = memberships();
    table.retain(|row| row[0] + row[1] > 1.0 / 64.0);
    let presets = [
        IntersectionOpacity::Max,
        IntersectionOpacity::Over,
        IntersectionOpacity::In,
        IntersectionOpacity::Out,
        IntersectionOpacity::Atop,
        IntersectionOpacity::Xor,
        IntersectionOpacity::Plus,
    ];
    let kernel = ShaderKernel {
        modules: TYPES.to_owned() + &modules(&["number/arithmetic", "volumeshop/ghosting", "volumeshop/intersections"]),
        before: "let e = enhancement_of(x[2], x[3]);
            let mean = mean_color(Shaded(vec3<real>(x[4]), x[0]), Shaded(vec3<real>(x[5]), x[1]), x[2]);
            let none = mean_color(Shaded(vec3<real>(x[4]), 0.0), Shaded(vec3<real>(x[5]), 0.0), x[2]);
            let own = of_color(vec3<real>(x[4]), x[0], x[1]);",
        results: &[
            "opacity_of_both(0, x[0], x[1])",
            "opacity_of_both(1, x[0], x[1])",
            "opacity_of_both(2, x[0], x[1])",
            "opacity_of_both(3, x[0], x[1])",
            "opacity_of_both(4, x[0], x[1])",
            "opacity_of_both(5, x[0], x[1])",
            "opacity_of_both(6, x[0], x[1])",
            "e",
            "ghosting_factor(x[4], e)",
            "mean.rgb.z",
            "mean.alpha",
            "none.alpha",
            "own.alpha",
        ],
        ..ShaderKernel::default()
    };
    let truth = |&[a, b, c, d, e, f]: &[f64; 6]| {
        let mut all = [0.0; 13];
        for (found, preset) in all.iter_mut().zip(presets) {
            *found = intersections::opacity(preset, a, b);
        }
        let enhancement = spared(c, d);
        let mean = intersections::mean(([e; 3], a), ([f; 3], b)).unwrap_or([0.0; 3]);
        all[7..].copy_from_slice(&[enhancement, factor(e, enhancement), mean[2], c, 0.0, a * b]);
        all
    };
    let found = errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0);
    println!("intersections: f64 {:.1e}, f32 {:.1e} of {:.1e}", found[0], found[1], 12.0 * U);
    assert!(found[0] <= 1e-15 && found[1] <= 12.0 * U, "{found:?}");
}

/// Pictures of several sizes, one behind the other, within their ranges and beyond.
#[test]
fn pictures_of_intersections() {
    let Some(gpu) = gpu() else { return };
    for size in [[1, 1], [1, 4], [5, 1], [7, 3]] {
        let mut next = random(9);
        let pixels: Vec<[f64; 4]> =
            (0..size[0] * size[1] + 2).map(|_| std::array::from_fn(|_| f64::from(next() as f32))).collect();
        let mut table: Vec<[f64; 2]> = (0..1000).map(|_| [next() * 1.5 - 0.25, next() * 1.5 - 0.25]).collect();
        table.extend([[0.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.5, 0.5]]);
        let at = format!("let found = intersection_at(2, {}, {}, x[0], x[1]);", size[0], size[1]);
        let kernel = ShaderKernel {
            modules: modules(&["number/arithmetic", "number/bilinear", "volumeshop/intersections_picture"]),
            lists: &[(25, pixels.as_flattened())],
            before: &at,
            results: &["found.r", "found.g", "found.b", "found.a", "share_of_range(x[0], 0.25, 0.5)"],
            ..ShaderKernel::default()
        };
        // Two pixels of another picture come first.
        let picture = IntersectionPicture { size, pixels: pixels[2..].to_vec(), has_opacity: true };
        let truth = |&[x, y]: &[f64; 2]| {
            let [r, g, b, a] = intersections::pictured(&picture, [x, y]);
            [r, g, b, a, (x - 0.25) / 0.5]
        };
        let found = errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0);
        println!("{size:?}: f64 {:.1e}, f32 {:.1e}", found[0], found[1]);
        assert!(found[0] <= 1e-15 && found[1] <= 32.0 * U, "{size:?}: {found:?}");
    }
}

/// Two dabs over colours and opacities of at least 2⁻⁶, at the centres, around them and far beyond.
///
/// With y the exponent, w has a relative error of 4y + 4 roundings. The share s = w/α' has s(1 − s) ≤ ¼ of this error, below
/// 6 roundings as y < 5 where s is not small, and 6 more of its own and of the mixture. The second dab adds as many, and ¼ of
/// the relative error of α below it: 32 in all.
#[test]
fn dabs_of_intersections() {
    let Some(gpu) = gpu() else { return };
    let dabs = [
        Dab { at: [0.25, 0.75], width: [0.25, 0.5], color: [1.0, 0.25, 0.0, 0.75] },
        Dab { at: [0.5, 0.5], width: [0.125, 0.0625], color: [0.0, 0.5, 1.0, 1.0] },
    ];
    // One number of another table comes first.
    let mut numbers = vec![7.0; 4];
    for Dab { at, width, color } in dabs {
        numbers.extend(at.into_iter().chain(width).chain(color));
    }
    let mut table = memberships();
    table.retain(|row| row[1] > 1.0 / 64.0);
    for row in &mut table {
        [row[2], row[3]] = [row[2], row[3]].map(|value| 2.0 * value - 0.5);
    }
    table.extend([[0.5, 0.5, 0.25, 0.75, 0.0, 0.0], [0.5, 0.5, 1e30, -1e30, 0.0, 0.0]]);
    let kernel = ShaderKernel {
        modules: TYPES.to_owned()
            + &modules(&[
                "number/arithmetic",
                "number/math",
                "number/bilinear",
                "volumeshop/intersections_picture",
                "volumeshop/intersections_dabs",
            ]),
        lists: &[(25, &numbers)],
        before: "let top = painted_by_all(Shaded(vec3<real>(x[0], x[4], x[5]), x[1]), 1, 2, vec2<real>(x[2], x[3]));",
        results: &["top.rgb.x", "top.rgb.y", "top.rgb.z", "top.alpha"],
        ..ShaderKernel::default()
    };
    let truth = |&[r, alpha, v, w, g, b]: &[f64; 6]| {
        let under = ([r, g, b], alpha);
        let ([r, g, b], alpha) = dabs.iter().fold(under, |under, dab| intersections::painted(under, dab, [v, w]));
        [r, g, b, alpha]
    };
    let found = errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0);
    println!("dabs: f64 {:.1e}, f32 {:.1e} of {:.1e}", found[0], found[1], 32.0 * U);
    assert!(found[0] <= 1e-14 && found[1] <= 32.0 * U, "{found:?}");
}
