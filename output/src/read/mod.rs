//! Pictures read from files of Drypoint and of other renderers ([GPU-5]).

mod background;
mod exr;
mod intersection_picture;
mod png;

use crate::OutputError;
use crate::layers::room;
use drypoint_scene::memory;
use drypoint_scene::picture::Picture;
use drypoint_scene::source::{Disk, Source};
use std::path::Path;

pub use background::{read_background, stretch};
pub use intersection_picture::read_intersection_picture;

/// A picture of any origin, as named channels of numbers, row by row from the top.
///
/// Colours (`R`, `G`, `B`) are linear and premultiplied by `A`. Other channels are unchanged.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Image {
    /// Pixels from left to right.
    pub width: usize,
    /// Pixels from top to bottom.
    pub height: usize,
    /// Name and `width · height` numbers of each channel. Names are unique.
    pub channels: Vec<(String, Vec<f64>)>,
}

/// The colours of an [`Image`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColorChannels<'a> {
    /// Red, green and blue, linear and premultiplied.
    pub rgb: [&'a [f64]; 3],
    /// α; an image without it is opaque.
    pub alpha: Option<&'a [f64]>,
}

impl Image {
    /// Returns the channel of a name.
    pub fn channel(&self, name: &str) -> Option<&[f64]> {
        self.channels.iter().find(|(n, _)| n == name).map(|(_, values)| values.as_slice())
    }

    /// Returns red, green, blue and, if present, α; none if a colour is missing.
    pub fn colors(&self) -> Option<ColorChannels<'_>> {
        let rgb = [self.channel("R")?, self.channel("G")?, self.channel("B")?];
        Some(ColorChannels { rgb, alpha: self.channel("A") })
    }

    /// Returns the names of the channels, in order.
    pub fn names(&self) -> Vec<String> {
        self.channels.iter().map(|(name, _)| name.clone()).collect()
    }
}

impl From<&Picture> for Image {
    /// Converts every layer. If several channels have the same name, only the first one is kept.
    fn from(picture: &Picture) -> Self {
        let mut image = Self { width: picture.width, height: picture.height, channels: Vec::new() };
        for layer in &picture.layers {
            for (name, values) in layer.kind.channels().iter().zip(&layer.channels) {
                if image.channel(name).is_none() {
                    image.channels.push((name.to_string(), values.clone()));
                }
            }
        }
        image
    }
}

/// Reads a PNG (at most 16 bits, any colour type) or an EXR (flat, any channels, one part or several). The first bytes
/// decide the format, not the file's name.
///
/// A PNG becomes `R G B A`: sRGB decoded to linear light, then multiplied by α ([VAL-3]). Chunks gAMA, cHRM and ICC are
/// ignored.
///
/// Values of an EXR are unchanged. The picture is the display window, and is 0 where the file has no data. Channels of
/// the second and further parts get the part's name as prefix.
///
/// # Errors
/// [`OutputError::Io`], [`OutputError::UnknownFormat`], [`OutputError::Malformed`], [`OutputError::TooLarge`],
/// [`OutputError::NoRoom`]. The last two are found before anything is allocated.
pub fn read_image(path: &Path) -> Result<Image, OutputError> {
    decode(&bytes(&Disk, path)?, path)
}

/// Returns the bytes of a file of a source.
fn bytes(source: &dyn Source, path: &Path) -> Result<Vec<u8>, OutputError> {
    memory::read(source, path).map_err(|source| OutputError::Io { path: path.into(), action: "read", source })
}

/// Decodes bytes as [`read_image`] does. The path is only for messages.
///
/// # Errors
/// Same errors as [`read_image`].
pub fn decode(bytes: &[u8], path: &Path) -> Result<Image, OutputError> {
    decode_within(bytes, path, &ImageLimits { side: usize::MAX, each: 0 })
}

/// The limits of a picture that is decoded for a use.
struct ImageLimits {
    /// Most pixels along a side.
    side: usize,
    /// Bytes of memory a pixel that the use needs beside the decoded channels.
    each: usize,
}

impl ImageLimits {
    /// Checks the size that a header says, before anything is allocated. A pixel takes `decoding` bytes while it is
    /// decoded, and `decoded` bytes after that.
    fn check(&self, path: &Path, size: [usize; 2], decoding: usize, decoded: usize) -> Result<(), OutputError> {
        if size.iter().any(|&side| side > self.side) {
            return Err(OutputError::Side { path: path.into(), size, most: self.side });
        }
        room(Some(path), size, decoding.max(decoded.saturating_add(self.each)))
    }
}

