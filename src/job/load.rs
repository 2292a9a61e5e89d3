//! Loading of a job's data: the volume and further ones, styles, and a background picture.

use super::room;
use super::target::RenderTarget;
use crate::Failure;
use drypoint_output::OutputError;
use drypoint_output::read::read_background;
use drypoint_scene::color::Rgba;
use drypoint_scene::file::Given;
use drypoint_scene::memory;
use drypoint_scene::mesh::{self, TriangleMesh};
use drypoint_scene::phantom::{self, PhantomError};
use drypoint_scene::plan::{Pass, Plan};
use drypoint_scene::source::Source;
use drypoint_scene::style::{Style, StyleError, lighting_table as decode_lighting_table, load as load_styles};
use drypoint_scene::tables::{
    Axis, Background, Halo, LabelKey, Node, Scene, Transfer, TransferKind, VolumeSource, VolumeTable,
};
use drypoint_scene::transfer::FunctionError;
use drypoint_scene::volume::labels::LabelNames;
use drypoint_scene::volume::read::Fault;
use drypoint_scene::volume::{Volume, read};
use std::collections::BTreeSet;
use std::fmt::Display;
use std::sync::Arc;

/// Reads or generates a scene's volume.
pub(super) fn load_volume(source: &dyn Source, table: &VolumeTable, given: &Given) -> Result<Volume, Failure> {
    match &table.source {
        VolumeSource::File { path, raw } => read::read_part(source, path, raw.as_ref(), &|grid, _| {
            table.subset.of(grid.dims())
        })
        .map_err(|error| match *error.fault {
            Fault::NotInVolume(_) => {
                let what = format!("{}: {}", path.display(), error.what());
                Failure::new(what, given.position("volume.box"), error.remedy())
            }
            _ => Failure::from(error),
        }),
        VolumeSource::Phantom(described) => phantom::generate_part(described, &table.subset).map_err(|error| {
            if let PhantomError::NotInVolume(_) = error {
                return Failure::new(error, given.position("volume.box"), "give ranges within the phantom's size");
            }
            let remedy = match &error {
                PhantomError::Memory { .. } => "ask for fewer voxels with volume.phantom.size",
                PhantomError::Space(_) => "give other numbers as volume.phantom.spacing",
                _ => "`drypoint phantom --list` lists phantoms and parameters",
            };
            Failure::new(error, given.position("volume.phantom"), remedy)
        }),
    }
}

/// Reads or generates the volume of a scene. A program that edits a scene keeps the volume while `[volume]` stays the
/// same, and hands it to `Job::with_volume_for`.
///
/// # Errors
/// A volume that cannot be read.
pub fn read_volume(scene: &Scene, source: &dyn Source) -> Result<Volume, Failure> {
    load_volume(source, &scene.volume, &scene.given)
}

/// Reads the further volumes of the transfer function. Errors go to `failures`.
pub(super) fn further(source: &dyn Source, scene: &Scene, failures: &mut Vec<Failure>) -> [Option<Volume>; 2] {
    let axes = scene.transfer.as_ref().map_or(&[][..], |transfer| transfer.over.axes());
    [0, 1].map(|i| match axes.get(i) {
        Some(Axis::Volume(path)) => {
            let read = read::read_part(source, path, None, &read::all_voxels);
            read.map_err(|error| failures.push(Failure::from(error))).ok()
        }
        _ => None,
    })
}

/// Reads the meshes of a scene and moves them to their places. Errors go to `failures`.
pub(super) fn meshes(source: &dyn Source, scene: &Scene, failures: &mut Vec<Failure>) -> Vec<TriangleMesh> {
    let mut meshes = Vec::with_capacity(scene.meshes.len());
    for (i, table) in scene.meshes.iter().enumerate() {
        let read = mesh::read::read(source, &table.file).map_err(|error| {
            let place = format!("{}, {}", table.file.display(), scene.given.position(&format!("mesh[{i}].file")));
            Failure::new(&error, place, error.remedy())
        });
        let placed = read.and_then(|mesh| {
            let map = table.motion.map(mesh.centre());
            let mesh = if table.motion.is_moved() { mesh.moved(&map) } else { Ok(mesh) };
            let key = format!("mesh[{i}]");
            mesh.map_err(|fault| Failure::new(fault, scene.given.position(&key), "move or scale the mesh less"))
        });
        meshes.extend(placed.map_err(|failure| failures.push(failure)).ok());
    }
    meshes
}

/// Returns the names of the nodes' styles, each once.
pub(super) fn named(transfer: &Transfer) -> impl Iterator<Item = &str> {
    let mut told = BTreeSet::new();
    transfer.all_nodes().filter_map(Node::style).filter(move |name| told.insert(*name))
}

/// Returns the failure of a transfer function, at the key that causes it.
pub(super) fn function_failure(error: &FunctionError, given: &Given, names: &LabelNames) -> Failure {
    let key = match error {
        FunctionError::UnknownLabel { row: Some(row), .. } | FunctionError::LabelTwice { row, .. } => {
            format!("transfer.rows[{row}].at")
        }
        FunctionError::UnknownLabel { row: None, .. } => "transfer.over".into(),
    };
    let remedy = match error {
        FunctionError::LabelTwice { .. } => "keep one row for each label".into(),
        FunctionError::UnknownLabel { name, .. } => known_label(name, names),
    };
    Failure::new(error, given.position(&key), remedy)
}

