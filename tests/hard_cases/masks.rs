//! Voxels that are not finite ([PREC-2]): outside the projection of the cells that touch one, the picture is that of the
//! filled volume bit for bit; inside it those samples are transparent, and nothing is ever undefined.

use crate::common::lattice::sighted;
use crate::common::random::Random;
use crate::common::{LAYERS, Stage, perspective, plain};
use crate::stability::{Case, Theme, differing};
use drypoint::reference::number::Real;
use drypoint::scene::glam::DVec3;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{
    Contours, GradientEstimator, GradientRange, HessianEstimator, Kappa, Kernel, Number, Shading,
};
use drypoint::scene::volume::{Volume, VolumeError, Voxels};

pub(crate) static THEME: Theme = Theme::new(
    "Voxels that are NaN or ±∞",
    &[
        Case {
            name: "1, 4 and 12 of them, outside the projection of their cells",
            breaks: "one NaN spreads through prefilters, ranges and quantiles",
            done: "each is filled by its nearest neighbour and has a bit in a mask [PREC-2]",
            of: "numbers with another bit than in the filled volume, all layers; 5 reconstructions",
            bound: 0.0,
            why: "no filter and no range sees them, and a masked sample is transparent",
            measure: || outside_the_masked_cells::<f64>(Number::F64),
        },
        Case {
            name: "the same, everywhere",
            breaks: "NaN or ∞ in the picture",
            done: "as above",
            of: "numbers that are NaN, of all layers; every second voxel masked, and all but one",
            bound: 0.0,
            why: "no output is ever NaN",
            measure: || nans(Number::F64),
        },
        Case {
            name: "both in f32",
            breaks: "as above",
            done: "as above",
            of: "numbers with another bit than in the filled volume, and numbers that are NaN",
            bound: 0.0,
            why: "as above",
            measure: || outside_the_masked_cells::<f32>(Number::F32) + nans(Number::F32),
        },
        Case {
            name: "all of them",
            breaks: "nothing to fill from",
            done: "an error of its own type",
            of: "volumes that were taken",
            bound: 0.0,
            why: "there is no field",
            measure: nothing_finite,
        },
    ],
);

#[test]
fn voxels_that_are_not_finite() {
    THEME.hold();
}

/// NaNs where hardly a voxel is finite.
fn nans(number: Number) -> f64 {
    let mut found = 0;
    for whole in [|i: usize| i.is_multiple_of(2), |i: usize| i == 700] {
        let grid = Grid::with_spacing(DIMS, [1.0, 1.2, 0.9]).unwrap();
        let voxels = (0..grid.len()).map(|i| if whole(i) { (i % 17) as f64 } else { f64::NAN }).collect();
        let volume = Volume::new(grid, Voxels::F64(voxels), 1.0, 0.0).unwrap();
        for shot in shots(volume) {
            let shown = shot.layers(&LAYERS).in_number(number).render();
            found +=
                shown.picture.layers.iter().flat_map(|l| l.channels.iter().flatten()).filter(|v| v.is_nan()).count();
        }
    }
    found as f64
}

fn nothing_finite() -> f64 {
    let grid = Grid::with_spacing([2; 3], [1.0; 3]).unwrap();
    let taken = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY].into_iter().filter(|&v| {
        let made = Volume::new(grid.clone(), Voxels::F64(vec![v; 8]), 1.0, 0.0);
        made.err() != Some(VolumeError::NothingFinite)
    });
    taken.count() as f64
}

const DIMS: [usize; 3] = [14, 11, 12];

/// A smooth field with holes of NaN, +∞ and −∞.
fn holed(seed: u64, holes: usize) -> Volume {
    let grid = Grid::with_spacing(DIMS, [1.0, 1.2, 0.9]).unwrap();
    let mut random = Random(seed);
    let mut voxels: Vec<f64> =
        crate::common::positions(&grid).map(|p| (0.5 * p.x).sin() + (0.4 * p.y).cos() + (0.6 * p.z).sin()).collect();
    for _ in 0..holes {
        let i = random.below(voxels.len());
        voxels[i] = random.pick(&[f64::NAN, f64::INFINITY, f64::NEG_INFINITY]);
    }
    Volume::new(grid, Voxels::F64(voxels), 1.0, 0.0).unwrap()
}

/// The same voxels as they were filled, without a mask.
fn filled(volume: &Volume) -> Volume {
    Volume::new(volume.grid().clone(), volume.voxels().clone(), 1.0, 0.0).unwrap()
}

