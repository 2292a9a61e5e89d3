//! The objects on one ray: their ranges of samples, and the colour and opacity of all sets at a sample ([VS-2] …
//! [VS-4], [VS-7]).

use super::part_ray::{FieldEvaluator, FoundPart, Here, PartRay, SelectionSet, evaluator};
use super::selection_ray::{SelectionRay, contains};
use crate::number::{Real, Vec3};
use crate::ray::cell_mask::CellMask;
use crate::ray::prepared::Prepared;
use crate::ray::prepared_combination::{PreparedCombination, PreparedIntersection, PreparedPart, PreparedSelection};
use crate::ray::sample::{Sample, SampleAttributes};
use crate::volumeshop::far_side::through_box;
use crate::volumeshop::{ObjectSet, Shares, combined, fuzzy, ghosting, intersections, sets};
use drypoint_scene::counts::Counts;
use drypoint_scene::shot::{Cut, IntersectionPaint};
use smallvec::{SmallVec, smallvec};

/// The share of a step by which a sample must lie before the end of a funnel to be cut.
const SLACK: f64 = 1.0 / (1u64 << 32) as f64;

/// The number of sets at a sample, intersections included, that need no heap memory.
const INLINE: usize = 16;

/// The objects on a ray.
pub(in crate::ray) struct ObjectRay<'p, 'v, R: Real> {
    pub(in crate::ray) combination: &'p PreparedCombination<'v, R>,
    pub(in crate::ray) selections: Vec<SelectionRay<R>>,
    pub(in crate::ray) parts: Vec<PartRay<'p, 'v, R>>,
    /// The background among objects. It decides on its kernel at every call, so that the code that combines sets exists
    /// once.
    pub(in crate::ray) behind: FieldEvaluator<'p, 'v, R>,
    /// The samples at which the background can show something. On a ray for seeds, these are the samples at which it
    /// can seed.
    pub(in crate::ray) background: Vec<[i64; 2]>,
    /// The samples in the background's box.
    pub(in crate::ray) inside: [i64; 2],
    /// The first sample behind each cutaway.
    pub(in crate::ray) cut_ends: Vec<i64>,
    /// Working memory: the set of each part at a sample.
    found: Vec<Option<FoundPart<R>>>,
    /// The fractions w_N of the background and the parts at the last sample; empty if no layer shows them.
    fractions: Vec<f64>,
}

/// Colour and opacity of all objects at a sample, and the set that the layers read.
pub(in crate::ray) struct Together<R> {
    pub(in crate::ray) rgb: [R; 3],
    pub(in crate::ray) alpha: R,
    pub(super) largest: Largest<R>,
}

/// The set with the largest μ. If several are equal, selections come first, then ghosts, then the background.
pub(in crate::ray) struct Largest<R> {
    /// Index of the set's part; none for the background.
    pub(super) part: Option<usize>,
    pub(super) sample: Sample<R>,
    pub(super) attributes: SampleAttributes<R>,
}

impl<'p, 'v, R: Real> ObjectRay<'p, 'v, R> {
    /// The objects on the ray through a point of the picture. Returns none if the ray meets no object. See
    /// [`aimed`](Self::aimed).
    pub(super) fn new(
        prepared: &'p Prepared<'v, R>,
        point: [f64; 2],
        samples: (impl Iterator<Item = [i64; 2]>, [i64; 2]),
        counts: &mut Counts,
    ) -> Option<Self> {
        Self::aimed(prepared, point, samples, counts).filter(Self::meets_any)
    }

    /// The objects of a picture on the ray through a point. Returns none without objects. `background` holds the samples
    /// at which the background can show something or seed; `inside` those in its box.
    pub(in crate::ray) fn aimed(
        prepared: &'p Prepared<'v, R>,
        point: [f64; 2],
        (background, inside): (impl Iterator<Item = [i64; 2]>, [i64; 2]),
        counts: &mut Counts,
    ) -> Option<Self> {
        let combination = prepared.combination.as_ref()?;
        let pixel = prepared.view.ray(point[0], point[1]);
        let selections: Vec<_> =
            combination.selections.iter().map(|s| SelectionRay::new(s, prepared, &pixel)).collect();
        let part = |part: &'p PreparedPart<'v, R>| PartRay::new(part, &selections[part.selection], prepared, &pixel);
        let parts: Vec<_> = combination.parts.iter().map(part).collect();
        let found = vec![None; parts.len()];
        let (cut_ends, fractions) = (Vec::new(), Vec::new());
        let background = background.collect();
        let behind = evaluator(&prepared.object, prepared, &pixel);
        let mut ray = Self { combination, selections, parts, behind, background, inside, cut_ends, found, fractions };
        ray.cut_ends = (0..combination.cutaways.len()).map(|i| ray.cut_end(i, prepared, point, counts)).collect();
        Some(ray)
    }

