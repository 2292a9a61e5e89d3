//! Frames that are stopped: little is drawn after that, and the frames that follow are whole.

use drypoint::frames::{Frames, ReferenceFrames};
use drypoint::job::Job;
use drypoint::scene::file::{Overrides, parse};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

const SCENE: &str = r##"
drypoint = 1
[volume]
phantom = { name = "torus", size = 24 }
[picture]
size = [96, 80]
[transfer]
kind = "regular"
nodes = [{ at = 100, color = "white", opacity = 0 }, { at = 150, color = "#ffcc88", opacity = 0.3 }]
[shading]
"##;

/// A frame ends at the share at which it is stopped, but for the tiles or the group of planes at hand; one that is stopped
/// before it begins casts no ray. Stopping leaves nothing behind.
#[test]
fn a_stopped_frame_ends_and_the_next_one_is_whole() {
    let halo = "[[halo]]\nseed.value = [[100, 0], [150, 1]]\n";
    for tables in ["[picture]\nsamples = 1\n", "[picture]\nsamples = \"auto\"\n", halo] {
        let text = match tables.strip_prefix("[picture]\n") {
            Some(keys) => SCENE.replace("[picture]\n", &format!("[picture]\n{keys}")),
            None => format!("{SCENE}{tables}"),
        };
        let scene = parse(&text, "stop.toml".as_ref(), &Overrides::default()).unwrap_or_else(|f| panic!("{f}"));
        let job = Job::load(scene).unwrap_or_else(|failures| panic!("{failures}"));
        let stop = Arc::new(AtomicBool::new(false));
        let mut frames = ReferenceFrames::new(job.renderer().unwrap(), &job.scene);
        frames.stop_by(stop.clone());
        let (whole, counts) = frames.frame(&|_| ()).unwrap();
        let (_, stopped) = frames.frame(&|share| stop.store(share >= 0.3, Ordering::Relaxed)).unwrap();
        assert!(stop.load(Ordering::Relaxed), "{tables}: the share at which the frame was stopped is its last one");
        let share = stopped.samples as f64 / counts.samples as f64;
        assert!(share > 0.05 && share < 0.75, "{tables}: {share} of the samples");
        let (_, none) = frames.frame(&|_| ()).unwrap();
        assert_eq!([none.rays, none.samples], [0, 0], "{tables}");
        stop.store(false, Ordering::Relaxed);
        let (again, of_again) = frames.frame(&|_| ()).unwrap();
        assert_eq!((again, of_again.samples), (whole, counts.samples), "{tables}");
    }
}
