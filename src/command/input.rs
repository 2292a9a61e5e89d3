//! The input of a verb: a scene, a bare volume, or nothing, which means the embedded scene.

use super::Talk;
use super::raw::{self, layout};
use super::report::{note, say};
use crate::job::{Job, RenderTarget, bare, bare_for};
use crate::scene::counts::Counts;
use crate::scene::file::{self, Fault, Faults, Overrides, Place};
use crate::scene::picture::LayerKind;
use crate::scene::source::Disk;
use crate::scene::tables::{RawLayout, Scene, VolumeSource};
use crate::scene::volume::{Volume, read};
use crate::{Failure, Failures};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The options `--set key=value` of a verb.
#[derive(Clone, Debug, Default, clap::Args)]
pub(super) struct SetArgs {
    /// Override a scene key, such as sampling.step="1 voxel"; `contours=off` removes a table
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub set: Vec<String>,
}

/// The volume to draw by a scene, given after the scene's name.
#[derive(Clone, Debug, Default, clap::Args)]
pub(super) struct TemplateArgs {
    /// Volume to draw by the scene, in place of the scene's own; a scene without [volume] is a template and needs one
    #[arg(value_name = "VOLUME")]
    pub volume: Option<PathBuf>,
}

/// A flag that stands for a scene key.
pub(super) struct KeyFlag {
    /// The key.
    pub key: &'static str,
    /// The value as TOML.
    pub value: String,
    /// The flag as typed, for messages.
    pub typed: String,
}

impl KeyFlag {
    /// Returns a flag with a text value, even if TOML would parse it as something else.
    pub(super) fn name(key: &'static str, flag: &str, value: &str) -> Self {
        Self { key, value: format!("{value:?}"), typed: format!("{flag} {}", value.trim()) }
    }

    /// Returns a flag with a value that is a number, or a text with a unit.
    pub(super) fn length(key: &'static str, flag: &str, value: &str) -> Self {
        match value.trim().parse::<f64>() {
            Ok(number) => Self { value: format!("{number:?}"), ..Self::name(key, flag, value) },
            Err(_) => Self::name(key, flag, value),
        }
    }
}

/// Keys that decide which voxels of a file are read. They must be known before there is a scene.
const READING: [&str; 3] = ["volume.raw", "volume.box", "volume.stride"];

/// Everything on the command line that overrides a scene.
#[derive(Default)]
pub(super) struct SceneOverrides {
    /// Overrides of `--set`, then of the flags.
    overrides: Overrides,
    /// Overrides of `[picture]` alone.
    picture: Overrides,
    /// Overrides of the keys in [`READING`] alone.
    reading: Overrides,
    /// Override of `preset` alone.
    preset: Overrides,
    /// Whether an override changes the kind of the transfer function.
    sets_kind: bool,
    flags: Vec<KeyFlag>,
    /// Whether only the layer `beauty` is rendered. Layers that nobody writes are not computed ([PLAN-1]).
    pub beauty_only: bool,
    /// The volume to draw by the scene, in place of its own.
    pub volume: Option<PathBuf>,
    /// Pixels of the picture's longer side, in place of the scene's.
    pub longer_side: Option<usize>,
    /// The part of the scene to draw.
    pub target: RenderTarget,
}

impl SceneOverrides {
    /// Collects a verb's `--set`s and its flags. Flags win.
    pub(super) fn new(set: &SetArgs, flags: Vec<KeyFlag>) -> Result<Self, Failures> {
        let mut over = Self::default();
        let mut failures = Vec::new();
        for argument in &set.set {
            over.sets_kind |= argument.trim_start().starts_with("transfer.kind");
            if let Some(part) = over.part(argument.trim_start()) {
                // The push below reports its fault.
                let _ = part.push_argument(argument);
            }
            if let Err(faults) = over.overrides.push_argument(argument) {
                failures.extend(faults.iter().map(Failure::from));
            }
        }
        for KeyFlag { key, value, .. } in &flags {
            over.overrides.push(*key, value.clone());
            if let Some(part) = over.part(key) {
                part.push(*key, value.clone());
            }
        }
        over.flags = flags;
        Failures::check(failures).map(|()| over)
    }

