//! Faces of thin layers where voxels are not cubes: as dense whatever way they lie, and in total as eq. 1 says ([STIP-3],
//! [STIP-4]).

use super::{drawn_from, params, table};
use crate::common;
use drypoint::reference::volume_stippling::{FrameDots, Frames, Preprocess};
use drypoint::scene::counts::Counts;
use drypoint::scene::glam::DVec3;
use drypoint::scene::marks::Page;
use drypoint::scene::math::exp;
use drypoint::scene::shot::StippleParams;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{Camera, Length, PointsPerPixel, Projection, Snap, Stipples, Threshold};
use drypoint::scene::tone::{FULL, Tone};
use drypoint::scene::view::View;

const DIMS: [usize; 3] = [24, 20, 16];

const SPACINGS: [[f64; 3]; 5] = [[1.0; 3], [1.0, 1.0, 2.0], [1.0, 1.0, 4.0], [1.0, 2.0, 1.0], [1.0, 1.7, 3.1]];

/// Pixels a unit.
const SCALE: f64 = 10.0;

/// What eq. 1 gives a voxel, and how many dots a pixel a face across each axis has where it is seen from the front, T = 1.
fn faces(spacing: [f64; 3], direction: DVec3, k_max: PointsPerPixel, tone: Option<(&Tone, f64)>) -> (f64, [f64; 3]) {
    let grid = Grid::with_spacing(DIMS, spacing).unwrap();
    let projection = Projection::Orthographic { height: Some(Length::World(90.0)) };
    let camera = Camera { projection, direction, direction_given: true, ..Camera::default() };
    let view = View::new(&camera, &grid, [(90.0 * SCALE) as usize; 2]).unwrap();
    let table = table();
    let stipples =
        Stipples { k_max, thin: true, snap: Snap::Edge, threshold: Threshold::Magnitude(0.5), ..Stipples::default() };
    let mut eq_1 = 0.0;
    let densities = [0, 1, 2].map(|axis| {
        let n = DVec3::AXES[axis];
        // Between two voxels, nearer to one.
        let at = grid.centre() + 0.3 * spacing[axis] * n;
        let volume = common::on(grid.clone(), |p| 1.0 / (1.0 + exp((p - at).dot(n) / (0.6 * spacing[axis]))));
        let unthinned = Stipples { thin: false, ..stipples.clone() };
        let made = |stipples| {
            let dot_area = tone.map_or(1.0, |(_, dot)| dot);
            let params = StippleParams { dot_area, ..params(stipples, &table, volume.grid(), &view) };
            Preprocess::new(params, &volume, tone.map(|(tone, _)| tone)).unwrap()
        };
        eq_1 = made(&unthinned).each as f64;
        let preprocess = made(&stipples);
        assert_eq!(preprocess.box_side, 1);
        let mut points = preprocess.points(&mut Counts::default(), &|_| {}).unwrap();
        let voxels = DIMS.iter().product::<usize>() / DIMS[axis];
        assert_eq!(points.voxels.len(), voxels, "one layer");
        // At the border of the volume the fit leans n a little.
        let others = [(axis + 1) % 3, (axis + 2) % 3];
        let is_inner = |cell: [u32; 3]| others.iter().all(|&a| (1..DIMS[a] as u32 - 1).contains(&cell[a]));
        let inner: Vec<usize> = (0..voxels).filter(|&i| is_inner(points.voxels[i].cell)).collect();
        points.offsets = inner.iter().flat_map(|&i| points.of(i).to_vec()).collect();
        points.voxels = inner.iter().map(|&i| points.voxels[i]).collect();
        let frames = Frames::new(drawn_from(&stipples, &points, &grid, &view, 1.0));
        let mut drawn = FrameDots::default();
        frames.draw(&view, &Page::in_pixels(view.size, 0.0, 254.0), &mut drawn);
        // The last dot of a voxel is as opaque as its part of a dot, so that nothing is left to chance.
        drawn.dots().map(|dot| dot.opacity).sum::<f64>() / (inner.len() as f64 * cell(spacing, axis))
    });
    (eq_1, densities)
}

/// The pixels of a voxel's face across an axis.
fn cell(spacing: [f64; 3], axis: usize) -> f64 {
    spacing.iter().product::<f64>() / spacing[axis] * SCALE * SCALE
}

#[test]
fn faces_are_as_dense_as_eq_1_says_on_the_mean_over_the_box() {
    let directions = [DVec3::X, DVec3::NEG_Y, DVec3::Z, DVec3::new(0.5, -0.8, 0.3), DVec3::new(-0.1, 0.05, -1.0)];
    for (spacing, direction) in SPACINGS.into_iter().flat_map(|spacing| directions.map(|d| (spacing, d))) {
        let (eq_1, densities) = faces(spacing, direction, PointsPerPixel::Number(0.1), None);
        // Eq. 1 gives a face N_max dots a voxel; the box shows each of its faces by its area times the cosine.
        let shown = [0, 1, 2].map(|a| {
            let pieces = [(a + 1) % 3, (a + 2) % 3].map(|b| (DIMS[b] - 1) as f64);
            pieces[0] * pieces[1] * cell(spacing, a) * direction.normalize()[a].abs()
        });
        let dots: f64 = (0..3).map(|a| shown[a] * eq_1 / cell(spacing, a)).sum();
        let want = dots / shown.iter().sum::<f64>();
        for density in densities {
            assert!((density - want).abs() < 1e-9 * want, "{spacing:?} {direction}: {densities:?}, {want}");
        }
    }
}

#[test]
fn automatic_faces_print_the_full_tone_across_every_axis() {
    let (tone, dot) = (Tone::ideal(), 7.0);
    for spacing in SPACINGS {
        for direction in [DVec3::X, DVec3::Z, DVec3::new(0.5, -0.8, 0.3)] {
            let (_, densities) = faces(spacing, direction, PointsPerPixel::Auto, Some((&tone, dot)));
            for density in densities {
                assert!((density * dot - tone.ink(FULL)).abs() < 1e-9, "{spacing:?} {direction}: {densities:?}");
            }
        }
    }
}
