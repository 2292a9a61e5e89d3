//! The tables of a part: an object's selection or its ghost ([VS-2]).

use crate::picture::LayerKind;
use crate::tables::{
    Annotations, GhostTable, Halo, Ids, InteractionState, ObjectTable, PartName, Scene, Shading, Styles, Transfer,
    VolumeSource, VolumeTable,
};
use serde::{Deserialize, Serialize};

/// A part of an object.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Role {
    /// The selection, where M moves it; of an object that is not moved, where it is.
    Selection,
    /// The ghost: a moved selection at its original place.
    Ghost,
}

impl Scene {
    /// The parts of the scene's objects, in their order, each object's selection before its ghost.
    pub fn parts(&self) -> impl Iterator<Item = (usize, Role)> {
        let is_there = |&(i, role): &(usize, Role)| role == Role::Selection || self.objects[i].motion.is_moved();
        self.parts_of_frames().filter(is_there)
    }

    /// The parts of all frames of `[orbit]`, in the order of [`Scene::parts`]. Ghosts of later frames are among them.
    pub fn parts_of_frames(&self) -> impl Iterator<Item = (usize, Role)> {
        (0..self.objects.len())
            .flat_map(|i| [(i, Role::Selection)].into_iter().chain(self.leaves_ghost(i).then_some((i, Role::Ghost))))
    }

    /// Whether the selection of an object leaves its place when `[orbit]` turns the camera ([VS-9]).
    pub fn follows_camera(&self, object: usize) -> bool {
        self.orbit.is_some() && self.objects[object].interaction != InteractionState::Integrated
    }

    /// Whether an object has a ghost in some frame.
    pub fn leaves_ghost(&self, object: usize) -> bool {
        self.objects[object].motion.is_moved() || self.follows_camera(object)
    }

    /// The scene of a part: the object's data and material replace the picture's. Other objects, and effects that are
    /// drawn of `[volume]` alone, are left out. A table that the part does not have is the object's, or else the
    /// picture's. Halos keep their places; halos that the part does not seed have no effect.
    pub fn of_part(&self, object: usize, role: Role) -> Self {
        let table = &self.objects[object];
        let ghost = table.ghost.as_ref().filter(|_| role == Role::Ghost);
        let transfer: [Option<&Transfer>; 2] = [ghost.and_then(|g| g.transfer.as_ref()), table.transfer.as_ref()];
        let shading: [Option<&Shading>; 2] = [ghost.and_then(|g| g.shading.as_ref()), table.shading.as_ref()];
        let mut scene = Self {
            given: self.given.with_tables(tables_of(object, table, ghost)),
            shading: first(shading).or(self.shading.as_ref()).cloned(),
            styles: self.styles_of(object, ghost.is_some(), &|key| self.given.contains(key)),
            volume: self.volume_of(table),
            stipples: None,
            hatching: None,
            outlines: None,
            surface: None,
            meshes: Vec::new(),
            ..self.with_transfer(first(transfer).or(self.transfer.as_ref()))
        };
        let own = match role {
            Role::Selection => PartName::Selection(table.name.clone()),
            Role::Ghost => PartName::Ghost(table.name.clone()),
        };
        scene.clips.retain(|clip| clip.applies.is_empty() || clip.applies.contains(&own));
        // In data without labels h_l is 0.
        let seeds = |halo: &Halo| halo.takes(&own) && (halo.seed.labels.is_none() || scene.volume.labels.is_some());
        let idle: Vec<usize> = (0..self.halos.len()).filter(|&i| !seeds(&self.halos[i])).collect();
        idle.iter().for_each(|&i| scene.halos[i].opacity = 0.0);
        scene.picture.layers.retain(|layer| !matches!(layer, LayerKind::Halo(i) if idle.contains(i)));
        scene
    }

    /// The index of the object whose own data a part is drawn of; none if the part is drawn of `[volume]`.
    pub fn own_data_of(&self, part: &PartName) -> Option<usize> {
        let (PartName::Selection(name) | PartName::Ghost(name)) = part else { return None };
        self.objects.iter().position(|object| object.name == *name && object.volume.is_some())
    }

    /// Whether a part has a table of shading of its own.
    pub fn has_own_shading(&self, object: usize, role: Role) -> bool {
        let table = &self.objects[object];
        let of_ghost = table.ghost.as_ref().is_some_and(|ghost| role == Role::Ghost && ghost.shading.is_some());
        table.shading.is_some() || of_ghost
    }

