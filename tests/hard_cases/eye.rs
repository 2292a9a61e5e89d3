//! Where the eye stands and how wide it looks ([RAY-5], [RAY-6]).

use crate::camera::{first_positions, grids};
use crate::common::random::Random;
use crate::common::{Stage, on, orthographic, perspective};
use crate::slabs::in_steps;
use crate::stability::{Case, Theme, worst};
use drypoint::scene::glam::DVec3;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{Camera, Length, Number, Projection, StepAlong};
use drypoint::scene::view::View;
use drypoint::scene::volume::{Volume, Voxels};

pub(crate) static THEME: Theme = Theme::new(
    "The eye",
    &[
        Case {
            name: "the eye in the middle, on a voxel, on a face, in a corner",
            breaks: "rays that begin inside; division by a distance of 0",
            done: "depths begin beyond `near`, inside is decided on positions",
            of: "|α − closed form| of a homogeneous box in units of one step's opacity; 0.001°, 1°, 60°, 170°",
            bound: 1.0,
            why: "the length of the ray beyond `near`, to one step [RAY-1]",
            measure: || inside(Number::F64),
        },
        Case {
            name: "the same in f32",
            breaks: "as above",
            done: "as above",
            of: "|α − closed form| in units of the opacity of 1.001 steps, after 4 u a sample",
            bound: 1.0,
            why: "as above; positions round by u of a box's size",
            measure: || inside(Number::F32),
        },
        Case {
            name: "the eye 10⁶ box sizes away",
            breaks: "positions lose the digits that the distance takes",
            done: "a position is formed in index space in one expression",
            of: "|α − closed form| in units of one step's opacity; orthographic and perspective",
            bound: 1.0,
            why: "as above: rounding of positions moves samples by 10⁻⁹ voxels",
            measure: far_away,
        },
        Case {
            name: "the eye 10⁶ box sizes away: positions",
            breaks: "as above",
            done: "as above",
            of: "distance of a first sample from its closed form, in units of 16 ε times the distance; 2 grids",
            bound: 1.0,
            why: "origin, direction and depth round once or twice each, D⁻¹ and D at most triple it",
            measure: positions_far_away,
        },
        Case {
            name: "fields of view of 0.001°, 1°, and 170° from inside: positions",
            breaks: "tan and sin of nearly 0 and nearly 90°",
            done: "the distance follows from one tangent [RAY-5]",
            of: "distance of a first sample from its closed form, in units of 16 ε times the distance from the eye",
            bound: 1.0,
            why: "as above",
            measure: positions_by_field_of_view,
        },
        Case {
            name: "fields of view of 0.001°, 1°, and 170° from inside: opacity",
            breaks: "Δ/cosφ of 16 in the corners of 170°",
            done: "the correction is for the distance on this ray [VAL-4]",
            of: "|α − closed form| in units of one step's opacity",
            bound: 1.0,
            why: "the length of the ray, to one step [RAY-1]",
            measure: opacity_by_field_of_view,
        },
    ],
);

#[test]
fn the_eye() {
    THEME.hold();
}

const STEP: f64 = 0.37;
const ALPHA: f64 = 0.2;

/// A homogeneous box of α₀ = 0.2 a world unit.
fn slab(camera: Camera) -> Stage {
    Stage::regular(on(grid(), |_| 3.0), &[(0.0, [1.0; 3], ALPHA)]).with(|s| {
        s.camera = camera;
        s.sampling.step = Length::World(STEP);
        s.sampling.reference_length = Length::World(1.0);
    })
}

fn grid() -> Grid {
    Grid::with_spacing([9, 7, 8], [1.0, 1.25, 0.8]).unwrap()
}

fn inside(number: Number) -> f64 {
    let box_of = grid();
    let [first, last] = [box_of.world_corners()[0], box_of.world_corners()[7]];
    let eyes = [box_of.centre(), DVec3::new(4.0, 2.5, 2.4), DVec3::new(4.3, 0.0, 2.2), first, last];
    let directions = [DVec3::new(0.3, 0.8, -0.4), DVec3::Y, -DVec3::X, DVec3::new(-1.0, -1.0, -1.0)];
    worst(eyes.into_iter().flat_map(|eye| {
        directions.into_iter().flat_map(move |direction| {
            [0.001, 1.0, 60.0, 170.0].map(|fov| {
                let camera = Camera { eye: Some(eye), direction, direction_given: true, ..perspective(fov) };
                in_steps(&slab(camera).in_number(number), STEP, ALPHA, 1.0)
            })
        })
    }))
}

/// The camera at 10⁶ times the box's diagonal, and a picture that the box just fills.
fn far(grid: &Grid, direction: DVec3, projection: &Projection) -> Camera {
    far_by(grid, direction, projection, 2e6)
}

/// The same at some radii of the box.
fn far_by(grid: &Grid, direction: DVec3, projection: &Projection, radii: f64) -> Camera {
    let projection = match projection {
        Projection::Perspective { .. } => Projection::Perspective { fov: 2.0 * (1.0 / radii).atan().to_degrees() },
        Projection::Orthographic { .. } => Projection::Orthographic { height: None },
    };
    let eye = Some(grid.centre() - direction.normalize() * (radii * grid.radius()));
    Camera { projection, eye, direction, direction_given: true, ..Camera::default() }
}

