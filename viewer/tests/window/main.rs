//! The window on software Vulkan: what a user does, and what the document and the picture are afterwards.

mod compare;
mod functions;
mod late;
mod objects;
mod places;

use drypoint::gpu::{Gpu, wgpu};
use drypoint::output::read::read_image;
use drypoint::scene::color::linear_to_srgb;
use drypoint::scene::glam::DVec3;
use drypoint_viewer::app::{Backend, Viewer};
use drypoint_viewer::commands::Action;
use drypoint_viewer::document::Document;
use drypoint_viewer::export::{Outcome, export};
use drypoint_viewer::state::State;
use eframe::egui::{Color32, ColorImage, Event, Key, Modifiers, MouseWheelUnit, PointerButton, Pos2, Vec2};
use eframe::egui_wgpu::{RenderState, RendererOptions, WgpuSetup, WgpuSetupCreateNew};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use egui_kittest::wgpu::{WgpuTestRenderer, create_render_state};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

const SCENE: &str = r##"# A ring.
drypoint = 1

[volume]
phantom = { name = "torus", size = 24 }

[picture]
size = [96, 72]
samples = 1

[camera]
eye = [50, -20, 40]   # from above
target = [12, 12, 12]

[transfer]
kind = "regular"
nodes = [
  { at = 120, color = "#804020", opacity = 0 },
  { at = 150, color = "#ffcc88", opacity = 0.9 },   # the surface
]

[shading]
"##;

/// Returns a device as the window opens it, if there is an adapter.
fn device() -> Option<RenderState> {
    let instance = wgpu::Instance::default();
    let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()));
    if adapter.is_err() && std::env::var_os("DRYPOINT_REQUIRE_GPU").is_none() {
        println!("skipped: no adapter");
        return None;
    }
    let setup = WgpuSetupCreateNew {
        device_descriptor: Arc::new(Gpu::descriptor),
        ..WgpuSetupCreateNew::without_display_handle()
    };
    Some(create_render_state(WgpuSetup::CreateNew(setup), RendererOptions::PREDICTABLE))
}

type Window = Harness<'static, Option<Viewer>>;

/// Opens a window over a text, and waits for its exact frame.
fn window(text: &str, backend: Backend) -> Option<Window> {
    window_in(text, backend, None)
}

/// Opens a window that keeps its state in a folder.
fn window_in(text: &str, backend: Backend, folder: Option<&Path>) -> Option<Window> {
    let folder = folder.map(Path::to_owned);
    let render = device()?;
    let document = Document::untitled(text.into(), "ring.toml".into());
    let (mut document, own) = (Some(document), render.clone());
    let show = move |ui: &mut eframe::egui::Ui, viewer: &mut Option<Viewer>| {
        let ctx = ui.ctx().clone();
        let viewer = viewer.get_or_insert_with(|| {
            Viewer::new(&ctx, Some(own.clone()), backend, document.take().unwrap(), State::read(folder.clone()))
        });
        viewer.ui(ui);
    };
    let builder = Harness::builder().with_size(Vec2::new(1200.0, 760.0)).with_step_dt(1.0 / 60.0);
    let mut window = builder.renderer(WgpuTestRenderer::from_render_state(render)).build_ui_state(show, None);
    settle(&mut window);
    Some(window)
}

/// Runs passes until the exact frame of the document is shown.
fn settle(window: &mut Window) {
    let start = Instant::now();
    window.run_steps(2);
    while !viewer(window).session.is_settled() {
        assert!(start.elapsed() < Duration::from_secs(60), "no exact frame");
        std::thread::sleep(Duration::from_millis(5));
        window.step();
    }
    window.run_steps(2);
}

fn viewer(window: &Window) -> &Viewer {
    window.state().as_ref().unwrap()
}

fn text(window: &Window) -> String {
    viewer(window).session.document.text().to_owned()
}

fn press(window: &mut Window, key: Key, modifiers: Modifiers) {
    window.key_press_modifiers(modifiers, key);
    window.run_steps(2);
}

