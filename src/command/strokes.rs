//! The verb `strokes`: a page of hatching and outlines.

use super::input::SetArgs;
use super::page::PageRequest;
use super::raw::RawArgs;
use super::{Done, Outcome, Talk};
use clap::Args;
use drypoint::Failure;
use drypoint::job::RenderTarget;
use std::path::PathBuf;

/// Draw the strokes of a scene or a bare volume onto a page, without what is hidden, or write a saved list of strokes in another format.
#[derive(Debug, Args)]
pub(super) struct StrokesArgs {
    /// A scene (.toml) with [hatching] or [outlines], a volume, which is drawn 160 mm wide, or a list of strokes (.csv, .jsonl), whose page --set says
    #[arg(value_name = "SCENE|VOLUME|LIST")]
    input: PathBuf,
    /// Output file; the suffix chooses SVG, PDF, PNG, EXR, CSV or JSON lines; ### is the number of a frame of [orbit];
    /// a GIF, an APNG or an SVG without it shows all frames in turn
    #[arg(short, long, value_name = "FILE", required_unless_present = "seeds")]
    output: Option<PathBuf>,
    /// The preset of a bare volume: hatch, outline, or one of the figures' [default: hatch]
    #[arg(long, value_name = "NAME")]
    preset: Option<String>,
    /// Write the cells that strokes can begin in, each with its probability p: rows x,y,z,p to CSV, or a picture, the darker the
    /// more probable, to SVG, PDF, PNG or EXR
    #[arg(long, value_name = "FILE")]
    seeds: Option<PathBuf>,
    #[command(flatten)]
    raw: RawArgs,
    #[command(flatten)]
    set: SetArgs,
    /// Print the counts as one JSON object, alone on standard output
    #[arg(long)]
    stats: bool,
}

impl StrokesArgs {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        let Self { input, output, preset, seeds, raw, set, stats } = self;
        let (default_preset, target) = ("hatch", RenderTarget::Strokes);
        let draws = output.is_some();
        let output = output.unwrap_or_default();
        let page = PageRequest { input, output, preset, default_preset, raw, set, stats: stats && draws, target };
        if let Some(path) = seeds.as_ref().filter(|path| **path == page.output) {
            let what = "the seeds and the strokes go to one file";
            return Err(Failure::new(what, path.display(), "give --seeds another name").into());
        }
        if let Some(path) = &seeds {
            PageRequest { stats: stats && !draws, ..page.clone() }.seeds(path, talk)?;
        }
        if draws { page.run(talk) } else { Ok(Done::Yes) }
    }
}
