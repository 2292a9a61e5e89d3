//! What must be true of every page that people read: its scenes are scenes, and its links lead somewhere ([IO-3]).

use crate::files::in_docs;
use drypoint::job::Job;
use drypoint::output::compare::{CompareOptions, compare};
use drypoint::output::read::Image;
use drypoint::scene::file::{Overrides, parse};
use std::path::{Path, PathBuf};

/// Every page: README, that of the data, and all Markdown under `docs/`, with its text.
fn pages() -> Vec<(PathBuf, String)> {
    let mut folders = vec![in_docs("")];
    let mut files = vec![in_docs("../README.md"), in_docs("../data/README.md")];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() && !path.ends_with("make") {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "md") {
                files.push(path);
            }
        }
    }
    files.sort();
    files.into_iter().map(|file| (file.clone(), std::fs::read_to_string(file).unwrap())).collect()
}

/// The fenced blocks of a language.
fn blocks<'t>(text: &'t str, language: &str) -> Vec<&'t str> {
    let fence = format!("\n```{language}\n");
    text.split(fence.as_str()).skip(1).map(|rest| rest.split("\n```").next().unwrap()).collect()
}

/// A scene around a block: tables alone and nodes alone are parts of one. None for what is no scene.
fn scene(block: &str) -> Option<String> {
    let volume = "[volume]\nphantom = { name = \"sphere\" }\n";
    match block.split_whitespace().next()? {
        "drypoint" => Some(block.into()),
        "[volume]" => Some(format!("drypoint = 1\n{block}")),
        first if first.starts_with('[') => Some(format!("drypoint = 1\n{volume}{block}")),
        "nodes" => Some(format!("drypoint = 1\n{volume}[transfer]\n{block}")),
        _ => None,
    }
}

#[test]
fn scenes_on_pages_are_scenes() {
    let mut read = 0;
    for (page, text) in pages() {
        for scene in blocks(&text, "toml").into_iter().filter_map(scene) {
            if let Err(faults) = parse(&scene, &page, &Overrides::default()) {
                panic!("{}:\n{scene}\n{faults}", page.display());
            }
            read += 1;
        }
    }
    assert!(read >= 6, "only {read} scenes were found");
}

/// The numbers by which errata show that the printed normal makes another picture are those of the printed recipe.
#[test]
fn the_recipe_of_errata_gives_its_numbers() {
    let text = std::fs::read_to_string(in_docs("papers/errata.md")).unwrap();
    let ball = blocks(&text, "toml").into_iter().find(|block| block.contains("\"sphere\"")).unwrap();
    let [outward, printed] = ["outward", "gradient"].map(|side| {
        let overrides = Overrides::from_iter([("sampling.normal", side)]);
        let job = Job::load(parse(ball, Path::new("ball.toml"), &overrides).unwrap()).unwrap();
        Image::from(&job.renderer().unwrap().frame(&|_| ()).0)
    });
    let compared = compare(&outward, &printed, &CompareOptions::default()).unwrap();
    let said = format!("differ by up to {:.2}, and the mean FLIP is {:.2}", compared.max, compared.flip.unwrap());
    assert!(text.contains(&said), "{said}");
}

/// The anchors of a page's headings, as GitHub makes them.
fn anchors(text: &str) -> Vec<String> {
    let kept = |c: char| c.is_alphanumeric() || c == '-' || c == ' ' || c == '_';
    let anchor = |line: &str| line.trim_start_matches('#').trim().to_lowercase().chars().filter(|&c| kept(c)).collect();
    text.lines().filter(|line| line.starts_with('#')).map(anchor).map(|a: String| a.replace(' ', "-")).collect()
}

/// Where the links and the pictures of a page lead: `[text](target)`.
fn links(text: &str) -> impl Iterator<Item = &str> {
    text.lines()
        .flat_map(|line| line.split("](").skip(1))
        .filter_map(|rest| rest.split(')').next())
        .filter(|t| !t.contains("://"))
}

#[test]
fn links_lead_to_files_and_headings_that_are_there() {
    let mut followed = 0;
    for (page, text) in pages() {
        for link in links(&text) {
            let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
            let target = page.parent().unwrap_or(Path::new("")).join(file);
            let target = if file.is_empty() { page.clone() } else { target };
            assert!(target.exists(), "{}: {link} leads nowhere", page.display());
            if !anchor.is_empty() {
                let known = anchors(&std::fs::read_to_string(&target).unwrap());
                assert!(known.iter().any(|a| a == anchor), "{}: no heading for {link}", page.display());
            }
            followed += 1;
        }
    }
    assert!(followed >= 30, "only {followed} links were found");
}
