//! Lighting transfer functions.

use super::{errors, gpu, modules, random};
use drypoint::gpu::ShaderKernel;
use drypoint::reference::number::Vec3;
use drypoint::reference::volumeshop::LightingFunction;
use drypoint::scene::glam::DVec3;
use drypoint::scene::lighting::LightingTable;
use drypoint::scene::shot::{LightingParams, LightingSource};
use std::sync::Arc;

/// Half a last place of 1 in f32: the error of one operation.
const U: f64 = 1.0 / (1u64 << 24) as f64;

/// The types of samples, as far as these functions read them.
const TYPES: &str = "struct Ray { v: vec3<real>, }\nstruct Sample { k: i32, }
    struct Attributes { has_normal: bool, normal: vec3<real>, magnitude: real, }
    struct Shaded { rgb: vec3<real>, alpha: real, }\n";

/// Tables of several sizes, of one cell among them, at random normals and at light from behind. A cosine carries 8 roundings,
/// and a cell is at most 1 from the next one along each axis; eq. 8 divides by at least ¼.
#[test]
fn lighting_tables() {
    let Some(gpu) = gpu() else { return };
    for [width, height] in [[1, 1], [1, 5], [4, 1], [9, 6], [33, 33]] {
        let mut next = random(11);
        let unit = |next: &mut dyn FnMut() -> f64| {
            DVec3::new(next() - 0.5, next() - 0.5, next() - 0.5).normalize().to_array().map(|c| f64::from(c as f32))
        };
        let light = unit(&mut next);
        let cells: Vec<[f64; 4]> =
            (0..width * height).map(|_| [next(), next(), next(), next()].map(|c| f64::from(c as f32))).collect();
        let mut table: Vec<[f64; 9]> = (0..2000)
            .map(|_| {
                let ([a, b, c], [d, e, f]) = (unit(&mut next), unit(&mut next));
                [a, b, c, d, e, f, next(), next(), next()]
            })
            .collect();
        let [x, y, z] = light;
        table.push([0.6, 0.8, 0.0, -x, -y, -z, 0.5, 0.25, 0.75]);
        table.push([x, y, z, x, y, z, 0.5, 0.25, 1.0]);
        let lighting = LightingTable::new(width, height, cells.clone()).unwrap();
        let source = LightingSource::File { path: "table.png".into(), table: Arc::new(lighting) };
        let params = LightingParams { source, divisor_floor: 0.25, light: DVec3::from_array(light) };
        let function = LightingFunction::<f64>::new(&params);
        let sizes = format!("const LIGHTING_WIDTH: i32 = {width};\nconst LIGHTING_HEIGHT: i32 = {height};\n");
        let kernel = ShaderKernel {
            modules: format!(
                "{sizes}{TYPES}{}",
                modules(&["number/arithmetic", "number/bilinear", "volumeshop/lighting"])
            ),
            params: &[("divisor_floor", 0.25)],
            vectors: &[("light", light)],
            lists: &[(24, cells.as_flattened())],
            before: "var ray: Ray; var sample: Sample;\nray.v = vec3<real>(x[3], x[4], x[5]);
                let a = Attributes(true, vec3<real>(x[0], x[1], x[2]), x[8]);
                let c_u = Shaded(vec3<real>(x[6]), x[7]);
                let lit = shade_by_table(ray, sample, a, c_u);
                let unlit = shade_by_table(ray, sample, Attributes(), c_u);",
            results: &["lit.rgb.y", "lit.alpha", "unlit.rgb.y", "unlit.alpha"],
            ..ShaderKernel::default()
        };
        let truth = |&[a, b, c, d, e, f, color, alpha, magnitude]: &[f64; 9]| {
            let (n, v) = (Vec3::new(a, b, c), Vec3::new(d, e, f));
            let found = function.reflectance(n, function.half_vector(v));
            [found.color([color; 3])[1], function.opacity(alpha, &found, magnitude), color, alpha]
        };
        let found = errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0);
        let bound = (3.0 * 8.0 * width.max(height) as f64 + 32.0) * 16.0 * U;
        println!("{width} × {height}: f64 {:.1e}, f32 {:.1e} of {bound:.1e}", found[0], found[1]);
        assert!(found[0] <= 1e-12 && found[1] <= bound, "{width} × {height}: {found:?}");
    }
}
