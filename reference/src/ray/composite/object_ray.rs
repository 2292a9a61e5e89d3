//! The objects on one ray: where it meets them, and what the sets at a sample make of its colour and opacity ([VS-2] …
//! [VS-4], [VS-7]).

use crate::field::{Field, Sampler};
use crate::number::{Real, Vec3};
use crate::ray::cell_mask::CellMask;
use crate::ray::lattice::IndexRay;
use crate::ray::prepared::Prepared;
use crate::ray::prepared_combination::{
    PreparedCombination, PreparedIntersection, PreparedMembership, PreparedPart, PreparedSelection,
};
use crate::ray::sample::{Evaluator, PreparedObject, Sample, SampleAttributes};
use crate::volumeshop::far_side::through_box;
use crate::volumeshop::{ObjectSet, Shares, combined, fuzzy, ghosting, intersections};
use drypoint_scene::counts::Counts;
use drypoint_scene::shot::{Cut, Fuzzy, IntersectionPaint};
use drypoint_scene::space::Grid;
use drypoint_scene::view::Ray;

/// An evaluator of a field of any kernel.
type FieldEvaluator<'p, 'v, R> = Evaluator<'p, 'v, R, Field<'v, R>>;

/// No samples.
const EMPTY: [i64; 2] = [1, 0];

/// The objects on a ray.
pub(super) struct ObjectRay<'p, 'v, R: Real> {
    combination: &'p PreparedCombination<'v, R>,
    selections: Vec<SelectionRay>,
    parts: Vec<PartRay<'p, 'v, R>>,
    /// The background among objects. It decides on its kernel at every call: of code that combines there is one.
    behind: FieldEvaluator<'p, 'v, R>,
    /// The samples at which the background can show something.
    background: Vec<[i64; 2]>,
    /// The samples in the background's box.
    inside: [i64; 2],
    /// Of each cutaway, the first sample that is not cut.
    cut_ends: Vec<i64>,
    /// Working memory: what was found of each part at a sample.
    found: Vec<Option<FoundPart<R>>>,
}

/// A selection on a ray, at its original place and where it is moved.
struct SelectionRay {
    here: PlacedSelection,
    there: PlacedSelection,
}

/// A selection's grid on a ray.
struct PlacedSelection {
    /// The ray in the index space of the memberships.
    ray: Option<IndexRay<f64>>,
    /// The samples in the box of [VS-2].
    range: [i64; 2],
}

/// A part on a ray.
struct PartRay<'p, 'v, R: Real> {
    part: &'p PreparedPart<'v, R>,
    evaluator: FieldEvaluator<'p, 'v, R>,
    /// The samples at which it can show something.
    range: [i64; 2],
}

/// What was found of a part at a sample.
#[derive(Clone, Copy)]
struct FoundPart<R> {
    sample: Sample<R>,
    attributes: SampleAttributes<R>,
    rgb: [R; 3],
    /// The membership of its selection set.
    weight: R,
    /// μ of eq. 3.
    mu: R,
    /// The factor by which ghosting faded its opacity.
    faded: R,
}

/// Colour and opacity of all objects at a sample, and the set that the layers read.
pub(super) struct Together<R> {
    pub(super) rgb: [R; 3],
    pub(super) alpha: R,
    pub(super) largest: Largest<R>,
}

/// The set with the largest μ; of equal ones a selection, a ghost, the background.
pub(super) struct Largest<R> {
    /// The place of its part; none: the background.
    pub(super) part: Option<usize>,
    pub(super) sample: Sample<R>,
    pub(super) attributes: SampleAttributes<R>,
}

