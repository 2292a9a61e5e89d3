//! Turned by 90° or mirrored, volume and camera together, a picture stays what it is ([SPACE-1] … [SPACE-4], [RAY-6]).
//!
//! The voxels are stored anew, so that axes change places and directions: x, y, z are nested, summed and stepped over in
//! another order. A mirrored scene is a mirrored picture.

use crate::common::{Shown, Stage, on, orthographic, perspective, style};
use crate::stability::{Case, Theme, U, differing, worst};
use drypoint::scene::glam::{DMat3, DVec3};
use drypoint::scene::picture::LayerKind;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{
    Camera, Contours, GradientEstimator, GradientRange, HessianEstimator, Kappa, Kernel, Length, Number, Shading,
};

pub(crate) static THEME: Theme = Theme::new(
    "Turned and mirrored",
    &[
        Case {
            name: "a dyadic phantom under all 48 symmetries of the cube",
            breaks: "swapped axes, spacings or signs; borders that differ from side to side",
            done: "one map from index to world [SPACE-2], one rule for all axes",
            of: "numbers with another bit in picture, depth, normals, gradients; trilinear, shaded, 1 : ½ : 2",
            bound: 0.0,
            why: "whole voxels, dyadic positions and spacings: nothing is rounded before ‖g‖, whose square is exact",
            measure: dyadic,
        },
        Case {
            name: "the same in f32: pictures",
            breaks: "as above",
            done: "as above",
            of: "largest difference of a channel",
            bound: 64.0 * 8.0 * U,
            why: "squares of gradients are no longer exact, and their sum depends on the order of the axes: up to 8 u a sample, 64 samples a ray",
            measure: dyadic_in_f32,
        },
        Case {
            name: "a dyadic phantom in styles, turned by 24 rotations",
            breaks: "as above, and lookups in a frame of their own",
            done: "the lookup is in eye space [STF-1]",
            of: "numbers with another bit",
            bound: 0.0,
            why: "as above; N is turned, not rounded, by a camera along the axes",
            measure: dyadic_styles,
        },
        Case {
            name: "waves under 12 symmetries, askew cameras",
            breaks: "as above, for kernels, curvatures and contours",
            done: "as above",
            of: "share of pixels that differ by more than 10⁻¹²; 5 kernels, 4 gradients, κ along the ray and exact",
            bound: 1e-3,
            why: "rounding alone differs but where a decision is crossed: steps of the function, the box, no normal",
            measure: waves,
        },
    ],
);

#[test]
fn turned_and_mirrored() {
    THEME.hold();
}

/// The 48 symmetries of the cube.
fn symmetries() -> Vec<DMat3> {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let places = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [1, 0, 2], [0, 2, 1], [2, 1, 0]];
    let signed = |p: [usize; 3], i: usize| {
        let sign = |a: usize| if i >> a & 1 == 0 { 1.0 } else { -1.0 };
        DMat3::from_cols(axes[p[0]] * sign(0), axes[p[1]] * sign(1), axes[p[2]] * sign(2))
    };
    places.into_iter().flat_map(|p| (0..8).map(move |i| signed(p, i))).collect()
}

/// A grid about the world's origin.
fn centred(dims: [usize; 3], spacing: DVec3) -> Grid {
    let half = DVec3::from_array(dims.map(|n| (n - 1) as f64 / 2.0));
    Grid::new(dims, DMat3::from_diagonal(spacing), -half * spacing).unwrap()
}

/// The same scene with everything in the world moved by a symmetry, the voxels stored along the axes again. What was
/// the value at p is the value at m·p.
fn moved(shot: &Stage, m: DMat3, field: impl Fn(DVec3) -> f64) -> Stage {
    let grid = shot.volume.grid();
    let dims = (m * DVec3::from_array(grid.dims().map(|n| n as f64))).abs();
    let spacing = (m * DVec3::from_array(grid.spacing())).abs();
    let volume = on(centred(dims.to_array().map(|n| n as usize), spacing), |p| field(m.transpose() * p));
    let flip = m.determinant() < 0.0;
    // A mirrored thing in a mirrored style is a mirrored picture.
    let styles = if flip { vec![look(true)] } else { shot.styles.clone() };
    Stage { volume, styles, ..shot.clone() }.with(|s| {
        let Camera { eye, direction, up, .. } = &mut s.camera;
        *eye = eye.map(|eye| m * eye);
        (*direction, *up) = (m * *direction, m * *up);
    })
}