/// Returns the remedy for a label's name that does not exist.
pub(crate) fn known_label(name: &str, names: &LabelNames) -> String {
    match names.nearest(name) {
        Some(nearest) => format!("write {nearest:?}"),
        None if names.iter().next().is_none() => "write an id, or name the labels with volume.label_names".into(),
        None => "write an id, or one of the names in volume.label_names".into(),
    }
}

/// Replaces the names of labels that seed halos by ids. Names that no label has go to `failures`.
pub(super) fn halo_labels(scene: &mut Scene, names: &LabelNames, is_part: bool, failures: &mut Vec<Failure>) {
    // Those of an object's own data are names there.
    let elsewhere = |halo: &Halo| halo.object.as_ref().is_some_and(|part| scene.own_data_of(part).is_some());
    let elsewhere: Vec<bool> = scene.halos.iter().map(elsewhere).collect();
    for (i, halo) in scene.halos.iter_mut().enumerate().filter(|(i, _)| !elsewhere[*i]) {
        // A halo of all parts may name labels that this one does not have.
        if let (true, None, Some(labels)) = (is_part, &halo.object, &mut halo.seed.labels) {
            labels.retain(|label| !matches!(label, LabelKey::Name(name) if names.id(name).is_none()));
        }
        for (j, name) in halo.seed.resolve_labels(|name| names.id(name)).err().into_iter().flatten() {
            let position = scene.given.position(&format!("halo[{i}].seed.labels[{j}]"));
            failures.push(Failure::new(format!("there is no label {name:?}"), position, known_label(&name, names)));
        }
    }
}

/// Loads styles by name. Errors go to `failures`.
pub(super) fn styles<'a>(
    source: &dyn Source,
    scene: &Scene,
    names: impl Iterator<Item = &'a str>,
    failures: &mut Vec<Failure>,
) -> Vec<Style> {
    let mut styles = Vec::new();
    for name in names {
        match load_styles(source, &scene.styles, [name]) {
            Ok(style) => styles.extend(style),
            Err(error) => failures.push(style_failure(scene, &error)),
        }
    }
    styles
}

/// Returns the failure of a style or theme, at the key that names it.
fn style_failure(scene: &Scene, error: &StyleError) -> Failure {
    let own = |name: &String| scene.styles.files.iter().any(|(known, _)| known == name);
    let is_bare = |name: &String| name.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_' || b == b'-');
    let key = match error {
        StyleError::File { name, .. } | StyleError::Picture { name, .. } if own(name) && is_bare(name) => {
            format!("styles.{name}")
        }
        StyleError::File { name, .. } | StyleError::Picture { name, .. } if own(name) => format!("styles.{name:?}"),
        StyleError::Unknown { .. } => "transfer.nodes".into(),
        _ => "styles.theme".into(),
    };
    Failure::new(error, scene.given.position(&key), error.help())
}

/// Reads the lighting table of a file, if rays are lit by one. Errors go to `failures`.
pub(super) fn lighting_table(source: &dyn Source, scene: &mut Scene, plan: &Plan, failures: &mut Vec<Failure>) {
    let is_lit = scene.transfer.as_ref().is_some_and(|transfer| transfer.kind == TransferKind::Regular);
    let Some(shading) = scene.shading.as_mut().filter(|_| is_lit && plan.has_pass(Pass::Rays)) else { return };
    let reads = shading.lighting_file().is_some();
    let Some(file) = shading.table.as_mut().filter(|_| reads) else { return };
    let failed = |what: &dyn Display, remedy| {
        let what = format!("the lighting table {}: {what}", file.path.display());
        Failure::new(what, scene.given.position("shading.table"), remedy)
    };
    let read = memory::read(source, &file.path).map_err(|error| failed(&error, "give a picture that may be read"));
    match read.and_then(|bytes| decode_lighting_table(&bytes).map_err(|fault| failed(&fault, fault.help()))) {
        Ok(table) => file.table = Some(Arc::new(table)),
        Err(failure) => failures.push(failure),
    }
}

/// Reads the picture behind the volume, if the scene has one. Errors go to `failures`.
pub(super) fn background(
    source: &dyn Source,
    scene: &Scene,
    target: RenderTarget,
    failures: &mut Vec<Failure>,
) -> Option<Vec<Rgba>> {
    let Background::Picture(path) = &scene.picture.background else { return None };
    if target != RenderTarget::Picture {
        let (what, remedy) = ("a page has no picture behind it", "give a colour, or \"none\", or render the scene");
        failures.push(Failure::new(what, scene.given.position("picture.background"), remedy));
        return None;
    }
    let [width, height] = scene.picture.size;
    if let Err(failure) = room(scene, size_of::<Rgba>()) {
        failures.push(failure);
        return None;
    }
    let pixels = read_background(source, path, width, height);
    let failed = |error| Failure::new(&error, scene.given.position("picture.background"), OutputError::help(&error));
    pixels.map_err(|error| failures.push(failed(error))).ok()
}
