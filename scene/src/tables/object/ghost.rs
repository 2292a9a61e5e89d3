//! `ghost` of an object: the look of the selection at its original place ([VS-2]).

use crate::document::declare::table;
use crate::document::describe::Table;
use crate::document::kind::TableOf;
use crate::quantity::Quantity;
use crate::tables::{Shading, Styles, Transfer, shading, styles, transfer};

table! {
    /// The table `ghost` of an object.
    #[derive(Clone, Debug, PartialEq)]
    pub struct GhostTable {
        /// Colours or styles, and opacities.
        transfer: Option<Transfer> = None,
            key("VS-2", TableOf(&transfer::TABLE)).absent("the object's").needs(&[Quantity::Value]);
        /// The lit-sphere pictures that its function names, over those of the object.
        styles: Option<Styles> = None, key("VS-2", TableOf(&styles::TABLE)).absent("the object's");
        /// Light on a regular function.
        shading: Option<Shading> = None,
            key("VS-2", TableOf(&shading::TABLE)).absent("the object's").needs(&[Quantity::Gradient]);
    }
}

/// The description of `ghost`.
pub(super) static TABLE: Table<GhostTable> = GhostTable::description(
    "ghost of an object",
    "The look of the ghost, which stays where the selection was moved from. Each table that is missing is the object's.",
);
