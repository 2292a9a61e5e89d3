//! Frames that are stopped: little is drawn after that, and the frames that follow are whole.

use drypoint::frames::{Frames, ReferenceFrames};
use drypoint::job::Job;
use drypoint::scene::file::{Overrides, parse};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

const SCENE: &str = r##"
drypoint = 1
[volume]
phantom = { name = "torus", size = 24 }
[picture]
size = [160, 120]
[transfer]
kind = "regular"
nodes = [{ at = 100, color = "white", opacity = 0 }, { at = 150, color = "#ffcc88", opacity = 0.3 }]
[shading]
"##;

/// A frame that is stopped has no picture and tells no later share; one that is stopped before it begins tells nothing. Stopping
/// leaves nothing behind.
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
        // With halos bands of a few rows follow each other.
        let renderer = job.renderer().unwrap().with_band(2000);
        let mut frames = ReferenceFrames::new(renderer, &job.scene);
        let whole = frames.frame(&|_| ()).unwrap().0;
        let (stop, heard) = (AtomicBool::new(false), AtomicUsize::new(0));
        let drawn = frames.frame_until(
            &|share| {
                heard.fetch_max((100.0 * share) as usize, Ordering::Relaxed);
                stop.fetch_or(share >= 0.3, Ordering::Relaxed);
            },
            &stop,
        );
        let last = heard.into_inner();
        assert!(drawn.unwrap().is_none() && (30..90).contains(&last), "{tables}: {last} %");
        let none = frames.frame_until(&|_| panic!("nothing is drawn"), &stop);
        assert!(none.unwrap().is_none(), "{tables}");
        let again = frames.frame_until(&|_| (), &AtomicBool::new(false)).unwrap();
        assert_eq!(again.map(|(picture, _)| picture), Some(whole), "{tables}");
    }
}
