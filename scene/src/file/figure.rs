//! Figure files: several scenes on one page.

use super::{Faults, Overrides, data_folders, document, find, finish, text};
use crate::document::check::Check;
use crate::document::item::{Item, Value};
use crate::document::{full, reference, schema};
use crate::tables::Figure;
use crate::tables::figure::root::ROOT;
use std::path::Path;

/// Returns the figure with every default filled in, as the text of a figure file ([SCN-3]). See [`super::write_full`].
pub fn write_full_figure(figure: &Figure) -> String {
    full::write(&ROOT, figure, |out| out)
}

/// Returns the text of [`write_full_figure`] with every path cut to its last name. See [`super::identity`].
pub fn figure_identity(figure: &Figure) -> String {
    full::write(&ROOT, figure, full::without_folders)
}

/// The JSON Schema (2020-12) of a figure file. See [`super::schema`].
pub fn figure_schema() -> serde_json::Value {
    schema::document("Drypoint figure", &ROOT.section())
}

/// A page of Markdown with every table and key of a figure file. See [`super::reference_markdown`].
pub fn figure_reference_markdown() -> String {
    reference::page("Figure file reference", &ROOT.section())
}

/// Whether a text is that of a figure file: it has panels.
pub fn is_figure(text: &str) -> bool {
    Item::document(text)
        .is_ok_and(|document| matches!(document.value, Value::Table(entries) if entries.contains_key("panel")))
}

/// Reads a figure from the text of a file. Relative paths are resolved against the folder of `file_name`. No file that
/// the figure names is opened.
///
/// # Errors
/// Every fault of the text and of the overrides, with its place ([SCN-4]).
pub fn parse_figure(text: &str, file_name: &Path, overrides: &Overrides) -> Result<Figure, Faults> {
    let mut check = Check::new(file_name);
    let figure = read(text, overrides, &mut check);
    finish(figure, |figure| &mut figure.given, check)
}

/// Reads a figure file. A volume that is not beside it is looked for in [`data_folders`].
///
/// # Errors
/// A file that cannot be read, every fault of its text and of the overrides, and every file that it names and that is
/// not there. Scenes are not read.
pub fn load_figure(path: &Path, overrides: &Overrides) -> Result<Figure, Faults> {
    let mut check = Check::new(path);
    let mut figure = text(path, &mut check).and_then(|text| read(&text, overrides, &mut check));
    if let Some(figure) = &mut figure {
        find::panels(figure, &mut check, &data_folders());
    }
    finish(figure, |figure| &mut figure.given, check)
}

fn read(text: &str, overrides: &Overrides, check: &mut Check) -> Option<Figure> {
    let mut document = document(text, check)?;
    overrides.apply(&ROOT, &mut document, check);
    check.table(&ROOT, &document)
}
