//! From a scene to a picture: load what the scene names, hand it to the renderer, write what comes back.
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

use crate::labels::Named;
use crate::{Failure, Failures, Format, memory};
use drypoint_output::read::read_background;
use drypoint_output::{OutputError, exr, png};
use drypoint_reference::field::FieldError;
use drypoint_reference::ray::{Backdrop, Inputs, RenderError, Renderer};
use drypoint_reference::suggest;
use drypoint_scene::color::{Rgba, premultiply};
use drypoint_scene::counts::Counts;
use drypoint_scene::file::{Given, identity};
use drypoint_scene::phantom::{self, Phantom, PhantomError};
use drypoint_scene::picture::{LayerKind, Picture, Provenance};
use drypoint_scene::plan::{Pass, Plan, Quantity};
use drypoint_scene::style::{Style, StyleError, load as load_styles};
use drypoint_scene::tables::{
    Axis, Background, Ids, Iso, NodeColor, Scene, StepAlong, Transfer, VolumeSource, VolumeTable,
};
use drypoint_scene::transfer::{Function, FunctionError};
use drypoint_scene::view::{View, ViewError};
use drypoint_scene::volume::labels::{LabelNames, LabelVolume};
use drypoint_scene::volume::{Volume, read};
use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};

/// A scene with everything that it names.
pub struct Job {
    /// The scene. A transfer function without nodes has those that were found in the data.
    pub scene: Scene,
    /// What the scene called for, as it was given.
    pub plan: Plan,
    /// Its volume.
    pub volume: Volume,
    /// What was done to load it: voxels that an automatic function looked at. Not among the counts of a frame.
    pub counts: Counts,
    function: Function,
    labels: Option<LabelVolume>,
    further: [Option<Volume>; 2],
    styles: Vec<Style>,
    background: Option<Vec<Rgba>>,
}

/// A scene with other knobs, and what follows from them.
pub struct Turned {
    /// The scene.
    pub scene: Scene,
    /// What it calls for.
    pub plan: Plan,
    function: Function,
}

impl Job {
    /// Loads the volume, the styles and the background of a scene. A transfer function without nodes is found from the
    /// data.
    ///
    /// # Errors
    /// All that cannot be read, does not exist, or draws nothing.
    pub fn load(scene: Scene) -> Result<Self, Failures> {
        match load_volume(&scene.volume, &scene.given) {
            Ok(volume) => Self::with_volume(scene, volume),
            Err(failure) => {
                // What else is wrong does not wait for the volume.
                let mut others = Vec::new();
                styles(&scene, scene.transfer.iter().flat_map(named), &mut others);
                background(&scene, &mut others);
                Err(Failures::new(failure, others))
            }
        }
    }

    /// The same for a volume that is already loaded.
    ///
    /// # Errors
    /// As [`Job::load`].
    pub fn with_volume(mut scene: Scene, volume: Volume) -> Result<Self, Failures> {
        let volume = match scene.volume.ids {
            Ids::Values => volume,
            Ids::Mask => volume.present(),
        };
        // Of the scene as it was given: that its function was found in the data is part of the plan.
        let mut plan = Plan::new(&scene);
        plan.settle(&scene, is_integer(&volume));
        if let (Some(step), Ok(view)) =
            (scene.sampling.step.world(volume.grid()), View::new(&scene.camera, volume.grid(), scene.picture.size))
        {
            let stretch = match scene.sampling.step_along {
                StepAlong::Plane => view.largest_stretch(),
                StepAlong::Ray => 1.0,
            };
            plan.warn_step(step * stretch, volume.grid().voxel());
        }
        if scene.stipples.is_some() {
            let what = "stipples are not drawn into a rendered picture yet ([STIP-16])";
            let remedy = "draw them with `drypoint points`, or remove the table [stipples]";
            return Err(Failure::new(what, scene.given.position("stipples"), remedy).into());
        }
        let mut failures = Vec::new();
        let reads_labels = plan.needs(Quantity::Label) || plan.needs(Quantity::LabelDistance);
        let labels = if reads_labels { Named::load(&scene.volume, &mut failures) } else { Named::default() };
        plan.warnings.extend(labels.warning(&scene.volume, &volume));
        if scene.transfer.is_none() && !plan.needs(Quantity::Surface) {
            let place = scene.given.position("transfer");
            let remedy = "add a [transfer] table, or a [surface] with a look";
            return Err(Failure::new("the scene draws nothing", place, remedy).into());
        }
        let mut counts = Counts::default();
        if let Some(transfer) = scene.transfer.as_mut().filter(|transfer| transfer.is_automatic()) {
            suggest::fill_function(transfer, &volume, scene.volume.outside, &mut counts);
        }
        if let Some(surface) = scene.surface.as_mut().filter(|_| plan.has_pass(Pass::AutomaticIso)) {
            surface.iso = Iso::Value(suggest::iso(&volume, &scene.volume, &mut counts));
        }
        let range = scene.volume.range.unwrap_or_else(|| volume.range());
        let found = match &scene.transfer {
            Some(transfer) => Function::new(transfer, range, &volume, &|name| labels.names.id(name)),
            None => Ok(Some(Function::nothing())),
        };
        let function = found.unwrap_or_else(|errors| {
            // Without the table every name would be unknown.
            if failures.is_empty() {
                failures.extend(errors.iter().map(|error| function_failure(error, &scene.given, &labels.names)));
            }
            None
        });
        let styles = match &function {
            Some(Function::Style { names, .. }) => styles(&scene, names.iter().map(String::as_str), &mut failures),
            Some(Function::Regular(_)) => Vec::new(),
            None => styles(&scene, scene.transfer.iter().flat_map(named), &mut failures),
        };
        let background = background(&scene, &mut failures);
        let further = further(&scene, &mut failures);
        Failures::check(failures)?;
        let Some(function) = function else {
            let place = scene.given.position("transfer.nodes");
            return Err(Failure::new("the transfer function has no node", place, "give it at least one").into());
        };
        Ok(Self { scene, plan, volume, counts, function, labels: labels.volume, further, styles, background })
    }

