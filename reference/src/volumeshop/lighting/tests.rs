use super::*;
use crate::shading::Phong;
use drypoint_scene::glam::DVec3;
use drypoint_scene::lighting::{ContourRule, LightingCell, LightingModel, LightingPreset, LightingTable};
use drypoint_scene::shot::{LightingSource, PhongParams};
use std::sync::Arc;

/// A function of a table under a light, with s_min = 1/64.
fn function<R: Real>(table: LightingTable, light: DVec3) -> LightingFunction<R> {
    let source = LightingSource::File { path: "table.png".into(), table: Arc::new(table) };
    LightingFunction::new(&LightingParams { source, divisor_floor: 1.0 / 64.0, light })
}

/// W × H cells by a function of column and row.
fn table(width: usize, height: usize, cell: impl Fn(usize, usize) -> LightingCell) -> LightingTable {
    let cells = (0..width * height).map(|at| cell(at % width, at / width)).collect();
    LightingTable::new(width, height, cells).unwrap()
}

fn all<R: Real>(found: Reflectance<R>) -> [f64; 4] {
    [found.ambient, found.diffuse, found.specular, found.opacity].map(R::to_f64)
}

/// Unit vectors that cover the sphere.
fn normals() -> impl Iterator<Item = Vec3<f64>> {
    const N: usize = 20_000;
    (0..N).map(|i| {
        let z = 1.0 - (2 * i + 1) as f64 / N as f64;
        let (sin, cos) = (i as f64 * 2.399_963_229_728_653).sin_cos();
        let across = (1.0 - z * z).sqrt();
        Vec3::new(across * cos, across * sin, z)
    })
}

#[test]
fn cells_stand_at_their_cosines_and_the_ends_go_on() {
    // Whole steps are exact: 2i/4 − 1 and 1 − 2j/2.
    let cells = |i: usize, j: usize| [i as f64, 10.0 * j as f64, 0.5, (i * j) as f64];
    let found = function::<f64>(table(5, 3, cells), DVec3::Z);
    for i in 0..5 {
        for j in 0..3 {
            let at = all(found.at(0.5 * i as f64 - 1.0, 1.0 - j as f64));
            assert_eq!(at, cells(i, j), "{i} {j}");
        }
    }
    // Bilinear between them: a quarter of the way to the right, half of it down.
    assert_eq!(all(found.at(-0.375, 0.5)), [1.25, 5.0, 0.5, 0.625]);
    // Beyond the ends, where unit vectors round to.
    assert_eq!(all(found.at(1.0 + 1e-9, 1.0 + 1e-9)), cells(4, 0));
    assert_eq!(all(found.at(-7.0, -7.0)), cells(0, 2));
    // Normals are looked up by the cosines.
    let (n, half) = (Vec3::new(0.0, 0.6, 0.8), Vec3::new(0.0, 1.0, 0.0));
    assert_eq!(found.reflectance(n, half), found.at(0.8, 0.6));
}

#[test]
fn a_single_row_or_column_is_constant() {
    let column = function::<f64>(table(1, 2, |_, j| [j as f64; 4]), DVec3::Z);
    let row = function::<f64>(table(2, 1, |i, _| [i as f64; 4]), DVec3::Z);
    for x in [-1.0, -0.3, 0.0, 0.9, 1.0] {
        assert_eq!((all(column.at(x, -1.0)), all(column.at(x, 1.0))), ([1.0; 4], [0.0; 4]));
        assert_eq!((all(row.at(-1.0, x)), all(row.at(1.0, x))), ([0.0; 4], [1.0; 4]));
    }
}

