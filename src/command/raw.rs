//! `--raw`: the layout of voxels without a header, where no sidecar describes them ([IO-1]).

use super::input::{self, Flag};
use drypoint::Failures;
use drypoint::scene::tables::{RawLayout, VolumeSource};
use drypoint::scene::volume::{Volume, read};
use std::path::Path;

/// The layout of a file without header, as verbs take it.
#[derive(Clone, Debug, Default, clap::Args)]
pub(super) struct Raw {
    /// The layout of raw voxels, the keys of volume.raw: 'size = [256, 256, 113], type = "i16"'
    #[arg(long = "raw", value_name = "KEYS")]
    keys: Option<String>,
}

impl Raw {
    /// The scene key that it stands for.
    pub(super) fn flag(&self) -> Option<Flag> {
        let keys = self.keys.as_ref()?;
        Some(Flag { key: "volume.raw", value: format!("{{ {keys} }}"), typed: format!("--raw {keys}") })
    }

    /// Reads a volume: by its layout, if one was given.
    pub(super) fn read(&self, path: &Path) -> Result<Volume, Failures> {
        let scene = input::settings(self.flag().into_iter().collect())?;
        Ok(read::read(path, layout(&scene.volume.source))?)
    }
}

/// The layout that a source has.
pub(super) fn layout(source: &VolumeSource) -> Option<&RawLayout> {
    match source {
        VolumeSource::File { raw, .. } => raw.as_ref(),
        VolumeSource::Phantom(_) => None,
    }
}
