//! `styles`: the styles of a theme.

use super::report::{note, print};
use super::{Done, Outcome, Talk};
use clap::Args;
use drypoint::Failure;
use drypoint::output::png;
use drypoint::reference::style_transfer_functions::gallery::preview_sheet;
use drypoint::scene::picture::Provenance;
use drypoint::scene::style::{StyleError, Theme};
use drypoint::scene::tables::StyleSource;
use std::path::PathBuf;

/// List the styles of a theme; with -o, write a sheet of spheres.
#[derive(Debug, Args)]
pub(super) struct Styles {
    /// An embedded theme, or a folder of pictures
    #[arg(long, value_name = "NAME|FOLDER", default_value = "textbook")]
    theme: String,
    /// Write a preview sheet (.png)
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

impl Styles {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        let source = if Theme::embedded_names().any(|name| name == self.theme) {
            StyleSource::Embedded(self.theme.clone())
        } else {
            StyleSource::Folder(PathBuf::from(&self.theme))
        };
        let theme = Theme::open(&source).map_err(|e| refused(&e))?;
        let names: Vec<String> = theme.names().map(str::to_owned).collect();
        let Some(output) = &self.output else { return print(&(names.join("\n") + "\n")) };
        let mut styles = Vec::new();
        for style in names.iter().filter_map(|name| theme.style(name)) {
            styles.push(style.map_err(|e| refused(&e))?);
        }
        png::write_png(&preview_sheet(&styles), 8, &Provenance::default(), output)
            .map_err(|e| Failure::new(&e, output.display(), e.help()))?;
        note(talk, output.display());
        Ok(Done::Yes)
    }
}

/// A theme or a style that cannot be had.
fn refused(error: &StyleError) -> Failure {
    Failure::new(error, "--theme", "give the name of an embedded theme, or a folder of square pictures")
}
