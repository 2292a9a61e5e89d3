//! Graphics cards of a library without the feature `gpu`: there is none.

/// A graphics card.
pub enum Gpu {}
