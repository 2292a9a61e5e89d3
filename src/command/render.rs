//! `render`: a picture.

use super::input::{self, Set};
use super::report::{Progress, note, print};
use super::{Done, Failures, Outcome, Talk};
use clap::{Args, ValueEnum};
use drypoint::output::{atomic, exr, png};
use drypoint::scene::counts::Counts;
use drypoint::scene::picture::{LayerKind, Picture};
use drypoint::{Failure, job::Job};
use serde_json::json;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Render a scene or a bare volume to a picture; without either, the embedded scene.
#[derive(Debug, Args)]
pub(super) struct Render {
    /// A scene (.toml) or a volume (.nrrd, .nhdr, .nii, .nii.gz, .mhd, .mha, .raw)
    #[arg(value_name = "SCENE|VOLUME")]
    input: Option<PathBuf>,
    /// Where to write; the suffix chooses PNG or EXR [default: the input's name with .png, here]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Pixels of the picture
    #[arg(long, value_name = "WxH")]
    size: Option<String>,
    /// Who renders
    #[arg(long, value_enum, default_value_t = Backend::Reference)]
    backend: Backend,
    /// The preset of a bare volume
    #[arg(long, value_name = "NAME")]
    preset: Option<String>,
    /// Layers of an EXR, separated by commas: beauty, Z, depth, normal, gradient, curvature, curvature.KV, first, counts
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    layers: Vec<String>,
    #[command(flatten)]
    set: Set,
    /// Threads [default: all]
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    /// Print the counts of the render as JSON
    #[arg(long)]
    stats: bool,
    /// Render that many frames after loading, for timing
    #[arg(long, value_name = "N", default_value_t = 1)]
    repeat: usize,
}

/// Who renders.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Backend {
    /// The CPU reference, the truth.
    Reference,
    /// The GPU.
    Gpu,
}

/// What the suffix of the output chooses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Png,
    Exr,
}

impl Render {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        if self.backend == Backend::Gpu {
            return Err(
                Failure::new("the GPU backend is not built yet", "--backend gpu", "use --backend reference").into()
            );
        }
        let target = self.target();
        let format = format_of(&target)?;
        let overrides = self.set.overrides(&self.own_overrides()?)?;
        let job = input::load(self.input.as_ref(), &overrides)?;
        for warning in &job.plan.warnings {
            note(talk, format_args!("warning: {warning}"));
        }
        if let Some(mask) = job.volume.mask() {
            note(
                talk,
                format_args!(
                    "warning: {} voxels are NaN or infinite; the cells they touch are transparent",
                    mask.count()
                ),
            );
        }
        if talk.verbose {
            note(talk, &job.plan);
        }
        let (picture, counts, times) = in_threads(self.threads, || self.frames(&job, talk))??;
        write(&job, &picture, format, &target)?;
        note(talk, format_args!("{}", target.display()));
        if self.stats {
            return print(&stats(&counts, &times)?);
        }
        Ok(Done::Yes)
    }

    /// Where the picture goes.
    fn target(&self) -> PathBuf {
        self.output.clone().unwrap_or_else(|| match &self.input {
            None => PathBuf::from("drypoint.png"),
            Some(input) => {
                let name = input.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
                let stem = name.split('.').next().filter(|s| !s.is_empty()).unwrap_or("drypoint");
                PathBuf::from(format!("{stem}.png"))
            }
        })
    }

    /// Flags that stand for scene keys.
    fn own_overrides(&self) -> Result<Vec<(&'static str, String)>, Failures> {
        let mut own = Vec::new();
        if let Some(size) = &self.size {
            let parts = size.split_once('x').and_then(|(w, h)| Some((w.parse::<u32>().ok()?, h.parse::<u32>().ok()?)));
            let (w, h) =
                parts.ok_or_else(|| Failure::new(format!("`{size}` is no size"), "--size", "write it as 800x600"))?;
            own.push(("picture.size", format!("[{w}, {h}]")));
        }
        if let Some(preset) = &self.preset {
            own.push(("preset", preset.clone()));
        }
        if !self.layers.is_empty() {
            let unknown = self.layers.iter().find(|name| LayerKind::from_name(name).is_none());
            if let Some(name) = unknown {
                let known = LayerKind::ALL.map(LayerKind::name).join(", ");
                return Err(
                    Failure::new(format!("there is no layer `{name}`"), "--layers", format!("one of {known}")).into()
                );
            }
            let list: Vec<String> = self.layers.iter().map(|name| format!("\"{name}\"")).collect();
            own.push(("picture.layers", format!("[{}]", list.join(", "))));
        }
        Ok(own)
    }

    /// Renders, as often as asked.
    fn frames(&self, job: &Job, talk: Talk) -> Result<(Picture, Counts, Times), Failures> {
        let renderer = job.renderer()?;
        let progress = Progress::new(talk);
        let cpu = cpu_seconds();
        let mut wall = Vec::new();
        let mut frame = None;
        for _ in 0..self.repeat.max(1) {
            let start = Instant::now();
            frame = Some(renderer.frame(&|share| progress.hear(share)));
            wall.push(start.elapsed().as_secs_f64());
        }
        progress.clear();
        let cpu = cpu_seconds().zip(cpu).map(|(after, before)| (after - before) / wall.len() as f64);
        wall.sort_by(f64::total_cmp);
        match frame {
            Some((picture, counts)) => Ok((picture, counts, Times { wall, cpu })),
            None => Err(Failure::new("no frame was rendered", "--repeat", "ask for one at least").into()),
        }
    }
}

