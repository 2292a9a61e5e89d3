//! `docs/rules.md`: the rules that the sources cite by tags, in a sentence each.

mod sentences;

use crate::files;
use sentences::FAMILIES;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Where people and machines read of rules, from the root of the repository.
const PLACES: [&str; 10] =
    ["CHANGELOG.md", "README.md", "benches", "data", "docs", "output", "reference", "scene", "src", "tests"];

/// What is no citation: the page itself and the table that it is made of.
const NOT_HERE: [&str; 2] = ["docs/rules.md", "docs/make/src/rules"];

/// A tag: `("SPACE", 1)` of `[SPACE-1]`.
type Tag = (String, u32);

/// Writes the page.
///
/// # Errors
/// A file that cannot be read or written, a tag without a sentence.
pub(crate) fn write() -> Result<(), String> {
    files::write("rules.md", page(&citations()?)?.as_bytes())
}

/// The files that cite each tag, by their paths from the root, in alphabetical order.
fn citations() -> Result<BTreeMap<Tag, BTreeSet<String>>, String> {
    let root = files::in_docs("..");
    let mut cited: BTreeMap<Tag, BTreeSet<String>> = BTreeMap::new();
    let mut open: Vec<PathBuf> = PLACES.iter().map(PathBuf::from).collect();
    while let Some(path) = open.pop() {
        if NOT_HERE.iter().any(|other| path == Path::new(other)) {
            continue;
        }
        let here = root.join(&path);
        let say = |e: io::Error| format!("{}: {e}", here.display());
        if here.is_dir() {
            for entry in fs::read_dir(&here).map_err(say)? {
                open.push(path.join(entry.map_err(say)?.file_name()));
            }
        } else if path.extension().is_some_and(|e| ["md", "rs", "toml"].iter().any(|known| e == *known)) {
            // The same on every system.
            let name = path.iter().map(|part| part.to_string_lossy()).collect::<Vec<_>>().join("/");
            for tag in tags(&fs::read_to_string(&here).map_err(say)?) {
                cited.entry(tag).or_default().insert(name.clone());
            }
        }
    }
    Ok(cited)
}

/// The tags in a text: letters of a known family, a hyphen and a number; in brackets, any capitals and a number.
fn tags(text: &str) -> BTreeSet<Tag> {
    let tag = |at: usize| {
        let (before, after) = (&text[..at], &text[at + 1..]);
        let letters = before.trim_end_matches(|c: char| c.is_ascii_uppercase());
        let digits = after.trim_start_matches(|c: char| c.is_ascii_digit());
        let (family, number) = (&before[letters.len()..], &after[..after.len() - digits.len()]);
        let bracketed = letters.ends_with('[') && digits.starts_with(']');
        let apart = |c: Option<char>| !c.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == '-');
        let known = FAMILIES.iter().any(|known| known.letters == family);
        let whole = apart(letters.chars().next_back()) && apart(digits.chars().next());
        let number = number.parse().ok().filter(|_| !family.is_empty())?;
        (bracketed || (known && whole)).then(|| (family.to_owned(), number))
    };
    text.match_indices('-').filter_map(|(at, _)| tag(at)).collect()
}

/// The sentence of a tag.
fn sentence((letters, number): &Tag) -> Option<&'static str> {
    let family = FAMILIES.iter().find(|family| family.letters == letters)?;
    family.rules.iter().find(|(n, _)| n == number).map(|(_, sentence)| *sentence)
}

/// The page for what is cited.
///
/// # Errors
/// Every tag without a sentence, with a file that cites it.
fn page(cited: &BTreeMap<Tag, BTreeSet<String>>) -> Result<String, String> {
    let unknown: Vec<String> = cited
        .iter()
        .filter(|(tag, _)| sentence(tag).is_none())
        .map(|((letters, number), files)| {
            let file = files.first().map_or("", String::as_str);
            format!("{letters}-{number} has no sentence in docs/make/src/rules/sentences.rs; {file} cites it")
        })
        .collect();
    if !unknown.is_empty() {
        return Err(unknown.join("\n"));
    }
    let mut page = String::from(
        "# Rules\n\nComments, tests, errors and pages cite rules by tags such as [SPACE-1].\nThis page says in a sentence \
         what each of them asks for.\n\n`cargo run --release -p drypoint-docs -- rules` writes it.\n",
    );
    for family in &FAMILIES {
        let tag = |number: u32| (family.letters.to_owned(), number);
        let rules: Vec<_> = family.rules.iter().filter(|(n, _)| cited.contains_key(&tag(*n))).collect();
        if !rules.is_empty() {
            page += &format!("\n## {}\n", family.subject);
        }
        for (number, sentence) in rules {
            page += &format!("\n### {}-{number}\n\n{sentence}\n", family.letters);
        }
    }
    Ok(page)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tags_by_hand() {
        let text =
            "A sample ([SPACE-1], [ABC-2]) of \"RAY-6\", IO-6.\nUTF-8, [1-2], XRAY-1, RAY-1a, RAY-, xIO-1, [-3], VS-5…";
        let expected = [("ABC", 2), ("IO", 6), ("RAY", 6), ("SPACE", 1), ("VS", 5)];
        assert_eq!(tags(text).into_iter().collect::<Vec<_>>(), expected.map(|(letters, n)| (letters.to_owned(), n)));
    }

    #[test]
    fn families_and_rules_are_told_once_in_order_and_in_short_sentences() {
        let mut letters: Vec<&str> = FAMILIES.iter().map(|family| family.letters).collect();
        letters.sort_unstable();
        letters.dedup();
        assert_eq!(letters.len(), FAMILIES.len());
        for family in &FAMILIES {
            assert!(family.rules.windows(2).all(|pair| pair[0].0 < pair[1].0), "{}", family.letters);
            for (n, sentence) in family.rules {
                let whole = sentence.ends_with('.') && !sentence.contains(". ") && sentence.chars().count() <= 220;
                assert!(whole, "{}-{n}: {sentence}", family.letters);
            }
        }
    }

    #[test]
    fn a_tag_without_a_sentence_is_an_error_that_names_it_and_a_file() {
        let cited = |letters: &str, n| BTreeMap::from([((letters.to_owned(), n), BTreeSet::from(["a.rs".to_owned()]))]);
        assert_eq!(
            page(&cited("RAY", 99)).unwrap_err(),
            "RAY-99 has no sentence in docs/make/src/rules/sentences.rs; a.rs cites it"
        );
        assert!(page(&cited("ABC", 1)).is_err());
        let page = page(&cited("RAY", 3)).unwrap();
        assert!(page.ends_with("order of tiles.\n") && !page.contains("RAY-2"), "{page}");
    }

    #[test]
    fn every_tag_that_is_cited_has_a_sentence_and_the_page_is_as_it_would_be_written() {
        let expected = page(&citations().unwrap()).unwrap();
        let written = fs::read_to_string(files::in_docs("rules.md")).unwrap_or_default();
        assert!(written == expected, "docs/rules.md is out of date: cargo run --release -p drypoint-docs -- rules");
    }
}
