//! `docs/scene-reference.md` and `docs/scene.schema.json`, from the description of the tables.

use crate::files;
use drypoint::scene::file::{reference_markdown, schema};

/// What is generated: file and text.
fn pages() -> [(&'static str, String); 2] {
    [("scene-reference.md", reference_markdown()), ("scene.schema.json", format!("{:#}\n", schema()))]
}

/// Writes both files.
///
/// # Errors
/// What the system says, with the file.
pub(crate) fn write() -> Result<(), String> {
    pages().iter().try_for_each(|(name, text)| files::write(name, text.as_bytes()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_checked_in_files_are_what_the_tables_say() {
        for (name, text) in pages() {
            let written = std::fs::read_to_string(files::in_docs(name)).unwrap();
            assert!(written == text, "docs/{name} is out of date: cargo run --release -p drypoint-docs -- reference");
        }
    }
}
