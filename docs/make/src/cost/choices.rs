//! The table that opens `docs/cost.md`: settings for a preview, a talk and a print, with their errors and times.

use super::{Measured, RUNS, job};
use drypoint::cost::median;
use drypoint::output::compare::{CompareOptions, compare};
use drypoint::output::read::Image;
use std::time::Instant;

/// Settings for one use.
struct Choice {
    name: &'static str,
    words: &'static str,
    over: &'static [(&'static str, &'static str)],
}

/// Uses from fast to exact.
const CHOICES: [Choice; 4] = [
    Choice {
        name: "preview",
        words: "`step = \"1 voxel\"`, `stop_below = 0.05`",
        over: &[("sampling.step", "1 voxel"), ("sampling.stop_below", "0.05")],
    },
    Choice { name: "talk", words: "`stop_below = 0.01`", over: &[("sampling.stop_below", "0.01")] },
    Choice { name: "the scene", words: "as it is", over: &[] },
    Choice {
        name: "print",
        words: "`samples = \"auto\"`, `step = \"0.25 voxels\"`, `kernel = \"bspline\"`",
        over: &[("picture.samples", "auto"), ("sampling.step", "0.25 voxels"), ("sampling.kernel", "bspline")],
    },
];

/// Settings of the picture that errors are measured against.
const FINEST: [(&str, &str); 3] =
    [("picture.samples", "4"), ("sampling.step", "0.125 voxels"), ("sampling.kernel", "bspline")];

/// Returns the table for scenes of volumes.
///
/// # Errors
/// A scan that is not there, or errors of the renderer.
pub(super) fn table(scenes: &[&Measured]) -> Result<String, String> {
    let mut columns = Vec::new();
    for scene in scenes {
        let (truth, _) = job(scene, &FINEST)?.renderer().map_err(|e| e.to_string())?.frame(&|_| ());
        let truth = Image::from(&truth);
        let cells: Result<Vec<String>, String> = CHOICES
            .iter()
            .map(|choice| {
                let (picture, seconds) = drawn(scene, choice.over)?;
                let error = compare(&picture, &truth, &CompareOptions::default()).map_err(|e| e.to_string())?;
                Ok(format!("{:.1e} in {:.0} ms", error.rms, seconds * 1e3))
            })
            .collect();
        columns.push(cells?);
    }
    let names: Vec<&str> = scenes.iter().map(|scene| scene.name).collect();
    let mut text = format!("| for | settings | {} |\n|---|---|{}\n", names.join(" | "), "--:|".repeat(names.len()));
    for (i, choice) in CHOICES.iter().enumerate() {
        let cells: Vec<&str> = columns.iter().map(|column| column[i].as_str()).collect();
        text += &format!("| **{}** | {} | {} |\n", choice.name, choice.words, cells.join(" | "));
    }
    Ok(text)
}

/// Returns the picture of a scene with other settings, and the median seconds of a frame.
fn drawn(scene: &Measured, settings: &[(&str, &str)]) -> Result<(Image, f64), String> {
    let job = job(scene, settings)?;
    let renderer = job.renderer().map_err(|e| e.to_string())?;
    let mut seconds = Vec::new();
    // The first frame warms up.
    let (mut picture, _) = renderer.again(&|_| ());
    for _ in 0..RUNS {
        let start = Instant::now();
        picture = renderer.again(&|_| ()).0;
        seconds.push(start.elapsed().as_secs_f64());
    }
    Ok((Image::from(&picture), median(&seconds)))
}
