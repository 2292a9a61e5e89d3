//! `points`: a page of stipples.

use super::input::Set;
use super::page::Page;
use super::raw::Raw;
use super::{Outcome, Talk};
use clap::Args;
use drypoint::job::Wanted;
use std::path::PathBuf;

/// Stipple a scene or a bare volume onto a page, or write a saved list of dots in another format.
#[derive(Debug, Args)]
pub(super) struct Points {
    /// A scene (.toml) with [stipples], a volume, which is drawn 160 mm wide, or a list of dots (.csv, .jsonl), whose page --set says
    #[arg(value_name = "SCENE|VOLUME|LIST")]
    input: PathBuf,
    /// Where to write; the suffix chooses SVG, PDF, PNG, EXR, CSV or JSON lines; ### is the number of a frame of [orbit],
    /// all of which an SVG without it shows in turn
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The preset of a bare volume: stipple, or stipple-fig1, stipple-fig4 … stipple-fig9 [default: stipple]
    #[arg(long, value_name = "NAME")]
    preset: Option<String>,
    #[command(flatten)]
    raw: Raw,
    #[command(flatten)]
    set: Set,
    /// Print the counts as one JSON object, alone on standard output
    #[arg(long)]
    stats: bool,
}

impl Points {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        let Self { input, output, preset, raw, set, stats } = self;
        let (default_preset, wanted) = ("stipple", Wanted::Points);
        Page { input, output, preset, default_preset, raw, set, stats, wanted }.run(talk)
    }
}
