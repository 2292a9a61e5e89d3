//! Hatching on the page ([HATCH-6] … [HATCH-13], [HATCH-19]), of a torus, whose lines of curvature are circles.

use super::page;
use drypoint::job::Wanted;
use drypoint::scene::glam::DVec3;
use drypoint::scene::marks::{Marks, Polyline};

/// A torus about z through the middle of 49³ voxels, of floating-point distances.
fn torus(hatching: &str) -> String {
    format!(
        "drypoint = 1\n[volume]\nphantom = {{ name = \"torus\", size = 49, type = \"f64\", param = {{ R = {RING}, r = {TUBE} }} }}\n\
         [camera]\nprojection = \"orthographic\"\ndirection = [0.2, 0.5, -0.8]\n\
         [picture]\nwidth = \"100 mm\"\nheight = \"80 mm\"\ndpi = 100\n[hatching]\niso = 0\n{hatching}"
    )
}

const RING: f64 = 14.0;
const TUBE: f64 = 6.0;

fn lines(marks: &Marks) -> Vec<&Polyline> {
    marks.layers.iter().flat_map(|layer| &layer.lines).collect()
}

/// The distance from the torus and the azimuth of each vertex of a line.
fn places(line: &Polyline, centre: DVec3) -> Vec<(f64, f64)> {
    let place = |world: DVec3| {
        let p = world - centre;
        let ring = p.x.hypot(p.y);
        ((ring - RING).hypot(p.z) - TUBE, p.y.atan2(p.x))
    };
    line.vertices.iter().map(|vertex| place(vertex.world)).collect()
}

/// κ₁ is 1/r everywhere on a torus, along its meridians: each line stays at one azimuth, 0.15 voxel in front of the surface, less
/// what a chord may leave it by, 0.1, where a line is cut between two vertices. The field between voxels is off by
/// (1/8)·(1/r) of a voxel.
#[test]
fn lines_of_the_larger_curvature_are_meridians() {
    let (marks, counts, job) = page(&torus("seeds = \"dense\"\n"), Wanted::Strokes);
    let lines = lines(&marks);
    assert!(lines.len() > 500, "{}", lines.len());
    let mut along = 0.0f64;
    for line in &lines {
        let places = places(line, job.volume.grid().centre());
        assert!(places.iter().all(|(front, _)| (0.02..0.2).contains(front)), "{places:?}");
        let first = places[0].1;
        let turned = |azimuth: f64| (azimuth - first).sin().abs() * RING;
        along = places.iter().fold(along, |most, place| most.max(turned(place.1)));
    }
    assert!(along < 1.0, "{along} voxels off a meridian");
    // What is done is counted: no pass over the volume for seeds that need none, a cause for each of two ends.
    assert_eq!((counts.preprocess["measures of seeds"], counts.preprocess.get("gradients")), (0, None));
    let strokes = counts.preprocess["seeds"] - counts.preprocess["seeds without a stroke"];
    let stops: u64 = counts.stops.values().sum();
    assert_eq!(stops, 2 * strokes - counts.stops["closed"]);
    assert!(counts.directions > strokes);
}

/// The other family are the circles about z.
#[test]
fn lines_of_the_smaller_curvature_go_round_the_axis() {
    let (marks, ..) = page(&torus("seeds = \"dense\"\nfamily = \"min\"\n"), Wanted::Strokes);
    let height = |line: &Polyline| {
        let heights = line.vertices.iter().map(|v| v.world.z);
        let (lo, hi) = heights.fold((f64::MAX, f64::MIN), |(lo, hi), z| (lo.min(z), hi.max(z)));
        hi - lo
    };
    let lines = lines(&marks);
    let mut heights: Vec<f64> = lines.iter().map(|line| height(line)).collect();
    heights.sort_by(f64::total_cmp);
    assert!(lines.len() > 500 && heights[lines.len() * 95 / 100] < 1.0, "{:?}", &heights[lines.len() - 5..]);
}

/// Widths are w_max·τ^a·taper(u) between `min_width` and w_max; of a pen that has its tone in the spacing they are its nib.
#[test]
fn widths_are_those_of_the_tone_or_of_the_pen() {
    let style =
        "seeds = \"dense\"\nwidth = \"0.5 mm\"\n[hatching.stroke]\nlight = [-1, 1, 1]\nmin_width = \"0.1 mm\"\n";
    let (marks, ..) = page(&torus(style), Wanted::Strokes);
    // Ends may be where a line is cut between two vertices, of which one has no width.
    let inner =
        |line: &Polyline| line.vertices[1..line.vertices.len() - 1].iter().map(|v| v.radius).collect::<Vec<_>>();
    let radii: Vec<f64> = lines(&marks).iter().flat_map(|line| inner(line)).collect();
    assert!(radii.iter().all(|&r| r == 0.0 || (0.05 - 1e-9..=0.25 + 1e-9).contains(&r)));
    assert!(radii.contains(&0.0) && radii.iter().any(|&r| r > 0.2));
    let even = "seeds = \"dense\"\nwidth = \"0.3 mm\"\nspacing = \"tone\"\n[hatching.stroke]\nlight = [-1, 1, 1]\n";
    let (marks, counts, _) = page(&torus(even), Wanted::Strokes);
    let lines = lines(&marks);
    assert!(lines.len() > 30 && lines.iter().flat_map(|l| &l.vertices).all(|v| v.radius == 0.15 && v.opacity == 1.0));
    assert!(lines.iter().all(|line| line.length() > 1.7), "six nibs at least");
    // Strokes are grown where there may be room, which is a small part of all cells.
    assert!(counts.preprocess["strokes tried"] < counts.preprocess["seeds"] / 2);
}

/// Cross-hatching adds lines where the light falls flatly, and none where there is no such place.
#[test]
fn strokes_are_crossed_where_the_light_falls_flatly() {
    let number = |more: &str| {
        let (marks, ..) = page(&torus(&format!("seeds = \"dense\"\n{more}")), Wanted::Strokes);
        lines(&marks).len()
    };
    let (plain, some, most) = (number(""), number("cross = 80\n"), number("cross = 30\n"));
    assert!(plain < some && some < most, "{plain} {some} {most}");
}

/// The same strokes, whatever the number of threads.
#[test]
fn threads_do_not_show() {
    let scene = torus("seeds = \"curvature\"\nmin_curvature = 0\ncross = 60\nspacing = \"tone\"\n");
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| page(&scene, Wanted::Strokes).0)
    };
    let (one, three) = (with(1), with(3));
    assert!(!lines(&one).is_empty());
    assert_eq!(lines(&one), lines(&three));
}