    /// A key of a part's scene as the scene itself says it.
    pub fn key_of_part(&self, object: usize, role: Role, key: &str) -> String {
        let table = &self.objects[object];
        let tables = tables_of(object, table, table.ghost.as_ref().filter(|_| role == Role::Ghost));
        let outer = tables.iter().find_map(|(outer, place)| {
            let rest = key.strip_prefix(place)?;
            (rest.is_empty() || rest.starts_with(['.', '['])).then(|| format!("{outer}{rest}"))
        });
        outer.unwrap_or_else(|| key.to_owned())
    }

    /// The scene of the background: without objects.
    pub fn of_background(&self) -> Self {
        self.with_transfer(self.transfer.as_ref())
    }

    /// The scene without objects and with a transfer function. Every part has such a scene, so the tables that are left
    /// out are not copied.
    fn with_transfer(&self, transfer: Option<&Transfer>) -> Self {
        Self {
            light: self.light,
            volume: self.volume.clone(),
            clips: self.clips.clone(),
            camera: self.camera.clone(),
            orbit: self.orbit,
            picture: self.picture.clone(),
            page: self.page.clone(),
            pens: self.pens.clone(),
            sampling: self.sampling.clone(),
            transfer: transfer.cloned(),
            styles: self.styles.clone(),
            shading: self.shading.clone(),
            contours: self.contours.clone(),
            style_mipmaps: self.style_mipmaps.clone(),
            halos: self.halos.clone(),
            combine: None,
            objects: Vec::new(),
            intersections: Vec::new(),
            stipples: self.stipples.clone(),
            hatching: self.hatching.clone(),
            outlines: self.outlines.clone(),
            surface: self.surface.clone(),
            meshes: self.meshes.clone(),
            annotations: Annotations::default(),
            given: self.given.clone(),
        }
    }

    /// The styles of a part. For each name, a style of the ghost replaces the object's, and that replaces the
    /// picture's. A theme replaces another if the scene gives it.
    pub(crate) fn styles_of(&self, object: usize, is_ghost: bool, says: &dyn Fn(&str) -> bool) -> Styles {
        let table = &self.objects[object];
        let of_ghost = table.ghost.as_ref().filter(|_| is_ghost).and_then(|ghost| ghost.styles.as_ref());
        let above = [(table.styles.as_ref(), "styles"), (of_ghost, "ghost.styles")];
        let mut all = self.styles.clone();
        for (styles, key) in above.into_iter().filter_map(|(styles, key)| Some((styles?, key))) {
            if says(&format!("object[{object}].{key}.theme")) {
                all.theme = styles.theme.clone();
            }
            all.files.retain(|(name, _)| styles.files.iter().all(|(other, _)| other != name));
            all.files.extend(styles.files.iter().cloned());
        }
        all
    }

    /// The table of an object's data.
    fn volume_of(&self, object: &ObjectTable) -> VolumeTable {
        let Some(path) = &object.volume else {
            // The data are those of the picture, whose parts are kept and whose ids are shown already.
            return VolumeTable { parts: None, ids: Ids::Values, ..self.volume.clone() };
        };
        VolumeTable {
            labels: object.labels.clone(),
            label_names: object.label_names.clone(),
            range: object.range,
            gradient_range: object.gradient_range,
            outside: object.outside,
            ..VolumeTable::new(VolumeSource::File { path: path.clone(), raw: None })
        }
    }
}

/// The tables of a part's scene that its object or its ghost says, each with the key that it has as the picture's.
fn tables_of(object: usize, table: &ObjectTable, ghost: Option<&GhostTable>) -> Vec<(String, &'static str)> {
    let outer = |of_ghost: bool, of_object: bool, name: &'static str| match (of_ghost, of_object) {
        (true, _) => Some((format!("object[{object}].ghost.{name}"), name)),
        (false, true) => Some((format!("object[{object}].{name}"), name)),
        (false, false) => None,
    };
    let own = table.volume.is_some().then(|| (format!("object[{object}]"), "volume"));
    let tables = [
        outer(ghost.is_some_and(|g| g.transfer.is_some()), table.transfer.is_some(), "transfer"),
        outer(ghost.is_some_and(|g| g.shading.is_some()), table.shading.is_some(), "shading"),
        outer(ghost.is_some_and(|g| g.styles.is_some()), table.styles.is_some(), "styles"),
        own,
    ];
    tables.into_iter().flatten().collect()
}

fn first<T>(tables: [Option<&T>; 2]) -> Option<&T> {
    tables.into_iter().flatten().next()
}
