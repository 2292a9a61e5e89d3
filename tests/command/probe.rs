//! `probe`, against phantoms whose derivatives and curvatures are known.

use crate::folder::Folder;
use serde_json::{Value, json};

fn probe(folder: &Folder, line: &str) -> Vec<Value> {
    serde_json::from_str(&folder.good(&format!("probe {line}"))).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value}"))
}

fn vector(value: &Value) -> [f64; 3] {
    [0, 1, 2].map(|i| number(&value[i]))
}

/// Ring and tube of a torus of 64³ voxels around voxel 31.5, in voxels.
const RING: f64 = 18.9;
const TUBE: f64 = 7.56;

fn torus() -> Folder {
    let folder = Folder::new();
    folder.good(&format!("-q phantom torus --size 64 --type f64 --param R={RING} --param r={TUBE} -o torus.nrrd"));
    folder
}

/// On the tube of radius r about a ring of radius R, at the angle θ from the outer side: κ = 1/r around the tube and
/// cos θ/(R + r cos θ) along the ring, which is negative on the inner side.
#[test]
fn both_curvatures_of_a_torus_have_their_signs() {
    let folder = torus();
    for (kernel, estimator) in [("trilinear", "central"), ("bspline", "analytic")] {
        let line = format!(
            "torus.nrrd --kernel {kernel} --at {},31.5,31.5 {},31.5,31.5",
            31.5 + RING + TUBE,
            31.5 + RING - TUBE
        );
        let both = probe(&folder, &line);
        for (point, (along_ring, outward)) in
            both.iter().zip([(1.0 / (RING + TUBE), 1.0), (-1.0 / (RING - TUBE), -1.0)])
        {
            assert_eq!(point["hessian_estimator"], estimator);
            let (k1, k2) = (number(&point["k1"]), number(&point["k2"]));
            // The bound for central differences on a curvature 1/r, 1.2 h²/r² of it; the B-spline is closer.
            let bound = 1.2 / (TUBE * TUBE) / TUBE;
            assert!((k1 - 1.0 / TUBE).abs() < bound, "{kernel}: {k1} for {}", 1.0 / TUBE);
            assert!((k2 - along_ring).abs() < bound, "{kernel}: {k2} for {along_ring}");
            assert!((number(&point["mean"]) - (k1 + k2) / 2.0).abs() < 1e-15);
            assert!((number(&point["gaussian"]) - k1 * k2).abs() < 1e-15);
            // The value is the distance: 0 on the surface, falling outwards by 1 a voxel.
            assert!(number(&point["value"]).abs() < 1.0 / TUBE);
            assert!((vector(&point["normal"])[0] - outward).abs() < 1e-9);
            // A slope is the second term of the same series: its bound has one power of 1/r less.
            assert!((vector(&point["gradient"])[0] + outward).abs() < bound * TUBE);
            // Around the tube is ±z here, along the ring ±y.
            assert!(
                (vector(&point["e1"])[2].abs() - 1.0).abs() < 1e-9
                    && (vector(&point["e2"])[1].abs() - 1.0).abs() < 1e-9
            );
        }
    }
}

#[test]
fn the_names_are_those_of_the_contract() {
    let folder = torus();
    let names = |line: &str| -> Vec<String> {
        let mut names: Vec<String> = probe(&folder, line)[0].as_object().unwrap().keys().cloned().collect();
        names.sort();
        names
    };
    let mut contract = ["value", "gradient", "hessian", "normal", "k1", "k2", "e1", "e2", "mean", "gaussian"].to_vec();
    // REC-3: it says which estimator.
    contract.push("hessian_estimator");
    contract.sort_unstable();
    assert_eq!(names("torus.nrrd --at 50,31.5,31.5"), contract);
    contract.push("kv");
    contract.sort_unstable();
    assert_eq!(names("torus.nrrd --at 50,31.5,31.5 --view 0,0,1"), contract);
}

#[test]
fn curvature_along_a_view_lies_between_the_principal_ones() {
    let folder = torus();
    let at = format!("torus.nrrd --kernel bspline --at {},31.5,31.5 --view", 31.5 + RING + TUBE);
    let point = |view: &str| probe(&folder, &format!("{at} {view}")).remove(0);
    let (k1, k2) = (number(&point("0,0,1")["k1"]), number(&point("0,0,1")["k2"]));
    // Euler: κ₁ cos² + κ₂ sin²; e₁ is z, e₂ is y. The length of the view does not matter.
    for (view, expected) in [("0,0,1", k1), ("0,-3,0", k2), ("0,1,1", (k1 + k2) / 2.0), ("-5,0,2", k1)] {
        assert!((number(&point(view)["kv"]) - expected).abs() < 1e-12, "{view}");
    }
}

