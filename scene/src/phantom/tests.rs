//! Properties that hold for all phantoms.

use super::*;
use crate::philox;
use crate::space::SpaceError;
use crate::volume::Voxels;
use proptest::prelude::*;

/// A cube of side 1 with 65 voxels along it.
pub(super) fn unit_grid() -> Grid {
    Grid::with_spacing([65; 3], [1.0 / 64.0; 3]).unwrap()
}

fn owned(params: &[(&str, f64)]) -> Vec<(String, f64)> {
    params.iter().map(|(name, value)| (name.to_string(), *value)).collect()
}

/// A phantom on the unit cube, and the cube's centre.
pub(super) fn made(name: &str, params: &[(&str, f64)]) -> (Box<dyn Phantom>, DVec3) {
    let grid = unit_grid();
    (by_name(name, &grid, &owned(params)).unwrap(), grid.centre())
}

#[track_caller]
pub(super) fn assert_near(got: f64, want: f64, bound: f64) {
    assert!((got - want).abs() <= bound, "{got} is not within {bound} of {want}");
}

/// Points all over a grid's box, the same ones every time.
pub(super) fn points(grid: &Grid, n: u32) -> impl Iterator<Item = DVec3> + use<'_> {
    let [lo, hi] = grid.index_box();
    (0..n).map(move |i| {
        let [x, y, z, _] = philox::uniforms(2026, [i, 0, 0], 0);
        grid.to_world(lo + DVec3::new(x, y, z) * (hi - lo))
    })
}

/// Phantoms whose fields, or whose first three derivatives, jump inside the box. The number is the least share of
/// points whose difference stencil of ±2·10⁻³ meets no jump. (White noise jumps at every 64th of the box.)
const BROKEN: [(&str, f64); 6] = [
    ("machined-part", 0.95),
    ("tube-tree", 0.95),
    ("shepp-logan", 0.95),
    ("shells", 0.95),
    ("noise", 0.95),
    ("white-noise", 0.4),
];

/// The derivative of f at 0 by central differences of eighth order at ±h … ±4h.
fn central(f: impl Fn(f64) -> f64, h: f64) -> f64 {
    let weights = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    (1..=4).zip(weights).map(|(k, w)| w * (f(f64::from(k) * h) - f(f64::from(-k) * h))).sum::<f64>() / h
}

/// Compares gradients with differences of values, and Hessians with differences of those gradients.
fn check_derivatives(name: &str, params: &[(&str, f64)]) {
    let (phantom, _) = made(name, params);
    let grid = unit_grid();
    let n = 150;
    let jets: Vec<_> = points(&grid, n).map(|p| phantom.jet(p)).collect();
    let largest = |of: fn(&Jet) -> f64| jets.iter().map(of).fold(0.0, f64::max);
    // What is differenced is rounded a few dozen times on its way: 64 ε of the largest value, plus that of a point's
    // coordinates (below 1) times the slope.
    let (value, slope) = (largest(|j| j.value.abs()), largest(|j| j.gradient.length()));
    let bend = largest(|j| j.hessian.to_cols_array().into_iter().fold(0.0, |a: f64, b| a.max(b.abs())));
    let h = 1.0 / 4096.0;
    let good = points(&grid, n).zip(&jets).filter(|(p, jet)| {
        let agrees = |f: &dyn Fn(DVec3) -> f64, axis: usize, want: f64, scale: f64| {
            let along = |t: f64| f(*p + DVec3::AXES[axis] * t);
            let (coarse, fine) = (central(along, 2.0 * h), central(along, h));
            // Truncation falls by 2⁸ from the coarse to the fine step, so their difference bounds that of the fine.
            (fine - want).abs() <= (fine - coarse).abs() + 64.0 * f64::EPSILON * scale / h
        };
        (0..3).all(|a| {
            agrees(&|q| phantom.value(q), a, jet.gradient[a], value + slope)
                && (0..3).all(|b| agrees(&|q| phantom.gradient(q)[b], a, jet.hessian.col(a)[b], slope + bend))
        })
    });
    let share = good.count() as f64 / f64::from(n);
    let least = BROKEN.iter().find(|(broken, _)| *broken == name).map_or(1.0, |(_, share)| *share);
    assert!(share >= least, "{name} {params:?}: derivatives agree at {share} of the points");
}

