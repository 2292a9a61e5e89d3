//! The verb `strokes`: a page of hatching and outlines.

use super::input::{SetArgs, TemplateArgs};
use super::page::PageRequest;
use super::raw::RawArgs;
use super::{Done, Outcome, Talk};
use crate::Failure;
use crate::job::RenderTarget;
use clap::Args;
use std::path::PathBuf;

/// Draw the visible strokes of a scene or a bare volume, or convert a saved list of strokes.
#[derive(Debug, Args)]
pub(super) struct StrokesArgs {
    /// Scene (.toml) with [hatching] or [outlines]; volume, drawn 160 mm wide; or list of strokes (.csv, .jsonl), whose page --set gives
    #[arg(value_name = "SCENE|VOLUME|LIST")]
    input: PathBuf,
    #[command(flatten)]
    template: TemplateArgs,
    /// Output file. The suffix chooses SVG, PDF, PNG, EXR, CSV or JSON lines. With [orbit], ### in the name is the
    /// number of the frame; GIF, APNG and SVG can also hold all frames as an animation
    #[arg(short, long, value_name = "FILE", required_unless_present = "seeds")]
    output: Option<PathBuf>,
    /// Preset of a bare volume: hatch, outline, or a figure of the paper; see `render --help` [default: hatch]
    #[arg(long, value_name = "NAME")]
    preset: Option<String>,
    /// Write the cells that strokes can start in, with their probability p: rows x,y,z,p as CSV, or a picture, darker for a
    /// higher probability, as SVG, PDF, PNG or EXR
    #[arg(long, value_name = "FILE")]
    seeds: Option<PathBuf>,
    #[command(flatten)]
    raw: RawArgs,
    #[command(flatten)]
    set: SetArgs,
    /// Print the counts to standard output, as one JSON object
    #[arg(long)]
    stats: bool,
}

impl StrokesArgs {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        let Self { input, template, output, preset, seeds, raw, set, stats } = self;
        let (default_preset, target) = ("hatch", RenderTarget::Strokes);
        let draws = output.is_some();
        let output = output.unwrap_or_default();
        let (volume, drawn) = (template.volume, stats && draws);
        let page = PageRequest { input, volume, output, preset, default_preset, raw, set, stats: drawn, target };
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
