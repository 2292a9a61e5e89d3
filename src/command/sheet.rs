//! The verb `sheet`: many pictures on one.

use super::frames;
use super::input::{self, SceneOverrides, SetArgs};
use super::report::{Progress, note};
use super::{Done, Outcome, Talk, output_path};
use crate::output::png;
use crate::output::read::{Image, read_image};
use crate::output::sheet::{Layout, sheet};
use crate::scene::picture::Provenance;
use crate::{Failure, Failures, Format};
use clap::Args;
use clap::builder::RangedU64ValueParser;
use std::path::{Path, PathBuf};

/// Write a contact sheet of volumes, scenes or pictures. Volumes and scenes are rendered.
#[derive(Debug, Args)]
pub(super) struct SheetArgs {
    /// Volumes, scenes (.toml) or pictures (.png, .exr)
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Output file (.png)
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Side of a cell in pixels
    #[arg(long, default_value_t = 256, value_parser = RangedU64ValueParser::<usize>::new().range(16..=4096))]
    cell: usize,
    /// Number of pictures in a row [default: a nearly square sheet]
    #[arg(long, value_parser = RangedU64ValueParser::<usize>::new().range(1..))]
    columns: Option<usize>,
    #[command(flatten)]
    set: SetArgs,
}

impl SheetArgs {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        output_path::picture(&self.output, &[Format::Png])?;
        output_path::check_not_read(&self.output, self.files.iter().map(PathBuf::as_path))?;
        input::all_there(&self.files)?;
        let mut over = SceneOverrides::new(&self.set, Vec::new())?;
        (over.beauty_only, over.longer_side) = (true, Some(self.cell));
        let mut pictures = Vec::new();
        for file in &self.files {
            pictures.push((output_path::stem(file), self.image(file, &over, talk)?));
        }
        let layout = Layout { columns: self.columns, cell: self.cell };
        let failed = |error| Failure::picture(&error, self.output.display());
        let picture = sheet(&pictures, layout).map_err(failed)?;
        png::write_png(&picture, 8, &Provenance::default(), &self.output).map_err(failed)?;
        note(talk, self.output.display());
        Ok(Done::Yes)
    }

    /// Returns the picture of a cell: a file as it is, or anything else rendered to fit.
    fn image(&self, file: &Path, over: &SceneOverrides, talk: Talk) -> Result<Image, Failures> {
        if Format::of(file).is_some_and(|format| Format::PICTURES.contains(&format)) {
            let image = read_image(file).map_err(|error| Failure::picture(&error, file.display()))?;
            if image.colors().is_none() {
                let what = format!("the picture has no channels R, G and B; it has {}", image.names().join(", "));
                return Err(Failure::new(what, file.display(), "give a picture with colours").into());
            }
            return Ok(image);
        }
        let job = {
            let _loading = Progress::new(talk, file.display());
            input::load(Some(file), over)?
        };
        output_path::check_not_read(&self.output, job.scene.files())?;
        input::tell(talk, &job);
        let progress = Progress::new(talk, file.display());
        Ok(Image::from(&frames::first(&job, &|share| progress.hear(share))?))
    }
}
