//! The objects of a job: their data, selections and looks ([VS-2]).

use super::assets::Assets;
use super::room::room_for_parts;
use super::target::{RenderTarget, plan_for, something_is_drawn, values_of_nodes};
use super::{Job, shot_failure};
use crate::labels::SceneLabels;
use crate::{Failure, Failures};
use drypoint_output::read::read_intersection_picture;
use drypoint_scene::counts::Counts;
use drypoint_scene::glam::DVec3;
use drypoint_scene::inputs::Inputs;
use drypoint_scene::intersection_picture::IntersectionPicture;
use drypoint_scene::plan::{NodesPlan, Plan};
use drypoint_scene::shot::{PartFacts, SelectionFacts, Shot, VolumeFacts};
use drypoint_scene::source::Source;
use drypoint_scene::space::Grid;
use drypoint_scene::tables::{Halo, IntersectionColor, LabelKey, Motion, ObjectTable, Role, Scene, Transfer};
use drypoint_scene::transfer::Function;
use drypoint_scene::view::View;
use drypoint_scene::volume::{Anatomy, Selection, Volume, read, selected_by_value};
use std::sync::Arc;

/// The objects of a job.
#[derive(Default)]
pub(crate) struct Objects {
    /// Selections and ghosts, in the order of [`Scene::parts_of_frames`].
    parts: Vec<ObjectPart>,
    /// The selection volume of each object that has one.
    selections: Vec<Option<Selection>>,
    facts: Vec<SelectionFacts>,
    /// The picture of each intersection whose colour is one, in the order of the tables.
    pictures: Vec<Option<IntersectionPicture>>,
}

/// A selection or a ghost with all data that its function and its material name.
struct ObjectPart {
    object: usize,
    role: Role,
    /// Its tables ([`Scene::of_part`]), with automatic functions and label ids resolved.
    tables: Scene,
    volume: Arc<Volume>,
    assets: Assets,
    /// The grid of its data in the world of `[volume]`.
    grid: Grid,
}

/// Tables of the picture's scene before they are resolved, for objects with data of their own.
pub(super) struct Given {
    /// The function. An automatic one is found from the objects' own data.
    pub(super) transfer: Option<Transfer>,
    /// The halos. Names of labels are those of the objects' own data.
    pub(super) halos: Vec<Halo>,
}

impl Objects {
    /// Loads the objects of a job whose other data are loaded.
    ///
    /// # Errors
    /// Data cannot be read, a part draws nothing, or its function or material is faulty.
    pub(super) fn load(main: &Job, given: &Given) -> Result<Self, Failures> {
        let (scene, volume, source) = (&main.scene, &main.volume, &*main.source);
        let mut own: Vec<Option<Arc<Volume>>> = Vec::new();
        let mut failures = Vec::new();
        for (i, object) in scene.objects.iter().enumerate() {
            let read = object.volume.as_ref().map(|path| read::read_part(source, path, None, &read::all_voxels));
            own.push(read.and_then(|read| match read {
                Ok(volume) => Some(Arc::new(volume)),
                Err(error) => {
                    let key = format!("object[{i}].volume");
                    failures.push(Failure::of_file(&error, scene.given.position(&key)));
                    None
                }
            }));
        }
        Failures::check(std::mem::take(&mut failures))?;
        let data = |object: usize| own[object].as_ref().unwrap_or(volume);
        // Selections, and what only voxels can tell of them.
        let (mut selections, mut facts) = (Vec::new(), Vec::new());
        for (i, object) in scene.objects.iter().enumerate() {
            let selection = match object.strokes {
                Some(_) => Some(main.paint(i)?.selection),
                None => selection(source, scene, (i, object), data(i), &mut failures),
            };
            facts.push(selection_facts(object, selection.as_ref(), data(i), volume.anatomy()));
            selections.push(selection);
        }
        let pictures = scene.intersections.iter().enumerate().map(|(i, table)| {
            let IntersectionColor::Picture(path) = &table.color else { return None };
            let failed = |error: drypoint_output::OutputError| {
                Failure::new(&error, scene.given.position(&format!("intersection[{i}].color")), error.help())
            };
            read_intersection_picture(source, path).map_err(|error| failures.push(failed(error))).ok()
        });
        let pictures = pictures.collect();
        Failures::check(std::mem::take(&mut failures))?;
        room_for_parts(scene)?;
        let mut parts = Vec::new();
        for (object, role) in scene.parts_of_frames() {
            let table = &scene.objects[object];
            let mut tables = match table.volume {
                None => scene.of_part(object, role),
                Some(_) => Scene { halos: given.halos.clone(), ..scene.clone() }.of_part(object, role),
            };
            let has_function = table.transfer.is_some() || table.ghost.as_ref().is_some_and(|g| g.transfer.is_some());
            if table.volume.is_some() && !has_function {
                tables.transfer.clone_from(&given.transfer);
            }
            something_is_drawn(&tables, RenderTarget::Picture)?;
            let volume = data(object).clone();
            let mut plan = plan_for(&tables, RenderTarget::Picture);
            plan.settle(&tables, volume.is_integer());
            let (main_grid, counts) = (Some(main.volume.grid()), &mut Counts::default());
            let assets = Assets::load(source, &mut tables, &mut plan, &volume, main_grid, counts, &mut failures);
            Failures::check(std::mem::take(&mut failures))?;
            let grid = Anatomy::between(volume.grid(), volume.anatomy(), main.volume.anatomy());
            parts.push(ObjectPart { object, role, tables, volume, assets, grid });
        }
        Ok(Self { parts, selections, facts, pictures })
    }

