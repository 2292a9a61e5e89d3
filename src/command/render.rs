//! The verb `render`: a picture.

use super::frames::{self, DrawReport};
use super::input::{self, KeyFlag, SceneOverrides, SetArgs, TemplateArgs};
use super::output_path::RenderOutput;
use super::raw::RawArgs;
use super::report::{note, print};
use super::stats;
use super::{Done, Outcome, Talk, graphics};
use crate::gpu::Gpu;
use crate::{Failure, Format};
use clap::builder::RangedU64ValueParser;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Render a scene or a bare volume to a picture.
#[derive(Debug, Args)]
pub(super) struct RenderArgs {
    /// Scene (.toml) or volume (.nrrd, .nhdr, .nii, .nii.gz, .mhd, .mha, .raw) [default: the embedded scene]
    #[arg(value_name = "SCENE|VOLUME")]
    input: Option<PathBuf>,
    #[command(flatten)]
    template: TemplateArgs,
    /// Output file. The suffix chooses PNG, EXR, SVG or PDF; the last two draw dots and strokes as vectors over the picture.
    /// With [orbit], GIF and APNG hold all frames, and ### in the name is the number of the frame [default: the input's
    /// name with .png, in the working directory; with a second argument the volume's name]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Width and height of the picture in pixels
    #[arg(long, value_name = "WxH")]
    size: Option<String>,
    /// Renderer
    #[arg(long, value_enum, default_value_t = Backend::Reference)]
    backend: Backend,
    /// Preset of a bare volume: style, toon, halo, halo-glow, halo-lines, hatch, outline, stipple, or a figure: hatch-fig2,
    /// hatch-fig4, hatch-fig5, hatch-fig6-left, hatch-fig6-right, stipple-fig1, stipple-fig4 … stipple-fig9
    #[arg(long, value_name = "NAME")]
    preset: Option<String>,
    /// Layers of an EXR, separated by commas: beauty, Z, depth, normal, gradient, curvature, curvature.KV, first,
    /// first.normal, first.curvature, first.curvature.KV, counts, halo0, halo1, …, part0, part1, …; sets the default name's
    /// suffix to .exr
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    layers: Vec<String>,
    #[command(flatten)]
    raw: RawArgs,
    #[command(flatten)]
    set: SetArgs,
    /// Print the counts to standard output, as one JSON object
    #[arg(long)]
    stats: bool,
    /// Render N frames after loading, to measure time; --stats then have median_s, min_s and cpu_s of a frame
    #[arg(long, value_name = "N", value_parser = RangedU64ValueParser::<usize>::new().range(1..=1_000_000))]
    repeat: Option<usize>,
}

/// The renderer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Backend {
    /// CPU, in f64, the ground truth
    Reference,
    /// Graphics card, in f32; needs a build with --features gpu
    Gpu,
    /// Graphics card whose texture unit interpolates between voxels, with weights of 8 bits
    GpuFast,
}

impl Backend {
    /// Opens the graphics card, if it is to draw.
    pub(super) fn open(self, talk: Talk) -> Result<Option<Gpu>, Failure> {
        match self {
            Self::Reference => Ok(None),
            Self::Gpu | Self::GpuFast => graphics::open(talk, self == Self::GpuFast).map(Some),
        }
    }
}

impl RenderArgs {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        let gpu = self.backend.open(talk)?;
        // A template draws many volumes, and each picture has the name of its own.
        let named = self.template.volume.as_deref().or(self.input.as_deref());
        let target = RenderOutput::new(self.output.as_deref(), named, !self.layers.is_empty())?;
        let mut over = SceneOverrides::new(&self.set, self.flags()?)?;
        over.volume.clone_from(&self.template.volume);
        over.beauty_only = target.format != Format::Exr;
        let (input, files) = (self.input.as_deref(), |scene: &_| target.files(scene));
        let repeat = self.repeat.unwrap_or(1);
        let DrawReport { counts, times } = frames::load_and_draw(input, &over, files, gpu.as_ref(), repeat, talk)?;
        let line = stats::line(counts, self.repeat.map(|_| &times))?;
        if self.stats {
            return print(&line);
        }
        if talk.verbose {
            note(talk, line.trim_end());
        }
        Ok(Done::Yes)
    }

    /// Returns the flags that stand for scene keys.
    fn flags(&self) -> Result<Vec<KeyFlag>, Failure> {
        let mut flags: Vec<KeyFlag> = self.raw.flag().into_iter().collect();
        if let Some(size) = &self.size {
            flags.push(input::size_flag(size)?);
        }
        if let Some(preset) = &self.preset {
            flags.extend(input::preset_flags(preset, self.input.as_deref(), &self.set, self.size.is_some()));
        }
        if !self.layers.is_empty() {
            let typed = format!("--layers {}", self.layers.join(","));
            flags.push(KeyFlag { key: "picture.layers", value: format!("{:?}", self.layers), typed });
        }
        Ok(flags)
    }
}
