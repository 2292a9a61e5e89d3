//! Which file format the suffix of a picture's name asks for.

use crate::Failure;
use std::path::Path;

/// A format that rendered pictures are written in ([IO-2]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// The layer `beauty` alone, in 8 or 16 bits a channel.
    Png,
    /// Every layer, in 32-bit float ([IO-6]).
    Exr,
}

impl Format {
    /// The format of a name, by its suffix; case does not count.
    ///
    /// # Errors
    /// A suffix of no format, or of one for points and strokes.
    pub fn of(path: &Path) -> Result<Self, Failure> {
        let suffix = path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
        let refused = |what: String| Err(Failure::new(what, path.display(), "give a name that ends in .png or .exr"));
        match suffix.as_str() {
            "png" => Ok(Self::Png),
            "exr" => Ok(Self::Exr),
            "svg" | "pdf" => {
                refused(format!(".{suffix} is for points and lines, which `drypoint points` writes ([IO-7])"))
            }
            "" => refused("the name has no suffix, which chooses the format of the picture".into()),
            _ => refused(format!(".{suffix} is the suffix of no picture format that is written")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_suffix_chooses() {
        let of = |name: &str| Format::of(Path::new(name));
        assert_eq!(of("a/b.c.PNG"), Ok(Format::Png));
        assert_eq!(of("b.exr"), Ok(Format::Exr));
        for (name, what) in [
            ("a.pdf", ".pdf is for points and lines, which `drypoint points` writes ([IO-7])"),
            ("a.jpg", ".jpg is the suffix of no picture format that is written"),
            ("png", "the name has no suffix, which chooses the format of the picture"),
            (".png", "the name has no suffix, which chooses the format of the picture"),
        ] {
            assert_eq!(of(name).unwrap_err().what, what, "{name}");
        }
    }
}
