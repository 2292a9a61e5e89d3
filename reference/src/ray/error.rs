//! Errors of pictures.

use super::lattice::{MOST_ACROSS, MOST_SAMPLES};
use crate::field::FieldError;
use crate::transfer::NodesError;

/// An error that prevents a picture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RenderError {
    /// The field cannot be reconstructed as the scene asks.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// Sample planes coincide ([RAY-1]). From 2⁵² on k + ½ is not a number of f64.
    #[error("the volume reaches {planes:.1e} steps from the eye; f64 cannot distinguish sample planes that far away")]
    TooManyPlanes {
        /// The largest distance from the eye, in steps.
        planes: f64,
    },
    /// A volume with so many steps across that a single ray, which cannot be interrupted, takes long.
    #[error("the volume is about {steps:.1e} steps across, and at most {MOST_ACROSS:.0e} are drawn")]
    TooManySteps {
        /// Steps along the longest diagonal of its box.
        steps: f64,
    },
    /// More samples than can be evaluated in months.
    #[error("the rays have about {samples:.1e} samples, more than {:.0e}; the picture would take months", MOST_SAMPLES)]
    Endless {
        /// Samples of all rays, if none is skipped.
        samples: f64,
    },
    /// The nodes do not make a function.
    #[error(transparent)]
    Nodes(#[from] NodesError),
    /// The function is over a further volume, which was not handed over.
    #[error("the transfer function is over a further volume, and none was loaded")]
    NoFurtherVolume,
    /// The function reads labels, which were not handed over.
    #[error("the transfer function reads labels, and there are none")]
    NoLabels,
    /// No voxel has the label to which a distance is measured.
    #[error("no voxel has the label {id}")]
    NoSuchLabel {
        /// The label.
        id: u32,
    },
    /// A frame of another size than the picture behind it.
    #[error("the picture behind the volume was not stretched to {} × {} pixels", size[0], size[1])]
    BackdropSize {
        /// The frame's size.
        size: [usize; 2],
    },
    /// The data of objects were not handed over.
    #[error("the shot has objects whose data were not handed over")]
    NoObjects,
    /// Objects in a picture of a phantom's formula.
    #[error("objects are drawn from voxels: there is no picture of a phantom's formula with objects")]
    ExactObjects,
    /// A motion moves an object out of the range of numbers.
    #[error("the motion of an object leaves the range of numbers")]
    Motion,
    /// The function and the material do not fit.
    #[error("material and transfer function do not match: one has colours, the other styles")]
    Material,
    /// The function's nodes and the styles do not fit.
    #[error("the transfer function names {named} styles, {given} were loaded")]
    Styles {
        /// Styles that the function names.
        named: usize,
        /// Styles that were handed over.
        given: usize,
    },
}
