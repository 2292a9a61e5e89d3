//! The verb `validate`: a graphics card against the reference.

use super::input::{SetArgs, TemplateArgs};
use super::raw::RawArgs;
use super::{Outcome, Talk, graphics};
use clap::Args;
use std::path::PathBuf;

/// Compare a graphics card with the reference, stage by stage and within derived bounds; exit code 1 when a bound is
/// exceeded or a stage parts in f64, 3 when nothing is proven of f32: no bound is known for the scene.
#[derive(Debug, Args)]
pub(super) struct ValidateArgs {
    /// Scene (.toml) or volume
    #[arg(value_name = "SCENE|VOLUME")]
    input: PathBuf,
    #[command(flatten)]
    template: TemplateArgs,
    /// Write a picture of the difference (FLIP), as PNG
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Width and height of the picture in pixels
    #[arg(long, value_name = "WxH")]
    size: Option<String>,
    /// Print JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    raw: RawArgs,
    #[command(flatten)]
    set: SetArgs,
}

impl ValidateArgs {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        let gpu = graphics::open(talk, false)?;
        #[cfg(feature = "gpu")]
        return self.compare(&gpu, talk);
        #[cfg(not(feature = "gpu"))]
        match gpu {}
    }

    #[cfg(feature = "gpu")]
    fn compare(self, gpu: &crate::gpu::Gpu, talk: Talk) -> Outcome {
        use super::input::{self, SceneOverrides};
        use super::report::{note, print, print_json};
        use super::{Done, output_path};
        use crate::output::compare::difference::difference_picture;
        use crate::output::compare::{CompareOptions, flip};
        use crate::output::png;
        use crate::scene::picture::Provenance;
        use crate::validate::{Validation, Verdict};
        use crate::{Failure, Format};

        /// The comparison as JSON.
        #[derive(serde::Serialize)]
        struct Report<'v> {
            #[serde(flatten)]
            found: &'v Validation,
            verdict: Verdict,
        }

        if let Some(path) = &self.output {
            output_path::picture(path, &[Format::Png])?;
            output_path::check_not_read(path, std::iter::once(&*self.input).chain(self.template.volume.as_deref()))?;
        }
        let mut flags: Vec<_> = self.raw.flag().into_iter().collect();
        if let Some(size) = &self.size {
            flags.push(input::size_flag(size)?);
        }
        let mut over = SceneOverrides::new(&self.set, flags)?;
        over.volume = self.template.volume;
        let job = input::find(Some(&self.input), &over)?.load(over.target)?;
        let found = crate::validate::validate(&job, gpu)?;
        if let Some(path) = &self.output {
            let say = |error| Failure::picture(&error, path.display());
            let [a, b] = found.pictures.each_ref().map(crate::output::read::Image::from);
            let map = flip::flip(&a, &b, CompareOptions::default().pixels_per_degree).map_err(say)?;
            png::write_png(&difference_picture(&map), 8, &Provenance::default(), path).map_err(say)?;
            note(talk, path.display());
        }
        if self.json {
            print_json(serde_json::to_string_pretty(&Report { found: &found, verdict: found.verdict() }))?;
        } else {
            print(&format!("{found}\n"))?;
        }
        Ok(match found.verdict() {
            Verdict::Kept => Done::Yes,
            Verdict::Failed => Done::Different,
            Verdict::NotProven => Done::NotProven,
        })
    }
}
