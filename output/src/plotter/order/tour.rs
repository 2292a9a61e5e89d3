//! Tours: strokes in an order, each drawn forwards or backwards.

use drypoint_scene::glam::DVec2;

/// An order of strokes for a pen that starts at `from` and stays where it ends.
#[derive(Clone)]
pub(super) struct Tour {
    from: DVec2,
    ends: Vec<[DVec2; 2]>,
    order: Vec<TourStop>,
    /// Position of each stroke in the order.
    position: Vec<usize>,
}

/// One stroke of a tour.
#[derive(Clone, Copy)]
pub(super) struct TourStop {
    /// Index of the stroke.
    pub(super) item: usize,
    /// Whether the stroke is drawn backwards.
    pub(super) turned: bool,
}

impl Tour {
    /// Makes the tour of strokes in the given order, drawn forwards.
    pub(super) fn new(ends: Vec<[DVec2; 2]>, from: DVec2) -> Self {
        let order = (0..ends.len()).map(|item| TourStop { item, turned: false }).collect();
        Self { from, order, position: (0..ends.len()).collect(), ends }
    }

    /// Returns the same strokes in another order, drawn forwards.
    pub(super) fn reordered(&self, items: impl Iterator<Item = usize>) -> Self {
        let mut tour = self.clone();
        tour.order = items.map(|item| TourStop { item, turned: false }).collect();
        tour.number(0, tour.order.len());
        tour
    }

    pub(super) fn len(&self) -> usize {
        self.order.len()
    }

    pub(super) fn ends(&self) -> &[[DVec2; 2]] {
        &self.ends
    }

    pub(super) fn stops(&self) -> impl Iterator<Item = TourStop> {
        self.order.iter().copied()
    }

    pub(super) fn item(&self, position: usize) -> usize {
        self.order[position].item
    }

    pub(super) fn position(&self, item: usize) -> usize {
        self.position[item]
    }

    /// Returns the point where the pen comes down for the stroke at a position.
    pub(super) fn start(&self, position: usize) -> DVec2 {
        let TourStop { item, turned } = self.order[position];
        self.ends[item][usize::from(turned)]
    }

    /// Returns the point where the pen is before the stroke at a position.
    pub(super) fn before(&self, position: usize) -> DVec2 {
        match position.checked_sub(1) {
            Some(last) => self.stop(last),
            None => self.from,
        }
    }

    /// Returns the point where the stroke at a position ends.
    pub(super) fn stop(&self, position: usize) -> DVec2 {
        let TourStop { item, turned } = self.order[position];
        self.ends[item][usize::from(!turned)]
    }

    /// Returns the distance from a point to the stroke at a position; 0 beyond the last.
    pub(super) fn on_to(&self, place: DVec2, position: usize) -> f64 {
        if position < self.order.len() { place.distance(self.start(position)) } else { 0.0 }
    }

    /// Returns the pen-up distance between all strokes.
    pub(super) fn length(&self) -> f64 {
        (0..self.order.len()).map(|i| self.before(i).distance(self.start(i))).sum()
    }

    /// Reverses the strokes at first … last: the last is drawn first, each backwards.
    pub(super) fn turn(&mut self, first: usize, last: usize) {
        self.order[first..=last].reverse();
        self.order[first..=last].iter_mut().for_each(|stop| stop.turned = !stop.turned);
        self.number(first, last + 1);
    }

    /// Moves the strokes at first … last before the one at `to`, and reverses them if asked. `to` lies outside first …
    /// last + 1.
    pub(super) fn shift(&mut self, first: usize, last: usize, to: usize, turned: bool) {
        let length = last + 1 - first;
        let at = if to > last {
            self.order[first..to].rotate_left(length);
            self.number(first, to);
            to - length
        } else {
            self.order[to..=last].rotate_right(length);
            self.number(to, last + 1);
            to
        };
        if turned {
            self.turn(at, at + length - 1);
        }
    }

    fn number(&mut self, from: usize, to: usize) {
        for i in from..to {
            self.position[self.order[i].item] = i;
        }
    }
}
