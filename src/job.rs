//! From a scene to a picture: load what the scene names, hand it to the renderer.

use crate::Failure;
use drypoint_output::read::read_background;
use drypoint_reference::ray::{Backdrop, Inputs, RenderError, Renderer};
use drypoint_reference::suggest;
use drypoint_scene::color::Rgba;
use drypoint_scene::file::identity;
use drypoint_scene::phantom;
use drypoint_scene::picture::Provenance;
use drypoint_scene::plan::Plan;
use drypoint_scene::style::{Style, load as load_styles};
use drypoint_scene::tables::{Background, Ids, Scene, VolumeSource, VolumeTable};
use drypoint_scene::transfer::Function;
use drypoint_scene::view::View;
use drypoint_scene::volume::{Volume, read};
use std::path::PathBuf;

/// A scene with everything that it names.
pub struct Job {
    /// The scene.
    pub scene: Scene,
    /// What it calls for.
    pub plan: Plan,
    /// Its volume.
    pub volume: Volume,
    function: Function,
    styles: Vec<Style>,
    background: Option<Vec<Rgba>>,
}

impl Job {
    /// Loads the volume, the styles and the background of a scene. A transfer function without nodes is found from the
    /// data.
    ///
    /// # Errors
    /// What cannot be read, does not exist, or draws nothing.
    pub fn load(scene: Scene) -> Result<Self, Failure> {
        let volume = load_volume(&scene.volume)?;
        Self::with_volume(scene, volume)
    }

    /// The same for a volume that is already loaded.
    ///
    /// # Errors
    /// As [`Job::load`].
    pub fn with_volume(mut scene: Scene, volume: Volume) -> Result<Self, Failure> {
        let volume = meant(&scene.volume, volume);
        let Some(transfer) = scene.transfer.as_mut() else {
            return Err(Failure::new(
                "the scene draws nothing: it has no [transfer]",
                volume_name(&scene.volume),
                "add a [transfer] table, or leave out what replaces it",
            ));
        };
        if transfer.nodes.is_none() {
            suggest::fill_function(transfer, &volume, scene.volume.outside);
        }
        let range = scene.volume.range.unwrap_or_else(|| volume.range());
        let function = Function::new(transfer, range, &volume).ok_or_else(|| {
            Failure::new("the transfer function has no node", volume_name(&scene.volume), "give it `nodes`")
        })?;
        let styles = match &function {
            Function::Regular(_) => Vec::new(),
            Function::Style { names, .. } => load_styles(&scene.styles, names.iter().map(String::as_str))
                .map_err(|e| Failure::new(e, "[styles]", "`drypoint styles` lists the styles of a theme"))?,
        };
        let [width, height] = scene.picture.size;
        let background = match &scene.picture.background {
            Background::Picture(path) => Some(
                read_background(path, width, height).map_err(|e| Failure::new(&e, "picture.background", e.help()))?,
            ),
            Background::None | Background::Color(_) => None,
        };
        let mut plan = Plan::new(&scene);
        if let (Some(step), Ok(view)) =
            (scene.sampling.step.world(volume.grid()), View::new(&scene.camera, volume.grid(), scene.picture.size))
        {
            plan.warn_step(step * view.largest_stretch(), volume.grid().voxel());
        }
        Ok(Self { scene, plan, volume, function, styles, background })
    }

    /// The scene made ready for any number of frames.
    ///
    /// # Errors
    /// A reconstruction that does not exist, a camera without direction.
    pub fn renderer(&self) -> Result<Renderer<'_>, Failure> {
        let background = match (&self.background, &self.scene.picture.background) {
            (Some(pixels), _) => Backdrop::Pixels(pixels),
            (None, Background::Color(color)) => Backdrop::Color(*color),
            (None, _) => Backdrop::None,
        };
        let inputs = Inputs {
            scene: &self.scene,
            plan: &self.plan,
            volume: &self.volume,
            function: &self.function,
            styles: &self.styles,
            background,
        };
        Renderer::new(inputs).map_err(|error| {
            let remedy = match &error {
                RenderError::Field(_) => "choose another `sampling.kernel` or `sampling.hessian`",
                RenderError::View(_) => "move `camera.eye` away from `camera.target`, or give `camera.direction`",
                RenderError::Nodes(_) => "give `transfer.nodes` in ascending order, with opacities in [0, 1]",
                RenderError::Length { .. } => "give it in world units or in voxels",
                RenderError::Styles { .. } => "hand over one style for each name",
            };
            Failure::new(error, volume_name(&self.scene.volume), remedy)
        })
    }

    /// What a picture of this job says of its origin ([IO-2]).
    pub fn provenance(&self) -> Provenance {
        Provenance {
            software: concat!("drypoint ", env!("CARGO_PKG_VERSION")).into(),
            scene_hash: identity(&self.scene),
            plan: self.plan.to_string(),
        }
    }
}

/// Reads or generates a scene's volume.
///
/// # Errors
/// What the reader or the phantom says.
pub fn load_volume(table: &VolumeTable) -> Result<Volume, Failure> {
    let volume = match &table.source {
        VolumeSource::File { path, raw } => {
            read::read(path, raw.as_ref()).map_err(|e| Failure::new(e.what(), e.place(), e.remedy()))
        }
        VolumeSource::Phantom(source) => phantom::generate(source)
            .map_err(|e| Failure::new(e, "volume.phantom", "`drypoint phantom --list` lists phantoms and parameters")),
    };
    volume.map(|volume| meant(table, volume))
}

/// A volume as its table means it. Once more changes nothing.
fn meant(table: &VolumeTable, volume: Volume) -> Volume {
    match table.ids {
        Ids::Values => volume,
        Ids::Mask => volume.present(),
    }
}

/// A scene for a bare volume: an automatic function, a camera that frames the content, a pleasant style.
pub fn bare(path: PathBuf, volume: &Volume, size: [usize; 2]) -> Scene {
    suggest::scene(VolumeSource::File { path, raw: None }, volume, size)
}

/// How a message names a volume.
fn volume_name(table: &VolumeTable) -> String {
    match &table.source {
        VolumeSource::File { path, .. } => path.display().to_string(),
        VolumeSource::Phantom(source) => format!("phantom {}", source.name),
    }
}
