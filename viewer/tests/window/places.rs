//! Places in the volume: the probe under the pointer, the cross-hair of picture and slices, the focus of halos.

use super::{SCENE, Window, click, command, middle, press, settle, text, viewer, wait_for, window};
use drypoint::job::Job;
use drypoint::picking::pick_pixel;
use drypoint::scene::glam::DVec3;
use drypoint_viewer::app::Backend;
use drypoint_viewer::document::Document;
use drypoint_viewer::probe::PixelReport;
use eframe::egui::{Color32, Event, Key, Modifiers, MouseWheelUnit, Pos2, Rect, Vec2};
use egui_kittest::kittest::Queryable;
use serde_json::Value;

/// The answer about the pixel under the pointer, with derivatives.
fn report(window: &Window) -> Option<PixelReport> {
    let session = &viewer(window).session;
    let report = session.probed.clone().filter(|report| report.serial == session.serial())?;
    let is_whole = report.place.as_ref().unwrap().as_ref().is_some_and(|place| place.derivatives.is_some());
    is_whole.then_some(report)
}

/// The numbers at a pixel are those that `drypoint pick` and `drypoint probe` print, also after the camera has turned.
#[test]
fn the_probe_tells_the_commands_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let [scene, volume, names] = ["ring.toml", "ring.nrrd", "names.csv"].map(|name| folder.path().join(name));
    let [scene, volume, names] = [&scene, &volume, &names].map(|path| path.to_str().unwrap());
    command(&["phantom", "torus", "--size", "24", "-o", volume]);
    std::fs::write(names, (0..256).map(|id| format!("{id},part {id}\n")).collect::<String>()).unwrap();
    let source = format!("file = \"{volume}\"\nlabels = \"{volume}\"\nlabel_names = \"{names}\"");
    let source = SCENE.replace("phantom = { name = \"torus\", size = 24 }", &source);
    let Some(mut window) = window(&format!("{source}[sampling]\ngradient = \"sobel\"\n"), Backend::Reference) else {
        return;
    };
    let at = middle(&window) + Vec2::new(-60.0, 40.0);
    window.hover_at(at);
    for turn in [false, true] {
        if turn {
            press(&mut window, Key::ArrowLeft, Modifiers::NONE);
            settle(&mut window);
        }
        let found = wait_for(&mut window, "no report", report);
        let place = found.place.unwrap().unwrap();
        let derivatives = place.derivatives.unwrap();
        std::fs::write(scene, text(&window)).unwrap();
        let pixel = found.pixel.map(|n| n.to_string()).join(",");
        let picked: Value = serde_json::from_str(&command(&["pick", scene, "--pixel", &pixel, "--json"])).unwrap();
        let picked = &picked[0];
        let vector = |value: &Value| DVec3::from_array(std::array::from_fn(|axis| value[axis].as_f64().unwrap()));
        let index = place.picked.index.to_array().map(|x| format!("{x:?}")).join(",");
        let probed = command(&["probe", volume, "--space", "index", "--at", &index, "--gradient", "sobel"]);
        let probed: Value = serde_json::from_str(&probed).unwrap();
        let numbers = [
            (place.picked.value, picked["value"].as_f64()),
            (place.picked.depth, picked["depth"].as_f64()),
            (place.picked.world.distance(vector(&picked["world"])), Some(0.0)),
            (derivatives.magnitude, Some(vector(&probed[0]["gradient"]).length())),
            (derivatives.k1, probed[0]["k1"].as_f64()),
            (derivatives.k2, probed[0]["k2"].as_f64()),
        ];
        for (i, (own, expected)) in numbers.into_iter().enumerate() {
            let expected = expected.unwrap();
            assert!((own - expected).abs() <= 1e-12 * (1.0 + expected.abs()), "{i}: {own} {expected}");
        }
        assert!(derivatives.magnitude > 1.0 && derivatives.k1 > 0.0, "{derivatives:?}");
        assert_eq!(place.picked.label.map(u64::from), picked["label"].as_u64());
        assert_eq!(place.label_name.as_deref(), picked["label_name"].as_str());
        window.run_steps(2);
        let label = format!("{}, part {}", place.picked.label.unwrap(), place.picked.label.unwrap());
        for shown in ["place", "|grad f|", "κ1", "κ2", &label] {
            assert!(window.query_by_label(shown).is_some(), "{shown}");
        }
    }
    // While the pointer moves nothing is shown.
    window.hover_at(at + Vec2::new(5.0, 0.0));
    window.run_steps(2);
    assert!(window.query_by_label("κ1").is_none());
}

/// The middle of a pixel of a slice.
fn pixel_of(rect: Rect, [x, y]: [usize; 2]) -> Pos2 {
    rect.min + Vec2::new(x as f32 + 0.5, y as f32 + 0.5) * rect.size() / 24.0
}

