//! `[combine]`: the fuzzy operators by which objects are combined ([VS-3]).

use crate::document::declare::{choices, table};
use crate::document::describe::Table;

table! {
    /// The table `[combine]`.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Combine {
        /// The operators of fuzzy sets.
        fuzzy: Fuzzy = Fuzzy::Zadeh, key("VS-3", Fuzzy::KIND);
    }
}

choices! {
    /// Operators of fuzzy sets ([VS-3]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
    pub enum Fuzzy {
        /// Intersection min, union max: the paper's. Opacities dip to ½ where a soft selection begins.
        Zadeh = "zadeh",
        /// Intersection ab, union a + b − ab; a selection and the background share what both are made of, without a dip.
        Product = "product",
    }
}

/// The description of `[combine]`.
pub(crate) static TABLE: Table<Combine> = Combine::description(
    "[combine]",
    "How objects are combined where they lie at the same place. It acts where the scene has [[object]] tables.",
);
