//! The labels of a page in two columns: which are shown, in which column, in which order.

use super::stack::{is_room, stack};
use crate::volumeshop::annotations::layout::MOST_ROUNDS;
use crate::volumeshop::annotations::segments::cross;
use drypoint_scene::annotations::{AnnotatedPage, Annotation, Hidden};
use drypoint_scene::glam::DVec2;
use std::cmp::Ordering;

/// The distance of a column from the hull's bounding box, as a fraction of the frame's diagonal. Leader lines bend
/// halfway.
const GAP: f64 = 1.0 / 40.0;
/// The margin that keeps a label in its column: a fraction of the width of the hull's bounding box ([VS-10]).
const MARGIN: f64 = 0.05;

/// One of the two columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Left,
    Right,
}

/// A label at its place in a column.
#[derive(Clone, Copy, Debug)]
pub(super) struct Standing {
    /// The label, as its place in the order of priority.
    pub(super) label: usize,
    pub(super) side: Side,
    /// The first segment of its leader line, from the anchor to the bend.
    pub(super) slant: [DVec2; 2],
    /// The end of the leader line at the box.
    pub(super) end: DVec2,
    /// Lower and upper corner of the box.
    pub(super) corners: [DVec2; 2],
}

impl Standing {
    /// The conflict of this label with another one, if any. Columns lie beside all lines up to their bends, and boxes of a
    /// column lie apart. So only lines from anchors to bends can cross.
    fn conflict(&self, other: &Self) -> Option<Hidden> {
        cross(self.slant, other.slant).then_some(Hidden::Crossing(other.label))
    }
}

/// A page with its labels in the order of priority.
pub(super) struct Sheet<'a> {
    pub(super) labels: Vec<Annotation>,
    frame: [DVec2; 2],
    obstacles: &'a [[DVec2; 2]],
    /// The hull's bounding box within the frame.
    bounds: [DVec2; 2],
    /// The middle of the bounding box. Columns are to its left and to its right.
    pub(super) middle: DVec2,
    gap: f64,
    rounds: usize,
}

impl<'a> Sheet<'a> {
    pub(super) fn new(page: &'a AnnotatedPage, labels: Vec<Annotation>) -> Self {
        let (frame, obstacles) = (page.frame, &page.obstacles);
        let [lower, upper] = frame;
        let outline = page.outline.iter().copied().filter(|point| point.is_finite());
        let points = outline.map(|point| point.max(lower).min(upper)).chain(labels.iter().map(|label| label.anchor));
        let bounds = points.fold([upper, lower], |[low, high], point| [low.min(point), high.max(point)]);
        let middle = bounds[0] / 2.0 + bounds[1] / 2.0;
        let (gap, rounds) = (lower.distance(upper) * GAP, page.rounds.min(MOST_ROUNDS));
        Self { frame, obstacles, bounds, middle, gap, rounds, labels }
    }

    /// The x of a column's inner edge.
    fn inner(&self, side: Side) -> f64 {
        match side {
            Side::Left => self.bounds[0].x - self.gap,
            Side::Right => self.bounds[1].x + self.gap,
        }
    }

    /// The heights that obstacles leave free to a column of a width, as intervals that ascend. There are none if the column
    /// leaves the frame.
    fn free(&self, side: Side, width: f64) -> Vec<[f64; 2]> {
        let ([lower, upper], inner) = (self.frame, self.inner(side));
        let [left, right] = if side == Side::Left { [inner - width, inner] } else { [inner, inner + width] };
        if left < lower.x || right > upper.x {
            return Vec::new();
        }
        let met = self.obstacles.iter().filter(|[low, high]| low.x < right && left < high.x);
        let mut taken: Vec<[f64; 2]> = met.map(|[low, high]| [low.y, high.y.min(upper.y)]).collect();
        taken.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let (mut free, mut start) = (Vec::new(), lower.y);
        for [low, high] in taken.into_iter().chain([[upper.y; 2]]) {
            if low > start {
                free.push([start, low.min(upper.y)]);
            }
            start = start.max(high);
        }
        free
    }

    /// Whether labels fit in a column.
    fn is_room(&self, side: Side, labels: &[usize]) -> bool {
        let sizes = labels.iter().map(|&label| self.labels[label].size);
        let width = sizes.clone().map(|size| size.x).fold(0.0, f64::max);
        is_room(sizes.map(|size| size.y), &self.free(side, width))
    }

    /// Whether a label fits in the left column, and whether in the right one, if it is alone.
    pub(super) fn fits(&self, label: usize) -> [bool; 2] {
        [Side::Left, Side::Right].map(|side| self.is_room(side, &[label]))
    }

