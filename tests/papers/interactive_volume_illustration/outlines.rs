//! Outlines on the page ([HATCH-18], [HATCH-14]): where they are, what hides them, and what they do not change.

use super::page;
use drypoint::drawing::Drawing;
use drypoint::job::{Job, RenderTarget};
use drypoint::marking::Marking;
use drypoint::reference::field::{Field, Reconstruction, Rung};
use drypoint::reference::interactive_volume_illustration::outlines;
use drypoint::reference::surface::IsoSurface;
use drypoint::scene::counts::Counts;
use drypoint::scene::file::parse;
use drypoint::scene::glam::{DVec2, DVec3};
use drypoint::scene::marks::{Marks, Page, Polyline};
use drypoint::scene::source::Disk;
use std::path::Path;
use std::sync::Arc;

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

fn lines(marks: &Marks) -> Vec<&Polyline> {
    marks.layers.iter().flat_map(|layer| &layer.lines).collect()
}

/// A ball is one closed circle of its own radius on the page; a pixel is a known length of the world.
#[test]
fn a_ball_is_a_circle() {
    let (marks, counts, job) = page(BALL, RenderTarget::Strokes);
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

/// How deep inside a torus about the z axis, of ring R and tube r, a place is.
fn inside_torus(p: DVec3, [ring, tube]: [f64; 2]) -> f64 {
    tube - (p.x.hypot(p.y) - ring).hypot(p.z)
}

/// A torus hides parts of its own outlines: what is drawn has a free way to the eye, in closed form, and what is not drawn
/// is a part of the whole.
#[test]
fn what_lies_behind_is_not_drawn() {
    let size = [0.3 * 47.0, 0.12 * 47.0];
    let torus =
        |direction: &str| BALL.replace("name = \"sphere\"", "name = \"torus\"").replace("[0.3, 0.7, -0.4]", direction);
    // From above both circles are seen whole.
    let (above, ..) = page(&torus("[0.02, 0.01, -1]"), RenderTarget::Strokes);
    assert_eq!(lines(&above).iter().map(|line| line.closed).collect::<Vec<_>>(), [true, true]);
    for direction in ["[1, 0.1, -0.6]", "[1, 0.1, -0.3]", "[1, 0.1, -0.1]"] {
        let (marks, _, job) = page(&torus(direction), RenderTarget::Strokes);
        let (centre, v) = (job.volume.grid().centre(), -job.view().unwrap().forward);
        let seen = lines(&marks);
        for vertex in seen.iter().flat_map(|line| &line.vertices) {
            let p = vertex.world - centre;
            let on_ring = DVec3::new(p.x, p.y, 0.0).normalize() * size[0];
            let from = p + (p - on_ring).normalize() * 0.3;
            let deepest = (1..400).map(|k| inside_torus(from + v * (0.1 * f64::from(k)), size));
            // Trilinear values of a distance are off by an eighth of the curvatures' sum, 0.05 at the most; a change of
            // what is seen is known to a tenth of a pixel of 0.2.
            assert!(deepest.fold(f64::NEG_INFINITY, f64::max) < 0.1, "{direction}: {p}");
        }
        let field = Field::new(&job.volume, Reconstruction::default(), Rung::Gradient).unwrap();
        let all = outlines(&IsoSurface::new(&field, 0.0), &job.view().unwrap()).strokes;
        let whole = all.iter().flat_map(|stroke| stroke.vertices.windows(2));
        let whole: f64 = whole.map(|pair| pair[0].world.distance(pair[1].world)).sum();
        let drawn = seen.iter().flat_map(|line| line.vertices.windows(2));
        let drawn: f64 = drawn.map(|pair| pair[0].world.distance(pair[1].world)).sum();
        assert!(drawn > 0.4 * whole && drawn < 0.95 * whole, "{direction}: {drawn} of {whole}");
    }
}

/// Outlines are drawn over what rays show and change nothing of it; without them nothing of theirs is done.
#[test]
fn over_a_surface_and_without() {
    let scene = format!("{BALL}[surface]\niso = 0\n").replace("size = [400, 400]", "size = [80, 80]");
    let (_, counts, job) = page(&scene, RenderTarget::Picture);
    assert_eq!(counts.strokes, 1);
    let bare = parse(&scene, Path::new("s"), &[("outlines", "off")].into_iter().collect()).unwrap();
    let bare = Job::load_for(bare, RenderTarget::Picture, Arc::new(Disk)).unwrap();
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
