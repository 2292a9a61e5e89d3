//! `docs/scene-reference.md`, `docs/figure-reference.md` and their JSON Schemas, from the description of the tables.

use crate::files;
use drypoint::scene::file::{figure_reference_markdown, figure_schema, reference_markdown, schema};

/// What is generated: file and text.
fn pages() -> [(&'static str, String); 4] {
    [
        ("scene-reference.md", reference_markdown()),
        ("scene.schema.json", format!("{:#}\n", schema())),
        ("figure-reference.md", figure_reference_markdown()),
        ("figure.schema.json", format!("{:#}\n", figure_schema())),
    ]
}

/// Writes the files.
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
