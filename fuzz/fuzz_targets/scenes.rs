//! Scene files. A line `#set key=value` is an override as well as a comment of the file.

#![no_main]

use drypoint_fuzz::{check_error, start};
use drypoint_scene::file::{Faults, Overrides, differences, identity, parse, write_full};
use drypoint_scene::knobs::knobs;
use drypoint_scene::marks::{Page, Pen};
use drypoint_scene::plan::Plan;
use drypoint_scene::space::Grid;
use drypoint_scene::tables::Scene;
use drypoint_scene::transfer::Function;
use drypoint_scene::view::View;
use drypoint_scene::volume::{Volume, Voxels};
use libfuzzer_sys::fuzz_target;
use std::path::Path;

fuzz_target!(init: start(), |data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let mut overrides = Overrides::default();
    for argument in text.lines().filter_map(|line| line.strip_prefix("#set ")) {
        if let Err(faults) = overrides.push_argument(argument) {
            check_faults(&faults);
        }
    }
    match parse(text, Path::new("scene.toml"), &overrides) {
        Ok(scene) => check_scene(&scene),
        Err(faults) => check_faults(&faults),
    }
});

/// Checks that the text of a scene is the scene, and asks for its plans and knobs.
fn check_scene(scene: &Scene) {
    let text = write_full(scene);
    let back = parse(&text, Path::new("scene.toml"), &Overrides::default());
    let back = back.unwrap_or_else(|faults| panic!("{text}\n{faults}"));
    assert_eq!(&back, scene, "{text}");
    assert_eq!(write_full(&back), text);
    assert_eq!(identity(&back), identity(scene));
    assert_eq!(differences(&back, scene), <[String; 0]>::default());
    let plan = Plan::new(scene);
    for plan in [&plan, &Plan::of_marks(scene), &Plan::of_points(scene), &Plan::of_strokes(scene)] {
        assert!(!plan.to_string().is_empty());
    }
    check_numbers(scene);
    for knob in knobs(scene, &plan) {
        if let Err(faults) = knob.set(scene, knob.finest()) {
            check_faults(&faults);
        }
    }
}

/// Turns what a scene says into the numbers of a small volume: camera, function, page and pens.
fn check_numbers(scene: &Scene) {
    let grid = Grid::with_spacing([4, 3, 5], [1.0, 1.5, 2.0]).expect("a grid of few voxels");
    let ramp = Voxels::U8((0..60).collect());
    let volume = Volume::new(grid, ramp, 1.0, 0.0).expect("a volume of few voxels");
    if let Ok(view) = View::new(&scene.camera, volume.grid(), scene.picture.size) {
        view.ray(0.5, 0.5);
    }
    if let Some(transfer) = &scene.transfer
        && let Ok(Some(function)) = Function::new(transfer, volume.range(), &volume, &|name| name.parse().ok())
    {
        function.can_be_visible(volume.range(), None, |value| value);
    }
    let page = Page::of(scene);
    assert!(Pen::of(&scene.pens, &page).iter().all(|pen| pen.width > 0.0));
}

/// Checks that there is a fault, and that each is told in three lines.
fn check_faults(faults: &Faults) {
    let told = faults.to_string();
    assert_eq!(told.lines().count(), 3 * faults.iter().count(), "{told}");
    let mut lines = told.lines().map(str::to_owned);
    while let Some(what) = lines.next() {
        check_error([what, lines.next().unwrap_or_default(), lines.next().unwrap_or_default()]);
    }
}
