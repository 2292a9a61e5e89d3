//! The thread that draws exact frames with points, lines and annotations. Points and lines take seconds to make, in which
//! the thread of [`frames`](crate::frames) follows the camera.

use crate::background::Background;
use crate::canvas;
use crate::frames::{Answer, Frame};
use drypoint::Failures;
use drypoint::drawing::Drawing;
use drypoint::gpu::Gpu;
use drypoint::job::{Job, RenderTarget};
use drypoint::marking::Marking;
use drypoint::scene::counts::Counts;
use drypoint::scene::source::Disk;
use drypoint::scene::tables::Scene;
use drypoint::scene::volume::Volume;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// A scene to draw.
pub(crate) struct PageRequest {
    /// The revision of the document, which the answer names.
    pub(crate) revision: u64,
    pub(crate) scene: Scene,
    pub(crate) volume: Arc<Volume>,
}

/// Starts the thread. `wake` is called after each answer, on the thread.
pub(crate) fn pages(card: Option<Gpu>, wake: Box<dyn Fn() + Send>) -> Background<PageRequest, Answer> {
    Background::new("pages", wake, move |desk| {
        while let Some(PageRequest { revision, scene, volume }) = desk.wait() {
            match draw(revision, scene, volume, card.as_ref(), desk.mailbox.stop()) {
                Ok(Some(frame)) => desk.answer(Answer::Drawn(frame)),
                Ok(None) => {}
                Err(failures) => desk.answer(Answer::Failed(revision, failures)),
            }
        }
    })
}

/// Draws the exact frame of a scene. Returns none if it is stopped.
pub(crate) fn draw(
    revision: u64,
    scene: Scene,
    volume: Arc<Volume>,
    card: Option<&Gpu>,
    stop: &AtomicBool,
) -> Result<Option<Frame>, Failures> {
    let (start, mut counts) = (Instant::now(), Counts::default());
    let job = Job::with_volume_for(scene, volume, RenderTarget::Picture, Arc::new(Disk))?;
    let marking = Marking::new(&job, &mut counts, &|_| ())?;
    if stop.load(Ordering::Relaxed) {
        return Ok(None);
    }
    let mut drawing = Drawing::on(&job, &marking, card, &mut counts)?;
    let Some((frame, _)) = drawing.frame_until(0, &|_| (), stop)? else { return Ok(None) };
    let (size, pixels) = canvas::codes(&frame.painted(&job)?)?;
    Ok(Some(Frame { revision, size, pixels, is_coarse: false, seconds: start.elapsed().as_secs_f64() }))
}
