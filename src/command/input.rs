//! What a verb is given: a scene, a bare volume, or nothing, which is the embedded scene.

use super::Failures;
use drypoint::job::{Job, bare};
use drypoint::scene::file::{self, Overrides};
use drypoint::scene::tables::{Scene, VolumeSource};
use drypoint::scene::volume::read;
use drypoint::{Failure, job};
use std::path::{Path, PathBuf};

/// `--set key=value`, as a verb takes them.
#[derive(Clone, Debug, Default, clap::Args)]
pub(super) struct Set {
    /// Override a scene key, such as sampling.step="1 voxel"; `contours=off` removes a table
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub set: Vec<String>,
}

impl Set {
    /// The overrides, with more of the verb's own flags after them.
    pub(super) fn overrides(&self, more: &[(&str, String)]) -> Result<Overrides, Failures> {
        let mut overrides = Overrides::default();
        for argument in &self.set {
            overrides.push_argument(argument).map_err(faults)?;
        }
        for (key, value) in more {
            overrides.push(*key, value.clone());
        }
        Ok(overrides)
    }
}

/// Whether a path is taken for a scene file.
pub(super) fn is_scene(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml"))
}

/// Loads a job.
pub(super) fn load(path: Option<&PathBuf>, overrides: &Overrides) -> Result<Job, Failures> {
    let Some(path) = path else {
        let scene = file::parse(file::DEFAULT_SCENE, Path::new("the embedded scene"), overrides).map_err(faults)?;
        return Ok(Job::load(scene)?);
    };
    if is_scene(path) {
        let scene = file::load(path, overrides).map_err(faults)?;
        return Ok(Job::load(scene)?);
    }
    if !read::is_volume(path) {
        return Err(Failure::new(
            "neither a scene nor a volume",
            path.display(),
            "scenes end in .toml; volumes in .nrrd, .nhdr, .nii, .nii.gz, .hdr, .mhd, .mha or .raw",
        )
        .into());
    }
    let volume = read::read(path, None).map_err(|e| Failure::new(e.what(), e.place(), e.remedy()))?;
    // Through the text of the scene, so that overrides act on a bare volume as on any scene. The text has the volume's
    // path as it was given; a name without folder leaves it as it is.
    let name = path.file_name().map_or(path.as_path(), Path::new);
    let through_text = |scene: &Scene| file::parse(&file::write_full(scene), name, overrides);
    // The camera frames what is shown for the picture's shape, which the overrides may change.
    let shortest = Scene::for_volume(VolumeSource::File { path: path.clone(), raw: None });
    let size = through_text(&shortest).map_or(shortest.picture.size, |scene| scene.picture.size);
    let scene = through_text(&bare(path.clone(), &volume, size)).map_err(faults)?;
    Ok(job::Job::with_volume(scene, volume)?)
}

/// All faults of a scene.
pub(super) fn faults(faults: file::Faults) -> Failures {
    Failures(faults.iter().map(|f| Failure::new(f.what(), f.position(), f.remedy())).collect())
}
