//! The layout of labels: rounds of exchanges and nudges, then greedy keeping ([VS-10]).

use super::hull::{RadialHull, wrapped};
use super::place::Place;
use super::segments::within;
use drypoint_scene::annotations::{AnnotatedPage, Annotation, AnnotationLayout, Hidden, PlacedAnnotation, Relocation};
use drypoint_scene::glam::DVec2;
use std::ops::Range;

/// The step of a nudge, in turns.
const NUDGE: f64 = 1.0 / 256.0;
/// The largest number of nudges from its home for a label that still meets another one after the rounds.
const NUDGES: usize = 32;
/// The least mean width of the hull, as a fraction of the frame's diagonal.
const LEAST_WIDTH: f64 = 1.0 / 1024.0;
/// The margin that keeps a label on its side: a fraction of the hull's diameter. A motion of at most this fraction of a
/// turn stays on a side.
const MARGIN: f64 = 0.05;

/// Places the labels of a page.
///
/// The rules leave some cases open. These are the decisions:
///
/// - Anchors in the frame are points of the hull, so first segments of leader lines lie in the hull and boxes lie
///   outside it. Points that are not finite are left out.
/// - A label's distance from its anchor is the length of the leader line up to the hull.
/// - Nudges lead towards larger t. A label's predecessor is the label before it in the order of t, which begins after
///   the widest gap.
/// - An exchange that brings two labels nearer is made only if it adds no conflict.
/// - A label that meets a nearer one after the rounds tries its home and the places up to an eighth of a turn after
///   it. A label that is hidden stands at its home, and takes no part in the rounds of the next layout.
/// - Labels that are kept then return towards their homes and exchange their places while that is nearer and free. So
///   a layout from this one changes nothing.
/// - The second segment of a leader line lies on the normal through the box's centre. The line is straight while the
///   label is at its home.
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
            places[i].hidden = Some(Hidden::OutsideFrame);
        }
        return AnnotationLayout { annotations: places, relocations: Vec::new() };
    };
    let labels = order.iter().map(|&i| {
        let previous = previous.and_then(|layout| layout.annotations.get(i));
        Label::new(i, all[i], previous, &hull)
    });
    let mut table = Table {
        labels: labels.collect(),
        hull,
        frame: page.frame,
        obstacles: &page.obstacles,
        relocations: Vec::new(),
    };
    table.resolve(page.rounds);
    table.keep(page.rounds);
    for Label { index, given, home, place, hidden, .. } in table.labels {
        let opacity = opacity(given.depth, [nearest, farthest].map(|i| all[i].depth), page.least_opacity);
        let leader = [place.hull.at, place.end];
        places[index] =
            PlacedAnnotation { t: place.hull.t, home: Some(home), corners: place.corners, leader, opacity, hidden };
    }
    AnnotationLayout { annotations: places, relocations: table.relocations }
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
    /// Whether its home moved to another side.
    changed_side: bool,
}

impl Label {
    /// A label before the rounds: at its home, or moved from it as in the previous layout.
    fn new(index: usize, given: Annotation, previous: Option<&PlacedAnnotation>, hull: &RadialHull) -> Self {
        let anchor = given.anchor;
        let nearest = hull.nearest(anchor);
        let (mut home, mut start, mut changed_side) = (nearest.t, nearest.t, false);
        if let Some((previous, old)) = previous.and_then(|previous| previous.home.map(|home| (previous, home))) {
            // A side is the local minimum of the distance that the old home leads to. If that is far away, the home
            // stays where it was.
            let minimum = hull.nearest_from(old, anchor);
            let turn = wrapped(minimum.t - old);
            let side = if turn.min(1.0 - turn) <= MARGIN { minimum } else { hull.at(old) };
            changed_side = side.at.distance(anchor) > nearest.at.distance(anchor) + MARGIN * hull.diameter;
            if !changed_side {
                home = side.t;
                let is_moved = previous.hidden.is_none() && previous.t != old;
                start = if is_moved { wrapped(previous.t + (home - old)) } else { home };
            }
        }
        let hidden = previous.and_then(|previous| previous.hidden);
        Self { index, given, home, place: Place::new(hull, hull.at(start), &given), hidden, changed_side }
    }
}

