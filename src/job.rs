//! Jobs: a scene with all its data loaded, ready for the renderer.
//!
//! ```
//! use drypoint::job::Job;
//! use drypoint::scene::file::{Overrides, parse};
//!
//! let text = r##"
//! drypoint = 1
//! [volume]
//! phantom = { name = "torus", size = 24 }
//! [picture]
//! size = [32, 24]
//! [transfer]
//! nodes = [{ at = 100, style = "wax", opacity = 0 }, { at = 150, style = "wax", opacity = 1 }]
//! "##;
//! let scene = parse(text, "torus.toml".as_ref(), &Overrides::default())?;
//! let job = Job::load(scene)?;
//! let (picture, counts) = job.renderer()?.frame(&|_share| ());
//! assert_eq!((picture.width, picture.height), (32, 24));
//! assert!(counts.gradients > 0 && counts.hessians == 0);
//!
//! let path = std::env::temp_dir().join(format!("drypoint-torus-{}.png", std::process::id()));
//! job.write(&picture, &path)?;
//! # std::fs::remove_file(&path)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod assets;
mod bare_scene;
mod failures;
mod focus;
mod interaction;
mod iso;
mod load;
mod objects;
mod painting;
mod parts;
mod provenance;
mod room;
mod target;
mod value_colors;

use crate::labels::SceneLabels;
use crate::{Failure, Failures, Format};
use assets::Assets;
pub use bare_scene::{bare, bare_for};
use drypoint_output::{exr, png};
use drypoint_reference::ray::{RenderError, Renderer};
use drypoint_scene::backdrop::Backdrop;
use drypoint_scene::color::{Rgba, premultiply};
use drypoint_scene::counts::Counts;
use drypoint_scene::glam::DVec3;
use drypoint_scene::inputs::Inputs;
use drypoint_scene::marks::{Page, Pen};
use drypoint_scene::mesh::TriangleMesh;
use drypoint_scene::phantom::Phantom;
use drypoint_scene::picture::{LayerKind, Picture};
use drypoint_scene::plan::{NodesPlan, Pass, Plan};
use drypoint_scene::shot::{Shot, VolumeFacts};
use drypoint_scene::source::{Disk, Source};
use drypoint_scene::style::Style;
use drypoint_scene::tables::{
    Background, Ids, ObjectTable, PartName, RaysPerPixel, Role, Scene, StepAlong, VolumeTable,
};
use drypoint_scene::transfer::Function;
use drypoint_scene::view::{View, ViewError};
use drypoint_scene::volume::Volume;
use drypoint_scene::volume::labels::{LabelNames, LabelVolume};
use failures::view_failure;
pub(crate) use failures::{render_failure, shot_failure};
use iso::find_iso_values;
pub(crate) use load::known_label;
pub use load::read_volume;
use load::{background, lighting_table, load_volume, meshes, named, styles};
use objects::{Given, Objects};
pub use painting::Painting;
pub(crate) use provenance::{figure_provenance, provenance};
pub(crate) use room::{no_room_for_pixels, room, room_for_passes, room_for_picture};
use room::{room_for_halos, room_for_table};
use std::num::NonZeroUsize;
use std::path::Path;
use std::sync::Arc;
pub use target::RenderTarget;
use target::{calls_for_function, plan_for, something_is_drawn, values_of_nodes};

/// A scene with all its data.
pub struct Job {
    /// The scene. A transfer function without nodes has those suggested from the data, and foci of halos are points of the
    /// world.
    pub scene: Scene,
    /// The plan of the scene as given.
    pub plan: Plan,
    /// The volume.
    pub volume: Arc<Volume>,
    /// Counts of loading, such as voxels read for an automatic function. They are no part of a frame's counts.
    pub counts: Counts,
    target: RenderTarget,
    /// The source of the files that the scene names.
    pub(crate) source: Arc<dyn Source>,
    /// The scene's camera in numbers.
    view: Result<View, ViewError>,
    /// The data that the material names, and the function of the volume or of the colours of dots.
    pub(crate) assets: Assets,
    /// The meshes that the scene names, in the world.
    pub(crate) meshes: Vec<TriangleMesh>,
    /// The premultiplied picture behind the volume, if the scene has one.
    pub(crate) background: Option<Vec<Rgba>>,
    pub(crate) objects: Objects,
    /// The names of the labels of `[volume]`, if annotations ask for them.
    pub(crate) label_names: LabelNames,
}

