//! What can be wrong with a phantom's name and parameters.

use crate::space::SpaceError;
use crate::volume::VolumeError;

/// A phantom that cannot be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PhantomError {
    /// No phantom has that name.
    #[error("no phantom is called `{name}`{}; phantoms: {}", suggestion(nearest), known.join(", "))]
    UnknownName {
        /// As given.
        name: String,
        /// The known name that is nearest, if one is near.
        nearest: Option<&'static str>,
        /// Every known name.
        known: Vec<&'static str>,
    },
    /// The phantom has no parameter of that name.
    #[error("phantom `{phantom}` has no parameter `{param}`{}; parameters: {}", suggestion(nearest), known.join(", "))]
    UnknownParam {
        /// Which phantom.
        phantom: &'static str,
        /// As given.
        param: String,
        /// The known name that is nearest, if one is near.
        nearest: Option<&'static str>,
        /// Every parameter of this phantom.
        known: Vec<&'static str>,
    },
    /// A parameter is given twice.
    #[error("phantom `{phantom}`: parameter `{param}` is given twice")]
    Repeated {
        /// Which phantom.
        phantom: &'static str,
        /// Which parameter.
        param: &'static str,
    },
    /// A parameter's value is not allowed.
    #[error("phantom `{phantom}`: parameter `{param}` is {value}, expected {expected}")]
    OutOfRange {
        /// Which phantom.
        phantom: &'static str,
        /// Which parameter.
        param: &'static str,
        /// As given.
        value: f64,
        /// What is allowed, in words.
        expected: String,
    },
    /// Parameters that are allowed one by one, but not together.
    #[error("phantom `{phantom}`: {fault}")]
    Together {
        /// Which phantom.
        phantom: &'static str,
        /// Which parameters, and what must hold.
        fault: String,
    },
    /// The phantom's grid cannot be.
    #[error(transparent)]
    Space(#[from] SpaceError),
    /// The phantom's volume cannot be.
    #[error(transparent)]
    Volume(#[from] VolumeError),
    /// The voxels do not fit in memory.
    #[error("{dims:?} voxels of {bytes} bytes do not fit in memory")]
    Memory {
        /// Voxels along x, y, z.
        dims: [usize; 3],
        /// Bytes of one voxel.
        bytes: usize,
    },
}

fn suggestion(nearest: &Option<&'static str>) -> String {
    nearest.map(|n| format!(", did you mean `{n}`?")).unwrap_or_default()
}

/// The known name with the fewest edits from `name`, if they are at most a third of its letters (and one at least may
/// be wrong). Ties go to the first.
pub(super) fn nearest(name: &str, known: &[&'static str]) -> Option<&'static str> {
    let allowed = (name.chars().count() / 3).max(1);
    let (edits, best) = known.iter().map(|k| (edits(name, k), *k)).min_by_key(|(n, _)| *n)?;
    (edits <= allowed).then_some(best)
}

/// Levenshtein's distance, upper and lower case alike.
fn edits(a: &str, b: &str) -> usize {
    let letters = |s: &str| s.to_lowercase().chars().collect::<Vec<_>>();
    let (a, b) = (letters(a), letters(b));
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.iter().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(x != y);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(row[j + 1] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edits_by_hand() {
        assert_eq!(edits("kitten", "sitting"), 3);
        assert_eq!(edits("", "abc"), 3);
        assert_eq!(edits("Torus", "torus"), 0);
    }

    #[test]
    fn near_names_are_suggested_and_far_ones_are_not() {
        let known = ["sphere", "torus", "plane"];
        assert_eq!(nearest("spere", &known), Some("sphere"));
        assert_eq!(nearest("TORUS", &known), Some("torus"));
        assert_eq!(nearest("cube", &known), None);
        assert_eq!(nearest("", &known), None);
    }
}