impl<'p, 'v, R: Real> ObjectRay<'p, 'v, R> {
    /// The objects on the ray through a point of the picture; none if it meets none of them. `background` are the samples at
    /// which the background can show something, `inside` those in its box.
    pub(super) fn new(
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
        let cut_ends = Vec::new();
        let background = background.collect();
        let behind = evaluator(&prepared.object, prepared, &pixel);
        let mut ray = Self { combination, selections, parts, behind, background, inside, cut_ends, found };
        ray.cut_ends = (0..combination.cutaways.len()).map(|i| ray.cut_end(i, prepared, point, counts)).collect();
        let takes = |s: &SelectionRay| s.here.range[0] <= s.here.range[1];
        let is_met = ray.parts.iter().any(|part| part.range[0] <= part.range[1])
            || ray.selections.iter().zip(&combination.selections).any(|(ray, s)| s.takes && takes(ray))
            || ray.background.first().is_some_and(|[first, _]| ray.cut_ends.iter().any(|end| first < end));
        is_met.then_some(ray)
    }

    /// All samples at which something can be seen, in order and without overlap.
    pub(super) fn visits(&self) -> Vec<[i64; 2]> {
        let of_parts = self.parts.iter().map(|part| part.range).filter(|[first, last]| first <= last);
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

    /// Splits the samples first..=last: the first run of them, and whether more than the background alone is in it.
    pub(super) fn run_from(&self, [first, last]: [i64; 2]) -> ([i64; 2], bool) {
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

    /// The sets at sample k together.
    #[inline(never)]
    pub(super) fn together(&mut self, k: i64, prepared: &Prepared<'_, R>, counts: &mut Counts) -> Option<Together<R>> {
        let combination = self.combination;
        let fuzzy = combination.fuzzy;
        // The value of the background's volume here, which its pieces share; looked up at most once.
        let mut here = Here { k, is_inside: contains(self.inside, k), sample: None };

        // Eq. 1: the selections here that are taken from the background, and what is left of it.
        let mut shares = Shares::whole();
        let takes = |(ray, s): &(&SelectionRay, &PreparedSelection<'_, R>)| s.takes && contains(ray.here.range, k);
        if self.selections.iter().zip(&combination.selections).any(|pair| takes(&pair)) {
            let taken = self.selections.iter().zip(&combination.selections).filter(takes);
            let mut memberships = Vec::with_capacity(self.selections.len());
            for (ray, selection) in taken {
                memberships.push(ray.here.membership(selection, k, || Some(here.sample(&self.behind, counts)?.s)));
            }
            shares = Shares::beside(fuzzy, memberships.into_iter());
        }

        // Eqs. 2 and 3: the background, faded where it lies before an object.
        let mut of_background = None;
        let is_gone = || self.cutaways_at(k).any(|gamma| gamma >= R::ONE);
        if shares.background > R::ZERO && self.background.iter().any(|&range| contains(range, k)) && !is_gone() {
            let can_show = |cells: &CellMask, at: Sample<R>| cells.can_show(&prepared.object.field, at.at.cell);
            let sample = here.sample(&self.behind, counts);
            let sample = sample.filter(|at| prepared.cells.as_ref().is_none_or(|cells| can_show(cells, *at)));
            if let Some(sample) = sample
                && let Some(((rgb, alpha), attributes)) = self.behind.shaded_by_any(sample, counts)
            {
                let background = &self.behind;
                let enhancement = || {
                    let seen = background.cut_at(k).map_or(attributes, |cut| cut.attributes(attributes));
                    background.object.shader.enhancement(&seen, &background.dirs)
                };
                let mut fades = self.cutaways_at(k).peekable();
                let e = if fades.peek().is_some() { enhancement() } else { R::ZERO };
                let faded = fades.fold(R::ONE, |factor, gamma| factor * ghosting::factor(gamma, e));
                let weight = shares.background;
                let mu = fuzzy::intersection(fuzzy, weight, alpha * faded);
                of_background = Some(FoundPart { sample, attributes, rgb, weight, mu, faded });
            }
        }

        // Eqs. 2 and 3: ghosts and selections.
        for (part, found) in self.parts.iter_mut().zip(&mut self.found) {
            *found = None;
            if !contains(part.range, k) {
                continue;
            }
            let selection = &combination.selections[part.part.selection];
            let ray = &self.selections[part.part.selection];
            let placed = if part.part.is_moved { &ray.there } else { &ray.here };
            let share = if selection.takes && !part.part.is_moved { shares.of_each } else { R::ONE };
            *found = part.found(k, (selection, placed, share), &mut here, &self.behind, fuzzy, counts);
        }
        let largest = self.largest(of_background.as_ref())?;

        // Eqs. 6 and 7: intersections, taken out of the sets that meet.
        let mut sets = Vec::with_capacity(1 + 2 * self.parts.len());
        let set = |found: &FoundPart<R>, shares| ObjectSet { rgb: found.rgb, mu: found.mu, shares };
        sets.push(of_background.as_ref().map_or(ObjectSet::NONE, |found| set(found, true)));
        for (part, found) in self.parts.iter().zip(&self.found) {
            let shares = combination.selections[part.part.selection].takes && !part.part.is_moved;
            sets.push(found.as_ref().map_or(ObjectSet::NONE, |found| set(found, shares)));
        }
        if !combination.intersections.is_empty() {
            let mut taken = vec![R::ZERO; self.parts.len()];
            for intersection in &combination.intersections {
                let meeting = self.meeting(intersection, of_background.as_ref(), counts);
                let Some(meeting) = meeting.filter(|set| set.mu > R::ZERO) else { continue };
                let of_selection = &mut taken[intersection.params.selection];
                *of_selection = fuzzy::union(fuzzy, *of_selection, meeting.mu);
                let other = intersection.params.ghost.map_or(0, |ghost| 1 + ghost);
                sets[other].without(fuzzy, meeting.mu);
                sets.push(meeting);
            }
            for (set, taken) in sets[1..].iter_mut().zip(taken).filter(|(_, taken)| *taken > R::ZERO) {
                set.without(fuzzy, taken);
            }
        }
        let (rgb, alpha) = combined(fuzzy, sets.into_iter());
        Some(Together { rgb, alpha, largest })
    }

    /// γ of the cutaways that sample k lies before.
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

    /// The alternative set where a selection meets something (eq. 7).
    fn meeting(
        &self,
        intersection: &PreparedIntersection<'_>,
        of_background: Option<&FoundPart<R>>,
        counts: &mut Counts,
    ) -> Option<ObjectSet<R>> {
        let (params, fuzzy) = (&intersection.params, self.combination.fuzzy);
        let selection = self.found[params.selection].as_ref()?;
        let other = params.ghost.map_or(of_background, |ghost| self.found[ghost].as_ref())?;
        if fuzzy::intersection(fuzzy, other.mu, selection.mu) <= R::ZERO {
            return None;
        }
        // Unshaded colours and opacities, both by the attributes of the set with the larger μ; a tie is the selection's.
        let wins = selection.mu >= other.mu;
        let winner = if wins { selection } else { other };
        let attributes = winner.attributes;
        let of_selection =
            self.parts[params.selection].evaluator.unlit(selection.sample, [selection.attributes, attributes], counts);
        let asked = [other.attributes, attributes];
        let (c_2, alpha_2) = match params.ghost {
            Some(ghost) => self.parts[ghost].evaluator.unlit(other.sample, asked, counts),
            None => self.behind.unlit(other.sample, asked, counts),
        };
        let of_other = (c_2, alpha_2 * other.faded);
        // The opacity, and the colour.
        let (a, b) = (of_selection.1, of_other.1);
        let [a, b] = if params.swap { [b, a] } else { [a, b] };
        let preset = intersections::opacity(params.opacity, a, b);
        let (rgb, alpha) = match (&params.color, intersection.picture) {
            (IntersectionPaint::Mean, _) => (intersections::mean(of_selection, of_other)?, preset),
            (IntersectionPaint::Color(rgb, opacity), _) => (rgb.map(R::from_f64), preset * R::from_f64(*opacity)),
            (IntersectionPaint::Picture(ranges), picture) => {
                let values = [other.sample.s.to_f64(), selection.sample.s.to_f64()];
                let share = |i: usize| (values[i] - ranges[i][0]) / (ranges[i][1] - ranges[i][0]);
                let [r, g, b, opacity] = picture?.at([share(0), share(1)]);
                let alpha = if picture?.has_opacity { R::from_f64(opacity) } else { preset };
                ([r, g, b].map(R::from_f64), alpha)
            }
        };
        // Shaded once, by the winner.
        let (rgb, alpha) = match (wins, params.ghost) {
            (true, _) => self.parts[params.selection].light((rgb, alpha), &attributes),
            (false, Some(ghost)) => self.parts[ghost].light((rgb, alpha), &attributes),
            (false, None) => self.behind.object.shader.light((rgb, alpha), &attributes, &self.behind.dirs),
        };
        let both = fuzzy::intersection(fuzzy, other.weight, selection.weight);
        Some(ObjectSet { rgb, mu: fuzzy::intersection(fuzzy, both, alpha), shares: false })
    }

    /// The first sample that a cutaway leaves: those before it lie before d ([VS-7]).
    fn cut_end(&mut self, cutaway: usize, prepared: &Prepared<'v, R>, point: [f64; 2], counts: &mut Counts) -> i64 {
        let cutaway = &self.combination.cutaways[cutaway];
        let lattice = self.behind.ray;
        let d = self.depth(cutaway.params.part, cutaway.params.cut, counts);
        let d = match &cutaway.funnel {
            None => d,
            Some(funnel) => {
                let pixel = [0, 1].map(|a| (point[a].max(0.0) as usize).min(prepared.view.size[a] - 1));
                match through_box(lattice.line(), prepared.object.grid.index_box()) {
                    Some([z_in, _]) => funnel.depth(pixel, z_in.max(prepared.near_of(&lattice)), d),
                    None => d,
                }
            }
        };
        if d == f64::NEG_INFINITY { i64::MIN } else { lattice.last_before(d) + 1 }
    }

    /// d of a part.
    fn depth(&mut self, part: usize, cut: Cut, counts: &mut Counts) -> f64 {
        let part = &mut self.parts[part];
        let selection = part.part.selection;
        part.depth(&self.combination.selections[selection], &self.selections[selection], cut, counts)
    }

    /// The attributes that the layers read of a part, with what only the first visible sample is asked for.
    pub(super) fn for_layers(
        &mut self,
        largest: &Largest<R>,
        is_first: bool,
        main_exponent: i32,
        counts: &mut Counts,
    ) -> Option<SampleAttributes<R>> {
        let part = &mut self.parts[largest.part?];
        let mut attributes = largest.attributes;
        if let (Some(first), true) = (part.part.object.first, is_first) {
            attributes = part.evaluator.evaluate(largest.sample, first, attributes, counts);
        }
        // The gradient of the moved field, times the power of two of the background's.
        let object = &part.part.object;
        let gradient = object.moved.as_ref().map_or(attributes.gradient, |moved| moved.apply(attributes.gradient));
        let by = object.field.scale_exponent() - main_exponent;
        let scaled = |x: R| R::monotone([x], |[x]| drypoint_scene::math::scale_by_power_of_two(x, by));
        attributes.gradient =
            if by == 0 { gradient } else { Vec3::new(scaled(gradient.x), scaled(gradient.y), scaled(gradient.z)) };
        let cut = part.evaluator.cut_at(largest.sample.k);
        Some(cut.map_or(attributes, |cut| cut.attributes(attributes)))
    }
}

/// d of a part on the ray through a point of the picture or of a guard band about it; −∞ if it misses the part ([VS-7]).
pub(in crate::ray) fn depth_of_part<R: Real>(
    prepared: &Prepared<'_, R>,
    combination: &PreparedCombination<'_, R>,
    point: [f64; 2],
    (part, cut): (usize, Cut),
    counts: &mut Counts,
) -> f64 {
    let part = &combination.parts[part];
    let selection = &combination.selections[part.selection];
    let pixel = prepared.view.ray(point[0], point[1]);
    let ray = SelectionRay::new(selection, prepared, &pixel);
    PartRay::new(part, &ray, prepared, &pixel).depth(selection, &ray, cut, counts)
}

/// A sample of the background's volume, looked up at most once.
struct Here<R> {
    k: i64,
    is_inside: bool,
    /// None: not looked up yet; the sample is none where it is masked.
    sample: Option<Option<Sample<R>>>,
}

impl<R: Real> Here<R> {
    fn sample(&mut self, evaluator: &FieldEvaluator<'_, '_, R>, counts: &mut Counts) -> Option<Sample<R>> {
        if !self.is_inside {
            return None;
        }
        *self.sample.get_or_insert_with(|| look_up(evaluator, self.k, counts))
    }
}

/// The sample of an evaluator's field on plane k; none where it is masked.
fn look_up<R: Real>(evaluator: &FieldEvaluator<'_, '_, R>, k: i64, counts: &mut Counts) -> Option<Sample<R>> {
    let at = evaluator.sampler.place(evaluator.ray.position(k));
    if evaluator.object.volume.mask().is_some_and(|mask| mask.touches_cell(at.cell)) {
        counts.masked += 1;
        return None;
    }
    counts.samples += 1;
    Some(Sample { k, at, s: evaluator.sampler.value_at(at) })
}

impl SelectionRay {
    fn new<R: Real>(selection: &PreparedSelection<'_, R>, prepared: &Prepared<'_, R>, pixel: &Ray) -> Self {
        let placed = |grid: Option<&Grid>| {
            let ray = grid.map(|grid| IndexRay::<f64>::new(pixel, &prepared.view, &prepared.lattice, grid));
            let range = ray.zip(selection.index_box).map(|(ray, ends)| ray.inside(ends.map(Vec3::from_glam)));
            PlacedSelection { ray, range: range.unwrap_or(EMPTY) }
        };
        Self { here: placed(Some(&selection.here)), there: placed(selection.there.as_ref()) }
    }
}

impl PlacedSelection {
    /// f_S at sample k, which lies in the box. `value` is the data's.
    fn membership<R: Real>(
        &self,
        selection: &PreparedSelection<'_, R>,
        k: i64,
        value: impl FnOnce() -> Option<R>,
    ) -> R {
        match (&selection.membership, &self.ray) {
            (PreparedMembership::Everything, _) => R::ONE,
            (PreparedMembership::Value(function), _) => {
                let place = value().and_then(|s| function.locate(s));
                place.map_or(R::ZERO, |place| place.alpha_u)
            }
            (PreparedMembership::Voxels(memberships), Some(ray)) => {
                R::from_f64(memberships.at(ray.position(k).to_glam()))
            }
            (PreparedMembership::Voxels(_), None) => R::ZERO,
        }
    }
}

impl<'p, 'v, R: Real> PartRay<'p, 'v, R> {
    fn new(
        part: &'p PreparedPart<'v, R>,
        selection: &SelectionRay,
        prepared: &'p Prepared<'v, R>,
        pixel: &Ray,
    ) -> Self {
        let object = &part.object;
        let evaluator = evaluator(object, prepared, pixel);
        let ray = evaluator.ray;
        let placed = if part.is_moved { &selection.there } else { &selection.here };
        let [first, last] = ray.left_by(&object.clip.planes, object.ends, ray.inside(object.ends));
        let range = [first.max(placed.range[0]), last.min(placed.range[1])];
        Self { part, evaluator, range: if range[0] <= range[1] { range } else { EMPTY } }
    }

    /// Its set at sample k: none where it has no members.
    fn found(
        &mut self,
        k: i64,
        (selection, placed, share): (&PreparedSelection<'_, R>, &PlacedSelection, R),
        here: &mut Here<R>,
        background: &FieldEvaluator<'_, '_, R>,
        fuzzy: Fuzzy,
        counts: &mut Counts,
    ) -> Option<FoundPart<R>> {
        let mut sample = None;
        let by_value = matches!(selection.membership, PreparedMembership::Value(_));
        if by_value {
            sample = Some(self.look_up(k, here, background, counts)?);
        }
        let weight = placed.membership(selection, k, || sample.map(|sample: Sample<R>| sample.s)) * share;
        if weight <= R::ZERO {
            return None;
        }
        let sample = match sample {
            Some(sample) => sample,
            None => self.look_up(k, here, background, counts)?,
        };
        let ((rgb, alpha), attributes) = self.evaluator.shaded_by_any(sample, counts)?;
        let mu = fuzzy::intersection(fuzzy, weight, alpha);
        let seen = self.evaluator.cut_at(k).map_or(attributes, |cut| cut.attributes(attributes));
        (mu > R::ZERO).then_some(FoundPart { sample, attributes: seen, rgb, weight, mu, faded: R::ONE })
    }

    /// Its value at sample k: that of the background where both are one volume at one place.
    fn look_up(
        &self,
        k: i64,
        here: &mut Here<R>,
        background: &FieldEvaluator<'_, '_, R>,
        counts: &mut Counts,
    ) -> Option<Sample<R>> {
        if !self.part.can_show(self.evaluator.sampler.place(self.evaluator.ray.position(k)).cell) {
            return None;
        }
        if self.part.is_of_background { here.sample(background, counts) } else { look_up(&self.evaluator, k, counts) }
    }

    /// Whether μ > 0 at sample k.
    fn is_member(
        &mut self,
        k: i64,
        (selection, placed): (&PreparedSelection<'_, R>, &PlacedSelection),
        counts: &mut Counts,
    ) -> bool {
        let mut found = || {
            let sample = look_up(&self.evaluator, k, counts)?;
            let weight = placed.membership(selection, k, || Some(sample.s));
            let ((_, alpha), _) = self.evaluator.shaded_by_any(sample, counts).filter(|_| weight > R::ZERO)?;
            (alpha > R::ZERO).then_some(())
        };
        found().is_some()
    }

    /// d: the far side of its box, or the depth of its last sample with μ > 0; −∞ if the ray misses it ([VS-7]).
    fn depth(
        &mut self,
        selection: &PreparedSelection<'_, R>,
        ray: &SelectionRay,
        cut: Cut,
        counts: &mut Counts,
    ) -> f64 {
        let placed = if self.part.is_moved { &ray.there } else { &ray.here };
        match cut {
            Cut::Bounds => {
                let through = placed.ray.zip(selection.index_box).and_then(|(ray, ends)| through_box(ray.line(), ends));
                through.map_or(f64::NEG_INFINITY, |[_, far]| far)
            }
            Cut::Object => {
                let [first, last] = self.range;
                let is_member = |k: &i64| self.is_member(*k, (selection, placed), counts);
                let last = (first..=last).rev().find(is_member);
                last.map_or(f64::NEG_INFINITY, |k| self.evaluator.ray.depth(k).to_f64())
            }
        }
    }

    /// A colour and an opacity in the light of the part.
    fn light(&self, unlit: ([R; 3], R), attributes: &SampleAttributes<R>) -> ([R; 3], R) {
        self.part.object.shader.light(unlit, attributes, &self.evaluator.dirs)
    }
}

/// The evaluator of an object on a ray.
fn evaluator<'p, 'v, R: Real>(
    object: &'p PreparedObject<'v, R>,
    prepared: &Prepared<'_, R>,
    pixel: &Ray,
) -> FieldEvaluator<'p, 'v, R> {
    let view = &prepared.view;
    let ray = IndexRay::<R>::new(pixel, view, &prepared.lattice, &object.grid);
    let (v, v_eye) = (Vec3::from_glam(view.direction_to_world(pixel.v)), Vec3::from_glam(pixel.v));
    let dirs = object.shader.view_dirs(v, v_eye);
    Evaluator::new(object, &object.field, ray, dirs, &prepared.eye_axes)
}

/// Whether a sample lies in a range.
#[inline]
fn contains([first, last]: [i64; 2], k: i64) -> bool {
    first <= k && k <= last
}