    /// Returns the extra list for an override that must be known before there is a scene.
    fn part(&mut self, key: &str) -> Option<&mut Overrides> {
        match key {
            // Layers say nothing of the frame, and may name halos.
            _ if key.starts_with("picture.layers") => None,
            _ if key.starts_with("picture.") => Some(&mut self.picture),
            _ if READING.iter().any(|read| key.starts_with(read)) => Some(&mut self.reading),
            _ if key.starts_with("preset") => Some(&mut self.preset),
            _ => None,
        }
    }

    /// Returns the failures of a scene. A value from a flag is shown as it was typed.
    fn failures(&self, faults: Faults) -> Failures {
        let failure = |fault: &Fault| {
            let flag = match &fault.place {
                Place::Set(text) => self.flags.iter().find(|flag| **text == *format!("{}={}", flag.key, flag.value)),
                Place::File { .. } | Place::Chosen => None,
            };
            match flag {
                // The flag stands for a table, of which the fault names no key.
                Some(flag) if flag.key == raw::KEY && fault.key == raw::KEY => raw::no_keys(&flag.typed),
                Some(flag) => Failure::new(fault.what(), &flag.typed, fault.remedy()),
                None => Failure::from(fault),
            }
        };
        let mut each = faults.iter().map(failure);
        match each.next() {
            Some(first) => Failures::new(first, each),
            // A list of faults is never empty.
            None => faults.clone().into(),
        }
    }
}

/// A verb's input before loading.
pub(super) struct VerbInput {
    /// The scene.
    pub scene: Scene,
    /// The volume, if it had to be read to make the scene.
    pub volume: Option<Volume>,
    /// Counts of making the scene.
    pub counts: Counts,
}

/// Loads a verb's input.
pub(super) fn load(path: Option<&Path>, over: &SceneOverrides) -> Result<Job, Failures> {
    find(path, over)?.load(over.target)
}

impl VerbInput {
    /// Loads everything that the scene names.
    pub(super) fn load(self, target: RenderTarget) -> Result<Job, Failures> {
        let mut job = match self.volume {
            Some(volume) => Job::with_volume_for(self.scene, volume, target, Arc::new(Disk)),
            None => Job::load_for(self.scene, target, Arc::new(Disk)),
        }?;
        job.counts.add(&self.counts);
        Ok(job)
    }
}

/// Returns a verb's scene, or the one made for a bare volume.
pub(super) fn find(path: Option<&Path>, over: &SceneOverrides) -> Result<VerbInput, Failures> {
    let finished = |mut scene: Scene| {
        if over.beauty_only {
            scene.picture.layers = vec![LayerKind::Beauty];
        }
        // Dots have the size that the page gives, and would cover a smaller page. Such a page is shown smaller instead.
        if let Some(side) = over.longer_side.filter(|_| !scene.draws_on_page()) {
            let [width, height] = scene.picture.size;
            scene.picture.size = [width, height].map(|n| (n * side).div_ceil(width.max(height)));
        }
        scene
    };
    let found = |scene| VerbInput { scene: finished(scene), volume: None, counts: Counts::default() };
    if let (Some(path), Some(volume)) = (path, &over.volume) {
        check_pair(path, volume)?;
        let scene = file::load_for(path, volume, &over.overrides);
        return Ok(found(scene.map_err(|faults| over.failures(faults))?));
    }
    let Some(path) = path else {
        let scene = file::parse(file::DEFAULT_SCENE, Path::new("the embedded scene"), &over.overrides);
        return Ok(found(scene.map_err(|faults| over.failures(faults))?));
    };
    if is_scene(path) {
        if std::fs::read_to_string(path).is_ok_and(|text| file::is_figure(&text)) {
            let what = "this is a figure of several scenes, and one scene is wanted";
            return Err(Failure::new(what, path.display(), "draw it with drypoint figure").into());
        }
        let scene = file::load(path, &over.overrides);
        return Ok(found(scene.map_err(|faults| over.failures(faults))?));
    }
    let described = file::parse(NOTHING, Path::new(""), &over.reading).map_err(|faults| over.failures(faults))?;
    let raw = layout(&described.volume.source);
    if raw.is_none() && !read::is_volume(path) {
        return Err(no_input(path).into());
    }
    let volume = read::read_part(&Disk, path, raw, &|grid, _| described.volume.subset.of(grid.dims()))?;
    let mut counts = Counts::default();
    let scene = finished(suggested(path, raw, &volume, over, &mut counts)?);
    let same = match &scene.volume.source {
        VolumeSource::File { path: shown, raw: described } => shown == path && described.as_ref() == raw,
        VolumeSource::Phantom(_) => false,
    };
    Ok(VerbInput { scene, volume: same.then_some(volume), counts })
}

