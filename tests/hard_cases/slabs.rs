//! Homogeneous boxes ([RAY-1], [VAL-4]): opacity is a closed form of the length L of the ray inside.
//!
//! n samples Δ_ray apart have 1 − (1 − α₀)^(nΔ_ray/Δ₀), and n is L/Δ_ray rounded up or down, since the lattice belongs to
//! the camera: |α − (1 − (1 − α₀)^(L/Δ₀))| ≤ 1 − (1 − α₀)^(Δ_ray/Δ₀).

use crate::common::{Stage, on, orthographic, perspective};
use crate::stability::{Case, Theme, U, worse};
use drypoint::scene::glam::{DMat3, DVec3};
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{Length, Number, StepAlong};
use proptest::prelude::*;

pub(crate) static THEME: Theme = Theme::new(
    "Homogeneous boxes",
    &[
        Case {
            name: "a box of one opacity, from 48 directions",
            breaks: "opacity that depends on step, direction or field of view",
            done: "correction to the distance between samples on this ray is the last step [VAL-4]",
            of: "|α − (1 − (1 − α₀)^(L/Δ₀))| in units of one step's opacity; 5 grids, 6 steps, α₀ from 10⁻¹² to 0.999",
            bound: 1.0,
            why: "the lattice belongs to the camera: a ray has L/Δ_ray samples, rounded up or down [RAY-1]",
            measure: || boxes(Number::F64),
        },
        Case {
            name: "an orthographic camera moved by Δ, −3Δ, 100Δ along the view",
            breaks: "samples that hang on the box or on the camera's distance",
            done: "a position is a function of pixel and k, never accumulated [RAY-1]",
            of: "largest difference of a channel; 3 directions",
            bound: 1e-12,
            why: "the same planes: positions round by some ε, colours change by less than 10 a voxel, 40 samples a ray",
            measure: moved_by_steps,
        },
        Case {
            name: "the same in f32",
            breaks: "a sample more at both ends; sums that stand still",
            done: "positions from k; the correction is computed in f64 and rounded once",
            of: "|α − (1 − (1 − α₀)^(L/Δ₀))| in units of the opacity of 1.001 steps, after 4 u a sample",
            bound: 1.0,
            why: "as above: the ends of a ray move by some u of the way from the eye, less than a thousandth of a step; four roundings a sample",
            measure: || boxes(Number::F32),
        },
    ],
);

#[test]
fn homogeneous_boxes() {
    THEME.hold();
}

/// How far the opacities of a homogeneous box of α₀ per Δ₀ are off their closed form, in units of one step's opacity; in f32 after what
/// rounding can do.
pub(crate) fn in_steps(shot: &Stage, step: f64, alpha: f64, reference: f64) -> f64 {
    let lengths = lengths(shot, step, false);
    let pixels = shot.render().pixels();
    let off = lengths.into_iter().zip(pixels).map(|((length, cos), pixel)| {
        let opacity = |length: f64| -f64::exp_m1(length / reference * f64::ln_1p(-alpha));
        // Sums of opacities round relative to their size.
        let (most, steps) = match shot.scene.sampling.number {
            Number::F64 => (1e-12, 1.0),
            // The ends of the ray move with its positions.
            Number::F32 => (4.0 * U * (length * cos / step + 1.0), 1.001),
        };
        let rounding = most * opacity(length).max(alpha);
        ((pixel[3] - opacity(length)).abs() - rounding).max(0.0) / opacity(steps * step / cos)
    });
    off.fold(0.0, worse)
}

fn boxes(number: Number) -> f64 {
    let mut largest = 0.0;
    for i in 0..48 {
        let angle = f64::from(i) * 2.4;
        // Along a spiral over all directions, and along the axes.
        let z = 1.0 - (2.0 * f64::from(i) + 1.0) / 48.0;
        let askew = [angle.cos() * (1.0 - z * z).sqrt(), angle.sin() * (1.0 - z * z).sqrt(), z];
        let direction =
            if i % 8 == 7 { [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]][i as usize % 3] } else { askew };
        let step = [0.03, 0.25, 0.5, 0.77, 1.0, 3.0][i as usize % 6];
        let alpha = [1e-12, 0.001, 0.3, 0.999][i as usize % 4];
        let shot = Stage::regular(on(grid(i as usize % 5), |_| 3.0), &[(0.0, [0.5, 0.25, 1.0], alpha)]).with(|s| {
            s.camera = if i % 2 == 0 { orthographic(None) } else { perspective([5.0, 60.0, 120.0][i as usize % 3]) };
            s.camera.direction = direction.into();
            s.sampling.step = Length::World(step);
            s.sampling.reference_length = Length::World(1.3);
            s.picture.size = [11, 7];
            s.sampling.number = number;
        });
        largest = worse(largest, in_steps(&shot, step, alpha, 1.3));
    }
    largest
}

