//! Triangles of meshes, the boxes about them and their normals ([VS-12]).

use super::{errors, gpu, modules, random};
use drypoint::gpu::ShaderKernel;
use drypoint::scene::glam::DVec3;

/// Half a last place of 1 in f32: the error of one operation.
const U: f64 = 1.0 / (1u64 << 24) as f64;

fn vector(next: &mut impl FnMut() -> f64) -> DVec3 {
    DVec3::new(next() - 0.5, next() - 0.5, next() - 0.5) * 2.0
}

/// Three numbers of a row as a vector.
fn at(row: &[f64], i: usize) -> DVec3 {
    DVec3::from_slice(&row[3 * i..])
}

const HIT: &str = "let line = sheared_ray(vec3<real>(x[0], x[1], x[2]), vec3<real>(x[3], x[4], x[5]));
    let p = vec3<real>(x[6], x[7], x[8]);
    let q = vec3<real>(x[9], x[10], x[11]);
    let r = vec3<real>(x[12], x[13], x[14]);";

/// The plane of a triangle is met at t = n·(p − o)/n·d, and the weights are areas over the whole one, along n. A coordinate, an
/// area, a weight and the sum carry about 30 roundings, and triangles here are no smaller than a fifth of their bounds.
#[test]
fn triangles_are_met_at_their_closed_form() {
    let Some(gpu) = gpu() else { return };
    let mut next = random(21);
    let mut table: Vec<[f64; 15]> = Vec::new();
    while table.len() < 4000 {
        let [p, q, r] = [0, 1, 2].map(|_| vector(&mut next));
        // From near a corner to far outside.
        let weights = DVec3::new(next(), next(), next()) * 1.6 - 0.4;
        let weights = weights / weights.element_sum();
        let (n, d) = ((q - p).cross(r - p), vector(&mut next));
        let is_clear = weights.abs().min_element() > 0.01 && weights.abs().max_element() < 3.0;
        if !is_clear || n.length() < 0.5 || n.dot(d).abs() < 0.3 * n.length() * d.length() || d.length() < 0.2 {
            continue;
        }
        let o = p * weights.x + q * weights.y + r * weights.z - d * (next() * 6.0 - 1.0);
        let row: Vec<f64> = [o, d, p, q, r].iter().flat_map(|v| v.to_array()).collect();
        table.push(row.try_into().unwrap());
    }
    let kernel = ShaderKernel {
        modules: modules(&["mesh/triangle"]),
        before: &format!("{HIT}\nlet hit = triangle_hit(line, p, q, r);"),
        results: &[
            "select(real(0.0), real(1.0), hit.is_met)",
            "hit.t",
            "hit.weights.x",
            "hit.weights.y",
            "hit.weights.z",
        ],
        ..ShaderKernel::default()
    };
    let truth = |row: &[f64; 15]| {
        let [o, d, p, q, r] = [0, 1, 2, 3, 4].map(|i| at(row, i));
        let n = (q - p).cross(r - p);
        let t = n.dot(p - o) / n.dot(d);
        let place = o + d * t;
        let share = |a: DVec3, b: DVec3| (a - place).cross(b - place).dot(n) / n.length_squared();
        let weights = [share(q, r), share(r, p), share(p, q)];
        if weights.iter().any(|&w| w < 0.0) { [0.0; 5] } else { [1.0, t, weights[0], weights[1], weights[2]] }
    };
    let met = table.iter().filter(|row| truth(row)[0] == 1.0).count();
    assert!((800..3200).contains(&met), "{met}");
    let found = errors(&gpu, &kernel, &table, truth, |_, t, i| if i == 1 { t[1].abs().max(1.0) } else { 1.0 });
    let bound = 30.0 * 25.0 * 10.0 * U;
    println!("triangles: f64 {:.1e}, f32 {:.1e} of {bound:.1e}", found[0], found[1]);
    assert!(found[0] <= 1e-12 && found[1] <= bound, "{found:?}");
}

/// Rays that are aimed at an edge as exactly as numbers allow meet one of the triangles beside it.
#[test]
fn no_ray_passes_between_two_triangles() {
    let Some(gpu) = gpu() else { return };
    let mut next = random(22);
    let mut table: Vec<[f64; 18]> = Vec::new();
    for _ in 0..20_000 {
        let (p, q, d) = (vector(&mut next) * 40.0, vector(&mut next) * 40.0, vector(&mut next));
        let aim = p + (q - p) * (0.1 + 0.8 * next());
        let side = d.cross(q - p);
        let row = [aim - d * (1.0 + 9.0 * next()), d, p, q, aim + side, aim - side * (0.2 + next())];
        table.push(row.iter().flat_map(|v| v.to_array()).collect::<Vec<_>>().try_into().unwrap());
    }
    let kernel = ShaderKernel {
        modules: modules(&["mesh/triangle"]),
        before: &format!(
            "{HIT}\nlet s = vec3<real>(x[15], x[16], x[17]);
            let is_met = triangle_hit(line, p, q, r).is_met || triangle_hit(line, q, p, s).is_met;"
        ),
        results: &["select(real(0.0), real(1.0), is_met)"],
        ..ShaderKernel::default()
    };
    let found = errors(&gpu, &kernel, &table, |_| [1.0], |_, _, _| 1.0);
    assert_eq!(found, [0.0, 0.0]);
}

