//! Parts that are not kept are gone, and those that are kept have their bits ([VOL-2]).

use drypoint::job::Job;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::picture::Picture;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{Keep, PartsTable, Scene};
use drypoint::scene::volume::{Volume, Voxels};

const SIZE: [usize; 3] = [40, 20, 20];

/// Soft balls along x: their centres and radii. Values are 200 at a centre and 100 at a radius.
fn balls(balls: &[(f64, f64)]) -> Volume {
    let value = |i: usize| {
        let p = [i % 40, i / 40 % 20, i / 800].map(|i| i as f64);
        let of = |(x, r): &(f64, f64)| {
            let d = ((p[0] - x).powi(2) + (p[1] - 9.0).powi(2) + (p[2] - 9.0).powi(2)).sqrt();
            100.0 + 100.0 * (r - d) / r
        };
        balls.iter().map(of).fold(10.0, f64::max)
    };
    let voxels = Voxels::F64((0..SIZE.iter().product()).map(value).collect());
    Volume::new(Grid::with_spacing(SIZE, [1.0; 3]).unwrap(), voxels, 1.0, 0.0).unwrap()
}

/// A scene of what is above 100, with all that a sample can have.
fn scene(more: &str) -> Scene {
    let text = format!(
        "drypoint = 1\n[volume]\nfile = \"none.nrrd\"\ngradient_range = [0, 30]\n[camera]\ndirection = [0, 1, 0]\n\
         [picture]\nsize = [60, 40]\nsamples = 1\n[transfer]\nkind = \"regular\"\nnodes = [{{ at = 100, color = \
         \"red\", opacity = 0 }}, {{ at = 140, color = \"blue\", opacity = 0.5 }}]\n[shading]\n[contours]\n{more}"
    );
    parse(&text, "scene.toml".as_ref(), &Overrides::default()).unwrap()
}

fn drawn(mut scene: Scene, parts: Option<PartsTable>, volume: &Volume) -> (Picture, Job) {
    scene.volume.parts = parts;
    let job = Job::with_volume(scene, volume.clone()).unwrap();
    let picture = job.renderer().unwrap().frame(&|_| ()).0;
    (picture, job)
}

fn keep(keep: Keep) -> Option<PartsTable> {
    Some(PartsTable { keep, at_least: None })
}

#[test]
fn kept_parts_are_drawn_as_if_they_were_alone() {
    // 14 voxels lie between the two.
    let (both, large) = (balls(&[(8.0, 6.0), (33.0, 4.0)]), balls(&[(8.0, 6.0)]));
    let (alone, _) = drawn(scene(""), None, &large);
    let (kept, job) = drawn(scene(""), keep(Keep::Largest(1)), &both);
    assert_eq!(kept, alone);
    // Voxels nearer to a centre than its radius: lattice points in open balls of radius 6 and 4.
    assert_eq!((job.counts.parts, job.counts.parts_kept, &job.counts.part_sizes[..]), (2, 1, &[895, 251][..]));
    let (whole, _) = drawn(scene(""), None, &both);
    assert_ne!(whole, kept);
    for all in [Keep::Share(0.0), Keep::Largest(2), Keep::Share(0.28)] {
        assert_eq!(drawn(scene(""), keep(all), &both).0, whole);
    }
    let at = Keep::At([33.0, 9.0, 9.0].into());
    assert_eq!(drawn(scene(""), keep(at), &both).0, drawn(scene(""), None, &balls(&[(33.0, 4.0)])).0);
}

#[test]
fn a_scene_without_function_has_the_parts_of_its_surface() {
    let text = "[surface]\niso = 100\nlook = \"phong\"\n";
    let surface = || Scene { transfer: None, contours: None, ..scene(text) };
    let (both, large) = (balls(&[(8.0, 6.0), (33.0, 4.0)]), balls(&[(8.0, 6.0)]));
    let (kept, job) = drawn(surface(), keep(Keep::Largest(1)), &both);
    // The surface's parts have the voxels on it, too.
    assert_eq!((kept, job.counts.parts), (drawn(surface(), None, &large).0, 2));
    assert_eq!(job.counts.part_sizes, [925, 257]);
    // A value in the place of the surface's: both balls have it at their centres alone.
    let at_least = Some(PartsTable { keep: Keep::Largest(1), at_least: Some(190.0) });
    let (_, job) = drawn(surface(), at_least, &both);
    assert_eq!(job.counts.part_sizes, [1, 1]);
}

#[test]
fn what_cannot_be_kept_is_said_at_its_key() {
    let both = balls(&[(8.0, 6.0), (33.0, 4.0)]);
    let fault = |mut scene: Scene, parts| {
        scene.volume.parts = parts;
        Job::with_volume(scene, both.clone()).err().unwrap().to_string()
    };
    let nowhere = fault(scene(""), keep(Keep::At([20.0, 1.0, 1.0].into())));
    assert!(nowhere.starts_with("error: there is no part at [20, 1, 1]\n"), "{nowhere}");
    let stippled = parse(
        "drypoint = 1\n[volume]\nfile = \"none.nrrd\"\n[volume.parts]\n[stipples]\n[picture]\nsize = [20, 20]\n",
        "scene.toml".as_ref(),
        &Overrides::default(),
    );
    let none = fault(stippled.unwrap(), keep(Keep::Largest(1)));
    assert!(
        none.contains("nothing in the scene says which voxels are parts\n  at: scene.toml:4:9, key volume.parts"),
        "{none}"
    );
}
