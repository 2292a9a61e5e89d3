//! The border of the box: closed, without a skirt, and no mirror ([SPACE-1], [REC-1], [REC-2]).

use crate::common::{Stage, on, orthographic};
use crate::reconstruction::{linear, linear_errors};
use crate::stability::{Case, Theme, worst};
use drypoint::reference::number::Real;
use drypoint::scene::glam::{DMat3, DVec3};
use drypoint::scene::picture::LayerKind;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{Camera, Length, Number};

pub(crate) static THEME: Theme = Theme::new(
    "Borders",
    &[
        Case {
            name: "linear fields on faces, edges and corners",
            breaks: "mirrored borders bend normals; one-sided differences lose an order",
            done: "kernels continue by c₋₁ = 3c₀ − 3c₁ + c₂, differences are of second order [REC-1, REC-2]",
            of: "errors of value, gradient, Hessian in units of c ε M‖D⁻¹‖ⁿ; 52 reconstructions, 3 grids",
            bound: 1.0,
            why: "exact for every estimator but for rounding [REC-4]",
            measure: on_the_faces::<f64>,
        },
        Case {
            name: "the same in f32",
            breaks: "as above",
            done: "as above",
            of: "errors of value, gradient, Hessian in units of c · 2u · M‖D⁻¹‖ⁿ; 52 reconstructions, 3 grids",
            bound: 1.0,
            why: "as above, with the ε of f32",
            measure: on_the_faces::<f32>,
        },
        Case {
            name: "sample planes exactly on both faces",
            breaks: "a face that belongs to nothing, or to both sides",
            done: "the box is closed, and asked on the position itself [RAY-1]",
            of: "samples too many or too few; along 3 axes, both ways",
            bound: 0.0,
            why: "n voxels have 2(n − 1) + 1 planes half a voxel apart",
            measure: || planes_on_faces(HAIR),
        },
        Case {
            name: "rays exactly in a face, and next to it",
            breaks: "0/0 for a ray along a face; a half-voxel skirt",
            done: "as above",
            of: "pixels that are seen and should not be, or the reverse; both faces of 2 axes",
            bound: 0.0,
            why: "the box is closed, and nothing lies beyond it",
            measure: || rays_in_faces(HAIR),
        },
        Case {
            name: "both in f32",
            breaks: "as above",
            done: "as above",
            of: "samples too many or too few, and pixels that are seen and should not be, or the reverse",
            bound: 0.0,
            why: "as above: places are dyadic, the hair is 2⁻¹⁶ voxels",
            measure: || planes_on_faces(HAIR_F32) + rays_in_faces(HAIR_F32),
        },
    ],
);

#[test]
fn borders() {
    THEME.hold();
}

fn on_the_faces<R: Real>() -> f64 {
    let axes = [
        DMat3::IDENTITY,
        DMat3::from_diagonal(DVec3::new(0.5, 0.5, 2.0)),
        DMat3::from_cols(DVec3::new(1.0, 0.25, 0.0), DVec3::new(-0.5, 1.5, 0.5), DVec3::new(0.25, 0.0, 2.0)),
    ];
    worst(axes.into_iter().map(|axes| {
        let grid = Grid::new([5, 4, 6], axes, DVec3::new(-1.0, 2.0, 0.5)).unwrap();
        let [lo, hi] = grid.index_box();
        // The lower end, within the first cell, the middle, within the last cell, the upper end of each axis.
        let along = |a: usize, i: usize| [lo[a], 0.3, 0.5 * hi[a] + 0.1, hi[a] - 0.7, hi[a]][i];
        let is_end = |i: usize| i == 0 || i == 4;
        let all = (0..125).map(|i| [i % 5, i / 5 % 5, i / 25]);
        let faces = all.filter(|at| at.iter().any(|&i| is_end(i)));
        let places: Vec<DVec3> = faces.map(|[i, j, k]| DVec3::new(along(0, i), along(1, j), along(2, k))).collect();
        linear_errors::<R>(&on(grid, linear), &places)
    }))
}

/// How far beside a face a ray lies that just misses it: many roundings of positions, and little of a voxel.
const HAIR: (Number, f64) = (Number::F64, 1.0 / (1u64 << 40) as f64);
const HAIR_F32: (Number, f64) = (Number::F32, 1.0 / 65536.0);

/// A box seen along an axis, with planes half a voxel apart of which one is `offset` before the box's near face.
fn along(direction: DVec3, up: DVec3, offset: f64) -> Stage {
    let grid = Grid::with_spacing([5, 7, 9], [1.0; 3]).unwrap();
    let (centre, [_, last]) = (grid.centre(), grid.index_box());
    let half = (direction.abs() * last).element_sum() / 2.0;
    Stage::regular(on(grid, |_| 3.0), &[(0.0, [1.0; 3], 0.25)]).layers(&[LayerKind::Counts]).with(|s| {
        s.camera = Camera {
            direction,
            up,
            // The plane at depth ¼ is `offset` before the near face.
            eye: Some(centre - direction * (half + 0.25 + offset)),
            direction_given: true,
            ..orthographic(Some(2.0))
        };
        s.picture.size = [4, 4];
        s.sampling.step = Length::World(0.5);
    })
}

fn planes_on_faces((number, hair): (Number, f64)) -> f64 {
    let mut wrong = 0.0;
    for (a, up) in [(DVec3::X, DVec3::Z), (DVec3::Y, DVec3::Z), (DVec3::Z, DVec3::Y)] {
        for direction in [a, -a] {
            let voxels = (a * DVec3::new(5.0, 7.0, 9.0)).element_sum();
            // On both faces; all a hair before them, so that the last face is missed, but the plane before it is not.
            for (offset, expected) in [(0.0, 2.0 * (voxels - 1.0) + 1.0), (hair, 2.0 * (voxels - 1.0))] {
                let counts = along(direction, up, offset).in_number(number).render().one(LayerKind::Counts);
                wrong += counts.iter().map(|n| (n - expected).abs()).sum::<f64>();
            }
        }
    }
    wrong
}

fn rays_in_faces((number, hair): (Number, f64)) -> f64 {
    let mut wrong = 0;
    // Along y, the faces of x at 0 and 4 in the middle column, and those of z at 0 and 8 in the middle row.
    for (at, face_of_x) in [(0.0, true), (4.0, true), (0.0, false), (8.0, false)] {
        for off in [-hair, 0.0, hair] {
            let seen = along(DVec3::Y, DVec3::Z, 0.0).in_number(number).with(|s| {
                s.picture.size = [1, 1];
                let (x, z) = if face_of_x { (at + off, 3.0) } else { (2.0, at + off) };
                s.camera.eye = Some(DVec3::new(x, -4.0, z));
            });
            let inside = if at == 0.0 { off >= 0.0 } else { off <= 0.0 };
            wrong += usize::from((seen.render().covered() == 1) != inside);
        }
    }
    wrong as f64
}
