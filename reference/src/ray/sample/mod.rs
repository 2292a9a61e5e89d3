//! A sample: what it is asked for, what is found, and which colour and opacity that gives. Nothing here composites.

mod attributes;
mod evaluate;
mod lit;
mod material;
pub(super) mod need;
mod object;
mod over_two;

pub use attributes::SampleAttributes;
pub(super) use attributes::{EyeAxes, ViewDirs};
pub(super) use evaluate::{Evaluator, Previous, Sample};
pub(super) use lit::Lit;
pub(super) use material::{Shader, Styled};
pub(super) use object::PreparedObject;
pub(super) use over_two::OverTwo;
