//! The verb `compare`: two pictures.

use super::report::{print, print_json};
use super::{Done, Outcome, Talk, output_path, report};
use crate::output::compare::difference::difference_picture;
use crate::output::compare::{self, CompareOptions, ErrorLimits, flip};
use crate::output::read::read_image;
use crate::output::{OutputError, png};
use crate::scene::picture::Provenance;
use crate::{Failure, Failures, Format};
use clap::Args;
use std::path::PathBuf;

/// Compare two pictures: largest and RMS difference of every layer, and FLIP of the colours.
#[derive(Debug, Args)]
pub(super) struct CompareArgs {
    /// Picture, PNG or EXR
    a: PathBuf,
    /// Picture of the same size
    b: PathBuf,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Write a picture of the difference (FLIP), as PNG
    #[arg(long, value_name = "FILE")]
    diff: Option<PathBuf>,
    /// Exit with 1 if the largest difference exceeds this
    #[arg(long, value_name = "X", value_parser = limit)]
    max: Option<f64>,
    /// Exit with 1 if the RMS difference exceeds this
    #[arg(long, value_name = "X", value_parser = limit)]
    rms: Option<f64>,
    /// Exit with 1 if the mean FLIP exceeds this
    #[arg(long, value_name = "X", value_parser = limit)]
    flip: Option<f64>,
}

/// Parses a bound. NaN is refused, because every comparison with it would pass.
fn limit(text: &str) -> Result<f64, &'static str> {
    let number = text.parse::<f64>().ok().filter(|x| x.is_finite() && *x >= 0.0);
    number.ok_or("a bound is a number of at least 0")
}

impl CompareArgs {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        if let Some(path) = &self.diff {
            output_path::picture(path, &[Format::Png])?;
            output_path::check_not_read(path, [&*self.a, &*self.b])?;
        }
        let say = |error: OutputError| {
            Failure::picture(&error, format_args!("{} and {}", self.a.display(), self.b.display()))
        };
        let (a, b) = match (read_image(&self.a).map_err(say), read_image(&self.b).map_err(say)) {
            (Ok(a), Ok(b)) => (a, b),
            (Err(first), second) => return Err(Failures::new(first, second.err())),
            (Ok(_), Err(second)) => return Err(second.into()),
        };
        // The comparison goes to standard output, the picture of the difference to its file.
        let comparison = compare::compare(&a, &b, &CompareOptions::default()).map_err(say)?;
        if let Some(path) = &self.diff {
            let map = flip::flip(&a, &b, CompareOptions::default().pixels_per_degree).map_err(say)?;
            png::write_png(&difference_picture(&map), 8, &Provenance::default(), path).map_err(say)?;
            report::note(talk, path.display());
        }
        if self.json {
            print_json(serde_json::to_string_pretty(&comparison))?;
        } else {
            print(&format!("{comparison}\n"))?;
        }
        let exceeded = comparison.exceeded(&ErrorLimits { max: self.max, rms: self.rms, flip: self.flip });
        for line in &exceeded {
            report::note(talk, line);
        }
        Ok(if exceeded.is_empty() { Done::Yes } else { Done::Different })
    }
}