fn shots(volume: Volume) -> Vec<Stage> {
    let nodes = [(-1.0, [0.9, 0.2, 0.1], 0.0), (0.5, [0.2, 0.9, 0.1], 0.1), (2.5, [0.1, 0.2, 0.9], 0.4)];
    let styled = [(-1.0, "a", 0.0), (2.5, "a", 0.4)];
    let regular = Stage::regular(volume.clone(), &nodes).with(|s| s.shading = Some(Shading::default()));
    let style = Stage::styled(volume, vec![plain("a", [0.2, 0.4, 0.6, 0.8])], &styled);
    let contours = |kappa| Some(Contours { kappa, ..Contours::default() });
    vec![
        regular.clone(),
        regular.with(|s| s.sampling.kernel = Kernel::CatmullRom),
        style.with(|s| s.contours = contours(Kappa::Ray)),
        style.with(|s| {
            s.contours = contours(Kappa::Exact);
            s.sampling.kernel = Kernel::Bspline;
            s.sampling.gradient = GradientEstimator::Analytic;
        }),
        style.with(|s| {
            s.contours = contours(Kappa::Exact);
            s.sampling.hessian = HessianEstimator::Gaussian;
            s.sampling.gradient = GradientEstimator::Sobel;
        }),
    ]
}

fn outside_the_masked_cells<R: Real>(number: Number) -> f64 {
    let mut differ = 0.0;
    for (seed, holes) in [(1, 1), (2, 4), (3, 12)] {
        let masked = holed(seed, holes);
        for (i, shot) in shots(masked.clone()).into_iter().enumerate() {
            let shot = shot.layers(&LAYERS).with(|s| {
                let direction = DVec3::new(0.5, 0.7, -0.4);
                s.camera = perspective(40.0);
                s.camera.direction = direction;
                s.sampling.number = number;
            });
            let with = shot.render();
            let without = Stage { volume: filled(&masked), ..shot.clone() }.render();
            let (mut same, mut touched) = (0, 0);
            for (t, ray) in sighted::<R>(&shot).iter().enumerate() {
                let channels = |s: &crate::common::Shown| {
                    s.picture.layers.iter().flat_map(|l| l.channels.iter()).map(|c| c[t].to_bits()).collect::<Vec<_>>()
                };
                if ray.iter().any(|s| s.masked) {
                    touched += usize::from(with.pixels()[t] != without.pixels()[t]);
                } else {
                    differ += differing(&channels(&with), &channels(&without));
                    same += usize::from(!ray.is_empty());
                }
            }
            assert!(same > 10 && touched > 0, "{same} {touched}");
            assert!(with.counts.masked > 0 && without.counts.masked == 0);
            assert!(with.counts.bytes.contains_key("mask") && !without.counts.bytes.contains_key("mask"));
            let values = with.picture.layers.iter().flat_map(|l| l.channels.iter().flatten());
            assert!(values.into_iter().all(|v| !v.is_nan()), "scene {i}");
        }
    }
    differ
}

/// An opaque volume with a hole has a window: the rays that meet nothing but masked cells see the background.
#[test]
fn a_hole_through_the_volume_is_seen_through() {
    let grid = Grid::with_spacing([9, 5, 9], [1.0; 3]).unwrap();
    let voxels =
        crate::common::positions(&grid).map(|p| if p.x == 4.0 && p.z == 4.0 { f64::NAN } else { 5.0 }).collect();
    let volume = Volume::new(grid, Voxels::F64(voxels), 1.0, 0.0).unwrap();
    let shot = Stage::regular(volume, &[(0.0, [1.0; 3], 1.0)]).with(|s| {
        s.camera.projection = crate::common::orthographic(Some(8.0)).projection;
    });
    for (t, p) in shot.render().pixels().into_iter().enumerate() {
        // Pixels are half a voxel; the masked cells reach from 3 to 5 on both axes.
        let at = |i: usize| ((i as f64 + 0.5) * 0.5 - 4.0).abs();
        let hole = at(t % 16) < 1.0 && at(t / 16) < 1.0;
        assert_eq!(p[3], if hole { 0.0 } else { 1.0 }, "{t}");
    }
}

