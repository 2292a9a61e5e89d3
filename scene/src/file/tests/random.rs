//! Scenes with random slips: a fault or a scene, never a panic.

use super::round_trip::FULL_OF_KEYS;
use super::*;
use proptest::prelude::*;

/// What a slip may put into a text.
const PIECES: [&str; 24] = [
    "=",
    "[",
    "]",
    "[[",
    "]]",
    "{",
    "}",
    ".",
    ",",
    "\"",
    "\n",
    "#",
    "-",
    "nan",
    "inf",
    "1e999",
    "99999999999999999999",
    "0",
    "true",
    "\"q2\"",
    "\u{0}",
    "é",
    "1979-05-27",
    "[volume]\n",
];

fn slip(text: &mut String, at: usize, kind: usize, piece: usize) {
    let places: Vec<usize> = text.char_indices().map(|(i, _)| i).chain([text.len()]).collect();
    let from = places[at % places.len()];
    let to = places[(at % places.len() + 1 + kind / 4 % 9).min(places.len() - 1)];
    match kind % 4 {
        0 => text.replace_range(from..to, ""),
        1 => text.insert_str(from, PIECES[piece % PIECES.len()]),
        2 => text.replace_range(from..to, PIECES[piece % PIECES.len()]),
        _ => {
            let mut lines: Vec<&str> = text.lines().collect();
            let n = lines.len().max(1);
            if lines.len() > 1 {
                lines.swap(at % n, piece % n);
            }
            *text = lines.join("\n");
        }
    }
}

fn judge(text: &str, overrides: &Overrides) {
    match parse(text, Path::new("s.toml"), overrides) {
        Ok(scene) => {
            let full = write_full(&scene);
            let back =
                parse(&full, Path::new("s.toml"), &Overrides::default()).unwrap_or_else(|f| panic!("{full}\n{f}"));
            assert_eq!(back, scene, "{full}");
            assert!(!crate::plan::Plan::new(&scene).to_string().is_empty());
        }
        Err(faults) => {
            let (said, count) = (faults.to_string(), faults.iter().count());
            assert!(count > 0);
            assert_eq!(said.lines().count(), 3 * count, "{said}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn a_scene_with_slips(slips in prop::collection::vec((any::<u16>(), 0usize..64, 0usize..64), 1..4)) {
        let mut text = FULL_OF_KEYS.to_owned();
        for (at, kind, piece) in slips {
            slip(&mut text, usize::from(at), kind, piece);
        }
        judge(&text, &Overrides::default());
    }

    #[test]
    fn any_text(text in "\\PC{0,60}") {
        judge(&text, &Overrides::default());
    }

    #[test]
    fn any_override(key in "[a-z_.\\[\\]0-9\"]{0,20}|camera\\.[a-z]{0,3}|transfer\\.nodes[.\\[][0-9]\\]?[a-z.]{0,4}", value in "\\PC{0,12}|off") {
        judge(FULL_OF_KEYS, &[(key, value)].into_iter().collect());
    }

    #[test]
    fn a_described_key_with_any_value(which in any::<prop::sample::Index>(), piece in 0usize..PIECES.len(), text in "\\PC{0,8}") {
        let keys = every_key();
        let key = keys[which.index(keys.len())].0.clone();
        judge(FULL_OF_KEYS, &[(key.clone(), PIECES[piece])].into_iter().collect());
        judge(FULL_OF_KEYS, &[(key, text)].into_iter().collect());
    }
}
