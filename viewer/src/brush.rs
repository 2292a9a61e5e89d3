//! The thread that tells where a brush meets the volume.
//!
//! As for strokes at pixels, these are the first visible places of the picture without objects and halos ([VS-6]). No
//! stroke changes that picture, so it is prepared once and kept while a volume is painted, as the camera turns, too.

use crate::background::{Background, Desk};
use crate::probe::follow;
use drypoint::job::{Job, RenderTarget};
use drypoint::picking::pick_pixel;
use drypoint::reference::ray::Picked;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::source::Disk;
use drypoint::scene::tables::Scene;
use drypoint::scene::volume::Volume;
use drypoint::{Failure, Failures};
use std::sync::Arc;

/// A question: where does a brush at some pixels meet the volume?
pub(crate) struct BrushQuery {
    scene: Scene,
    volume: Arc<Volume>,
    pixels: Vec<[usize; 2]>,
}

impl BrushQuery {
    /// A question about pixels of a scene's picture, column and row.
    pub(crate) fn new(scene: &Scene, volume: Arc<Volume>, pixels: Vec<[usize; 2]>) -> Self {
        let mut scene = Scene { halos: Vec::new(), ..scene.of_background() };
        scene.picture.layers = vec![LayerKind::Beauty];
        Self { scene, volume, pixels }
    }
}

/// The place at each pixel; none where nothing is visible.
pub(crate) type BrushPlaces = Result<Vec<Option<Picked>>, Failures>;

/// A handle of the thread, which ends when it is dropped.
pub(crate) type BrushPicker = Background<BrushQuery, BrushPlaces>;

/// Starts the thread. `wake` is called after each answer, on the thread.
pub(crate) fn picker(wake: Box<dyn Fn() + Send>) -> BrushPicker {
    Background::new("brush", wake, |desk| run(&desk))
}

fn run(desk: &Desk<BrushQuery, BrushPlaces>) {
    let mut next = desk.wait();
    while let Some(query) = next {
        let (scene, volume) = (query.scene.clone(), Arc::clone(&query.volume));
        let job = Job::with_volume_for(scene, volume, RenderTarget::Picture, Arc::new(Disk));
        let served = job.and_then(|job| Ok(serve(desk, &job, query)?));
        next = served.unwrap_or_else(|failures| {
            desk.answer(Err(failures));
            desk.wait()
        });
    }
}

/// Answers a question, and those after it whose scenes only move the camera. Returns the next question; none if the
/// window is closed.
fn serve(
    desk: &Desk<BrushQuery, BrushPlaces>,
    job: &Job,
    mut query: BrushQuery,
) -> Result<Option<BrushQuery>, Failure> {
    let mut renderer = job.renderer()?;
    loop {
        desk.answer(Ok(query.pixels.iter().map(|&pixel| pick_pixel(&renderer, pixel)).collect()));
        let Some(newer) = desk.wait() else { return Ok(None) };
        let is_same = Arc::ptr_eq(&query.volume, &newer.volume);
        if !is_same || !follow(job, &mut renderer, [&query.scene, &newer.scene])? {
            return Ok(Some(newer));
        }
        query = newer;
    }
}
