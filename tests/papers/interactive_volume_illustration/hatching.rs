//! Hatching on the page ([HATCH-6] … [HATCH-13], [HATCH-19]), of a torus, whose lines of curvature are circles.

use super::page;
use drypoint::job::RenderTarget;
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
    let (marks, counts, job) = page(&torus("seeds = \"dense\"\n"), RenderTarget::Strokes);
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

/// Stored directions are made where strokes come, or everywhere, which draws the same page; without them there are none.
#[test]
fn directions_are_stored_where_the_scene_says_so() {
    let drawn = |directions: &str| {
        let (marks, counts, _) =
            page(&torus(&format!("seeds = \"dense\"\n[hatching.directions]\n{directions}")), RenderTarget::Strokes);
        (marks, counts.preprocess["stored directions"], counts.bytes["stored directions"], counts.directions)
    };
    let (direct, none, no_bytes, asked) = drawn("");
    let (stored, visited, bytes, between) = drawn("from = \"stored\"\n");
    let (whole, all, more_bytes, as_often) = drawn("from = \"stored\"\ngrid = \"all\"\n");
    assert_eq!((none, no_bytes), (0, 0));
    assert!(visited > 1000 && 2 * visited < all && all < 49 * 49 * 49, "{visited} {all}");
    assert!(bytes > 64 * visited && bytes < more_bytes);
    assert!(asked > between / 2 && between == as_often);
    assert!(stored == whole && stored != direct);
    let counted = lines(&stored).len() as f64 / lines(&direct).len() as f64;
    assert!((counted - 1.0).abs() < 0.05, "{counted}");
}

