//! Where a picture or a volume goes, settled before any work is done.

use drypoint::output::atomic;
use drypoint::scene::volume::read;
use drypoint::{Failure, Format};
use std::path::{Path, PathBuf};

/// The name of an input without its folder and suffix: `head` of `ct/head.nii.gz`, `my.scene` of `my.scene.toml`.
pub(super) fn stem(input: &Path) -> String {
    let name = input.file_name().unwrap_or_default().to_string_lossy();
    let lower = name.to_ascii_lowercase();
    let volume =
        read::EXTENSIONS.iter().filter(|suffix| lower.ends_with(&format!(".{suffix}"))).max_by_key(|s| s.len());
    let cut = match volume {
        Some(suffix) => name.len() - suffix.len() - 1,
        None => name.rfind('.').unwrap_or(name.len()),
    };
    let stem = &name[..cut];
    if stem.is_empty() { "drypoint".into() } else { stem.into() }
}

/// A picture's file of one format, which can be written now.
///
/// # Errors
/// A wrong suffix, a pattern for several frames, a folder, or a folder that is not there or may not be written to.
pub(super) fn picture(path: &Path, formats: &[Format]) -> Result<Format, Failure> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    if name.contains('#') {
        return Err(Failure::new(
            "a # stands for the number of a frame, and [orbit] is not built yet ([STIP-4])",
            path.display(),
            "give a name without #",
        ));
    }
    if path.is_dir() {
        // Its suffix does not matter.
        writable(path)?;
    }
    let format = Format::of(path).map_err(|failure| match formats {
        [Format::Png] => Failure { remedy: "give a name that ends in .png".into(), ..failure },
        _ => failure,
    })?;
    if !formats.contains(&format) {
        return Err(Failure::new("this picture is written as PNG", path.display(), "give a name that ends in .png"));
    }
    writable(path)?;
    Ok(format)
}

/// Whether a picture's file can be written now.
fn writable(path: &Path) -> Result<(), Failure> {
    atomic::check(path).map_err(|error| Failure::picture(&error, path.display()))
}

/// Where a rendered picture goes.
pub(super) struct Target {
    /// The file.
    pub path: PathBuf,
    /// How it is written.
    pub format: Format,
}

impl Target {
    /// What `-o` says; without it, the input's name in the working directory, `drypoint` for the embedded scene. Its
    /// suffix is `.png`, or `.exr` where layers are asked for, which only an EXR has.
    ///
    /// # Errors
    /// As [`picture`], and layers for a PNG.
    pub(super) fn new(output: Option<&Path>, input: Option<&Path>, layers: bool) -> Result<Self, Failure> {
        let suffix = if layers { "exr" } else { "png" };
        let default = || format!("{}.{suffix}", input.map_or("drypoint".into(), stem)).into();
        let path = output.map_or_else(default, Path::to_path_buf);
        let format = picture(&path, &[Format::Png, Format::Exr])?;
        if layers && format == Format::Png {
            let remedy = "give a name that ends in .exr, or leave --layers out";
            return Err(Failure::new("a PNG has no layers, and --layers asks for some", path.display(), remedy));
        }
        Ok(Self { path, format })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stems() {
        for (input, name) in [
            ("ct/head.nii.gz", "head"),
            ("head.v2.NRRD", "head.v2"),
            ("my.scene.toml", "my.scene"),
            ("a.raw.gz", "a"),
            ("plain", "plain"),
            (".toml", "drypoint"),
            ("..", "drypoint"),
        ] {
            assert_eq!(stem(Path::new(input)), name, "{input}");
        }
    }
}