const DIRECTIONS: [DVec3; 3] = [DVec3::new(0.3, 0.8, -0.4), DVec3::Y, DVec3::new(-0.5, 0.1, 0.7)];

fn far_away() -> f64 {
    worst(DIRECTIONS.into_iter().flat_map(|direction| {
        [perspective(1.0), orthographic(None)].map(|camera| {
            let shot = slab(far(&grid(), direction, &camera.projection));
            assert!(shot.render().covered() > 30);
            in_steps(&shot, STEP, ALPHA, 1.0)
        })
    }))
}

/// How far first samples lie from where the formulas say, in units of 16 ε times the distance from the eye.
fn positions(grid: &Grid, camera: &Camera) -> f64 {
    let size = [13, 8];
    let view = View::new(camera, grid, size).unwrap();
    let mut seen = 0;
    let off = worst(first_positions(grid, camera, size, StepAlong::Plane).into_iter().enumerate().map(|(t, found)| {
        let Some((position, depth)) = found else { return 0.0 };
        seen += 1;
        // The formulas of [RAY-6], about the camera's own axes.
        let x = ((t % 13) as f64 + 0.5 - 6.5) * view.pixel;
        let y = (4.0 - ((t / 13) as f64 + 0.5)) * view.pixel;
        let scale = if view.perspective { depth } else { 1.0 };
        let off = position - (view.eye + view.right * (x * scale) + view.up * (y * scale) + view.forward * depth);
        off.length() / (16.0 * f64::EPSILON * (view.eye.length() + grid.centre().length() + grid.radius()))
    }));
    assert!(seen > 10, "{seen}");
    off
}

fn positions_far_away() -> f64 {
    worst(grids().iter().flat_map(|grid| {
        DIRECTIONS.into_iter().flat_map(move |direction| {
            [perspective(1.0), orthographic(None)]
                .map(|camera| positions(grid, &far(grid, direction, &camera.projection)))
        })
    }))
}

/// Wide fields see a box from the default distance in hardly a pixel: at 170° the eye stands inside.
fn fields(grid: &Grid, direction: DVec3) -> [Camera; 3] {
    let eye = Some(grid.centre() - direction * (0.2 * grid.radius()));
    let inside = Camera { eye, direction_given: true, ..perspective(170.0) };
    [perspective(0.001), perspective(1.0), inside].map(|camera| Camera { direction, ..camera })
}

fn positions_by_field_of_view() -> f64 {
    worst(grids().iter().flat_map(|grid| {
        DIRECTIONS.into_iter().flat_map(|direction| fields(grid, direction).map(|camera| positions(grid, &camera)))
    }))
}

fn opacity_by_field_of_view() -> f64 {
    worst(DIRECTIONS.into_iter().flat_map(|direction| {
        fields(&grid(), direction).map(|camera| {
            let shot = slab(camera);
            assert!(shot.render().covered() > 30);
            in_steps(&shot, STEP, ALPHA, 1.0)
        })
    }))
}

/// From just over 2¹⁷ and 2²⁰ voxels away depths are coarser in f32 than positions are, and samples stand in other bricks
/// than the line through them: what is skipped has to know. A step next to 0 shows each of them.
#[test]
fn skipping_shows_nowhere_from_far_away_in_f32() {
    for seed in 0..6 {
        let mut random = Random(seed);
        let grid = Grid::with_spacing([40; 3], [1.0; 3]).unwrap();
        let values = (0..grid.len()).map(|_| if random.once_in(1000) { 1.0 } else { 0.0 }).collect();
        let field = Volume::new(grid.clone(), Voxels::F64(values), 1.0, 0.0).unwrap();
        let sparse = Stage::regular(field, &[(1e-6, [1.0; 3], 0.0), (2e-6, [1.0; 3], 0.1), (1.0, [1.0; 3], 0.2)]);
        let away = [17, 20].map(|power| 1.01 * 2f64.powi(power) + grid.radius())[seed as usize % 2];
        for direction in DIRECTIONS.into_iter().chain([DVec3::new(0.95, 0.1, 0.2), DVec3::new(0.2, -0.1, -0.9)]) {
            for projection in [perspective(1.0).projection, orthographic(None).projection] {
                let camera = far_by(&grid, direction, &projection, away / grid.radius());
                let shot = sparse.in_number(Number::F32).with(|s| {
                    s.camera = camera;
                    s.picture.size = [72, 72];
                    s.sampling.step = Length::Voxels(0.3);
                });
                let without = shot.with(|s| s.sampling.skip_empty = false).render();
                let with = shot.render();
                assert!(with.counts.samples * 2 < without.counts.samples && with.covered() > 200);
                assert!(with.bits() == without.bits(), "{seed} {direction} {projection:?}");
                assert!(shot.render_in_tiles(3).bits() == without.bits(), "{seed} {direction} {projection:?}, tiles");
            }
        }
    }
}
