//! The command line around `clap`: the default verb, points and pixels that begin with a minus, and usage errors in
//! three lines.

use super::Cli;
use crate::Failure;
use clap::CommandFactory;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use std::ffi::OsString;
use std::path::Path;

/// The verb of a command line that names none.
const DEFAULT: &str = "render";

/// A command line with its verb in place.
pub(super) struct Arguments {
    /// The words for `clap` to parse.
    pub words: Vec<OsString>,
    /// The verb, for messages.
    pub verb: String,
}

impl Arguments {
    /// Puts the default verb in front of a command line that begins with options, a file, or nothing.
    pub(super) fn new(words: impl IntoIterator<Item = OsString>) -> Self {
        let mut words: Vec<OsString> = words.into_iter().collect();
        if words.is_empty() {
            words.push("drypoint".into());
        }
        let at = 1 + in_front(&words[1..]);
        let first = words.get(at).and_then(|word| word.to_str()).unwrap_or_default().to_owned();
        let own = ["help", "-h", "--help", "-V", "--version"].contains(&&*first);
        if own || Cli::command().find_subcommand(&first).is_some() || is_word(&first) {
            if first == "probe" || first == "pick" {
                protect_points(&mut words[at..]);
            }
            return Self { words, verb: first };
        }
        words.insert(at, DEFAULT.into());
        Self { words, verb: DEFAULT.into() }
    }
}

/// Returns the number of words in front of a verb: options of all verbs, with their values.
fn in_front(words: &[OsString]) -> usize {
    let mut n = 0;
    while let Some(word) = words.get(n).and_then(|word| word.to_str()) {
        n += match word {
            "-q" | "--quiet" | "-v" | "--verbose" => 1,
            "--threads" | "--memory" => 2,
            _ if word.starts_with("--threads=") || word.starts_with("--memory=") => 1,
            _ => break,
        };
    }
    n.min(words.len())
}

/// Whether a word in place of a verb is more likely a misspelt verb than a file: letters only, and no such file.
fn is_word(first: &str) -> bool {
    !first.is_empty() && first.bytes().all(|b| b.is_ascii_alphabetic()) && !Path::new(first).exists()
}

/// Protects points and pixels that begin with a minus, which `clap` takes for an option. A leading blank does not change a number.
fn protect_points(words: &mut [OsString]) {
    for word in words {
        let text = word.to_str().unwrap_or_default();
        let number =
            text.strip_prefix('-').is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit() || c == '.'));
        if number {
            *word = format!(" {text}").into();
        }
    }
}

/// Returns a usage error in three lines.
pub(super) fn refused(error: &clap::Error, verb: &str) -> Failure {
    let text = error.render().to_string();
    // The first paragraph says what is wrong; hints and the usage follow.
    let what = text.split("\n\n").next().unwrap_or_default().trim_start_matches("error: ");
    let what = match (error.kind(), error.get(ContextKind::InvalidSubcommand)) {
        (ErrorKind::InvalidSubcommand, Some(ContextValue::String(word))) => format!("there is no verb {word:?}"),
        _ => what.split_whitespace().collect::<Vec<_>>().join(" "),
    };
    let known = Cli::command().find_subcommand(verb).is_some();
    let place = if known { format!("drypoint {verb}") } else { "drypoint".into() };
    let suggested = [ContextKind::SuggestedArg, ContextKind::SuggestedSubcommand, ContextKind::SuggestedValue];
    let meant = suggested.into_iter().find_map(|kind| match error.get(kind)? {
        ContextValue::String(one) => Some(one.clone()),
        // The likeliest suggestion is the last.
        ContextValue::Strings(some) => some.last().cloned(),
        _ => None,
    });
    let help = format!("`{place} --help` tells what there is");
    let remedy = meant.map_or(help.clone(), |name| format!("write {name}; {help}"));
    Failure::new(what, place, remedy)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(line: &str) -> String {
        let arguments = Arguments::new(line.split(' ').map(OsString::from));
        arguments.words.iter().map(|w| w.to_str().unwrap()).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn the_default_verb_stands_behind_what_is_said_of_talking() {
        assert_eq!(words("drypoint"), "drypoint render");
        assert_eq!(words("drypoint -q -v a.toml"), "drypoint -q -v render a.toml");
        assert_eq!(
            words("drypoint --threads 2 --memory=1GiB a.toml"),
            "drypoint --threads 2 --memory=1GiB render a.toml"
        );
        assert_eq!(words("drypoint --memory 1GiB plan a.toml"), "drypoint --memory 1GiB plan a.toml");
        assert_eq!(words("drypoint --threads"), "drypoint --threads render");
        assert_eq!(words("drypoint --size 3x4"), "drypoint render --size 3x4");
        assert_eq!(words("drypoint folder/scene"), "drypoint render folder/scene");
        for same in ["drypoint -q render x", "drypoint --help", "drypoint help probe", "drypoint rendre", "drypoint -V"]
        {
            assert_eq!(words(same), same);
        }
    }

    #[test]
    fn a_point_may_begin_with_a_minus() {
        assert_eq!(words("drypoint probe a --at -1,2 -.5,0 -x"), "drypoint probe a --at  -1,2  -.5,0 -x");
    }
}
