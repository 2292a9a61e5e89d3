//! Style transfer functions.

use super::{errors, gpu, modules, random};
use drypoint::gpu::{Gpu, ShaderKernel};
use drypoint::reference::number::Vec3;
use drypoint::reference::style_transfer_functions::{
    Blend, Blend2, Contour, Detail, Footprint, MipMap, SphereMap, Spheres, StyleIndex, contour, curvature_along_ray,
    frame, transparency,
};
use drypoint::reference::transfer::{NodePatch, NodePlace};
use drypoint::scene::math;
use drypoint::scene::shot::Turn;
use drypoint::scene::style::Style;
use drypoint::scene::tables::{Kappa, Mix, SphereFrame, Transparency};

/// Half a last place of 1 in f32: the error of one operation.
const U: f64 = 1.0 / (1u64 << 24) as f64;

/// Checks the errors of a table: those of f64 are rounding, those of f32 have a derived bound.
fn hold(name: &str, found: [f64; 2], single: f64) {
    println!("{name}: f64 {:.1e}, f32 {:.1e} of {single:.1e}", found[0], found[1]);
    assert!(found[0] <= 1e-13 && found[1] <= single, "{name}: {found:?}");
}

/// The lists that lookups of styles read.
struct Maps {
    texels: Vec<[f32; 4]>,
    maps: Vec<u32>,
    lambdas: Vec<f64>,
}

impl Maps {
    fn new(styles: &[Style]) -> Self {
        let (mut texels, mut maps): (Vec<[f32; 4]>, Vec<[u32; 4]>) = (Vec::new(), Vec::new());
        let mut add = |side: usize, of: &[[f64; 4]]| {
            texels.extend(of.iter().map(|texel| texel.map(|c| c as f32)));
            [(texels.len() - of.len()) as u32, side as u32, 0, 0]
        };
        maps.extend(styles.iter().map(|style| add(style.side, &style.texels)));
        let mut lambdas: Vec<f64> = styles.iter().map(|style| math::log2(style.side as f64)).collect();
        for (j, style) in styles.iter().enumerate() {
            let levels = style.mip_levels();
            [maps[j][2], maps[j][3]] = [maps.len() as u32, levels.len() as u32];
            for level in levels {
                maps.push(add(level.side, &level.texels));
                lambdas.push(level.lambda);
            }
        }
        Self { texels, maps: maps.into_flattened(), lambdas }
    }
}

/// Styles of random texels, of sides with and without a middle, and of one texel. Some are clear, some opaque.
fn styles() -> Vec<Style> {
    let mut next = random(11);
    let mut style = |side: usize| {
        let texels: Vec<[f64; 4]> = (0..side * side)
            .map(|_| {
                let alpha = [0.0, 1.0, next()][(3.0 * next()) as usize];
                [next(), next(), next(), alpha]
            })
            .collect();
        Style::from_straight("random", side, &texels, true).unwrap()
    };
    [1, 2, 5, 32].map(&mut style).into()
}

/// Normals on the disk, its middle and its rim among them.
fn normals(next: &mut impl FnMut() -> f64) -> Vec<[f64; 2]> {
    let mut all: Vec<[f64; 2]> = (0..600).map(|_| [2.0 * next() - 1.0, 2.0 * next() - 1.0]).collect();
    all.extend([[0.0, 0.0], [1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0], [0.6, 0.8], [0.5, -0.5], [-1.0, 1.0]]);
    all
}

/// The text of lookups, without mip-maps.
fn lookups(more: &[&str]) -> String {
    let before =
        ["number/arithmetic", "number/math", "number/bilinear", "number/color", "style_transfer_functions/sphere_map"];
    let stubs =
        "struct Ray { depth: real, depth_step: real, }\nstruct Sample { k: i32, offset: real, place: NodePlace, }
        struct Attributes { kappa: real, magnitude: real, }\nstruct NodePlace { node: i32, w: real, alpha_u: real, }
        const PERSPECTIVE = true;\nfn depth_of(ray: Ray, k: i32) -> real { return ray.depth; }\n";
    format!("{stubs}{}", modules(&[&before[..], more].concat()))
}

