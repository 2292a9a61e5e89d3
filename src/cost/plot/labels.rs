//! Places of labels beside points, so that no label covers another label or a point.

/// Size of the labels' font and of a label's line, and the width of a character at most, in the plot's units.
pub(super) const SIZE: u32 = 11;
const HEIGHT: f64 = 13.0;
const CHARACTER: f64 = 7.2;

/// Space around a point that no label covers.
const POINT: f64 = 6.0;

/// Least distance of a label's border from its point, and the distances between the places that are tried.
const NEAREST: f64 = 7.0;
const STEPS: [f64; 2] = [6.0, (NEAREST + HEIGHT / 2.0) / 3.0];

/// A rectangle: left, top, right and bottom; down is positive.
pub(super) type Area = [f64; 4];

/// Returns the area of each label. Labels stay inside, cover no point and no other label, and lie as near to their
/// points as the earlier ones let them. Where there is no such place, the one that covers least is taken.
pub(super) fn places(labels: &[(String, [f64; 2])], points: &[[f64; 2]], inside: Area) -> Vec<Area> {
    let mut taken: Vec<Area> = points.iter().map(|&point| around(point, [2.0 * POINT; 2])).collect();
    let of_points = taken.len();
    for (text, point) in labels {
        let size = [CHARACTER * text.chars().count() as f64, HEIGHT];
        let mut best = (f64::INFINITY, around(*point, size));
        for area in candidates(*point, size, inside) {
            let covered: f64 = taken.iter().map(|other| common(area, *other)).sum();
            if covered < best.0 {
                best = (covered, area);
            }
            if covered == 0.0 {
                break;
            }
        }
        taken.push(best.1);
    }
    taken.split_off(of_points)
}

/// Areas of a size inside another, nearest to a point first: above it, beside that, then to its sides and below.
fn candidates(point: [f64; 2], size: [f64; 2], inside: Area) -> impl Iterator<Item = Area> {
    let count = [0, 1].map(|i| ((inside[i + 2] - inside[i]) / STEPS[i]) as i32);
    let mut found = Vec::new();
    for i in -count[0]..=count[0] {
        for j in -count[1]..=count[1] {
            let offset = [f64::from(i) * STEPS[0], f64::from(j) * STEPS[1]];
            let area = around([point[0] + offset[0], point[1] + offset[1]], size);
            let away = [0, 1].map(|i| (offset[i].abs() - size[i] / 2.0).max(0.0));
            let distance = away[0].hypot(away[1]);
            let is_inside = (0..2).all(|i| area[i] >= inside[i] && area[i + 2] <= inside[i + 2]);
            if is_inside && distance > NEAREST - 1e-9 {
                // Of equal distances the more central, and above before below.
                found.push((distance + 0.05 * offset[0].abs() + if offset[1] > 0.0 { 1.0 } else { 0.0 }, area));
            }
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found.into_iter().map(|(_, area)| area)
}

fn around([x, y]: [f64; 2], [width, height]: [f64; 2]) -> Area {
    [x - width / 2.0, y - height / 2.0, x + width / 2.0, y + height / 2.0]
}

/// Returns what two areas have in common.
fn common(a: Area, b: Area) -> f64 {
    (a[2].min(b[2]) - a[0].max(b[0])).max(0.0) * (a[3].min(b[3]) - a[1].max(b[1])).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const INSIDE: Area = [0.0, 0.0, 320.0, 240.0];

    #[test]
    fn a_single_label_stands_above_its_point() {
        let [place] = places(&[("f32".into(), [100.0, 100.0])], &[[100.0, 100.0]], INSIDE)[..] else { panic!() };
        assert_eq!((place[0] + place[2]) / 2.0, 100.0);
        assert!(place[3] < 100.0 - POINT, "{place:?}");
    }

    proptest! {
        /// Up to eight points that all but coincide, as those of a kernel or a scale do, anywhere in a panel.
        #[test]
        fn no_label_covers_another_or_a_point(
            centre in (0.0..320.0, 0.0..240.0),
            offsets in prop::collection::vec((-4.0..4.0, -4.0..4.0), 1..=8),
        ) {
            let points: Vec<[f64; 2]> = offsets.iter().map(|(x, y)| [centre.0 + x, centre.1 + y]).collect();
            let labels: Vec<_> = points.iter().map(|&point| ("bspline-smooth".to_owned(), point)).collect();
            let found = places(&labels, &points, INSIDE);
            for (i, a) in found.iter().enumerate() {
                prop_assert!(a[0] >= 0.0 && a[1] >= 0.0 && a[2] <= 320.0 && a[3] <= 240.0, "{:?}", a);
                prop_assert!(found[..i].iter().all(|b| common(*a, *b) == 0.0), "{:?}", found);
                let on_point = |point: &[f64; 2]| common(*a, around(*point, [2.0 * POINT; 2])) > 0.0;
                prop_assert!(!points.iter().any(on_point), "{:?}", found);
            }
        }
    }
}
