//! Objects: the brush over the picture, moves by handles, boxes that cut.

use super::{SCENE, Window, click, drag, middle, pixels, press, settle, text, viewer, window};
use drypoint::job::Job;
use drypoint::picking::pick_pixel;
use drypoint::scene::glam::DVec3;
use drypoint::scene::tables::{PaintMode, PaintTarget};
use drypoint_viewer::app::Backend;
use drypoint_viewer::document::Document;
use eframe::egui::{Key, Modifiers, PointerButton, Pos2, Vec2};
use egui_kittest::kittest::Queryable;

fn open(text: &str, panel: &str) -> Option<Window> {
    let mut window = window(text, Backend::Reference)?;
    window.get_by_label(panel).click();
    window.run_steps(3);
    Some(window)
}

/// Waits for the dabs of a stroke, and for their picture.
fn finish(window: &mut Window) {
    super::wait_for(window, "no dabs", |window| (!viewer(window).session.is_stroke_open).then_some(()));
    settle(window);
}

/// A place in the window of a point of the world.
fn place(window: &Window, p: DVec3) -> Pos2 {
    let rect = window.get_by_label("Picture").rect();
    let scale = (rect.width() / 96.0).min(rect.height() / 72.0);
    let [x, y] = viewer(window).session.pose().unwrap().view.point_of(p).unwrap();
    rect.center() + Vec2::new(x as f32 - 48.0, y as f32 - 36.0) * scale
}

/// A drag of the brush is one change. Its dabs are where `drypoint pick` sees the volume without the object, in the order
/// of the drag, and to erase along the same way with a brush of memberships 1 leaves nothing.
#[test]
fn a_stroke_paints_what_is_seen_and_is_erased() {
    let Some(mut window) = open(SCENE, "Objects") else { return };
    let first = pixels(&window);
    window.get_by_label("ball").click();
    press(&mut window, Key::B, Modifiers::NONE);
    let from = middle(&window) + Vec2::new(-60.0, 40.0);
    let to = from + Vec2::new(48.0, 12.0);
    drag(&mut window, PointerButton::Primary, from, to, Modifiers::NONE);
    finish(&mut window);
    let job = Job::load(Document::untitled(SCENE.into(), "ring.toml".into()).scene().unwrap()).unwrap();
    let renderer = job.renderer().unwrap();
    let rect = window.get_by_label("Picture").rect();
    let scale = (rect.width() / 96.0).min(rect.height() / 72.0);
    let seen = |share: f32| {
        let pixel = (from + (to - from) * share - rect.center()) / scale + Vec2::new(48.0, 36.0);
        pick_pixel(&renderer, [pixel.x as usize, pixel.y as usize]).map(|picked| picked.world)
    };
    let painted = viewer(&window).session.scene.clone().unwrap();
    let strokes = painted.objects[0].strokes.clone().unwrap();
    assert!(strokes.len() > 1, "{}", text(&window));
    let mut share = 0;
    for stroke in &strokes {
        let PaintTarget::At(at) = stroke.target else { panic!() };
        assert_eq!(stroke.mode, PaintMode::Add);
        let is_there = |i: &i32| seen(*i as f32 / 480.0).is_some_and(|p| p.distance(at) < 2e-3);
        share = (share..=480).find(is_there).unwrap_or_else(|| panic!("{at} is not seen: {}", text(&window)));
    }
    assert!(text(&window).contains("strokes = [\n  { at = ["), "{}", text(&window));
    assert!(super::difference(&first, &pixels(&window)) > 0.01 && viewer(&window).session.failures.is_none());
    // The view has not turned, and turns with Ctrl.
    assert!(text(&window).contains("eye = [50, -20, 40]"));
    window.get_by_label("erase").click();
    window.run_steps(2);
    drag(&mut window, PointerButton::Primary, from, to, Modifiers::NONE);
    finish(&mut window);
    let erased = viewer(&window).session.scene.clone().unwrap();
    let erased = erased.objects[0].strokes.clone().unwrap();
    assert_eq!(erased.len(), 2 * strokes.len());
    assert!(erased[strokes.len()..].iter().all(|stroke| stroke.mode == PaintMode::Subtract));
    assert_eq!(pixels(&window), first);
    for expected in [2 * strokes.len(), strokes.len()] {
        assert_eq!(text(&window).matches("{ at = [").count(), expected);
        press(&mut window, Key::Z, Modifiers::COMMAND);
    }
    assert_eq!(text(&window), SCENE);
    drag(&mut window, PointerButton::Primary, from, to, Modifiers::COMMAND);
    assert!(!text(&window).contains("eye = [50, -20, 40]") && !text(&window).contains("{ at = ["));
}

