//! Whole figures, with tens of thousands of dots as small as a pixel, as librsvg and poppler draw them.

use crate::outside::{Codes, run};
use drypoint::drawing::Drawing;
use drypoint::job::{Job, RenderTarget};
use drypoint::marking::Marking;
use drypoint::scene::counts::Counts;
use drypoint::scene::file::{Overrides, data_folders, load};
use drypoint::scene::source::Disk;
use std::path::Path;
use std::sync::Arc;

/// Pixels of theirs on one of ours, along each side. Of dots of a pixel both lose ink or find some that is not there: with
/// so many pixels little is left of that.
const FINER: usize = 4;

/// Pixels of a scene to an inch, where it does not say.
const DPI: usize = 300;

/// Draws a figure into files.
fn draw(figure: &str, paths: [&Path; 3]) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/scenes/volume_stippling");
    let mut overrides = Overrides::default();
    overrides.push_argument("picture.blend_space=srgb").unwrap();
    let scene = load(&folder.join(figure).with_extension("toml"), &overrides).unwrap();
    let job = Job::load_for(scene, RenderTarget::Marks, Arc::new(Disk)).unwrap();
    let mut counts = Counts::default();
    let marking = Marking::new(&job, &mut counts, &|_| ()).unwrap();
    let mut drawing = Drawing::new(&job, &marking, &mut counts).unwrap();
    for path in paths {
        drawing.frame(0, &|_| ()).unwrap().0.write(&job, path).unwrap();
    }
}

/// Pixel by pixel where both count coverage a dot at a time, and in ink where theirs is fine enough to have it all.
///
/// Of poppler's two programs this asks `pdftocairo`: `pdftoppm` bends the edges of dots by a gamma, and a dot of a pixel is
/// all edge.
fn is_what_others_draw(figure: &str) {
    if data_folders().iter().all(|folder| !folder.join("engine.nhdr").is_file()) {
        println!("skipped: no data");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    draw(figure, [&path("ours.png"), &path("a.svg"), &path("a.pdf")]);
    let (once, finely) = (DPI.to_string(), (DPI * FINER).to_string());
    let svg = |dpi: &str, name: &str| {
        let arguments = ["-d", dpi, "-p", dpi, "-b", "white", "-o", name, "a.svg"];
        run("rsvg-convert", Some("librsvg2-bin"), &arguments, folder.path())
    };
    let pdf = ["-r", &finely, "-singlefile", "-png", "a.pdf", "pdf"];
    if svg(&once, "once.png").and_then(|_| svg(&finely, "svg.png")).is_none()
        || run("pdftocairo", Some("poppler-utils"), &pdf, folder.path()).is_none()
    {
        return;
    }
    let ours = Codes::of_png(&path("ours.png"));
    ours.is_nearly_everywhere(&Codes::of_png(&path("once.png")));
    let [svg, pdf] = ["svg.png", "pdf.png"].map(|name| Codes::of_png(&path(name)).reduced(FINER));
    ours.has_the_ink_of(&svg);
    ours.has_the_ink_of(&pdf);
    svg.agrees_with(&pdf);
}

#[test]
fn silhouettes_and_curves_of_the_engine() {
    is_what_others_draw("figure_1_b");
}

#[test]
fn fading_dots_of_the_engine() {
    is_what_others_draw("figure_5");
}

#[test]
fn a_head_with_all_factors() {
    is_what_others_draw("figure_9");
}
