//! Rendering of the document by the reference into a file, in the background, as the command does it.

use drypoint::drawing::{Drawing, room_for_page, write_animation};
use drypoint::job::{Job, RenderTarget};
use drypoint::marking::Marking;
use drypoint::scene::atomic;
use drypoint::scene::counts::Counts;
use drypoint::scene::picture::LayerKind;
use drypoint::scene::source::Disk;
use drypoint::scene::tables::Scene;
use drypoint::{Failure, Failures, Format};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, channel};

/// The end of an export.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The file is written.
    Written,
    /// The user stopped it, and there is no file.
    Stopped,
}

/// A running export. It goes on if the handle is dropped.
pub struct Export {
    path: PathBuf,
    shared: Arc<Shared>,
    end: Receiver<Result<Outcome, Failures>>,
}

/// The state that the thread and the window share.
#[derive(Default)]
struct Shared {
    stop: AtomicBool,
    /// The bits of the share that is done.
    share: AtomicU64,
}

impl Export {
    /// Starts to render a scene into a file, whose suffix is the format. `wake` is called as it goes on, on any thread.
    pub fn start(scene: Scene, path: PathBuf, wake: Box<dyn Fn() + Send + Sync>) -> Self {
        let shared = Arc::new(Shared::default());
        let (sender, end) = channel();
        let (own, file) = (Arc::clone(&shared), path.clone());
        std::thread::spawn(move || {
            let progress = |share: f64| {
                let before = f64::from_bits(own.share.swap(share.to_bits(), Ordering::Relaxed));
                if (share * 100.0).floor() != (before * 100.0).floor() {
                    wake();
                }
            };
            let drawn = export(scene, &file, &progress, &own.stop);
            // The window may be closed.
            let _ = sender.send(drawn);
            wake();
        });
        Self { path, shared, end }
    }

    /// Returns the file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Returns the share that is done.
    pub fn share(&self) -> f64 {
        f64::from_bits(self.shared.share.load(Ordering::Relaxed))
    }

    /// Ends the export soon, without a file.
    pub fn stop(&self) {
        self.shared.stop.store(true, Ordering::Relaxed);
    }

    /// Returns the outcome, once there is one.
    pub fn end(&self) -> Option<Result<Outcome, Failures>> {
        match self.end.try_recv() {
            Ok(end) => Some(end),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => {
                let what = "the picture was not drawn to its end";
                Some(Err(Failure::new(what, self.path.display(), "render it with drypoint render").into()))
            }
        }
    }
}

/// Renders a scene into a file, as `drypoint render` does. `progress` receives the share that is done, on any thread.
///
/// # Errors
/// The errors of the command.
pub fn export(
    mut scene: Scene,
    path: &Path,
    progress: &(dyn Fn(f64) + Sync),
    stop: &AtomicBool,
) -> Result<Outcome, Failures> {
    let unwritable = |error: std::io::Error| {
        Failure::new(format!("the file cannot be written: {error}"), path.display(), atomic::remedy(&error))
    };
    atomic::check(path).map_err(unwritable)?;
    let format = Format::of(path);
    if format != Some(Format::Exr) {
        // Layers that nobody writes are not computed.
        scene.picture.layers = vec![LayerKind::Beauty];
    }
    let job = Job::load_for(scene, RenderTarget::Picture, Arc::new(Disk))?;
    room_for_page(&job, path)?;
    let mut counts = Counts::default();
    let marking = Marking::new(&job, &mut counts, &|_| ())?;
    let mut drawing = Drawing::new(&job, &marking, &mut counts)?;
    let frames = drawing.frames();
    let is_animation = format.is_some_and(|format| Format::ANIMATIONS.contains(&format)) && frames > 1;
    if is_animation {
        let stopped = || Failure::new("stopped", path.display(), "");
        let written = write_animation(&job, frames, path, |i| {
            let drawn = drawing.frame_until(i, &|share| progress((i as f64 + share) / frames as f64), stop)?;
            drawn.map(|(frame, _)| frame).ok_or_else(stopped)
        });
        return match written {
            Err(_) if stop.load(Ordering::Relaxed) => Ok(Outcome::Stopped),
            written => Ok(written.map(|()| Outcome::Written)?),
        };
    }
    let Some((frame, _)) = drawing.frame_until(0, progress, stop)? else { return Ok(Outcome::Stopped) };
    frame.write(&job, path)?;
    Ok(Outcome::Written)
}
