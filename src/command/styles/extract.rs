//! The verb `styles extract`: a style from a part of a picture ([STF-2]).

use super::super::report::note;
use super::super::{Done, Outcome, Talk, output_path};
use crate::output::{OutputError, png};
use crate::reference::style_transfer_functions::extract::{Region, extract};
use crate::scene::memory;
use crate::scene::picture::Provenance;
use crate::scene::source::Disk;
use crate::scene::style::{MAX_SIDE, SourcePicture};
use crate::{Failure, Format};
use clap::builder::RangedU64ValueParser;
use clap::{ArgGroup, Args};
use std::path::{Path, PathBuf};

/// Make a style from a sphere, an ellipsoid or another closed shape in a picture.
///
/// Coordinates are in pixels, x from the left and y from the top; fractions are allowed.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("region").required(true))]
pub(super) struct ExtractArgs {
    /// Picture, PNG, JPEG or OpenEXR
    picture: PathBuf,
    /// Sphere: centre and radius
    #[arg(long, value_name = "X,Y,R", group = "region", allow_hyphen_values = true)]
    circle: Option<String>,
    /// Ellipsoid: centre, semi-axes, and the angle of the first semi-axis from the right, anticlockwise in degrees
    #[arg(long, value_name = "X,Y,A,B,ANGLE", group = "region", allow_hyphen_values = true)]
    ellipse: Option<String>,
    /// Closed shape: the points of its outline as "X,Y X,Y …", or a file with a point on each line
    #[arg(long, value_name = "POINTS|FILE", group = "region", allow_hyphen_values = true)]
    outline: Option<String>,
    /// Depth of the shape towards the viewer, in pixels [default: the radius of its largest inscribed circle]
    #[arg(long, value_name = "PX", conflicts_with = "circle", allow_negative_numbers = true)]
    depth: Option<f64>,
    /// Output file of the style (.png)
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Side of the style in texels
    #[arg(long, value_name = "S", default_value_t = 256, value_parser = RangedU64ValueParser::<usize>::new().range(1..=MAX_SIDE as u64))]
    size: usize,
    /// Read the picture as linear light instead of sRGB
    #[arg(long)]
    linear: bool,
}

impl ExtractArgs {
    pub(super) fn run(self, talk: Talk) -> Outcome {
        output_path::picture(&self.output, &[Format::Png])?;
        let outline = self.outline.as_deref().map(Path::new);
        output_path::check_not_read(&self.output, outline.into_iter().chain([&*self.picture]))?;
        let (option, region) = self.region()?;
        let source = self.source()?;
        let found = extract(&source, &region, self.size).map_err(|error| {
            let place = format!("{option} in {}", self.picture.display());
            Failure::new(&error, place, error.help())
        })?;
        png::write_png(&found.picture, 8, &Provenance::default(), &self.output)
            .map_err(|error| Failure::picture(&error, self.output.display()))?;
        note(talk, self.output.display());
        if found.shown < 1.0 {
            // Rounded down: never 100 % if a texel is missing.
            let shown = (found.shown * 100.0).floor();
            note(
                talk,
                format_args!(
                    "the picture shows {shown} % of the directions of a sphere; the others continue what it shows"
                ),
            );
        }
        Ok(Done::Yes)
    }

    fn source(&self) -> Result<SourcePicture, Failure> {
        let place = || self.picture.display();
        let bytes = memory::read(&Disk, &self.picture).map_err(|source| {
            Failure::picture(&OutputError::Io { path: self.picture.clone(), action: "read", source }, place())
        })?;
        SourcePicture::decode(&bytes, self.linear).map_err(|fault| Failure::new(&fault, place(), fault.help()))
    }

    /// Returns the region, and the option that gives it.
    fn region(&self) -> Result<(String, Region), Failure> {
        if let Some(text) = &self.circle {
            let option = format!("--circle {text}");
            let Some([x, y, r]) = numbers(text) else {
                let what = format!("{text:?} is no circle");
                return Err(Failure::new(what, option, "write x,y,r in pixels, such as 512,340,120"));
            };
            return Ok((option, Region::Circle { x, y, r }));
        }
        if let Some(text) = &self.ellipse {
            let option = format!("--ellipse {text}");
            let Some([x, y, a, b, angle]) = numbers(text) else {
                let what = format!("{text:?} is no ellipse");
                let remedy = "write x,y,a,b in pixels and an angle in degrees, such as 512,340,120,80,30";
                return Err(Failure::new(what, option, remedy));
            };
            return Ok((option, Region::Ellipse { x, y, a, b, angle, depth: self.depth }));
        }
        let text = self.outline.as_deref().unwrap_or_default();
        let points = match inline(text) {
            Some(points) => points,
            None => file(Path::new(text))?,
        };
        Ok((format!("--outline {text}"), Region::Outline { points, depth: self.depth }))
    }
}

/// Parses N numbers between commas.
fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    numbers?.try_into().ok()
}

/// Parses points between blanks. Returns none if the text is something else, such as a file name.
fn inline(text: &str) -> Option<Vec<[f64; 2]>> {
    text.contains(',').then(|| text.split_whitespace().map(numbers).collect()).flatten()
}

/// Reads one point from each line. Empty lines, lines that begin with # and a first line with names are skipped.
fn file(path: &Path) -> Result<Vec<[f64; 2]>, Failure> {
    let remedy = "write x,y on each line, in pixels, or all points as \"x,y x,y …\"";
    let text = memory::read_to_string(&Disk, path)
        .map_err(|error| Failure::new(format!("the outline cannot be read: {error}"), path.display(), remedy))?;
    let mut points = Vec::new();
    for (k, line) in text.lines().enumerate().map(|(k, line)| (k, line.trim())) {
        if line.is_empty() || line.starts_with('#') || (k == 0 && line.eq_ignore_ascii_case("x,y")) {
            continue;
        }
        let Some(point) = numbers(line) else {
            let place = format!("{}:{}", path.display(), k + 1);
            return Err(Failure::new(format!("{line:?} is no point"), place, remedy));
        };
        points.push(point);
    }
    Ok(points)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_so_many_and_no_more() {
        assert_eq!(numbers("1, -2.5,3e1"), Some([1.0, -2.5, 30.0]));
        for text in ["", "1,2", "1,2,3,4", "1,2,x", "1,,3"] {
            assert_eq!(numbers::<3>(text), None, "{text}");
        }
    }

    #[test]
    fn points_or_a_file() {
        assert_eq!(inline("1,2  3,4\n5,-6"), Some(vec![[1.0, 2.0], [3.0, 4.0], [5.0, -6.0]]));
        for text in ["shape.csv", "a,b.csv", "1,2 3", ""] {
            assert_eq!(inline(text), None, "{text}");
        }
    }
}
