//! The verb `halo`: the halo of a picture of seeds ([HALO-4], [HALO-5], [HALO-10]).

use super::report::note;
use super::{Done, Outcome, Talk, output_path};
use crate::halo::{HaloFigure, IntensityMap};
use crate::output::{exr, png};
use crate::reference::volumetric_halos::{Border, Process, SpreadParams};
use crate::scene::picture::{Layer, LayerKind, Picture, Provenance};
use crate::{Failure, Format};
use clap::builder::RangedU64ValueParser;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Passes at the most: 4095 pixels of reach.
const MAX_PASSES: u64 = 12;

/// Spread a picture of seeds into a halo that keeps small features.
#[derive(Debug, Args)]
pub(super) struct HaloArgs {
    /// Picture of seeds, PNG, JPEG or OpenEXR. The intensity is luminance times alpha, of the encoded numbers
    /// code/(2ⁿ − 1)
    picture: PathBuf,
    /// Output file. The suffix chooses a grey PNG or an EXR
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Amount of spreading δ, from 0 (none) to 1
    #[arg(long, value_name = "D", default_value_t = 0.8, value_parser = delta, allow_negative_numbers = true)]
    delta: f64,
    /// Number of passes N: intensities spread by up to 2^N − 1 pixels
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = RangedU64ValueParser::<u32>::new().range(..=MAX_PASSES))]
    passes: u32,
    /// Values beyond the border
    #[arg(long, value_enum, default_value_t = BorderChoice::Replicate)]
    border: BorderChoice,
    /// Image that is spread
    #[arg(long, value_enum, default_value_t = From::Gradient)]
    from: From,
    /// Filter of the spread image
    #[arg(long, value_enum, default_value_t = Filter::Spread)]
    filter: Filter,
    /// First remove single pixels from the seeds by a 3×3 median
    #[arg(long)]
    median: bool,
    /// Write a contact sheet instead of a halo, as PNG
    #[arg(long, value_enum, conflicts_with_all = ["from", "filter"])]
    figure: Option<FigureChoice>,
    /// Bits of a pixel in a PNG
    #[arg(long, default_value = "16", value_parser = ["8", "16"], conflicts_with = "figure")]
    bits: String,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum BorderChoice {
    /// Zero; content cut by the frame has an edge there
    Zero,
    /// Nearest pixel; the frame is no edge
    Replicate,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum From {
    /// Gradient magnitude of the seeds; small and large features have equal halos
    Gradient,
    /// Seeds
    Seeds,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Filter {
    /// Passes that keep the original image
    Spread,
    /// Passes of the low-pass filter only
    LowPass,
    /// No filter
    None,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum FigureChoice {
    /// Seeds and gradient: unfiltered, low-pass filtered and spread
    Stages,
    /// Spread gradients for four values of δ, 0.70 to 0.95
    Deltas,
}

/// Parses δ.
fn delta(text: &str) -> Result<f64, &'static str> {
    let number = text.parse::<f64>().ok().filter(|delta| (0.0..=1.0).contains(delta));
    number.ok_or("not a number from 0 to 1")
}

impl HaloArgs {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        let formats: &[Format] = if self.figure.is_some() { &[Format::Png] } else { &Format::PICTURES };
        let format = output_path::picture(&self.output, formats)?;
        output_path::check_not_read(&self.output, [&*self.picture])?;
        let seeds = IntensityMap::read(&self.picture)?;
        let spread = SpreadParams {
            from_gradient: self.from == From::Gradient,
            passes: self.passes,
            delta: self.delta,
            stretch: 1.0,
            median: self.median,
            floor: 0.0,
        };
        let border = match self.border {
            BorderChoice::Zero => Border::Zero,
            BorderChoice::Replicate => Border::Replicate,
        };
        let failed = |error| Failure::picture(&error, self.output.display());
        if let Some(figure) = self.figure {
            let figure = match figure {
                FigureChoice::Stages => HaloFigure::Stages,
                FigureChoice::Deltas => HaloFigure::Deltas,
            };
            let picture = figure.draw(&seeds, spread, border, &self.picture)?;
            png::write_png(&picture, 8, &Provenance::default(), &self.output).map_err(failed)?;
            note(talk, self.output.display());
            return Ok(Done::Yes);
        }
        let process = match self.filter {
            Filter::Spread => Process::Spread,
            Filter::LowPass => Process::LowPass,
            Filter::None => Process::Source,
        };
        let halo = seeds.halo(spread, border, process, &self.picture)?;
        if format == Format::Png {
            let bits = if self.bits == "8" { 8 } else { 16 };
            png::write_grey_png(halo.size, &halo.values, bits, &self.output).map_err(failed)?;
        } else {
            exr::write_exr(&grey_picture(halo), &Provenance::default(), &self.output).map_err(failed)?;
        }
        note(talk, self.output.display());
        Ok(Done::Yes)
    }
}

/// Returns a map as opaque colours, number for number.
fn grey_picture(map: IntensityMap) -> Picture {
    let ([width, height], alpha) = (map.size, vec![1.0; map.values.len()]);
    let channels = vec![map.values.clone(), map.values.clone(), map.values, alpha];
    Picture { width, height, layers: vec![Layer { kind: LayerKind::Beauty, channels }] }
}
