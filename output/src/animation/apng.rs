//! Writing of animated PNG. Programs without animation show the first frame.

use super::{check_size, refused};
use crate::OutputError;
use crate::layers::{fault, side};
use crate::png::{info, rgba_codes};
use drypoint_scene::picture::{LayerKind, Picture, Provenance};
use std::io::Write;
use std::path::{Path, PathBuf};

/// An animated PNG. Each frame has the pixels that [`encode_png`](crate::png::encode_png) gives its picture, with 8 or
/// 16 bits a channel.
pub struct ApngAnimation<W: Write> {
    writer: png::Writer<W>,
    size: [usize; 2],
    bits: u8,
    path: PathBuf,
}

impl<W: Write> ApngAnimation<W> {
    /// Begins an animation of `frames` frames, `fps` a second. `path` is the file's name for errors.
    ///
    /// # Errors
    /// [`OutputError::Bits`], [`OutputError::Layer`] for a size that PNG does not have or no frame, [`OutputError::Io`].
    pub fn new(
        out: W,
        [width, height]: [usize; 2],
        bits: u8,
        [frames, fps]: [usize; 2],
        provenance: &Provenance,
        path: &Path,
    ) -> Result<Self, OutputError> {
        let frames = side(frames, LayerKind::Beauty)?;
        let fps = u16::try_from(fps).map_err(|_| fault(LayerKind::Beauty, format!("{fps} frames a second")))?;
        let wrong = |error| refusal(error, path);
        let mut encoder = png::Encoder::with_info(out, info([width, height], bits, provenance)?).map_err(wrong)?;
        encoder.set_animated(frames, 0).map_err(wrong)?;
        encoder.set_frame_delay(1, fps).map_err(wrong)?;
        encoder.validate_sequence(true);
        let writer = encoder.write_header().map_err(wrong)?;
        Ok(Self { writer, size: [width, height], bits, path: path.into() })
    }

    /// Writes the next frame.
    ///
    /// # Errors
    /// [`OutputError::Layer`] for a picture of another size or without beauty, [`OutputError::Io`].
    pub fn frame(&mut self, picture: &Picture) -> Result<(), OutputError> {
        check_size(picture, self.size)?;
        let data = rgba_codes(picture, self.bits)?;
        self.writer.write_image_data(&data).map_err(|error| refusal(error, &self.path))
    }

    /// Ends the file.
    ///
    /// # Errors
    /// [`OutputError::Layer`] for fewer frames than were announced, [`OutputError::Io`].
    pub fn finish(self) -> Result<(), OutputError> {
        let Self { writer, path, .. } = self;
        writer.finish().map_err(|error| refusal(error, &path))
    }
}

/// Converts an error of the encoder.
fn refusal(error: png::EncodingError, path: &Path) -> OutputError {
    match error {
        png::EncodingError::IoError(source) => refused(path, source),
        other => fault(LayerKind::Beauty, other.to_string()),
    }
}
