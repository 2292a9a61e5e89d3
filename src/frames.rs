//! Frames of a volume, by the reference or on a graphics card.
//!
//! ```
//! use drypoint::frames::{Frames, ReferenceFrames};
//! # use drypoint::job::Job;
//! # use drypoint::scene::file::{Overrides, parse};
//! # use std::num::NonZeroUsize;
//! # let text = "drypoint = 1\n[volume]\nphantom = { name = \"torus\", size = 24 }\n[picture]\nsize = [60, 50]\n[transfer]\n";
//! # let job = Job::load(parse(text, "torus.toml".as_ref(), &Overrides::default())?)?;
//!
//! // A coarse frame, which a viewer shows at once, then the exact one.
//! let mut frames = ReferenceFrames::new(job.renderer()?, &job.scene);
//! for shot in [job.coarse_shot(NonZeroUsize::new(8).unwrap())?, job.shot()?] {
//!     frames.turn(&shot)?;
//!     let (picture, _counts) = frames.frame(&|_share| ())?;
//!     assert_eq!([picture.width, picture.height], shot.view.size);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::Failure;
use crate::job::{Job, SceneVariant, render_failure};
use drypoint_reference::ray::Renderer;
use drypoint_scene::counts::Counts;
use drypoint_scene::fragments::Fragments;
use drypoint_scene::picture::Picture;
use drypoint_scene::shot::Shot;
use drypoint_scene::tables::Scene;
use std::sync::atomic::AtomicBool;

/// Draws any number of frames of one scene, from any camera with its lens.
pub trait Frames {
    /// Returns about how many samples a frame has without skipping.
    fn samples(&self) -> f64;

    /// Returns the reference's renderer at the current camera, if it draws the frames.
    fn reference(&self) -> Option<&Renderer<'_>> {
        None
    }

    /// Returns n of the n×n rays of a pixel that is not refined.
    fn rays_across(&self) -> usize;

    /// Puts lines inside the following frames, or removes them.
    ///
    /// # Errors
    /// The scene's plan has no lines inside the volume.
    fn merge(&mut self, lines: Option<Fragments>) -> Result<(), Failure>;

    /// Takes the camera and the lights of another shot of the scene ([`Shot::seen_from`]), and the size and the rays of a
    /// coarse frame ([`Job::coarse_shot`](crate::job::Job::coarse_shot)). Nothing is prepared anew. Reaches in px and mm keep
    /// their pixels: in a coarse frame such halos are wider beside the volume.
    ///
    /// # Errors
    /// The camera is too far away, or the size differs before a picture. On a graphics card funnels have one size, too.
    fn turn(&mut self, shot: &Shot) -> Result<(), Failure>;

    /// Takes a variant of the job's scene, if that saves work, and removes lines inside the picture. Returns whether it did;
    /// otherwise the frames have to be prepared anew.
    ///
    /// # Errors
    /// The errors of preparing the frames.
    fn change_to(&mut self, _job: &Job, _variant: &SceneVariant) -> Result<bool, Failure> {
        Ok(false)
    }

    /// Draws a frame, with its own counts. `progress` receives the share that is done, on any thread; the frame pauses
    /// until it returns. Once `stop` is true, the frame soon ends without a picture, unless it is already complete.
    ///
    /// # Errors
    /// Errors of the adapter.
    fn frame_until(
        &mut self,
        progress: &(dyn Fn(f64) + Sync),
        stop: &AtomicBool,
    ) -> Result<Option<(Picture, Counts)>, Failure>;

    /// Draws a frame that cannot be stopped. See [`Frames::frame_until`].
    ///
    /// # Errors
    /// The errors of [`Frames::frame_until`].
    fn frame(&mut self, progress: &(dyn Fn(f64) + Sync)) -> Result<(Picture, Counts), Failure> {
        let frame = self.frame_until(progress, &AtomicBool::new(false))?;
        Ok(frame.unwrap_or_else(|| unreachable!("nothing stops the frame")))
    }

    /// Draws a frame to where a viewer needs it, and waits for it: the reference to memory, a graphics card to a
    /// texture. The frame cannot be stopped. Returns the seconds of its rays by the adapter's clock; none without a
    /// clock.
    ///
    /// # Errors
    /// Errors of the adapter, and a picture without a beauty.
    fn show(&mut self) -> Result<Option<f64>, Failure>;
}

/// Frames of the reference.
pub struct ReferenceFrames<'a> {
    renderer: Renderer<'a>,
    scene: &'a Scene,
}

impl<'a> ReferenceFrames<'a> {
    /// Frames of a scene by a renderer.
    pub fn new(renderer: Renderer<'a>, scene: &'a Scene) -> Self {
        Self { renderer, scene }
    }
}

impl Frames for ReferenceFrames<'_> {
    fn reference(&self) -> Option<&Renderer<'_>> {
        Some(&self.renderer)
    }

    fn samples(&self) -> f64 {
        self.renderer.samples()
    }

    fn rays_across(&self) -> usize {
        self.renderer.rays_across()
    }

    fn merge(&mut self, lines: Option<Fragments>) -> Result<(), Failure> {
        self.renderer.merge(lines);
        Ok(())
    }

    fn turn(&mut self, shot: &Shot) -> Result<(), Failure> {
        self.renderer.turn(shot).map_err(|error| render_failure(&error, self.scene))
    }

    fn frame_until(
        &mut self,
        progress: &(dyn Fn(f64) + Sync),
        stop: &AtomicBool,
    ) -> Result<Option<(Picture, Counts)>, Failure> {
        Ok(self.renderer.again_until(progress, stop))
    }

    fn show(&mut self) -> Result<Option<f64>, Failure> {
        self.renderer.again(&|_| ());
        Ok(None)
    }
}
