//! Dots on a sphere whose voxels are not cubes: as many a unit of area everywhere, whatever lies between two slices
//! ([STIP-4]). Voxels whose pieces of a face overlap or leave gaps show as rows of dots, one a slice.

use super::{drawn_from, flat, params, table};
use crate::common;
use drypoint::reference::volume_stippling::{FrameDots, Frames, Preprocess};
use drypoint::scene::counts::Counts;
use drypoint::scene::glam::DVec3;
use drypoint::scene::marks::Page;
use drypoint::scene::math::{cos, exp, sin};
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{Camera, PointsPerPixel, Snap, Stipples, Threshold};
use drypoint::scene::view::View;
use std::f64::consts::TAU;

const RADIUS: f64 = 40.0;

/// Points of a voxel.
const EACH: f64 = 6.0;

/// A sphere in dots.
struct Sphere {
    /// Where they are, as directions from its middle.
    dots: Vec<DVec3>,
    /// How far the middle is from a slice.
    middle: f64,
    /// The voxels that have dots.
    cells: Vec<[u32; 3]>,
}

/// A sphere whose edge is a logistic function of the distance over `soft` slices; of 0, a step.
fn sphere(slices: f64, soft: f64) -> Sphere {
    let side = 2.0 * (RADIUS + 4.0 * slices);
    let dims = [side as usize, side as usize, (side / slices) as usize];
    let grid = Grid::with_spacing(dims, [1.0, 1.0, slices]).unwrap();
    let centre = grid.centre();
    let volume = common::on(grid, |p| match (p - centre).length() - RADIUS {
        outside if soft == 0.0 => f64::from(u8::from(outside < 0.0)),
        outside => 1.0 / (1.0 + exp(outside / (soft * slices))),
    });
    let view = View::new(&Camera::default(), volume.grid(), [1000, 1000]).unwrap();
    let stipples = Stipples {
        thin: true,
        snap: Snap::Edge,
        threshold: Threshold::Magnitude(0.2),
        k_max: PointsPerPixel::Number(1.0),
        ..Stipples::default()
    };
    let table = table();
    let made = |stipples: &Stipples| {
        let preprocess = Preprocess::new(params(stipples, &table, volume.grid(), &view), &volume, None).unwrap();
        (preprocess.each, preprocess.points(&mut Counts::default(), &|_| {}).unwrap())
    };
    // Eq. 1 is linear in k_max.
    let k_max = PointsPerPixel::Number(2.0 * EACH / made(&stipples).0 as f64);
    let stipples = Stipples { k_max, ..stipples };
    let points = made(&stipples).1;
    let stipples = flat(stipples, &points, volume.grid(), &view, EACH);
    let frames = Frames::new(drawn_from(&stipples, &points, volume.grid(), &view, 1.0));
    let mut drawn = FrameDots::default();
    frames.draw(&view, &Page::in_pixels(view.size, 0.0, 254.0), &mut drawn);
    let dots = drawn.dots().map(|dot| (dot.world - centre).normalize()).collect();
    Sphere { dots, middle: centre.z / slices, cells: points.voxels.iter().map(|voxel| voxel.cell).collect() }
}

/// The dots a unit of area about each of some angles to the slices' axis, and their wave of one slice, as a share.
fn zones(sphere: &Sphere, slices: f64) -> Vec<[f64; 2]> {
    let zone = |degrees: f64| {
        // Whole slices about that angle.
        let about = (RADIUS * cos(degrees.to_radians()) / slices + sphere.middle).floor() - sphere.middle;
        let half = (3.0 / slices).ceil();
        let heights = sphere.dots.iter().map(|n| n.z * RADIUS / slices).filter(|z| (z - about).abs() < half);
        let phases: Vec<f64> = heights.map(|z| TAU * (z + sphere.middle)).collect();
        let count = phases.len() as f64;
        let wave = phases.iter().map(|&p| cos(p)).sum::<f64>().hypot(phases.iter().map(|&p| sin(p)).sum());
        let (wave, noise) = (2.0 * wave / count, 2.0 / count.sqrt());
        let density = count / (TAU * RADIUS * 2.0 * half * slices);
        println!("slices {slices}, {degrees}°: density {density:.3}, wave {wave:.3}, white noise {noise:.3}");
        [density, wave]
    };
    [25.0, 35.0, 45.0, 55.0, 65.0, 75.0, 85.0].map(zone).to_vec()
}

/// The largest density over the least.
fn spread(zones: &[[f64; 2]]) -> f64 {
    let (least, most) = zones.iter().fold((f64::MAX, 0.0f64), |(a, b), zone| (a.min(zone[0]), b.max(zone[0])));
    most / least
}

/// A zone of a sphere has the area 2πR·height, so that an even one has as many dots at each height within a slice: their wave
/// of one slice is no more than noise of their number, and that number over the area is the same in all zones.
#[test]
fn a_sphere_has_no_rows_of_dots() {
    // Twice as wide as slices are apart, and as wide.
    for (slices, soft) in [1.0, 2.0, 4.0].into_iter().flat_map(|slices| [0.6, 0.3].map(|soft| (slices, soft))) {
        println!("an edge of {soft} slices");
        let zones = zones(&sphere(slices, soft), slices);
        assert!(zones.iter().all(|zone| zone[1] < 0.08), "slices {slices}, soft {soft}: {zones:?}");
        assert!(spread(&zones) < 1.1, "slices {slices}, soft {soft}: {zones:?}");
    }
}

/// The edge of a segmentation: nothing tells where between two slices it is, and ‖∇V‖ is the same on both sides. One layer
/// all the same, of treads and risers, whose area is that of the sphere at least and √2 times as much at most.
#[test]
fn a_step_has_one_layer() {
    for slices in [1.0, 2.0, 4.0] {
        println!("a step");
        let sphere = sphere(slices, 0.0);
        let zones = zones(&sphere, slices);
        assert!(spread(&zones) < 2f64.sqrt(), "slices {slices}: {zones:?}");
        // Columns across slices, where the face is nearer to them than to the other axes.
        let steepest = RADIUS * sin(40f64.to_radians());
        let centre = RADIUS + 4.0 * slices - 0.5;
        let side = (2.0 * centre) as u32;
        for (x, y) in (0..=side).flat_map(|y| (0..=side).map(move |x| (x, y))).filter(|_| slices > 1.0) {
            if (f64::from(x) - centre).hypot(f64::from(y) - centre) < steepest {
                let above = |cell: &&[u32; 3]| cell[..2] == [x, y] && f64::from(cell[2]) > sphere.middle;
                assert_eq!(sphere.cells.iter().filter(above).count(), 1, "slices {slices}: {x} {y}");
            }
        }
    }
}