/// Drags with a button, in steps.
fn drag(window: &mut Window, button: PointerButton, from: Pos2, to: Pos2, modifiers: Modifiers) {
    let pressed = |pos, pressed| Event::PointerButton { pos, button, pressed, modifiers };
    window.event_modifiers(Event::PointerMoved(from), modifiers);
    window.run_steps(2);
    window.event_modifiers(pressed(from, true), modifiers);
    window.step();
    for i in 1..=4 {
        window.event_modifiers(Event::PointerMoved(from + (to - from) * (i as f32 / 4.0)), modifiers);
        window.step();
    }
    window.event_modifiers(pressed(to, false), modifiers);
    window.run_steps(2);
}

fn middle(window: &Window) -> Pos2 {
    window.get_by_label("Picture").rect().center()
}

/// Pixels of the frame in the window.
fn pixels(window: &Window) -> ColorImage {
    viewer(window).session.image().unwrap()
}

/// Share of pixels that differ by more than a code or two of rounding.
fn difference(a: &ColorImage, b: &ColorImage) -> f64 {
    assert_eq!(a.size, b.size);
    let far = |(a, b): (&Color32, &Color32)| a.to_array().into_iter().zip(b.to_array()).any(|(a, b)| a.abs_diff(b) > 3);
    a.pixels.iter().zip(&b.pixels).filter(|&pair| far(pair)).count() as f64 / a.pixels.len() as f64
}

/// The card's frame and the reference's are the PNG of the command, up to the card's rounding.
#[test]
fn both_back_ends_show_the_commands_picture() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("ring.png");
    let scene = Document::untitled(SCENE.into(), "ring.toml".into()).scene().unwrap();
    assert_eq!(export(scene, &file, &|_| (), &AtomicBool::new(false)).unwrap(), Outcome::Written);
    let png = read_image(&file).unwrap();
    let rgb = png.colors().unwrap().rgb;
    let code = |c: usize, i: usize| (linear_to_srgb(rgb[c][i]) * 255.0).round() as u8;
    let pixels_of = (0..png.width * png.height).map(|i| Color32::from_rgb(code(0, i), code(1, i), code(2, i)));
    let command = ColorImage::new([png.width, png.height], pixels_of.collect());
    assert!(command.pixels.iter().any(|pixel| *pixel != command.pixels[0]));
    for (backend, share) in [(Backend::Reference, 0.0), (Backend::Card, 0.002)] {
        let Some(window) = window(SCENE, backend) else { return };
        let differing = difference(&pixels(&window), &command);
        assert!(differing <= share, "{backend:?}: {differing}");
    }
}

#[test]
fn drags_change_the_camera_and_undo_restores_the_text() {
    let Some(mut window) = window(SCENE, Backend::Card) else { return };
    let (first, at) = (pixels(&window), middle(&window));
    let turned = at + Vec2::new(60.0, 20.0);
    for (button, modifiers, keeps_target) in [
        (PointerButton::Primary, Modifiers::NONE, true),
        (PointerButton::Primary, Modifiers::SHIFT, false),
        (PointerButton::Middle, Modifiers::NONE, false),
        (PointerButton::Secondary, Modifiers::NONE, true),
    ] {
        drag(&mut window, button, at, turned, modifiers);
        settle(&mut window);
        let changed = text(&window);
        assert!(!changed.contains("eye = [50, -20, 40]") && changed.contains("# from above"), "{button:?}: {changed}");
        assert_eq!(changed.contains("target = [12, 12, 12]\n"), keeps_target, "{button:?}: {changed}");
        assert!(difference(&first, &pixels(&window)) > 0.1, "{button:?}");
        // The drag is one change.
        press(&mut window, Key::Z, Modifiers::COMMAND);
        settle(&mut window);
        assert_eq!(text(&window), SCENE);
        assert_eq!(pixels(&window), first);
    }
    press(&mut window, Key::Z, Modifiers::COMMAND.plus(Modifiers::SHIFT));
    assert_ne!(text(&window), SCENE);
}

