//! Objects: the brush over the picture, moves by handles, boxes that cut.

use super::{SCENE, Window, click, drag, middle, pixels, press, settle, text, viewer, window};
use drypoint::job::Job;
use drypoint::picking::pick_pixel;
use drypoint::scene::clip::ClipPlane;
use drypoint::scene::glam::{DAffine3, DVec3};
use drypoint::scene::tables::{NodeColor, PaintMode, PaintStroke, PaintTarget};
use drypoint::scene::view::View;
use drypoint_viewer::app::Backend;
use drypoint_viewer::document::Document;
use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, Vec2};
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

/// A drag of the brush is one change. Its dabs are at the voxels that `drypoint pick` sees without the object, in the order
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
        pick_pixel(&renderer, [pixel.x as usize, pixel.y as usize]).map(|picked| picked.index.round())
    };
    let painted = viewer(&window).session.scene.clone().unwrap();
    let strokes = painted.objects[0].strokes.clone().unwrap();
    assert!(strokes.len() > 1, "{}", text(&window));
    let mut share = 0;
    for stroke in &strokes {
        let PaintTarget::At(at) = stroke.target else { panic!() };
        assert_eq!(stroke.mode, PaintMode::Add);
        let is_there = |i: &i32| seen(*i as f32 / 480.0) == Some(at);
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

/// A painted object has the look of the picture in another style of its theme, which may lack the usual one.
#[test]
fn a_new_object_has_a_style_of_the_theme() {
    let folder = tempfile::tempdir().unwrap();
    let theme = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../data/themes/studio");
    for name in ["bone.png", "wax.png"] {
        std::fs::copy(theme.join(name), folder.path().join(name)).unwrap();
    }
    let nodes = "nodes = [{ at = 120, style = \"bone\", opacity = 0 }, { at = 150, style = \"bone\", opacity = 0.9 }]";
    let mixed = "transparency = \"plain\" # clear\nmix = \"printed\"\nsphere_frame = \"view\"\ntable = 64\n";
    let head = SCENE.split("[transfer]").next().unwrap();
    let scene = format!("{head}[styles]\ntheme = {:?}\n[transfer]\n{mixed}{nodes}\n", folder.path());
    let Some(mut window) = open(&scene, "Objects") else { return };
    let first = pixels(&window);
    press(&mut window, Key::B, Modifiers::NONE);
    let at = middle(&window) + Vec2::new(-60.0, 40.0);
    click(&mut window, at);
    finish(&mut window);
    let session = &viewer(&window).session;
    assert!(session.failures.is_none(), "{:?}", session.failures);
    let scene = session.scene.clone().unwrap();
    let mut expected = scene.transfer.clone().unwrap();
    for node in expected.nodes.iter_mut().flatten() {
        node.color = NodeColor::Style("wax".into());
    }
    assert_eq!(scene.objects[0].transfer.as_ref(), Some(&expected));
    assert!(super::difference(&first, &pixels(&window)) > 0.002);
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

/// A selection that is decoupled stays before the eye while keys turn, pan and scale the view: V'M' = VM. One that is pinned
/// keeps its pixel and its depth, and one that is integrated its motion. A turn is undone as a whole.
#[test]
fn selections_follow_the_camera() {
    let objects = ["decoupled", "pinned", "integrated"].map(|state| {
        let select = "value = [[140, 0], [141, 1]]\nmove = [1, 2, 3] # up\nrotate = { axis = [1, 0, 0], angle = 30 }";
        format!("[[object]]\nname = \"{state}\"\ninteraction = \"{state}\"\n{select}\n")
    });
    let scene = format!("{SCENE}\n{}", objects.join("\n"));
    let Some(mut window) = open(&scene, "Objects") else { return };
    let centre = viewer(&window).session.boxes[0].unwrap().iter().sum::<DVec3>() / 8.0;
    let state = |window: &Window| {
        let session = &viewer(window).session;
        let motions =
            session.document.scene().unwrap().objects.iter().map(|object| object.motion.map(centre)).collect();
        (session.pose().unwrap().view, motions)
    };
    let (before, motions): (View, Vec<DAffine3>) = state(&window);
    for key in [Key::ArrowLeft, Key::ArrowUp, Key::ArrowLeft, Key::PageUp] {
        press(&mut window, key, Modifiers::NONE);
    }
    settle(&mut window);
    let (now, moved) = state(&window);
    assert!(now.eye.distance(before.eye) > 1.0 && viewer(&window).session.failures.is_none());
    let seen = |view: &View, motion: &DAffine3, p: DVec3| view.to_eye(motion.transform_point3(p));
    for p in [centre, DVec3::ZERO, DVec3::new(30.0, -7.0, 4.0)] {
        let off = seen(&now, &moved[0], p) - seen(&before, &motions[0], p);
        assert!(off.length() < 1e-9, "{off}");
    }
    let off = seen(&now, &moved[1], centre) - seen(&before, &motions[1], centre);
    assert!(off.length() < 1e-9 && moved[1].matrix3.abs_diff_eq(motions[1].matrix3, 1e-12), "{off}");
    assert_eq!(moved[2], motions[2]);
    assert_eq!(text(&window).matches("matrix = [[").count(), 2, "{}", text(&window));
    while viewer(&window).session.document.text() != scene {
        assert!(text(&window).contains("matrix = [["), "{}", text(&window));
        press(&mut window, Key::Z, Modifiers::COMMAND);
    }
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

/// A ring of flat voxels under parallel rays, so that a brush has one size in the whole picture.
fn flat() -> String {
    let scene = SCENE.replace("size = 24 }", "size = 24, spacing = [1, 1.5, 2] }");
    let camera = "projection = \"orthographic\"\nheight = 26\ndirection = [-1, 1, -2]\n";
    scene.replace("eye = [50, -20, 40]   # from above\ntarget = [12, 12, 12]\n", camera)
}

/// Presses the brush at a place and drags it by a way, and keeps the button down.
fn press_and_drag(window: &mut Window, from: Pos2, by: Vec2) {
    window.hover_at(from);
    window.run_steps(2);
    window.event(button(from, true));
    window.step();
    window.hover_at(from + by);
    window.step();
}

fn button(pos: Pos2, pressed: bool) -> Event {
    Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE }
}

/// The voxels, in world space, of the dabs in the document.
fn dabs(window: &Window) -> Vec<DVec3> {
    let scene = viewer(window).session.document.scene().unwrap();
    let strokes = scene.objects.first().and_then(|object| object.strokes.clone()).unwrap_or_default();
    let at = |stroke: &PaintStroke| if let PaintTarget::At(at) = stroke.target { at } else { panic!("{stroke:?}") };
    strokes.iter().map(at).collect()
}

/// Commands wait for the dabs of a stroke: it keeps its places though keys turn the view, and it is undone as a whole. A
/// stroke of length L has ⌊3 L/R⌋ + 1 dabs of radius R.
#[test]
fn commands_wait_for_the_stroke() {
    let Some(mut window) = open(&flat(), "Objects") else { return };
    let view = viewer(&window).session.pose().unwrap().view;
    let rect = window.get_by_label("Picture").rect();
    let scale = (rect.width() / 96.0).min(rect.height() / 72.0);
    press(&mut window, Key::B, Modifiers::NONE);
    let (from, by) = (middle(&window) + Vec2::new(-80.0, 92.0), Vec2::new(170.0, -8.0));
    press_and_drag(&mut window, from, by);
    for key in [Key::ArrowLeft, Key::B] {
        press(&mut window, key, Modifiers::NONE);
    }
    press(&mut window, Key::S, Modifiers::COMMAND);
    assert!(viewer(&window).session.is_stroke_open && text(&window).contains("direction = [-1, 1, -2]"));
    window.event(button(from + by, false));
    finish(&mut window);
    window.run_steps(2);
    let session = &viewer(&window).session;
    assert!(!session.is_painting && !session.document.text().contains("direction = [-1, 1, -2]"), "{}", text(&window));
    // The first voxel's side is 1, and so 5 voxels are 5 units of the world.
    let radius = 5.0 / view.pixel as f32 * scale;
    let found = dabs(&window);
    assert_eq!(found.len(), (3.0 * by.length() / radius) as usize + 1);
    // Each lies within half a voxel of the way of the drag, as it was seen then.
    let half_a_voxel = (0.5 * DVec3::new(1.0, 1.5, 2.0).length() / view.pixel + 1.0) as f32;
    for (i, at) in found.iter().enumerate() {
        let [x, y] = view.point_of(*at).unwrap();
        let drawn = (from + by.normalized() * (i as f32 * radius / 3.0) - rect.center()) / scale;
        let off = Vec2::new(x as f32 - 48.0, y as f32 - 36.0) - drawn;
        assert!(off.length() < half_a_voxel, "{i}: {off}");
        // It is the middle of a voxel.
        assert_eq!((*at / DVec3::new(1.0, 1.5, 2.0)).fract(), DVec3::ZERO);
    }
    for _ in 0..2 {
        press(&mut window, Key::Z, Modifiers::COMMAND);
    }
    assert_eq!(text(&window), flat());
    // An undo in the midst of a stroke waits, too, and takes the whole stroke.
    press(&mut window, Key::B, Modifiers::NONE);
    press_and_drag(&mut window, from, by);
    press(&mut window, Key::Z, Modifiers::COMMAND);
    assert!(viewer(&window).session.is_stroke_open);
    window.event(button(from + by, false));
    finish(&mut window);
    window.run_steps(2);
    assert_eq!(text(&window), flat());
    press(&mut window, Key::Z, Modifiers::COMMAND.plus(Modifiers::SHIFT));
    assert_eq!(dabs(&window).len(), found.len());
}

/// Dabs that are still to come when another document is opened are dropped, and the next stroke is that document's.
#[test]
fn dabs_do_not_land_in_another_document() {
    let Some(mut window) = open(&flat(), "Objects") else { return };
    let other = SCENE.replace("0.9", "0.8");
    let [on_the_flat_ring, from] = [[-80.0, 92.0], [-60.0, 40.0]].map(|by| middle(&window) + Vec2::from(by));
    press(&mut window, Key::B, Modifiers::NONE);
    // One dab is asked about in the last pass, others wait.
    press_and_drag(&mut window, on_the_flat_ring, Vec2::new(170.0, -8.0));
    let session = &mut window.state_mut().as_mut().unwrap().session;
    assert!(session.is_stroke_open);
    session.take(Document::untitled(other.clone(), "other.toml".into()));
    assert!(!session.is_stroke_open && !session.is_painting);
    window.event(button(from, false));
    settle(&mut window);
    std::thread::sleep(std::time::Duration::from_millis(300));
    window.run_steps(5);
    assert!(text(&window) == other && !viewer(&window).session.is_stroke_open);
    press(&mut window, Key::B, Modifiers::NONE);
    click(&mut window, from);
    finish(&mut window);
    assert_eq!(dabs(&window).len(), 1);
    // A stroke goes on while another program writes the file, with the brush that it was begun with.
    press_and_drag(&mut window, from, Vec2::new(30.0, 0.0));
    let session = &mut window.state_mut().as_mut().unwrap().session;
    let written = session
        .document
        .text()
        .replace("[[object]]", "[[object]]\nname = \"before\"\nvalue = [[0, 0], [255, 1]]\n\n[[object]]");
    session.document.replace("change by another program", written);
    window.event(button(from, false));
    finish(&mut window);
    let scene = viewer(&window).session.document.scene().unwrap();
    assert!(scene.objects[0].strokes.is_none() && scene.objects[1].strokes.as_ref().unwrap().len() > 1);
}

/// With flat voxels: a plane of index space turns to the view, and a side of a box of index space follows its handle.
#[test]
fn cuts_of_index_space_follow_the_view_and_their_handles() {
    let plane = "[[clip]]\nspace = \"index\"\nnormal = [0.123456789, 0, 1]\npoint = [11.5, 11.5, 90]\n";
    let clips = format!("{plane}\n[[clip]]\nspace = \"index\"\nbox = [[2, 21], [2, 21], [2, 21]]\n");
    let Some(mut window) = open(&format!("{}\n{clips}", flat()), "Cuts") else { return };
    // A plane outside the volume stays there, and a normal is flipped with all its digits.
    window.run_steps(5);
    assert!(text(&window).ends_with(&clips));
    window.get_by_label("Flip").click();
    settle(&mut window);
    assert!(text(&window).contains("normal = [-0.123456789, 0, -1]"), "{}", text(&window));
    window.get_by_label("Across the view").click();
    settle(&mut window);
    let session = &viewer(&window).session;
    let (scene, data, pose) =
        (session.scene.clone().unwrap(), session.data().cloned().unwrap(), session.pose().unwrap());
    let plane = ClipPlane::in_index(DVec3::ZERO, scene.clips[0].normal.unwrap(), data.volume.grid());
    assert!((plane.normal + pose.view.forward).length() < 2e-6, "{}", plane.normal);
    // The box's side in z is moved by 4 voxels, 8 units of the world.
    let before = scene.clips[1].extent.unwrap();
    let middle = DVec3::splat(11.5);
    let ends = [21.0, 17.0].map(|z| data.volume.grid().to_world(DVec3::new(middle.x, middle.y, z)));
    assert_eq!(ends[0] - ends[1], DVec3::new(0.0, 0.0, 8.0));
    let by = place(&window, ends[1]) - place(&window, ends[0]);
    let handle = window.get_by_label("Clip box 1, z to").rect().center();
    drag(&mut window, PointerButton::Primary, handle, handle + by, Modifiers::NONE);
    settle(&mut window);
    let after = viewer(&window).session.scene.clone().unwrap().clips[1].extent.unwrap();
    assert!((after[2][1] - 17.0).abs() < 0.1 && after[..2] == before[..2] && after[2][0] == 2.0, "{after:?}");
}
