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

/// Ink by the page's x of a cylinder along z that is seen from the side, beside τ by its normal: pairs for tones from 0.1 to
/// 0.8 ([HATCH-19]).
fn inks_of_a_cylinder(family: &str, millimetres: f64) -> Vec<[f64; 2]> {
    const RADIUS: f64 = 24.0;
    const NIB: f64 = 0.25;
    let side = 64.0 * millimetres;
    let (marks, ..) = page(
        &format!(
            "drypoint = 1\n[volume]\nphantom = {{ name = \"cylinder\", size = 64, type = \"f32\", param = {{ R = {RADIUS} }} }}\n\
             [camera]\nprojection = \"orthographic\"\ndirection = [-1, 0, 0]\nheight = 64\n\
             [picture]\nwidth = \"{side} mm\"\nheight = \"{side} mm\"\n[hatching]\niso = 0\nseeds = \"dense\"\n\
             family = \"{family}\"\nspacing = \"tone\"\nwidth = \"{NIB} mm\"\n[hatching.stroke]\nlight = [1, 0, 0.3]\nambient = 0.1\n"
        ),
        Wanted::Strokes,
    );
    let pieces: Vec<_> =
        lines(&marks).iter().flat_map(|line| line.vertices.windows(2)).map(|p| [p[0].at, p[1].at]).collect();
    // Lines are shorter than wanted near the ends of the cylinder, which the page's upper and lower tenth leave out.
    let (low, high) = (0.1 * side, 0.9 * side);
    let tau = |x: f64| 1.0 - (0.1 + (x + 0.3 * (1.0 - x * x).sqrt()) / 1.0f64.hypot(0.3)).clamp(0.0, 1.0);
    let bins = (0..16).map(|bin| [-0.96 + 0.12 * f64::from(bin), -0.96 + 0.12 * f64::from(bin + 1)]);
    let inks = bins.map(|[from, to]| {
        let ink: f64 = pieces
            .iter()
            .map(|[a, b]| {
                let steps = (a.distance(*b) / 0.05).ceil().max(1.0);
                let step = a.distance(*b) / steps;
                let places = (0..steps as usize).map(|k| a.lerp(*b, (k as f64 + 0.5) / steps));
                let x = |at: f64| (at - 0.5 * side) / (RADIUS * millimetres);
                NIB * step
                    * places.filter(|p| (low..high).contains(&p.y) && (from..to).contains(&x(p.x))).count() as f64
            })
            .sum();
        let wanted = (0..100).map(|k| tau(from + (to - from) * (f64::from(k) + 0.5) / 100.0)).sum::<f64>() / 100.0;
        [wanted, ink / ((to - from) * RADIUS * millimetres * (high - low))]
    });
    inks.filter(|[wanted, _]| (0.1..0.8).contains(wanted)).collect()
}

/// Tone is what it should be whether a voxel is as wide as the distance of lines or ten times that, with lines along the
/// change of tone and across it. Of the latter few lie in a bin, so three bins are one.
#[test]
fn spacing_prints_the_tone_at_any_size_of_the_page() {
    for (family, millimetres) in [("max", 0.5), ("max", 2.0), ("min", 2.0)] {
        let inks = inks_of_a_cylinder(family, millimetres);
        let mean = |inks: &[[f64; 2]]| [0, 1].map(|i| inks.iter().map(|ink| ink[i]).sum::<f64>() / inks.len() as f64);
        let inks: Vec<[f64; 2]> = inks.windows(3).map(mean).collect();
        let off = inks.iter().map(|[wanted, ink]| (ink - wanted).abs()).fold(0.0, f64::max);
        assert!(inks.len() >= 5 && off <= 0.05, "{family} {millimetres} mm: {inks:.3?}");
    }
}
