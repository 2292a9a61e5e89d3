//! `docs/only-what-is-called-for.md`: for each effect what is counted and how long it takes, with it and without.

mod effects;
mod measure;
mod scenes;

use crate::files;
use effects::{EFFECTS, Effect};
use measure::{Folder, Named, median, run};
use std::collections::BTreeSet;
use std::fmt::Write;

/// Frames of each kind, in turns after one that warms up.
const ROUNDS: usize = 7;

/// The counts that a row shows whether or not they differ.
const SHOWN: [&str; 4] = ["samples", "gradients", "hessians", "style_lookups"];

/// Counts and times all effects, or those whose names contain a word behind `called-for`, and writes the page. Other
/// effects keep their rows.
///
/// # Errors
/// What a scene, the renderer or the system says.
pub(crate) fn write() -> Result<(), String> {
    let only: Vec<String> = std::env::args().skip(2).collect();
    let place = files::in_docs(NAME);
    let before = std::fs::read_to_string(&place).map_err(|error| format!("{}: {error}", place.display()))?;
    let folder = Folder::new()?;
    let mut rows = String::new();
    for effect in EFFECTS {
        let kept = before.lines().find(|line| line.starts_with(&effect.first_cell()));
        if let Some(kept) = kept.filter(|_| !only.is_empty() && !only.iter().any(|word| effect.name.contains(word))) {
            rows += &format!("{kept}\n");
            continue;
        }
        let [without, with] = in_turns(&folder, effect)?;
        if let Some(fault) = fault(effect, &without.0, &with.0) {
            return Err(fault);
        }
        row(&mut rows, effect, &without, &with);
    }
    let page = PAGE.replace("{rows}", rows.trim_end()).replace("{rounds}", &ROUNDS.to_string());
    files::write(NAME, page.as_bytes())
}

/// The page.
const NAME: &str = "only-what-is-called-for.md";

/// The page around its table.
const PAGE: &str = include_str!("page.template");

/// Counts and median seconds without an effect and with it.
fn in_turns(folder: &Folder, effect: &Effect) -> Result<[(Named, f64); 2], String> {
    let jobs = [folder.job(effect.base, &[effect.without])?, folder.job(effect.base, &[effect.with])?];
    let mut seconds = [const { Vec::new() }; 2];
    let mut counts = [Named::new(), Named::new()];
    for round in 0..=ROUNDS {
        for ((job, seconds), counts) in jobs.iter().zip(&mut seconds).zip(&mut counts) {
            let (named, took) = run(job)?;
            *counts = named;
            if round > 0 {
                seconds.push(took);
            }
        }
    }
    let [a, b] = seconds;
    let [m, n] = counts;
    Ok([(m, median(a)), (n, median(b))])
}

/// A count that an effect has no right to change, or that it should and does not ([PLAN-1]): a scene that lacks an effect
/// does none of its work, and an effect adds no work but its own.
fn fault(effect: &Effect, without: &Named, with: &Named) -> Option<String> {
    let named = [effect.only, effect.more, effect.fewer].concat();
    let names: BTreeSet<&str> = without.keys().chain(with.keys()).map(String::as_str).chain(named).collect();
    names.into_iter().find_map(|name| {
        let (a, b) = (count(without, name), count(with, name));
        let right = if effect.only.contains(&name) {
            a == 0 && b > 0
        } else if effect.perhaps.contains(&name) {
            a == 0
        } else if effect.more.contains(&name) {
            b > a
        } else if effect.fewer.contains(&name) {
            b < a
        } else {
            a == b || effect.others.contains(&name)
        };
        (!right).then(|| format!("{}: {name} goes from {a} to {b}", effect.name))
    })
}

/// A count, 0 where there is none of that name.
fn count(named: &Named, name: &str) -> u64 {
    named.get(name).copied().unwrap_or(0)
}

fn row(rows: &mut String, effect: &Effect, (m, s): &(Named, f64), (n, t): &(Named, f64)) {
    let cell = |name: &str| match (count(m, name), count(n, name)) {
        (a, b) if a == b => thousands(a),
        (a, b) => format!("{} → **{}**", thousands(a), thousands(b)),
    };
    let others = m.keys().chain(n.keys()).filter(|name| !SHOWN.contains(&name.as_str()));
    let mut others: Vec<&String> = others.filter(|name| count(m, name) != count(n, name)).collect();
    others.sort();
    others.dedup();
    let others: Vec<String> = others.iter().map(|name| format!("{name} {}", cell(name))).collect();
    let shown = SHOWN.map(cell).join(" | ");
    let (first, others) = (effect.first_cell(), others.join("<br>"));
    // Writing to a text does not fail.
    let _ = writeln!(rows, "{first} {shown} | {others} | {:.1} → {:.1} |", s * 1e3, t * 1e3);
}

/// A count with its thousands apart.
fn thousands(count: u64) -> String {
    let digits = count.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_effect_adds_its_own_work_and_no_other() {
        let small: effects::Settings = &[("picture.size", "[48, 48]"), ("volume.phantom.size", "32")];
        let folder = Folder::new().unwrap();
        for effect in EFFECTS {
            let [without, with] = [effect.without, effect.with]
                .map(|settings| run(&folder.job(effect.base, &[small, settings]).unwrap()).unwrap().0);
            assert_eq!(fault(effect, &without, &with), None);
        }
    }

    /// The page has a row for every effect: it was written since the last one came.
    #[test]
    fn the_page_has_every_effect() {
        let page = std::fs::read_to_string(files::in_docs(NAME)).unwrap();
        for effect in EFFECTS {
            assert!(page.contains(&effect.first_cell()), "{}", effect.name);
        }
    }

    #[test]
    fn digits_are_grouped_from_the_right() {
        let shown = [0, 999, 1000, 1234567].map(|n| thousands(n).replace('\u{202f}', " "));
        assert_eq!(shown, ["0", "999", "1 000", "1 234 567"]);
    }
}
