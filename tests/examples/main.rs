//! The programs of `examples/`, run.

// `main` and the words on it are for people.
#![allow(dead_code)]

#[path = "../../examples/compare_two_pictures.rs"]
mod compare_two_pictures;
#[path = "../../examples/own_phantom.rs"]
mod own_phantom;
#[path = "../../examples/picture_to_stdout.rs"]
mod picture_to_stdout;
#[path = "../../examples/render_to_buffer.rs"]
mod render_to_buffer;
#[path = "../../examples/stipple_to_svg.rs"]
mod stipple_to_svg;

use drypoint::output::read::read_image;
use std::process::Command;

/// Runs the WebAssembly of the first argument.
const RUN_WASM: &str = r#"
const { WASI } = require("node:wasi");
const wasi = new WASI({ version: "preview1" });
const module = new WebAssembly.Module(require("node:fs").readFileSync(process.argv[1]));
wasi.start(new WebAssembly.Instance(module, { wasi_snapshot_preview1: wasi.wasiImport }));
"#;

#[test]
fn a_buffer_has_four_bytes_a_pixel() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("torus.png");
    let bytes = render_to_buffer::run(&file).unwrap();
    assert_eq!(bytes.len(), 160 * 120 * 4);
    // Transparent in the corner, opaque on the torus; the file has the same pixels.
    assert!(bytes[3] == 0 && bytes.chunks(4).any(|pixel| pixel[3] == 255));
    let image = read_image(&file).unwrap();
    let alpha: Vec<u8> = image.channel("A").unwrap().iter().map(|a| (a * 255.0).round() as u8).collect();
    assert_eq!(alpha, bytes.chunks(4).map(|pixel| pixel[3]).collect::<Vec<_>>());
}

/// `DRYPOINT_WASM` names the program as built for wasm32-wasip1; `.ci/targets` builds it.
#[test]
fn web_assembly_draws_the_same_bytes() {
    let Some(program) = std::env::var_os("DRYPOINT_WASM") else {
        println!("skipped: DRYPOINT_WASM names no WebAssembly of examples/picture_to_stdout.rs");
        return;
    };
    let said = Command::new("node").args(["-e", RUN_WASM]).arg(program).output().unwrap();
    assert!(said.status.success(), "{}", String::from_utf8_lossy(&said.stderr));
    assert!(said.stdout == picture_to_stdout::run().unwrap(), "WebAssembly draws other bytes");
}

#[test]
fn a_page_has_its_dots() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("part.svg");
    let dots = stipple_to_svg::run(&file).unwrap();
    // A plotter's dots are elements of their own.
    let svg = std::fs::read_to_string(file).unwrap();
    assert_eq!(svg.matches("<polyline").count(), dots);
    assert!(dots > 1000, "{dots}");
}

/// The largest value is where each of x², y², z² is 5/2: 3·25/4 − 11.8 = 6.95; voxels come near it.
#[test]
fn a_formula_becomes_a_picture() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("tanglecube.png");
    let [lo, hi] = own_phantom::run(&file).unwrap();
    assert!(lo == -20.0 && hi <= 6.95 && hi > 6.9, "{lo} {hi}");
    let image = read_image(&file).unwrap();
    let red = image.channel("R").unwrap();
    assert_eq!((image.width, image.height), (240, 240));
    assert!(red.iter().filter(|&&r| r < 0.9).count() > 240 * 240 / 10, "something is drawn");
}

#[test]
fn kernels_differ() {
    let folder = tempfile::tempdir().unwrap();
    let found = compare_two_pictures::run(&folder.path().join("smooth.png")).unwrap();
    assert!(found.max > 0.1 && found.flip.unwrap() > 0.01, "{found}");
}
