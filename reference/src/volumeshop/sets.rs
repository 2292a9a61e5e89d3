//! Object sets at a place, and their colour and opacity (eqs. 3 to 5, 7; [VS-3], [VS-4]).

use super::fuzzy;
use crate::number::Real;
use drypoint_scene::shot::Fuzzy;

/// An object set: its colour, and its grade of membership.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObjectSet<R> {
    /// Straight, linear colour.
    pub rgb: [R; 3],
    /// μ.
    pub mu: R,
    /// Whether the set shares a place with others of its kind, as the background and the ghosts do. With product
    /// operators the memberships of such sets are added.
    pub shares: bool,
}

impl<R: Real> ObjectSet<R> {
    /// A set without members.
    pub const NONE: Self = Self { rgb: [R::ZERO; 3], mu: R::ZERO, shares: false };

    /// Removes another set from this one: μ_{A − B}.
    pub fn without(&mut self, fuzzy: Fuzzy, other: R) {
        self.mu = fuzzy::difference(fuzzy, self.mu, other);
    }
}

/// Colour and opacity at a place (eqs. 4 and 5): Σcμ/Σμ, and the membership in the union of all sets. Sets come in
/// their order, intersections last. The result is transparent if Σμ = 0.
pub fn combined<R: Real>(fuzzy: Fuzzy, sets: impl Iterator<Item = ObjectSet<R>> + Clone) -> ([R; 3], R) {
    let members = sets.filter(|set| set.mu > R::ZERO);
    let (mut sum, mut weight) = ([R::ZERO; 3], R::ZERO);
    for set in members.clone() {
        for (sum, c) in sum.iter_mut().zip(set.rgb) {
            *sum += c * set.mu;
        }
        weight += set.mu;
    }
    if weight <= R::ZERO {
        return ([R::ZERO; 3], R::ZERO);
    }
    let shared = || members.clone().filter(|set| set.shares).map(|set| set.mu);
    let first = match fuzzy {
        Fuzzy::Zadeh => shared().fold(R::ZERO, |a, b| fuzzy::union(fuzzy, a, b)),
        Fuzzy::Product => shared().fold(R::ZERO, |sum, mu| sum + mu).min(R::ONE),
    };
    let opacity = members.clone().filter(|set| !set.shares).fold(first, |a, set| fuzzy::union(fuzzy, a, set.mu));
    // A mean lies between its least and its largest number.
    let color = |i: usize| {
        let ends = members.clone().map(|set| [set.rgb[i]; 2]).reduce(|[a, b], [c, _]| [a.min(c), b.max(c)]);
        let mean = sum[i] / weight;
        ends.map_or(mean, |[least, most]| mean.known_between(least, most))
    };
    (std::array::from_fn(color), opacity)
}

