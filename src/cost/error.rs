//! Errors of settings against the truth.

use super::strokes::distances;
use super::variant::SettingOutput;
use crate::Failure;
use crate::drawing::Frame;
use crate::job::Job;
use drypoint_output::OutputError;
use drypoint_output::compare::flip::{PIXELS_PER_DEGREE, flip};
use drypoint_output::compare::line_distance::LineDistance;
use drypoint_output::compare::{CompareOptions, compare};
use drypoint_output::read::Image;
use drypoint_scene::marks::Marks;

/// Error of a setting, as in a row.
pub(super) struct SettingError {
    pub(super) rms: f64,
    pub(super) max: f64,
    pub(super) flip: f64,
    pub(super) angle: Option<f64>,
}

/// Returns the error of a setting's output against a truth of the same kind.
pub(super) fn error(job: &Job, made: &SettingOutput, truth: &SettingOutput) -> Result<SettingError, Failure> {
    let wrong = |error: OutputError| Failure::picture(&error, job.scene.given.position("picture.size"));
    match (made, truth) {
        (SettingOutput::Picture(a), SettingOutput::Picture(b)) | (SettingOutput::Dots(a), SettingOutput::Dots(b)) => {
            let error = compare(a, b, &CompareOptions::default()).map_err(wrong)?;
            // Both pictures have colours.
            let flip = error.flip.unwrap_or(f64::NAN);
            Ok(SettingError { rms: error.rms, max: error.max, flip, angle: None })
        }
        (SettingOutput::Strokes(a), SettingOutput::Strokes(b)) => {
            let (LineDistance { rms, max }, angle) = distances(a, b, job.volume.grid().voxel()).ok_or_else(|| {
                let what = "a setting draws no stroke, so that there is nothing to compare";
                Failure::new(what, job.scene.given.position(""), "`drypoint strokes` shows what is drawn")
            })?;
            let map = flip(&painted(job, &a.marks)?, &painted(job, &b.marks)?, PIXELS_PER_DEGREE).map_err(wrong)?;
            Ok(SettingError { rms, max, flip: map.mean(), angle })
        }
        // A knob changes one thing.
        _ => Ok(SettingError { rms: f64::NAN, max: f64::NAN, flip: f64::NAN, angle: None }),
    }
}

/// Returns marks on their background, in pixels.
fn painted(job: &Job, marks: &Marks) -> Result<Image, Failure> {
    let frame = Frame::of_marks(marks.clone());
    Ok(Image::from(&frame.painted(job)?))
}
