//! Extreme scales ([SPACE-4], [VAL-1]): values and lengths of 10^±30, and worlds far from their origin.

use crate::common::strip::ramp;
use crate::common::{LAYERS, Stage, largest_difference, on, orthographic, perspective};
use crate::stability::{Case, Theme, differing, worst};
use drypoint::scene::glam::{DMat3, DVec3};
use drypoint::scene::math::scale_by_power_of_two;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{
    Camera, Contours, GradientRange, HessianEstimator, Kappa, Kernel, Length, Number, Shading,
};

pub(crate) static THEME: Theme = Theme::new(
    "Extreme scales",
    &[
        Case {
            name: "values of 10^±30",
            breaks: "squares of gradients and Hessians overflow or vanish",
            done: "derivatives are squared only after scaling by a power of two [SPACE-4]",
            of: "largest difference of a channel from values of 1; styles with exact contours, Phong",
            bound: 1e-12,
            why: "10³⁰ is no power of two: voxels, nodes and slopes round by ε each, 60 samples a ray",
            measure: values,
        },
        Case {
            name: "spacings of 2^±100, lengths and camera with them",
            breaks: "κ of 10^±30, tangents and lengths that vanish",
            done: "as above; all lengths are in one unit [SPACE-5]",
            of: "numbers with another bit in the picture and its normals; 2 kernels, exact and ray κ",
            bound: 0.0,
            why: "a power of two changes no mantissa",
            measure: || spacings_by_two(Number::F64),
        },
        Case {
            name: "the same in f32",
            breaks: "as above",
            done: "as above",
            of: "numbers with another bit in the picture and its normals; 2 kernels, exact and ray κ",
            bound: 0.0,
            why: "as above: 2^±100 is a number of f32 too, its square is not",
            measure: || spacings_by_two(Number::F32),
        },
        Case {
            name: "spacings of 10^±30, lengths and camera with them",
            breaks: "as above",
            done: "as above",
            of: "largest difference of a channel from a spacing of 1",
            bound: 1e-12,
            why: "as for values, for positions",
            measure: spacings_by_ten,
        },
        Case {
            name: "a world 2³⁰ voxels from its origin",
            breaks: "positions in the world lose the digits between voxels",
            done: "a ray is moved into index space before it is walked along",
            of: "numbers with another bit, all layers; a camera along an axis, dyadic places",
            bound: 0.0,
            why: "sums of dyadic numbers below 2⁵³ are exact",
            measure: far_from_the_origin,
        },
    ],
);

#[test]
fn extreme_scales() {
    THEME.hold();
}

/// A smooth field of [0.1, 0.9] that no axis is special for.
fn wave(p: DVec3) -> f64 {
    0.5 + 0.25 * (0.7 * p.x + 0.2).sin() + 0.15 * (0.8 * p.y - 0.3 * p.z).cos()
}

/// The scene over values times `value`, in a world whose lengths are times `length`.
fn scenes(value: f64, length: f64) -> Vec<Stage> {
    let grid = Grid::with_spacing([12, 11, 10], [1.0, 0.75, 1.25].map(|s| s * length)).unwrap();
    let volume = on(grid, |p| value * wave(p / length));
    let looked = |shot: Stage, kernel, kappa| {
        shot.layers(&[LayerKind::Normal]).with(|s| {
            s.camera = Camera { direction: DVec3::new(0.4, 0.8, -0.5), ..perspective(35.0) };
            s.camera.eye = Some(DVec3::new(-8.0, -16.0, 16.0) * length);
            s.camera.direction_given = true;
            s.sampling.kernel = kernel;
            s.sampling.hessian = HessianEstimator::Auto;
            s.sampling.step = Length::World(0.25 * length);
            s.sampling.reference_length = Length::World(1.5 * length);
            s.volume.gradient_range = GradientRange::Quantile(0.99);
            s.contours = Some(Contours { kappa, thickness: Length::World(0.75 * length), ..Contours::default() });
        })
    };
    let nodes = [(0.3 * value, "ramp", 0.0), (0.5 * value, "ramp", 0.2), (0.8 * value, "ramp", 0.7)];
    let styled = Stage::styled(volume.clone(), vec![ramp()], &nodes);
    let nodes = [(0.3 * value, [0.9, 0.3, 0.2], 0.0), (0.8 * value, [0.2, 0.5, 0.9], 0.5)];
    let regular = Stage::regular(volume, &nodes).with(|s| s.shading = Some(Shading::default()));
    vec![
        looked(styled.clone(), Kernel::Bspline, Kappa::Exact),
        looked(styled, Kernel::Trilinear, Kappa::Ray),
        looked(regular, Kernel::Trilinear, Kappa::Ray),
    ]
}

/// The largest difference from the scene at scale 1.
fn off(value: f64, length: f64) -> f64 {
    let pairs = scenes(1.0, 1.0).into_iter().zip(scenes(value, length));
    worst(pairs.map(|(one, other)| {
        let one = one.render();
        assert!(one.covered() > 60);
        largest_difference(&one, &other.render())
    }))
}

fn values() -> f64 {
    worst([1e30, 1e-30].map(|scale| off(scale, 1.0)))
}

fn spacings_by_ten() -> f64 {
    worst([1e30, 1e-30].map(|scale| off(1.0, scale)))
}

fn spacings_by_two(number: Number) -> f64 {
    let scales = [-100, -37, 1, 100].map(|k| scale_by_power_of_two(1.0, k));
    let differ = scales.map(|scale| {
        let pairs = scenes(1.0, 1.0).into_iter().zip(scenes(1.0, scale));
        pairs
            .map(|(one, other)| {
                let [one, other] = [one, other].map(|shot| shot.in_number(number).render());
                assert!(one.covered() > 60);
                differing(&one.bits(), &other.bits())
            })
            .sum::<f64>()
    });
    differ.into_iter().sum()
}

fn far_from_the_origin() -> f64 {
    let seen = |origin: DVec3| {
        let grid = Grid::new([9, 8, 10], DMat3::from_diagonal(DVec3::new(1.0, 0.5, 2.0)), origin).unwrap();
        let centre = grid.centre();
        let nodes = [(0.3, "ramp", 0.0), (0.5, "ramp", 0.2), (0.8, "ramp", 0.7)];
        Stage::styled(on(grid, |p| wave(p - origin)), vec![ramp()], &nodes)
            .layers(&LAYERS)
            .with(|s| {
                s.camera = Camera {
                    direction: DVec3::Y,
                    eye: Some(centre - DVec3::Y * 8.0),
                    direction_given: true,
                    ..orthographic(Some(16.0))
                };
                s.sampling.step = Length::World(0.125);
                s.contours = Some(Contours { kappa: Kappa::Exact, ..Contours::default() });
            })
            .render()
    };
    let here = seen(DVec3::ZERO);
    assert!(here.covered() > 60);
    let far = f64::from(1 << 30);
    let origins = [DVec3::splat(far), DVec3::new(-far, 0.0, far)];
    origins.map(|origin| differing(&here.bits(), &seen(origin).bits())).into_iter().sum()
}
