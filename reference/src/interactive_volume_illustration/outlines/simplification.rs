//! Simplification of curves to fewer vertices within a distance.

use drypoint_scene::glam::DVec3;

/// Flags of the places to keep (Ramer 1972, Douglas and Peucker 1973). No removed place is farther than `within` from
/// the segment that replaces it. The ends stay; a closed curve keeps the first place and the place farthest from it.
pub(super) fn kept(places: &[DVec3], closed: bool, within: f64) -> Vec<bool> {
    let n = places.len();
    let mut is_kept = vec![false; n];
    if n == 0 {
        return is_kept;
    }
    let at = |i: usize| places[i % n];
    let end = if closed { n } else { n - 1 };
    let mut parts = vec![[0, end]];
    if closed {
        let far = (0..n).map(|i| (places[i].distance_squared(places[0]), i));
        let far = far.fold((-1.0, 0), |most, next| if next.0 > most.0 { next } else { most }).1;
        parts = vec![[0, far], [far, n]];
    }
    while let Some([a, b]) = parts.pop() {
        (is_kept[a], is_kept[b % n]) = (true, true);
        let mut most = (within, None);
        for i in a + 1..b {
            let d = from_segment(at(i), [at(a), at(b)]);
            if d > most.0 {
                most = (d, Some(i));
            }
        }
        if let (_, Some(i)) = most {
            parts.extend([[a, i], [i, b]]);
        }
    }
    is_kept
}

/// Distance of a place from a segment.
fn from_segment(p: DVec3, [a, b]: [DVec3; 2]) -> f64 {
    let (along, from) = (b - a, p - a);
    let length = along.length_squared();
    let t = if length > 0.0 { (from.dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
    (from - along * t).length()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn corners_stay() {
        let places: Vec<DVec3> =
            [(0, 0), (1, 0), (2, 0), (2, 1), (2, 2)].map(|(x, y)| DVec3::new(f64::from(x), f64::from(y), 0.0)).into();
        assert_eq!(kept(&places, false, 0.01), [true, false, true, false, true]);
        assert_eq!(kept(&places, true, 0.01), [true, false, true, false, true]);
        assert_eq!(kept(&places, false, 2.0), [true, false, false, false, true]);
        assert_eq!(kept(&[], true, 1.0), [false; 0]);
    }

    /// A chord of length L on a circle of radius R is R − √(R² − L²/4) from it.
    #[test]
    fn a_circle_stays_round() {
        let (r, n, within) = (20.0, 4000, 0.005);
        let at = |i: usize| TAU * i as f64 / n as f64;
        let places: Vec<DVec3> = (0..n).map(|i| DVec3::new(r * at(i).cos(), r * at(i).sin(), 0.0)).collect();
        let left: Vec<DVec3> =
            kept(&places, true, within).iter().zip(&places).filter(|(kept, _)| **kept).map(|(_, p)| *p).collect();
        for i in 0..left.len() {
            let chord = left[i].distance(left[(i + 1) % left.len()]);
            assert!(r - (r * r - chord * chord / 4.0).sqrt() <= within * 1.01, "{chord}");
        }
        // Halving leaves at most twice as many places as the longest chords do: 2√(2rc) = 0.89.
        assert!((140..=290).contains(&left.len()), "{}", left.len());
    }
}