/// A click in the picture moves the cross-hair to the place that the command picks, a click in a slice to the voxel under
/// it, and the wheel to the next slice.
#[test]
fn picture_and_slices_share_the_cross_hair() {
    let Some(mut window) = window(SCENE, Backend::Reference) else { return };
    let at = middle(&window) + Vec2::new(-60.0, 40.0);
    click(&mut window, at);
    let cross = wait_for(&mut window, "no place", |window| viewer(window).session.cross);
    let job = Job::load(Document::untitled(SCENE.into(), "ring.toml".into()).scene().unwrap()).unwrap();
    let pixel = viewer(&window).session.probed.as_ref().unwrap().pixel;
    assert_eq!(cross, pick_pixel(&job.renderer().unwrap(), pixel).unwrap().world);
    assert_eq!(text(&window), SCENE);

    window.get_by_label("Slices").click();
    window.run_steps(3);
    let data = viewer(&window).session.data().cloned().unwrap();
    // From below x falls to the right, and y falls down.
    let axial = window.get_by_label("Axial slice").rect();
    let (pixel, k) = ([15, 6], cross.z.round() as usize);
    click(&mut window, pixel_of(axial, pixel));
    assert_eq!(viewer(&window).session.cross, Some(DVec3::new(8.0, 17.0, k as f64)));
    let voxel = [8, 17, k].map(|n| n.to_string()).join(", ");
    assert!(window.query_by_label_contains(&format!("Voxel {voxel}: ")).is_some(), "{voxel}");
    let image = window.render().unwrap();
    let [lo, hi] = data.volume.range();
    let mut codes = std::collections::BTreeSet::new();
    for [x, y] in [[3, 3], [11, 12], [19, 8], [4, 12], [12, 20], [20, 20]] {
        let value = data.volume.value([23 - x, 23 - y, k]);
        let at = pixel_of(axial, [x, y]);
        let shown = image.get_pixel(at.x as u32, at.y as u32);
        let grey = Color32::from_gray(((value - lo) / (hi - lo) * 255.0).round() as u8);
        assert_eq!(shown.0, grey.to_array(), "{x} {y}: {value}");
        codes.insert(grey.r());
    }
    assert!(codes.len() >= 3, "{codes:?}");
    // The function shows values above 120, from 150 on in the second node's colour.
    let k = 12;
    window.state_mut().as_mut().unwrap().session.cross = Some(DVec3::new(8.0, 17.0, 12.0));
    window.get_by_label("In the function's colours").click();
    window.run_steps(3);
    let image = window.render().unwrap();
    let mut kinds = std::collections::BTreeSet::new();
    let all = (0..24).flat_map(|y| (0..24).map(move |x| [x, y])).filter(|[x, y]| *x != 15 && *y != 6);
    // The name lies over the first voxels.
    for [x, y] in all.filter(|[_, y]| *y > 1) {
        let value = data.volume.value([23 - x, 23 - y, k]);
        let at = pixel_of(axial, [x, y]);
        let [r, g, b, _] = image.get_pixel(at.x as u32, at.y as u32).0;
        let kind = if value <= 120.0 { 0 } else { 1 + usize::from(value >= 150.0) };
        let grey = ((value - lo) / (hi - lo) * 255.0).round() as u8;
        match kind {
            0 => assert_eq!([r, g, b], [grey; 3], "{value}"),
            1 => assert!(r > g && g > b, "{value}: {r} {g} {b}"),
            _ => assert_eq!([r, g, b], [0xff, 0xcc, 0x88], "{value}"),
        }
        kinds.insert(kind);
    }
    assert_eq!(kinds.len(), 3, "{kinds:?}");

    let wheel = |notches: f32| Event::MouseWheel {
        unit: MouseWheelUnit::Line,
        delta: Vec2::new(0.0, notches),
        phase: eframe::egui::TouchPhase::Move,
        source: eframe::egui::MouseWheelSource::Unknown,
        modifiers: Modifiers::NONE,
    };
    for (slice, axis, by) in [("Axial slice", 2, 1.0), ("Coronal slice", 1, -2.0), ("Sagittal slice", 0, 3.0)] {
        let mut expected = viewer(&window).session.cross.unwrap();
        expected[axis] += f64::from(by);
        let middle = window.get_by_label(slice).rect().center();
        window.hover_at(middle);
        window.run_steps(2);
        window.event(wheel(by));
        window.run_steps(60);
        assert_eq!(viewer(&window).session.cross, Some(expected), "{slice}");
    }
    // A click beside the ring says so, and the cross-hair stays.
    let before = viewer(&window).session.cross;
    let picture = window.get_by_label("Picture").rect();
    click(&mut window, picture.center() + Vec2::new(0.0, -0.35 * picture.width()));
    wait_for(&mut window, "no answer", |window| {
        (viewer(window).session.notice == "Nothing is seen there").then_some(())
    });
    assert_eq!(viewer(&window).session.cross, before);
    press(&mut window, Key::Delete, Modifiers::NONE);
    assert_eq!(viewer(&window).session.cross, None);
}

/// The focus of a halo is the place that was clicked.
#[test]
fn halos_are_focused_by_a_click() {
    let halo = format!("{SCENE}\n[[halo]]   # a rim\nfloor = 0.1\n");
    let Some(mut window) = window(&halo, Backend::Reference) else { return };
    press(&mut window, Key::H, Modifiers::COMMAND);
    assert!(text(&window) == halo && viewer(&window).session.notice.starts_with("A click"));
    let at = middle(&window) + Vec2::new(-60.0, 40.0);
    click(&mut window, at);
    let cross = wait_for(&mut window, "no place", |window| viewer(window).session.cross);
    press(&mut window, Key::H, Modifiers::COMMAND);
    settle(&mut window);
    let scene = viewer(&window).session.scene.clone().unwrap();
    let seed = &scene.halos[0].seed;
    let drypoint::scene::tables::FocusPoints::World(points) = &seed.focus.as_ref().unwrap().points else {
        panic!("{}", text(&window))
    };
    // To a thousandth of a voxel.
    assert!(points.len() == 1 && points[0].distance(cross) < 1e-3 && seed.is_by_opacity(), "{}", text(&window));
    assert!(text(&window).contains("# a rim\nfloor = 0.1\n") && viewer(&window).session.failures.is_none());
    press(&mut window, Key::Z, Modifiers::COMMAND);
    assert_eq!(text(&window), halo);
}
