//! The layout of annotations (6.4, [VS-10]): boxes of labels around the convex hull of what is annotated.

mod hull;
mod layout;
mod place;

pub use layout::layout;

#[cfg(test)]
mod tests;
