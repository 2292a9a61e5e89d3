//! Failures of a job's camera, shot and renderer, each at the key that causes it.

use crate::Failure;
use drypoint_reference::field::FieldError;
use drypoint_reference::ray::RenderError;
use drypoint_scene::shot::ShotError;
use drypoint_scene::tables::Scene;
use drypoint_scene::view::ViewError;

/// Returns the failure of a camera, at the key that causes it.
pub(super) fn view_failure(error: ViewError, scene: &Scene) -> Failure {
    let (key, remedy) = match error {
        ViewError::HeightOnPage => ("camera.height", "give it in world units or in voxels"),
        ViewError::NoDirection => ("camera", "move camera.eye away from camera.target, or give camera.direction"),
    };
    Failure::new(error, scene.given.position(key), remedy)
}

/// Returns the failure of a shot, at the key that causes it.
pub(crate) fn shot_failure(error: &ShotError, scene: &Scene) -> Failure {
    let (key, remedy) = match error {
        ShotError::NotSmooth(_) => (NOT_SMOOTH.0.to_owned(), NOT_SMOOTH.1),
        ShotError::Length { key } => ((*key).to_owned(), "give it in world units or in voxels"),
        ShotError::NotOnPage { key } => ((*key).to_owned(), "give it in mm, px or %"),
        ShotError::NoIso { key } => ((*key).to_owned(), "give it a value"),
        ShotError::NoLightingTable => ("shading.table".to_owned(), "load the scene as a job, which reads it"),
        ShotError::FocusInPixels { halo } => {
            (format!("halo[{halo}].seed.focus.pixels"), "give points of the world in its place: at = [[x, y, z]]")
        }
        ShotError::Motion => ("object".to_owned(), "move it less far, or scale it less"),
        ShotError::ObjectTooLarge { object, .. } => {
            let keys = ["matrix", "scale"].map(|key| format!("object[{object}].{key}"));
            match keys.into_iter().find(|key| scene.given.contains(key)) {
                Some(key) => (key, "scale it less, or make sampling.step longer"),
                None => ("sampling.step".to_owned(), "make it longer"),
            }
        }
        ShotError::LabelName { halo, label } => (format!("halo[{halo}].seed.labels[{label}]"), "write the label's id"),
    };
    Failure::new(error, scene.given.position(&key), remedy)
}

/// The key and the remedy of a Hessian that its kernel does not have.
const NOT_SMOOTH: (&str, &str) = ("sampling.hessian", "choose another sampling.kernel or sampling.hessian");

/// Returns the failure of a renderer, at the key that causes it.
pub(crate) fn render_failure(error: &RenderError, scene: &Scene) -> Failure {
    let (key, remedy) = match error {
        RenderError::Field(FieldError::NotSmooth(_)) => NOT_SMOOTH,
        RenderError::Field(FieldError::TooLarge { .. }) => ("sampling.number", "write \"f64\""),
        RenderError::Field(FieldError::Scale { .. }) => ("sampling.scale", "make it smaller, or leave it out"),
        RenderError::TooManyPlanes { .. } => ("sampling.step", "make it longer, or move the camera nearer"),
        RenderError::TooManySteps { .. } => ("sampling.step", "make it longer"),
        RenderError::Endless { .. } => ("sampling.step", "make it longer, or the picture or picture.samples smaller"),
        RenderError::Nodes(_) => ("transfer.nodes", "give them in ascending order, with opacities in [0, 1]"),
        RenderError::NoFurtherVolume => ("transfer.over", "hand over the volume that it names"),
        RenderError::NoLabels => ("transfer.over", "name a label volume with volume.labels"),
        RenderError::NoSuchLabel { .. } => ("transfer.over", "name a label that the label volume has"),
        RenderError::BackdropSize { .. } => ("picture.background", "give a colour, or draw frames of its size alone"),
        RenderError::NoObjects => ("object", "hand over the data of all its objects"),
        RenderError::ExactObjects => ("object", "leave the objects out, or compare with the finest settings"),
        RenderError::Motion => ("object", "move it less far, or scale it less"),
        RenderError::Material => ("transfer", "hand over the material of its kind"),
        RenderError::Styles { .. } => ("styles", "hand over one style for each name"),
    };
    Failure::new(error, scene.given.position(key), remedy)
}
