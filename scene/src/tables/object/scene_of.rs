//! The scene of a part: an object's selection or its ghost, drawn as a picture of its own ([VS-2]).

use crate::tables::{ObjectTable, PartName, Scene, Shading, Styles, Transfer, VolumeSource, VolumeTable};

/// A part of an object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// The selection, where M moves it; of an object that is not moved, where it is.
    Selection,
    /// The ghost: a moved selection at its original place.
    Ghost,
}

impl Scene {
    /// The parts of the scene's objects, in their order, each object's selection before its ghost.
    pub fn parts(&self) -> impl Iterator<Item = (usize, Role)> {
        self.objects.iter().enumerate().flat_map(|(i, object)| {
            let ghost = object.motion.is_moved().then_some((i, Role::Ghost));
            [(i, Role::Selection)].into_iter().chain(ghost)
        })
    }

    /// The scene of a part: the object's data and look in place of the picture's, without other objects and without what is
    /// drawn of `[volume]` alone. A table that the part does not have is the object's, or else the picture's.
    pub fn of_part(&self, object: usize, role: Role) -> Self {
        let table = &self.objects[object];
        let ghost = table.ghost.as_ref().filter(|_| role == Role::Ghost);
        let transfer: [Option<&Transfer>; 2] = [ghost.and_then(|g| g.transfer.as_ref()), table.transfer.as_ref()];
        let shading: [Option<&Shading>; 2] = [ghost.and_then(|g| g.shading.as_ref()), table.shading.as_ref()];
        let mut scene = Self {
            transfer: first(transfer).or_else(|| self.transfer.clone()),
            shading: first(shading).or_else(|| self.shading.clone()),
            styles: self.styles_of(object, ghost.is_some(), &|key| self.given.contains(key)),
            volume: self.volume_of(table),
            objects: Vec::new(),
            combine: None,
            intersections: Vec::new(),
            stipples: None,
            hatching: None,
            outlines: None,
            surface: None,
            meshes: Vec::new(),
            ..self.clone()
        };
        let own = match role {
            Role::Selection => PartName::Selection(table.name.clone()),
            Role::Ghost => PartName::Ghost(table.name.clone()),
        };
        scene.keep_for(&own);
        scene
    }

    /// The scene of the background: without objects, and with the planes that cut it.
    pub fn of_background(&self) -> Self {
        let mut scene = Self { objects: Vec::new(), combine: None, intersections: Vec::new(), ..self.clone() };
        scene.keep_for(&PartName::Background);
        scene
    }

    /// Keeps the clip planes and the halos that act on a part.
    fn keep_for(&mut self, part: &PartName) {
        self.clips.retain(|clip| clip.applies.is_empty() || clip.applies.contains(part));
        self.halos.retain(|halo| halo.object.as_ref().is_none_or(|object| object == part));
    }

    /// The styles of a part: name by name, those of the ghost over the object's over the picture's.
    /// A theme replaces another if the scene says it.
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
        let Some(path) = &object.volume else { return self.volume.clone() };
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

fn first<T: Clone>(tables: [Option<&T>; 2]) -> Option<T> {
    tables.into_iter().flatten().next().cloned()
}