    /// The scene made ready for any number of frames.
    ///
    /// # Errors
    /// A reconstruction that does not exist, a camera without direction, a picture for which there is no memory.
    pub fn renderer(&self) -> Result<Renderer<'_>, Failure> {
        self.made_ready(&self.scene, &self.plan, &self.function, Renderer::new)
    }

    /// Another scene over what this one has loaded: one that differs in its knobs alone ([COST-1]).
    pub fn turned(&self, scene: Scene) -> Turned {
        let plan = self.plan_of(&scene);
        let range = scene.volume.range.unwrap_or_else(|| self.volume.range());
        // Over two quantities, labels among them, no knob changes the function.
        let over_value = scene.transfer.as_ref().filter(|transfer| transfer.rows.is_none());
        let function = over_value.and_then(|t| Function::new(t, range, &self.volume, &|_| None).ok().flatten());
        Turned { function: function.unwrap_or_else(|| self.function.clone()), scene, plan }
    }

    /// The same with other knobs.
    ///
    /// # Errors
    /// As [`Job::renderer`].
    pub fn renderer_of<'a>(&'a self, turned: &'a Turned) -> Result<Renderer<'a>, Failure> {
        self.made_ready(&turned.scene, &turned.plan, &turned.function, Renderer::new)
    }

    /// The same of a phantom's own formula in place of the voxels ([COST-2]).
    ///
    /// # Errors
    /// As [`Job::renderer`].
    pub fn exact_renderer_of<'a>(
        &'a self,
        turned: &'a Turned,
        phantom: &'a dyn Phantom,
    ) -> Result<Renderer<'a>, Failure> {
        let make = |inputs| Renderer::exact(inputs, phantom);
        self.made_ready(&turned.scene, &turned.plan, &turned.function, make)
    }

    /// The plan of a scene over what this job has loaded.
    fn plan_of(&self, scene: &Scene) -> Plan {
        let mut plan = Plan::new(scene);
        plan.settle(scene, is_integer(&self.volume));
        plan
    }

    fn made_ready<'a>(
        &'a self,
        scene: &'a Scene,
        plan: &'a Plan,
        function: &'a Function,
        make: impl FnOnce(Inputs<'a>) -> Result<Renderer<'a>, RenderError>,
    ) -> Result<Renderer<'a>, Failure> {
        let background = match (&self.background, &scene.picture.background) {
            (Some(pixels), _) => Backdrop::Pixels(pixels),
            (None, Background::Color(color)) => Backdrop::Color(*color),
            (None, _) => Backdrop::None,
        };
        let inputs = Inputs {
            scene,
            plan,
            volume: &self.volume,
            function,
            labels: self.labels.as_ref(),
            further: self.further.each_ref().map(Option::as_ref),
            styles: &self.styles,
            background,
        };
        room_for_passes(self, plan)?;
        let renderer = make(inputs).map_err(|error| {
            let (key, remedy) = match &error {
                RenderError::Field(FieldError::NotSmooth { .. }) => {
                    ("sampling.hessian", "choose another sampling.kernel or sampling.hessian")
                }
                RenderError::Field(FieldError::TooLarge { .. }) => ("sampling.number", "write \"f64\""),
                RenderError::Field(FieldError::Scale { .. }) => ("sampling.scale", "make it smaller, or leave it out"),
                RenderError::View(ViewError::HeightOnPage) => ("camera.height", "give it in world units or in voxels"),
                RenderError::View(ViewError::NoDirection) => {
                    ("camera", "move camera.eye away from camera.target, or give camera.direction")
                }
                RenderError::TooManyPlanes { .. } => ("sampling.step", "make it longer, or move the camera nearer"),
                RenderError::Nodes(_) => ("transfer.nodes", "give them in ascending order, with opacities in [0, 1]"),
                RenderError::NoFurtherVolume => ("transfer.over", "hand over the volume that it names"),
                RenderError::NoLabels => ("transfer.over", "name a label volume with volume.labels"),
                RenderError::NoSuchLabel { .. } => ("transfer.over", "name a label that the label volume has"),
                RenderError::Length { key } => (*key, "give it in world units or in voxels"),
                RenderError::Styles { .. } => ("styles", "hand over one style for each name"),
            };
            Failure::new(&error, scene.given.position(key), remedy)
        })?;
        // Of what is left: the picture's channels, and as much again while they are encoded.
        let channels: usize = scene.picture.layers.iter().map(|layer| layer.channels().len()).sum();
        room(scene, 2 * 8 * channels)?;
        Ok(renderer)
    }

    /// Whether a picture of this job shows what lies behind the volume and nothing else.
    pub fn shows_nothing(&self, picture: &Picture) -> bool {
        /// What a mean of equal colours, encoded and decoded, can be off by.
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

    /// What a picture of this job says of its origin ([IO-2]): two files that say the same scene give the same.
    pub fn provenance(&self) -> Provenance {
        provenance(&self.scene, &self.plan_of(&self.scene))
    }

    /// Writes a picture of this job, as PNG or EXR by the suffix. The file appears whole or not at all.
    ///
    /// # Errors
    /// A suffix of no format, or what the operating system refuses.
    pub fn write(&self, picture: &Picture, path: &Path) -> Result<(), Failure> {
        let provenance = self.provenance();
        let written = match Format::of(path)? {
            Format::Png => png::write_png(picture, self.scene.picture.bits, &provenance, path),
            Format::Exr => exr::write_exr(picture, &provenance, path),
        };
        written.map_err(|error| Failure::picture(&error, path.display()))
    }
}

