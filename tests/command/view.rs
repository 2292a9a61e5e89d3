//! `view` starts the window's program, or says how to get it.

use crate::folder::Folder;
use std::process::Command;

/// The command alone in a folder, so that no window beside it opens. Linux starts no file that a process has open for
/// writing, which a process that another test starts meanwhile would inherit; so another process writes it.
fn alone(folder: &Folder) -> Command {
    let name = folder.path("drypoint").with_extension(std::env::consts::EXE_EXTENSION);
    let command = env!("CARGO_BIN_EXE_drypoint");
    if cfg!(unix) {
        assert!(Command::new("cp").arg(command).arg(&name).status().unwrap().success());
    } else {
        std::fs::copy(command, &name).unwrap();
    }
    let mut command = Command::new(name);
    command.current_dir(folder.path("")).env("PATH", "");
    command
}

#[test]
fn without_the_program_it_says_how_to_install_it() {
    let folder = Folder::new();
    let output = alone(&folder).args(["view", "head.nrrd"]).output().unwrap();
    let text = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{text}");
    assert!(
        text.starts_with("error: the window cannot be opened: ") && text.contains("\n  at: drypoint-viewer"),
        "{text}"
    );
    assert!(text.ends_with("\n  try: install it with cargo install --path viewer --locked\n"), "{text}");
}

#[cfg(unix)]
#[test]
fn the_program_beside_the_command_gets_the_file() {
    let folder = Folder::new();
    let write = |line: &str| {
        let line = format!("printf '#!/bin/sh\\n%s\\n' '{line}' > drypoint-viewer; chmod +x drypoint-viewer");
        let written = Command::new("sh").args(["-c", &line]).current_dir(folder.path("")).status().unwrap();
        assert!(written.success());
    };
    write("echo \"$1\" > shown");
    let status = alone(&folder).args(["view", "head.nrrd"]).status().unwrap();
    assert!(status.success());
    assert_eq!(folder.read("shown"), b"head.nrrd\n");
    write("exit 2");
    let output = alone(&folder).arg("view").output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8(output.stderr).unwrap().starts_with("error: the window ended with"));
}
