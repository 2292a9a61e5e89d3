//! Animations of pictures as GIF and APNG. Frames are written one by one and not kept. The animation repeats for ever.

pub mod apng;
pub mod gif;
mod palette;

#[cfg(test)]
mod tests;

use crate::OutputError;
use crate::layers::fault;
use drypoint_scene::picture::{LayerKind, Picture};
use std::io;
use std::path::Path;

/// Checks that a frame has the size of the animation.
///
/// # Errors
/// [`OutputError::Layer`].
fn check_size(picture: &Picture, size: [usize; 2]) -> Result<(), OutputError> {
    let [width, height] = size;
    if [picture.width, picture.height] == size {
        return Ok(());
    }
    let text = format!("a frame of {}x{} pixels in an animation of {width}x{height}", picture.width, picture.height);
    Err(fault(LayerKind::Beauty, text))
}

/// Returns the error of a file that cannot be written.
fn refused(path: &Path, source: io::Error) -> OutputError {
    OutputError::Io { path: path.into(), action: "written", source }
}