/// What a picture of a scene says of its origin ([IO-2]).
pub(crate) fn provenance(scene: &Scene, plan: &Plan) -> Provenance {
    Provenance {
        software: concat!("drypoint ", env!("CARGO_PKG_VERSION")).into(),
        scene_hash: Sha256::digest(identity(scene)).iter().map(|byte| format!("{byte:02x}")).collect(),
        plan: plan.summary(),
    }
}

/// A scene for a bare volume: an automatic function, a camera that frames the content in a picture of `size` pixels, a
/// pleasant style. What was looked at for it goes to `counts`.
pub fn bare(path: PathBuf, volume: &Volume, size: [usize; 2], counts: &mut Counts) -> Scene {
    suggest::scene(VolumeSource::File { path, raw: None }, volume, size, counts)
}

/// Whether a volume's file is of integers ([REC-3]).
fn is_integer(volume: &Volume) -> bool {
    volume.voxels().voxel_type().is_integer()
}

/// Whether there is memory for so many bytes a pixel.
fn room(scene: &Scene, bytes: usize) -> Result<(), Failure> {
    let [width, height] = scene.picture.size;
    let needed = [width, height, bytes].into_iter().fold(1u64, |product, n| product.saturating_mul(n as u64));
    memory::room(needed).map_err(|no_room| {
        let what = format!("a picture of {width} × {height} pixels needs {no_room}");
        Failure::new(what, scene.given.position("picture.size"), "make it smaller, or ask for fewer layers")
    })
}