/// Decodes bytes like [`decode`], within the limits of a use.
fn decode_within(bytes: &[u8], path: &Path, limits: &ImageLimits) -> Result<Image, OutputError> {
    if bytes.starts_with(&PNG) {
        png::decode(bytes, path, limits)
    } else if bytes.starts_with(&[0x76, 0x2f, 0x31, 0x01]) {
        exr::decode(bytes, path, limits)
    } else {
        Err(OutputError::UnknownFormat { path: path.into(), found: bytes[..bytes.len().min(8)].to_vec() })
    }
}

/// Whether a file contains opacity; `image` is the decoded file.
fn has_alpha(bytes: &[u8], image: &Image) -> bool {
    if bytes.starts_with(&PNG) { png::has_alpha(bytes) } else { image.channel("A").is_some() }
}

/// The first bytes of a PNG.
const PNG: [u8; 4] = [0x89, b'P', b'N', b'G'];

/// Refuses pixels that no file of that length can hold. `ratio` is the largest expansion of a byte of the file.
fn check_claim(claimed: Option<u64>, ratio: u64, bytes: &[u8], path: &Path) -> Result<(), OutputError> {
    let length = bytes.len() as u64;
    match claimed {
        Some(claimed) if claimed <= length.saturating_mul(ratio) => Ok(()),
        _ => Err(OutputError::TooLarge { path: path.into(), claimed: claimed.unwrap_or(u64::MAX), length }),
    }
}

/// Largest expansion of a byte of DEFLATE.
const DEFLATE: u64 = 1032;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exr::encode_exr;
    use crate::png::encode_png;
    use drypoint_scene::picture::{Layer, LayerKind, Provenance};
    use proptest::prelude::*;

    fn picture() -> Picture {
        let wave = |k: usize| (0..35).map(|i| ((i * (k + 3)) % 11) as f64 / 11.0).collect();
        let layer = |kind: LayerKind| Layer { kind, channels: (0..kind.channels().len()).map(wave).collect() };
        Picture { width: 7, height: 5, layers: vec![layer(LayerKind::Beauty), layer(LayerKind::Z)] }
    }

    fn files() -> [Vec<u8>; 3] {
        let provenance = Provenance { software: "Drypoint".into(), ..Default::default() };
        let png = |bits| encode_png(&picture(), bits, &provenance).unwrap();
        [png(8), png(16), encode_exr(&picture(), &provenance).unwrap()]
    }

    #[test]
    fn any_cut_is_an_error() {
        // A PNG is complete once its pixels are: the end marker alone, 12 bytes, may be missing.
        for (file, end) in files().into_iter().zip([12, 12, 0]) {
            assert!(decode(&file, Path::new("a")).is_ok());
            for length in 0..file.len() - end {
                let error = decode(&file[..length], Path::new("some.png")).unwrap_err();
                assert!(error.to_string().contains("some.png"), "{length}: {error}");
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        /// A damaged file is an error or a picture that fits its own size, never a panic.
        #[test]
        fn mutations_never_panic(which in 0usize..3, changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6), cut in any::<prop::sample::Index>(), cuts in any::<bool>()) {
            let mut file = files()[which].clone();
            for (at, byte) in changes {
                let at = at.index(file.len());
                file[at] = byte;
            }
            if cuts {
                file.truncate(cut.index(file.len()));
            }
            if let Ok(image) = decode(&file, Path::new("a")) {
                prop_assert!(image.channels.iter().all(|(_, v)| v.len() == image.width * image.height));
            }
        }

        #[test]
        fn noise_never_panics(magic in prop::sample::select(vec![vec![0x89, b'P', b'N', b'G', 13, 10, 26, 10], vec![0x76, 0x2f, 0x31, 1, 2, 0, 0, 0]]), noise in prop::collection::vec(any::<u8>(), 0..300)) {
            let _ = decode(&[magic, noise].concat(), Path::new("a"));
        }
    }

    #[test]
    fn what_is_no_picture_is_named() {
        let error = decode(b"NRRD0004\nx", Path::new("head.nrrd")).unwrap_err();
        assert_eq!(
            error.to_string(),
            "head.nrrd: neither a PNG nor an EXR file: it begins with the bytes [4e, 52, 52, 44, 30, 30, 30, 34]"
        );
        let error = read_image(Path::new("absent.png")).unwrap_err();
        assert!(error.to_string().starts_with("absent.png: cannot be read"), "{error}");
    }

    #[test]
    fn a_picture_becomes_an_image() {
        let image = Image::from(&picture());
        assert_eq!(image.names(), ["R", "G", "B", "A", "Z"]);
        assert_eq!(image.channel("Z").unwrap(), picture().layers[1].channels[0]);
        assert!(image.colors().unwrap().alpha.is_some());
    }
}
