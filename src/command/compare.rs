//! `compare`: two pictures.

use super::report::print;
use super::{Done, Outcome};
use clap::Args;
use drypoint::Failure;
use drypoint::output::compare::difference::difference_picture;
use drypoint::output::compare::{self, Limits, Options, flip};
use drypoint::output::{OutputError, png, read::read_image};
use drypoint::scene::picture::Provenance;
use std::path::PathBuf;

/// Compare two pictures: largest and RMS difference of every layer, and FLIP of the colours.
#[derive(Debug, Args)]
pub(super) struct Compare {
    /// A picture, PNG or EXR
    a: PathBuf,
    /// Another of the same size
    b: PathBuf,
    /// As JSON
    #[arg(long)]
    json: bool,
    /// Write a picture of the difference (FLIP)
    #[arg(long, value_name = "FILE")]
    diff: Option<PathBuf>,
    /// Exit with 1 where the largest difference exceeds this
    #[arg(long, value_name = "X")]
    max: Option<f64>,
    /// Exit with 1 where the RMS difference exceeds this
    #[arg(long, value_name = "X")]
    rms: Option<f64>,
    /// Exit with 1 where the mean FLIP exceeds this
    #[arg(long, value_name = "X")]
    flip: Option<f64>,
}

impl Compare {
    pub(super) fn run(self) -> Outcome {
        let say =
            |e: OutputError| Failure::new(&e, format_args!("{} and {}", self.a.display(), self.b.display()), e.help());
        let (a, b) = (read_image(&self.a).map_err(say)?, read_image(&self.b).map_err(say)?);
        let comparison = compare::compare(&a, &b, &Options::default()).map_err(say)?;
        if let Some(path) = &self.diff {
            let map = flip::flip(&a, &b, Options::default().pixels_per_degree).map_err(say)?;
            png::write_png(&difference_picture(&map), 8, &Provenance::default(), path).map_err(say)?;
        }
        if self.json {
            let json = serde_json::to_string_pretty(&comparison).map_err(|e| {
                Failure::new("the comparison cannot be written as JSON", e, "this is a fault of the program")
            })?;
            print(&format!("{json}\n"))?;
        } else {
            print(&comparison.to_string())?;
        }
        let exceeded = comparison.exceeded(&Limits { max: self.max, rms: self.rms, flip: self.flip });
        for line in &exceeded {
            eprintln!("{line}");
        }
        Ok(if exceeded.is_empty() { Done::Yes } else { Done::Different })
    }
}