#[test]
fn outside_high_turns_normals_and_signs() {
    let folder = torus();
    let at = "torus.nrrd --at 57,31.5,31.5";
    let (low, high) = (probe(&folder, at).remove(0), probe(&folder, &format!("{at} --outside high")).remove(0));
    assert_eq!(vector(&low["normal"]).map(|x| -x), vector(&high["normal"]));
    assert_eq!((number(&low["k1"]), number(&low["k2"])), (-number(&high["k2"]), -number(&high["k1"])));
    assert_eq!(low["gradient"], high["gradient"]);
}

#[test]
fn the_estimator_that_auto_chose_is_named() {
    let folder = Folder::new();
    folder.good("-q phantom sphere --size 24 --type u8 -o u8.nrrd");
    folder.good("-q phantom sphere --size 24 --type f32 -o f32.nrrd");
    for (line, estimator) in [
        ("u8.nrrd", "gaussian"),
        ("u8.nrrd --kernel bspline", "gaussian"),
        ("u8.nrrd --hessian central", "central"),
        ("f32.nrrd", "central"),
        ("f32.nrrd --kernel catmull-rom", "central"),
        ("f32.nrrd --kernel bspline-smooth", "analytic"),
        ("f32.nrrd --kernel bspline5 --hessian gaussian", "gaussian"),
    ] {
        assert_eq!(probe(&folder, &format!("{line} --at 5,11,11"))[0]["hessian_estimator"], estimator, "{line}");
    }
    // σ in the file's units or in voxels.
    let curvature = |scale: &str| {
        let said = folder.run(["probe", "u8.nrrd", "--at", "18,11.5,11.5", "--scale", scale]);
        serde_json::from_str::<Vec<Value>>(&said.out).unwrap()[0]["k1"].clone()
    };
    assert_eq!(curvature("2"), curvature("2 voxels"));
    assert_ne!(curvature("2"), curvature("1"));
}

/// value = 2x + 3y − z on a sheared grid with spacing, offset: every estimator has the gradient (2, 3, −1).
#[test]
fn a_linear_field_on_a_sheared_grid() {
    let folder = Folder::new();
    let (a, b, c, o) = ([0.5, 0.0, 0.0], [0.25, 2.0, 0.0], [0.0, -0.5, 4.0], [10.0, -20.0, 3.0]);
    let mut voxels = String::new();
    for k in 0..5 {
        for j in 0..5 {
            for i in 0..5 {
                let p: [f64; 3] =
                    std::array::from_fn(|d| o[d] + f64::from(i) * a[d] + f64::from(j) * b[d] + f64::from(k) * c[d]);
                voxels += &format!("{:?} ", 2.0 * p[0] + 3.0 * p[1] - p[2]);
            }
        }
    }
    folder.write(
        "sheared.nrrd",
        format!(
            "NRRD0004\ntype: double\ndimension: 3\nspace dimension: 3\nsizes: 5 5 5\nspace directions: (0.5,0,0) (0.25,2,0) \
             (0,-0.5,4)\nspace origin: (10,-20,3)\nencoding: ascii\n\n{voxels}\n"
        ),
    );
    let world = [11.5, -16.25, 12.0];
    for how in
        ["", "--gradient analytic", "--gradient sobel", "--gradient regression", "--kernel bspline --gradient analytic"]
    {
        let [x, y, z] = world;
        let point = probe(&folder, &format!("sheared.nrrd --at {x},{y},{z} {how}")).remove(0);
        // ε·cond(D) is 2·10⁻¹⁵ (D's singular values are 0.5 … 4), times values of up to 80 and a few roundings.
        let bound = 80.0 * 2e-15 * 10.0;
        assert!((number(&point["value"]) - (2.0 * x + 3.0 * y - z)).abs() < bound, "{how}");
        for (found, wanted) in vector(&point["gradient"]).into_iter().zip([2.0, 3.0, -1.0]) {
            assert!((found - wanted).abs() < bound, "{how}: {found}");
        }
    }
    // The same point in index space: i = (x − 10 − 0.25 j)/0.5, k = 2.25, j = (3.75 + 1.125)/2.
    let [j, k] = [(3.75 + 0.5 * 2.25) / 2.0, 2.25];
    let i = (1.5 - 0.25 * j) / 0.5;
    let by_index = probe(&folder, &format!("sheared.nrrd --space index --at {i},{j},{k}"));
    assert!((number(&by_index[0]["value"]) - (2.0 * 11.5 - 3.0 * 16.25 - 12.0)).abs() < 1e-12);
}

