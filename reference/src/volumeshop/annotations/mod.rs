//! The layout of annotations (6.4, [VS-10]): boxes of labels around the convex hull of what is annotated, or in two
//! columns beside it.

mod columns;
mod hull;
mod layout;
mod place;
mod segments;

pub use columns::columns;
pub use layout::layout;

#[cfg(test)]
mod tests;