/// The world length of each pixel's ray inside the box, beyond `near`, in perspective.
fn lengths(shot: &Stage, near: f64, shells: bool) -> Vec<(f64, f64)> {
    let (view, grid) = (shot.view(), shot.volume.grid());
    let [lo, hi] = grid.index_box();
    let [width, height] = shot.scene.picture.size;
    (0..width * height)
        .map(|t| {
            let ray = view.ray((t % width) as f64 + 0.5, (t / width) as f64 + 0.5);
            let (o, d) = (grid.to_index(ray.origin), grid.inverse_axes() * ray.along);
            let nearest = if shells { near * ray.cos_phi } else { near };
            let mut range = [if view.perspective { nearest } else { f64::NEG_INFINITY }, f64::INFINITY];
            for a in 0..3 {
                let (x, y) = ((lo[a] - o[a]) / d[a], (hi[a] - o[a]) / d[a]);
                // 0/0: the ray runs in the face.
                if x.is_nan() || y.is_nan() {
                    continue;
                }
                range = [range[0].max(x.min(y)), range[1].min(x.max(y))];
            }
            ((range[1] - range[0]).max(0.0) * ray.along.length(), ray.cos_phi)
        })
        .collect()
}

fn grid(kind: usize) -> Grid {
    let sheared = DMat3::from_cols(DVec3::new(1.0, 0.2, 0.0), DVec3::new(-0.3, 0.9, 0.1), DVec3::new(0.2, 0.4, 2.0));
    match kind {
        0 => Grid::with_spacing([9, 7, 8], [1.0; 3]).unwrap(),
        1 => Grid::with_spacing([6, 9, 4], [1.0, 0.5, 4.0]).unwrap(),
        2 => Grid::new([6, 7, 5], sheared, DVec3::new(-40.0, 7.0, 1000.0)).unwrap(),
        // An axis of length 1 is a box one voxel thick.
        3 => Grid::with_spacing([7, 1, 6], [1.0, 3.0, 1.0]).unwrap(),
        _ => Grid::with_spacing([1, 1, 1], [2.0, 3.0, 4.0]).unwrap(),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(160))]

    #[test]
    fn homogeneous_boxes_have_their_opacity(
        kind in 0usize..5,
        direction in prop_oneof![
            prop::array::uniform3(-1.0..1.0f64),
            prop::sample::select(vec![[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 0.0]]),
        ],
        step in 0.03..3.0f64,
        alpha in prop_oneof![0.001..0.999f64, Just(1e-12)],
        reference in 0.2..5.0f64,
        fov in prop_oneof![Just(None), (1.0..150.0f64).prop_map(Some)],
        inside in any::<bool>(),
        shells in any::<bool>(),
        narrow in any::<bool>(),
        skip in any::<bool>(),
    ) {
        prop_assume!(DVec3::from_array(direction).length() > 0.1);
        let shot = Stage::regular(on(grid(kind), |_| 3.0), &[(0.0, [0.5, 0.25, 1.0], alpha)])
            .seen_along(direction)
            .with(|s| {
                let (direction, eye) = (s.camera.direction, if inside { Some(grid(kind).centre()) } else { None });
                s.camera = fov.map_or(orthographic(None), perspective);
                (s.camera.direction, s.camera.eye) = (direction, eye);
                s.camera.direction_given = inside;
                s.sampling.step = Length::World(step);
                s.sampling.reference_length = Length::World(reference);
                s.sampling.skip_empty = skip;
                s.sampling.step_along = if shells && fov.is_some() { StepAlong::Ray } else { StepAlong::Plane };
                s.sampling.number = if narrow { Number::F32 } else { Number::F64 };
                s.picture.size = [11, 7];
            });
        let shells = shot.scene.sampling.step_along == StepAlong::Ray;
        // In f32 a sample at a face can fall on its other side: one more or less. Opacities are rounded to 2⁻²⁴ each.
        let (steps, rounding) = if narrow { (2.0, 1e-4) } else { (1.0, 1e-12) };
        let pixels = shot.render().pixels();
        for (i, ((length, cos), pixel)) in lengths(&shot, step, shells).into_iter().zip(pixels).enumerate() {
            let ray_step = if shells { step } else { step / cos };
            let opacity = |length: f64| -f64::exp_m1(length / reference * f64::ln_1p(-alpha));
            let (whole, bound) = (opacity(length), opacity(ray_step * steps));
            prop_assert!(
                (pixel[3] - whole).abs() <= bound + rounding * whole.max(if narrow { 1.0 } else { alpha }),
                "pixel {i}: {} of {whole} ± {bound}", pixel[3]
            );
            // The straight colour does not change with the step.
            for (c, straight) in pixel.iter().zip([0.5, 0.25, 1.0]) {
                prop_assert!((c - straight * pixel[3]).abs() <= rounding);
            }
        }
    }
}

