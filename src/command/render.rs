//! `render`: a picture.

use super::input::{self, Flag, Over, Set};
use super::raw::Raw;
use super::report::{Progress, note, print};
use super::stats::{self, Times, cpu_seconds};
use super::target::Target;
use super::{Done, Outcome, Talk};
use clap::builder::RangedU64ValueParser;
use clap::{Args, ValueEnum};
use drypoint::job::Job;
use drypoint::scene::counts::Counts;
use drypoint::scene::picture::Picture;
use drypoint::{Failure, Format};
use std::path::PathBuf;
use std::time::Instant;

/// Render a scene or a bare volume to a picture; without either, the embedded scene.
#[derive(Debug, Args)]
pub(super) struct Render {
    /// A scene (.toml) or a volume (.nrrd, .nhdr, .nii, .nii.gz, .mhd, .mha, .raw)
    #[arg(value_name = "SCENE|VOLUME")]
    input: Option<PathBuf>,
    /// Where to write; the suffix chooses PNG or EXR [default: the input's name with .png, in the working directory]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Pixels of the picture
    #[arg(long, value_name = "WxH")]
    size: Option<String>,
    /// Who renders
    #[arg(long, value_enum, default_value_t = Backend::Reference)]
    backend: Backend,
    /// The preset of a bare volume: style
    #[arg(long, value_name = "NAME")]
    preset: Option<String>,
    /// Layers of an EXR, separated by commas: beauty, Z, depth, normal, gradient, curvature, curvature.KV, first,
    /// first.normal, first.curvature, first.curvature.KV, counts. The default name then ends in .exr
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    layers: Vec<String>,
    #[command(flatten)]
    raw: Raw,
    #[command(flatten)]
    set: Set,
    /// Threads [default: one a processor]
    #[arg(long, value_name = "N", value_parser = RangedU64ValueParser::<usize>::new().range(1..=1024))]
    threads: Option<usize>,
    /// Print the counts of the render as one JSON object, alone on standard output
    #[arg(long)]
    stats: bool,
    /// Render N frames after loading, for timing: --stats then have median_s, min_s and cpu_s of a frame
    #[arg(long, value_name = "N", value_parser = RangedU64ValueParser::<usize>::new().range(1..=1_000_000))]
    repeat: Option<usize>,
}

/// Who renders.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Backend {
    /// The CPU, in f64: the truth
    Reference,
    /// The GPU; not built yet
    Gpu,
}

impl Render {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        if self.backend == Backend::Gpu {
            let what = "the GPU backend is not built yet ([GPU-1])";
            return Err(Failure::new(what, "--backend gpu", "leave --backend out: the CPU renders").into());
        }
        let target = Target::new(self.output.as_deref(), self.input.as_deref(), !self.layers.is_empty())?;
        let mut over = Over::new(&self.set, self.flags()?)?;
        over.beauty_only = target.format == Format::Png;
        if let Some(threads) = self.threads {
            let started = rayon::ThreadPoolBuilder::new().num_threads(threads).build_global();
            started.map_err(|e| Failure::new(e, format!("--threads {threads}"), "ask for fewer"))?;
        }
        let start = Instant::now();
        let job = {
            let _loading = Progress::new(talk, "loading");
            input::load(self.input.as_deref(), &over)?
        };
        let loaded = start.elapsed().as_secs_f64();
        input::tell(talk, &job);
        let (picture, mut counts, times) = self.frames(&job, talk)?;
        if job.shows_nothing(&picture) {
            let seen =
                "nothing is seen: no ray meets a value that transfer.nodes show; `drypoint info` tells the range";
            note(talk, format_args!("warning: {seen} of a volume, `drypoint plan --full` the nodes and the camera"));
        }
        counts.add(&job.counts);
        counts.seconds.insert("load".into(), loaded);
        let start = Instant::now();
        job.write(&picture, &target.path)?;
        counts.seconds.insert("write".into(), start.elapsed().as_secs_f64());
        note(talk, target.path.display());
        let line = stats::line(counts, self.repeat.map(|_| &times))?;
        if self.stats {
            return print(&line);
        }
        if talk.verbose {
            note(talk, line.trim_end());
        }
        Ok(Done::Yes)
    }

    /// The flags that stand for scene keys.
    fn flags(&self) -> Result<Vec<Flag>, Failure> {
        let mut flags: Vec<Flag> = self.raw.flag().into_iter().collect();
        if let Some(size) = &self.size {
            let typed = format!("--size {size}");
            let [w, h] = pixels(size).ok_or_else(|| {
                Failure::new(
                    format!("{size:?} is no size"),
                    &typed,
                    "write width and height in pixels, such as 800x600",
                )
            })?;
            flags.push(Flag { key: "picture.size", value: format!("[{w}, {h}]"), typed });
        }
        if let Some(preset) = &self.preset {
            flags.push(Flag::name("preset", "--preset", preset));
        }
        if !self.layers.is_empty() {
            let typed = format!("--layers {}", self.layers.join(","));
            flags.push(Flag { key: "picture.layers", value: format!("{:?}", self.layers), typed });
        }
        Ok(flags)
    }

    /// Renders, as often as asked.
    fn frames(&self, job: &Job, talk: Talk) -> Result<(Picture, Counts, Times), Failure> {
        let progress = Progress::new(talk, "rendering");
        let renderer = job.renderer()?;
        let cpu = cpu_seconds();
        let frame = || {
            let start = Instant::now();
            let (picture, counts) = renderer.frame(&|share| progress.hear(share));
            (picture, counts, start.elapsed().as_secs_f64())
        };
        let (mut picture, mut counts, first) = frame();
        let mut wall = vec![first];
        for _ in 1..self.repeat.unwrap_or(1) {
            let seconds;
            (picture, counts, seconds) = frame();
            wall.push(seconds);
        }
        let cpu = cpu_seconds().zip(cpu).map(|(after, before)| after - before);
        Ok((picture, counts, Times::new(wall, cpu)))
    }
}

/// Width and height of `800x600`.
fn pixels(size: &str) -> Option<[u64; 2]> {
    let (w, h) = size.split_once('x')?;
    Some([w.parse().ok()?, h.parse().ok()?])
}