    /// The x that decides on a label's column. It is farther on the side of the column in which the label was.
    ///
    /// Labels that fit in one column alone are infinitely far on its side.
    fn key(&self, label: usize, was: Option<Side>) -> f64 {
        let margin = MARGIN * (self.bounds[1].x - self.bounds[0].x);
        match (self.fits(label), was) {
            ([true, false], _) => f64::NEG_INFINITY,
            ([false, true], _) => f64::INFINITY,
            (_, Some(Side::Left)) => self.labels[label].anchor.x - margin,
            (_, Some(Side::Right)) => self.labels[label].anchor.x + margin,
            (_, None) => self.labels[label].anchor.x,
        }
    }

    /// The column in which a label stands if none is full.
    pub(super) fn side(&self, label: usize, was: Option<Side>) -> Side {
        if self.key(label, was) < self.middle.x { Side::Left } else { Side::Right }
    }

    /// The columns of some labels, in the order of the labels. Returns none if the labels do not fit.
    ///
    /// The labels are in the order of their keys: first those of the left column, then those of the right one. They part
    /// as near to the middle as both columns have room.
    fn split(&self, labels: &[usize], was: &[Option<Side>]) -> Option<Vec<Side>> {
        let keys: Vec<f64> = labels.iter().zip(was).map(|(&label, &was)| self.key(label, was)).collect();
        let mut order: Vec<usize> = (0..labels.len()).collect();
        order.sort_by(|&i, &j| keys[i].total_cmp(&keys[j]));
        // Number of labels that fit, from the start of the order and from its end.
        let fitting = |side: Side, order: &mut dyn Iterator<Item = &usize>| {
            let mut column = Vec::new();
            let grown = order.map(|&i| {
                let at = column.partition_point(|&other| self.is_above(other, labels[i]));
                column.insert(at, labels[i]);
                self.is_room(side, &column)
            });
            grown.take_while(|is_room| *is_room).count()
        };
        let forced = |key: f64| keys.iter().filter(|k| **k == key).count();
        let most = fitting(Side::Left, &mut order.iter()).min(labels.len() - forced(f64::INFINITY));
        let least = labels.len() - fitting(Side::Right, &mut order.iter().rev());
        let least = least.max(forced(f64::NEG_INFINITY));
        let wanted = keys.iter().filter(|key| **key < self.middle.x).count();
        (least <= most).then(|| {
            let left = wanted.max(least).min(most);
            let mut sides = vec![Side::Right; labels.len()];
            order[..left].iter().for_each(|&i| sides[i] = Side::Left);
            sides
        })
    }

    /// Places labels in their columns. Returns none if they do not fit.
    ///
    /// Labels that a full column gave away may return once they are kept in their new columns by the margin. So the
    /// columns are found again until they stay. From the second time on labels move in one direction only.
    pub(super) fn arrange(&self, labels: &[usize], was: &[Option<Side>]) -> Option<Vec<Standing>> {
        let mut sides = self.split(labels, was)?;
        for _ in 0..=labels.len() {
            let was: Vec<_> = sides.iter().map(|side| Some(*side)).collect();
            let next = self.split(labels, &was)?;
            if next == sides {
                break;
            }
            sides = next;
        }
        let column = |side: Side| {
            let labels: Vec<_> = labels.iter().zip(&sides).filter(|(_, s)| **s == side).map(|(l, _)| *l).collect();
            self.column(side, &labels)
        };
        Some([column(Side::Left)?, column(Side::Right)?].concat())
    }

    /// Whether a label's anchor is above another one's; of anchors at one height the nearer label's is.
    fn is_above(&self, label: usize, other: usize) -> bool {
        let [a, b] = [label, other].map(|label| self.labels[label].anchor.y);
        a < b || a == b && label < other
    }

    /// Places labels in one column, from the least y to the largest. Returns none if they do not fit.
    ///
    /// Boxes of equal heights in one free interval have no crossings after the exchanges at fixed bends: the boxes that
    /// touch exchange their anchors without moving. Other boxes move, so crossings may be left.
    pub(super) fn column(&self, side: Side, labels: &[usize]) -> Option<Vec<Standing>> {
        let mut order = labels.to_vec();
        order.sort_by(|&i, &j| if self.is_above(i, j) { Ordering::Less } else { Ordering::Greater });
        let mut standing = self.stand(side, &order)?;
        let exchanged = self.exchange_anchors(order.clone(), standing.clone());
        if let Some(found) = self.stand(side, &exchanged) {
            (order, standing) = (exchanged, found);
        }
        let mut least = tangle(&standing);
        // Each exchange leaves fewer crossings, or shorter lines with as many. So no order comes twice.
        for _ in 0..self.rounds {
            let before = least;
            for (i, j) in pairs(order.len()) {
                if cross(standing[i].slant, standing[j].slant) {
                    order.swap(i, j);
                    let exchanged = self.stand(side, &order);
                    match exchanged.map(|exchanged| (tangle(&exchanged), exchanged)) {
                        Some((found, exchanged)) if found < least => (standing, least) = (exchanged, found),
                        _ => order.swap(i, j),
                    }
                }
            }
            if least.0 == 0 || least == before {
                break;
            }
        }
        Some(standing)
    }

