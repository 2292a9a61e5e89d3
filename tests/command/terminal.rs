//! Names on a terminal: those that could change what stands around them are escaped.

#![cfg(unix)]

use crate::folder::{Folder, SCENE, Said};

/// Red from here on, written from right to left, and another way to say that.
const NASTY: &str = "a\u{1b}[31m\u{202e}\u{9b}31m\u{2066}b";

/// [`NASTY`] as a terminal gets it.
const PLAIN: &str = r"a\u{1b}[31m\u{202e}\u{9b}31m\u{2066}b";

fn good(folder: &Folder, words: &[&str]) -> Said {
    let said = folder.run(words);
    assert_eq!(said.code, Some(0), "{words:?}\n{}", said.err);
    let is_plain = |c: char| c == '\n' || !drypoint::scene::unprintable::is_unprintable(c);
    assert!(said.out.chars().chain(said.err.chars()).all(is_plain), "{words:?}\n{:?}\n{:?}", said.out, said.err);
    said
}

#[test]
fn info_names_the_file() {
    let folder = Folder::new();
    let name = format!("{NASTY}.nrrd");
    let said = good(&folder, &["phantom", "constant", "--size", "2", "-o", &name]);
    assert_eq!(said.err, format!("{PLAIN}.nrrd\n"));
    let said = good(&folder, &["info", &name]);
    assert!(said.out.starts_with(&format!("file       {PLAIN}.nrrd\n")), "{}", said.out);
    // JSON stays JSON, of the name as it is.
    let said = good(&folder, &["info", "--json", &name]);
    assert_eq!(serde_json::from_str::<serde_json::Value>(&said.out).unwrap()["file"], name);
}

#[test]
fn verbose_and_plan_name_the_file() {
    let folder = Folder::new();
    let name = format!("{NASTY}.nrrd");
    good(&folder, &["phantom", "torus", "--size", "12", "-o", &name]);
    let said = good(&folder, &["-v", "render", &name, "--size", "8x8"]);
    assert!(said.err.starts_with(&format!("{PLAIN}.nrrd: 12 × 12 × 12 voxels")), "{}", said.err);
    assert!(said.err.contains(&format!("\n{PLAIN}.png\n")), "{}", said.err);
    // The scene of --full stays a scene of the same file.
    let full = good(&folder, &["plan", "--full", &name]).out;
    folder.write("full.toml", &full);
    good(&folder, &["render", "full.toml", "--size", "8x8"]);
}

#[test]
fn styles_names_those_of_a_theme() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("theme")).unwrap();
    folder.write(&format!("theme/{NASTY}.png"), "");
    assert_eq!(good(&folder, &["styles", "--theme", "theme"]).out, format!("{PLAIN}\n"));
}

#[test]
fn a_plotter_names_its_pens() {
    let folder = Folder::new();
    let pen = serde_json::to_string(NASTY).unwrap().replace('\u{9b}', "\\u009b");
    folder
        .write("pens.toml", format!("{SCENE}[stipples]\npen = {pen}\n[page]\nplotter = true\n[[pen]]\nname = {pen}\n"));
    let said = good(&folder, &["points", "pens.toml", "-o", "page.svg"]);
    assert!(said.err.contains(&format!("1-{PLAIN} ")), "{}", said.err);
}

/// An error shows a blank for a control character, as for a line break, and the direction of writing is escaped.
#[test]
fn errors_name_what_is_wrong() {
    let folder = Folder::new();
    let said = folder.run(["info", &format!("{NASTY}.nrrd")]);
    assert!(said.err.contains(r"  at: a [31m\u{202e} 31m\u{2066}b.nrrd"), "{}", said.err);
}