/// The point under the pointer stays when the wheel turns, and keys look from the sides.
#[test]
fn wheel_and_keys_move_the_camera() {
    let Some(mut window) = window(SCENE, Backend::Reference) else { return };
    let at = middle(&window) + Vec2::new(40.0, -30.0);
    window.hover_at(at);
    window.run_steps(2);
    let wheel = Event::MouseWheel {
        unit: MouseWheelUnit::Point,
        delta: Vec2::new(0.0, 60.0),
        phase: eframe::egui::TouchPhase::Move,
        source: eframe::egui::MouseWheelSource::Unknown,
        modifiers: Modifiers::NONE,
    };
    let before = viewer(&window).session.pose().unwrap();
    window.event(wheel);
    window.run_steps(30);
    let after = viewer(&window).session.pose().unwrap();
    assert!(after.depth() < 0.95 * before.depth(), "{} {}", after.depth(), before.depth());
    // A turn of the wheel is one change.
    press(&mut window, Key::Z, Modifiers::COMMAND);
    assert_eq!(text(&window), SCENE);
    press(&mut window, Key::Num1, Modifiers::NONE);
    settle(&mut window);
    assert!((viewer(&window).session.pose().unwrap().view.forward.y + 1.0).abs() < 1e-5);
    press(&mut window, Key::Home, Modifiers::NONE);
    settle(&mut window);
    assert!(!text(&window).contains("eye") && text(&window).contains("direction = [0, -1, 0]"), "{}", text(&window));
}

#[test]
fn a_fault_is_shown_with_its_key_and_the_last_picture_stays() {
    let Some(mut window) = window(SCENE, Backend::Reference) else { return };
    let first = pixels(&window);
    let viewer_of = |window: &mut Window, fov: i64| {
        window.state_mut().as_mut().unwrap().session.set(&"camera.fov".into(), fov);
    };
    viewer_of(&mut window, 200);
    settle(&mut window);
    assert_eq!(window.query_all_by_label_contains("camera.fov").count(), 2);
    assert_eq!(pixels(&window), first);
    window.get_by_label("Undo the last change").click();
    settle(&mut window);
    assert!(text(&window) == SCENE && window.query_by_label_contains("camera.fov").is_none());
}

#[test]
fn the_palette_runs_commands_by_their_words() {
    let Some(mut window) = window(SCENE, Backend::Reference) else { return };
    press(&mut window, Key::P, Modifiers::COMMAND);
    window.event(Event::Text("from above".into()));
    window.run_steps(2);
    press(&mut window, Key::Enter, Modifiers::NONE);
    settle(&mut window);
    assert!((viewer(&window).session.pose().unwrap().view.forward.z + 1.0).abs() < 1e-5);
    for label in ["Function", "Cuts", "All keys", "File", "Edit", "View"] {
        assert!(window.query_by_label(label).is_some(), "{label}");
    }
}

#[test]
fn every_key_can_be_found_and_edited() {
    let Some(mut window) = window(SCENE, Backend::Reference) else { return };
    window.get_by_label("All keys").click();
    window.run_steps(2);
    window.get_by_label("Search").focus();
    window.step();
    window.event(Event::Text("stop_below".into()));
    window.run_steps(10);
    assert!(window.query_by_label("sampling").is_some() && window.query_by_label("contours").is_none());
    window.get_by_role_and_label(eframe::egui::Role::SpinButton, "stop_below").focus();
    window.run_steps(2);
    press(&mut window, Key::ArrowUp, Modifiers::NONE);
    settle(&mut window);
    assert!(text(&window).contains("[sampling]\nstop_below = "), "{}", text(&window));
}

