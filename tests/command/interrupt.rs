//! Ctrl-C.

#![cfg(unix)]

use crate::folder::Folder;
use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};

#[test]
fn an_interrupt_leaves_no_file_and_exits_with_130() {
    let folder = Folder::new();
    folder.torus();
    let before = folder.listing();
    // Minutes of work, if nobody stopped it.
    let line = ["-v", "render", "torus.nrrd", "--size", "2000x2000", "--set", "sampling.step=0.001"];
    let mut child = folder.command(line).stderr(Stdio::piped()).spawn().unwrap();
    // Once it says what it has loaded it listens for signals and is about to render.
    let mut said = String::new();
    BufReader::new(child.stderr.take().unwrap()).read_line(&mut said).unwrap();
    assert!(said.contains("torus.nrrd: 24 × 24 × 24"), "{said}");
    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(sent.success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert_eq!(folder.listing(), before);
}