    /// Whether the ray meets an object.
    fn meets_any(&self) -> bool {
        let takes = |s: &SelectionRay<R>| s.here.range[0] <= s.here.range[1];
        self.parts.iter().any(|part| part.range[0] <= part.range[1])
            || self.selections.iter().zip(&self.combination.selections).any(|(ray, s)| s.takes && takes(ray))
            || self.background.first().is_some_and(|[first, _]| self.cut_ends.iter().any(|end| first < end))
    }

    /// All samples at which something can be seen, in order and without overlap.
    pub(super) fn visits(&self) -> Vec<[i64; 2]> {
        self.visits_of(|_| true)
    }

    /// All samples of the background and of the parts for which `counts` holds, in order and without overlap.
    pub(super) fn visits_of(&self, counts: impl Fn(&PreparedPart<'v, R>) -> bool) -> Vec<[i64; 2]> {
        let of_parts = self.parts.iter().filter(|part| counts(part.part)).map(|part| part.range);
        let of_parts = of_parts.filter(|[first, last]| first <= last);
        let mut all: Vec<[i64; 2]> = self.background.iter().copied().chain(of_parts).collect();
        all.sort_unstable();
        let mut visits: Vec<[i64; 2]> = Vec::new();
        for [first, last] in all {
            match visits.last_mut() {
                Some(before) if first <= before[1] => before[1] = before[1].max(last),
                _ => visits.push([first, last]),
            }
        }
        visits
    }

    /// Splits the samples first..=last. Returns the first run, and whether it contains more than the background.
    pub(in crate::ray) fn run_from(&self, [first, last]: [i64; 2]) -> ([i64; 2], bool) {
        let mut end = last;
        let mut is_mixed = false;
        let mut meet = |[from, to]: [i64; 2]| {
            if from <= first && first <= to {
                is_mixed = true;
                end = end.min(to);
            } else if first < from && from <= to {
                end = end.min(from - 1);
            }
        };
        self.parts.iter().for_each(|part| meet(part.range));
        let takes = self.selections.iter().zip(&self.combination.selections).filter(|(_, s)| s.takes);
        takes.for_each(|(ray, _)| meet(ray.here.range));
        self.cut_ends.iter().for_each(|&end| meet([i64::MIN, end.saturating_sub(1)]));
        ([first, end], is_mixed)
    }

    /// The samples of a run at which the background can show something.
    pub(super) fn background_in(&self, [first, last]: [i64; 2]) -> impl Iterator<Item = [i64; 2]> + use<R> {
        let parts: Vec<[i64; 2]> = self.background.iter().map(|&[a, b]| [a.max(first), b.min(last)]).collect();
        parts.into_iter().filter(|[first, last]| first <= last)
    }

    /// The fractions w_N of the background and the parts at the last sample. Empty if no layer shows them.
    pub(super) fn fractions(&self) -> &[f64] {
        &self.fractions
    }

    /// Evaluates and combines all sets at sample k. Returns none if nothing is visible.
    #[inline(never)]
    pub(in crate::ray) fn together(
        &mut self,
        k: i64,
        prepared: &Prepared<'_, R>,
        counts: &mut Counts,
    ) -> Option<Together<R>> {
        let combination = self.combination;
        let fuzzy = combination.fuzzy;
        // The value of the background's volume, which its pieces share. It is evaluated at most once.
        let mut here = self.here(k);
        let shares = self.shares(&mut here, counts);

        // Eqs. 2 and 3: the background, faded in front of an object.
        let mut of_background = None;
        if self.has_background(k, &shares) {
            let can_show = |cells: &CellMask, at: Sample<R>| cells.can_show(&prepared.object.field, at.at.cell);
            let sample = here.sample(&self.behind, counts);
            let sample = sample.filter(|at| prepared.cells.as_ref().is_none_or(|cells| can_show(cells, *at)));
            if let Some(sample) = sample
                && let Some(((rgb, alpha), attributes)) = self.behind.shaded_by_any(sample, counts)
            {
                let faded = self.faded(k, attributes);
                let weight = shares.background;
                let mu = fuzzy::intersection(fuzzy, weight, alpha * faded);
                let attributes = self.behind.cut_at(k).map_or(attributes, |cut| cut.attributes(attributes));
                of_background = Some(FoundPart { sample, attributes, rgb, weight, mu, faded });
            }
        }

        // Eqs. 2 and 3: ghosts and selections.
        for (part, found) in self.parts.iter_mut().zip(&mut self.found) {
            *found = None;
            if !contains(part.range, k) {
                continue;
            }
            let set = selection_set(part.part, combination, &self.selections, &shares);
            *found = part.found(k, set, &mut here, &self.behind, fuzzy, counts);
        }
        let largest = self.largest(of_background.as_ref())?;

        // Eqs. 6 and 7: intersections, removed from the two sets that meet.
        let mut sets: SmallVec<[ObjectSet<R>; INLINE]> = SmallVec::new();
        let mut met: SmallVec<[[(usize, R); 2]; INLINE]> = SmallVec::new();
        let set = |found: &FoundPart<R>, shares| ObjectSet { rgb: found.rgb, mu: found.mu, shares };
        sets.push(of_background.as_ref().map_or(ObjectSet::NONE, |found| set(found, true)));
        for (part, found) in self.parts.iter().zip(&self.found) {
            let shares = combination.selections[part.part.selection].takes && !part.part.is_moved;
            sets.push(found.as_ref().map_or(ObjectSet::NONE, |found| set(found, shares)));
        }
        if !combination.intersections.is_empty() {
            let mut taken: SmallVec<[R; INLINE]> = smallvec![R::ZERO; self.parts.len()];
            for intersection in &combination.intersections {
                let meeting = self.meeting(intersection, of_background.as_ref(), counts);
                let Some((meeting, opacities)) = meeting.filter(|(set, _)| set.mu > R::ZERO) else { continue };
                let of_selection = &mut taken[intersection.params.selection];
                *of_selection = fuzzy::union(fuzzy, *of_selection, meeting.mu);
                let other = intersection.params.ghost.map_or(0, |ghost| 1 + ghost);
                sets[other].without(fuzzy, meeting.mu);
                sets.push(meeting);
                met.push([(1 + intersection.params.selection, opacities[0]), (other, opacities[1])]);
            }
            for (set, taken) in sets[1..].iter_mut().zip(taken).filter(|(_, taken)| *taken > R::ZERO) {
                set.without(fuzzy, taken);
            }
        }
        let (rgb, alpha) = combined(fuzzy, sets.iter().copied());
        if prepared.covering > 0 {
            sets::fractions(&sets, &met, &mut self.fractions);
        }
        Some(Together { rgb, alpha, largest })
    }

    /// The sample k of the background's volume, not evaluated yet.
    pub(super) fn here(&self, k: i64) -> Here<R> {
        Here { k, is_inside: contains(self.inside, k), sample: None }
    }

    /// Eq. 1 at a sample: the selections that are taken from the background, and the remaining background.
    pub(super) fn shares(&self, here: &mut Here<R>, counts: &mut Counts) -> Shares<R> {
        let (combination, k) = (self.combination, here.k);
        let takes = |(ray, s): &(&SelectionRay<R>, &PreparedSelection<'_, R>)| s.takes && contains(ray.here.range, k);
        if !self.selections.iter().zip(&combination.selections).any(|pair| takes(&pair)) {
            return Shares::whole();
        }
        let taken = self.selections.iter().zip(&combination.selections).filter(takes);
        let cut_depth = self.behind.cut_depth(k);
        let mut value = || Some(here.sample(&self.behind, counts)?.s);
        let memberships = taken.map(|(ray, selection)| ray.here.membership(selection, (k, cut_depth), &mut value));
        Shares::beside(combination.fuzzy, memberships)
    }

    /// Whether the background is present at sample k and not removed by a cutaway.
    pub(super) fn has_background(&self, k: i64, shares: &Shares<R>) -> bool {
        let is_gone = || self.cutaways_at(k).any(|gamma| gamma >= R::ONE);
        shares.background > R::ZERO && self.background.iter().any(|&range| contains(range, k)) && !is_gone()
    }

    /// Whether a cutaway fades the background at sample k.
    pub(super) fn is_cut(&self, k: i64) -> bool {
        self.cutaways_at(k).next().is_some()
    }

    /// The factor by which ghosting fades the background at sample k. `attributes` are those of the field.
    pub(super) fn faded(&self, k: i64, attributes: SampleAttributes<R>) -> R {
        if !self.is_cut(k) {
            return R::ONE;
        }
        let background = &self.behind;
        let seen = background.cut_at(k).map_or(attributes, |cut| cut.attributes(attributes));
        let e = background.object.shader.enhancement(&seen, &background.dirs);
        self.cutaways_at(k).fold(R::ONE, |factor, gamma| factor * ghosting::factor(gamma, e))
    }

    /// Size in bytes.
    pub(super) fn bytes(&self) -> u64 {
        let of_ranges = size_of_val(self.background.as_slice()) + size_of_val(self.cut_ends.as_slice());
        Self::most_bytes(self.combination) + (of_ranges + size_of_val(self.fractions.as_slice())) as u64
    }

    /// Bytes of the objects on one ray, without the ranges of the background.
    pub(super) fn most_bytes(combination: &PreparedCombination<'_, R>) -> u64 {
        let of_part = size_of::<PartRay<'_, '_, R>>() + size_of::<Option<FoundPart<R>>>();
        let of_selections = combination.selections.len() * size_of::<SelectionRay<R>>();
        (size_of::<Self>() + combination.parts.len() * of_part + of_selections) as u64
    }

    /// γ of the cutaways that cover sample k.
    fn cutaways_at(&self, k: i64) -> impl Iterator<Item = R> {
        let cut = self.combination.cutaways.iter().zip(&self.cut_ends).filter(move |(_, end)| k < **end);
        cut.map(|(cutaway, _)| R::from_f64(cutaway.params.ghosting))
    }

    /// The set with the largest μ.
    fn largest(&self, background: Option<&FoundPart<R>>) -> Option<Largest<R>> {
        let of_parts = self.found.iter().zip(&self.parts).enumerate();
        let of_parts = of_parts.filter_map(|(i, (found, part))| Some((Some(i), found.as_ref()?, part)));
        let is_ghost = |part: &PartRay<'_, '_, R>| {
            !part.part.is_moved && self.combination.selections[part.part.selection].there.is_some()
        };
        let in_order =
            of_parts.clone().filter(|(.., part)| !is_ghost(part)).chain(of_parts.filter(|(.., part)| is_ghost(part)));
        let all = in_order.map(|(i, found, _)| (i, found)).chain(background.map(|found| (None, found)));
        let largest = all.reduce(|most, next| if next.1.mu > most.1.mu { next } else { most });
        largest.map(|(part, found)| Largest { part, sample: found.sample, attributes: found.attributes })
    }

    /// The alternative set of an intersection (eq. 7), and the unshaded opacities of the selection and the other set.
    /// Returns none if they do not meet.
    fn meeting(
        &mut self,
        intersection: &PreparedIntersection<'_>,
        of_background: Option<&FoundPart<R>>,
        counts: &mut Counts,
    ) -> Option<(ObjectSet<R>, [R; 2])> {
        let (params, fuzzy) = (&intersection.params, self.combination.fuzzy);
        let selection = self.found[params.selection]?;
        let other = params.ghost.map_or(of_background.copied(), |ghost| self.found[ghost])?;
        if fuzzy::intersection(fuzzy, other.mu, selection.mu) <= R::ZERO {
            return None;
        }
        // Unshaded colours and opacities, both with the attributes of the set with the larger μ. If both are equal, the
        // selection wins.
        let wins = selection.mu >= other.mu;
        let attributes = match (wins, params.ghost) {
            (true, _) => self.parts[params.selection].evaluator.shading(&selection, counts),
            (false, Some(ghost)) => self.parts[ghost].evaluator.shading(&other, counts),
            (false, None) => self.behind.shading(&other, counts),
        };
        let of_selection =
            self.parts[params.selection].evaluator.unlit(selection.sample, [selection.attributes, attributes], counts);
        let asked = [other.attributes, attributes];
        let (c_2, alpha_2) = match params.ghost {
            Some(ghost) => self.parts[ghost].evaluator.unlit(other.sample, asked, counts),
            None => self.behind.unlit(other.sample, asked, counts),
        };
        let of_other = (c_2, alpha_2 * other.faded);
        // The opacity and the colour of the intersection.
        let (a, b) = (of_selection.1, of_other.1);
        let [a, b] = if params.swap { [b, a] } else { [a, b] };
        let preset = intersections::opacity(params.opacity, a, b);
        let values = [other.sample.s, selection.sample.s];
        let unpainted = match (&params.color, intersection.picture) {
            (IntersectionPaint::Mean, _) => {
                (intersections::mean(of_selection, of_other).unwrap_or([R::ZERO; 3]), preset)
            }
            (IntersectionPaint::Color(rgb, opacity), _) => (rgb.map(R::from_f64), preset * R::from_f64(*opacity)),
            (IntersectionPaint::Picture(ranges), picture) => {
                let share = |i: usize| {
                    let [low, high] = ranges[i];
                    (values[i] - R::from_f64(low)) / R::from_f64(high - low)
                };
                let [r, g, b, opacity] = intersections::pictured(picture?, [share(0), share(1)]);
                ([r, g, b], if picture?.has_opacity { opacity } else { preset })
            }
        };
        let paint = |under, dab| intersections::painted(under, dab, values);
        let (rgb, alpha) = params.dabs.iter().fold(unpainted, paint);
        // Light is applied once, by the winner's material.
        let (rgb, alpha) = match (wins, params.ghost) {
            (true, _) => self.parts[params.selection].light((rgb, alpha), &attributes),
            (false, Some(ghost)) => self.parts[ghost].light((rgb, alpha), &attributes),
            (false, None) => self.behind.object.shader.light((rgb, alpha), &attributes, &self.behind.dirs),
        };
        let both = fuzzy::intersection(fuzzy, other.weight, selection.weight);
        let set = ObjectSet { rgb, mu: fuzzy::intersection(fuzzy, both, alpha), shares: false };
        Some((set, [of_selection.1, of_other.1]))
    }

    /// The first sample behind a cutaway: all samples before it lie before d ([VS-7]).
    fn cut_end(&mut self, cutaway: usize, prepared: &Prepared<'v, R>, point: [f64; 2], counts: &mut Counts) -> i64 {
        let cutaway = &self.combination.cutaways[cutaway];
        let lattice = self.behind.ray;
        let d = self.depth(cutaway.params.part, cutaway.params.cut, counts);
        let d = match &cutaway.funnel {
            None => d,
            Some(funnel) => match through_box(lattice.line(), prepared.object.grid.index_box()) {
                // The slack keeps rounding from deciding about a sample at d̃ itself.
                Some([z_in, _]) => {
                    let end = funnel.depth(point, z_in.max(prepared.near_of(&lattice)), d);
                    end - SLACK * lattice.depth_step.to_f64()
                }
                None => d,
            },
        };
        if d == f64::NEG_INFINITY { i64::MIN } else { lattice.last_before(d) + 1 }
    }

    /// The depth d of a part.
    fn depth(&mut self, part: usize, cut: Cut, counts: &mut Counts) -> f64 {
        let part = &mut self.parts[part];
        let selection = part.part.selection;
        part.depth(&self.combination.selections[selection], &self.selections[selection], cut, counts)
    }

    /// The depth and the attributes of a part for the layers. For the first visible sample of a ray they include those
    /// of the layers `first.*`.
    pub(super) fn for_layers(
        &mut self,
        largest: &Largest<R>,
        is_first: bool,
        main_exponent: i32,
        counts: &mut Counts,
    ) -> Option<(f64, SampleAttributes<R>)> {
        let part = &mut self.parts[largest.part?];
        let mut attributes = largest.attributes;
        if let (Some(first), true) = (part.part.object.first, is_first) {
            attributes = part.evaluator.evaluate(largest.sample, first, attributes, counts);
        }
        // The gradient of the moved field, scaled by the power of two of the background's field.
        let object = &part.part.object;
        let gradient = object.moved.as_ref().map_or(attributes.gradient, |moved| moved.apply(attributes.gradient));
        let by = object.field.scale_exponent() - main_exponent;
        let scaled = |x: R| R::monotone([x], |[x]| drypoint_scene::math::scale_by_power_of_two(x, by));
        attributes.gradient =
            if by == 0 { gradient } else { Vec3::new(scaled(gradient.x), scaled(gradient.y), scaled(gradient.z)) };
        let cut = part.evaluator.cut_at(largest.sample.k);
        let attributes = cut.map_or(attributes, |cut| cut.attributes(attributes));
        Some((part.evaluator.depth(largest.sample.k).to_f64(), attributes))
    }
}

/// The selection set of a part on a ray.
pub(super) fn selection_set<'a, 'v, R: Real>(
    part: &PreparedPart<'v, R>,
    combination: &'a PreparedCombination<'v, R>,
    selections: &'a [SelectionRay<R>],
    shares: &Shares<R>,
) -> SelectionSet<'a, 'v, R> {
    let (selection, ray) = (&combination.selections[part.selection], &selections[part.selection]);
    SelectionSet {
        selection,
        placed: if part.is_moved { &ray.there } else { &ray.here },
        share: if selection.takes && !part.is_moved { shares.of_each } else { R::ONE },
    }
}
