//! The known name that a misspelt one probably meant.

/// The name with the fewest changed, added or left-out characters, if they are at most a third of the longer name
/// (and one is always allowed); ties go to the first.
pub(super) fn nearest_name<'a>(wanted: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let mut best: Option<(usize, &str)> = None;
    for name in known {
        let distance = edit_distance(wanted, name);
        let allowed = (wanted.chars().count().max(name.chars().count()) / 3).max(1);
        if distance <= allowed && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, name));
        }
    }
    best.map(|(_, name)| name)
}

/// Levenshtein's distance, capitals counted as small letters.
fn edit_distance(a: &str, b: &str) -> usize {
    let [a, b] = [a, b].map(|s| s.to_lowercase().chars().collect::<Vec<char>>());
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.iter().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let changed = diagonal + usize::from(x != y);
            diagonal = row[j + 1];
            row[j + 1] = changed.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_by_hand() {
        for (a, b, distance) in
            [("", "", 0), ("wax", "", 3), ("kitten", "sitting", 3), ("Wax", "wax", 0), ("bone", "bne", 1)]
        {
            assert_eq!(edit_distance(a, b), distance, "{a}, {b}");
            assert_eq!(edit_distance(b, a), distance, "{b}, {a}");
        }
    }

    #[test]
    fn a_name_is_suggested_only_if_it_is_near() {
        let known = ["bone", "metal", "wax"];
        assert_eq!(nearest_name("metall", known), Some("metal"));
        assert_eq!(nearest_name("max", known), Some("wax"));
        assert_eq!(nearest_name("porcelain", known), None);
    }
}
