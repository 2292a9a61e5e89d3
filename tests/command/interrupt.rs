//! Ctrl-C and the other signals that end a program.

#![cfg(unix)]

use crate::folder::Folder;
use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

fn send(signal: &str, child: &Child) {
    let sent = Command::new("kill").args([&format!("-{signal}"), &child.id().to_string()]).status().unwrap();
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
    send("INT", &child);
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert_eq!(folder.listing(), before);
}

/// Starts a write that takes a second, over a file that is there, and returns while it writes.
fn writing(folder: &Folder, before: &str) -> Child {
    folder.write("noise.nrrd", "the old one");
    // Noise does not compress: writing takes far longer than making it.
    let line = format!("{before} exec \"$0\" phantom white-noise --size 160 --type f64 -o noise.nrrd");
    let mut command = Command::new("sh");
    command.arg("-c").arg(line).arg(env!("CARGO_BIN_EXE_drypoint")).current_dir(folder.path(""));
    let mut child = command.stderr(Stdio::null()).spawn().unwrap();
    let writes =
        || folder.listing().iter().any(|(path, length)| path.to_string_lossy().ends_with(".part") && *length > 0);
    while !writes() {
        assert!(child.try_wait().unwrap().is_none(), "it was done before it was seen to write");
        std::thread::sleep(Duration::from_millis(2));
    }
    child
}

#[test]
fn while_it_writes_it_leaves_no_half_file_and_the_old_one_as_it_was() {
    for (signal, code) in [("INT", 130), ("TERM", 143), ("HUP", 129)] {
        // Where a system does not say whether a hang-up is ignored, it is left alone.
        if signal == "HUP" && !cfg!(target_os = "linux") {
            continue;
        }
        let folder = Folder::new();
        let mut child = writing(&folder, "");
        send(signal, &child);
        let ended = child.wait().unwrap().code();
        if signal == "HUP" && ended == Some(0) {
            println!("skipped: these tests were started by nohup");
            continue;
        }
        assert_eq!(ended, Some(code), "{signal}");
        assert_eq!(folder.listing().len(), 1, "{signal}");
        assert_eq!(folder.read("noise.nrrd"), b"the old one");
    }
}

/// A program that `nohup` starts goes on after a hang-up. SIGTERM ends it.
#[test]
fn a_hangup_that_is_ignored_stays_ignored() {
    let folder = Folder::new();
    let mut child = writing(&folder, "trap '' HUP;");
    send("HUP", &child);
    std::thread::sleep(Duration::from_millis(100));
    assert!(child.try_wait().unwrap().is_none(), "the hang-up has ended it");
    send("TERM", &child);
    assert_eq!(child.wait().unwrap().code(), Some(143));
    assert_eq!(folder.read("noise.nrrd"), b"the old one");
}

/// A limit of file sizes makes the write fail. The unfinished file is removed, and the old one stays.
#[test]
fn a_write_beyond_the_limit_of_file_sizes_is_an_error() {
    let folder = Folder::new();
    // 4000 blocks of 512 or 1024 bytes.
    let run = |size: u32| {
        let line = format!("ulimit -f 4000; exec \"$0\" phantom white-noise --size {size} --type f64 -o noise.nrrd");
        let mut command = Command::new("sh");
        command.arg("-c").arg(line).arg(env!("CARGO_BIN_EXE_drypoint")).current_dir(folder.path(""));
        let ended = command.output().unwrap();
        (ended.status.code(), String::from_utf8(ended.stderr).unwrap())
    };
    // 0.9 MB fit, 8 MB do not.
    assert_eq!(run(48).0, Some(0));
    let before = folder.read("noise.nrrd");
    let (code, said) = run(100);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("noise.nrrd") && said.contains("ulimit -f"), "{said}");
    assert_eq!((folder.listing().len(), folder.read("noise.nrrd") == before), (1, true));
}
