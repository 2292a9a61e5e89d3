//! The verb `cost`: accuracy against time.

use super::input::{self, SceneOverrides, SetArgs};
use super::report::{Progress, note, print};
use super::{Done, Outcome, Talk, output_path};
use clap::Args;
use clap::builder::RangedU64ValueParser;
use drypoint::Failure;
use drypoint::cost::{SweepFormat, SweepOptions, csv, sweep};
use std::path::PathBuf;

/// Turn every knob of a scene from coarse to fine, and tell the error and the time of each setting.
///
/// A knob is a key that trades accuracy for time: the step, the kernel, early termination and others, as far as the
/// scene uses them. One is turned at a time. The error is that of the picture in linear light: against the formula of a
/// phantom, else against the knob's finest setting. Knobs of stipples are measured on the page of dots, blurred over a few
/// distances between them; those of hatching on the strokes, as distances in voxels.
#[derive(Debug, Args)]
pub(super) struct CostArgs {
    /// A scene or a volume; without either, the embedded scene
    #[arg(value_name = "SCENE|VOLUME")]
    input: Option<PathBuf>,
    /// Output file, as often as wanted: .csv, .md for a Markdown table, .svg or .png for a plot of error against time
    /// [default: CSV on standard output]
    #[arg(short, long, value_name = "FILE")]
    output: Vec<PathBuf>,
    /// Turn this knob alone, such as sampling.step; as often as wanted
    #[arg(long, value_name = "KEY")]
    knob: Vec<String>,
    /// Number of times each setting is timed; the result is the median
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = RangedU64ValueParser::<usize>::new().range(1..=1000))]
    runs: usize,
    #[command(flatten)]
    set: SetArgs,
}

impl CostArgs {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        // A sweep takes long, so faults of the output files are reported first.
        let mut files = Vec::new();
        for path in self.output {
            let form = SweepFormat::of(&path)?;
            output_path::writable(&path)?;
            files.push((path, form));
        }
        // The scene, and a warning for each output file that it reads.
        let over = SceneOverrides::new(&self.set, Vec::new())?;
        let job = {
            let _loading = Progress::new(talk, "loading");
            input::load(self.input.as_deref(), &over)?
        };
        files.iter().try_for_each(|(path, _)| output_path::check_not_read(path, job.scene.files()))?;
        input::tell(talk, &job);
        // The sweep, and one file for each output.
        let found = {
            let progress = Progress::new(talk, "measuring");
            sweep(&job, &SweepOptions { runs: self.runs, only: self.knob }, &|share| progress.hear(share))?
        };
        for (knob, setting, failure) in &found.left_out {
            note(talk, format_args!("warning: {knob} = {setting} is left out: {}", failure.what));
        }
        for (path, form) in &files {
            let name = self.input.as_deref().map_or("the embedded scene".into(), output_path::stem);
            let bytes = form.of_sweep(&found, &name).map_err(|what| {
                Failure::new(what, path.display(), "write a .csv, or turn a knob that changes the picture")
            })?;
            output_path::write(path, &bytes)?;
            note(talk, path.display());
        }
        if files.is_empty() { print(&csv(&found)) } else { Ok(Done::Yes) }
    }
}
