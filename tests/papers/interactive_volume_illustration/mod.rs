//! Nagy, Schneider and Westermann 2002: what the paper and the specification say, in pictures and strokes of phantoms whose
//! truth is known.

mod hatching;
mod merged;
mod outlines;
mod toon;
mod without_iso;

use drypoint::job::{Job, RenderTarget};
use drypoint::marking::Marking;
use drypoint::scene::counts::Counts;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::marks::Marks;
use drypoint::scene::source::Disk;
use std::path::Path;
use std::sync::Arc;

/// The points and lines of a scene's first frame.
fn page(scene: &str, target: RenderTarget) -> (Marks, Counts, Job) {
    let scene = parse(scene, Path::new("scene.toml"), &Overrides::default()).unwrap();
    let job = Job::load_for(scene, target, Arc::new(Disk)).unwrap();
    let mut counts = Counts::default();
    let marking = Marking::new(&job, &mut counts, &|_| ()).unwrap();
    let marks = marking.frames(&mut counts).unwrap().draw(&job.view().unwrap(), &mut counts).unwrap();
    drop(marking);
    (marks, counts, job)
}
