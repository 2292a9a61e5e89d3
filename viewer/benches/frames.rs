//! Times from a change of a scene to the first frame that shows it, and to the exact frame, by the thread that draws for the
//! window: on the CPU, and on a card if there is one. As in the window, software is no card. The engine at 800×600 pixels.
//!
//! `cargo bench -p drypoint-viewer --bench frames`, with the scans in `DRYPOINT_DATA` or `../shared/data`

use drypoint::cost::median;
use drypoint::gpu::Gpu;
use drypoint::scene::file::{Overrides, load_text};
use drypoint_viewer::frames::{Answer, Request, Worker};
use std::time::{Duration, Instant};

const SCENE: &str = r##"
drypoint = 1
[volume]
file = "engine.nhdr"
[picture]
size = [800, 600]
[camera]
direction = [1, 2, -1]
[transfer]
nodes = [{ at = 60, style = "cartoon-2", opacity = 0 }, { at = 90, style = "cartoon-2", opacity = 0.3 }]
[styles]
theme = "studio"
[contours]
[[clip]]
normal = [1, 0, 0]
point = [200, 0, 0]
[combine]
fuzzy = "product"
[[object]]
name = "painted"
transfer = { nodes = [{ at = 60, style = "vein", opacity = 0 }, { at = 90, style = "vein", opacity = 0.9 }] }
strokes = [{ at = [128, 60, 60], radius = "20 voxels" }]
"##;

/// Changes: a name, and texts before and after it.
const CHANGES: [(&str, &str, &str); 5] = [
    ("a turn", "[1, 2, -1]", "[1.1, 2, -1]"),
    ("an opacity", "opacity = 0.3", "opacity = 0.4"),
    ("the thickness of contours", "[contours]", "[contours]\nthickness = \"3 voxels\""),
    ("a clip plane", "point = [200, 0, 0]", "point = [190, 0, 0]"),
    ("a dab", "\"20 voxels\" }", "\"20 voxels\" }, { at = [140, 60, 60], radius = \"20 voxels\" }"),
];

/// Time after which a frame is given up.
const LONGEST: Duration = Duration::from_secs(120);

/// Rounds in which every change is made and taken back.
const ROUNDS: usize = 3;

/// Milliseconds from the request of a scene to its first frame, and to the exact one.
fn times(worker: &Worker, revision: u64, text: &str) -> Result<[f64; 2], String> {
    let scene = load_text(text, "engine.toml".as_ref(), &Overrides::default()).map_err(|faults| faults.to_string())?;
    let (start, mut first) = (Instant::now(), None);
    worker.ask(Request { revision, scene, longest: 800 });
    while start.elapsed() < LONGEST {
        for answer in worker.answers() {
            match answer {
                Answer::Drawn(frame) if frame.revision == revision => {
                    let now = 1e3 * start.elapsed().as_secs_f64();
                    let first = *first.get_or_insert(now);
                    if !frame.is_coarse {
                        return Ok([first, now]);
                    }
                }
                Answer::Failed(_, failures) => return Err(failures.to_string()),
                _ => {}
            }
        }
        std::thread::sleep(Duration::from_micros(200));
    }
    Err("no exact frame has come".into())
}

fn main() -> Result<(), String> {
    let card = Gpu::new().ok().filter(|gpu| !gpu.is_software());
    println!("| drawn by | change | first frame, ms | exact frame, ms |\n|---|---|--:|--:|");
    for gpu in card.map(Some).into_iter().chain([None]) {
        let name = gpu.as_ref().map_or_else(|| "the CPU".to_owned(), Gpu::describe);
        let worker = Worker::new(gpu, || ());
        let mut revision = 0;
        let mut ask = |text: &str| {
            revision += 1;
            times(&worker, revision, text)
        };
        // The volume is read, and what a card needs is compiled.
        ask(SCENE)?;
        let mut all = vec![[Vec::new(), Vec::new()]; CHANGES.len()];
        for _ in 0..ROUNDS {
            for ((_, from, to), taken) in CHANGES.iter().zip(&mut all) {
                let changed = ask(&SCENE.replace(from, to))?;
                taken.iter_mut().zip(changed).for_each(|(times, time)| times.push(time));
                ask(SCENE)?;
            }
        }
        for ((change, ..), [first, exact]) in CHANGES.iter().zip(&all) {
            println!("| {name} | {change} | {:.0} | {:.0} |", median(first), median(exact));
        }
    }
    Ok(())
}