/// Checks that the first path is a scene, and the second one an existing volume file.
fn check_pair(scene: &Path, volume: &Path) -> Result<(), Failures> {
    let order = "write the scene, then the volume: drypoint render template.toml head.nrrd";
    match (is_scene(scene), is_scene(volume)) {
        (true, true) => {
            let what = "a scene is drawn for a volume, and this is a second scene";
            Err(Failure::new(what, volume.display(), order).into())
        }
        (false, true) => Err(Failure::new("the volume stands before its scene", volume.display(), order).into()),
        (false, false) => {
            let what = "a volume is drawn by a scene, and the file before this one is none";
            Err(Failure::new(what, volume.display(), order).into())
        }
        // Whether a template says how raw voxels lie is known once it is read.
        (true, false) if volume.is_file() => Ok(()),
        (true, false) => Err(no_input(volume).into()),
    }
}

/// Returns the scene without volume that `--set` and flags describe, over the defaults.
pub(super) fn settings(set: &SetArgs, flags: Vec<KeyFlag>) -> Result<Scene, Failures> {
    let over = SceneOverrides::new(set, flags)?;
    file::parse(NOTHING, Path::new(""), &over.overrides).map_err(|faults| over.failures(faults))
}

/// Whether a path has the suffix of a scene file.
pub(super) fn is_scene(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml"))
}

/// Returns the reason why a path is neither a scene nor a volume.
pub(super) fn no_input(path: &Path) -> Failure {
    if let Err(error) = read::refuse_dicom(&Disk, path) {
        return error.into();
    }
    let suffixes = read::EXTENSIONS.map(|suffix| format!(".{suffix}")).join(", ");
    let check = format!("check the path; scenes end in .toml, volumes in {suffixes}");
    match std::fs::metadata(path) {
        Ok(found) if found.is_dir() => {
            let remedy = format!("give a file that is in it: scenes end in .toml, volumes in {suffixes}");
            Failure::new("a folder is neither a scene nor a volume", path.display(), remedy)
        }
        Ok(_) => {
            let what = "the suffix is neither that of a scene nor of a volume";
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let remedy = format!("{check}; --raw or a file {name}.toml describes raw voxels of any other");
            Failure::new(what, path.display(), remedy)
        }
        Err(error) => Failure::new(format!("the file cannot be read: {error}"), path.display(), check),
    }
}

/// Returns the scene for a bare volume. It goes through its own text, so that overrides act as on any scene.
fn suggested(
    path: &Path,
    raw: Option<&RawLayout>,
    volume: &Volume,
    over: &SceneOverrides,
    counts: &mut Counts,
) -> Result<Scene, Failures> {
    let parse = |text: &str, name: &str, overrides: &Overrides| file::parse(text, Path::new(name), overrides);
    // The camera frames the content in a picture of one shape. Faults of these overrides are reported below.
    let size = parse(NOTHING, "", &over.picture).map_or([512, 512], |scene| scene.picture.size);
    let preset = parse(NOTHING, "", &over.preset).ok();
    let suggested = match &preset {
        Some(preset) => bare_for(preset, path.to_path_buf(), volume, size, counts)?,
        None => bare(path.to_path_buf(), volume, size, counts)?,
    };
    let mut text = file::write_full(&suggested);
    if over.sets_kind {
        // Nodes of one kind do not fit the other, so they are suggested anew.
        let nodes = Overrides::from_iter([("transfer.nodes", "off")]);
        text = parse(&text, "", &nodes).map_or(text, |scene| file::write_full(&scene));
    }
    // A name without a folder keeps the volume's path as given.
    let name = format!("the scene for {}", path.file_name().unwrap_or_default().to_string_lossy());
    let mut scene = parse(&text, &name, &over.overrides).map_err(|faults| over.failures(faults))?;
    // No line of this text was written by a user.
    let default = Scene::for_volume(suggested.volume.source.clone());
    scene.given.keep_overrides(file::differences(&suggested, &default));
    if !scene.given.contains("volume.file") && !scene.given.contains("volume.phantom") {
        // The text would change a path that is not Unicode.
        scene.volume.source = VolumeSource::File { path: path.to_path_buf(), raw: raw.cloned() };
    }
    Ok(scene)
}