/// The first click of the brush makes an object in a colour of its own. Another selects nothing that is seen.
#[test]
fn a_click_paints_a_new_object() {
    let Some(mut window) = open(SCENE, "Objects") else { return };
    let first = pixels(&window);
    window.get_by_label("Paint").click();
    window.run_steps(2);
    let beside = window.get_by_label("Picture").rect().center_top() + Vec2::new(0.0, 120.0);
    click(&mut window, beside);
    finish(&mut window);
    assert_eq!(text(&window), SCENE);
    let at = middle(&window) + Vec2::new(-60.0, 40.0);
    click(&mut window, at);
    finish(&mut window);
    let scene = viewer(&window).session.scene.clone().unwrap();
    assert_eq!(scene.objects[0].strokes.as_ref().unwrap().len(), 1, "{}", text(&window));
    assert!(super::difference(&first, &pixels(&window)) > 0.002 && viewer(&window).session.failures.is_none());
}

/// The handle of an axis moves the object along it, and no other way.
#[test]
fn an_object_is_moved_by_its_handle() {
    let scene = format!("{SCENE}\n[[object]]\nname = \"ring\"\nvalue = [[140, 0], [141, 1]] # bright\n");
    let Some(mut window) = open(&scene, "Objects") else { return };
    let first = pixels(&window);
    for (name, axis) in [("Move along z", DVec3::Z), ("Move along x", DVec3::X)] {
        let before = viewer(&window).session.scene.clone().unwrap().objects[0].motion.shift;
        let handle = window.get_by_label(name).rect().center();
        let boxes = viewer(&window).session.boxes[0].unwrap();
        let centre = boxes.iter().sum::<DVec3>() / 8.0 + before;
        let reach = boxes.iter().map(|corner| (*corner + before - centre).dot(axis)).fold(0.0, f64::max);
        let foot = centre + axis * reach;
        assert!(place(&window, foot).distance(handle) < 2.0, "{name}");
        let to = place(&window, foot + axis * 2.0);
        drag(&mut window, PointerButton::Primary, handle, to, Modifiers::NONE);
        settle(&mut window);
        let moved = viewer(&window).session.scene.clone().unwrap().objects[0].motion.shift - before;
        assert!((moved.dot(axis) - 2.0).abs() < 0.2 && (moved - axis * moved.dot(axis)).length() < 1e-9, "{moved}");
    }
    assert!(super::difference(&first, &pixels(&window)) > 0.01);
    assert!(text(&window).contains("# bright\nmove = [") && text(&window).contains("eye = [50, -20, 40]"));
    press(&mut window, Key::Z, Modifiers::COMMAND);
    press(&mut window, Key::Z, Modifiers::COMMAND);
    assert_eq!(text(&window), scene);
}

/// A box that cuts is added as large as the volume, and a handle moves one of its sides.
#[test]
fn a_side_of_a_clip_box_is_moved_by_its_handle() {
    let Some(mut window) = open(SCENE, "Cuts") else { return };
    let first = pixels(&window);
    window.get_by_label("or a box").click();
    settle(&mut window);
    let added = text(&window);
    let extent = viewer(&window).session.scene.clone().unwrap().clips[0].extent.unwrap();
    assert!(super::difference(&first, &pixels(&window)) < 0.005, "{added}");
    let middle = DVec3::from_array(extent.map(|[lo, hi]| (lo + hi) / 2.0));
    let side = DVec3::new(middle.x, middle.y, extent[2][1]);
    let handle = window.get_by_label("Clip box 0, z to").rect().center();
    let to = place(&window, side) + (place(&window, side - DVec3::Z * 11.0) - place(&window, side));
    drag(&mut window, PointerButton::Primary, handle, to, Modifiers::NONE);
    settle(&mut window);
    let mut moved = viewer(&window).session.scene.clone().unwrap().clips[0].extent.unwrap();
    let by = moved[2][1] - extent[2][1];
    moved[2][1] = extent[2][1];
    assert!(moved == extent && (by + 11.0).abs() < 2.0, "{by} {}", text(&window));
    assert!(super::difference(&first, &pixels(&window)) > 0.01);
    press(&mut window, Key::Z, Modifiers::COMMAND);
    assert_eq!(text(&window), added);
}
