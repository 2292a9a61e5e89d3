//! File formats of pictures, points and lines, chosen by a name's suffix.

use crate::Failure;
use std::path::Path;

/// A file format of pictures, points and lines ([IO-2]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// The layer `beauty` alone, in 8 or 16 bits a channel.
    Png,
    /// Every layer, in 32-bit float ([IO-6]).
    Exr,
    /// All frames, each with its own palette and transparent or opaque pixels.
    Gif,
    /// All frames, each with the pixels of its PNG.
    Apng,
    /// Points and lines as vectors, a millimetre a unit, over the picture ([IO-7]).
    Svg,
    /// Points and lines as PDF, over the picture ([IO-7]).
    Pdf,
    /// Points alone, a row each ([STIP-16]).
    Csv,
    /// Points alone, a JSON object a line ([STIP-16]).
    JsonLines,
}

impl Format {
    /// Formats of rendered pictures.
    pub const PICTURES: [Self; 2] = [Self::Png, Self::Exr];
    /// Formats of all frames in one file, in pixels.
    pub const ANIMATIONS: [Self; 2] = [Self::Gif, Self::Apng];
    /// Formats of points or lines, over a picture or alone.
    pub const SHEETS: [Self; 4] = [Self::Png, Self::Exr, Self::Svg, Self::Pdf];
    /// Formats of a rendered scene.
    pub const RENDERED: [Self; 6] = [Self::Png, Self::Exr, Self::Svg, Self::Pdf, Self::Gif, Self::Apng];
    /// Formats of one page of points or lines.
    pub const PAGES: [Self; 6] = [Self::Svg, Self::Pdf, Self::Png, Self::Exr, Self::Csv, Self::JsonLines];
    /// All formats.
    pub const ALL: [Self; 8] =
        [Self::Svg, Self::Pdf, Self::Png, Self::Exr, Self::Gif, Self::Apng, Self::Csv, Self::JsonLines];

    /// Returns the suffix without its dot.
    pub fn suffix(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Exr => "exr",
            Self::Gif => "gif",
            Self::Apng => "apng",
            Self::Svg => "svg",
            Self::Pdf => "pdf",
            Self::Csv => "csv",
            Self::JsonLines => "jsonl",
        }
    }

    /// Whether it has points alone.
    pub fn is_list(self) -> bool {
        matches!(self, Self::Csv | Self::JsonLines)
    }

    /// Returns the format of a name by its suffix, in any case.
    pub fn of(path: &Path) -> Option<Self> {
        let suffix = path.extension()?;
        Self::ALL.into_iter().find(|format| suffix.eq_ignore_ascii_case(format.suffix()))
    }

    /// Returns the format of a name, if it is one of `may`.
    ///
    /// # Errors
    /// A suffix of another format, or of none.
    pub fn among(path: &Path, may: &[Self]) -> Result<Self, Failure> {
        let found = Self::of(path);
        if let Some(format) = found.filter(|format| may.contains(format)) {
            return Ok(format);
        }
        let suffix = path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
        let what = match found {
            Some(Self::Csv | Self::JsonLines) => {
                format!(".{suffix} is for lists of points, which `drypoint points` writes")
            }
            Some(Self::Gif | Self::Apng) => format!(".{suffix} is for the frames of [orbit], and this is one picture"),
            Some(_) if *may == [Self::Png] => "this picture is written as PNG".into(),
            Some(_) => format!("this picture is not written as .{suffix}"),
            None if suffix.is_empty() => "the name has no suffix, which chooses the format of the picture".into(),
            None => format!(".{suffix} is the suffix of no picture format that is written"),
        };
        let suffixes: Vec<String> = may.iter().map(|format| format!(".{}", format.suffix())).collect();
        let suffixes = match suffixes.as_slice() {
            [all @ .., last] if !all.is_empty() => format!("{} or {last}", all.join(", ")),
            _ => suffixes.concat(),
        };
        Err(Failure::new(what, path.display(), format!("give a name that ends in {suffixes}")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_suffix_chooses() {
        let of = |name: &str| Format::among(Path::new(name), &Format::PICTURES);
        assert_eq!(of("a/b.c.PNG"), Ok(Format::Png));
        assert_eq!(of("b.exr"), Ok(Format::Exr));
        for (name, what) in [
            ("a.pdf", "this picture is not written as .pdf"),
            ("a.gif", ".gif is for the frames of [orbit], and this is one picture"),
            ("a.csv", ".csv is for lists of points, which `drypoint points` writes"),
            ("a.jpg", ".jpg is the suffix of no picture format that is written"),
            ("png", "the name has no suffix, which chooses the format of the picture"),
            (".png", "the name has no suffix, which chooses the format of the picture"),
        ] {
            assert_eq!(of(name).unwrap_err().what, what, "{name}");
        }
        let remedy = |may| Format::among(Path::new("a"), may).unwrap_err().remedy;
        assert_eq!(remedy(&[Format::Png]), "give a name that ends in .png");
        assert_eq!(remedy(&Format::SHEETS), "give a name that ends in .png, .exr, .svg or .pdf");
    }
}