/// Whether there is memory for what is made of every voxel before the rays.
fn room_for_passes(job: &Job, plan: &Plan) -> Result<(), Failure> {
    let voxels = job.volume.dims().into_iter().fold(1u64, |product, n| product.saturating_mul(n as u64));
    let each = plan.passes.iter().map(|need| (need, voxels.saturating_mul(need.pass.bytes_a_voxel())));
    // One after another they are kept, so together they have to fit.
    let mut needed = 0u64;
    for (need, bytes) in each {
        needed = needed.saturating_add(bytes);
        memory::room(needed).map_err(|no_room| {
            let [nx, ny, nz] = job.volume.dims();
            let (effect, pass) = (&need.effect, need.pass.name());
            let what = format!("{effect}: {pass} of {nx} × {ny} × {nz} voxels need {no_room}");
            let remedy = "leave out what asks for it (`drypoint plan` shows what does), or make the volume smaller";
            Failure::new(what, job.scene.given.position(&need.key), remedy)
        })?;
    }
    Ok(())
}

/// Reads or generates a scene's volume.
pub(crate) fn load_volume(table: &VolumeTable, given: &Given) -> Result<Volume, Failure> {
    match &table.source {
        VolumeSource::File { path, raw } => read::read(path, raw.as_ref()).map_err(Failure::from),
        VolumeSource::Phantom(source) => phantom::generate(source).map_err(|error| {
            let remedy = match &error {
                PhantomError::Memory { .. } => "ask for fewer voxels with volume.phantom.size",
                PhantomError::Space(_) => "give other numbers as volume.phantom.size or spacing",
                _ => "`drypoint phantom --list` lists phantoms and parameters",
            };
            Failure::new(error, given.position("volume.phantom"), remedy)
        }),
    }
}

/// The further volumes that the transfer function is over; what is wrong goes to `failures`.
fn further(scene: &Scene, failures: &mut Vec<Failure>) -> [Option<Volume>; 2] {
    let axes = scene.transfer.as_ref().map_or(&[][..], |transfer| transfer.over.axes());
    [0, 1].map(|i| match axes.get(i) {
        Some(Axis::Volume(path)) => read::read(path, None).map_err(|error| failures.push(Failure::from(error))).ok(),
        _ => None,
    })
}

/// The names of the styles that nodes carry.
fn named(transfer: &Transfer) -> impl Iterator<Item = &str> {
    transfer.all_nodes().filter_map(|node| match &node.color {
        NodeColor::Style(name) => Some(name.as_str()),
        NodeColor::Color(_) => None,
    })
}

/// What makes no function, at the key that says it.
fn function_failure(error: &FunctionError, given: &Given, names: &LabelNames) -> Failure {
    let key = match error {
        FunctionError::UnknownLabel { row: Some(row), .. } | FunctionError::LabelTwice { row, .. } => {
            format!("transfer.rows[{row}].at")
        }
        FunctionError::UnknownLabel { row: None, .. } => "transfer.over".into(),
    };
    let remedy = match error {
        FunctionError::LabelTwice { .. } => "keep one row for each label".into(),
        FunctionError::UnknownLabel { name, .. } => match names.nearest(name) {
            Some(nearest) => format!("write {nearest:?}"),
            None if names.iter().next().is_none() => "write an id, or name the labels with volume.label_names".into(),
            None => "write an id, or one of the names in volume.label_names".into(),
        },
    };
    Failure::new(error, given.position(&key), remedy)
}

/// The styles of those names; what is wrong goes to `failures`.
fn styles<'a>(scene: &Scene, names: impl Iterator<Item = &'a str>, failures: &mut Vec<Failure>) -> Vec<Style> {
    let mut styles = Vec::new();
    for name in names {
        match load_styles(&scene.styles, [name]) {
            Ok(style) => styles.extend(style),
            Err(error) => failures.push(style_failure(scene, &error)),
        }
    }
    styles
}

/// A style or theme that cannot be had, at the key that names it.
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

/// The pixels behind, where the scene has a picture there; what is wrong goes to `failures`.
fn background(scene: &Scene, failures: &mut Vec<Failure>) -> Option<Vec<Rgba>> {
    let Background::Picture(path) = &scene.picture.background else { return None };
    let [width, height] = scene.picture.size;
    if let Err(failure) = room(scene, size_of::<Rgba>()) {
        failures.push(failure);
        return None;
    }
    let pixels = read_background(path, width, height);
    let failed = |error| Failure::new(&error, scene.given.position("picture.background"), OutputError::help(&error));
    pixels.map_err(|error| failures.push(failed(error))).ok()
}