#[test]
fn eq_8_by_hand() {
    let found = Reflectance { ambient: 0.25, diffuse: 0.5, specular: 0.125, opacity: 0.25 };
    assert_eq!(found.color([1.0, 0.5, 0.0]), [0.875, 0.5, 0.125]);
    let function = function::<f64>(table(1, 1, |_, _| [0.0; 4]), DVec3::Z);
    let opacity =
        |alpha, s_alpha, magnitude| function.opacity(alpha, &Reflectance { opacity: s_alpha, ..found }, magnitude);
    // 0.25 + (1 − 0.75) = ½, and s_α + (1 − |N|) above 1 counts as 1.
    assert_eq!(opacity(0.25, 0.25, 0.75), 0.5);
    assert_eq!(opacity(0.75, 0.25, 0.75), 1.0);
    assert_eq!(opacity(0.3, 0.75, 0.5), 0.3);
    assert_eq!(opacity(0.3, 1.0, 1.0), 0.3);
    assert_eq!(opacity(0.3, 0.0, 0.0), 0.3);
    // The floor holds where the divisor is 0.
    assert_eq!(opacity(1.0 / 128.0, 0.0, 1.0), 0.5);
    assert_eq!(opacity(1e-300, 0.0, 1.0), 64e-300);
}

/// A table of (1, 0, 0, 1) leaves colour and opacity to the last bit.
#[test]
fn a_constant_table_is_unshaded() {
    fn check<R: Real>() {
        let plain = function::<R>(table(7, 4, |_, _| [1.0, 0.0, 0.0, 1.0]), DVec3::new(0.6, 0.0, 0.8));
        for n in normals().step_by(37) {
            let n = Vec3::new(R::from_f64(n.x), R::from_f64(n.y), R::from_f64(n.z));
            let half = plain.half_vector(Vec3::new(R::ZERO, R::ZERO, R::ONE));
            let found = plain.reflectance(n, half);
            for (i, x) in [0.1, 1.0 / 3.0, 1e-30, 1.0].map(R::from_f64).into_iter().enumerate() {
                assert_eq!(found.color([x; 3]), [x; 3]);
                assert_eq!(plain.opacity(x, &found, R::from_f64(0.3 * i as f64)), x);
            }
        }
    }
    check::<f64>();
    check::<f32>();
}

/// Bilinear interpolation of a smooth function: halving the cells quarters the error. The columns N·L = 0, where light
/// ends, belong to every table; cells at it are left out, where the highlight jumps.
#[test]
fn blinn_phong_tables_converge_to_blinn_phong_by_the_square_of_a_cell() {
    let (light, v) = (DVec3::new(0.48, 0.6, 0.64), Vec3::new(0.0, 0.0, 1.0));
    let params = PhongParams { ambient: 0.3, diffuse: 0.6, specular: 0.3, shininess: 30.0, light };
    let phong = Phong::<f64>::new(&params);
    let model = LightingModel {
        preset: LightingPreset::BlinnPhong,
        ambient: 0.3,
        diffuse: 0.6,
        specular: 0.3,
        shininess: 30.0,
        contour_factor: 0.0,
    };
    let error = |steps: usize| {
        let at = |i: usize| 2.0 * i as f64 / steps as f64 - 1.0;
        let cells = table(steps + 1, steps + 1, |i, j| model.reflectance(at(i), -at(j)));
        let function = function::<f64>(cells, light);
        let half = function.half_vector(v);
        assert_eq!(half, phong.half_vector(v));
        let difference = |n: Vec3<f64>| {
            let [a, b] = [function.reflectance(n, half).color([0.7; 3]), phong.shade([0.7; 3], n, half)];
            (a[0] - b[0]).abs()
        };
        let smooth = |n: &Vec3<f64>| n.dot(Vec3::from_glam(light)).abs() > 2.0 / steps as f64;
        normals().filter(smooth).map(difference).fold(0.0, f64::max)
    };
    let errors = [128, 256, 512, 1024].map(error);
    println!("largest errors of tables of 129, 257, 513 and 1025 columns: {errors:?}");
    // h²/8 times the largest second derivative, k_s·30·29 in y at the highlight, which fine tables come near to.
    let bound = |steps: f64| (2.0 / steps).powi(2) / 8.0 * 0.3 * 30.0 * 29.0;
    let shares: Vec<f64> = [128.0, 256.0, 512.0, 1024.0].iter().zip(&errors).map(|(&n, e)| e / bound(n)).collect();
    assert!(shares.iter().all(|share| *share < 1.0) && shares.is_sorted() && shares[3] > 0.95, "{shares:?}");
}

