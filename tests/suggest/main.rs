//! Pictures that nobody has set up: bare volumes, and the scenes that come with the program.

mod bare;
mod data_page;
mod labels;
mod measure;
mod scenes;
mod selections;
mod templates;

use std::path::PathBuf;

/// The folder of the shared volumes, if there is one here.
fn data() -> Option<PathBuf> {
    drypoint::scene::file::data_folders().into_iter().find(|folder| folder.join("engine.nhdr").is_file())
}