/// Returns the flag of `--size`, such as `800x600`.
pub(super) fn size_flag(size: &str) -> Result<KeyFlag, Failure> {
    let typed = format!("--size {size}");
    let number = |n: &str| n.parse::<u64>().ok();
    let pixels = size.split_once('x').and_then(|(width, height)| Some([number(width)?, number(height)?]));
    let [width, height] = pixels.ok_or_else(|| {
        let remedy = "write width and height in pixels, such as 800x600";
        Failure::new(format!("{size:?} is no size"), &typed, remedy)
    })?;
    Ok(KeyFlag { key: "picture.size", value: format!("[{width}, {height}]"), typed })
}

/// Returns the flags of `--preset`. A bare volume drawn as dots or outlines alone gets a page, unless a size is given.
pub(super) fn preset_flags(preset: &str, input: Option<&Path>, set: &SetArgs, has_size: bool) -> Vec<KeyFlag> {
    let is_bare = input.is_some_and(|input| !is_scene(input));
    let on_a_page = is_bare && !has_size && (preset.starts_with("stipple") || preset == "outline");
    let page = if on_a_page { page_flags(set) } else { Vec::new() };
    std::iter::once(KeyFlag::name("preset", "--preset", preset)).chain(page).collect()
}

/// Returns the flags of a page to print on, 160 mm wide and high, for the marks of a bare volume. None if `--set` gives
/// a size. If one length is given, the other equals it.
pub(super) fn page_flags(set: &SetArgs) -> Vec<KeyFlag> {
    let said = |key: &str| set.set.iter().find_map(|set| Some(set.trim_start().strip_prefix(key)?.trim_start()));
    if said("picture.size").or(said("picture=")).is_some() {
        return Vec::new();
    }
    let [width, height] = ["picture.width", "picture.height"].map(|key| said(key)?.strip_prefix('='));
    let as_long = |other: Option<&str>| other.unwrap_or("160 mm").trim().trim_matches('"').to_owned();
    let flags = [("picture.width", width, height), ("picture.height", height, width)];
    flags
        .into_iter()
        .filter(|(_, own, _)| own.is_none())
        .map(|(key, _, other)| KeyFlag::name(key, key, &as_long(other)))
        .collect()
}

/// A scene in which every key has its default.
const NOTHING: &str = "drypoint = 1\nvolume.file = \"none\"\n";

/// Prints the warnings of a job and, if verbose, its volume and plan.
pub(super) fn tell(talk: Talk, job: &Job) {
    for warning in &job.plan.warnings {
        note(talk, format_args!("warning: {warning}"));
    }
    if let Some(mask) = job.volume.mask() {
        let (voxels, are) = if mask.count() == 1 { ("voxel", "is") } else { ("voxels", "are") };
        note(
            talk,
            format_args!("warning: {} {voxels} {are} NaN or infinite: the cells around are transparent", mask.count()),
        );
    }
    if talk.verbose {
        if job.scene.volume.parts.is_some() {
            let Counts { parts, parts_kept, part_sizes, .. } = &job.counts;
            let largest: Vec<String> = part_sizes.iter().take(5).map(u64::to_string).collect();
            let more = if part_sizes.len() > 5 { ", …" } else { "" };
            note(talk, format_args!("parts: {parts} of {}{more} voxels, {parts_kept} kept", largest.join(", ")));
        }
        let [nx, ny, nz] = job.volume.dims();
        let voxels = job.volume.voxels();
        let source = match &job.scene.volume.source {
            VolumeSource::File { path, .. } => path.display().to_string(),
            VolumeSource::Phantom(phantom) => format!("phantom {}", phantom.name),
        };
        note(talk, format_args!("{source}: {nx} × {ny} × {nz} voxels, {}", voxels.voxel_type().name()));
        say(format_args!("\n{}", job.plan));
    }
}

/// Reports every missing file of a list before work begins.
pub(super) fn all_there(files: &[PathBuf]) -> Result<(), Failures> {
    Failures::check(files.iter().filter(|file| !file.is_file()).map(|file| no_input(file)))
}
