//! The layout of labels: rounds of exchanges and nudges, then greedy keeping ([VS-10]).

use super::hull::{RadialHull, wrapped};
use super::place::Place;
use super::segments::within;
use drypoint_scene::annotations::{AnnotatedPage, Annotation, AnnotationLayout, Hidden, PlacedAnnotation, Relocation};
use drypoint_scene::glam::DVec2;
use std::ops::Range;

/// The step of a nudge, in turns.
const NUDGE: f64 = 1.0 / 256.0;
/// The largest number of nudges from its home, to each side, for a label that still meets another one after the rounds.
const NUDGES: i32 = 32;
/// The largest number of rounds that are made, whatever the page asks for. Rounds of some pages never end.
pub(super) const MOST_ROUNDS: usize = 1024;
/// The least mean width of the hull, as a fraction of the frame's diagonal.
const LEAST_WIDTH: f64 = 1.0 / 1024.0;
/// The margin that keeps a label on its side ([VS-10]): a fraction of the hull's diameter. A home that moves farther
/// along the hull is reported, too.
const MARGIN: f64 = 0.05;

/// The largest motion of a home that is rounding, in turns.
const ROUNDING: f64 = 1e-12;

/// Places the labels of a page.
///
/// The rules leave some cases open. These are the decisions:
///
/// - Anchors in the frame are points of the hull, so first segments of leader lines lie in the hull and boxes lie
///   outside it. Points that are not finite are left out.
/// - A label's distance from its anchor is the length of the leader line up to the hull.
/// - Nudges of a round lead towards larger t. A label's predecessor is the label before it in the order of t, which
///   begins after the widest gap.
/// - An exchange that brings two labels nearer is made only if it adds no conflict.
/// - A label that meets a nearer one after the rounds tries its home and the places up to an eighth of a turn before and
///   after it, nearest first. A label that is hidden stands at its home.
/// - Labels that are kept then return towards their homes and exchange their places while that is nearer and free.
/// - The second segment of a leader line lies on the normal through the box's centre. The line is straight while the
///   label is at its home.
///
/// The previous layout gives the homes and nothing else, so a layout from a finished one changes nothing. A home follows
/// the local minimum of the distance that it leads to. So a label that was hidden has as good a chance as the others.
pub fn layout(page: &AnnotatedPage, previous: Option<&AnnotationLayout>) -> AnnotationLayout {
    let all = &page.annotations;
    let mut places: Vec<PlacedAnnotation> = all.iter().map(|annotation| unplaced(annotation, page.frame)).collect();
    let order = by_depth(all, &places);
    let (Some(&nearest), Some(&farthest)) = (order.first(), order.last()) else {
        return AnnotationLayout { annotations: places, relocations: Vec::new() };
    };
    let points = page.outline.iter().copied().filter(|point| point.is_finite());
    let points = points.chain(order.iter().map(|&i| all[i].anchor)).collect();
    let Some(hull) = RadialHull::new(points, page.frame[0].distance(page.frame[1]) * LEAST_WIDTH) else {
        for i in order {
            let is_large = all[i].size.cmpgt(page.frame[1] - page.frame[0]).any();
            places[i].hidden = Some(if is_large { Hidden::OutsideFrame } else { Hidden::OutOfRange });
        }
        return AnnotationLayout { annotations: places, relocations: Vec::new() };
    };
    let labels = order.iter().map(|&i| {
        let previous = previous.and_then(|layout| layout.annotations.get(i));
        Label::new(i, all[i], previous, &hull)
    });
    let mut table = Table { labels: labels.collect(), hull, frame: page.frame, obstacles: &page.obstacles };
    let rounds = page.rounds.min(MOST_ROUNDS);
    table.resolve(rounds);
    table.keep(rounds);
    let relocations = table.relocations();
    for Label { index, given, home, place, hidden, .. } in table.labels {
        let opacity = opacity(given.depth, [nearest, farthest].map(|i| all[i].depth), page.least_opacity);
        let leader = [place.hull.at, place.end];
        places[index] =
            PlacedAnnotation { t: place.hull.t, home: Some(home), corners: place.corners, leader, opacity, hidden };
    }
    AnnotationLayout { annotations: places, relocations }
}

