//! The verb `styles`: the styles of a theme, new ones from pictures, and the presets of lighting functions.

mod extract;
mod lighting;

use super::report::{note, print};
use super::{Done, Outcome, Talk, output_path};
use crate::output::png;
use crate::output::read::Image;
use crate::output::sheet::{Layout, sheet};
use crate::reference::style_transfer_functions::preview;
use crate::scene::picture::Provenance;
use crate::scene::source::Disk;
use crate::scene::style::{StyleError, Theme};
use crate::scene::tables::StyleSource;
use crate::{Failure, Failures, Format};
use clap::{Args, Subcommand};
use std::path::PathBuf;

/// Pixels across a sphere of the sheet.
const CELL: usize = 176;

/// List the styles of a theme. With -o, write a sheet of labelled spheres.
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true)]
pub(super) struct StylesArgs {
    #[command(subcommand)]
    what: Option<StylesVerb>,
    #[arg(long, value_name = "NAME|FOLDER", default_value = "textbook", help = theme_help())]
    theme: String,
    /// Write a preview sheet, as PNG
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

#[derive(Debug, Subcommand)]
enum StylesVerb {
    /// Make a style from a part of a picture
    Extract(extract::ExtractArgs),
    /// List the presets of lighting functions. With -o, write a sheet of lit spheres, or a preset's table
    Lighting(lighting::LightingArgs),
}

/// Returns the help of `--theme` with the names of themes.
fn theme_help() -> String {
    let names: Vec<&str> = Theme::embedded_names().collect();
    format!("An embedded theme ({}), or a folder of pictures", names.join(", "))
}

impl StylesArgs {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        match self.what {
            Some(StylesVerb::Extract(verb)) => return verb.run(talk),
            Some(StylesVerb::Lighting(verb)) => return verb.run(talk),
            None => {}
        }
        let folder = PathBuf::from(&self.theme);
        if let Some(output) = &self.output {
            output_path::picture(output, &[Format::Png])?;
            output_path::check_not_read(output, [&*folder])?;
        }
        // The theme: an embedded one, or a folder.
        let source = if folder.is_dir() && !Theme::embedded_names().any(|name| name == self.theme) {
            StyleSource::Folder(folder)
        } else {
            StyleSource::Embedded(self.theme.clone())
        };
        let refused = |error: StyleError| Failure::new(&error, format_args!("--theme {}", self.theme), error.help());
        let theme = Theme::open(&Disk, &source).map_err(refused)?;
        let names: Vec<&str> = theme.names().collect();
        if names.is_empty() {
            let place = format!("--theme {}", self.theme);
            return Err(Failure::new("the theme has no style", place, "put square pictures into its folder").into());
        }
        let Some(output) = &self.output else {
            return print(&names.iter().map(|name| format!("{name}\n")).collect::<String>());
        };
        // The sheet: a sphere for each style.
        let (mut styles, mut failures) = (Vec::new(), Vec::new());
        for style in names.iter().filter_map(|name| theme.style(&Disk, name)) {
            match style {
                Ok(style) => styles.push(style),
                Err(error) => failures.push(refused(error)),
            }
        }
        Failures::check(failures)?;
        let spheres: Vec<(String, Image)> =
            styles.iter().map(|style| (style.name.clone(), Image::from(&preview(style, CELL)))).collect();
        let failed = |error| Failure::picture(&error, output.display());
        let picture = sheet(&spheres, Layout { columns: None, cell: CELL }).map_err(failed)?;
        png::write_png(&picture, 8, &Provenance::default(), output).map_err(failed)?;
        note(talk, output.display());
        Ok(Done::Yes)
    }
}