/// Bilinear lookups: coordinates carry 3S roundings, and texels are at most 1 apart along each axis.
#[test]
fn lookups_of_spheres() {
    let Some(gpu) = gpu() else { return };
    let (styles, mut next) = (styles(), random(1));
    let data = Maps::new(&styles);
    let maps: Vec<SphereMap> = styles.iter().map(SphereMap::new).collect();
    let table: Vec<[f64; 3]> =
        (0..styles.len()).flat_map(|j| normals(&mut next).into_iter().map(move |[x, y]| [j as f64, x, y])).collect();
    let kernel = ShaderKernel {
        modules: lookups(&["style_transfer_functions/mipmaps_none"]),
        texels: &[(10, &data.texels)],
        words: &[(11, &data.maps)],
        before: "let c = sft(i32(x[0]), vec2<real>(x[1], x[2]), 0.0);",
        results: &["c.r", "c.g", "c.b", "c.a"],
        ..ShaderKernel::default()
    };
    let found = errors(&gpu, &kernel, &table, |&[j, x, y]| maps[j as usize].sample(x, y), |_, _, _| 1.0);
    hold("sphere maps", found, (2.0 * 3.0 * 32.0 + 8.0) * U);
}

/// λ is split among levels, each of which is as the style itself; λ carries 2 roundings of log₂ S ≤ 5, and colours of
/// two levels are at most 1 apart.
#[test]
fn lookups_in_mip_maps() {
    let Some(gpu) = gpu() else { return };
    let (styles, mut next) = (styles(), random(2));
    let data = Maps::new(&styles);
    let maps: Vec<(SphereMap, MipMap<f64>)> = styles.iter().map(|s| (SphereMap::new(s), MipMap::new(s))).collect();
    let mut table = Vec::new();
    for j in 0..styles.len() {
        for [x, y] in normals(&mut next) {
            table.push([j as f64, x, y, 2.0 - 9.0 * next()]);
        }
        table.extend([-1e4, -5.0, -4.0, -3.0, -1.0, -0.5, 0.0, 3.0].map(|level| [j as f64, 0.3, -0.4, level]));
    }
    let kernel = ShaderKernel {
        modules: lookups(&["style_transfer_functions/mipmaps"]),
        params: &PARAMS,
        lists: &[(12, &data.lambdas)],
        texels: &[(10, &data.texels)],
        words: &[(11, &data.maps)],
        before: "let c = sft(i32(x[0]), vec2<real>(x[1], x[2]), x[3]);",
        results: &["c.r", "c.g", "c.b", "c.a"],
        ..ShaderKernel::default()
    };
    let truth = |&[j, x, y, level]: &[f64; 4]| {
        let (map, chain) = &maps[j as usize];
        chain.sample(map, x, y, level)
    };
    // Levels of a side of 5 are as little as log₂ 5/3 = 0.7 apart.
    let found = errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0);
    hold("mip-maps", found, (2.0 * 3.0 * 32.0 + 8.0 + (3.0 * 7.0 + 2.0) / 0.7) * U);
}

/// Parameters of the level of detail.
const PARAMS: [(&str, f64); 5] = [
    ("curvature_bias", 1.5),
    ("gradient_bias", 0.75),
    ("assumed_turn", 2.0 / 256.0),
    ("mip_voxel", 0.625),
    ("rays_in_voxel", 7.25),
];

/// λ − log₂ S: a relative error of 4 roundings in the logarithm's argument is one of 4/ln 2, absolute, and the logarithm has
/// 4 last places of its result, which is below 16.
#[test]
fn levels_of_detail() {
    let Some(gpu) = gpu() else { return };
    let mut next = random(3);
    let mut table: Vec<[f64; 3]> = (0..2000).map(|_| [0.1 + 50.0 * next(), 3.0 * next() - 1.0, next()]).collect();
    table.extend([[1.0, 0.0, 1.0], [1.0, 0.0, 0.0], [1e-3, 1e9, 0.5], [1e4, -1e9, 0.5]]);
    let kernel = ShaderKernel {
        modules: lookups(&["style_transfer_functions/mipmaps"]),
        params: &PARAMS,
        lists: &[(12, &[0.0])],
        texels: &[(10, &[[0.0; 4]])],
        words: &[(11, &[0, 1, 1, 0])],
        before: "let ray = Ray(x[0], 1.0);\nlet a = Attributes(x[1], x[2]);\nlet c = sft(0, vec2<real>(), 0.0).r;",
        results: &["level_below_last(ray, Sample(), a) + c"],
        ..ShaderKernel::default()
    };
    let [curvature_bias, gradient_bias, turn, voxel, rays] = PARAMS.map(|(_, value)| f64::from(value as f32));
    let footprint = Footprint::Perspective(rays);
    let detail = Detail { curvature_bias, gradient_bias, turn, voxel, footprint };
    let found =
        errors(&gpu, &kernel, &table, |&[depth, kappa, g]| [detail.below_last(depth, kappa, g)], |_, _, _| 16.0);
    hold("levels of detail", found, (6.0 + 8.0) * U);
}

