//! The verb `plan`: what a scene calls for, and why.

use super::input::{self, SceneOverrides, SetArgs, TemplateArgs};
use super::report::{Progress, print};
use super::{Outcome, Talk};
use crate::Failure;
use crate::scene::file::write_full;
use crate::stippling::Stippling;
use clap::Args;
use std::path::PathBuf;

/// List the work that a scene needs, and the keys that ask for it.
#[derive(Debug, Args)]
pub(super) struct PlanArgs {
    /// Scene or volume [default: the embedded scene]
    #[arg(value_name = "SCENE|VOLUME")]
    input: Option<PathBuf>,
    #[command(flatten)]
    template: TemplateArgs,
    /// Print the scene with every default written out, as a scene file. Paths are relative to the working directory
    #[arg(long)]
    full: bool,
    /// Print the resolved picture as JSON: everything a renderer needs besides the voxels
    #[arg(long, conflicts_with = "full")]
    json: bool,
    /// Preset of a bare volume; see `render --help`
    #[arg(long, value_name = "NAME")]
    preset: Option<String>,
    #[command(flatten)]
    set: SetArgs,
}

impl PlanArgs {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        let flags = |preset: &String| input::preset_flags(preset, self.input.as_deref(), &self.set, false);
        let flags = self.preset.iter().flat_map(flags).collect();
        let mut over = SceneOverrides::new(&self.set, flags)?;
        over.volume = self.template.volume;
        let mut job = {
            let _loading = Progress::new(talk, "loading");
            input::load(self.input.as_deref(), &over)?
        };
        if self.json {
            if !job.draws_volume() {
                let what = "the scene draws points and lines alone, and --json prints what rays have to know";
                return Err(Failure::new(what, "--json", "add a [transfer] table or a [surface]").into());
            }
            let json = job.shot()?.to_json();
            return print(
                &json.map_err(|error| Failure::new(error, "transfer.over", "name volumes by paths that are text"))?,
            );
        }
        job.plan.nodes = job.node_values();
        if !self.full && job.scene.stipples.is_some() {
            job.plan.points = Some(Stippling::planned(&job)?);
        }
        print(&if self.full { write_full(&job.scene) } else { job.plan.to_string() })
    }
}