/// A style without symmetry, or its mirror image.
fn look(mirrored: bool) -> drypoint::scene::style::Style {
    let sign = if mirrored { -1.0 } else { 1.0 };
    style("look", 64, move |x, y| [0.5 + 0.5 * sign * x, 0.5 + 0.25 * y, 0.25, 0.75])
}

/// The channels of a layer row by row, mirrored if asked for.
fn rows(shown: &Shown, kind: LayerKind, mirrored: bool) -> Vec<Vec<f64>> {
    let width = shown.picture.width;
    let channels = &shown.picture.layer(kind).unwrap().channels;
    let turned = |channel: &Vec<f64>| {
        let mut channel = channel.clone();
        if mirrored {
            channel.chunks_mut(width).for_each(<[f64]>::reverse);
        }
        channel
    };
    channels.iter().map(turned).collect()
}

/// Whole numbers: a thing with flat parts, slopes and a hole, up to the border on one side.
fn whole(p: DVec3) -> f64 {
    let far = (p.x + 1.0).abs().max(2.0 * p.y.abs()).max((p.z - 0.5).abs());
    (40.0 - 8.0 * far + 3.0 * p.x - p.z).floor().clamp(-20.0, 30.0)
}

/// Orthographic along an axis, or straight down between two, with pixels, steps and planes at dyadic places.
fn along_axes(shot: &Stage, direction: DVec3, up: DVec3) -> Stage {
    shot.with(|s| {
        s.camera = Camera {
            direction,
            up,
            eye: Some(-direction * 16.0 + DVec3::splat(0.125)),
            direction_given: true,
            ..orthographic(Some(12.0))
        };
        s.picture.size = [24, 24];
        s.sampling.step = Length::World(0.25);
        s.sampling.reference_length = Length::World(1.0);
    })
}

/// The voxels of the dyadic phantom: places from the middle are halves of spacings.
fn phantom() -> Grid {
    centred([11, 15, 8], DVec3::new(1.0, 0.5, 2.0))
}

/// Shaded, with layers, seen along two axes.
fn shaded() -> [Stage; 2] {
    let nodes = [(-5.0, [0.9, 0.3, 0.2], 0.0), (10.0, [0.2, 0.9, 0.2], 0.2), (25.0, [0.1, 0.4, 0.9], 0.6)];
    let regular = Stage::regular(on(phantom(), whole), &nodes)
        .layers(&[LayerKind::Depth, LayerKind::Normal, LayerKind::Gradient, LayerKind::First])
        .with(|s| s.shading = Some(Shading::default()));
    [(DVec3::Y, DVec3::Z), (-DVec3::X, DVec3::Y)].map(|(direction, up)| along_axes(&regular, direction, up))
}

fn dyadic_in_f32() -> f64 {
    worst(shaded().into_iter().flat_map(|shot| {
        let here = shot.in_number(Number::F32);
        let still = here.render();
        assert!(still.covered() > 100);
        symmetries().into_iter().map(move |m| {
            let a = rows(&still, LayerKind::Beauty, m.determinant() < 0.0).concat();
            let b = rows(&moved(&here, m, whole).render(), LayerKind::Beauty, false).concat();
            worst(a.into_iter().zip(b).map(|(a, b)| (a - b).abs()))
        })
    }))
}

fn dyadic() -> f64 {
    let mut differ = 0.0;
    for here in shaded() {
        let still = here.render();
        assert!(still.covered() > 100);
        for m in symmetries() {
            let there = moved(&here, m, whole).render();
            let mirrored = m.determinant() < 0.0;
            for kind in [LayerKind::Beauty, LayerKind::Depth, LayerKind::First] {
                differ += differing(&rows(&still, kind, mirrored).concat(), &rows(&there, kind, false).concat());
            }
            // Normals in eye space, their x mirrored; gradients in the world, moved.
            let [normals, others] = [rows(&still, LayerKind::Normal, mirrored), rows(&there, LayerKind::Normal, false)];
            let sign = if mirrored { -1.0 } else { 1.0 };
            let turned: Vec<f64> = normals[0].iter().map(|x| sign * x).collect();
            differ += differing(&turned, &others[0]) + differing(&normals[1..], &others[1..]);
            let gradients = rows(&still, LayerKind::Gradient, mirrored);
            let moved: Vec<DVec3> = (0..gradients[0].len())
                .map(|i| m * DVec3::from_array([0, 1, 2].map(|c: usize| gradients[c][i])))
                .collect();
            let others = rows(&there, LayerKind::Gradient, false);
            let others: Vec<DVec3> =
                (0..others[0].len()).map(|i| DVec3::from_array([0, 1, 2].map(|c: usize| others[c][i]))).collect();
            differ += differing(&moved, &others);
        }
    }
    differ
}

