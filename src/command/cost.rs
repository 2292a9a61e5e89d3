//! The verb `cost`: accuracy against time.

use super::input::{self, SceneOverrides, SetArgs, TemplateArgs};
use super::report::{Progress, note, print};
use super::{Done, Outcome, Talk, graphics, output_path};
use crate::Failure;
use crate::cost::{SweepFormat, SweepOptions, csv, sweep};
use clap::Args;
use clap::builder::RangedU64ValueParser;
use std::path::PathBuf;

/// Measure the error and the time of every accuracy setting of a scene, from coarse to fine.
///
/// A knob is a scene key that trades accuracy for time, such as the step, the kernel or early termination. Knobs are
/// changed one at a time. The error compares the pictures in linear light. Its truth is the formula of a phantom, else the
/// knob's finest setting. The knob `backend` has graphics cards beside the reference, and is measured if it is named.
/// Knobs of stipples compare blurred pages of dots. Knobs of hatching compare strokes, as distances
/// in voxels.
#[derive(Debug, Args)]
pub(super) struct CostArgs {
    /// Scene or volume [default: the embedded scene]
    #[arg(value_name = "SCENE|VOLUME")]
    input: Option<PathBuf>,
    #[command(flatten)]
    template: TemplateArgs,
    /// Output file: .csv or .md for a table, .svg or .png for a plot of error against time; can be repeated
    /// [default: CSV on standard output]
    #[arg(short, long, value_name = "FILE")]
    output: Vec<PathBuf>,
    /// Measure only this knob, such as sampling.step or backend; can be repeated
    #[arg(long, value_name = "KEY")]
    knob: Vec<String>,
    /// Number of timed runs of each setting; the median is reported
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
        let mut over = SceneOverrides::new(&self.set, Vec::new())?;
        over.volume = self.template.volume;
        let job = {
            let _loading = Progress::new(talk, "loading");
            input::load(self.input.as_deref(), &over)?
        };
        files.iter().try_for_each(|(path, _)| output_path::check_not_read(path, job.scene.files()))?;
        input::tell(talk, &job);
        let cards = graphics::knob(talk, &self.knob)?;
        // The sweep, and one file for each output.
        let found = {
            let progress = Progress::new(talk, "measuring");
            sweep(&job, &SweepOptions { runs: self.runs, only: self.knob }, &cards, &|share| progress.hear(share))?
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
