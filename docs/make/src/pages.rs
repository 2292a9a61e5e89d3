//! What must be true of every page that people read: its scenes are scenes, and its links lead somewhere ([IO-3]).

use crate::files::in_docs;
use drypoint::job::Job;
use drypoint::output::compare::{CompareOptions, compare};
use drypoint::output::read::Image;
use drypoint::scene::file::{Overrides, is_figure, parse, parse_figure};
use std::path::{Path, PathBuf};

/// Folders that hold no pages: build outputs, and data from elsewhere.
const WITHOUT_PAGES: [&str; 2] = ["target", "shared"];

/// Every page: all Markdown of the repository, with its text.
fn pages() -> Vec<(PathBuf, String)> {
    let mut folders = vec![in_docs("..")];
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_string_lossy();
            if path.is_dir() && !name.starts_with('.') && !WITHOUT_PAGES.contains(&&*name) {
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

/// A table of a list stands alone, or goes on with the page's scene.
#[test]
fn scenes_on_pages_are_scenes() {
    let mut read = 0;
    for (page, text) in pages() {
        let faults_of = |scene: &str| {
            let faults = match is_figure(scene) {
                true => parse_figure(scene, &page, &Overrides::default()).err(),
                false => parse(scene, &page, &Overrides::default()).err(),
            };
            faults.map(|faults| faults.to_string())
        };
        let mut whole = String::new();
        for block in blocks(&text, "toml") {
            let Some(alone) = scene(block) else { continue };
            let longer = format!("{whole}\n{block}");
            if block.starts_with("drypoint") {
                block.clone_into(&mut whole);
            } else if block.starts_with("[[") && !whole.is_empty() && faults_of(&longer).is_none() {
                whole = longer;
                read += 1;
                continue;
            }
            if let Some(faults) = faults_of(&alone) {
                panic!("{}:\n{alone}\n{faults}", page.display());
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

/// The targets of a page's links and pictures: `[text](target)` and `src="target"`.
fn links(text: &str) -> impl Iterator<Item = &str> {
    let starts = text.lines().flat_map(|line| line.split("](").skip(1).map(|rest| (rest, ')')));
    let sources = text.lines().flat_map(|line| line.split("src=\"").skip(1).map(|rest| (rest, '"')));
    starts.chain(sources).filter_map(|(rest, end)| rest.split(end).next()).filter(|t| !t.contains("://"))
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

/// The items that a page names behind a link to a Rust file: ``[`file.rs`](path/file.rs): `item`, `Type::item` ``.
fn items(text: &str) -> impl Iterator<Item = (&str, &str)> {
    let after_links = text.lines().flat_map(|line| line.split("](").skip(1)).filter_map(|rest| rest.split_once(')'));
    after_links.filter(|(file, _)| file.ends_with(".rs")).flat_map(|(file, rest)| {
        let mut names = Vec::new();
        let mut rest = rest.strip_prefix(": `");
        while let Some((name, more)) = rest.and_then(|rest| rest.split_once('`')) {
            names.push((file, name));
            rest = more.strip_prefix(", `");
        }
        names
    })
}

/// Whether a Rust file declares an item, or for `Type::item` the item beside a mention of the type.
fn declares(source: &str, item: &str) -> bool {
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let words: Vec<&str> = source.split(|c| !is_name(c)).filter(|word| !word.is_empty()).collect();
    let (of, name) = item.rsplit_once("::").unwrap_or(("", item));
    let keyword = |word: &str| ["fn", "struct", "enum", "trait", "const", "static", "type"].contains(&word);
    (of.is_empty() || words.contains(&of)) && words.windows(2).any(|pair| keyword(pair[0]) && pair[1] == name)
}

#[test]
fn items_behind_links_to_rust_files_are_declared_there() {
    let mut found = 0;
    for (page, text) in pages() {
        for (file, item) in items(&text) {
            let source = std::fs::read_to_string(page.parent().unwrap().join(file)).unwrap();
            assert!(declares(&source, item), "{}: {file} declares no {item}", page.display());
            found += 1;
        }
    }
    assert!(found >= 50, "only {found} items were found");
}

#[test]
fn items_are_read_from_links_and_found_in_sources() {
    let line = "| x | [`a.rs`](b/a.rs): `Ray::cast`, `END` and [`c.md`](c.md): `no`, [`d.rs`](d.rs) |";
    assert_eq!(items(line).collect::<Vec<_>>(), [("b/a.rs", "Ray::cast"), ("b/a.rs", "END")]);
    let source = "/// cast\nstruct Ray; impl Ray { fn cast_all() {} } const END: u8 = 0;";
    let declared = ["Ray", "Ray::cast_all", "END", "cast", "Ray::cast", "Path::cast_all"].map(|i| declares(source, i));
    assert_eq!(declared, [true, true, true, false, false, false]);
}
