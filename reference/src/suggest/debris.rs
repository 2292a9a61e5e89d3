//! Parts that a first picture leaves out: head rests, burnt-in letters, specks of noise.

use super::content::ContentRange;
use drypoint_scene::tables::{Keep, Outside, PartsTable};
use drypoint_scene::volume::Volume;
use drypoint_scene::volume::parts::{Part, Parts};

/// Share of the largest part's voxels below which a part is debris. A head rest has a sixtieth of a head's voxels; the
/// smallest body of a molecule has a fifteenth of the largest one's.
const DEBRIS: f64 = 0.02;

/// Largest share of all voxels that debris has together. Vessels and flames fall into more pieces than that: these are
/// content.
const TOGETHER: f64 = 0.03;

/// Least share of the debris in its largest part. Many pieces of one kind are content, such as the legs of a lobster and
/// the leaves of a tree. A head rest is one piece with specks around it.
const ONE: f64 = 0.4;

/// Returns the parts to keep, by the value at which they are first seen. None if no part is debris, if debris may be
/// content, or if there is no memory to find parts.
pub(super) fn without_debris(volume: &Volume, seen: ContentRange) -> Option<PartsTable> {
    let parts = match seen.outside {
        Outside::Low => Parts::find(volume, &|value| value >= seen.value),
        Outside::High => Parts::find(volume, &|value| value <= seen.value),
    };
    has_debris(parts.ok()?.all()).then_some(PartsTable { keep: Keep::Share(DEBRIS), at_least: Some(seen.value) })
}

/// Whether some parts are debris that can be left out. Parts are in the order of their sizes.
fn has_debris(parts: &[Part]) -> bool {
    let least = DEBRIS * parts.first().map_or(0.0, |part| part.size as f64);
    let debris = &parts[parts.partition_point(|part| part.size as f64 >= least)..];
    let sum = |parts: &[Part]| parts.iter().map(|part| part.size as f64).sum::<f64>();
    let (all, largest) = (sum(debris), debris.first().map_or(0.0, |part| part.size as f64));
    !debris.is_empty() && all <= TOGETHER * sum(parts) && largest >= ONE * all
}

#[cfg(test)]
mod tests {
    use super::super::tests::{radius, volume};
    use super::*;

    fn seen(value: f64, outside: Outside) -> ContentRange {
        ContentRange { value, outside }
    }

    #[test]
    fn a_ball_is_kept_without_its_slab() {
        // A ball of radius 10 and a slab of 60 voxels, a seventieth of the ball's.
        let slab = |[x, y, z]: [usize; 3]| (10..30).contains(&x) && y == 30 && (3..6).contains(&z);
        let head = |p| if radius(p) < 10.0 || slab(p) { 90.0 } else { 10.0 };
        let kept = Some(PartsTable { keep: Keep::Share(DEBRIS), at_least: Some(50.0) });
        assert_eq!(without_debris(&volume(head), seen(50.0, Outside::Low)), kept);
        assert_eq!(without_debris(&volume(|p| 100.0 - head(p)), seen(50.0, Outside::High)), kept);
        assert_eq!(without_debris(&volume(|_| 10.0), seen(50.0, Outside::Low)), None);
    }

    #[test]
    fn scattered_content_stays() {
        let sizes =
            |sizes: &[usize]| has_debris(&sizes.iter().map(|&size| Part { size, first: 0 }).collect::<Vec<_>>());
        // One body, or bodies of one kind.
        assert!(!sizes(&[]) && !sizes(&[1000]) && !sizes(&[1000, 900, 25, 20]));
        // A head with its rest and specks.
        assert!(sizes(&[100_000, 1600, 180, 40, 5, 5, 1]));
        // Vessels: 70 pieces of a thousandth. Legs: ten of them.
        assert!(!sizes(&[&[50_000][..], &[50; 70]].concat()));
        assert!(!sizes(&[&[50_000][..], &[50; 10]].concat()));
    }
}
