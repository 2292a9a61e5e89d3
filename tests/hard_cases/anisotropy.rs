//! Voxels of 1 : 1000, and sheared ones ([SPACE-2], [SPACE-4]).

use crate::common::{Stage, on, orthographic, perspective};
use crate::reconstruction::{linear, linear_errors, places, sphere_errors, spheres};
use crate::slabs::in_steps;
use crate::stability::{Case, Theme, worst};
use drypoint::reference::number::Real;
use drypoint::scene::glam::{DMat3, DVec3};
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{Length, Number};

pub(crate) static THEME: Theme = Theme::new(
    "Anisotropy of 1 : 1000",
    &[
        Case {
            name: "linear fields",
            breaks: "a spacing that is forgotten once, or taken twice",
            done: "world gradients by D⁻ᵀ, Hessians by D⁻ᵀ H D⁻¹ [SPACE-4]",
            of: "errors of value, gradient, Hessian in units of c ε M‖D⁻¹‖ⁿ; 52 reconstructions, 4 grids",
            bound: 1.0,
            why: "exact for every estimator but for rounding [REC-4]; ‖D⁻¹‖ = cond(D)/‖D‖",
            measure: linear_fields::<f64>,
        },
        Case {
            name: "the same in f32",
            breaks: "as above",
            done: "as above",
            of: "errors of value, gradient, Hessian in units of c · 2u · M‖D⁻¹‖ⁿ; 52 reconstructions, 4 grids",
            bound: 1.0,
            why: "as above, with the ε of f32",
            measure: linear_fields::<f32>,
        },
        Case {
            name: "normals and curvatures of spheres",
            breaks: "normals bent towards the long axis; umbilics lose half of their digits",
            done: "as above; κ from a 2×2 block in a tangent frame [CUR-1]",
            of: "errors of N and of κ₁, κ₂ in units of c ε M‖D⁻¹‖/‖g‖ and with c ε M R‖D⁻¹‖²; 2 splines, 4 grids",
            bound: 1.0,
            why: "a quadratic is exact for the prefiltered splines but for rounding",
            measure: spheres_on_long_voxels,
        },
        Case {
            name: "homogeneous boxes",
            breaks: "steps in voxels, lengths in index space",
            done: "lengths are in the world [SPACE-5]",
            of: "|α − closed form| in units of one step's opacity; 4 grids, 3 directions",
            bound: 1.0,
            why: "the length of the ray, to one step [RAY-1]",
            measure: || boxes(Number::F64),
        },
        Case {
            name: "the same in f32",
            breaks: "as above",
            done: "as above",
            of: "|α − closed form| in units of the opacity of 1.001 steps, after 4 u a sample; 4 grids, 3 directions",
            bound: 1.0,
            why: "as above; the ends of a ray move by some u of the way from the eye",
            measure: || boxes(Number::F32),
        },
    ],
);

#[test]
fn anisotropy_of_1_to_1000() {
    THEME.hold();
}

/// Long along z, long along x, flat along y, and sheared with cond(D) = 1300; places of voxels are dyadic.
fn grids(dims: [usize; 3]) -> [Grid; 4] {
    let long = |spacing: [f64; 3]| DMat3::from_diagonal(spacing.into());
    let sheared = DMat3::from_cols(DVec3::X, DVec3::Y, DVec3::new(30.0, 20.0, 1.0));
    [long([1.0, 1.0, 1000.0]), long([1000.0, 1.0, 1.0]), long([1.0, 1.0 / 1024.0, 1.0]), sheared]
        .map(|axes| Grid::new(dims, axes, DVec3::new(-1.0, 2.0, 0.5)).unwrap())
}

fn linear_fields<R: Real>() -> f64 {
    worst([[7, 6, 5], [3, 4, 2]].into_iter().flat_map(grids).map(|grid| {
        let places = places(&grid, 30);
        linear_errors::<R>(&on(grid, linear), &places)
    }))
}

fn spheres_on_long_voxels() -> f64 {
    worst(grids([8, 7, 6]).into_iter().map(|grid| {
        // Outside the box, so that no place is the middle; a power of two keeps the voxels nearly exact.
        let centre = grid.centre() + DVec3::splat(2.0 * grid.radius());
        let radius = 2f64.powf(grid.radius().log2().ceil());
        let places = places(&grid, 30);
        sphere_errors(&on(grid, spheres(centre, radius)), centre, radius, &places)
    }))
}

fn boxes(number: Number) -> f64 {
    let directions = [DVec3::new(0.3, 0.8, -0.4), DVec3::Y, DVec3::new(-0.5, 0.1, 0.7)];
    worst(grids([6, 5, 7]).into_iter().flat_map(|grid| {
        directions.into_iter().flat_map(move |direction| {
            let step = grid.radius() / 40.0;
            let flat = on(grid.clone(), |_| 3.0);
            [orthographic(None), perspective(40.0)].map(|camera| {
                let shot = Stage::regular(flat.clone(), &[(0.0, [1.0; 3], 0.2)]).with(|s| {
                    s.camera = camera;
                    s.camera.direction = direction;
                    s.sampling.step = Length::World(step);
                    s.sampling.reference_length = Length::World(3.0 * step);
                    s.sampling.number = number;
                });
                in_steps(&shot, step, 0.2, 3.0 * step)
            })
        })
    }))
}