/// The fraction w_N of each object in the combined sets. Their sum is 1. `sets` are those of the objects, then the
/// intersections. `met` holds the index and the unshaded opacity of the two objects of each intersection.
///
/// By eq. 4 the colour is Σcμ/Σμ, so a set has the fraction μ/Σμ of the colour, and so of the opacity. An intersection
/// belongs to both of its objects. The mean of their colours is (α₁c₁ + α₂c₂)/(α₁ + α₂), so the first object has the
/// share α₁/(α₁ + α₂). This also holds for intersections of other colours. Two transparent objects have half each. The
/// sum is w_N = (μ_N + Σμ_{N∩M}·α_N/(α_N + α_M))/Σμ.
///
/// Opacity is not attributed by the order of the sets in a union, in which no set comes first.
pub fn fractions<R: Real>(sets: &[ObjectSet<R>], met: &[[(usize, R); 2]], fractions: &mut Vec<f64>) {
    let (of_objects, intersections) = sets.split_at(sets.len() - met.len());
    fractions.clear();
    fractions.extend(of_objects.iter().map(|set| set.mu.to_f64()));
    for (set, [(first, alpha_1), (second, alpha_2)]) in intersections.iter().zip(met) {
        let sum = *alpha_1 + *alpha_2;
        let of_first = if sum > R::ZERO { set.mu * (*alpha_1 / sum) } else { set.mu * R::from_f64(0.5) };
        fractions[*first] += of_first.to_f64();
        fractions[*second] += (set.mu - of_first).to_f64();
    }
    let sum: f64 = fractions.iter().sum();
    if sum > 0.0 {
        fractions.iter_mut().for_each(|fraction| *fraction /= sum);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn set(r: f64, mu: f64, shares: bool) -> ObjectSet<f64> {
        ObjectSet { rgb: [r, 0.0, 1.0], mu, shares }
    }

    #[test]
    fn by_hand() {
        let sets = [set(1.0, 0.5, true), set(0.0, 0.25, true), set(0.5, 0.25, false)];
        // Colour (½·1 + ¼·0 + ¼·½)/1 = 0.625.
        let zadeh = combined(Fuzzy::Zadeh, sets.into_iter());
        assert_eq!(zadeh, ([0.625, 0.0, 1.0], 0.5));
        // ½ + ¼ = ¾ together, then ¾ + ¼ − 3/16.
        assert_eq!(combined(Fuzzy::Product, sets.into_iter()), ([0.625, 0.0, 1.0], 0.8125));
        assert_eq!(combined(Fuzzy::Zadeh, [set(1.0, 0.0, true)].into_iter()), ([0.0; 3], 0.0));
    }

    /// Opacities 0.2 and 0.6 of two objects are a quarter and three quarters of what is seen.
    #[test]
    fn fractions_by_hand() {
        let (a, b, mut out) = (set(1.0, 0.2, true), set(0.0, 0.6, false), Vec::new());
        let near = |found: &[f64], expected: &[f64]| {
            let off = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(found.len() == expected.len() && off < 1e-15, "{found:?}, not {expected:?}");
        };
        fractions(&[a, b], &[], &mut out);
        near(&out, &[0.25, 0.75]);
        // An intersection of μ 0.2, whose objects have opacities 0.6 and 0.2 there: 0.15 and 0.05 of a sum of 1.
        let meeting = set(0.5, 0.2, false);
        fractions(&[a, b, meeting], &[[(1, 0.6), (0, 0.2)]], &mut out);
        near(&out, &[0.25, 0.75]);
        fractions(&[a, b, meeting], &[[(1, 0.0), (0, 0.2)]], &mut out);
        near(&out, &[0.4, 0.6]);
        // A colour of its own where both are transparent.
        fractions(&[ObjectSet::NONE, ObjectSet::NONE, meeting], &[[(1, 0.0), (0, 0.0)]], &mut out);
        near(&out, &[0.5, 0.5]);
        fractions(&[ObjectSet::<f64>::NONE; 2], &[], &mut out);
        near(&out, &[0.0, 0.0]);
    }

    #[test]
    fn an_intersection_is_taken_out_of_both() {
        let mut a = set(0.0, 0.75, false);
        a.without(Fuzzy::Zadeh, 0.5);
        assert_eq!(a.mu, 0.5);
        a.without(Fuzzy::Product, 0.5);
        assert_eq!(a.mu, 0.25);
    }

    proptest! {
        /// α ≤ the largest membership with Zadeh, never below it, and with both in [0, 1]; the colour lies between those of the
        /// sets; the order of sets shows in rounding alone.
        #[test]
        fn bounds(mus in prop::array::uniform4((0.0..=1.0f64, 0.0..=1.0f64, any::<bool>()))) {
            let sets = mus.map(|(r, mu, shares)| set(r, mu, shares));
            let largest = sets.iter().fold(0.0, |most: f64, set| most.max(set.mu));
            for fuzzy in [Fuzzy::Zadeh, Fuzzy::Product] {
                let (rgb, alpha) = combined(fuzzy, sets.into_iter());
                prop_assert!(alpha >= largest - 1e-15 && alpha <= 1.0);
                let back = combined(fuzzy, sets.into_iter().rev());
                prop_assert!((back.1 - alpha).abs() < 1e-15 && (back.0[0] - rgb[0]).abs() < 1e-14);
                if largest > 0.0 {
                    let of_members = || sets.iter().filter(|set| set.mu > 0.0).map(|set| set.rgb[0]);
                    let [lo, hi] = of_members().fold([1.0f64, 0.0], |[lo, hi], r| [lo.min(r), hi.max(r)]);
                    prop_assert!(rgb[0] >= lo - 1e-15 && rgb[0] <= hi + 1e-15);
                }
            }
            prop_assert_eq!(combined(Fuzzy::Zadeh, sets.into_iter()).1, largest);
        }

        /// μ_{B∩G} ≤ min(f_S, 1 − f_S) ≤ ½ ([VS-3]).
        #[test]
        fn background_and_ghost_hardly_meet(f in 0.0..=1.0f64, [a, b] in prop::array::uniform2(0.0..=1.0f64)) {
            let ghost = fuzzy::intersection(Fuzzy::Zadeh, f, a);
            let background = fuzzy::intersection(Fuzzy::Zadeh, 1.0 - f, b);
            prop_assert!(fuzzy::intersection(Fuzzy::Zadeh, ghost, background) <= f.min(1.0 - f));
        }
    }
}
