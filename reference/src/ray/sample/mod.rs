//! A sample: its query, its attributes, and the resulting colour and opacity. Compositing is elsewhere.

mod attributes;
mod cut;
mod evaluate;
mod lit;
pub(super) mod need;
mod object;
mod over_two;
mod seeds;
mod shaded;
mod shader;

pub(super) use attributes::{EyeAxes, SampleAttributes, ViewDirs};
pub(super) use cut::{CutFace, CutSample, PreparedClip};
pub(super) use evaluate::{Evaluator, Previous, Sample};
pub(super) use lit::Lit;
pub(super) use object::{PreparedObject, turned};
pub(super) use over_two::OverTwo;
pub(super) use shader::{Camera, SampleShader, Styled};
