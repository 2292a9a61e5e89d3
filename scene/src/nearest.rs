//! The known name that a misspelt one probably meant ([SCN-4]).

/// The most characters of a name that is looked for or found. Comparing two names takes the product of their lengths.
const LONGEST: usize = 100;

/// The name with the fewest slips: characters changed, added, left out, or two neighbours swapped. Capitals do not
/// count. At most a third of the longer name may be slips, but one slip is always allowed. Ties go to the first name.
/// Names of more than 100 characters have no nearest one.
pub(crate) fn nearest<'a>(wanted: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let length = |name: &str| Some(name.chars().take(LONGEST + 1).count()).filter(|&n| n <= LONGEST);
    let wanted_length = length(wanted)?;
    let slips = |name: &str| {
        let allowed = (wanted_length.max(length(name)?) / 3).max(1);
        Some(distance(wanted, name)).filter(|&d| d <= allowed)
    };
    // `min_by_key` keeps the first of equals.
    known.into_iter().filter_map(|name| slips(name).map(|d| (d, name))).min_by_key(|(d, _)| *d).map(|(_, name)| name)
}

/// Optimal string alignment: Levenshtein's distance with swapped neighbours as one slip.
fn distance(a: &str, b: &str) -> usize {
    let [a, b] = [a, b].map(|s| s.to_lowercase().chars().collect::<Vec<char>>());
    let (mut above2, mut above): (Vec<usize>, Vec<usize>) = (Vec::new(), (0..=b.len()).collect());
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let changed = above[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut best = changed.min(above[j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                best = best.min(above2[j - 2] + 1);
            }
            row.push(best);
        }
        above2 = std::mem::replace(&mut above, row);
    }
    above[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_by_hand() {
        for (a, b, d) in [
            ("", "", 0),
            ("fov", "", 3),
            ("kitten", "sitting", 3),
            ("fvo", "fov", 1),
            ("Kernel", "kernel", 0),
            ("ca", "abc", 3),
            ("gradeint", "gradient", 1),
        ] {
            assert_eq!(distance(a, b), d, "{a}, {b}");
            assert_eq!(distance(b, a), d, "{b}, {a}");
        }
    }

    #[test]
    fn only_a_near_name_is_named() {
        assert_eq!(nearest("contour", ["camera", "contours"]), Some("contours"));
        assert_eq!(nearest("porcelain", ["bone", "metal"]), None);
        assert_eq!(nearest("xp", ["up", "xu"]), Some("up"));
        assert_eq!(nearest("max", [] as [&str; 0]), None);
        for (n, is_found) in [(LONGEST, true), (LONGEST + 1, false)] {
            let [a, b] = ["a", "b"].map(|end| "é".repeat(n - 1) + end);
            assert_eq!(nearest(&a, [b.as_str()]), Some(b.as_str()).filter(|_| is_found));
        }
    }
}
