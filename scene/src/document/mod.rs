//! Documents in TOML, walked with their places against a description of their tables ([IO-3], [SCN-4]).
//!
//! Nothing here knows a scene: a description ([`describe::Table`]) stands with the table that it describes. The same
//! description makes the text with every default filled in, the JSON Schema and the reference page.

pub(crate) mod check;
mod css;
pub(crate) mod declare;
pub(crate) mod describe;
pub(crate) mod fault;
pub(crate) mod full;
pub(crate) mod item;
pub(crate) mod kind;
pub(crate) mod out;
pub(crate) mod place;
pub(crate) mod reference;
pub(crate) mod schema;
pub(crate) mod set;

pub use fault::{Fault, Faults, Problem};
pub use place::{Given, Place};
pub use set::Overrides;