/// The quantile of ‖g‖ leaves out the voxels whose stencil touches a masked voxel, and no others ([VAL-2]): three
/// spikes in nothing, with holes in and out of the reach of what each estimator reads.
#[test]
fn the_range_of_gradients_leaves_out_stencils_that_touch_a_mask() {
    // Values of 0 with spikes: a spike of height h at distance one gives ‖g‖ = h/2 by central differences.
    let grid = Grid::with_spacing([12, 9, 9], [1.0; 3]).unwrap();
    let with = |holes: &[DVec3], spike: DVec3| {
        let at = |p: DVec3| match p {
            p if holes.contains(&p) => f64::NAN,
            p if p == spike => 8.0,
            p if p == DVec3::new(1.0, 7.0, 7.0) => 2.0,
            _ => 0.0,
        };
        let voxels = crate::common::positions(&grid).map(at).collect();
        Volume::new(grid.clone(), Voxels::F64(voxels), 1.0, 0.0).unwrap()
    };
    // |g| is in no layer; eq. 2 at |N·v| = 1 says it: α = α_u^(0.5 + (1 − |g|)). What comes out is hi over the ‖g‖ there.
    let largest = |volume: Volume, gradient: GradientEstimator| {
        let glass = plain("glass", [1.0, 1.0, 1.0, 1.0]);
        let shot = Stage::styled(volume, vec![glass], &[(0.0, "glass", 0.5)]).with(|s| {
            s.volume.gradient_range = GradientRange::Quantile(1.0);
            s.sampling.gradient = gradient;
        });
        // One sample, at the voxel (1, 7, 6) beside the low spike: ‖g‖ is 1 by central differences, 2 analytic.
        let shot = shot.step(100.0).with(|s| {
            s.picture.size = [1, 1];
            s.camera = crate::common::orthographic(Some(1.0));
            s.camera.direction = DVec3::Z;
            s.camera.up = DVec3::Y;
            s.camera.direction_given = true;
            s.camera.eye = Some(DVec3::new(1.0, 7.0, 6.0 - 50.0));
        });
        let alpha = shot.render().pixels()[0][3];
        1.0 / (1.5 - alpha.ln() / 0.5f64.ln())
    };
    let is = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    let (central, analytic) = (GradientEstimator::Central, GradientEstimator::Analytic);
    let (spike, far) = (DVec3::new(6.0, 4.0, 4.0), DVec3::new(10.0, 0.0, 0.0));
    // Far from the hole the spike rules: 8/2 beside it, and 8 along all three axes at it.
    is(largest(with(&[far], spike), central), 4.0);
    is(largest(with(&[far], spike), analytic), 8.0 * 3f64.sqrt() / 2.0);
    // Holes at the eight corners about the spike are in no cross that the spike is in, but in every cube: then the low
    // spike rules, 2 along three axes.
    let corners: Vec<DVec3> =
        (0..8).map(|i| spike + DVec3::new([-1.0, 1.0][i & 1], [-1.0, 1.0][i >> 1 & 1], [-1.0, 1.0][i >> 2])).collect();
    is(largest(with(&corners, spike), central), 4.0);
    is(largest(with(&corners, spike), analytic), 2.0 * 3f64.sqrt() / 2.0);
    // At the border differences are one-sided: at x = 11 (3f₁₁ − 4f₁₀ + f₉)/2, 16 of a spike at 10, with a hole at 9 out of
    // the count; then 4 beside the spike.
    let border = DVec3::new(10.0, 4.0, 4.0);
    is(largest(with(&[DVec3::ZERO], border), central), 16.0);
    is(largest(with(&[DVec3::new(9.0, 4.0, 4.0)], border), central), 4.0);
    // Sobel's smoothing across takes ¼ of all of these, and of the 1 beside the low spike.
    let (sobel, regression) = (GradientEstimator::Sobel, GradientEstimator::Regression);
    is(largest(with(&[DVec3::ZERO], border), sobel), 16.0);
    is(largest(with(&[DVec3::new(9.0, 4.0, 4.0)], border), sobel), 4.0);
    // The regression reads whole cubes: with holes at the corners about the spike, it might as well not be there; with a
    // hole elsewhere it rules.
    let rest = largest(with(&corners, DVec3::splat(-1.0)), regression);
    is(largest(with(&corners, spike), regression), rest);
    assert!(largest(with(&[far], spike), regression) > 1.05 * rest, "{rest}");
}

/// Every voxel but one is masked: nothing is visible where no cell is whole, and nothing is undefined.
#[test]
fn almost_nothing_finite() {
    let grid = Grid::with_spacing([4; 3], [1.0; 3]).unwrap();
    let mut voxels = vec![f64::NAN; 64];
    voxels[21] = 3.0;
    let volume = Volume::new(grid, Voxels::F64(voxels), 1.0, 0.0).unwrap();
    let shown = Stage::regular(volume, &[(0.0, [1.0; 3], 0.5)]).layers(&LAYERS).render();
    assert_eq!(shown.covered(), 0);
    assert!(shown.one(LayerKind::Z).iter().all(|z| *z == f64::INFINITY));
}