    /// Returns the parts that are drawn if `is_moved` tells which objects are moved: only these have ghosts.
    fn drawn(&self, is_moved: impl Fn(usize) -> bool) -> impl Iterator<Item = &ObjectPart> {
        self.parts.iter().filter(move |part| part.role == Role::Selection || is_moved(part.object))
    }

    /// Returns the parts of a shot.
    fn of_shot<'a>(&'a self, shot: &Shot) -> impl Iterator<Item = &'a ObjectPart> {
        let combination = shot.combination.iter();
        combination.flat_map(|all| self.drawn(|object| all.selections[object].motion.is_some()))
    }

    /// The volumes of a shot's parts.
    #[cfg(feature = "gpu")]
    pub(super) fn volumes<'a>(&'a self, shot: &Shot) -> impl Iterator<Item = &'a Arc<Volume>> {
        self.of_shot(shot).map(|part| &part.volume)
    }

    /// Moves a selection by M' of another camera ([VS-9]).
    pub(super) fn follow(&self, object: usize, table: &mut ObjectTable, cameras: [&View; 2]) {
        if let Some(facts) = self.facts.get(object) {
            let centre = facts.centre();
            table.motion = Motion::of(table.interaction.motion(table.motion.map(centre), centre, cameras));
        }
    }

    /// Returns the corners of the box of an object in world space, x fastest: of its ghost, or of its selection where it
    /// is moved.
    pub(super) fn corners(&self, table: &ObjectTable, object: usize, role: Role) -> Option<[DVec3; 8]> {
        let facts = self.facts.get(object)?;
        let corners = facts.corners();
        Some(match role {
            Role::Ghost => corners,
            Role::Selection => {
                let motion = table.motion.map(facts.centre());
                corners.map(|corner| motion.transform_point3(corner))
            }
        })
    }

    /// Warnings of objects that select nothing.
    pub(super) fn warnings(&self, scene: &Scene) -> impl Iterator<Item = String> {
        // A selection by value has values between voxels, too.
        let is_empty =
            |(table, facts): &(&ObjectTable, &SelectionFacts)| table.value.is_none() && facts.index_box.is_none();
        let empty = scene.objects.iter().zip(&self.facts).filter(is_empty);
        empty.map(|(object, _)| format!("the object {:?} selects nothing", object.name))
    }

    /// Returns the values of the nodes of functions that are not the picture's in its own data, each function once.
    pub(super) fn node_values(&self, scene: &Scene) -> Vec<NodesPlan> {
        let mut found = Vec::new();
        for part in &self.parts {
            let key = scene.key_of_part(part.object, part.role, "transfer.unit");
            let has_function = key != "transfer.unit";
            let within = (!has_function && scene.objects[part.object].volume.is_some()).then_some(part.object);
            if has_function || within.is_some() {
                found.extend(values_of_nodes(&part.tables, &part.volume, key, within));
            }
        }
        // A ghost may share its selection's function.
        found.dedup();
        found
    }

    /// Adds the objects to the shot of a scene that differs from the job's only in its knobs and in M.
    pub(super) fn add_to(
        &self,
        shot: Shot,
        scene: &Scene,
        main: VolumeFacts<'_>,
        range: [f64; 2],
    ) -> Result<Shot, Failure> {
        if scene.objects.is_empty() || self.parts.is_empty() {
            return Ok(shot);
        }
        let parts = || self.drawn(|object| scene.objects[object].motion.is_moved());
        let scenes: Vec<(Scene, Plan)> = parts().map(|part| part.scene_of(scene)).collect();
        let facts = parts().zip(&scenes).map(|(part, (scene, plan))| PartFacts {
            scene,
            plan,
            function: part.assets.function.clone().unwrap_or_else(|| Arc::new(Function::nothing())),
            grid: &part.grid,
            is_integer: part.volume.is_integer(),
            range: part.tables.volume.range.unwrap_or_else(|| part.volume.range()),
        });
        let facts: Vec<PartFacts<'_>> = facts.collect();
        shot.with_objects(scene, main, range, &self.facts, &facts).map_err(|error| shot_failure(&error, scene))
    }

    /// Adds the objects' data that a shot names to the data of its main volume.
    pub(super) fn inputs<'a>(&'a self, shot: &Shot, inputs: Inputs<'a>) -> Inputs<'a> {
        let Some(combination) = shot.combination.as_ref() else { return inputs };
        Inputs {
            parts: self.of_shot(shot).map(|part| part.assets.of(&part.volume)).collect(),
            selections: self.selections.iter().map(Option::as_ref).collect(),
            pictures: combination.intersections.iter().map(|table| self.pictures[table.table].as_ref()).collect(),
            ..inputs
        }
    }
}

