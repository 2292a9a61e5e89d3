//! A tour: strokes in an order, each drawn forwards or backwards.

use drypoint_scene::glam::DVec2;

/// An order of strokes for a pen that comes from a place and stays where it ends.
#[derive(Clone)]
pub(super) struct Tour {
    from: DVec2,
    ends: Vec<[DVec2; 2]>,
    order: Vec<Stop>,
    /// Where in the order each stroke is.
    position: Vec<usize>,
}

/// One stroke of a tour.
#[derive(Clone, Copy)]
pub(super) struct Stop {
    /// Which stroke.
    pub(super) item: usize,
    /// Whether it is drawn backwards.
    pub(super) turned: bool,
}

impl Tour {
    /// Strokes in the order of their ends, drawn forwards.
    pub(super) fn new(ends: Vec<[DVec2; 2]>, from: DVec2) -> Self {
        let order = (0..ends.len()).map(|item| Stop { item, turned: false }).collect();
        Self { from, order, position: (0..ends.len()).collect(), ends }
    }

    /// The same strokes in another order, drawn forwards.
    pub(super) fn reordered(&self, items: impl Iterator<Item = usize>) -> Self {
        let mut tour = self.clone();
        tour.order = items.map(|item| Stop { item, turned: false }).collect();
        tour.number(0, tour.order.len());
        tour
    }

    pub(super) fn len(&self) -> usize {
        self.order.len()
    }

    pub(super) fn ends(&self) -> &[[DVec2; 2]] {
        &self.ends
    }

    pub(super) fn stops(&self) -> impl Iterator<Item = Stop> {
        self.order.iter().copied()
    }

    pub(super) fn item(&self, position: usize) -> usize {
        self.order[position].item
    }

    pub(super) fn position(&self, item: usize) -> usize {
        self.position[item]
    }

    /// Where the pen comes down for the stroke at a position.
    pub(super) fn start(&self, position: usize) -> DVec2 {
        let Stop { item, turned } = self.order[position];
        self.ends[item][usize::from(turned)]
    }

    /// Where the pen is before the stroke at a position.
    pub(super) fn before(&self, position: usize) -> DVec2 {
        match position.checked_sub(1) {
            Some(last) => self.stop(last),
            None => self.from,
        }
    }

    /// Where the stroke at a position leaves the pen.
    pub(super) fn stop(&self, position: usize) -> DVec2 {
        let Stop { item, turned } = self.order[position];
        self.ends[item][usize::from(!turned)]
    }

    /// Way from a place to the stroke at a position; beyond the last there is none.
    pub(super) fn on_to(&self, place: DVec2, position: usize) -> f64 {
        if position < self.order.len() { place.distance(self.start(position)) } else { 0.0 }
    }

    /// Way between the strokes.
    pub(super) fn length(&self) -> f64 {
        (0..self.order.len()).map(|i| self.before(i).distance(self.start(i))).sum()
    }

    /// Draws the strokes at first … last backwards, the last one first.
    pub(super) fn turn(&mut self, first: usize, last: usize) {
        self.order[first..=last].reverse();
        self.order[first..=last].iter_mut().for_each(|stop| stop.turned = !stop.turned);
        self.number(first, last + 1);
    }

    /// Moves the strokes at first … last to before the one at `to`, which lies outside first … last + 1, and turns them
    /// if asked.
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