/// A job's scene with other settings of knobs, or as a frame of `[orbit]` sees it, and its plan.
pub struct SceneVariant {
    /// The scene.
    pub scene: Scene,
    /// The plan.
    pub plan: Plan,
    function: Option<Arc<Function>>,
    /// The camera; none: the job's.
    view: Option<View>,
}

impl Job {
    /// Loads the volume, the styles and the background of a scene from the disk. A transfer function without nodes is
    /// found from the data.
    ///
    /// # Errors
    /// Data that cannot be read or do not exist, or a scene that draws nothing.
    pub fn load(scene: Scene) -> Result<Self, Failures> {
        Self::load_for(scene, RenderTarget::Picture, Arc::new(Disk))
    }

    /// Loads the part of a scene that `target` needs, as [`Job::load`] does, with the files of `source`.
    ///
    /// # Errors
    /// Same errors as [`Job::load`].
    pub fn load_for(mut scene: Scene, target: RenderTarget, source: Arc<dyn Source>) -> Result<Self, Failures> {
        match load_volume(&*source, &scene.volume, &scene.given) {
            Ok(volume) => Self::with_volume_for(scene, volume, target, source),
            Err(failure) => {
                // Other faults are reported together with the volume's.
                let mut others = Vec::new();
                let plan = plan_for(&scene, target);
                if calls_for_function(&plan, &scene) {
                    styles(&*source, &scene, scene.transfer.iter().flat_map(named), &mut others);
                }
                lighting_table(&*source, &mut scene, &plan, &mut others);
                background(&*source, &scene, target, &mut others);
                Err(Failures::new(failure, others))
            }
        }
    }

    /// Like [`Job::load`], but with a volume that is already loaded.
    ///
    /// # Errors
    /// Same errors as [`Job::load`].
    pub fn with_volume(scene: Scene, volume: impl Into<Arc<Volume>>) -> Result<Self, Failures> {
        Self::with_volume_for(scene, volume, RenderTarget::Picture, Arc::new(Disk))
    }

    /// Like [`Job::load_for`], but with a volume that is already loaded.
    ///
    /// # Errors
    /// Same errors as [`Job::load`].
    pub fn with_volume_for(
        mut scene: Scene,
        volume: impl Into<Arc<Volume>>,
        target: RenderTarget,
        source: Arc<dyn Source>,
    ) -> Result<Self, Failures> {
        let volume = volume.into();
        let given = Given { transfer: scene.transfer.clone(), halos: scene.halos.clone() };
        // The volume, the plan over it, and the plan's warnings of eye and step.
        let volume = match scene.volume.ids {
            Ids::Values => volume,
            Ids::Mask => Arc::new(volume.present()),
        };
        // The plan is of the scene as given: it says that the function was found in the data.
        let mut plan = plan_for(&scene, target);
        plan.settle(&scene, volume.is_integer());
        let view = View::new(&scene.camera, volume.grid(), scene.picture.size);
        if let Ok(view) = &view {
            plan.warn_eye(view, volume.grid());
            plan.warn_contours(&scene, view);
        }
        if let (true, Some(step), Ok(view)) =
            (plan.has_pass(Pass::Rays), scene.sampling.step.world(volume.grid()), &view)
        {
            let stretch = match scene.sampling.step_along {
                StepAlong::Plane => view.largest_stretch(),
                StepAlong::Ray => 1.0,
            };
            plan.warn_step(step * stretch, volume.grid().voxel());
        }
        something_is_drawn(&scene, target)?;
        // Data that the scene names, and settings that it leaves to them. All faults are reported together.
        let (mut counts, mut failures) = (Counts::default(), Vec::new());
        find_iso_values(&mut scene, &plan, &volume, &mut counts);
        let assets = Assets::load(&*source, &mut scene, &mut plan, &volume, None, &mut counts, &mut failures);
        let background = background(&*source, &scene, target, &mut failures);
        let meshes = if plan.has_pass(Pass::Rays) { meshes(&*source, &scene, &mut failures) } else { Vec::new() };
        Failures::check(failures)?;
        let volume = match scene.volume.parts {
            None => volume,
            Some(_) => {
                let volume = Arc::unwrap_or_clone(volume);
                Arc::new(parts::isolate(&scene, assets.function.as_deref(), volume, &mut counts)?)
            }
        };
        let (objects, label_names) = (Objects::default(), LabelNames::default());
        let mut job = Self {
            scene,
            plan,
            volume,
            counts,
            target,
            source,
            view,
            assets,
            meshes,
            background,
            objects,
            label_names,
        };
        if (job.scene.annotations.asks_labels() || job.scene.legend_lists_labels())
            && job.plan.has_pass(Pass::Annotations)
        {
            job.label_names = job.load_labels()?;
        }
        if job.draws_volume() && !job.scene.objects.is_empty() {
            job.objects = Objects::load(&job, &given)?;
            job.plan.warnings.extend(job.objects.warnings(&job.scene));
        }
        job.pick_foci()?;
        Ok(job)
    }