impl ObjectPart {
    /// The part's scene with the settings of the picture's scene, and its plan.
    fn scene_of(&self, scene: &Scene) -> (Scene, Plan) {
        let mut of_part = scene.of_part(self.object, self.role);
        of_part.transfer = self.tables.transfer.clone();
        // The labels are ids of its own data.
        for (halo, own) in of_part.halos.iter_mut().zip(&self.tables.halos) {
            halo.seed.labels.clone_from(&own.seed.labels);
        }
        if scene.has_own_shading(self.object, self.role) {
            // Its table has been read.
            of_part.shading = self.tables.shading.clone();
        } else if let (Some(shading), Some(read)) = (&mut of_part.shading, &self.tables.shading) {
            // The picture itself may be lit by no table.
            shading.table = read.table.clone();
        }
        let mut plan = plan_for(&of_part, RenderTarget::Picture);
        plan.add_meetings(scene, self.object, self.role);
        plan.settle(&of_part, self.volume.is_integer());
        (of_part, plan)
    }
}

/// The selection volume of an object. Returns none if the object has none.
fn selection(
    source: &dyn Source,
    scene: &Scene,
    (i, object): (usize, &ObjectTable),
    data: &Volume,
    failures: &mut Vec<Failure>,
) -> Option<Selection> {
    let at = |key: &str| scene.given.position(&format!("object[{i}].{key}"));
    let no_room = |no_room, key| Failure::new(format!("the selection needs {no_room}"), at(key), "select less");
    if let Some(path) = &object.selection {
        let volume = read::read_part(source, path, None, &read::all_voxels);
        let volume = volume.map_err(|error| Failure::of_file(&error, at("selection")));
        let selection =
            volume.and_then(|volume| Selection::from_volume(&volume).map_err(|error| no_room(error, "selection")));
        return selection.map_err(|failure| failures.push(failure)).ok();
    }
    let keys = object.label.as_ref()?;
    let table = scene.of_part(i, Role::Selection).volume;
    let labels = SceneLabels::load(source, &table, data, failures);
    let volume = labels.volume?;
    let mut ids = Vec::new();
    for key in keys {
        match key {
            LabelKey::Id(id) => ids.push(*id),
            LabelKey::Name(name) => match labels.names.id(name) {
                Some(id) => ids.push(id),
                None => {
                    let remedy = super::load::known_label(name, &labels.names);
                    failures.push(Failure::new(format!("there is no label {name:?}"), at("label"), remedy));
                }
            },
        }
    }
    Selection::from_labels(&volume, &ids).map_err(|error| failures.push(no_room(error, "label"))).ok()
}

/// The grid of an object's memberships in a world of the anatomical directions `world`, and the box of [VS-2].
fn selection_facts(
    object: &ObjectTable,
    selection: Option<&Selection>,
    data: &Volume,
    world: Option<Anatomy>,
) -> SelectionFacts {
    let of_data = || Anatomy::between(data.grid(), data.anatomy(), world);
    match (selection, &object.value) {
        (Some(selection), _) => {
            let grid = selection.grid_in(world);
            let index_box = selection.index_box().map(|ends| grid.voxel_box(ends));
            SelectionFacts { grid, index_box }
        }
        (None, Some(pairs)) => {
            let grid = of_data();
            let index_box = selected_by_value(data, pairs).map(|ends| grid.voxel_box(ends));
            SelectionFacts { grid, index_box }
        }
        (None, None) => {
            let grid = of_data();
            SelectionFacts { index_box: Some(grid.index_box()), grid }
        }
    }
}
