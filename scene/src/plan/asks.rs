//! Collectors that the rules of a table write to: needs, and keys without effect.

use super::{IdleKey, Need, Pass, PassNeed, Samples};
use crate::document::Place;
use crate::quantity::Quantity;
use crate::tables::Scene;

/// The parts of a scene that are drawn, if it has them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Drawn {
    pub(super) volume: bool,
    pub(super) points: bool,
    pub(super) strokes: bool,
}

/// A table of a scene, or an item of a list of tables.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct At {
    /// The table's key from the top, such as `contours` or `pen[0]`; empty for the top itself.
    pub(crate) key: String,
    /// The item's index, from 0, if the table is one of a list.
    pub(crate) item: Option<usize>,
}

impl At {
    /// A key of the table, from the top.
    pub(crate) fn inner(&self, key: &str) -> String {
        format!("{}.{key}", self.key)
    }
}

/// Collects what the effects of a scene need.
#[derive(Debug)]
pub(crate) struct Asks<'a> {
    pub(super) scene: &'a Scene,
    pub(super) drawn: Drawn,
    /// The table whose rules run.
    pub(crate) at: At,
    pub(super) needs: Vec<Need>,
    pub(super) passes: Vec<PassNeed>,
}

impl Asks<'_> {
    /// An effect needs a quantity at every visible sample, because of a key.
    pub(crate) fn need(&mut self, quantity: Quantity, effect: &str, key: &str) {
        self.need_at(quantity, Samples::Visible, effect, key);
    }

    /// An effect needs a quantity at some samples, because of a key.
    pub(crate) fn need_at(&mut self, quantity: Quantity, samples: Samples, effect: &str, key: &str) {
        let place = self.place(key);
        let item = self.at.item;
        self.needs.push(Need { quantity, samples, effect: effect.into(), item, key: key.into(), place });
    }

    /// An effect needs a pass, because of a key.
    pub(crate) fn pass(&mut self, pass: Pass, effect: &str, key: &str) {
        self.pass_where(pass, false, effect, key);
    }

    /// An effect needs a pass, if the file is of integers or in any case, because of a key.
    pub(crate) fn pass_where(&mut self, pass: Pass, integer_only: bool, effect: &str, key: &str) {
        let place = self.place(key);
        let item = self.at.item;
        self.passes.push(PassNeed { pass, integer_only, effect: effect.into(), item, key: key.into(), place });
    }

    /// Returns the place of a key in the scene, or else that of the table around it.
    fn place(&self, key: &str) -> Option<Place> {
        let outer = key.rsplit_once(['.', '[']).map(|(outer, _)| outer);
        let given = &self.scene.given;
        let said = given.place(key).or_else(|| outer.and_then(|outer| given.place(outer)));
        said.cloned().or_else(|| given.is_chosen(key).then_some(Place::Chosen))
    }

    /// Whether the volume itself is drawn.
    pub(crate) fn casts_rays(&self) -> bool {
        self.passes.iter().any(|need| need.pass == Pass::Rays)
    }

    /// Whether stipples are drawn, if the scene has some.
    pub(crate) fn draws_points(&self) -> bool {
        self.drawn.points
    }

    /// Whether strokes of hatching are drawn, if the scene has some. Outlines are drawn with dots and with strokes.
    pub(crate) fn draws_strokes(&self) -> bool {
        self.drawn.strokes
    }

    /// Whether an effect needs a pass.
    pub(crate) fn has_pass(&self, pass: Pass) -> bool {
        self.passes.iter().any(|need| need.pass == pass)
    }

    /// The first need of a quantity, if an effect needs it.
    pub(crate) fn first(&self, quantity: Quantity) -> Option<&Need> {
        self.needs.iter().find(|need| need.quantity == quantity)
    }

    /// Adds the quantities that needed quantities are made of, for the same samples and the first effect that needs
    /// them.
    pub(super) fn close(&mut self) {
        const ALL: [Samples; 3] = [Samples::Visible, Samples::First, Samples::Seeds];
        for (quantity, samples) in Quantity::ALL.into_iter().rev().flat_map(|q| ALL.map(|samples| (q, samples))) {
            let is = |need: &Need, quantity| need.quantity == quantity && need.samples == samples;
            let need = self.needs.iter().find(|need| is(need, quantity));
            let (Some(need), Some(prerequisite)) = (need, quantity.prerequisite()) else { continue };
            // What every visible sample has, the first one has. The value is one of every sample, seen or not.
            let is_covered = |need: &Need| {
                let covers =
                    need.samples == Samples::Visible && (samples == Samples::First || prerequisite == Quantity::Value);
                is(need, prerequisite) || (need.quantity == prerequisite && covers)
            };
            if !self.needs.iter().any(is_covered) {
                let need = Need { quantity: prerequisite, ..need.clone() };
                self.needs.push(need);
            }
        }
    }
}

/// Collects keys without effect.
#[derive(Debug)]
pub(crate) struct Idle<'a> {
    pub(super) scene: &'a Scene,
    /// The table whose rules run.
    pub(crate) at: At,
    pub(super) keys: Vec<IdleKey>,
}

impl Idle<'_> {
    /// Whether the scene has a key or table.
    pub(crate) fn says(&self, key: &str) -> bool {
        self.scene.given.contains(key)
    }

    /// Returns the keys in the order of the scene.
    pub(super) fn sorted(mut self) -> Vec<IdleKey> {
        self.keys.sort_by(|a, b| (&a.place, &a.key).cmp(&(&b.place, &b.key)));
        self.keys
    }

    /// Lists a key or table that has no effect, if the scene has it.
    pub(crate) fn key(&mut self, key: &str, why: &str) {
        if let Some(place) = self.scene.given.place(key) {
            self.keys.push(IdleKey { key: key.into(), place: place.clone(), why: why.into() });
        }
    }
}
