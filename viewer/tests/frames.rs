//! The thread that draws: what is prepared anew, and that each frame is that of a fresh thread.

use drypoint::gpu::Gpu;
use drypoint::job::read_volume;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::source::Disk;
use drypoint::scene::tables::Scene;
use drypoint_viewer::canvas::Pixels;
use drypoint_viewer::frames::{Answer, Request, Worker};
use drypoint_viewer::probe::{PixelQuery, Prober};
use std::sync::Arc;
use std::time::{Duration, Instant};

const SCENE: &str = r##"
drypoint = 1
[volume]
phantom = { name = "torus", size = 24 }
[picture]
size = [60, 45]
samples = 1
[camera]
direction = [1, 2, -3]
[transfer]
kind = "regular"
nodes = [{ at = 120, color = "#804020", opacity = 0 }, { at = 150, color = "#ffcc88", opacity = 0.9 }]
[shading]
"##;

fn scene(text: &str) -> Scene {
    parse(text, "ring.toml".as_ref(), &Overrides::default()).unwrap_or_else(|faults| panic!("{faults}"))
}

/// Answers of a thread until the exact frame of a request.
#[derive(Default)]
struct Answers {
    loaded: usize,
    prepared: usize,
    coarse: usize,
    failed: Option<String>,
    size: [usize; 2],
    bytes: Vec<u8>,
}

fn ask(worker: &Worker, revision: u64, text: &str, longest: usize) -> Answers {
    worker.ask(Request { revision, scene: scene(text), longest });
    let (start, mut all) = (Instant::now(), Answers::default());
    loop {
        assert!(start.elapsed() < Duration::from_secs(60), "no answer");
        std::thread::sleep(Duration::from_millis(2));
        for answer in worker.answers() {
            match answer {
                Answer::Loaded(_) => all.loaded += 1,
                Answer::Prepared(..) => all.prepared += 1,
                Answer::Failed(of, failures) => {
                    assert_eq!(of, revision);
                    all.failed = Some(failures.to_string());
                    return all;
                }
                Answer::Drawn(frame) if frame.is_coarse => all.coarse += 1,
                Answer::Drawn(frame) => {
                    assert_eq!(frame.revision, revision);
                    all.size = frame.size;
                    if let Pixels::Bytes(bytes) = frame.pixels {
                        all.bytes = bytes;
                    }
                    return all;
                }
            }
        }
    }
}

/// A scene without the volume's own colours.
fn drawn_alone(text: &str) -> String {
    text.split("[transfer]").next().unwrap_or_default().to_owned()
}

/// Changes of the camera prepare nothing, changes of other keys keep the volume, and every frame is that of a fresh thread.
#[test]
fn what_is_drawn_depends_on_the_last_request_alone() {
    let turned = SCENE.replace("[1, 2, -3]", "[-3, 1, 1]");
    let clipped = format!("{turned}[[clip]]\nnormal = [1, 0, 0]\npoint = [12, 0, 0]\n");
    let labelled = format!("{SCENE}[scale_bar]\n");
    let turned_labelled = format!("{turned}[scale_bar]\n");
    let [dots, turned_dots] = [SCENE, &turned].map(|text| format!("{}[stipples]\n", drawn_alone(text)));
    let other = SCENE.replace("size = 24", "size = 20");
    let lens = SCENE.replace("direction", "fov = 20\ndirection");
    let worker = Worker::new(None, || ());
    for (i, (text, loaded, prepared)) in [
        (&SCENE.to_owned(), 1, 1),
        (&turned, 0, 0),
        (&SCENE.to_owned(), 0, 0),
        (&lens, 0, 1),
        (&clipped, 0, 1),
        (&labelled, 0, 1),
        (&turned_labelled, 0, 0),
        (&dots, 0, 1),
        (&turned_dots, 0, 0),
        (&dots, 0, 0),
        (&other, 1, 1),
    ]
    .into_iter()
    .enumerate()
    {
        let drawn = ask(&worker, i as u64, text, 1000);
        assert_eq!([drawn.loaded, drawn.prepared], [loaded, prepared], "{text}");
        let fresh = ask(&Worker::new(None, || ()), 0, text, 1000);
        assert!(drawn.bytes == fresh.bytes && !drawn.bytes.is_empty() && drawn.failed.is_none(), "{text}");
        assert_eq!(drawn.size, [60, 45]);
        // Dots turn at once, and get their exact number then.
        assert!(drawn.coarse > 0 || !text.contains("[stipples]") || prepared > 0, "{text}");
    }
    // A window with fewer pixels gets a smaller picture of the same shape.
    assert_eq!(ask(&worker, 9, SCENE, 20).size, [20, 15]);
}

