//! The commands of README, tutorials and gallery, run as a reader would: in a folder with data, one after the other.

use crate::files::{self, in_docs};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

/// Pages whose commands are run.
const PAGES: [&str; 9] = [
    "../README.md",
    "gallery.md",
    "tutorials/first-picture.md",
    "tutorials/from-a-ct-file-to-a-plotter.md",
    "tutorials/halos.md",
    "tutorials/a-textbook-figure.md",
    "tutorials/a-style-from-a-picture.md",
    "tutorials/lift-ghost-and-cut.md",
    "tutorials/a-hatched-head.md",
];

/// Files that a reader has: their name on the pages, and a file of the data or of the repository in their place.
const STAND_INS: [(&str, &str); 3] = [
    ("your.nii.gz", "mri_head.nii.gz"),
    ("head.nrrd", "cthead.nhdr"),
    ("scene.toml", "data/scenes/style_transfer_functions/engine.toml"),
];

/// Beginnings of lines that are not run: they build, they run this program, or they need a file or a program that only
/// the reader has.
const NOT_RUN: [&str; 6] = [
    "cargo build",
    "cargo install",
    "cargo test",
    "cargo run --release -p",
    "vpype",
    "drypoint styles extract still-life.jpg",
];

/// Pictures of the docs that commands of a page write: the page, the file, and its place in `docs`.
const PICTURES: [(&str, &str, &str); 5] = [
    ("tutorials/first-picture.md", "four.png", "pictures/first-picture.png"),
    ("tutorials/halos.md", "four.png", "pictures/volumetric_halos/tutorial.png"),
    ("tutorials/a-textbook-figure.md", "page.png", "pictures/volumeshop/tutorial.png"),
    ("tutorials/lift-ghost-and-cut.md", "four.png", "pictures/volumeshop/tutorial-kidney.png"),
    ("tutorials/a-hatched-head.md", "four.png", "pictures/interactive_volume_illustration/tutorial.png"),
];

/// Runs every command of the pages, prints its time, and keeps the pictures that pages show. Words after the command
/// select pages by a part of their path.
///
/// # Errors
/// A command that fails, with its page.
pub(crate) fn run() -> Result<(), String> {
    let root = in_docs("..").canonicalize().map_err(|e| e.to_string())?;
    let data = std::env::var_os("DRYPOINT_DATA").map_or_else(|| root.join("../shared/data"), PathBuf::from);
    let asked: Vec<String> = std::env::args().skip(2).collect();
    for page in PAGES.iter().filter(|page| asked.is_empty() || asked.iter().any(|part| page.contains(part))) {
        let text = std::fs::read_to_string(in_docs(page)).map_err(|e| format!("{page}: {e}"))?;
        let folder = tempfile::tempdir().map_err(|e| e.to_string())?;
        furnish(folder.path(), &root, &data).map_err(|e| format!("{}: {e}", folder.path().display()))?;
        println!("{page}");
        run_page(&text, folder.path(), &root, &data).map_err(|e| format!("{page}: {e}"))?;
        for (_, file, picture) in PICTURES.iter().filter(|(of, ..)| of == page) {
            let bytes = std::fs::read(folder.path().join(file)).map_err(|e| format!("{page}: {file}: {e}"))?;
            files::write(picture, &bytes)?;
        }
    }
    Ok(())
}

/// Puts the repository's folder `data`, the volumes and the stand-ins into a folder.
fn furnish(folder: &Path, root: &Path, data: &Path) -> std::io::Result<()> {
    copy_folder(&root.join("data"), &folder.join("data"))?;
    for entry in std::fs::read_dir(data)? {
        let path = entry?.path();
        if let Some(name) = path.file_name().filter(|_| path.is_file()) {
            std::fs::copy(&path, folder.join(name))?;
        }
    }
    for (name, source) in STAND_INS {
        std::fs::copy(folder.join(source), folder.join(name))?;
    }
    Ok(())
}

/// Copies a folder with everything in it.
fn copy_folder(from: &Path, to: &Path) -> std::io::Result<()> {
    std::fs::create_dir_all(to)?;
    for entry in std::fs::read_dir(from)? {
        let path = entry?.path();
        let target = to.join(path.file_name().unwrap_or_default());
        if path.is_dir() { copy_folder(&path, &target)? } else { std::fs::copy(&path, &target).map(|_| ())? }
    }
    Ok(())
}

/// Runs the commands of a page in order. A whole scene on the page is saved under the name that the text gave last, and
/// a further `[[table]]` is added to it.
fn run_page(text: &str, folder: &Path, root: &Path, data: &Path) -> Result<(), String> {
    let mut scene_name = None;
    let mut block: Option<(&str, String)> = None;
    for line in text.lines() {
        match (&mut block, line.strip_prefix("```")) {
            (None, Some(language)) => block = Some((language, String::new())),
            (Some((language, body)), Some(_)) => {
                if *language == "sh" {
                    body.lines().try_for_each(|line| run_line(line, folder, root, data))?;
                } else if let Some(name) = scene_name {
                    let path = folder.join(name);
                    let before = if body.starts_with("[[") { std::fs::read_to_string(&path).ok() } else { None };
                    if before.is_some() || body.lines().any(|line| line == "drypoint = 1") {
                        let text = before.unwrap_or_default() + body;
                        std::fs::write(path, text).map_err(|e| format!("{name}: {e}"))?;
                    }
                }
                block = None;
            }
            (Some((_, body)), None) => {
                body.push_str(line);
                body.push('\n');
            }
            (None, None) => {
                scene_name = line.split('`').find(|part| part.ends_with(".toml") && !part.contains('/')).or(scene_name)
            }
        }
    }
    Ok(())
}

/// Runs a line of a shell.
fn run_line(line: &str, folder: &Path, root: &Path, data: &Path) -> Result<(), String> {
    if NOT_RUN.iter().any(|start| line.starts_with(start)) {
        println!("     -     {line}");
        return Ok(());
    }
    let program = root.join("target/release/drypoint");
    let line = line.replace("cargo run --release --", "drypoint");
    let script = line.replacen("drypoint", &program.display().to_string(), 1);
    let begin = Instant::now();
    let output = Command::new("sh")
        .args(["-c", &script])
        .current_dir(folder)
        .env("DRYPOINT_DATA", data)
        .stdin(Stdio::null())
        .output()
        .map_err(|e| format!("{line}: {e}"))?;
    println!("{:>8.1} s {line}", begin.elapsed().as_secs_f64());
    if output.status.success() { Ok(()) } else { Err(format!("{line}\n{}", String::from_utf8_lossy(&output.stderr))) }
}
