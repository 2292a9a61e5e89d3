//! Curvatures, and roots of cubics.

use super::{errors, gpu, modules, random};
use drypoint::gpu::ShaderKernel;
use drypoint::reference::field::Outside;
use drypoint::reference::field::curvature::{along_view, principal};
use drypoint::reference::number::{Sym3, Vec3};

/// A gradient, a Hessian (xx, yy, zz, yz, xz, xy) and a direction to the eye.
type Row = [f64; 12];

fn parts(&[gx, gy, gz, xx, yy, zz, yz, xz, xy, vx, vy, vz]: &Row) -> (Vec3<f64>, Sym3<f64>, Vec3<f64>) {
    (Vec3::new(gx, gy, gz), Sym3 { xx, xy, xz, yy, yz, zz }, Vec3::new(vx, vy, vz))
}

/// Entries of a form in unit vectors are below the Hessian's norm, and a form has about 20 roundings. The direction Pv is
/// known to ε/‖Pv‖.
#[test]
fn curvatures() {
    let Some(gpu) = gpu() else { return };
    let mut next = random(5);
    let mut table: Vec<Row> = (0..4000).map(|_| std::array::from_fn(|_| 2.0 * next() - 1.0)).collect();
    // Normals along the axes, where the frame turns over; exact umbilics; a view along the normal.
    for g in [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.0, -0.5, -1e-6]] {
        for h in [[-1.0, -1.0, -1.0, 0.0, 0.0, 0.0], [0.5, 0.25, 1.0, 0.125, -0.5, 0.75], [0.0; 6]] {
            for v in [[0.0, 0.0, 1.0], [0.6, 0.0, 0.8], [1.0, 0.0, 0.0]] {
                table.push([g.as_slice(), &h, &v].concat().try_into().unwrap());
            }
        }
    }
    let across = |row: &Row| {
        let (g, _, v) = parts(row);
        v.cross(g).length() / g.length()
    };
    table.retain(|row| across(row) == 0.0 || across(row) > 1e-3);
    let kernel = ShaderKernel {
        modules: modules(&[
            "number/arithmetic",
            "field/gradient/still",
            "field/gradient/normal",
            "field/hessian/second",
            "field/hessian/curvature",
        ]) + "struct Place { cell: vec3<i32>, w: vec3<real> }
            fn index_gradient(at: Place) -> vec3<real> { return at.w; }",
        params: &[
            ("no_normal_below", 0.0),
            ("outwards", -1.0),
            ("facing", 0.0),
            ("outside_sign", -1.0),
            ("curvature_unit", 1.0),
            ("no_direction", 1.0 / 4096.0),
        ],
        vectors: &[("to_world_x", [1.0, 0.0, 0.0]), ("to_world_y", [0.0, 1.0, 0.0]), ("to_world_z", [0.0, 0.0, 1.0])],
        before: "let g = vec3<real>(x[0], x[1], x[2]);
            let second = Second(g, vec3<real>(x[3], x[4], x[5]), vec3<real>(x[6], x[7], x[8]));
            let shape = world_shape(g, second);
            let k = principal_curvatures(shape);",
        results: &["curvature_along_view(shape, vec3<real>(x[9], x[10], x[11]))", "k.x", "k.y"],
        ..ShaderKernel::default()
    };
    let truth = |row: &Row| {
        let (g, h, v) = parts(row);
        let c = principal(g, h, Outside::Low);
        [along_view(g, h, v, Outside::Low), c.k1, c.k2]
    };
    let scale = |row: &Row, _: &[f64; 3], i: usize| {
        let (g, h, _) = parts(row);
        let norm = [h.xx, h.yy, h.zz, h.xy, h.xy, h.xz, h.xz, h.yz, h.yz].iter().map(|x| x * x).sum::<f64>().sqrt();
        let sine = across(row);
        norm.max(1e-3) / g.length() * if i == 0 && sine > 0.0 { 1.0 + 1.0 / sine } else { 1.0 }
    };
    let found = errors(&gpu, &kernel, &table, truth, scale);
    println!("curvatures: {found:?}");
    assert!(found[0] <= 1e-13 && found[1] <= 24.0 * f64::from(f32::EPSILON), "{found:?}");
}

/// The cubic a·(u − r)(u − s)(u − t) by its Bernstein coefficients: the first of its roots in [0, 1], or 2. The error of a
/// root is the rounding of values, some ε of the largest coefficient, over the slope there.
#[test]
fn first_roots_of_cubics() {
    let Some(gpu) = gpu() else { return };
    let mut next = random(9);
    let mut table: Vec<[f64; 3]> = (0..4000).map(|_| std::array::from_fn(|_| 3.0 * next() - 1.0)).collect();
    table.extend([[0.5, 5.0, 9.0], [0.0, 0.5, 1.0], [2.0, 3.0, 4.0], [-1.0, -2.0, -3.0], [0.25, 0.5, 0.75]]);
    // Roots at the ends or close together part by rounding, which is a decision.
    let apart = |a: f64, b: f64| (a - b).abs() > 0.02;
    table.retain(|&[r, s, t]| apart(r, s) && apart(s, t) && apart(r, t));
    table.retain(|row| row.iter().all(|&r| r == 0.0 || (apart(r, 0.0) && apart(r, 1.0))));
    let cubic = "let s0 = -(x[0] * x[1] * x[2]);
        let s1 = x[0] * x[1] + x[0] * x[2] + x[1] * x[2];
        let s2 = -(x[0] + x[1] + x[2]);
        let b = vec4<real>(s0, s0 + s1 / 3.0, s0 + (2.0 * s1 + s2) / 3.0, s0 + s1 + s2 + 1.0);
        cell_cubic = b;";
    let along = "var<private> cell_cubic: vec4<real>;
        fn along_cell(u: real) -> real { return cubic_at(cell_cubic, u); }";
    let kernel = ShaderKernel {
        modules: modules(&["surface/cubic", "surface/cubic_bracket"]) + along,
        before: cubic,
        results: &["first_root_of(b)"],
        ..ShaderKernel::default()
    };
    let truth = |row: &[f64; 3]| [row.iter().copied().filter(|r| (0.0..=1.0).contains(r)).fold(2.0, f64::min)];
    let scale = |&[r, s, t]: &[f64; 3], &[root]: &[f64; 1], _| {
        let others: Vec<f64> = [r, s, t].into_iter().filter(|&x| x != root).map(|x| (root - x).abs()).collect();
        let largest = [r, s, t].iter().map(|x| 1.0 + x.abs()).product::<f64>();
        if others.len() == 2 { largest / (others[0] * others[1]) } else { 1.0 }
    };
    let found = errors(&gpu, &kernel, &table, truth, scale);
    println!("roots: {found:?}");
    assert!(found[0] <= 1e-13 && found[1] <= 16.0 * f64::from(f32::EPSILON), "{found:?}");
}