/// On a card neither a turn nor a change of numbers compiles a pipeline.
#[test]
fn a_card_compiles_nothing_for_a_turn() {
    let Ok(gpu) = Gpu::new() else {
        assert!(std::env::var_os("DRYPOINT_REQUIRE_GPU").is_none(), "no adapter");
        return println!("skipped: no adapter");
    };
    let worker = Worker::new(Some(gpu.clone()), || ());
    ask(&worker, 0, SCENE, 1000);
    let compiled = gpu.pipelines();
    for (i, text) in [SCENE.replace("[1, 2, -3]", "[-3, 1, 1]"), SCENE.replace("150", "160")].iter().enumerate() {
        let drawn = ask(&worker, i as u64 + 1, text, 1000);
        assert_eq!([drawn.loaded, drawn.prepared], [0, i], "{text}");
        assert_eq!(gpu.pipelines(), compiled, "{text}");
    }
}

/// After a scene that cannot be drawn the next one is drawn.
#[test]
fn a_failure_ends_with_the_next_request() {
    let worker = Worker::new(None, || ());
    let missing = SCENE.replace("phantom = { name = \"torus\", size = 24 }", "file = \"none.nrrd\"");
    let failed = ask(&worker, 1, &missing, 1000).failed.unwrap();
    assert!(failed.contains("none.nrrd"), "{failed}");
    assert!(ask(&worker, 2, SCENE, 1000).failed.is_none());
    let background = SCENE.replace("samples = 1", "samples = 1\nbackground = \"none.png\"");
    assert!(ask(&worker, 3, &background, 1000).failed.unwrap().contains("none.png"));
    assert!(ask(&worker, 4, SCENE, 1000).failed.is_none());
}

/// A camera in its own target cannot look anywhere, and only a job tells that the target is the volume's middle.
fn blind() -> String {
    SCENE.replace("direction = [1, 2, -3]", "eye = [11.5, 11.5, 11.5]")
}

/// A failure after a turn is that of the turned scene: `ask` compares the revisions.
#[test]
fn a_turn_that_fails_is_told_by_its_own_revision() {
    let worker = Worker::new(None, || ());
    assert!(ask(&worker, 1, SCENE, 1000).failed.is_none());
    let failed = ask(&worker, 2, &blind(), 1000).failed.unwrap();
    assert!(failed.contains("direction"), "{failed}");
    assert!(ask(&worker, 3, SCENE, 1000).failed.is_none());

    let volume = Arc::new(read_volume(&scene(SCENE), &Disk).unwrap());
    let prober = Prober::new(Box::new(|| ()));
    for (serial, text) in [(1, SCENE), (2, &blind())] {
        let (scene, volume) = (Arc::new(scene(text)), Arc::clone(&volume));
        prober.ask(PixelQuery { serial, scene, volume, pixel: [30, 20 + serial as usize], is_click: serial == 2 });
        let start = Instant::now();
        let report = loop {
            assert!(start.elapsed() < Duration::from_secs(60), "no report");
            if let Some(report) = prober.answers().find(|report| report.serial == serial) {
                break report;
            }
            std::thread::sleep(Duration::from_millis(2));
        };
        assert_eq!((report.place.is_err(), report.is_click), (serial == 2, serial == 2));
        assert_eq!(report.pixel, [30, 20 + serial as usize]);
    }
}

/// A brush at a pixel of the picture paints the same voxels on a screen of any size, so the picture keeps its own.
#[test]
fn a_picture_with_places_at_pixels_keeps_its_size() {
    let object = "[[object]]\nname = \"spot\"\ntransfer = { kind = \"regular\", nodes = [{ at = 120, color = \"#0000ff\", \
        opacity = 0.9 }] }\n";
    let worker = Worker::new(None, || ());
    for (target, size) in [("pixel = [30, 30]", [60, 45]), ("at = [11.5, 5, 11.5]", [20, 15])] {
        let text = format!("{SCENE}{object}strokes = [{{ {target}, radius = \"4 voxels\", brush = \"ball\" }}]\n");
        let [whole, reduced] = [1000, 20].map(|longest| ask(&worker, 1, &text, longest));
        assert!(whole.failed.is_none() && reduced.failed.is_none(), "{:?}", whole.failed);
        assert_eq!([whole.size, reduced.size], [[60, 45], size], "{target}");
        assert_eq!(whole.bytes == reduced.bytes, size == [60, 45], "{target}");
        assert!(whole.bytes != ask(&worker, 2, SCENE, 1000).bytes, "nothing is painted: {target}");
    }
}