#[test]
fn derivatives_are_those_of_the_value() {
    for about in describe() {
        check_derivatives(about.name, &[]);
        if about.params.iter().any(|p| p.name == "w") {
            check_derivatives(about.name, &[("w", 0.03), ("high", 1000.0)]);
        }
    }
    check_derivatives("cylinder", &[("ax", 1.0), ("ay", -2.0), ("az", 0.5)]);
    check_derivatives("plane", &[("nx", 1.0), ("ny", -2.0), ("o", 0.1)]);
    check_derivatives("ellipsoid", &[("a", 0.2), ("b", 0.5), ("c", 0.2)]);
    for (n, l, m) in [(1.0, 0.0, 0.0), (2.0, 1.0, -1.0), (3.0, 2.0, 0.0), (5.0, 2.0, 1.0), (8.0, 7.0, -5.0)] {
        check_derivatives("hydrogen", &[("n", n), ("l", l), ("m", m)]);
    }
}

#[test]
fn differences_would_notice() {
    // The check itself: a slope that is off by 10⁻⁹ of the scale is far outside the bound of rounding.
    let f = |t: f64| crate::math::sin(3.0 * t + 1.0);
    let (coarse, fine) = (central(f, 1.0 / 2048.0), central(f, 1.0 / 4096.0));
    let bound = (fine - coarse).abs() + 64.0 * f64::EPSILON * 4.0 * 4096.0;
    assert!((fine - 3.0 * crate::math::cos(1.0)).abs() <= bound && bound < 1e-9, "{bound}");
}

#[test]
fn jets_carry_the_same_value_and_a_symmetric_hessian() {
    let grid = unit_grid();
    let on_axes = [grid.centre(), DVec3::new(0.5, 0.5, 0.2), DVec3::new(0.7, 0.5, 0.5), DVec3::new(0.5, 0.6, 0.7)];
    for about in describe() {
        let phantom = by_name(about.name, &grid, &[]).unwrap();
        for p in points(&grid, 100).chain(on_axes) {
            let jet = phantom.jet(p);
            assert_eq!(jet.value.to_bits(), phantom.value(p).to_bits(), "{} at {p}", about.name);
            assert!(jet.gradient.is_finite() && jet.hessian.is_finite(), "{} at {p}", about.name);
            assert_eq!(jet.hessian, jet.hessian.transpose(), "{} at {p}", about.name);
        }
    }
}

#[test]
fn distances_have_slope_one_and_lead_to_the_surface() {
    // Exact everywhere, but for the bracket inside only and for the tree outside only, as their docs say.
    let exact = |name: &str, d: f64| match name {
        "machined-part" => d > 0.0,
        "tube-tree" => d < 0.0,
        _ => true,
    };
    for name in ["sphere", "ellipsoid", "torus", "cylinder", "plane", "machined-part", "tube-tree"] {
        let (phantom, _) = made(name, &[]);
        let grid = unit_grid();
        let mut tried = 0;
        for (i, p) in points(&grid, 400).enumerate() {
            let jet = phantom.jet(p);
            let d = jet.value;
            // The ellipsoid's root is 1/u times as sensitive near its medial surface: 10⁻¹³ at the nearest point.
            assert_near(jet.gradient.length(), 1.0, 1e-12);
            if !exact(name, d) {
                continue;
            }
            tried += 1;
            assert_near(phantom.value(p - jet.gradient * d), 0.0, 1e-12);
            // Nothing of the surface is nearer: the ball around p lies on one side.
            let [x, y, z, _] = philox::uniforms(1, [i as u32, 0, 0], 0);
            let on_ball = p + (DVec3::new(x, y, z) - 0.5).normalize() * (0.999_999 * d.abs());
            assert!(phantom.value(on_ball) * d > 0.0, "{name} at {p}");
        }
        assert!(tried > 30, "{name}: {tried}");
    }
}

