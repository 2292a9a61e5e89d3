//! The objects on a ray, with the errors of their rays ([VS-2] … [VS-4], [VS-7]).
//!
//! Each part and each selection has a ray of its own, in the index space of its own grid. It starts on the same plane as
//! the ray through the picture's volume, and its positions have errors by the same rules. All formulas of objects are
//! those of the reference on numbers with errors. What remains are decisions: whether a sample lies in a box, behind a
//! clip plane, or before the end of a cutaway. If errors leave one open at a sample, the sample is evaluated on both
//! ways.

use super::aimed_ray::AimedRay;
use super::cast::Tracer;
use super::positions::Answer;
use super::surface::BoundedHit;
use crate::number::ways::{self, Ways};
use crate::number::{Bounded, Decision, Vec3};
use crate::ray::composite::{EMPTY, FieldEvaluator, ObjectRay, PlacedSelection};
use crate::ray::lattice::IndexRay;
use crate::ray::prepared::Prepared;
use crate::ray::prepared_combination::PreparedSelection;
use crate::ray::sample::{PreparedObject, Previous};
use crate::volumeshop::far_side::through_box;
use drypoint_scene::counts::Counts;
use drypoint_scene::glam::DVec3;
use drypoint_scene::shot::Cut;

/// Half a unit in the last place of 1.
const ROUNDING: f64 = 0.5 * f32::EPSILON as f64;

/// The objects on a ray, and the decisions at its samples.
pub(super) struct BoundedObjects<'p, 'v> {
    ray: ObjectRay<'p, 'v, Bounded>,
    /// Whether the background has samples.
    has_background: bool,
    /// The samples of the background by the values: in its box, and those of them that no plane cuts away.
    own: [[i64; 2]; 2],
    /// For each part, the samples in the box of its data that no plane cuts away, by the values.
    of_parts: Vec<[i64; 2]>,
    /// For each selection, the samples in its box by the values, at its original place and where it is moved.
    of_selections: Vec<[[i64; 2]; 2]>,
    /// The first sample behind each cutaway, by the values.
    cut_ends: Vec<i64>,
    /// For each cutaway, the least and the largest index of the first sample behind it in f32.
    open_ends: Vec<[i64; 2]>,
}

/// A question at a sample, with its answer by the values.
#[derive(Clone, Copy)]
struct Question {
    by_value: bool,
    /// The decision, if errors leave the question open.
    open: Option<Decision>,
}

/// The questions at a sample.
pub(super) struct Questions {
    /// Whether the sample lies in the background's box, and whether no plane cuts it away.
    own: [Question; 2],
    parts: Vec<Question>,
    selections: Vec<[Question; 2]>,
    /// Whether the sample lies before the end of each cutaway.
    cutaways: Vec<Question>,
    /// Whether errors leave open if the sample is the first one behind a cut.
    hangs_on_cut: bool,
}

impl Question {
    const NO: Self = Self { by_value: false, open: None };

    fn new(by_value: bool, is_open: bool, decision: Decision) -> Self {
        Self { by_value, open: is_open.then_some(decision) }
    }

    /// Whether the answer may be yes.
    fn can_be(self) -> bool {
        self.by_value || self.open.is_some()
    }

    /// The answer on the way that is followed. Each question at a sample has a number of its own.
    fn answer(self, number: usize) -> bool {
        let pair = [Bounded::exact(number as f64), Bounded::exact(-1.0)];
        self.open.map_or(self.by_value, |decision| ways::choose(self.by_value, pair, decision))
    }
}

/// The range of sample k alone, if it is there.
fn only(k: i64, is_there: bool) -> [i64; 2] {
    if is_there { [k, k] } else { EMPTY }
}

fn contains([first, last]: [i64; 2], k: i64) -> bool {
    first <= k && k <= last
}

/// Whether a sample lies in a box and no plane cuts it away.
#[inline]
fn is_left(ray: &IndexRay<Bounded>, object: &PreparedObject<'_, Bounded>, k: i64) -> Answer {
    match (ray.is_inside(k, object.ends), ray.is_cut(k, &object.clip.planes)) {
        (Answer::No, _) | (_, Answer::Yes) => Answer::No,
        (Answer::Yes, Answer::No) => Answer::Yes,
        _ => Answer::Open,
    }
}