    /// Loads the scene's labels even if no effect reads them, so that each picked place has one. Returns their names.
    ///
    /// # Errors
    /// Labels or names that cannot be read.
    pub fn load_labels(&mut self) -> Result<LabelNames, Failures> {
        let table = &self.scene.volume;
        let unread = table.labels.clone().filter(|_| self.assets.labels.is_none());
        let mut failures = Vec::new();
        let labels = SceneLabels::load(
            &*self.source,
            &VolumeTable { labels: unread, ..table.clone() },
            &self.volume,
            &mut failures,
        );
        Failures::check(failures)?;
        self.assets.labels = labels.volume.or(self.assets.labels.take());
        Ok(labels.names)
    }

    /// Whether the volume itself is drawn, by rays.
    pub fn draws_volume(&self) -> bool {
        self.plan.has_pass(Pass::Rays)
    }

    /// Whether the picture has the layer that points and lines are drawn over.
    pub fn shows_beauty(&self) -> bool {
        let layers = &self.scene.picture.layers;
        !self.draws_volume() || layers.is_empty() || layers.contains(&LayerKind::Beauty)
    }

    /// Returns the part of the scene to draw.
    pub fn target(&self) -> RenderTarget {
        self.target
    }

    /// Returns the transfer function that dots take their colours from, if any.
    pub(crate) fn function(&self) -> Option<&Function> {
        self.assets.function.as_deref()
    }

    /// Returns a style that the transfer function names, if it is loaded.
    pub(crate) fn style(&self, name: &str) -> Option<&Style> {
        self.assets.styles.iter().find(|style| style.name == name)
    }

    /// Returns the values of the nodes of those functions, of the scene and of its objects, that are in another unit.
    pub fn node_values(&self) -> Vec<NodesPlan> {
        let own = values_of_nodes(&self.scene, &self.volume, "transfer.unit".into(), None);
        own.into_iter().chain(self.objects.node_values(&self.scene)).collect()
    }

    /// Returns the corners of the box of a part in world space, x fastest: of the volume, of an object's selection where
    /// it is moved, or of its ghost. `objects` are those of the scene, or of a variant of it. Returns none for objects if
    /// the volume is not drawn.
    pub fn corners(&self, objects: &[ObjectTable], part: &PartName) -> Option<[DVec3; 8]> {
        let (name, role) = match part {
            PartName::Background => return Some(self.volume.grid().world_corners()),
            PartName::Selection(name) => (name, Role::Selection),
            PartName::Ghost(name) => (name, Role::Ghost),
        };
        let object = objects.iter().position(|object| object.name == *name)?;
        self.objects.corners(&objects[object], object, role)
    }

    /// Returns the label volume of `[volume]`, if something reads it.
    pub(crate) fn label_volume(&self) -> Option<&LabelVolume> {
        self.assets.labels.as_ref()
    }

    /// Returns the scene's camera in numbers.
    ///
    /// # Errors
    /// The camera has no direction, or its height is given on the page.
    pub fn view(&self) -> Result<View, Failure> {
        self.view.clone().map_err(|error| view_failure(error, &self.scene))
    }

    /// Returns the shot: the picture of the scene with nothing left to decide.
    ///
    /// # Errors
    /// The volume is not drawn itself, the camera has no direction, or a length has no size.
    pub fn shot(&self) -> Result<Shot, Failure> {
        self.resolve(&self.scene, &self.plan, self.assets.function.as_ref(), self.view()?)
    }