/// The premultiplied and the printed mix of two and of four styles. Straight colours are quotients of numbers in [0, 1]
/// with an error of a lookup; where α_d is small they carry its relative error, which the product with α_d takes back.
#[test]
fn mixes_of_styles() {
    let Some(gpu) = gpu() else { return };
    // α_d is not below ½ here: what a quotient gains is at most 2.
    let mut next = random(4);
    let mut style = |side: usize| {
        let mut texel = || [next(), next(), next(), 0.5 + 0.5 * next()];
        let texels: Vec<[f64; 4]> = (0..side * side).map(|_| texel()).collect();
        Style::from_straight("random", side, &texels, true).unwrap()
    };
    let styles: Vec<Style> = [4, 7, 3].map(&mut style).into();
    let data = Maps::new(&styles);
    let of_node = [0, 1, 2, 0, 0, 2];
    let index = StyleIndex::new(&of_node);
    let mut next = random(5);
    let share = |next: &mut dyn FnMut() -> f64| if next() < 0.2 { 0.0 } else { next() };
    let mut table: Vec<[f64; 7]> = (0..3000)
        .map(|_| {
            let node = |next: &mut dyn FnMut() -> f64| (5.0 * next()).floor();
            let (below, above) = (node(&mut next), node(&mut next));
            let w = [share(&mut next), share(&mut next), share(&mut next)];
            [below, w[0], above, w[1], w[2], 2.0 * next() - 1.0, 2.0 * next() - 1.0]
        })
        .collect();
    // A value just below a node can round to the whole way.
    table.push([0.0, 1.0, 1.0, 1.0, 0.5, 0.2, 0.3]);
    for (mix, text) in [(Mix::Premultiplied, "lookup_mix_premultiplied"), (Mix::Printed, "lookup_mix_printed")] {
        let spheres = Spheres::new(&styles, mix);
        let text = format!("style_transfer_functions/{text}");
        let used = ["style_transfer_functions/mipmaps_none", "style_transfer_functions/lookup_index", &text];
        let rest = ["style_transfer_functions/lookup", "style_transfer_functions/lookup_over_value"];
        let patch = "struct NodePatch { below: NodePlace, above: NodePlace, w: real, alpha_u: real, }
            var<private> node_patch: NodePatch;\n";
        let two = modules(&["transfer/over/lookup_over_two"])
            .replace("fn style_between", "fn style_between_two")
            .replace("fn opacity_between", "fn opacity_between_two");
        let kernel = ShaderKernel {
            modules: format!("{}{patch}{two}", lookups(&[&used[..], &rest[..]].concat())),
            texels: &[(10, &data.texels)],
            words: &[(11, &data.maps), (3, &of_node.map(|j| j as u32))],
            before: "let n = vec2<real>(x[5], x[6]);
                let below = NodePlace(i32(x[0]), x[1], 0.5);
                node_patch = NodePatch(below, NodePlace(i32(x[2]), x[3], 0.5), x[4], 0.5);
                let one = style_between(Sample(0, 0.0, below), n, 0.0);
                let two = style_between_two(Sample(0, 0.0, below), n, 0.0);",
            results: &["one.r", "one.g", "one.b", "one.a", "two.r", "two.g", "two.b", "two.a"],
            ..ShaderKernel::default()
        };
        let truth = |&[below, wb, above, wa, w, nx, ny]: &[f64; 7]| {
            let place = |node: f64, w: f64| NodePlace { node: node as usize, w, alpha_u: 0.5 };
            let rows = [place(below, wb), place(above, wa)];
            let one: Blend<f64> = index.blend(&rows[0]);
            let [a, b, c, d] = spheres.lookup(&one, nx, ny);
            let [e, f, g, h] = spheres.lookup2(&Blend2::new(&index, &NodePatch { rows, w, alpha_u: 0.5 }), nx, ny);
            [a, b, c, d, e, f, g, h]
        };
        let found = errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0);
        // A lookup has (6S + 8) roundings; a quotient doubles it and a product adds both factors' errors.
        hold(&format!("{mix:?}"), found, 4.0 * (6.0 * 7.0 + 8.0 + 8.0) * U);
    }
}

