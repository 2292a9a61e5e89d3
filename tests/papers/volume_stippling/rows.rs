//! Dots on a sphere whose voxels are not cubes: as many a unit of area everywhere, whatever lies between two slices
//! ([STIP-4]). Voxels whose pieces of a face overlap or leave gaps show as rows of dots, one a slice.

use super::table;
use crate::common;
use drypoint::reference::volume_stippling::{Drawn, FrameInputs, Frames, Inputs, Preprocess, viewing_distance};
use drypoint::scene::counts::Counts;
use drypoint::scene::glam::DVec3;
use drypoint::scene::marks::Page;
use drypoint::scene::math::{cos, exp, sin};
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{Camera, Ink, LightDirection, PointsPerPixel, Resolution, Snap, Stipples, Threshold};
use drypoint::scene::view::View;
use std::f64::consts::TAU;

const RADIUS: f64 = 40.0;

/// Points of a voxel.
const EACH: f64 = 6.0;

/// Where the dots of a sphere are, as directions from its middle, and how far that is from a slice. Its edge is as wide as two
/// slices, so that they tell where it is.
fn sphere(slices: f64) -> (Vec<DVec3>, f64) {
    let side = 2.0 * (RADIUS + 4.0 * slices);
    let dims = [side as usize, side as usize, (side / slices) as usize];
    let grid = Grid::with_spacing(dims, [1.0, 1.0, slices]).unwrap();
    let centre = grid.centre();
    let volume = common::on(grid, |p| 1.0 / (1.0 + exp(((p - centre).length() - RADIUS) / (0.6 * slices))));
    let view = View::new(&Camera::default(), volume.grid(), [1000, 1000]).unwrap();
    let stipples = Stipples {
        thin: true,
        snap: Snap::Edge,
        threshold: Threshold::Magnitude(0.2),
        k_max: PointsPerPixel::Number(1.0),
        ink: Ink::Opaque,
        ..Stipples::default()
    };
    let table = table();
    let made = |stipples: &Stipples| {
        let inputs =
            Inputs { stipples, table: &table, volume: &volume, view: &view, near: 0.5, square: 1.0, tone: None };
        let preprocess = Preprocess::new(inputs).unwrap();
        (preprocess.each, preprocess.points(&mut Counts::default(), &|_| {}).unwrap())
    };
    // Eq. 1 is linear in k_max.
    let k_max = PointsPerPixel::Number(2.0 * EACH / made(&stipples).0 as f64);
    let stipples = Stipples { k_max, ..stipples };
    let (each, points) = made(&stipples);
    let reference = viewing_distance(&view, volume.grid().centre(), 0.5) * EACH / each as f64;
    let stipples = Stipples { resolution: Some(Resolution { re: 1.0, reference: Some(reference) }), ..stipples };
    let frames = Frames::new(FrameInputs {
        stipples: &stipples,
        points: &points,
        light: LightDirection::Head,
        grid: volume.grid(),
        reference: &view,
        near: 0.5,
        size: 1.0,
        nib: None,
        surface: None,
        tone: None,
    });
    let mut drawn = Drawn::default();
    frames.draw(&view, &Page::in_pixels(view.size, 0.0, 254.0), &mut drawn);
    let dots = drawn.dots().map(|dot| (dot.world - centre).normalize()).collect();
    (dots, centre.z / slices)
}

/// A zone of a sphere has the area 2πR·height, so that an even one has as many dots at each height within a slice: their wave
/// of one slice is no more than noise of their number, and that number over the area is the same in all zones.
#[test]
fn a_sphere_has_no_rows_of_dots() {
    for slices in [1.0, 2.0, 4.0] {
        let (dots, middle) = sphere(slices);
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
            println!("slices {slices}, {degrees}°: density {density:.3}, wave {wave:.3}, white noise {noise:.3}");
            assert!(wave < 0.08, "slices {slices}, {degrees}°: {wave}");
            densities.push(density);
        }
        let (least, most) = densities.iter().fold((f64::MAX, 0.0f64), |(a, b), &x| (a.min(x), b.max(x)));
        assert!(most / least < 1.1, "slices {slices}: {least} to {most}");
    }
}
