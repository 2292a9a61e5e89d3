//! Points behind an iso-surface ([STIP-15]), in whole pages.

use drypoint::job::{Job, RenderTarget};
use drypoint::scene::counts::Counts;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::glam::DVec3;
use drypoint::scene::marks::Dot;
use drypoint::scene::source::Disk;
use drypoint::stippling::Stippling;
use std::path::Path;
use std::sync::Arc;

const SCENE: &str = r#"drypoint = 1
[volume]
phantom = { name = "sphere", size = 40, type = "u8" }
[camera]
projection = "orthographic"
direction = [0, 1, 0]
[picture]
size = [200, 200]
[stipples]
k_max = 1
thin = true
snap = "edge"
"#;

/// Dots lie on the edge, so that all have a foot on the surface: those of the scene with a line more in `[stipples]`, what was
/// counted, and the middle of the sphere.
fn page(line: &str) -> (Vec<Dot>, Counts, DVec3) {
    let scene = parse(&format!("{SCENE}{line}\n"), Path::new("sphere.toml"), &Overrides::default()).unwrap();
    let job = Job::load_for(scene, RenderTarget::Marks, Arc::new(Disk)).unwrap();
    let mut counts = job.counts.clone();
    let stippling = Stippling::new(&job, &mut counts, &|_| ()).unwrap();
    let marks = stippling.frames().draw(&job.view().unwrap(), &mut counts);
    (marks.unwrap_or_else(|failure| panic!("{failure}")).layers[0].dots.clone(), counts, job.volume.grid().centre())
}

/// Where the sphere's surface lies among the values: the middle of the 8 bits.
const ISO: f64 = 127.5;

#[test]
fn the_back_of_a_sphere_is_not_drawn_and_nothing_else_changes() {
    let (all, counts, centre) = page("");
    let (seen, counted, _) = page(&format!("hide_behind = {ISO}"));
    // Without the key nothing of it is made.
    assert!(!counts.bytes.contains_key("surface") && !counts.preprocess.contains_key("hidden points"));
    assert_eq!(counted.preprocess["hidden points"], (all.len() - seen.len()) as u64);
    // The other dots are those that they were.
    let mut rest = all.iter();
    assert!(seen.iter().all(|dot| rest.any(|other| other == dot)));
    // Half of a sphere of more than 10 voxels faces the eye, which looks along y; its rim is √(2δ/R) wide.
    let facing = |dot: &Dot| -(dot.world - centre).normalize().y;
    assert!(seen.iter().all(|dot| facing(dot) > -(2.0f64 * 0.15 / 10.0).sqrt()));
    let front = all.iter().filter(|dot| facing(dot) > 0.05).count();
    assert_eq!(seen.iter().filter(|dot| facing(dot) > 0.05).count(), front);
    assert!(front > 500, "{front}");
}

#[test]
fn a_value_that_is_found_hides_the_same() {
    let (found, counts, _) = page("hide_behind = \"auto\"");
    let (given, ..) = page(&format!("hide_behind = {ISO}"));
    assert!(counts.preprocess["differences"] > 0);
    let share = found.len() as f64 / given.len() as f64;
    // Within its edge of one voxel a sphere of 12 is a twelfth larger or smaller, and has as many dots on its front.
    assert!((1.0 - 1.0 / 12.0..1.0 + 1.0 / 12.0).contains(&share), "{share}");
}
