//! Tone of a page of dots, on which errors of their knobs are measured ([COST-1]).

use crate::Failure;
use crate::job::{Job, background_color};
use drypoint_output::OutputError;
use drypoint_output::compare::blur::blurred;
use drypoint_output::paint::{PageWindow, blank, paint};
use drypoint_output::read::Image;
use drypoint_scene::marks::{INCH, Marks, Page};
use drypoint_scene::tables::Scene;

/// σ of the blur, in diameters of the largest dot. At a tone of ½ this is three distances between dots.
const BLUR: f64 = 4.0;

/// Returns the page of dots, painted and blurred. Pixels are the scene's, or as large as the largest dot. A dot covers
/// the exact share of a pixel, so finer pixels change nothing after the blur.
pub(super) fn tone(job: &Job, scene: &Scene, marks: &Marks) -> Result<Image, Failure> {
    let wrong = |error: OutputError| Failure::picture(&error, job.scene.given.position("picture.size"));
    let size = scene.stipples.as_ref().and_then(|stipples| marks.page.length(stipples.size)).unwrap_or_default();
    let page = Page { dpi: marks.page.dpi.min(INCH / size), ..marks.page };
    let mut picture = blank(&page, background_color(scene)).map_err(wrong)?;
    paint(marks, &PageWindow::page(&page), scene.picture.blend_space, &mut picture).map_err(wrong)?;
    Ok(blurred(&Image::from(&picture), BLUR * size * page.pixels_per_mm()))
}
