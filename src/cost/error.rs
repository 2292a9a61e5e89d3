//! How far what a setting makes is from the truth.

use super::variant::Made;
use crate::Failure;
use crate::drawing::Frame;
use crate::job::Job;
use drypoint_output::OutputError;
use drypoint_output::compare::blur::blurred;
use drypoint_output::compare::flip::{PIXELS_PER_DEGREE, flip};
use drypoint_output::compare::lines::{Apart, apart};
use drypoint_output::compare::{Options, compare};
use drypoint_output::read::Image;
use drypoint_scene::marks::{Marks, Page, Polyline};
use drypoint_scene::tables::Scene;

/// σ of the Gaussian that dots are seen through, in diameters of the largest: at a tone of ½ three distances between dots.
const BLUR: f64 = 4.0;

/// The longest piece of a stroke, in voxels.
const PIECE: f64 = 0.1;

/// As a row has it.
pub(super) struct Error {
    pub(super) rms: f64,
    pub(super) max: f64,
    pub(super) flip: f64,
}

/// The error of what a knob of a scene made, against the truth of the same kind.
pub(super) fn error(job: &Job, scene: &Scene, made: &Made, truth: &Made) -> Result<Error, Failure> {
    let wrong = |error: OutputError| Failure::picture(&error, job.scene.given.position("picture.size"));
    let of_light = |a: &Image, b: &Image| {
        let error = compare(a, b, &Options::default()).map_err(wrong)?;
        // Both pictures have colours.
        Ok(Error { rms: error.rms, max: error.max, flip: error.flip.unwrap_or(f64::NAN) })
    };
    match (made, truth) {
        (Made::Picture(a), Made::Picture(b)) => of_light(a, b),
        (Made::Dots(a), Made::Dots(b)) => {
            let page = Page::of(scene);
            let size = scene.stipples.as_ref().and_then(|stipples| page.length(stipples.size)).unwrap_or_default();
            let sigma = BLUR * size * page.pixels_per_mm();
            of_light(&blurred(&painted(job, a)?, sigma), &blurred(&painted(job, b)?, sigma))
        }
        (Made::Strokes(a), Made::Strokes(b)) => {
            let voxel = job.volume.grid().voxel();
            let Apart { rms, max } = apart(lines(a), lines(b), PIECE * voxel).ok_or_else(|| {
                let what = "a setting draws no stroke, so that there is nothing to compare";
                Failure::new(what, job.scene.given.position(""), "`drypoint strokes` shows what is drawn")
            })?;
            let map = flip(&painted(job, a)?, &painted(job, b)?, PIXELS_PER_DEGREE).map_err(wrong)?;
            Ok(Error { rms: rms / voxel, max: max / voxel, flip: map.mean() })
        }
        // A knob changes one thing.
        _ => Ok(Error { rms: f64::NAN, max: f64::NAN, flip: f64::NAN }),
    }
}

fn lines(marks: &Marks) -> impl Iterator<Item = &Polyline> {
    marks.layers.iter().flat_map(|layer| &layer.lines)
}

/// Marks on their background, in pixels.
fn painted(job: &Job, marks: &Marks) -> Result<Image, Failure> {
    let frame = Frame { number: 0, picture: None, marks: Some(marks.clone()), inside: 0 };
    Ok(Image::from(&frame.painted(job)?))
}
