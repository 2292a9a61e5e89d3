//! The reference against the card on the scene as it stands, at a reduced size with a ray a pixel, in the background:
//! `drypoint validate`.

use crate::frames::shown_size;
use drypoint::gpu::Gpu;
use drypoint::job::{Job, RenderTarget};
use drypoint::output::compare::difference::difference_picture;
use drypoint::output::compare::{CompareOptions, flip};
use drypoint::output::png::rgba_codes;
use drypoint::output::read::Image;
use drypoint::scene::source::Disk;
use drypoint::scene::tables::{RaysPerPixel, Scene};
use drypoint::scene::volume::Volume;
use drypoint::validate::{Validation, validate_until};
use drypoint::{Failure, Failures};
use eframe::egui::ColorImage;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, channel};

/// A comparison of the card with the reference.
pub struct Comparison {
    /// The figures.
    pub found: Validation,
    /// The picture of the difference (FLIP): black for none, pale for the largest.
    pub difference: ColorImage,
    /// The largest FLIP of a pixel, from 0 to 1.
    pub largest_flip: f64,
}

/// A comparison that runs in the background. It is given up when this is dropped.
pub struct Comparing {
    end: Receiver<Result<Comparison, Failures>>,
    stop: Arc<AtomicBool>,
}

impl Drop for Comparing {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
    }
}

impl Comparing {
    /// Starts to compare. `wake` is called at the end, on the thread.
    pub fn start(scene: Scene, volume: Arc<Volume>, card: Gpu, wake: Box<dyn Fn() + Send>) -> Self {
        let ((sender, end), stop) = (channel(), Arc::new(AtomicBool::new(false)));
        let stopped = Arc::clone(&stop);
        std::thread::spawn(move || {
            if let Some(end) = compare(scene, volume, &card, &stopped).transpose() {
                // The window may be closed.
                let _ = sender.send(end);
            }
            wake();
        });
        Self { end, stop }
    }

    /// Returns the outcome, once there is one.
    pub fn end(&self) -> Option<Result<Comparison, Failures>> {
        match self.end.try_recv() {
            Ok(end) => Some(end),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => {
                let what = "the comparison did not come to its end";
                Some(Err(Failure::new(what, "the card", "compare with drypoint validate").into()))
            }
        }
    }
}

/// Returns a scene at a reduced size: at most so many pixels on the longer side, and one ray a pixel. See
/// [`shown_size`] for pages.
pub fn reduced(scene: &Scene, longest: usize) -> Scene {
    let mut scene = scene.clone();
    scene.picture.size = shown_size(&scene, longest);
    scene.picture.samples = RaysPerPixel::Across(1);
    scene
}

/// Compares a card with the reference on a scene. Once `stop` is true, the comparison ends without a result ([`validate_until`]).
///
/// # Errors
/// The errors of [`Job::with_volume_for`] and of [`validate_until`].
pub fn compare(
    scene: Scene,
    volume: Arc<Volume>,
    card: &Gpu,
    stop: &AtomicBool,
) -> Result<Option<Comparison>, Failures> {
    let job = Job::with_volume_for(scene, volume, RenderTarget::Picture, Arc::new(Disk))?;
    let Some(found) = validate_until(&job, card, stop)? else { return Ok(None) };
    let [a, b] = found.pictures.each_ref().map(Image::from);
    let map = flip::flip(&a, &b, CompareOptions::default().pixels_per_degree);
    let mut map = map.map_err(|error| Failure::picture(&error, "the difference"))?;
    // Differences within bounds would all be black.
    let largest_flip = map.values.iter().copied().fold(0.0, f64::max);
    if largest_flip > 0.0 {
        map.values.iter_mut().for_each(|value| *value /= largest_flip);
    }
    let bytes = rgba_codes(&difference_picture(&map), 8).map_err(|error| Failure::picture(&error, "the difference"))?;
    let difference = ColorImage::from_rgba_unmultiplied([map.width, map.height], &bytes);
    Ok(Some(Comparison { found, difference, largest_flip }))
}