/// A label at its anchor. It is hidden if it is not valid, or its anchor is outside the frame.
pub(super) fn unplaced(annotation: &Annotation, frame: [DVec2; 2]) -> PlacedAnnotation {
    let Annotation { anchor, depth, size } = *annotation;
    let is_valid = anchor.is_finite() && depth.is_finite() && size.is_finite() && size.min_element() > 0.0;
    let hidden =
        if is_valid { (!within(anchor, frame)).then_some(Hidden::OutsideFrame) } else { Some(Hidden::Invalid) };
    PlacedAnnotation { t: 0.0, home: None, corners: [anchor; 2], leader: [anchor; 2], opacity: 0.0, hidden }
}

/// The labels that are not hidden, from the nearest anchor to the farthest. Labels of equal depth are in the order of the
/// list.
pub(super) fn by_depth(all: &[Annotation], places: &[PlacedAnnotation]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..all.len()).filter(|&i| places[i].hidden.is_none()).collect();
    // −0 is as near as 0.
    order.sort_by(|&i, &j| (all[i].depth + 0.0).total_cmp(&(all[j].depth + 0.0)));
    order
}

/// The opacity of the leader line of an anchor at a depth between the nearest and the farthest one.
pub(super) fn opacity(depth: f64, [near, far]: [f64; 2], least: f64) -> f64 {
    // Halves keep the differences finite.
    let way = |depth: f64| depth / 2.0 - near / 2.0;
    if far > near { 1.0 - (1.0 - least) * (way(depth) / way(far)) } else { 1.0 }
}

/// A label on its way to a place.
struct Label {
    /// The place in the list.
    index: usize,
    given: Annotation,
    /// t of its home.
    home: f64,
    place: Place,
    hidden: Option<Hidden>,
    /// Whether its home moved to another side, or far along the hull.
    changed_side: bool,
    /// Its distance from its home in the previous layout, in turns. 0 without a previous layout.
    previous_offset: f64,
    /// The label with which it exchanged its hull point last, as its place in the list.
    exchanged: Option<usize>,
}

impl Label {
    /// A label before the rounds, at its home.
    fn new(index: usize, given: Annotation, previous: Option<&PlacedAnnotation>, hull: &RadialHull) -> Self {
        let anchor = given.anchor;
        let nearest = hull.nearest(anchor);
        let (mut home, mut changed_side, mut previous_offset) = (nearest.t, false, 0.0);
        if let Some((t, old)) = previous.and_then(|previous| Some((previous.t, previous.home?))) {
            // A side is the local minimum of the distance that the old home leads to.
            let (start, side) = (hull.at(old), hull.nearest_from(old, anchor));
            let margin = MARGIN * hull.diameter;
            let is_kept = side.at.distance(anchor) <= nearest.at.distance(anchor) + margin;
            changed_side = (if is_kept { side } else { nearest }).at.distance(start.at) > margin;
            if is_kept {
                let turn = wrapped(side.t - old);
                home = if turn.min(1.0 - turn) <= ROUNDING { old } else { side.t };
            }
            previous_offset = wrapped(t - old);
        }
        let place = Place::new(hull, hull.at(home), &given);
        Self { index, given, home, place, hidden: None, changed_side, previous_offset, exchanged: None }
    }
}

/// The labels of a page, from the nearest anchor to the farthest.
struct Table<'a> {
    labels: Vec<Label>,
    hull: RadialHull,
    frame: [DVec2; 2],
    obstacles: &'a [[DVec2; 2]],
}

