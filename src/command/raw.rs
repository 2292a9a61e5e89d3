//! The option `--raw`: the layout of voxels without a header or sidecar ([IO-1]).

use super::input::{self, KeyFlag, SetArgs};
use crate::scene::tables::{RawLayout, VolumeSource};
use crate::scene::volume::{Volume, read};
use crate::{Failure, Failures};
use std::path::Path;

/// The scene key that `--raw` stands for.
pub(super) const KEY: &str = "volume.raw";

/// The option `--raw` of verbs.
#[derive(Clone, Debug, Default, clap::Args)]
pub(super) struct RawArgs {
    /// Layout of raw voxels, the keys of volume.raw: 'size = [256, 256, 113], type = "i16"'
    #[arg(long = "raw", value_name = "KEYS")]
    keys: Option<String>,
}

impl RawArgs {
    /// Returns the flag of the scene key `volume.raw`.
    pub(super) fn flag(&self) -> Option<KeyFlag> {
        let keys = self.keys.as_ref()?;
        Some(KeyFlag { key: KEY, value: format!("{{ {keys} }}"), typed: format!("--raw {keys}") })
    }

    /// Reads a volume, by its layout if one is given.
    pub(super) fn read(&self, path: &Path) -> Result<Volume, Failures> {
        let scene = input::settings(&SetArgs::default(), self.flag().into_iter().collect())?;
        Ok(read::read(path, layout(&scene.volume.source))?)
    }
}

/// Returns the failure of a `--raw`, as typed, that is no list of keys.
pub(super) fn no_keys(typed: &str) -> Failure {
    let has = |key: &str| typed.contains(key);
    let absent = match (has("size"), has("["), has("type")) {
        (true, false, true) => ": size has no brackets",
        (true, false, false) => ": size has no brackets, and type is missing",
        (false, ..) => ": size is missing",
        (true, true, false) => ": type is missing",
        (true, true, true) => "",
    };
    let unquoted = ["type", "endian"].into_iter().find_map(|key| Some((key, bare_word(typed, key)?)));
    let what = match unquoted {
        Some((key, word)) => format!("this is no layout: {key} = {word} needs quotes, as in {key} = {word:?}"),
        None => format!("this is no layout{absent}"),
    };
    Failure::new(
        what,
        typed,
        "write --raw 'size = [256, 256, 113], type = \"i16\"', with size and type of these voxels",
    )
}

/// Returns the word that a key of a layout has without quotes, if it has one.
fn bare_word<'a>(typed: &'a str, key: &str) -> Option<&'a str> {
    let (_, value) = typed.split_once(key)?;
    let value = value.trim_start().strip_prefix('=')?.trim_start();
    let end = value.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(value.len());
    Some(&value[..end]).filter(|word| !word.is_empty())
}

/// Returns the layout of a source, if it has one.
pub(super) fn layout(source: &VolumeSource) -> Option<&RawLayout> {
    match source {
        VolumeSource::File { raw, .. } => raw.as_ref(),
        VolumeSource::Phantom(_) => None,
    }
}
