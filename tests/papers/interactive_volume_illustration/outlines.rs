//! Outlines on the page ([HATCH-18], [HATCH-14]): where they are, what hides them, and what they do not change.

use drypoint::drawing::Drawing;
use drypoint::job::{Job, Wanted};
use drypoint::marking::Marking;
use drypoint::scene::counts::Counts;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::glam::DVec2;
use drypoint::scene::marks::{Marks, Page, Polyline};
use std::path::Path;

const BALL: &str = r#"
drypoint = 1
[volume]
phantom = { name = "sphere", size = 48, type = "f32" }
[camera]
projection = "orthographic"
direction = [0.3, 0.7, -0.4]
[picture]
size = [400, 400]
dpi = 100
[outlines]
iso = 0
"#;

fn page(scene: &str, wanted: Wanted) -> (Marks, Counts, Job) {
    let scene = parse(scene, Path::new("scene.toml"), &Overrides::default()).unwrap();
    let job = Job::load_for(scene, wanted).unwrap();
    let mut counts = Counts::default();
    let marking = Marking::new(&job, &mut counts, &|_| ()).unwrap();
    let marks = marking.frames(&mut counts).unwrap().draw(&job.view().unwrap(), &mut counts);
    drop(marking);
    (marks, counts, job)
}

fn lines(marks: &Marks) -> Vec<&Polyline> {
    marks.layers.iter().flat_map(|layer| &layer.lines).collect()
}

/// A ball is one closed circle of its own radius on the page; a pixel is a known length of the world.
#[test]
fn a_ball_is_a_circle() {
    let (marks, counts, job) = page(BALL, Wanted::Strokes);
    let lines = lines(&marks);
    assert!(lines.len() == 1 && lines[0].closed && counts.strokes == 1);
    let view = job.view().unwrap();
    let mm = 1.0 / (view.pixel * Page::of(&job.scene).pixels_per_mm());
    let radius = 0.3 * 47.0 * mm;
    for vertex in &lines[0].vertices {
        let from = vertex.at.distance(DVec2::splat(marks.page.size.x / 2.0));
        // Trilinear values of a distance are off by 1/(4R) voxel at most, places by half a step of 0.001 mm along each axis.
        assert!((from - radius).abs() < mm / (4.0 * 14.1) + 0.001, "{from} {radius}");
    }
}

/// A torus hides its own far side.
#[test]
fn what_lies_behind_is_not_drawn() {
    let torus =
        |direction: &str| BALL.replace("name = \"sphere\"", "name = \"torus\"").replace("[0.3, 0.7, -0.4]", direction);
    // From above a torus has two circles; from the side the part behind is hidden, and one closed line is left.
    let (above, ..) = page(&torus("[0, 0, -1]"), Wanted::Strokes);
    assert_eq!(lines(&above).iter().map(|line| line.closed).collect::<Vec<_>>(), [true, true]);
    let (side, ..) = page(&torus("[1, 0, 0]"), Wanted::Strokes);
    let around = lines(&side).into_iter().max_by(|a, b| a.length().total_cmp(&b.length())).unwrap();
    let [lo, hi] = [f64::min as fn(f64, f64) -> f64, f64::max]
        .map(|most| around.vertices.iter().map(|v| v.at.x).reduce(most).unwrap());
    let inside = lines(&side).into_iter().filter(|line| **line != *around);
    assert!(inside.flat_map(|line| &line.vertices).all(|v| v.at.x >= lo && v.at.x <= hi));
    // Oblique: the ring's hole is seen through, and its far wall ends behind the near one.
    let (oblique, ..) = page(&torus("[1, 0, -0.5]"), Wanted::Strokes);
    assert!(lines(&oblique).iter().any(|line| !line.closed), "nothing is hidden");
    assert!(lines(&oblique).iter().any(|line| line.closed));
}

/// Outlines are drawn over what rays show and change nothing of it; without them nothing of theirs is done.
#[test]
fn over_a_surface_and_without() {
    let scene = format!("{BALL}[surface]\niso = 0\n").replace("size = [400, 400]", "size = [80, 80]");
    let (_, counts, job) = page(&scene, Wanted::Picture);
    assert_eq!(counts.strokes, 1);
    let bare = parse(&scene, Path::new("s"), &[("outlines", "off")].into_iter().collect()).unwrap();
    let bare = Job::load_for(bare, Wanted::Picture).unwrap();
    let drawn = |job: &Job| {
        let mut counts = Counts::default();
        let marking = Marking::new(job, &mut counts, &|_| ()).unwrap();
        let mut drawing = Drawing::new(job, &marking, &mut counts).unwrap();
        let (frame, own) = drawing.frame(0, &|_| ()).unwrap();
        counts.add(&own);
        (frame.picture.unwrap(), counts)
    };
    let ((with, _), (without, counts)) = (drawn(&job), drawn(&bare));
    assert_eq!(with, without);
    assert!(counts.strokes == 0 && counts.preprocess.keys().all(|key| !key.contains("outline")));
}