impl<'p, 'v> BoundedObjects<'p, 'v> {
    /// The objects on the ray through a point. Returns none without objects.
    #[inline]
    pub(super) fn new(prepared: &'p Prepared<'v, Bounded>, point: [f64; 2], aimed: &AimedRay<'p, 'v>) -> Option<Self> {
        let object = &prepared.object;
        let behind = aimed.evaluator(object);
        let has_background = !prepared.surface.as_ref().is_some_and(|surface| surface.alone);
        let inside = behind.ray.inside(object.ends);
        let left = if has_background { behind.ray.left_by(&object.clip.planes, object.ends, inside) } else { EMPTY };
        let background = [left].into_iter().filter(|[first, last]| first <= last);
        let mut ray = ObjectRay::aimed(prepared, point, (background, inside), &mut Counts::default())?;
        ray.behind = behind;
        for (placed, selection) in ray.selections.iter_mut().zip(&ray.combination.selections) {
            let ends = selection.index_box.map_or([Vec3::zero(); 2], |ends| ends.map(Vec3::from_glam));
            placed.here.ray = Some(aimed.in_grid(&selection.here, ends).less_first_voxel(ends));
            placed.there.ray = selection.there.as_ref().map(|grid| aimed.in_grid(grid, ends).less_first_voxel(ends));
        }
        for part in &mut ray.parts {
            part.evaluator = aimed.evaluator(&part.part.object);
        }
        let of_part = |object: &PreparedObject<'_, Bounded>, ray: &IndexRay<Bounded>| {
            ray.left_by(&object.clip.planes, object.ends, ray.inside(object.ends))
        };
        let mut objects = Self {
            has_background,
            own: [inside, left],
            of_parts: ray.parts.iter().map(|part| of_part(&part.part.object, &part.evaluator.ray)).collect(),
            of_selections: ray.selections.iter().map(|ray| [ray.here.range, ray.there.range]).collect(),
            cut_ends: ray.cut_ends.clone(),
            open_ends: Vec::new(),
            ray,
        };
        let cutaways = 0..objects.cut_ends.len();
        objects.open_ends = cutaways.map(|i| objects.open_end(i, aimed.start())).collect();
        Some(objects)
    }

    /// Whether errors leave open through which plane the ray of the background or of a part is cut.
    #[inline]
    pub(super) fn cut_is_open(&self, v: Vec3<Bounded>) -> bool {
        self.ray.parts.iter().any(|part| part.evaluator.ray.cut_is_open(&part.part.object.clip.planes, v))
    }

    /// The samples at which a part or the background may show something, as a closed range.
    #[inline]
    fn candidates(&self) -> [i64; 2] {
        let behind = self.has_background.then(|| self.ray.behind.ray.candidates(self.ray.behind.object.ends));
        let parts = self.ray.parts.iter().map(|part| part.evaluator.ray.candidates(part.part.object.ends));
        let all = behind.into_iter().chain(parts).filter(|[first, last]| first <= last);
        all.reduce(|[a, b], [c, d]| [a.min(c), b.max(d)]).unwrap_or(EMPTY)
    }

    /// The questions at sample k. Returns none if nothing can show there.
    #[inline]
    fn questions(&self, k: i64) -> Option<Questions> {
        let background = &self.ray.behind;
        let (ray, planes) = (&background.ray, &background.object.clip.planes);
        let inside = match ray.is_inside(k, background.object.ends) {
            _ if k < ray.first => Question::NO,
            answer => Question::new(contains(self.own[0], k), answer == Answer::Open, Decision::Inside),
        };
        let left = match ray.is_cut(k, planes) {
            Answer::Yes => Question::NO,
            _ if !self.has_background => Question::NO,
            answer => Question::new(
                contains(self.own[1], k) || !contains(self.own[0], k),
                answer == Answer::Open,
                Decision::Cut,
            ),
        };
        let parts = self.ray.parts.iter().zip(&self.of_parts).map(|(part, &by_value)| {
            match is_left(&part.evaluator.ray, &part.part.object, k) {
                Answer::No => Question::NO,
                _ if k < part.evaluator.ray.first => Question::NO,
                answer => Question::new(contains(by_value, k), answer == Answer::Open, Decision::Object),
            }
        });
        let parts: Vec<_> = parts.collect();
        let can_show = inside.can_be() && left.can_be() || parts.iter().any(|part| part.can_be());
        if !can_show {
            return None;
        }
        let rays = self.ray.selections.iter().zip(&self.ray.combination.selections).zip(&self.of_selections);
        let selections = rays.map(|((ray, selection), by_value)| {
            let is_member = |placed: &PlacedSelection<Bounded>, by_value: [i64; 2]| {
                let ends = selection.members.map(|ends| ends.map(Vec3::from_glam));
                let answer = placed.ray.zip(ends).map_or(Answer::No, |(ray, ends)| ray.is_inside(k, ends));
                Question::new(contains(by_value, k), answer == Answer::Open, Decision::Object)
            };
            [is_member(&ray.here, by_value[0]), is_member(&ray.there, by_value[1])]
        });
        let cutaways = self
            .cut_ends
            .iter()
            .zip(&self.open_ends)
            .map(|(&end, &[least, most])| Question::new(k < end, least <= k && k < most, Decision::Object));
        let is_open = |evaluator: &FieldEvaluator<'_, '_, Bounded>| {
            let planes = &evaluator.object.clip.planes;
            !planes.is_empty() && [k - 1, k].iter().any(|&k| evaluator.ray.is_cut(k, planes) == Answer::Open)
        };
        let hangs_on_cut = is_open(background) || self.ray.parts.iter().any(|part| is_open(&part.evaluator));
        let (selections, cutaways) = (selections.collect(), cutaways.collect());
        Some(Questions { own: [inside, left], parts, selections, cutaways, hangs_on_cut })
    }

    /// Restricts all ranges to sample k, by the answers on the way that is followed. Returns whether the background is
    /// there, and whether the sample is one of objects.
    #[inline]
    fn settle(&mut self, k: i64, questions: &Questions) -> (bool, bool) {
        let mut number = 0;
        let mut ask = |question: Question| {
            number += 1;
            question.answer(number)
        };
        let [inside, left] = questions.own.map(&mut ask);
        self.ray.inside = only(k, inside);
        self.ray.background.clear();
        self.ray.background.extend((inside && left).then_some([k, k]));
        for (placed, questions) in self.ray.selections.iter_mut().zip(&questions.selections) {
            let [here, there] = questions.map(&mut ask);
            (placed.here.range, placed.there.range) = (only(k, here), only(k, there));
        }
        for (part, question) in self.ray.parts.iter_mut().zip(&questions.parts) {
            let selection = &self.ray.selections[part.part.selection];
            let placed = if part.part.is_moved { &selection.there } else { &selection.here };
            part.range = only(k, ask(*question) && contains(placed.range, k));
            part.evaluator.previous = Previous::None;
        }
        for (end, question) in self.ray.cut_ends.iter_mut().zip(&questions.cutaways) {
            *end = if ask(*question) { k + 1 } else { i64::MIN };
        }
        self.ray.behind.previous = Previous::None;
        (inside && left, self.ray.run_from([k, k]).1)
    }

    /// The first sample behind a cutaway in f32, as its least and its largest index. `middle` is the depth from which a
    /// ray starts.
    #[inline]
    fn open_end(&mut self, cutaway: usize, middle: f64) -> [i64; 2] {
        let params = self.ray.combination.cutaways[cutaway].params;
        let part = &self.ray.parts[params.part];
        let (selection, ray) =
            (&self.ray.combination.selections[part.part.selection], &self.ray.selections[part.part.selection]);
        let placed = if part.part.is_moved { &ray.there } else { &ray.here };
        match params.cut {
            Cut::Bounds => far_sides(selection, placed, middle),
            Cut::Object => self.last_members(params.part),
        }
    }

    /// The last sample of a part with μ > 0, as the least and the largest index in f32.
    #[inline]
    fn last_members(&mut self, part: usize) -> [i64; 2] {
        let range = self.of_parts[part];
        let part = &mut self.ray.parts[part];
        let number = part.part.selection;
        let (selection, ray) = (&self.ray.combination.selections[number], &self.ray.selections[number]);
        let placed = if part.part.is_moved { &ray.there } else { &ray.here };
        let by_value = self.of_selections[number][usize::from(part.part.is_moved)];
        let Some(members) = selection.members.map(|ends| ends.map(Vec3::from_glam)) else { return [i64::MIN; 2] };
        let [first, last] = part.evaluator.ray.candidates(part.part.object.ends);
        let mut most = None;
        for k in (first..=last).rev() {
            let is_left = is_left(&part.evaluator.ray, &part.part.object, k);
            let is_inside = placed.ray.map_or(Answer::No, |ray| ray.is_inside(k, members));
            if is_left == Answer::No || is_inside == Answer::No {
                continue;
            }
            let is_open = is_left == Answer::Open || is_inside == Answer::Open;
            let is_there = Question::new(contains(range, k) && contains(by_value, k), is_open, Decision::Object);
            let Ways { by_value, others, too_many } = ways::follow(|| {
                part.evaluator.previous = Previous::None;
                is_there.answer(0) && part.is_member(k, (selection, placed), &mut Counts::default())
            });
            if by_value || too_many || others.iter().any(|other| other.0) {
                most.get_or_insert(k);
            }
            if by_value && !too_many && others.iter().all(|other| other.0) {
                return [k, most.unwrap_or(k)];
            }
        }
        [i64::MIN, most.unwrap_or(i64::MIN)]
    }
}