#[test]
fn integer_types_have_an_edge_of_one_voxel_and_floats_the_distance() {
    let source = |voxel_type| PhantomSource {
        name: "sphere".into(),
        size: [33; 3],
        spacing: [0.5; 3],
        voxel_type,
        params: owned(&[("R", 4.0)]),
    };
    // The voxel 12 steps from the centre is 2 outside: σ(−4) · 255 = 4.59.
    let at = |t| generate(&source(t)).unwrap().value([28, 16, 16]);
    assert_eq!([at(VoxelType::U8), at(VoxelType::I16), at(VoxelType::F64)], [5.0, 5.0, -2.0]);
    // i8 ends at 127: σ(8) · 127 in the middle.
    assert_eq!(generate(&source(VoxelType::I8)).unwrap().value([16; 3]), 127.0);
    let (truth, grid) = of_source(&source(VoxelType::U8)).unwrap();
    assert_near(truth.value(grid.to_world(DVec3::new(28.0, 16.0, 16.0))), 255.0 / (1.0 + 4f64.exp()), 1e-13);
}

#[test]
fn threads_do_not_show() {
    let grid = Grid::with_spacing([23, 18, 11], [1.0, 1.5, 0.7]).unwrap();
    for about in describe() {
        let phantom = by_name(about.name, &grid, &[]).unwrap();
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let volume = pool.install(|| sample(phantom.as_ref(), grid.clone(), VoxelType::F64)).unwrap();
            let Voxels::F64(voxels) = volume.voxels() else { panic!("asked for f64") };
            voxels.iter().map(|v| v.to_bits()).collect::<Vec<_>>()
        };
        assert_eq!(with(1), with(5), "{}", about.name);
    }
}

#[test]
fn the_same_bits_on_every_machine() {
    // FNV-1a over the bits of every phantom at 500 points ([PREC-4]). It changes only when a formula does.
    let grid = unit_grid();
    let hash = describe().iter().flat_map(|about| {
        let phantom = by_name(about.name, &grid, &[]).unwrap();
        points(&grid, 500).map(move |p| phantom.value(p).to_bits()).collect::<Vec<_>>()
    });
    let hash = hash
        .flat_map(u64::to_le_bytes)
        .fold(0xcbf2_9ce4_8422_2325_u64, |h, byte| (h ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3));
    assert_eq!(hash, 0x3276_6c03_25d9_4ade, "{hash:#x}");
}

#[test]
fn labels_come_as_a_volume() {
    let grid = unit_grid();
    let (shells, _) = made("shells", &[("n", 3.0), ("R", 0.45)]);
    let labels = sample_labels(shells.as_ref(), grid.clone()).unwrap();
    assert_eq!(labels.voxels().voxel_type(), VoxelType::U16);
    assert_eq!([labels.value([32; 3]), labels.value([32, 32, 10]), labels.value([0; 3])], [3.0, 1.0, 0.0]);
    let sphere = by_name("sphere", &grid, &[]).unwrap();
    assert_eq!(sample_labels(sphere.as_ref(), grid).unwrap().range(), [0.0, 0.0]);
}

#[test]
fn wrong_names_and_values_are_refused() {
    let grid = unit_grid();
    let fault = |name: &str, params: &[(&str, f64)]| by_name(name, &grid, &owned(params)).err().unwrap();
    let text = fault("elipsoid", &[]).to_string();
    assert!(
        text.starts_with("no phantom is called `elipsoid`, did you mean `ellipsoid`?; phantoms: sphere, "),
        "{text}"
    );
    let text = fault("sphere", &[("radius", 1.0)]).to_string();
    assert_eq!(text, "phantom `sphere` has no parameter `radius`; parameters: R, w, high");
    assert!(matches!(fault("torus", &[("Rr", 1.0)]), PhantomError::UnknownParam { nearest: Some("R"), .. }));
    let text = fault("sphere", &[("R", 0.0)]).to_string();
    assert_eq!(text, "phantom `sphere`: parameter `R` is 0, expected a number above 0");
    let text = fault("noise", &[("n", 1.5)]).to_string();
    assert_eq!(text, "phantom `noise`: parameter `n` is 1.5, expected a whole number from 1 to 16");
    assert!(matches!(fault("constant", &[("value", f64::NAN)]), PhantomError::OutOfRange { .. }));
    assert!(matches!(fault("sphere", &[("w", -1.0)]), PhantomError::OutOfRange { param: "w", .. }));
    assert!(matches!(fault("sphere", &[("R", 1.0), ("R", 2.0)]), PhantomError::Repeated { param: "R", .. }));
    for (name, params) in [
        ("torus", [("R", 0.1), ("r", 0.1)]),
        ("hydrogen", [("n", 2.0), ("l", 2.0)]),
        ("hydrogen", [("l", 1.0), ("m", -2.0)]),
        ("plane", [("nz", 0.0), ("o", 0.0)]),
        ("cylinder", [("az", 0.0), ("ax", 0.0)]),
    ] {
        assert!(matches!(fault(name, &params), PhantomError::Together { .. }), "{name} {params:?}");
    }
}