    /// Exchanges the anchors of lines that cross, while all bends stay. Returns the order.
    ///
    /// Each exchange shortens the lines, so no order comes twice.
    fn exchange_anchors(&self, mut order: Vec<usize>, mut standing: Vec<Standing>) -> Vec<usize> {
        for _ in 0..self.rounds {
            let mut any = false;
            for (i, j) in pairs(order.len()) {
                let [[a, p], [b, q]] = [standing[i].slant, standing[j].slant];
                let is_shorter = a.distance(q) + b.distance(p) < a.distance(p) + b.distance(q);
                if is_shorter && cross([a, p], [b, q]) {
                    (standing[i].slant, standing[j].slant) = ([b, p], [a, q]);
                    order.swap(i, j);
                    any = true;
                }
            }
            if !any {
                break;
            }
        }
        order
    }

    /// Places labels in one column in the given order. Returns none if they do not fit in this order.
    fn stand(&self, side: Side, order: &[usize]) -> Option<Vec<Standing>> {
        let sizes = || order.iter().map(|&label| self.labels[label].size);
        let free = self.free(side, sizes().map(|size| size.x).fold(0.0, f64::max));
        let inner = self.inner(side);
        let bend = if side == Side::Left { inner + self.gap / 2.0 } else { inner - self.gap / 2.0 };
        let wanted: Vec<_> = order.iter().zip(sizes()).map(|(&i, size)| [self.labels[i].anchor.y, size.y]).collect();
        let standing = stack(&wanted, &free)?.into_iter().zip(order).map(|(y, &label)| {
            let Annotation { anchor, size, .. } = self.labels[label];
            let x = if side == Side::Left { inner - size.x } else { inner };
            // Rounding may lead out of a free interval.
            let end = free.iter().map(|[_, high]| *high).find(|high| *high > y).unwrap_or(f64::INFINITY);
            let corners = [DVec2::new(x, y), DVec2::new(x + size.x, (y + size.y).min(end))];
            let level = corners[0].y / 2.0 + corners[1].y / 2.0;
            let [bend, end] = [bend, inner].map(|x| DVec2::new(x, level));
            Standing { label, side, slant: [anchor, bend], end, corners }
        });
        Some(standing.collect())
    }

    /// Whether labels have no conflict with each other.
    pub(super) fn are_free(&self, standing: &[Standing]) -> bool {
        pairs(standing.len()).all(|(i, j)| standing[j].conflict(&standing[i]).is_none())
    }

    /// The labels that are shown, and those that are left out with the reason, both in the order of priority.
    ///
    /// This is a function of the page alone. Each label is shown that fits with the ones before it.
    pub(super) fn choose(&self, candidates: &[usize]) -> (Vec<usize>, Vec<(usize, Hidden)>) {
        let (mut shown, mut left_out) = (Vec::new(), Vec::new());
        for &label in candidates {
            shown.push(label);
            if self.split(&shown, &vec![None; shown.len()]).is_none() {
                shown.pop();
                left_out.push((label, Hidden::NoRoom));
            }
        }
        let alone = |labels: &[usize]| self.arrange(labels, &vec![None; labels.len()]);
        if alone(&shown).is_some_and(|standing| self.are_free(&standing)) {
            return (shown, left_out);
        }
        let mut free = Vec::new();
        for label in shown {
            free.push(label);
            let standing = alone(&free).unwrap_or_default();
            if !(standing.len() == free.len() && self.are_free(&standing)) {
                free.pop();
                let own = standing.iter().find(|standing| standing.label == label);
                let others = standing.iter().filter(|standing| standing.label != label);
                let mut met: Vec<_> = others.filter_map(|other| own?.conflict(other)).collect();
                // The nearest label that it meets is named.
                met.sort_by_key(|met| if let Hidden::Overlap(j) | Hidden::Crossing(j) = met { *j } else { usize::MAX });
                left_out.push((label, met.first().copied().unwrap_or(Hidden::NoRoom)));
            }
        }
        left_out.sort_by_key(|(label, _)| *label);
        (free, left_out)
    }
}

/// All pairs i < j of some numbers from 0.
fn pairs(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(|j| (0..j).map(move |i| (i, j)))
}

/// Number of crossings of a column's lines, and their length.
fn tangle(standing: &[Standing]) -> (usize, f64) {
    let crossings = pairs(standing.len()).filter(|&(i, j)| cross(standing[i].slant, standing[j].slant)).count();
    (crossings, standing.iter().map(|standing| standing.slant[0].distance(standing.slant[1])).sum())
}
