//! The verb `points`: a page of stipples.

use super::input::{SetArgs, TemplateArgs};
use super::page::PageRequest;
use super::raw::RawArgs;
use super::{Outcome, Talk};
use crate::job::RenderTarget;
use clap::Args;
use std::path::PathBuf;

/// Draw a scene or a bare volume in stipples, or convert a saved list of dots.
#[derive(Debug, Args)]
pub(super) struct PointsArgs {
    /// Scene (.toml) with [stipples]; volume, drawn 160 mm wide; or list of dots (.csv, .jsonl), whose page --set gives
    #[arg(value_name = "SCENE|VOLUME|LIST")]
    input: PathBuf,
    #[command(flatten)]
    template: TemplateArgs,
    /// Output file. The suffix chooses SVG, PDF, PNG, EXR, CSV or JSON lines. With [orbit], ### in the name is the
    /// number of the frame; GIF, APNG and SVG can also hold all frames as an animation
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Preset of a bare volume: stipple, stipple-fig1, stipple-fig4 … stipple-fig9 [default: stipple]
    #[arg(long, value_name = "NAME")]
    preset: Option<String>,
    #[command(flatten)]
    raw: RawArgs,
    #[command(flatten)]
    set: SetArgs,
    /// Print the counts to standard output, as one JSON object
    #[arg(long)]
    stats: bool,
}

impl PointsArgs {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        let Self { input, template, output, preset, raw, set, stats } = self;
        let (default_preset, target) = ("stipple", RenderTarget::Points);
        PageRequest { input, volume: template.volume, output, preset, default_preset, raw, set, stats, target }
            .run(talk)
    }
}