/// The angles between light and eye of L·v from −0.99 to 1.
fn lights() -> impl Iterator<Item = DVec3> {
    let steps = [-0.99, -0.9, -0.5, 0.0, 0.3, 0.7, 0.95, 1.0];
    steps.into_iter().map(|z: f64| DVec3::new(0.6 * (1.0 - z * z).sqrt(), -0.8 * (1.0 - z * z).sqrt(), z))
}

fn contours(rule: ContourRule, light: DVec3) -> LightingFunction<f64> {
    let contour_factor = rule.factor(light.z);
    let preset = LightingPreset::BlinnPhongContours;
    let model = LightingModel { preset, ambient: 1.0, diffuse: 0.0, specular: 0.0, shininess: 1.0, contour_factor };
    function(model.table(), light)
}

/// Normals whose reflectance is below that at one deviation of the Gaussian lie within it of the silhouette, and all that lie
/// so are: up to the cell that is interpolated in, across which c·y − x changes by at most (1 + c)·2/256.
#[test]
fn exact_contours_lie_on_the_silhouette() {
    let v = Vec3::new(0.0, 0.0, 1.0);
    for light in lights() {
        let function = contours(ContourRule::Exact, light);
        let half = function.half_vector(v);
        let cell = (1.0 + ContourRule::Exact.factor(light.z)) * 2.0 / 256.0;
        let at_deviation = 1.0 - (-0.5f64).exp();
        let mut inside = 0;
        for n in normals() {
            let found = function.reflectance(n, half);
            if found.opacity < at_deviation {
                inside += 1;
                assert!(n.z.abs() <= 0.15 + cell, "{light} {n:?}");
            } else {
                assert!(n.z.abs() >= 0.15 - cell, "{light} {n:?}");
            }
            assert!((found.ambient - found.opacity).abs() < 1e-15);
        }
        assert!(inside > 2000, "{inside}");
    }
}

/// The normal at which the contour is darkest, beside the silhouette by the closed form.
#[test]
fn printed_contours_are_off_by_their_closed_form() {
    let v = Vec3::new(0.0, 0.0, 1.0);
    for (degrees, expected) in [(45.0f64, 2.93), (90.0, 16.33), (120.0, 30.0)] {
        let theta = degrees.to_radians();
        let light = DVec3::new(theta.sin(), 0.0, theta.cos());
        assert!((ContourRule::error(2.0, light.z) - expected).abs() < 0.01, "{}", ContourRule::error(2.0, light.z));
        for rule in [ContourRule::Printed, ContourRule::Exact] {
            let function = contours(rule, light);
            let half = function.half_vector(v);
            let opacity = |t: f64| {
                let n = Vec3::new(t.to_radians().cos(), 0.0, t.to_radians().sin());
                function.reflectance(n, half).opacity
            };
            let darkest = (-4500..4500).map(|i| f64::from(i) * 0.01).min_by(|a, b| opacity(*a).total_cmp(&opacity(*b)));
            let off = if rule == ContourRule::Printed { expected } else { 0.0 };
            assert!((darkest.unwrap().abs() - off).abs() < 0.5, "{degrees} {rule:?}: {darkest:?}");
        }
    }
}

/// Light from behind: there is no Ĥ, and N·Ĥ counts as 0.
#[test]
fn light_from_behind_has_no_half_vector() {
    let behind = contours(ContourRule::Exact, -DVec3::Z);
    let v = Vec3::new(0.0, 0.0, 1.0);
    assert_eq!(behind.half_vector(v), Vec3::zero());
    // c = 0: contours lie where N·L = 0, which is the silhouette.
    let opacity = |n: Vec3<f64>| behind.reflectance(n, behind.half_vector(v)).opacity;
    assert!(opacity(Vec3::new(1.0, 0.0, 0.0)) < 1e-12 && opacity(Vec3::new(0.0, 0.0, 1.0)) > 0.999);
}
