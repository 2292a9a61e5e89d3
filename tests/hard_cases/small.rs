//! Volumes of 1×1×1, 1×N×1 and 2×2×2, with every kernel and estimator ([SPACE-1], [REC-1], [REC-2]).

use crate::common::{LAYERS, Stage, on, orthographic, perspective, plain};
use crate::reconstruction::{all, linear, linear_errors, places};
use crate::slabs::in_steps;
use crate::stability::{Case, Theme, worst};
use drypoint::reference::number::Real;
use drypoint::scene::glam::DVec3;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{Contours, Kappa, Length, Number};

pub(crate) static THEME: Theme = Theme::new(
    "Tiny volumes",
    &[
        Case {
            name: "linear fields on 1×1×1, 1×N×1, 2×2×2 and between",
            breaks: "stencils that read past the volume; derivatives along an axis that has none",
            done: "an axis of length 1 is constant and half a voxel wide to both sides [SPACE-1]",
            of: "errors of value, gradient, Hessian in units of c ε M‖D⁻¹‖ⁿ; 52 reconstructions, 12 sizes",
            bound: 1.0,
            why: "exact for every estimator but for rounding [REC-4]",
            measure: linear_fields::<f64>,
        },
        Case {
            name: "the same in f32",
            breaks: "as above",
            done: "as above",
            of: "errors of value, gradient, Hessian in units of c · 2u · M‖D⁻¹‖ⁿ; 52 reconstructions, 12 sizes",
            bound: 1.0,
            why: "as above, with the ε of f32",
            measure: linear_fields::<f32>,
        },
        Case {
            name: "the same, homogeneous: opacity",
            breaks: "a box without thickness is never met",
            done: "as above",
            of: "|α − closed form| in units of one step's opacity; orthographic and perspective",
            bound: 1.0,
            why: "the length of the ray, to one step [RAY-1]",
            measure: || boxes(Number::F64),
        },
        Case {
            name: "the same with noise: whole pictures",
            breaks: "NaN from a Gaussian, a prefilter or a fit on too few voxels",
            done: "borders continue by c₋₁ = 3c₀ − 3c₁ + c₂, with fewer samples linear or constant [REC-1]",
            of: "numbers that are NaN or opacities outside [0, 1], all layers; exact κ, every reconstruction",
            bound: 0.0,
            why: "no output is ever NaN [PREC-2]",
            measure: || noise(Number::F64),
        },
        Case {
            name: "homogeneous, in f32",
            breaks: "a box without thickness is never met",
            done: "an axis of length 1 is half a voxel wide to both sides [SPACE-1]",
            of: "|α − closed form| in units of the opacity of 1.001 steps, after 4 u a sample; orthographic and perspective",
            bound: 1.0,
            why: "the length of the ray, to one step and to some u of the way from the eye",
            measure: || boxes(Number::F32),
        },
        Case {
            name: "noise, in f32",
            breaks: "as for f64",
            done: "as for f64",
            of: "numbers that are NaN or opacities outside [0, 1], all layers; exact κ, every reconstruction",
            bound: 0.0,
            why: "no output is ever NaN [PREC-2]",
            measure: || noise(Number::F32),
        },
    ],
);

#[test]
fn tiny_volumes() {
    THEME.hold();
}

const SIZES: [[usize; 3]; 12] = [
    [1, 1, 1],
    [1, 2, 1],
    [1, 3, 1],
    [1, 9, 1],
    [4, 1, 1],
    [1, 1, 5],
    [2, 2, 2],
    [2, 1, 2],
    [1, 2, 3],
    [3, 3, 3],
    [2, 3, 4],
    [4, 2, 1],
];

fn grids() -> Vec<Grid> {
    SIZES.map(|dims| Grid::with_spacing(dims, [1.0, 2.0, 0.5]).unwrap()).to_vec()
}

fn linear_fields<R: Real>() -> f64 {
    worst(grids().into_iter().map(|grid| {
        let places = places(&grid, 20);
        linear_errors::<R>(&on(grid, linear), &places)
    }))
}

fn boxes(number: Number) -> f64 {
    let directions = [DVec3::new(0.3, 0.8, -0.4), DVec3::Y, -DVec3::X, DVec3::new(0.0, 0.6, 0.8)];
    worst(grids().into_iter().flat_map(|grid| {
        let flat = on(grid, |_| 3.0);
        directions.into_iter().flat_map(move |direction| {
            let flat = flat.clone();
            [orthographic(None), perspective(50.0)].map(|camera| {
                let shot = Stage::regular(flat.clone(), &[(0.0, [1.0; 3], 0.3)]).with(|s| {
                    s.camera = camera;
                    s.camera.direction = direction;
                    // One pixel looks through the middle, however thin the box.
                    s.picture.size = [11, 11];
                    s.sampling.step = Length::World(0.07);
                    s.sampling.reference_length = Length::World(1.0);
                    s.sampling.number = number;
                });
                assert!(shot.render().covered() > 0);
                in_steps(&shot, 0.07, 0.3, 1.0)
            })
        })
    }))
}

fn noise(number: Number) -> f64 {
    let mut wrong = 0;
    for grid in grids() {
        let rough = on(grid.clone(), |p| 100.0 * (91.7 * p.x + 37.1 * p.y + 71.3 * p.z + 1.0).sin());
        for how in all(grid.voxel()) {
            let glass = plain("glass", [0.2, 0.5, 0.8, 0.7]);
            let nodes = [(-100.0, "glass", 0.1), (0.0, "glass", 0.0), (100.0, "glass", 0.6)];
            let shown = Stage::styled(rough.clone(), vec![glass], &nodes)
                .layers(&LAYERS)
                .with(|s| {
                    s.camera.direction = DVec3::new(0.3, 0.8, -0.4);
                    s.picture.size = [5, 5];
                    s.contours = Some(Contours { kappa: Kappa::Exact, ..Contours::default() });
                    s.sampling.number = number;
                    s.sampling.kernel = how.kernel;
                    s.sampling.gradient = how.gradient;
                    s.sampling.hessian = how.hessian;
                })
                .render();
            wrong +=
                shown.picture.layers.iter().flat_map(|l| l.channels.iter().flatten()).filter(|v| v.is_nan()).count();
            wrong += shown.pixels().iter().filter(|p| !(0.0..=1.0).contains(&p[3])).count();
            assert!(shown.one(LayerKind::Counts).iter().any(|n| *n > 0.0));
        }
    }
    wrong as f64
}