/// The rotation of v onto +z: products and sums of numbers up to 2, and 1/(1 + v_z), at most 10 here.
#[test]
fn the_frame_of_the_view() {
    let Some(gpu) = gpu() else { return };
    let mut next = random(6);
    let mut table: Vec<[f64; 6]> = Vec::new();
    for i in 0..2000 {
        let v = unit([next() - 0.5, next() - 0.5, if i % 2 == 0 { next() } else { 0.1 * next() - 0.05 }]);
        let n = unit([next() - 0.5, next() - 0.5, next() - 0.5]);
        table.push([n[0], n[1], n[2], v[0], v[1], v[2]]);
    }
    table.push([0.6, 0.0, 0.8, 0.0, 0.0, 1.0]);
    let kernel = ShaderKernel {
        modules: modules(&["style_transfer_functions/frame_view"]),
        before: "let n = on_sphere(vec3<real>(x[0], x[1], x[2]), vec3<real>(x[3], x[4], x[5]));",
        results: &["n.x", "n.y", "n.z"],
        ..ShaderKernel::default()
    };
    let truth = |&[a, b, c, d, e, f]: &[f64; 6]| {
        let n = frame::on_sphere(SphereFrame::View, Vec3::new(a, b, c), Vec3::new(d, e, f));
        [n.x, n.y, n.z]
    };
    let found = errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0);
    hold("frame of the view", found, 24.0 * U);
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
    v.map(|c| c / length)
}

/// τ: the root is as steep as 1/τ at 0, where its argument is as small as its rounding.
#[test]
fn thresholds_of_contours() {
    let Some(gpu) = gpu() else { return };
    let mut next = random(7);
    let params = [("contour_thickness", 1.75), ("fade_low", 0.25), ("fade_width", 0.5)];
    let mut table: Vec<[f64; 2]> = (0..2000).map(|_| [2.0 * next() - 0.7, next()]).collect();
    table.extend([[0.0, 0.5], [1e9, 1.0], [-1e-9, 0.9], [0.571_428_6, 0.6], [0.5, 0.25], [0.5, 0.75]]);
    let kernel = ShaderKernel {
        modules: format!(
            "struct Attributes {{ kappa: real, magnitude: real, }}\n{}",
            modules(&[
                "number/arithmetic",
                "style_transfer_functions/contour_by_curvature",
                "style_transfer_functions/contour_fade"
            ])
        ),
        params: &params,
        results: &["contour_root(x[0])", "contour_fade(x[1])", "contour_threshold(Attributes(x[0], x[1]))"],
        ..ShaderKernel::default()
    };
    let faded = Contour::<f64>::new(1.75, Kappa::Ray, Some([0.25, 0.75]));
    let truth = |&[kappa, g]: &[f64; 2]| [contour::root(kappa), contour::fade(g, 0.25, 0.75), faded.tau(kappa, g)];
    // x(2 − x) is within 3 roundings of itself, and its root within 2. A fade has t within 2, and at most 5 more.
    let found = errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0);
    hold("thresholds", found, 12.0 * U);
    // A step, which |g| = lo has passed.
    let kernel =
        ShaderKernel { params: &[("contour_thickness", 1.0), ("fade_low", 0.5), ("fade_width", 0.0)], ..kernel };
    let table = [0.49, 0.5, 0.51].map(|g| [0.3, g]);
    let step = Contour::<f64>::new(1.0, Kappa::Ray, Some([0.5, 0.5]));
    let truth = |&[kappa, g]: &[f64; 2]| [contour::root(kappa), contour::fade(g, 0.5, 0.5), step.tau(kappa, g)];
    hold("steps", errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0), 12.0 * U);
}

/// The push: r and δ have relative errors of 3 and 1 roundings, the quotient of 5.
#[test]
fn pushes_of_contours() {
    let Some(gpu) = gpu() else { return };
    let mut next = random(8);
    let mut table: Vec<[f64; 4]> = (0..2000)
        .map(|_| {
            let (r, turn) = (next().sqrt(), 6.3 * next());
            [r * turn.cos(), r * turn.sin(), next(), next()]
        })
        .collect();
    // Off the contour, on its border, τ = 0, the middle, the silhouette.
    table.extend([[0.4, 0.1, 0.75, 0.5], [0.4, 0.3, 0.5, 0.5], [0.6, 0.8, 0.0, 0.0], [0.0, 0.0, 0.0, 0.5]]);
    table.extend([[0.4, 0.1, 0.0, 0.5], [0.0, 0.0, 1.0, 1.0], [0.6, 0.8, 0.25, 0.5]]);
    let kernel = ShaderKernel {
        modules: modules(&["style_transfer_functions/contour"]),
        before: "let n = pushed(vec2<real>(x[0], x[1]), x[2], x[3]);",
        results: &["n.x", "n.y"],
        ..ShaderKernel::default()
    };
    let truth = |&[x, y, d, tau]: &[f64; 4]| <[f64; 2]>::from(contour::push(x, y, d, tau));
    hold("pushes", errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0), 6.0 * U);
}