/// The lattice belongs to the camera: moved by a whole step along the view, an orthographic camera sees the same samples,
/// each by rounding of its position elsewhere. Moved by half a step it does not.
fn moved_by_steps() -> f64 {
    let mut largest = 0.0;
    let grid = Grid::with_spacing([14, 12, 10], [1.0, 0.7, 1.3]).unwrap();
    let field = |p: DVec3| (0.9 * p.x).sin() + (0.7 * p.y).cos() - (0.8 * p.z + 0.1 * p.x).sin();
    let nodes = [(-1.0, [1.0, 0.2, 0.1], 0.0), (0.5, [0.1, 0.9, 0.1], 0.2), (2.0, [0.2, 0.2, 1.0], 0.7)];
    for direction in [[0.0, 1.0, 0.0], [0.4, -0.7, 0.5], [-0.1, 0.2, 1.0]] {
        let step = 0.375;
        let seen = |moved: f64| {
            let shot = Stage::regular(on(grid.clone(), field), &nodes).seen_along(direction).with(|s| {
                s.sampling.step = Length::World(step);
                s.camera.eye = Some(grid.centre() + s.camera.direction.normalize() * moved);
                s.camera.direction_given = true;
                s.picture.size = [24, 24];
            });
            shot.render()
        };
        let still = seen(0.0);
        for steps in [1.0, -3.0, 100.0] {
            largest = worse(largest, crate::common::largest_difference(&still, &seen(steps * step)));
        }
        assert!(crate::common::largest_difference(&still, &seen(0.5 * step)) > 1e-4);
    }
    largest
}

/// At 120° the corner's samples are 2.65 Δ apart, and its opacity is corrected for that: shells, which are Δ apart on
/// every ray, converge to the same picture.
#[test]
fn planes_and_shells_converge_to_one_picture_at_120_degrees() {
    let shot = Stage::regular(on(grid(0), |p| p.y), &[(0.0, [1.0; 3], 0.0), (9.0, [0.2; 3], 0.3)]).with(|s| {
        let direction = s.camera.direction;
        s.camera = perspective(120.0);
        s.camera.direction = direction;
        s.camera.eye = Some(DVec3::new(4.0, -2.0, 3.5));
        s.camera.direction_given = true;
    });
    let seen = |step: f64, along| {
        shot.with(|s| {
            s.sampling.step = Length::World(step);
            s.sampling.step_along = along;
        })
        .render()
    };
    for step in [0.1, 0.05, 0.025] {
        let [planes, shells] = [StepAlong::Plane, StepAlong::Ray].map(|along| seen(step, along));
        // One sample at each end of the ray, of up to 0.3 per voxel and 2.65 Δ long, for each of the two pictures.
        let bound = 2.0 * 0.3567 * step * (1.0 + 2.65);
        assert!(crate::common::largest_difference(&planes, &shells) <= bound);
    }
}
