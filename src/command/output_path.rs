//! Output paths, checked before any work.

use super::frames::FrameFiles;
use crate::output::atomic;
use crate::scene::tables::Scene;
use crate::scene::volume::read;
use crate::scene::volume::write::WriteError;
use crate::{Failure, Format};
use std::path::{Path, PathBuf};

/// Returns the name of an input without folder and suffix: `head` of `ct/head.nii.gz`, `my.scene` of `my.scene.toml`.
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

/// Returns the format of one picture's file, which can be written now.
///
/// # Errors
/// A wrong suffix, a pattern for several frames, a folder, or a missing or read-only folder.
pub(super) fn picture(path: &Path, formats: &[Format]) -> Result<Format, Failure> {
    if path.file_name().unwrap_or_default().to_string_lossy().contains('#') {
        let what = "a # stands for the number of a frame, and this picture has one";
        return Err(Failure::new(what, path.display(), "give a name without #"));
    }
    format(path, formats)
}

/// Returns the format of a file, or of files of frames, in a folder that can be written to now.
pub(super) fn format(path: &Path, formats: &[Format]) -> Result<Format, Failure> {
    if path.is_dir() {
        // A folder's suffix does not matter.
        writable(path)?;
    }
    let format = Format::among(path, formats)?;
    writable(path)?;
    Ok(format)
}

/// Checks whether a picture's file can be written now.
pub(super) fn writable(path: &Path) -> Result<(), Failure> {
    atomic::check(path).map_err(|error| Failure::picture(&error, path.display()))
}

/// Checks that a name ends in `.nrrd` and can be written now. `what` is what is written, in words.
pub(super) fn volume(path: &Path, what: &str) -> Result<(), Failure> {
    if !path.is_dir() && !path.extension().is_some_and(|suffix| suffix.eq_ignore_ascii_case("nrrd")) {
        let what = format!("{what} is written as NRRD");
        return Err(Failure::new(what, path.display(), "give a name that ends in .nrrd"));
    }
    crate::scene::atomic::check(path).map_err(|source| Failure::from(WriteError { file: path.to_path_buf(), source }))
}

/// Writes a file that is no picture of a scene, whole or not at all.
pub(super) fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    atomic::write(path, bytes).map_err(|error| Failure::picture(&error, path.display()))
}

/// Checks that an output file is none of the inputs. An input folder is a theme, of which no picture may be
/// overwritten. Symbolic links and other spellings of a path are the same file.
///
/// # Errors
/// The output file is an input.
pub(super) fn check_not_read<'a>(output: &Path, inputs: impl IntoIterator<Item = &'a Path>) -> Result<(), Failure> {
    // A file that does not exist yet is nobody's input.
    let Ok(written) = output.canonicalize() else { return Ok(()) };
    let is_picture = Format::of(&written).is_some_and(|format| Format::PICTURES.contains(&format));
    for read in inputs.into_iter().filter_map(|input| input.canonicalize().ok()) {
        if read == written || is_picture && written.parent() == Some(&read) {
            let what = "this file is read too, and would be overwritten";
            return Err(Failure::new(what, output.display(), "give another name"));
        }
    }
    Ok(())
}

/// The output of a rendered picture or its frames.
pub(super) struct RenderOutput {
    /// The file, or the pattern of the frames' names.
    path: PathBuf,
    /// Whether `-o` gives the path.
    said: bool,
    /// File format.
    pub format: Format,
}

impl RenderOutput {
    /// Returns the output of `-o`, or else the input's name in the working directory, `drypoint` for the embedded
    /// scene. The default suffix is `.png`, or `.exr` if layers are requested, which only an EXR has.
    ///
    /// # Errors
    /// Same errors as [`picture`], and layers for a format other than EXR.
    pub(super) fn new(output: Option<&Path>, input: Option<&Path>, layers: bool) -> Result<Self, Failure> {
        let suffix = if layers { "exr" } else { "png" };
        let default = || format!("{}.{suffix}", input.map_or("drypoint".into(), stem)).into();
        let path = output.map_or_else(default, Path::to_path_buf);
        let format = format(&path, &Format::RENDERED)?;
        if layers && format != Format::Exr {
            let remedy = "give a name that ends in .exr, or leave --layers out";
            let what = format!("a {} has no layers, and --layers asks for some", format.suffix().to_uppercase());
            return Err(Failure::new(what, path.display(), remedy));
        }
        Ok(Self { path, said: output.is_some(), format })
    }

    /// Returns the files of a scene's frames. A default name gets the numbers of frames.
    ///
    /// # Errors
    /// Same errors as [`FrameFiles::of`], and a vector file of a scene without points.
    pub(super) fn files(&self, scene: &Scene) -> Result<FrameFiles, Failure> {
        if matches!(self.format, Format::Svg | Format::Pdf) && !scene.draws_on_page() {
            let suffix = self.format.suffix();
            let what = format!(".{suffix} is for points, lines and annotations, and the scene has none");
            return Err(Failure::new(what, self.path.display(), "give a name that ends in .png or .exr"));
        }
        match scene.orbit {
            Some(orbit) if !self.said => {
                let digits = orbit.frames.to_string().len().max(3);
                let name = format!("{}_{}.{}", stem(&self.path), "#".repeat(digits), self.format.suffix());
                FrameFiles::of(Path::new(&name), scene)
            }
            _ => FrameFiles::of(&self.path, scene),
        }
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
