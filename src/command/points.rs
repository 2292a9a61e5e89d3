//! The verb `points`: a page of stipples.

use super::input::SetArgs;
use super::page::PageRequest;
use super::raw::RawArgs;
use super::{Outcome, Talk};
use clap::Args;
use drypoint::job::RenderTarget;
use std::path::PathBuf;

/// Stipple a scene or a bare volume onto a page, or write a saved list of dots in another format.
#[derive(Debug, Args)]
pub(super) struct PointsArgs {
    /// A scene (.toml) with [stipples], a volume, which is drawn 160 mm wide, or a list of dots (.csv, .jsonl), whose page --set says
    #[arg(value_name = "SCENE|VOLUME|LIST")]
    input: PathBuf,
    /// Output file; the suffix chooses SVG, PDF, PNG, EXR, CSV or JSON lines; ### is the number of a frame of [orbit];
    /// a GIF, an APNG or an SVG without it shows all frames in turn
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The preset of a bare volume: stipple, or stipple-fig1, stipple-fig4 … stipple-fig9 [default: stipple]
    #[arg(long, value_name = "NAME")]
    preset: Option<String>,
    #[command(flatten)]
    raw: RawArgs,
    #[command(flatten)]
    set: SetArgs,
    /// Print the counts as one JSON object, alone on standard output
    #[arg(long)]
    stats: bool,
}

impl PointsArgs {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        let Self { input, output, preset, raw, set, stats } = self;
        let (default_preset, target) = ("stipple", RenderTarget::Points);
        PageRequest { input, output, preset, default_preset, raw, set, stats, target }.run(talk)
    }
}