fn dyadic_styles() -> f64 {
    let nodes = [(-5.0, "look", 0.0), (10.0, "look", 0.25), (25.0, "look", 0.5)];
    let shot = Stage::styled(on(phantom(), whole), vec![look(false)], &nodes)
        .with(|s| s.volume.gradient_range = GradientRange::Fixed([0.0, 16.0]));
    let mut differ = 0.0;
    for (direction, up) in [(DVec3::Y, DVec3::Z), (-DVec3::X, DVec3::Y)] {
        let here = along_axes(&shot, direction, up);
        let still = here.render();
        assert!(still.covered() > 100);
        for m in symmetries().into_iter().filter(|m| m.determinant() > 0.0) {
            differ += differing(&still.pixels(), &moved(&here, m, whole).render().pixels());
        }
    }
    differ
}

/// Waves up to the border, not whole and not dyadic.
fn wave(p: DVec3) -> f64 {
    50.0 + 40.0 * (0.9 * p.x + 0.3).sin() * (0.7 * p.y).cos() + 20.0 * (0.8 * p.z - 0.1 * p.x).sin()
}

fn waves() -> f64 {
    let grid = centred([11, 13, 9], DVec3::new(1.0, 0.75, 1.3));
    let volume = on(grid, wave);
    // A soft flank, and a step.
    let regular = [
        (20.0, [0.9, 0.3, 0.2], 0.0),
        (60.0, [0.2, 0.9, 0.2], 0.2),
        (60.0, [0.2, 0.9, 0.2], 0.5),
        (90.0, [0.1; 3], 0.4),
    ];
    let styled = [(35.0, "look", 0.0), (62.3, "look", 0.3), (62.3, "look", 0.6), (90.0, "look", 0.8)];
    let kernels = [
        (Kernel::Trilinear, GradientEstimator::Central, HessianEstimator::Central),
        (Kernel::Bspline, GradientEstimator::Analytic, HessianEstimator::Analytic),
        (Kernel::BsplineSmooth, GradientEstimator::Sobel, HessianEstimator::Gaussian),
        (Kernel::Bspline5, GradientEstimator::Analytic, HessianEstimator::Analytic),
        (Kernel::CatmullRom, GradientEstimator::Regression, HessianEstimator::Gaussian),
    ];
    let cameras = [
        Camera { direction: DVec3::new(0.4, 0.8, -0.5), up: DVec3::new(0.1, 0.0, 1.0), ..perspective(40.0) },
        Camera { direction: DVec3::new(-0.7, 0.2, 0.6), up: DVec3::new(0.0, 1.0, 0.2), ..orthographic(Some(14.0)) },
    ];
    let (mut differ, mut pixels) = (0, 0);
    for (i, (kernel, gradient, hessian)) in kernels.into_iter().enumerate() {
        for (j, camera) in cameras.iter().enumerate() {
            let kappa = if j == 0 { Kappa::Exact } else { Kappa::Ray };
            let shot = if (i + j) % 3 == 2 {
                Stage::regular(volume.clone(), &regular).with(|s| s.shading = Some(Shading::default()))
            } else {
                Stage::styled(volume.clone(), vec![look(false)], &styled)
                    .with(|s| s.contours = Some(Contours { kappa, ..Contours::default() }))
            };
            let here = shot.with(|s| {
                s.camera = camera.clone();
                s.picture.size = [32, 32];
                (s.sampling.kernel, s.sampling.gradient, s.sampling.hessian) = (kernel, gradient, hessian);
            });
            let still = here.render();
            for m in symmetries().into_iter().skip(i % 4).step_by(4) {
                let there = moved(&here, m, wave).render();
                let rows = |shown, mirrored| rows(shown, LayerKind::Beauty, mirrored);
                let (a, b) = (rows(&still, m.determinant() < 0.0), rows(&there, false));
                pixels += still.covered();
                differ += (0..a[0].len()).filter(|&t| !(0..4).all(|c| (a[c][t] - b[c][t]).abs() <= 1e-12)).count();
            }
        }
    }
    assert!(pixels > 20_000, "{pixels}");
    differ as f64 / pixels as f64
}