/// α/α_d: x^y carries the error of y ln x, of 3 roundings of y and 4 last places of the logarithm, absolute.
#[test]
fn illustrative_transparency() {
    let Some(gpu) = gpu() else { return };
    let mut next = random(9);
    let mut table: Vec<[f64; 4]> = (0..3000).map(|_| [next().powi(3), next(), next(), next()]).collect();
    table.extend([[0.0, 0.5, 0.2, 0.3], [1.0, 0.5, 0.2, 0.3], [0.25, 0.1, 0.9, 0.0], [0.25, 1.0, 0.0, 0.0]]);
    let kernel = ShaderKernel {
        modules: modules(&["number/math", "style_transfer_functions/transparency_illustrative"]),
        results: &["opacity_share(x[0], x[1], x[2], x[3])"],
        ..ShaderKernel::default()
    };
    let truth = |&[a, d, tau, g]: &[f64; 4]| [transparency::share(Transparency::Illustrative, a, d, tau, g)];
    // α^y |ln α|·1.5 is below 1.2 for y ≥ ½.
    hold("transparency", errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0), (1.2 * (3.0 + 8.0) + 8.0) * U);
    // Its two constraints hold exactly.
    let exact = kernel.run(&gpu, drypoint::gpu::Precision::Single, 4, &[0.0, 0.5, 0.2, 0.3, 1.0, 0.5, 0.2, 0.3]);
    assert_eq!(exact.unwrap(), [0.0, 1.0]);
}

/// The normal at the sample before, beside the normal: ‖a × b‖ is within 5 roundings of 1, as the cosine is, and so is the
/// angle, over a distance.
#[test]
fn turns_along_a_ray() {
    let Some(gpu) = gpu() else { return };
    let mut next = random(10);
    let mut table: Vec<[f64; 7]> = Vec::new();
    for i in 0..2000 {
        let near = [1.0, 0.1, 1e-3][i % 3];
        let n = [next() - 0.5, next() - 0.5, next() - 0.5];
        let before = unit([n[0] + near * (next() - 0.5), n[1] + near * (next() - 0.5), n[2]]);
        let n = unit(n);
        table.push([n[0], n[1], n[2], before[0], before[1], before[2], 0.25 + next()]);
    }
    table.push([0.6, 0.0, 0.8, 0.6, 0.0, 0.8, 0.5]);
    table.push([0.6, 0.0, 0.8, -0.6, 0.0, -0.8, 0.5]);
    for (turn, text) in
        [(Turn::OfNormals, "curvature_along_ray_of_normals"), (Turn::OfLines, "curvature_along_ray_of_lines")]
    {
        turns(&gpu, turn, text, &table);
    }
}

fn turns(gpu: &Gpu, turn: Turn, text: &str, table: &[[f64; 7]]) {
    // The function of two normals alone.
    let whole = modules(&["style_transfer_functions/curvature_along_ray"]);
    let from = whole.find("// The angle between two normals").unwrap();
    let function = &whole[from..whole.find("// kappa is 0 unless").unwrap()];
    let kernel = ShaderKernel {
        modules: format!("{}{function}", modules(&["number/math", &format!("style_transfer_functions/{text}")])),
        results: &["turn_along_ray(vec3<real>(x[0], x[1], x[2]), vec3<real>(x[3], x[4], x[5]), x[6])"],
        ..ShaderKernel::default()
    };
    let truth = |&[a, b, c, d, e, f, way]: &[f64; 7]| {
        [curvature_along_ray::kappa(turn, Vec3::new(a, b, c), Vec3::new(d, e, f), true, way)]
    };
    let found = errors(gpu, &kernel, table, truth, |&[.., way], _, _| std::f64::consts::PI / way);
    hold(text, found, 12.0 * U);
}
