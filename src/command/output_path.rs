//! Where a picture or a volume goes, settled before any work is done.

use super::frames::FrameFiles;
use drypoint::output::atomic;
use drypoint::scene::tables::Scene;
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
    if path.file_name().unwrap_or_default().to_string_lossy().contains('#') {
        let what = "a # stands for the number of a frame, and this picture has one";
        return Err(Failure::new(what, path.display(), "give a name without #"));
    }
    format(path, formats)
}

/// The format of a file, or of files of frames, in a folder that can be written to now.
pub(super) fn format(path: &Path, formats: &[Format]) -> Result<Format, Failure> {
    if path.is_dir() {
        // Its suffix does not matter.
        writable(path)?;
    }
    let format = Format::among(path, formats)?;
    writable(path)?;
    Ok(format)
}

/// Whether a picture's file can be written now.
pub(super) fn writable(path: &Path) -> Result<(), Failure> {
    atomic::check(path).map_err(|error| Failure::picture(&error, path.display()))
}

/// Whether a file that is to be written is none of those that are read. Of a folder, which is a theme, no picture may be
/// written over. Symbolic links and other spellings of one path are the same file.
///
/// # Errors
/// It is one of them.
pub(super) fn check_not_read<'a>(output: &Path, inputs: impl IntoIterator<Item = &'a Path>) -> Result<(), Failure> {
    // What is not there yet is nobody's input.
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

/// Where a rendered picture goes, and frames of it.
pub(super) struct RenderOutput {
    /// The file, or what the names of frames are made of.
    path: PathBuf,
    /// Whether `-o` says it.
    said: bool,
    /// How it is written.
    pub format: Format,
}

impl RenderOutput {
    /// What `-o` says; without it, the input's name in the working directory, `drypoint` for the embedded scene. Its
    /// suffix is `.png`, or `.exr` where layers are asked for, which only an EXR has.
    ///
    /// # Errors
    /// As [`picture`], and layers for another format.
    pub(super) fn new(output: Option<&Path>, input: Option<&Path>, layers: bool) -> Result<Self, Failure> {
        let suffix = if layers { "exr" } else { "png" };
        let default = || format!("{}.{suffix}", input.map_or("drypoint".into(), stem)).into();
        let path = output.map_or_else(default, Path::to_path_buf);
        let format = format(&path, &Format::SHEETS)?;
        if layers && format != Format::Exr {
            let remedy = "give a name that ends in .exr, or leave --layers out";
            let what = format!("a {} has no layers, and --layers asks for some", format.suffix().to_uppercase());
            return Err(Failure::new(what, path.display(), remedy));
        }
        Ok(Self { path, said: output.is_some(), format })
    }

    /// The files of a scene's frames. A name that nobody said gets the numbers of frames.
    ///
    /// # Errors
    /// As [`FrameFiles::of`], and a vector file of a scene without points.
    pub(super) fn files(&self, scene: &Scene) -> Result<FrameFiles, Failure> {
        if !Format::PICTURES.contains(&self.format) && !scene.has_marks() {
            let suffix = self.format.suffix();
            let what = format!(".{suffix} is for points and lines, and the scene has none");
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
