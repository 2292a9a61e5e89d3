//! Ctrl-C.

#![cfg(unix)]

use crate::folder::Folder;
use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

fn interrupt(child: &Child) {
    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(sent.success());
}

#[test]
fn while_it_renders_it_leaves_no_file_and_exits_with_130() {
    let folder = Folder::new();
    folder.torus();
    let before = folder.listing();
    // Minutes of work, if nobody stopped it.
    let line = ["-v", "render", "torus.nrrd", "--size", "2000x2000", "--set", "sampling.step=0.001"];
    let mut child = folder.command(line).stderr(Stdio::piped()).spawn().unwrap();
    // Once it says what it has loaded it listens for signals and is about to render.
    let mut said = String::new();
    let mut stderr = BufReader::new(child.stderr.take().unwrap());
    stderr.read_line(&mut said).unwrap();
    assert!(said.contains("torus.nrrd: 24 × 24 × 24"), "{said}");
    interrupt(&child);
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert_eq!(folder.listing(), before);
}

#[test]
fn while_it_writes_it_leaves_no_half_file_and_the_old_one_as_it_was() {
    let folder = Folder::new();
    folder.write("noise.nrrd", "the old one");
    // Noise does not compress: writing takes far longer than making it.
    let line = ["phantom", "white-noise", "--size", "160", "--type", "f64", "-o", "noise.nrrd"];
    let mut child = folder.command(line).stderr(Stdio::null()).spawn().unwrap();
    let writes =
        || folder.listing().iter().any(|(path, length)| path.to_string_lossy().ends_with(".part") && *length > 0);
    while !writes() {
        assert!(child.try_wait().unwrap().is_none(), "it was done before it was seen to write");
        std::thread::sleep(Duration::from_millis(2));
    }
    interrupt(&child);
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert_eq!(folder.listing().len(), 1);
    assert_eq!(folder.read("noise.nrrd"), b"the old one");
}
