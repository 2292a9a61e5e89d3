//! The card against the reference in the window.

use super::{SCENE, Window, viewer, wait_for, window};
use drypoint_viewer::app::Backend;
use drypoint_viewer::compare::{compare, reduced};
use eframe::egui::Color32;
use egui_kittest::kittest::Queryable;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// The panel shows the verdict and the figures of `drypoint validate`.
#[test]
fn a_comparison_tells_what_the_command_tells() {
    let auto = SCENE.replace("samples = 1", "samples = \"auto\"");
    let Some(mut window) = window(&auto, Backend::Reference) else { return };
    window.get_by_label("Compare").click();
    window.run_steps(3);
    // One that is cancelled says nothing, and another one can start.
    window.get_by_label("Compare now").click();
    wait_for(&mut window, "no comparison", |window| window.query_by_label("Cancel").map(|cancel| cancel.click()));
    window.run_steps(3);
    let has_said = |window: &Window| window.query_by_label_contains("Bounds: ").is_some();
    assert!(window.query_by_label("Cancel").is_none() && !has_said(&window));
    std::thread::sleep(Duration::from_secs(1));
    window.run_steps(2);
    assert!(!has_said(&window), "the comparison was not cancelled");
    window.get_by_label("Compare now").click();
    wait_for(&mut window, "no verdict", |window| window.query_by_label_contains("Bounds: ").map(|_| ()));
    window.run_steps(3);
    let session = &viewer(&window).session;
    let scene = reduced(session.scene.as_ref().unwrap(), 64);
    let card = session.card.clone().unwrap();
    let volume = session.data().unwrap().volume.clone();
    let stopped = compare(scene.clone(), volume.clone(), &card, &AtomicBool::new(true)).unwrap();
    assert!(stopped.is_none());
    let direct = compare(scene, volume, &card, &AtomicBool::new(false)).unwrap().unwrap();
    let bounded = direct.found.bounded.as_ref().unwrap();
    assert!(bounded.measured > 0.0 && bounded.measured <= bounded.bound && direct.found.parts_at.is_none());
    assert_eq!(direct.difference.size, [64, 48]);
    // The largest difference is the end of the map Magma, and the background is black.
    let is_largest = |pixel: &&Color32| pixel.to_array() == [252, 253, 191, 255];
    assert_eq!(direct.difference.pixels.iter().filter(is_largest).count(), 1);
    assert_eq!(direct.difference.pixels[0], Color32::from_rgb(0, 0, 4));
    assert!(direct.largest_flip >= direct.found.flip && direct.largest_flip < 1e-2);
    let figures = [format!("{:.1e}", bounded.measured), format!("{:.1e}", bounded.bound), direct.found.adapter.clone()];
    let verdict = format!("Bounds: {}", direct.found.verdict());
    assert_eq!(verdict, "Bounds: kept");
    for label in figures.iter().chain([&verdict]) {
        assert!(window.query_all_by_label(label).next().is_some(), "{label}");
    }
    assert!(window.query_by_label("Picture of the difference").is_some());
}