/// The labels of a page, from the nearest anchor to the farthest.
struct Table<'a> {
    labels: Vec<Label>,
    hull: RadialHull,
    frame: [DVec2; 2],
    obstacles: &'a [[DVec2; 2]],
    relocations: Vec<Relocation>,
}

impl Table<'_> {
    /// The three steps of 6.4, in rounds until nothing changes. Labels that the previous layout hid take no part.
    fn resolve(&mut self, rounds: usize) {
        let sides = self.labels.iter().filter(|label| label.changed_side);
        self.relocations = sides.map(|label| Relocation::ChangeOfSide(label.index)).collect();
        for _ in 0..rounds {
            let uncrossed = self.exchange(Self::crosses);
            let nearer = self.exchange(Self::is_nearer);
            if !(self.nudge() | uncrossed | nearer) {
                break;
            }
        }
    }

    /// Exchanges the hull points of pairs for which a condition holds, and tells whether there are any.
    fn exchange(&mut self, condition: fn(&Self, usize, usize) -> bool) -> bool {
        let mut any = false;
        for j in 0..self.labels.len() {
            for i in 0..j {
                if self.is_shown(i) && self.is_shown(j) && condition(self, i, j) {
                    let [at_i, at_j] = self.exchanged(i, j);
                    (self.labels[i].place, self.labels[j].place) = (at_i, at_j);
                    let [i, j] = [i, j].map(|i| self.labels[i].index);
                    self.report(Relocation::Exchange(i.min(j), i.max(j)));
                    any = true;
                }
            }
        }
        any
    }

    /// Step 1: lines cross, and are shorter together once they are exchanged.
    fn crosses(&self, i: usize, j: usize) -> bool {
        let [a, b] = [&self.labels[i].place, &self.labels[j].place];
        a.crosses(b) && a.anchor.distance(b.hull.at) + b.anchor.distance(a.hull.at) < a.distance() + b.distance()
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
                self.relocate(pair[1], Place::new(&self.hull, at, &label.given), Relocation::Nudge);
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
            let free = (0..=NUDGES).map(|steps| self.nudged(i, steps)).find(|place| conflict(place).is_none());
            self.labels[i].hidden = if free.is_none() { conflict(&home) } else { None };
            match free {
                Some(place) => self.relocate(i, place, Relocation::Nudge),
                None => self.labels[i].place = home,
            }
        }
    }

    /// Moves labels that are kept to the first free place after their homes, if it is nearer to their anchors. Tells
    /// whether there are any.
    fn return_home(&mut self) -> bool {
        let mut any = false;
        for i in 0..self.labels.len() {
            let distance = self.labels[i].place.distance();
            if self.is_shown(i) && self.labels[i].place.hull.t != self.labels[i].home {
                let places = (0..=NUDGES).map(|steps| self.nudged(i, steps));
                let mut nearer = places.take_while(|place| place.distance() < distance);
                if let Some(place) = nearer.find(|place| self.conflict(i, place, 0..self.labels.len()).is_none()) {
                    self.relocate(i, place, Relocation::Return);
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
    fn nudged(&self, i: usize, nudges: usize) -> Place {
        let label = &self.labels[i];
        Place::new(&self.hull, self.hull.at(wrapped(label.home + nudges as f64 * NUDGE)), &label.given)
    }

    /// Whether a place is within the frame and covers no obstacle.
    fn is_free(&self, place: &Place) -> bool {
        place.is_within(self.frame) && !self.obstacles.iter().any(|obstacle| place.covers(*obstacle))
    }

    fn is_shown(&self, i: usize) -> bool {
        self.labels[i].hidden.is_none()
    }

    /// Moves a label and reports it.
    fn relocate(&mut self, i: usize, place: Place, relocation: fn(usize) -> Relocation) {
        self.labels[i].place = place;
        self.report(relocation(self.labels[i].index));
    }

    fn report(&mut self, relocation: Relocation) {
        if !self.relocations.contains(&relocation) {
            self.relocations.push(relocation);
        }
    }
}