/// The first sample behind the far side of a selection's box in f32, as its least and its largest index.
///
/// The ray in f32 is off by at most e along each axis. So it leaves the box no sooner than the ray leaves the box that
/// is smaller by e, and no later than it leaves the one that is larger by e. The quotient that gives the depth has four
/// roundings.
#[inline]
fn far_sides(selection: &PreparedSelection<'_, Bounded>, placed: &PlacedSelection<Bounded>, middle: f64) -> [i64; 2] {
    let Some((ray, [lo, hi])) = placed.ray.zip(selection.index_box) else { return [i64::MIN; 2] };
    let e = DVec3::from_array(ray.errors()) + 4.0 * ROUNDING * lo.abs().max(hi.abs());
    [-1.0, 1.0].map(|sign| match through_box(ray.line(), [lo - e * sign, hi + e * sign]) {
        None => i64::MIN,
        Some([_, far]) => {
            let slack = 8.0 * ROUNDING * (far.abs() + middle.abs());
            ray.last_before(far + slack * sign) + 1
        }
    })
}

impl IndexRay<Bounded> {
    /// The ray with the error of a position that is counted from the first voxel of a selection's box.
    fn less_first_voxel(mut self, [lo, hi]: [Vec3<Bounded>; 2]) -> Self {
        let size = (hi.to_glam() - lo.to_glam()).abs().max_element() + 1.0;
        let more = |x: Bounded| Bounded::new(x.value(), x.error() + ROUNDING * size);
        self.origin = Vec3::new(more(self.origin.x), more(self.origin.y), more(self.origin.z));
        self
    }
}

impl Tracer<'_, '_> {
    /// Visits all samples of the background and of objects that an f32 renderer may visit, up to the iso-surface.
    /// Returns whether the ray is still open.
    #[inline]
    pub(super) fn samples_among(&mut self, objects: &mut BoundedObjects<'_, '_>, hit: Option<BoundedHit>) -> bool {
        let [first, last] = objects.candidates();
        let last_of_all = hit.map_or(i64::MAX - 1, |hit| self.evaluator.ray.last_before(hit.t));
        for k in first..=last.min(last_of_all + 1) {
            let Some(questions) = objects.questions(k) else { continue };
            let steps = self.steps_of(k, hit, last_of_all);
            let shown = self.merged(|tracer| match objects.settle(k, &questions) {
                (_, true) => {
                    let together = objects.ray.together(k, tracer.prepared, &mut Counts::default())?;
                    Some(tracer.corrected((together.rgb, together.alpha), steps))
                }
                (true, false) => tracer.shaded(k, steps),
                (false, false) => None,
            });
            let Some(shown) = shown else { continue };
            if questions.hangs_on_cut {
                self.mark(Decision::Cut);
            }
            if !self.composite(k, &shown, hit, k <= last_of_all) {
                return false;
            }
        }
        true
    }
}