#[test]
fn where_there_is_no_normal_there_is_no_curvature() {
    let folder = Folder::new();
    folder.good("-q phantom constant --size 8 --param value=100 -o flat.nrrd");
    let point = probe(&folder, "flat.nrrd --at 3,3,3 --view 0,0,1").remove(0);
    assert_eq!([&point["normal"], &point["e1"], &point["e2"]], [&Value::Null; 3]);
    assert_eq!(
        json!([point["k1"], point["k2"], point["mean"], point["gaussian"], point["kv"]]),
        json!([0.0, 0.0, 0.0, 0.0, 0.0])
    );
    assert_eq!(point["value"], 100.0);
}

#[test]
fn points_may_be_many_begin_with_a_minus_or_come_from_standard_input() {
    let folder = torus();
    let first = probe(&folder, "torus.nrrd --at 1,2,3 40,31,31 --space index");
    assert_eq!(first.len(), 2);
    assert_eq!(first, probe(&folder, "torus.nrrd --space index --at 1,2,3 --at 40,31,31"));
    let said = folder.line_with("probe torus.nrrd --space index", "1 2 3\n\n 40,31,31\n");
    assert_eq!(serde_json::from_str::<Vec<Value>>(&said.out).unwrap(), first);
    assert_eq!(folder.line_with("probe torus.nrrd", "").out, "[\n]\n");
    let said = folder.line_with("probe torus.nrrd", "1,2,3\nx\n4,5\n");
    assert_eq!(
        (said.code, said.err.as_str()),
        (
            Some(2),
            "error: \"x\" is no point\n  at: standard input, line 2\n  try: a point is three numbers, as X,Y,Z\n\
             error: \"4,5\" is no point\n  at: standard input, line 3\n  try: a point is three numbers, as X,Y,Z\n"
        )
    );
    assert_eq!(
        folder.refused("probe torus.nrrd --at -1,2,3 1,2,3 -.5,0,64 --space index"),
        "error: the point -1,2,3 lies outside the volume\n  at: torus.nrrd\n  try: in index space the volume reaches from 0,0,0 to 63,63,63\n\
         error: the point -0.5,0,64 lies outside the volume\n  at: torus.nrrd\n  try: in index space the volume reaches from 0,0,0 to 63,63,63\n"
    );
}

/// 31 · 0.7 is 21.7 for a person; divided by 0.7 it is 31.000000000000004 in f64.
#[test]
fn the_border_is_inside_however_its_coordinates_are_rounded() {
    let folder = Folder::new();
    for (spacing, border) in [("0.7", "21.7"), ("0.3", "9.3"), ("1.1", "34.1"), ("0.07", "2.17")] {
        folder.good(&format!("-q phantom sphere --size 32 --spacing {spacing} -o a.nrrd"));
        assert_eq!(probe(&folder, &format!("a.nrrd --at {border},{border},{border} 0,0,0")).len(), 2);
    }
    assert_eq!(
        folder.refused("probe a.nrrd --at 2.1701,0,0"),
        "error: the point 2.1701,0,0, 31.00142857142857,0,0 in index space, lies outside the volume\n  at: a.nrrd\n  try: in index space the volume reaches from 0,0,0 to 31,31,31\n"
    );
}

#[test]
fn settings_that_cannot_be() {
    let folder = torus();
    for (more, expected) in [
        (
            "--kernel trilinea --scale -1",
            "error: sampling.kernel cannot be \"trilinea\"\n  at: --kernel trilinea\n  try: write \"trilinear\"; expected is \"trilinear\", \"bspline\", \"bspline-smooth\", \"bspline5\" or \"catmull-rom\"\n\
             error: sampling.scale cannot be -1\n  at: --scale -1\n  try: write a length above 0: a number in world units, or such as \"2 voxels\"\n",
        ),
        (
            "--hessian analytic",
            "error: sampling.hessian = \"analytic\" needs a kernel with second derivatives\n  at: --hessian analytic\n  try: write kernel = \"bspline\", or hessian = \"central\" or \"gaussian\"\n",
        ),
        (
            "--hessian gaussian --scale 5000",
            "error: scale = 5000 world units is not between 0 and 1000, which is 1000 voxels\n  at: torus.nrrd\n  try: choose another --kernel, --hessian or --scale\n",
        ),
        (
            "--view 0,0,0",
            "error: invalid value '0,0,0' for '--view <X,Y,Z>': a direction is three numbers that are not all 0, as X,Y,Z\n  at: drypoint probe\n  try: `drypoint probe --help` tells what there is\n",
        ),
    ] {
        assert_eq!(folder.refused(&format!("probe torus.nrrd --at 1,2,3 {more}")), expected);
    }
}