    /// Returns the shot of a coarse frame: of the scene with `picture.size` divided by `n`, rounded up, and one ray a pixel.
    /// Foci and brushes at pixels stay at the points that were seen there. See [`Frames::turn`](crate::frames::Frames::turn).
    ///
    /// # Errors
    /// Same errors as [`Job::shot`].
    pub fn coarse_shot(&self, n: NonZeroUsize) -> Result<Shot, Failure> {
        let mut scene = self.scene.clone();
        scene.picture.size = scene.picture.size.map(|side| side.div_ceil(n.get()));
        scene.picture.samples = RaysPerPixel::Across(1);
        let view = View::new(&scene.camera, self.volume.grid(), scene.picture.size);
        let view = view.map_err(|error| view_failure(error, &scene))?;
        self.resolve(&scene, &self.plan_of(&scene), self.assets.function.as_ref(), view)
    }

    /// Returns a renderer for any number of frames.
    ///
    /// # Errors
    /// The volume is not drawn itself, the reconstruction does not exist, the camera has no direction, or there is no
    /// memory for the picture.
    pub fn renderer(&self) -> Result<Renderer<'_>, Failure> {
        self.made_ready(&self.scene, &self.plan, &self.shot()?, Renderer::new)
    }

    /// Returns another scene over the loaded data. The scene differs from the job's in its knobs alone ([COST-1]).
    pub fn variant(&self, scene: Scene) -> SceneVariant {
        let plan = self.plan_of(&scene);
        let range = scene.volume.range.unwrap_or_else(|| self.volume.range());
        // No knob changes a function of two quantities, labels among them.
        let over_value = scene.transfer.as_ref().filter(|transfer| transfer.rows.is_none());
        let function = over_value.and_then(|t| Function::new(t, range, &self.volume, &|_| None).ok().flatten());
        let function = function.map(Arc::new).or_else(|| self.assets.function.clone());
        SceneVariant { scene, plan, function, view: None }
    }

    /// Returns a renderer of a variant of the scene.
    ///
    /// # Errors
    /// Same errors as [`Job::renderer`].
    pub fn renderer_of(&self, variant: &SceneVariant) -> Result<Renderer<'_>, Failure> {
        self.made_ready(&variant.scene, &variant.plan, &self.shot_of(variant)?, Renderer::new)
    }

    /// Returns a renderer of a phantom's formula in place of the voxels ([COST-2]).
    ///
    /// # Errors
    /// Same errors as [`Job::renderer`].
    pub fn exact_renderer_of<'a>(
        &'a self,
        variant: &SceneVariant,
        phantom: &'a dyn Phantom,
    ) -> Result<Renderer<'a>, Failure> {
        let make = |shot: &Shot, inputs| Renderer::exact(shot, inputs, phantom);
        self.made_ready(&variant.scene, &variant.plan, &self.shot_of(variant)?, make)
    }

    /// Returns the shot of a variant of the scene.
    pub(crate) fn shot_of(&self, variant: &SceneVariant) -> Result<Shot, Failure> {
        let view = variant.view.clone().map_or_else(|| self.view(), Ok)?;
        self.resolve(&variant.scene, &variant.plan, variant.function.as_ref(), view)
    }

    /// Returns the plan of a scene over the loaded data.
    fn plan_of(&self, scene: &Scene) -> Plan {
        let mut plan = plan_for(scene, self.target);
        plan.settle(scene, self.volume.is_integer());
        plan
    }

    fn resolve(
        &self,
        scene: &Scene,
        plan: &Plan,
        function: Option<&Arc<Function>>,
        view: View,
    ) -> Result<Shot, Failure> {
        let Some(function) = function.filter(|_| plan.has_pass(Pass::Rays)) else {
            let what = "the volume itself is not drawn";
            return Err(Failure::new(what, scene.given.position("transfer"), "add a [transfer] table"));
        };
        let facts = VolumeFacts { grid: self.volume.grid(), is_integer: self.volume.is_integer() };
        let shot = Shot::resolve(scene, plan, facts, function.clone(), view);
        let shot = shot.map_err(|error| shot_failure(&error, scene))?;
        let range = scene.volume.range.unwrap_or_else(|| self.volume.range());
        self.objects.add_to(shot, scene, facts, range)
    }

    fn made_ready<'a>(
        &'a self,
        scene: &Scene,
        plan: &Plan,
        shot: &Shot,
        make: impl FnOnce(&Shot, Inputs<'a>) -> Result<Renderer<'a>, RenderError>,
    ) -> Result<Renderer<'a>, Failure> {
        self.room_for_preparing(scene, plan)?;
        let renderer = make(shot, self.inputs(shot)).map_err(|error| render_failure(&error, scene))?;
        room_for_picture(scene, renderer.bytes_of_refinement())?;
        room_for_halos(scene, renderer.bytes_of_halos())?;
        Ok(renderer)
    }

    /// Checks that there is memory for the passes over voxels and for the table of the function.
    pub(crate) fn room_for_preparing(&self, scene: &Scene, plan: &Plan) -> Result<(), Failure> {
        room_for_passes(scene, &self.volume, plan)?;
        room_for_table(scene)
    }

    /// Returns the data that a shot names, for a renderer.
    pub fn inputs(&self, shot: &Shot) -> Inputs<'_> {
        Inputs {
            meshes: &self.meshes,
            ..self.objects.inputs(shot, Inputs::of(self.assets.of(&self.volume), self.backdrop(shot)))
        }
    }

    /// Returns the volumes of [`Shot::objects`], in their order.
    #[cfg(feature = "gpu")]
    pub(crate) fn volumes(&self, shot: &Shot) -> impl Iterator<Item = &Arc<Volume>> {
        std::iter::once(&self.volume).chain(self.objects.volumes(shot))
    }

    /// Returns the background of the volume.
    pub(crate) fn backdrop(&self, shot: &Shot) -> Backdrop<'_> {
        match (&self.background, &shot.background) {
            (Some(pixels), _) => Backdrop::Pixels(pixels),
            (None, Background::Color(color)) => Backdrop::Color(*color),
            (None, _) => Backdrop::None,
        }
    }

    /// Whether a picture of this job shows only its background.
    pub fn shows_nothing(&self, picture: &Picture) -> bool {
        /// Largest error of a mean of equal colours, encoded and decoded.
        const ROUNDING: f64 = 1e-9;
        let Some(layer) = picture.layer(LayerKind::Beauty) else { return false };
        (0..picture.width * picture.height).all(|i| {
            let behind = match (&self.background, &self.scene.picture.background) {
                (Some(pixels), _) => pixels[i],
                (None, Background::Color(color)) => premultiply(*color),
                (None, _) => [0.0; 4],
            };
            layer.channels.iter().zip(behind).all(|(channel, behind)| (channel[i] - behind).abs() <= ROUNDING)
        })
    }

    /// Writes a picture of this job as PNG or EXR, by the suffix. The file appears whole or not at all.
    ///
    /// # Errors
    /// A suffix of no picture format, or errors of the operating system.
    pub fn write(&self, picture: &Picture, path: &Path) -> Result<(), Failure> {
        let provenance = self.provenance();
        let written = match Format::among(path, &Format::PICTURES)? {
            Format::Exr => exr::write_exr(picture, &provenance, path),
            _ => png::write_png(picture, self.scene.picture.bits, &provenance, path),
        };
        written.map_err(|error| Failure::picture(&error, path.display()))
    }
}

/// Returns the colour behind the volume, if it is one.
pub(crate) fn background_color(scene: &Scene) -> Option<Rgba> {
    match scene.picture.background {
        Background::Color(color) => Some(color),
        Background::None | Background::Picture(_) => None,
    }
}

/// Returns the pen of `[[pen]]` that `key` names.
pub(crate) fn pen_named(scene: &Scene, page: &Page, name: &str, key: &str) -> Result<Pen, Failure> {
    Pen::of(&scene.pens, page).into_iter().find(|pen| pen.name == name).ok_or_else(|| {
        let names: Vec<&str> = scene.pens.iter().map(|pen| pen.name.as_str()).collect();
        let remedy = match names.as_slice() {
            [] => "add a table [[pen]] with that name".into(),
            names => format!("write one of {}", names.join(", ")),
        };
        Failure::new(format!("there is no pen {name:?}"), scene.given.position(key), remedy)
    })
}
