//! Dots on a sphere whose voxels are not cubes: as many a unit of area everywhere, whatever lies between two slices
//! ([STIP-4]). Voxels whose pieces of a face overlap or leave gaps show as rows of dots, one a slice.

use super::{drawn_from, flat, made_from, table};
use crate::common;
use drypoint::reference::volume_stippling::{Drawn, Frames, Preprocess};
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

/// Where the dots of a sphere are, as directions from its middle, and how far that is from a slice. Its edge is a logistic
/// function of the distance over `soft` slices.
fn sphere(slices: f64, soft: f64) -> (Vec<DVec3>, f64) {
    let side = 2.0 * (RADIUS + 4.0 * slices);
    let dims = [side as usize, side as usize, (side / slices) as usize];
    let grid = Grid::with_spacing(dims, [1.0, 1.0, slices]).unwrap();
    let centre = grid.centre();
    let volume = common::on(grid, |p| 1.0 / (1.0 + exp(((p - centre).length() - RADIUS) / (soft * slices))));
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
        let preprocess = Preprocess::new(made_from(stipples, &table, &volume, &view)).unwrap();
        (preprocess.each, preprocess.points(&mut Counts::default(), &|_| {}).unwrap())
    };
    // Eq. 1 is linear in k_max.
    let k_max = PointsPerPixel::Number(2.0 * EACH / made(&stipples).0 as f64);
    let stipples = Stipples { k_max, ..stipples };
    let points = made(&stipples).1;
    let stipples = flat(stipples, &points, volume.grid(), &view, EACH);
    let frames = Frames::new(drawn_from(&stipples, &points, volume.grid(), &view, 1.0));
    let mut drawn = Drawn::default();
    frames.draw(&view, &Page::in_pixels(view.size, 0.0, 254.0), &mut drawn);
    let dots = drawn.dots().map(|dot| (dot.world - centre).normalize()).collect();
    (dots, centre.z / slices)
}

/// A zone of a sphere has the area 2πR·height, so that an even one has as many dots at each height within a slice: their wave
/// of one slice is no more than noise of their number, and that number over the area is the same in all zones.
#[test]
fn a_sphere_has_no_rows_of_dots() {
    // Twice as wide as slices are apart, and as wide.
    for (slices, soft) in [1.0, 2.0, 4.0].into_iter().flat_map(|slices| [0.6, 0.3].map(|soft| (slices, soft))) {
        let (dots, middle) = sphere(slices, soft);
        let mut densities = Vec::new();
        for degrees in [25f64, 35.0, 45.0, 55.0, 65.0, 75.0, 85.0] {
            // Whole slices about that angle to their axis.
            let about = (RADIUS * cos(degrees.to_radians()) / slices + middle).floor() - middle;
            let half = (3.0 / slices).ceil();
            let heights = dots.iter().map(|n| n.z * RADIUS / slices).filter(|z| (z - about).abs() < half);
            let phases: Vec<f64> = heights.map(|z| TAU * (z + middle)).collect();
            let count = phases.len() as f64;
            let wave = phases.iter().map(|&p| cos(p)).sum::<f64>().hypot(phases.iter().map(|&p| sin(p)).sum());
            let (wave, noise) = (2.0 * wave / count, 2.0 / count.sqrt());
            let density = count / (TAU * RADIUS * 2.0 * half * slices);
            println!(
                "slices {slices}, soft {soft}, {degrees}°: density {density:.3}, wave {wave:.3}, white noise {noise:.3}"
            );
            assert!(wave < 0.08, "slices {slices}, soft {soft}, {degrees}°: {wave}");
            densities.push(density);
        }
        let (least, most) = densities.iter().fold((f64::MAX, 0.0f64), |(a, b), &x| (a.min(x), b.max(x)));
        assert!(most / least < 1.1, "slices {slices}, soft {soft}: {least} to {most}");
    }
}
