//! The picture of a scene, and the encoding that suits it.

use super::encode::{ink_png, inks_png, opaque_png};
use drypoint::drawing::Drawing;
use drypoint::job::{Job, RenderTarget};
use drypoint::marking::Marking;
use drypoint::output::read::Image;
use drypoint::output::sheet::{Layout, sheet};
use drypoint::scene::color::srgb_to_linear;
use drypoint::scene::counts::Counts;
use drypoint::scene::picture::{Layer, LayerKind, Picture};
use drypoint::scene::source::Disk;
use drypoint::scene::tables::{Background, Scene};
use drypoint::{Failure, Failures};
use std::sync::Arc;

/// Makes a file of a picture.
pub(super) type Encode = fn(&Picture) -> Result<Vec<u8>, png::EncodingError>;

/// The darkest κ_v of a map of curvature, per world unit.
const BLACK: f64 = 1.0;

/// Frames of an orbit in a row of a sheet.
const FRAMES_IN_A_ROW: usize = 4;

/// Pixels along the longer side of a frame on a sheet.
const FRAME: usize = 260;

/// The picture of a scene, and how it becomes a file.
///
/// A scene with the layer `curvature.KV` is shown as a map of κ_v.
///
/// # Errors
/// The renderer's failure.
pub(super) fn picture(mut scene: Scene) -> Result<(Picture, Encode), String> {
    let is_map = scene.picture.layers.contains(&LayerKind::CurvatureAlongView);
    if is_map {
        scene.picture.background = Background::None;
    }
    if scene.draws_on_page() {
        let colored = scene.draws_volume() && scene.stipples.is_none()
            || scene.hatching.as_ref().is_some_and(|hatching| hatching.lighting.is_some());
        let black = scene.pens.iter().all(|pen| pen.color[..3].iter().all(|c| *c == pen.color[0]));
        let encode = if colored {
            opaque_png
        } else if black {
            ink_png
        } else {
            inks_png
        };
        return marks(scene, colored).map_err(|e| e.to_string()).map(|picture| (picture, encode as Encode));
    }
    let job = Job::load(scene).map_err(|e| e.to_string())?;
    let (picture, _) = job.renderer().map_err(|e| e.to_string())?.frame(&|_| ());
    let picture = if is_map { map(&picture).ok_or("the picture has no curvature")? } else { picture };
    Ok((picture, opaque_png))
}

/// Dots and lines, on their page, or where they have colours over the volume. The frames of an orbit stand side by side.
fn marks(scene: Scene, colored: bool) -> Result<Picture, Failures> {
    let job = Job::load_for(scene, if colored { RenderTarget::Picture } else { RenderTarget::Marks }, Arc::new(Disk))?;
    let mut counts = Counts::default();
    let marking = Marking::new(&job, &mut counts, &|_| ())?;
    let mut drawing = Drawing::new(&job, &marking, &mut counts)?;
    let mut frames = Vec::new();
    for frame in 0..drawing.frames() {
        frames.push(drawing.frame(frame, &|_| ())?.0.painted(&job)?);
    }
    if frames.len() == 1 {
        return Ok(frames.remove(0));
    }
    let named: Vec<(String, Image)> =
        frames.iter().enumerate().map(|(i, frame)| (i.to_string(), Image::from(frame))).collect();
    let layout = Layout { columns: Some(FRAMES_IN_A_ROW), cell: FRAME };
    Ok(sheet(&named, layout).map_err(|error| Failure::picture(&error, "the frames of an orbit"))?)
}

/// |κ_v| as grey on white: the darker, the more curved; as faint as the picture is.
fn map(picture: &Picture) -> Option<Picture> {
    let alpha = &picture.layer(LayerKind::Beauty)?.channels[3];
    let kappa = &picture.layer(LayerKind::CurvatureAlongView)?.channels[0];
    let light = |(k, a): (&f64, &f64)| 1.0 - a * (1.0 - srgb_to_linear((1.0 - k.abs() / BLACK).max(0.0)));
    let grey: Vec<f64> = kappa.iter().zip(alpha).map(light).collect();
    let opaque = vec![1.0; grey.len()];
    let channels = vec![grey.clone(), grey.clone(), grey, opaque];
    Some(Picture { layers: vec![Layer { kind: LayerKind::Beauty, channels }], ..*picture })
}
