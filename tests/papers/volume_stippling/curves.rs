//! Silhouette curves ([STIP-13]).

use super::{orthographic, table};
use crate::common;
use drypoint::reference::volume_stippling::{Edges, Inputs, Preprocess, exhaustive, joined};
use drypoint::scene::glam::DVec3;
use drypoint::scene::marks::Page;
use drypoint::scene::points::PointVoxel;
use drypoint::scene::tables::{Camera, Curves, CurvesTest, Outside, Stipples};
use drypoint::scene::view::View;
use drypoint::scene::volume::Volume;
use std::collections::BTreeSet;

/// A ball with an edge eight voxels wide: in a sharper one the fitted normals are off by more than a voxel's turn.
fn ball(radius: f64) -> Volume {
    let n = 2 * radius as usize + 13;
    let centre = DVec3::splat((n - 1) as f64 / 2.0);
    common::volume([n; 3], |p| {
        let t = ((radius - (p - centre).length()) / 4.0).clamp(-1.0, 1.0);
        0.5 + t * (3.0 - t * t) / 4.0
    })
}

fn perspective(volume: &Volume) -> View {
    let camera = Camera { direction: DVec3::new(0.3, 1.0, -0.4), ..Camera::default() };
    View::new(&camera, volume.grid(), [400, 400]).unwrap()
}

fn voxels(volume: &Volume, view: &View, curves: &Curves) -> Vec<PointVoxel> {
    let (stipples, table) = (Stipples::default(), table());
    // Pixels enough for the resolution to stay as it is.
    let square = 0.05;
    let inputs = Inputs { stipples: &stipples, table: &table, volume, view, near: 0.5, square };
    Preprocess::new(inputs).unwrap().voxels_above(curves.grad).unwrap()
}

#[test]
fn the_test_finds_what_the_exhaustive_search_finds() {
    // The exhaustive search knows no LoG.
    let curves = Curves { log: 2.0, ..Curves::default() };
    for radius in [10.0, 20.0, 30.0] {
        let volume = ball(radius);
        for view in [orthographic(&volume, 8.0), perspective(&volume)] {
            let voxels = voxels(&volume, &view, &curves);
            let edges = Edges::new(&volume, &voxels, &curves, Outside::Low).unwrap();
            let tested: BTreeSet<_> = edges.segments(&curves, &view).iter().map(|segment| segment.cell).collect();
            let twin: BTreeSet<_> = exhaustive(volume.grid(), &voxels, &curves, &view).into_iter().collect();
            let jaccard = tested.intersection(&twin).count() as f64 / tested.union(&twin).count() as f64;
            println!(
                "r = {radius}, perspective {}: {jaccard:.3}, {} and {}",
                view.perspective,
                tested.len(),
                twin.len()
            );
            assert!(jaccard >= 0.85, "r = {radius}, perspective {}: {jaccard}", view.perspective);
        }
    }
}

/// n·E < Th_eye as printed: at 0 the half that faces away, which no fixed number makes a line.
#[test]
fn the_literal_test_keeps_a_half() {
    let volume = ball(20.0);
    let view = orthographic(&volume, 8.0);
    let curves = Curves { test: CurvesTest::Literal, log: 2.0, ..Curves::default() };
    let voxels = voxels(&volume, &view, &curves);
    let edges = Edges::new(&volume, &voxels, &curves, Outside::Low).unwrap();
    let share = edges.segments(&curves, &view).len() as f64 / voxels.len() as f64;
    assert!((share - 0.5).abs() < 0.02, "{share}");
}

#[test]
fn segments_lie_across_the_view_and_a_voxel_long() {
    let volume = ball(12.0);
    let (view, curves) = (perspective(&volume), Curves::default());
    let voxels = voxels(&volume, &view, &curves);
    let edges = Edges::new(&volume, &voxels, &curves, Outside::Low).unwrap();
    let segments = edges.segments(&curves, &view);
    assert!(!segments.is_empty());
    for segment in &segments {
        let [a, b] = segment.ends;
        let middle = (a + b) / 2.0;
        assert!((a.distance(b) - 1.0).abs() < 1e-12);
        assert_eq!(middle, DVec3::from_array(segment.cell.map(f64::from)));
        let e = (view.eye - middle).normalize();
        let found = voxels.iter().find(|voxel| voxel.cell == segment.cell).unwrap();
        assert!((b - a).dot(e).abs() < 1e-12 && (b - a).dot(found.normal).abs() < 1e-12);
    }
    // Joined they are fewer lines than segments, and as long to a quarter: joints draw ends together.
    let page = Page::in_pixels(view.size, 0.0, 254.0);
    let lines = joined(&segments, volume.grid(), &view, &page, 0.5, 0.1);
    assert!(lines.len() * 2 < segments.len(), "{} of {}", lines.len(), segments.len());
    assert!(lines.iter().all(|line| line.vertices.len() >= 2 && line.vertices.iter().all(|v| v.at.is_finite())));
}
