//! `sheet`: many pictures on one.

use super::input::{self, Set};
use super::report::note;
use super::{Done, Failures, Outcome, Talk};
use clap::Args;
use drypoint::Failure;
use drypoint::output::png;
use drypoint::output::read::{Image, read_image};
use drypoint::output::sheet::{Layout, sheet};
use drypoint::scene::picture::Provenance;
use std::path::{Path, PathBuf};

/// Write a contact sheet of volumes, scenes or pictures; volumes and scenes are rendered.
#[derive(Debug, Args)]
pub(super) struct Sheet {
    /// Volumes, scenes (.toml) or pictures (.png, .exr)
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Where to write (.png)
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Pixels along the side of a cell
    #[arg(long, default_value_t = 256)]
    cell: usize,
    /// Pictures in a row [default: about as many as there are rows]
    #[arg(long)]
    columns: Option<usize>,
    #[command(flatten)]
    set: Set,
}

impl Sheet {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        let mut pictures = Vec::new();
        for file in &self.files {
            note(talk, file.display());
            let name = file.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
            pictures.push((name.split('.').next().unwrap_or_default().to_owned(), self.image(file)?));
        }
        let layout = Layout { columns: self.columns, cell: self.cell };
        let picture = sheet(&pictures, layout).map_err(|e| Failure::new(&e, self.output.display(), e.help()))?;
        png::write_png(&picture, 8, &Provenance::default(), &self.output)
            .map_err(|e| Failure::new(&e, self.output.display(), e.help()))?;
        note(talk, self.output.display());
        Ok(Done::Yes)
    }

    /// One cell: a picture as it is, anything else rendered at the cell's size.
    fn image(&self, file: &Path) -> Result<Image, Failures> {
        let suffix = file.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
        if matches!(suffix.as_str(), "png" | "exr") {
            return Ok(read_image(file).map_err(|e| Failure::new(&e, file.display(), e.help()))?);
        }
        let size = format!("[{0}, {0}]", self.cell);
        let overrides = self.set.overrides(&[("picture.size", size)])?;
        let job = input::load(Some(&file.to_path_buf()), &overrides)?;
        let (picture, _) = job.renderer()?.frame(&|_| ());
        Ok(Image::from(&picture))
    }
}
