//! Pictures from files: our own and other renderers' ([GPU-5]).

mod background;
mod exr;
mod png;

use crate::OutputError;
use drypoint_scene::memory;
use drypoint_scene::picture::Picture;
use std::path::Path;

pub use background::{read_background, stretch};

/// A picture of any origin as named channels of numbers, row by row from the top.
///
/// Colours (`R`, `G`, `B`) are linear and premultiplied by `A`; all else is as the file has it.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Image {
    /// Pixels from left to right.
    pub width: usize,
    /// Pixels from top to bottom.
    pub height: usize,
    /// Name and `width · height` numbers of each channel; no name occurs twice.
    pub channels: Vec<(String, Vec<f64>)>,
}

/// The colours of an [`Image`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Colors<'a> {
    /// Red, green and blue, linear and premultiplied.
    pub rgb: [&'a [f64]; 3],
    /// α; an image without it is opaque.
    pub alpha: Option<&'a [f64]>,
}

impl Image {
    /// The channel of that name.
    pub fn channel(&self, name: &str) -> Option<&[f64]> {
        self.channels.iter().find(|(n, _)| n == name).map(|(_, values)| values.as_slice())
    }

    /// Red, green, blue and, where the picture has it, α; nothing if a colour is missing.
    pub fn colors(&self) -> Option<Colors<'_>> {
        let rgb = [self.channel("R")?, self.channel("G")?, self.channel("B")?];
        Some(Colors { rgb, alpha: self.channel("A") })
    }

    /// The names of the channels, in their order.
    pub fn names(&self) -> Vec<String> {
        self.channels.iter().map(|(name, _)| name.clone()).collect()
    }
}

impl From<&Picture> for Image {
    /// Every layer; of channels of the same name the first one.
    fn from(picture: &Picture) -> Self {
        let mut image = Self { width: picture.width, height: picture.height, channels: Vec::new() };
        for layer in &picture.layers {
            for (name, values) in layer.kind.channels().iter().zip(&layer.channels) {
                if image.channel(name).is_none() {
                    image.channels.push(((*name).into(), values.clone()));
                }
            }
        }
        image
    }
}

/// Reads a PNG (8 or 16 bits or fewer, any colour type) or an EXR (flat, any channels, one part or several). The
/// file's first bytes decide which it is, not its name.
///
/// A PNG becomes `R G B A`: sRGB decoded to linear light, then multiplied by α ([VAL-3]); gAMA, cHRM and ICC chunks are
/// ignored. An EXR is taken as it is: its display window is the picture, 0 where the file has no data; channels of the
/// second and further parts bear the part's name in front.
///
/// # Errors
/// [`OutputError::Io`], [`OutputError::UnknownFormat`], [`OutputError::Malformed`]; and before anything is allocated,
/// [`OutputError::TooLarge`] for a header that lies and [`OutputError::Memory`] for more pixels than memory has room for.
pub fn read_image(path: &Path) -> Result<Image, OutputError> {
    let bytes = std::fs::read(path).map_err(|source| OutputError::Io { path: path.into(), action: "read", source })?;
    decode(&bytes, path)
}

/// [`read_image`] from bytes that are already here; the path is only for messages.
///
/// # Errors
/// As [`read_image`].
pub fn decode(bytes: &[u8], path: &Path) -> Result<Image, OutputError> {
    if bytes.starts_with(&[0x89, b'P', b'N', b'G']) {
        png::decode(bytes, path)
    } else if bytes.starts_with(&[0x76, 0x2f, 0x31, 0x01]) {
        exr::decode(bytes, path)
    } else {
        Err(OutputError::UnknownFormat { path: path.into(), found: bytes[..bytes.len().min(8)].to_vec() })
    }
}

/// Refuses pixels that no file of that length can hold. `ratio` is the most bytes that one byte of file can expand to.
fn check_claim(claimed: Option<u64>, ratio: u64, bytes: &[u8], path: &Path) -> Result<(), OutputError> {
    let length = bytes.len() as u64;
    match claimed {
        Some(claimed) if claimed <= length.saturating_mul(ratio) => Ok(()),
        _ => Err(OutputError::TooLarge { path: path.into(), claimed: claimed.unwrap_or(u64::MAX), length }),
    }
}

/// Refuses pixels that take more bytes than there is memory for.
fn check_room(needed: Option<u64>, path: &Path) -> Result<(), OutputError> {
    memory::room(needed.unwrap_or(u64::MAX)).map_err(|no_room| OutputError::Memory { path: path.into(), no_room })
}

/// One byte of DEFLATE gives at most 1032.
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