#[test]
fn grids_that_cannot_be_are_refused() {
    let source = |size, spacing| {
        let (name, voxel_type, params) = ("sphere".to_owned(), VoxelType::F64, vec![]);
        generate(&PhantomSource { name, size, spacing, voxel_type, params }).err().unwrap()
    };
    assert_eq!(source([4, 0, 4], [1.0; 3]), PhantomError::Space(SpaceError::EmptyAxis { axis: 1 }));
    assert!(matches!(source([4; 3], [1.0, 0.0, 1.0]), PhantomError::Space(SpaceError::Singular { .. })));
    assert!(
        matches!(source([1 << 20; 3], [1.0; 3]), PhantomError::Memory { no_room, .. } if no_room.needed == 1 << 63)
    );
}

#[test]
fn every_default_and_limit_is_said_in_words() {
    for about in describe() {
        assert!(!about.doc.is_empty());
        for (i, param) in about.params.iter().enumerate() {
            assert!(!param.doc.is_empty() && !param.default.to_string().is_empty());
            assert!(about.params[..i].iter().all(|p| p.name != param.name), "{}: {}", about.name, param.name);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn any_size_spacing_and_type(
        which in 0..ALL.len(),
        dims in prop::array::uniform3(1usize..7),
        powers in prop::array::uniform3(-5.0f64..5.0),
        kind in 0..VoxelType::ALL.len(),
    ) {
        let voxel_type = VoxelType::ALL[kind];
        let spacing = powers.map(|p| 10f64.powf(p));
        let (name, params) = (ALL[which].name.to_owned(), vec![]);
        let source = PhantomSource { name, size: dims, spacing, voxel_type, params };
        let (phantom, grid) = of_source(&source).unwrap();
        let volume = sample(phantom.as_ref(), grid.clone(), voxel_type).unwrap();
        prop_assert!(volume.mask().is_none());
        // With the defaults of an integer type no value lies outside its range.
        let rounding = match voxel_type {
            VoxelType::F64 => 0.0,
            // Half a unit in the last place, or a whole subnormal one.
            VoxelType::F32 => f64::from(f32::EPSILON) * volume.largest_magnitude() + f64::from(f32::MIN_POSITIVE),
            _ => 0.5,
        };
        for i in 0..grid.len() {
            let index = [i % dims[0], i / dims[0] % dims[1], i / (dims[0] * dims[1])];
            let p = grid.to_world(DVec3::from_array(index.map(|x| x as f64)));
            prop_assert!((volume.value(index) - phantom.value(p)).abs() <= rounding);
            prop_assert!(!phantom.jet(p).gradient.is_nan());
        }
    }

    #[test]
    fn sheared_grids_are_sampled_in_the_world(shear in -0.9f64..0.9) {
        let axes = DMat3::from_cols(DVec3::X, DVec3::new(shear, 2.0, 0.0), DVec3::new(0.1, shear, 0.5));
        let grid = Grid::new([9, 7, 11], axes, DVec3::new(-100.0, 20.0, 3.0)).unwrap();
        let volume = sample(by_name("sphere", &grid, &owned(&[("R", 2.0)])).unwrap().as_ref(), grid.clone(), VoxelType::F64);
        let volume = volume.unwrap();
        prop_assert_eq!(volume.value([4, 3, 5]), 2.0);
        let p = grid.to_world(DVec3::new(7.0, 2.0, 1.0));
        prop_assert!((volume.value([7, 2, 1]) - (2.0 - (p - grid.centre()).length())).abs() <= 1e-13);
    }
}
