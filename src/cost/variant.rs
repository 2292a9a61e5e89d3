//! What a setting makes, and the time that it takes.

use super::On;
use crate::Failure;
use crate::job::{Job, Turned, Wanted};
use crate::marking::Marking;
use drypoint_output::read::Image;
use drypoint_reference::ray::Renderer;
use drypoint_scene::counts::Counts;
use drypoint_scene::marks::Marks;
use std::time::Instant;

/// Bytes that are kept prepared from turn to turn; what is more is prepared anew each time.
const KEPT: u64 = 1 << 30;

/// A scene that is drawn, whatever knobs lead to it.
pub(super) struct Variant<'a> {
    job: &'a Job,
    pub(super) on: On,
    pub(super) turned: &'a Turned,
    /// Ready for the next turn, where it may be kept.
    renderer: Option<Renderer<'a>>,
    /// What was made, with its counts, or why there is none.
    pub(super) made: Result<(Made, Counts), Failure>,
    pub(super) seconds: Vec<f64>,
}

/// What a setting makes.
pub(super) enum Made {
    /// Of [`On::Picture`].
    Picture(Image),
    /// Of [`On::Dots`].
    Dots(Marks),
    /// Of [`On::Strokes`].
    Strokes(Marks),
}

impl<'a> Variant<'a> {
    /// Prepares and warms up; `kept` counts what the variants keep.
    pub(super) fn new(job: &'a Job, on: On, turned: &'a Turned, kept: &mut u64) -> Self {
        let mut renderer = None;
        let made = match on {
            On::Picture => job.renderer_of(turned).map(|ready| {
                let (picture, counts) = ready.frame(&|_| ());
                let shared = |name: &str| ["volume", "mask", "labels", "picture"].contains(&name);
                let own: u64 = counts.bytes.iter().filter(|(name, _)| !shared(name)).map(|(_, bytes)| bytes).sum();
                if *kept + own <= KEPT {
                    *kept += own;
                    renderer = Some(ready);
                }
                (Made::Picture(Image::from(&picture)), counts)
            }),
            On::Dots => marks(job, turned, Wanted::Points).map(|(marks, counts)| (Made::Dots(marks), counts)),
            On::Strokes => marks(job, turned, Wanted::Strokes).map(|(marks, counts)| (Made::Strokes(marks), counts)),
        };
        Self { job, on, turned, renderer, made, seconds: Vec::new() }
    }

    /// Times one frame of a picture, or all of dots or strokes.
    pub(super) fn take_turn(&mut self) -> Result<(), Failure> {
        let (anew, start);
        match (self.on, &self.renderer) {
            (On::Picture, Some(renderer)) => {
                start = Instant::now();
                renderer.frame(&|_| ());
            }
            (On::Picture, None) => {
                anew = self.job.renderer_of(self.turned)?;
                start = Instant::now();
                anew.frame(&|_| ());
            }
            (On::Dots | On::Strokes, _) => {
                let wanted = if self.on == On::Dots { Wanted::Points } else { Wanted::Strokes };
                start = Instant::now();
                marks(self.job, self.turned, wanted)?;
            }
        }
        self.seconds.push(start.elapsed().as_secs_f64());
        Ok(())
    }
}

/// The first frame of a scene's points or strokes, made from its voxels.
fn marks(job: &Job, turned: &Turned, wanted: Wanted) -> Result<(Marks, Counts), Failure> {
    let mut counts = Counts::default();
    counts.bytes.insert("volume".into(), job.volume.voxels().bytes() as u64);
    let marking = Marking::of(job, &turned.scene, Some(wanted), (&mut counts, &|_| ()))?;
    let drawn = marking.frames(&mut counts).map(|mut frames| -> Result<Marks, Failure> {
        let view = job.view()?;
        Ok(frames.draw(&view, &mut counts))
    });
    match drawn {
        Some(marks) => Ok((marks?, counts)),
        None => Err(Failure::new("nothing is drawn", job.scene.given.position(""), "add a table [stipples]")),
    }
}
