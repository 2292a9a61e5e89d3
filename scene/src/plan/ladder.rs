//! The settings of keys that trade accuracy for time ([COST-1]).

use super::Plan;
use crate::tables::Scene;

/// The picture that the settings of a knob converge to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// The picture of the field itself, which is known if the field is a formula ([COST-2]).
    Field,
    /// The picture at the finest setting, whatever the field is.
    Finest,
}

/// Settings of a key from coarse to fine; none where the scene does not use the key.
pub(crate) type Settings = &'static [&'static str];

/// The settings of a key, as the rules of its table declare them.
#[derive(Clone, Copy)]
pub(crate) struct Ladder {
    pub(crate) limit: Limit,
    /// The settings in a scene, for an item of a list of tables with its number.
    pub(crate) settings: fn(&Scene, &Plan, Option<usize>) -> Settings,
}

impl Ladder {
    /// Returns the settings of a key that decides how close the samples come to the field, or their sum to its integral.
    pub(crate) const fn to_field(settings: fn(&Scene, &Plan, Option<usize>) -> Settings) -> Self {
        Self { limit: Limit::Field, settings }
    }

    /// Returns the settings of a key that does not concern the field.
    pub(crate) const fn to_finest(settings: fn(&Scene, &Plan, Option<usize>) -> Settings) -> Self {
        Self { limit: Limit::Finest, settings }
    }
}