/// How long the frames took.
struct Times {
    /// Seconds of each frame, in ascending order.
    wall: Vec<f64>,
    /// Processor seconds a frame, where the system says.
    cpu: Option<f64>,
}

/// The format that a suffix asks for.
fn format_of(target: &Path) -> Result<Format, Failures> {
    let suffix = target.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
    match suffix.as_str() {
        "png" => Ok(Format::Png),
        "exr" => Ok(Format::Exr),
        "svg" | "pdf" => Err(Failure::new(
            format!(
                "a rendered volume is no vector picture: .{suffix} is for points and strokes, which are not built yet"
            ),
            target.display(),
            "write .png or .exr",
        )
        .into()),
        _ => Err(Failure::new("the suffix names no picture format", target.display(), "write .png or .exr").into()),
    }
}

/// Runs with a number of threads of its own.
fn in_threads<T: Send>(threads: Option<usize>, work: impl FnOnce() -> T + Send) -> Result<T, Failures> {
    let Some(n) = threads else { return Ok(work()) };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build();
    let pool = pool.map_err(|e| Failure::new("the threads cannot be started", e, "ask for fewer with --threads"))?;
    Ok(pool.install(work))
}

/// Writes the picture beside its target, then renames.
fn write(job: &Job, picture: &Picture, format: Format, target: &Path) -> Result<(), Failures> {
    let provenance = job.provenance();
    let written = match format {
        Format::Png => png::write_png(picture, job.scene.picture.bits, &provenance, target),
        Format::Exr => exr::write_exr(picture, &provenance, target),
    };
    written.map_err(|e| {
        atomic::remove_unfinished();
        Failure::new(&e, target.display(), e.help()).into()
    })
}

/// The JSON object of `--stats`.
fn stats(counts: &Counts, times: &Times) -> Result<String, Failures> {
    let mut value = serde_json::to_value(counts)
        .map_err(|e| Failure::new("the counts cannot be written as JSON", e, "this is a fault of the program"))?;
    if let Some(object) = value.as_object_mut() {
        object.insert("median_s".into(), json!(times.wall[times.wall.len() / 2]));
        object.insert("min_s".into(), json!(times.wall[0]));
        object.insert("cpu_s".into(), json!(times.cpu));
        object.insert("samples_M".into(), json!(counts.samples as f64 / 1e6));
    }
    Ok(format!("{value}\n"))
}

/// Processor seconds that this process has used, where the system says so in its process table.
fn cpu_seconds() -> Option<f64> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    // Fields 14 and 15 (user and system time in ticks of 1/100 s), counted behind the name in parentheses.
    let mut fields = stat.rsplit_once(')')?.1.split_whitespace().skip(11);
    let (user, system) = (fields.next()?.parse::<f64>().ok()?, fields.next()?.parse::<f64>().ok()?);
    Some((user + system) / 100.0)
}