/// A clip plane is added through the middle, and its handle moves it along its normal.
#[test]
fn a_clip_plane_is_moved_by_its_handle() {
    let Some(mut window) = window(SCENE, Backend::Card) else { return };
    window.get_by_label("Cuts").click();
    window.run_steps(2);
    window.get_by_label("z").click();
    settle(&mut window);
    let added = text(&window);
    assert!(added.ends_with("[shading]\n\n[[clip]]\nnormal = [0, 0, 1]\npoint = [11.5, 11.5, 11.5]\n"), "{added}");
    let (whole, pose) = (pixels(&window), viewer(&window).session.pose().unwrap());
    // The handle is dragged to where a point of the axis is seen.
    let handle = window.get_by_label("Clip plane 0").rect().center();
    let picture = window.get_by_label("Picture").rect();
    let scale = (picture.width() / 96.0).min(picture.height() / 72.0);
    let to = DVec3::new(11.5, 11.5, 9.5);
    let [from, to] = [DVec3::splat(11.5), to].map(|p| pose.view.point_of(p).unwrap());
    let by = Vec2::new((to[0] - from[0]) as f32, (to[1] - from[1]) as f32) * scale;
    drag(&mut window, PointerButton::Primary, handle, handle + by, Modifiers::NONE);
    settle(&mut window);
    let scene = viewer(&window).session.scene.clone().unwrap();
    let point = scene.clips[0].point.unwrap();
    assert!(point.x == 11.5 && point.y == 11.5 && (point.z - 9.5).abs() < 0.2, "{point}");
    assert!(text(&window).contains("eye = [50, -20, 40]"), "the view turned");
    assert!(difference(&whole, &pixels(&window)) > 0.01);
    press(&mut window, Key::Z, Modifiers::COMMAND);
    assert_eq!(text(&window), added);
}

/// A picture that the window exports is the command's, byte for byte.
#[test]
fn an_export_is_the_commands_picture() {
    let Some(mut window) = window(SCENE, Backend::Card) else { return };
    let folder = tempfile::tempdir().unwrap();
    let [scene, exported, rendered] =
        ["ring.toml", "exported.png", "rendered.png"].map(|name| folder.path().join(name));
    let ctx = window.ctx.clone();
    let own = window.state_mut().as_mut().unwrap();
    own.session.document.save_as(&scene).unwrap();
    own.run(&ctx, Action::Look(drypoint_viewer::camera::Side::Left));
    own.session.document.save().unwrap();
    own.start_export(&ctx, exported.clone());
    let start = Instant::now();
    while !viewer(&window).session.notice.starts_with("Exported") {
        assert!(start.elapsed() < Duration::from_secs(60), "{}", viewer(&window).session.notice);
        std::thread::sleep(Duration::from_millis(5));
        window.step();
    }
    command(&["render", scene.to_str().unwrap(), "-o", rendered.to_str().unwrap()]);
    assert!(std::fs::read(&exported).unwrap() == std::fs::read(&rendered).unwrap());
}

/// Runs passes until something is there.
fn wait_for<T>(window: &mut Window, what: &str, find: impl Fn(&Window) -> Option<T>) -> T {
    let start = Instant::now();
    loop {
        window.step();
        if let Some(found) = find(window) {
            return found;
        }
        assert!(start.elapsed() < Duration::from_secs(120), "{what}: {}", viewer(window).session.notice);
        std::thread::sleep(Duration::from_millis(5));
    }
}

fn click(window: &mut Window, at: Pos2) {
    drag(window, PointerButton::Primary, at, at, Modifiers::NONE);
}

/// Runs the command, which is built beside the tests of the workspace. Returns what it prints.
fn command(arguments: &[&str]) -> String {
    let here = std::env::current_exe().unwrap();
    let name = Path::new("drypoint").with_extension(std::env::consts::EXE_EXTENSION);
    let program = here.ancestors().skip(2).map(|folder| folder.join(&name)).find(|program| program.is_file());
    let program = program.expect("the command is built with cargo build --release");
    let run = std::process::Command::new(program).arg("-q").args(arguments).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    String::from_utf8(run.stdout).unwrap()
}