/// Slabs by their closed form, for rays that run across an axis, too; rays that only just meet a box or miss it are left out.
#[test]
fn boxes_are_met_at_their_slabs() {
    let Some(gpu) = gpu() else { return };
    let mut next = random(23);
    // The length of the ray's way in a box, negative if it misses the box, and about 0 where rounding decides.
    let inside = |row: &[f64; 14]| {
        let [o, d, low, high] = [0, 1, 2, 3].map(|i| at(row, i));
        let (mut enter, mut leave) = (row[12], row[13]);
        for axis in 0..3 {
            if d[axis] == 0.0 {
                let outside = (low[axis] - o[axis]).max(o[axis] - high[axis]);
                if outside > -0.01 {
                    return -outside.max(0.0);
                }
                continue;
            }
            let (a, b) = ((low[axis] - o[axis]) / d[axis], (high[axis] - o[axis]) / d[axis]);
            (enter, leave) = (enter.max(a.min(b)), leave.min(a.max(b)));
        }
        leave - enter
    };
    let mut table: Vec<[f64; 14]> = Vec::new();
    while table.len() < 4000 {
        let mut d = vector(&mut next);
        for axis in 0..3 {
            d[axis] *= f64::from(u8::from(next() < 0.8));
        }
        let (a, b) = (vector(&mut next) * 30.0, vector(&mut next) * 30.0);
        // About a third of the rays pass beside the box.
        let aim = a + (b - a) * (vector(&mut next) * 0.7 + 0.5);
        let rows = [aim - d * (80.0 * next() - 40.0), d, a.min(b), a.max(b)];
        let from = 60.0 * next() - 50.0;
        let numbers = rows.iter().flat_map(|v| v.to_array()).chain([from, from + 80.0 * next()]);
        let row: Vec<f64> = numbers.map(|x| f64::from(x as f32)).collect();
        let row: [f64; 14] = row.try_into().unwrap();
        if d != DVec3::ZERO && inside(&row).abs() > 0.01 {
            table.push(row);
        }
    }
    let kernel = ShaderKernel {
        modules: modules(&["mesh/tree"]),
        params: &[("mesh_slack", 128.0 * U)],
        before: "let inverse = inverse_of(vec3<real>(x[3], x[4], x[5]));
            let is_met = meets_box(vec3<real>(x[0], x[1], x[2]), inverse, vec3<real>(x[6], x[7], x[8]),
                vec3<real>(x[9], x[10], x[11]), x[12], x[13]);",
        results: &["select(real(0.0), real(1.0), is_met)"],
        ..ShaderKernel::default()
    };
    let truth = |row: &[f64; 14]| [f64::from(u8::from(inside(row) > 0.0))];
    let met = table.iter().filter(|row| truth(row)[0] == 1.0).count();
    assert!((400..3600).contains(&met), "{met}");
    assert_eq!(errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0), [0.0, 0.0]);
}

/// Smooth normals have the side of the triangle that the eye sees, and flat ones are turned to the eye.
#[test]
fn normals_are_on_the_side_of_the_eye() {
    let Some(gpu) = gpu() else { return };
    let mut next = random(24);
    let mut table: Vec<[f64; 9]> = Vec::new();
    while table.len() < 3000 {
        let (mut flat, mut sum, v) =
            (vector(&mut next).normalize(), vector(&mut next) * 2.0, vector(&mut next).normalize());
        if [flat.dot(v), flat.dot(sum), sum.dot(v)].iter().any(|c| c.abs() < 1e-3) {
            continue;
        }
        match table.len() % 8 {
            0 => flat = DVec3::ZERO,
            1 => sum = DVec3::ZERO,
            2 => sum *= 1e-12,
            _ => {}
        }
        table.push([flat, sum, v].iter().flat_map(|v| v.to_array()).collect::<Vec<_>>().try_into().unwrap());
    }
    table.push([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
    let kernel = ShaderKernel {
        modules: modules(&["mesh/nearest_normal"]),
        before: "let flat_normal = vec3<real>(x[0], x[1], x[2]);
            let n = seen_normal(flat_normal, vec3<real>(x[3], x[4], x[5]), vec3<real>(x[6], x[7], x[8]));",
        results: &["n.x", "n.y", "n.z"],
        ..ShaderKernel::default()
    };
    let truth = |row: &[f64; 9]| {
        let [flat, sum, v] = [0, 1, 2].map(|i| at(row, i));
        let normal = if sum == DVec3::ZERO { flat } else { sum.normalize() };
        let outside = if flat == DVec3::ZERO { normal } else { flat * flat.dot(normal).signum() };
        (normal * outside.dot(v).signum()).to_array()
    };
    let found = errors(&gpu, &kernel, &table, truth, |_, _, _| 1.0);
    println!("normals: f64 {:.1e}, f32 {:.1e}", found[0], found[1]);
    assert!(found[0] <= 1e-14 && found[1] <= 12.0 * U, "{found:?}");
}