/// The other family are the circles about z.
#[test]
fn lines_of_the_smaller_curvature_go_round_the_axis() {
    let (marks, ..) = page(&torus("seeds = \"dense\"\nfamily = \"min\"\n"), RenderTarget::Strokes);
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
    let (marks, ..) = page(&torus(style), RenderTarget::Strokes);
    // A line that gets too thin ends where it is as wide as the least: on steps of 0.005 mm, none is thinner.
    let radii: Vec<f64> = lines(&marks).iter().flat_map(|line| line.vertices.iter().map(|v| v.radius)).collect();
    assert!(radii.iter().all(|&r| (0.05 - 1e-9..=0.25 + 1e-9).contains(&r)));
    let ends = lines(&marks)
        .iter()
        .flat_map(|line| [0, line.vertices.len() - 1].map(|i| line.vertices[i].radius))
        .collect::<Vec<_>>();
    assert!(ends.iter().filter(|&&r| r == 0.05).count() > ends.len() / 2 && radii.iter().any(|&r| r > 0.2));
    let even = "seeds = \"dense\"\nwidth = \"0.3 mm\"\nspacing = \"tone\"\n[hatching.stroke]\nlight = [-1, 1, 1]\n";
    let (marks, counts, _) = page(&torus(even), RenderTarget::Strokes);
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
        let (marks, ..) = page(&torus(&format!("seeds = \"dense\"\n{more}")), RenderTarget::Strokes);
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
        pool.install(|| page(&scene, RenderTarget::Strokes).0)
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
        RenderTarget::Strokes,
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

const LIT: &str = "seeds = \"dense\"\n[hatching.stroke]\nlight = [-1, 1.5, 0.8]\ntone = 0\n[hatching.lighting]\n";

/// Banks' light, worked anew from the torus itself: T runs along the meridian, and L, V and N are known. What is drawn has the
/// tangent of chords, at the ends of lines that of half a chord, 5° off where one of 0.1 voxel's error spans 2√(2·6·0.1) = 2.2
/// voxels; where that counts most, in the slope of a power of 20, it moves a channel by 0.3·20·0.087·0.6 = 0.3 of linear light, of
/// which the mean is a small part.
#[test]
fn strokes_are_lit_as_lines() {
    let (marks, counts, job) = page(&torus(LIT), RenderTarget::Strokes);
    let view = job.view().unwrap();
    let eye = -view.forward;
    let light = view.direction_to_world(DVec3::new(-1.0, 1.5, 0.8).normalize());
    let decoded = |bytes: [f64; 3]| bytes.map(|byte| drypoint::scene::color::srgb_to_linear(byte / 255.0));
    let (front, back) = (decoded([32.0, 64.0, 160.0]), decoded([192.0, 160.0, 32.0]));
    let mut off = Vec::new();
    for vertex in lines(&marks).iter().flat_map(|line| &line.vertices) {
        let p = vertex.world - job.volume.grid().centre();
        let out = DVec3::new(p.x, p.y, 0.0).normalize();
        let n = (p - out * RING).normalize();
        let t = n.cross(DVec3::Z.cross(out)).normalize();
        let (l_t, v_t): (f64, f64) = (light.dot(t), eye.dot(t));
        let across = |x: f64| (1.0 - x * x).max(0.0).sqrt();
        let diffuse = 0.7 * across(l_t).powf(4.8);
        let specular = 0.3 * (across(l_t) * across(v_t) - l_t * v_t).max(0.0).powi(20);
        let faces = 0.5 + 0.5 * n.dot(eye);
        let found = vertex.color.unwrap();
        for i in 0..3 {
            let wanted = (back[i] + (front[i] - back[i]) * faces) * diffuse + specular;
            off.push((found[i] - wanted).abs());
        }
    }
    let mean = off.iter().sum::<f64>() / off.len() as f64;
    off.sort_by(f64::total_cmp);
    let (median, most) = (off[off.len() / 2], off[off.len() - 1]);
    assert!(off.len() > 10_000 && median < 0.01 && mean < 0.02 && most < 0.3, "{} {median} {mean} {most}", off.len());
    // All that is drawn is thick enough, and what is hidden was cut.
    assert!(counts.preprocess["looks for what hides"] > 1000 && counts.bytes["surface"] > 0);
}

/// A pen has one colour, and so has a plotter's; strokes that keep their distance, too. Neither is the light asked for then.
#[test]
fn what_has_one_colour_is_not_lit() {
    let pen = "[[pen]]\nname = \"ink\"\nwidth = \"0.3 mm\"\n";
    for (scene, why) in [
        (torus(LIT) + "[page]\nplotter = true\n", "a plotter's pen has one colour"),
        (torus(&format!("pen = \"ink\"\n{LIT}")) + pen, "hatching.pen says the colour"),
        (torus(&format!("spacing = \"2 mm\"\n{LIT}")), "strokes that keep their distance have one colour"),
    ] {
        let (marks, _, job) = page(&scene, RenderTarget::Strokes);
        assert!(lines(&marks).iter().flat_map(|line| &line.vertices).all(|vertex| vertex.color.is_none()));
        let idle = job.plan.idle_keys.iter().find(|idle| idle.key == "hatching.lighting").unwrap();
        assert_eq!(idle.why, why);
        assert!(!job.plan.has_pass(drypoint::scene::plan::Pass::LitStrokes));
    }
}

/// With `hidden = "drawn"` no surface is looked at, strokes are seen from both sides, and the nearer come later.
#[test]
fn strokes_alone_are_seen_from_both_sides() {
    let (cut, ..) = page(&torus(LIT), RenderTarget::Strokes);
    let (all, counts, job) = page(&torus(&format!("hidden = \"drawn\"\n{LIT}")), RenderTarget::Strokes);
    let length = |marks: &Marks| lines(marks).iter().map(|line| line.length()).sum::<f64>();
    // A line 0.15 voxel in front of a tube of radius 6 is seen 12.7° past its rim, 0.57 of a meridian at the most.
    assert!(length(&all) > length(&cut) / 0.57, "{} {}", length(&all), length(&cut));
    assert_eq!((counts.preprocess["looks for what hides"], counts.bytes["surface"]), (0, 0));
    let view = job.view().unwrap();
    let depths: Vec<f64> =
        lines(&all).iter().map(|line| view.to_eye(line.vertices[line.vertices.len() / 2].world).z).collect();
    // A line that the frame cuts, or that rounding shortens, may have another middle: none here.
    assert!(depths.windows(2).all(|pair| pair[0] <= pair[1]));
}

/// Where one end of the ring lies over the other: gaps only cut what is farther, and only where a scene asks for them.
#[test]
fn gaps_where_a_nearer_line_crosses() {
    let scene = |more: &str| {
        torus(&format!(
            "hidden = \"drawn\"\nseeds = \"dense\"\nwidth = \"0.2 mm\"\n{more}[hatching.stroke]\ntone = 0\n[outlines]\niso = 0\n"
        ))
    };
    let (plain, counts, _) = page(&scene(""), RenderTarget::Strokes);
    assert!(!counts.preprocess.contains_key("segments with gaps"));
    let (gapped, counts, _) = page(&scene("gap = \"0.6 mm\"\ngap_depth = \"4 voxels\"\n"), RenderTarget::Strokes);
    assert!(counts.preprocess["segments with gaps"] > 100);
    let length = |marks: &Marks, layer: usize| marks.layers[layer].lines.iter().map(|line| line.length()).sum::<f64>();
    // Most of what lies behind the tube goes, and none of what is in front; outlines stay as they are.
    let left = length(&gapped, 0) / length(&plain, 0);
    assert!((0.3..0.75).contains(&left), "{left}");
    assert_eq!(plain.layers[1].lines, gapped.layers[1].lines);
    // Nothing is 100 voxels nearer.
    let (none, ..) = page(&scene("gap = \"0.6 mm\"\ngap_depth = \"100 voxels\"\n"), RenderTarget::Strokes);
    assert_eq!(none.layers[0].lines, plain.layers[0].lines);
}

/// Pencil is as faint as the light falls, engraving has blunt ends, dashes have their lengths, and a stroke at random is wider
/// and longer than another.
#[test]
fn styles_of_strokes() {
    let with = |key: &str, stroke: &str| {
        let scene =
            format!("{key}width = \"0.5 mm\"\nmax_angle = 179\n[hatching.stroke]\nlight = [-1, 1, 1]\n{stroke}");
        page(&torus(&format!("seeds = \"dense\"\n{scene}")), RenderTarget::Strokes).0
    };
    let vertices = |marks: &Marks| lines(marks).iter().flat_map(|line| line.vertices.clone()).collect::<Vec<_>>();
    let pencil = vertices(&with("style = \"pencil\"\n", ""));
    let opacities: Vec<f64> = pencil.iter().map(|v| v.opacity).collect();
    assert!(opacities.iter().any(|&o| o < 0.2) && opacities.iter().any(|&o| o > 0.8));
    // The taper alone changes its width; the tone has none of it.
    assert!(pencil.iter().filter(|v| v.radius == 0.25).count() > pencil.len() / 2);
    let engraving = with("style = \"engraving\"\n", "min_width = \"0.01 mm\"\ntone = 0\n");
    assert!(vertices(&engraving).iter().all(|v| v.radius == 0.25 && v.opacity == 1.0));
    let dashes = with("", "tone = 0\ntaper = 0\ndash = [\"1 mm\", \"0.5 mm\"]\n");
    assert!(lines(&dashes).iter().all(|line| line.length() < 1.01) && lines(&dashes).len() > lines(&engraving).len());
    let jitter = vertices(&with("", "tone = 0\ntaper = 0\njitter = 0.5\n"));
    let (lo, hi) = jitter.iter().fold((1.0f64, 0.0f64), |(lo, hi), v| (lo.min(v.radius), hi.max(v.radius)));
    assert!((0.125..0.15).contains(&lo) && hi > 0.35 && hi <= 0.375, "{lo} {hi}");
    let depth = vertices(&with("", "tone = 0\ntaper = 0\ndepth = 0.8\n"));
    let (lo, hi) = depth.iter().fold((1.0f64, 0.0f64), |(lo, hi), v| (lo.min(v.radius), hi.max(v.radius)));
    assert!(lo >= 0.05 && lo < hi && hi < 0.25, "{lo} {hi}");
}
