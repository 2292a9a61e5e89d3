//! File formats of sweeps.

use super::{Sweep, csv, markdown, plot};
use crate::Failure;
use std::path::Path;

/// A file format of sweeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SweepFormat {
    /// The table for programs.
    Csv,
    /// The table for people.
    Markdown,
    /// The plot as vectors, in the viewer's font.
    Svg,
    /// The plot in pixels, in its own font.
    Png,
}

impl SweepFormat {
    /// Returns the format of a name by its suffix, in any case.
    ///
    /// # Errors
    /// Any other suffix.
    pub fn of(path: &Path) -> Result<Self, Failure> {
        let suffix = path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
        match suffix.as_str() {
            "csv" => Ok(Self::Csv),
            "md" => Ok(Self::Markdown),
            "svg" => Ok(Self::Svg),
            "png" => Ok(Self::Png),
            _ => {
                let what = match suffix.as_str() {
                    "" => "the name has no suffix, which chooses the form".into(),
                    _ => format!(".{suffix} is the suffix of no form that costs are written in"),
                };
                Err(Failure::new(what, path.display(), "give a name that ends in .csv, .md, .svg or .png"))
            }
        }
    }

    /// Returns the bytes of a file; `name` is the title of a plot.
    ///
    /// # Errors
    /// A plot without a point: no setting has an error.
    pub fn of_sweep(self, sweep: &Sweep, name: &str) -> Result<Vec<u8>, String> {
        match self {
            Self::Csv => Ok(csv(sweep).into_bytes()),
            Self::Markdown => Ok(markdown(sweep).into_bytes()),
            Self::Svg => plot::svg(sweep, name).map(String::into_bytes),
            Self::Png => plot::png(sweep, name),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_suffix_chooses() {
        let of = |name: &str| SweepFormat::of(Path::new(name));
        assert_eq!(
            [of("a.csv"), of("b.MD"), of("c.svg"), of("d.x.png")].map(Result::unwrap),
            [SweepFormat::Csv, SweepFormat::Markdown, SweepFormat::Svg, SweepFormat::Png]
        );
        for (name, what) in [
            ("a.pdf", ".pdf is the suffix of no form that costs are written in"),
            ("csv", "the name has no suffix, which chooses the form"),
        ] {
            assert_eq!(of(name).unwrap_err().what, what, "{name}");
        }
    }
}
