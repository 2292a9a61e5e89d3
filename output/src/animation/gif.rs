//! Writing of animated GIF. Each frame has its own palette, without dithering.

use super::palette::Palette;
use super::{check_size, refused};
use crate::OutputError;
use crate::encode::{quantize, straight_srgb};
use crate::layers::{fault, fitting};
use drypoint_scene::picture::{LayerKind, Picture, Provenance};
use gif::{AnyExtension, DisposalMethod, Encoder, EncodingError, Frame, Repeat};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Most colours of a frame. One of the 256 places of a palette is left for transparent pixels.
const COLORS: usize = 255;

/// The label of a comment extension.
const COMMENT: AnyExtension = AnyExtension(0xfe);

/// An animated GIF in straight sRGB. A frame keeps up to 255 colours. If it has more, pixels get the nearest of 255
/// mean colours. A pixel is transparent where α is below ½, else opaque.
pub struct GifAnimation<W: Write> {
    encoder: Encoder<W>,
    size: [usize; 2],
    fps: u64,
    written: u64,
    path: PathBuf,
}

impl<W: Write> GifAnimation<W> {
    /// Begins an animation of `fps` frames a second. The file's comment names the program and the scene's hash. `path`
    /// is the file's name for errors.
    ///
    /// # Errors
    /// [`OutputError::Layer`] for a side of 0 or more than 65535 pixels, [`OutputError::Io`].
    pub fn new(
        out: W,
        size: [usize; 2],
        fps: usize,
        provenance: &Provenance,
        path: &Path,
    ) -> Result<Self, OutputError> {
        let [width, height] = sides(size)?;
        let wrong = |error| refusal(error, path);
        let mut encoder = Encoder::new(out, width, height, &[]).map_err(wrong)?;
        encoder.set_repeat(Repeat::Infinite).map_err(wrong)?;
        // A comment is ASCII, which the plan is not.
        let comment = format!("{}, scene {}", provenance.software, provenance.scene_hash);
        encoder.write_raw_extension(COMMENT, &[comment.as_bytes()]).map_err(wrong)?;
        Ok(Self { encoder, size, fps: fps as u64, written: 0, path: path.into() })
    }

    /// Writes the next frame.
    ///
    /// # Errors
    /// [`OutputError::Layer`] for a picture of another size or without beauty, [`OutputError::Io`].
    pub fn frame(&mut self, picture: &Picture) -> Result<(), OutputError> {
        check_size(picture, self.size)?;
        let [width, height] = sides(self.size)?;
        // Opaque pixels have a colour, transparent ones none.
        let channels = &fitting(picture, LayerKind::Beauty)?.channels;
        let pixels: Vec<Option<[u8; 3]>> = (0..channels[0].len())
            .map(|i| {
                let [r, g, b, a] = straight_srgb([channels[0][i], channels[1][i], channels[2][i], channels[3][i]]);
                (a >= 0.5).then(|| [r, g, b].map(|c| quantize(c, 255) as u8))
            })
            .collect();
        let palette = Palette::new(pixels.iter().flatten().copied(), COLORS);
        let transparent = palette.colors.len() as u8;
        let is_clear = pixels.contains(&None);
        let buffer: Vec<u8> =
            pixels.iter().map(|pixel| pixel.map_or(transparent, |color| palette.index(color))).collect();
        let mut colors = palette.colors.concat();
        if is_clear {
            colors.extend([0; 3]);
        }
        let frame = Frame {
            delay: self.delay(),
            // A frame does not show through the holes of the next.
            dispose: DisposalMethod::Background,
            transparent: is_clear.then_some(transparent),
            width,
            height,
            palette: Some(colors),
            buffer: buffer.into(),
            ..Frame::default()
        };
        self.written += 1;
        self.encoder.write_frame(&frame).map_err(|error| refusal(error, &self.path))
    }

    /// Ends the file.
    ///
    /// # Errors
    /// [`OutputError::Io`].
    pub fn finish(self) -> Result<(), OutputError> {
        let Self { encoder, path, .. } = self;
        encoder.into_inner().map(drop).map_err(|error| refusal(error, &path))
    }

    /// Returns the time of the next frame in hundredths of a second. Times are rounded from the start on, so that n
    /// frames take 100·n/fps, rounded once.
    fn delay(&self) -> u16 {
        let [from, to] = [self.written, self.written + 1].map(|n| (200 * n + self.fps) / (2 * self.fps));
        u16::try_from(to - from).unwrap_or(u16::MAX)
    }
}

/// Returns width and height as u16, the type of a GIF's sides.
fn sides(size: [usize; 2]) -> Result<[u16; 2], OutputError> {
    let side = |n: usize| u16::try_from(n).ok().filter(|&n| n > 0);
    match size.map(side) {
        [Some(width), Some(height)] => Ok([width, height]),
        _ => {
            let [width, height] = size;
            Err(fault(LayerKind::Beauty, format!("{width}x{height} pixels; a side of a GIF has 1 to 65535")))
        }
    }
}

/// Converts an error of the encoder.
fn refusal(error: EncodingError, path: &Path) -> OutputError {
    match error {
        EncodingError::Io(source) => refused(path, source),
        other => fault(LayerKind::Beauty, other.to_string()),
    }
}