impl Table<'_> {
    /// The three steps of 6.4, in rounds until nothing changes.
    fn resolve(&mut self, rounds: usize) {
        for _ in 0..rounds {
            let uncrossed = self.exchange(Self::crosses);
            let nearer = self.exchange(Self::is_nearer);
            if !(self.nudge() | uncrossed | nearer) {
                break;
            }
        }
    }

    /// Changes of side, and labels that are shown at another distance from their homes than in the previous layout.
    ///
    /// Homes move with their anchors, so the distance of labels that are exchanged changes a little without a
    /// relocation. Half a nudge is reported.
    fn relocations(&self) -> Vec<Relocation> {
        let mut relocations = Vec::new();
        for label in self.labels.iter().filter(|label| label.hidden.is_none()) {
            if label.changed_side {
                relocations.push(Relocation::ChangeOfSide(label.index));
            }
            let offset = wrapped(label.place.hull.t - label.home);
            let turn = wrapped(offset - label.previous_offset);
            if turn.min(1.0 - turn) >= NUDGE / 2.0 {
                relocations.push(match label.exchanged {
                    _ if label.place.hull.t == label.home => Relocation::Return(label.index),
                    Some(other) => Relocation::Exchange(label.index.min(other), label.index.max(other)),
                    None => Relocation::Nudge(label.index),
                });
            }
        }
        // Both labels of an exchange report it.
        let mut once: Vec<Relocation> = Vec::new();
        for relocation in relocations {
            if !once.contains(&relocation) {
                once.push(relocation);
            }
        }
        once
    }

    /// Exchanges the hull points of pairs for which a condition holds, and tells whether there are any.
    fn exchange(&mut self, condition: fn(&Self, usize, usize) -> bool) -> bool {
        let mut any = false;
        for j in 0..self.labels.len() {
            for i in 0..j {
                if self.is_shown(i) && self.is_shown(j) && condition(self, i, j) {
                    let [at_i, at_j] = self.exchanged(i, j);
                    (self.labels[i].place, self.labels[j].place) = (at_i, at_j);
                    let [a, b] = [i, j].map(|i| self.labels[i].index);
                    (self.labels[i].exchanged, self.labels[j].exchanged) = (Some(b), Some(a));
                    any = true;
                }
            }
        }
        any
    }

    /// Step 1: lines cross, and are shorter together once they are exchanged.
    fn crosses(&self, i: usize, j: usize) -> bool {
        let [a, b] = [&self.labels[i].place, &self.labels[j].place];
        // An exchange shortens no lines from one anchor.
        a.anchor != b.anchor
            && a.crosses(b)
            && a.anchor.distance(b.hull.at) + b.anchor.distance(a.hull.at) < a.distance() + b.distance()
    }

    /// Step 2: both labels are nearer to their anchors once they are exchanged, without more conflicts than before.
    fn is_nearer(&self, i: usize, j: usize) -> bool {
        let [a, b] = [&self.labels[i].place, &self.labels[j].place];
        let is_nearer =
            |a: &Place, b: &Place| a.anchor.distance_squared(b.hull.at) < a.anchor.distance_squared(a.hull.at);
        is_nearer(a, b)
            && is_nearer(b, a)
            && self.conflicts([i, j], self.exchanged(i, j)) <= self.conflicts([i, j], [*a, *b])
    }

    /// The places of two labels at each other's hull points.
    fn exchanged(&self, i: usize, j: usize) -> [Place; 2] {
        [(i, j), (j, i)].map(|(i, j)| Place::new(&self.hull, self.labels[j].place.hull, &self.labels[i].given))
    }

    /// Number of conflicts that two labels have at two places.
    fn conflicts(&self, pair: [usize; 2], places: [Place; 2]) -> usize {
        let outside = places.iter().filter(|place| !self.is_free(place)).count();
        let others = (0..self.labels.len()).filter(|k| !pair.contains(k) && self.is_shown(*k));
        let met = others.map(|k| places.iter().filter(|place| place.meets(&self.labels[k].place)).count());
        outside + met.sum::<usize>() + usize::from(places[0].meets(&places[1]))
    }

    /// Step 3: nudges each label whose box meets its predecessor, and tells whether there are any.
    fn nudge(&mut self) -> bool {
        let mut order: Vec<usize> = (0..self.labels.len()).filter(|&i| self.is_shown(i)).collect();
        let t = |i: usize| self.labels[i].place.hull.t;
        order.sort_by(|&i, &j| t(i).total_cmp(&t(j)));
        let gap = |k: usize| {
            if k == 0 { t(order[0]) + 1.0 - t(order[order.len() - 1]) } else { t(order[k]) - t(order[k - 1]) }
        };
        let widest = (1..order.len()).fold(0, |widest, k| if gap(k) > gap(widest) { k } else { widest });
        order.rotate_left(widest);
        let mut any = false;
        for pair in order.windows(2) {
            let [before, label] = [&self.labels[pair[0]], &self.labels[pair[1]]];
            if label.place.overlaps(&before.place) || label.place.touches_box(&before.place) {
                let at = self.hull.at(wrapped(label.place.hull.t + NUDGE));
                self.labels[pair[1]].place = Place::new(&self.hull, at, &label.given);
                any = true;
            }
        }
        any
    }

    /// Keeps labels from the nearest to the farthest, then lets those that are kept come nearer to their anchors.
    ///
    /// Each repetition keeps a label that is nearer than all labels it hides, or it shortens lines of the same labels.
    /// So no state comes twice.
    fn keep(&mut self, rounds: usize) {
        self.keep_greedily();
        for _ in 0..rounds {
            let nearer = self.exchange(Self::is_nearer);
            if !(self.return_home() | nearer) {
                break;
            }
            self.keep_greedily();
        }
    }

    /// Keeps each label that meets no nearer one that is kept, after nudges if need be. Others are hidden at home.
    fn keep_greedily(&mut self) {
        for i in 0..self.labels.len() {
            let conflict = |place: &Place| self.conflict(i, place, 0..i);
            if conflict(&self.labels[i].place).is_none() {
                self.labels[i].hidden = None;
                continue;
            }
            let home = self.nudged(i, 0);
            let free = nudges().map(|steps| self.nudged(i, steps)).find(|place| conflict(place).is_none());
            self.labels[i].hidden = if free.is_none() { conflict(&home) } else { None };
            self.labels[i].place = free.unwrap_or(home);
        }
    }

    /// Moves labels that are kept to the first free place from their homes that is nearer to their anchors. Tells whether
    /// there are any.
    fn return_home(&mut self) -> bool {
        let mut any = false;
        for i in 0..self.labels.len() {
            let distance = self.labels[i].place.distance();
            if self.is_shown(i) && self.labels[i].place.hull.t != self.labels[i].home {
                let mut nearer =
                    nudges().map(|steps| self.nudged(i, steps)).filter(|place| place.distance() < distance);
                if let Some(place) = nearer.find(|place| self.conflict(i, place, 0..self.labels.len()).is_none()) {
                    self.labels[i].place = place;
                    any = true;
                }
            }
        }
        any
    }

    /// Why a label cannot be at a place: the frame, or the nearest of some labels that are kept.
    fn conflict(&self, i: usize, place: &Place, others: Range<usize>) -> Option<Hidden> {
        if !self.is_free(place) {
            return Some(Hidden::OutsideFrame);
        }
        let met = others.filter(|&k| k != i && self.is_shown(k)).find(|&k| place.meets(&self.labels[k].place))?;
        let Label { index, place: other, .. } = &self.labels[met];
        Some(if place.overlaps(other) { Hidden::Overlap(*index) } else { Hidden::Crossing(*index) })
    }

    /// A label's place some nudges after its home.
    fn nudged(&self, i: usize, nudges: i32) -> Place {
        let label = &self.labels[i];
        Place::new(&self.hull, self.hull.at(wrapped(label.home + f64::from(nudges) * NUDGE)), &label.given)
    }

    /// Whether a place is within the frame and covers no obstacle.
    fn is_free(&self, place: &Place) -> bool {
        place.is_within(self.frame) && !self.obstacles.iter().any(|obstacle| place.covers(*obstacle))
    }

    fn is_shown(&self, i: usize) -> bool {
        self.labels[i].hidden.is_none()
    }
}

/// Nudges from a home: none, then forwards and backwards in turn.
fn nudges() -> impl Iterator<Item = i32> {
    std::iter::once(0).chain((1..=NUDGES).flat_map(|steps| [steps, -steps]))
}
