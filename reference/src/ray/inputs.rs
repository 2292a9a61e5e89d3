//! The data that a picture is made of, and what can be wrong with it.

use super::lattice::MOST_SAMPLES;
use crate::field::FieldError;
use crate::transfer::NodesError;
pub use drypoint_scene::backdrop::Backdrop;
use drypoint_scene::mesh::TriangleMesh;
use drypoint_scene::style::Style;
use drypoint_scene::volume::Volume;
use drypoint_scene::volume::labels::LabelVolume;

/// The data that a shot names.
#[derive(Clone, Copy, Debug)]
pub struct Inputs<'a> {
    /// The volume.
    pub volume: &'a Volume,
    /// The labels beside the volume, where the function reads them ([STF-13]).
    pub labels: Option<&'a LabelVolume>,
    /// The further volumes that the function is over, one for each of its quantities that is one ([STF-4]).
    pub further: [Option<&'a Volume>; 2],
    /// The styles that the function names, in the order of [`Function::Style::names`](drypoint_scene::transfer::Function::Style::names),
    /// then those that caps name, in the order of [`Clipping::styles`](drypoint_scene::shot::Clipping::styles).
    pub styles: &'a [Style],
    /// The meshes of the shot, in its order, in the world ([VS-12]).
    pub meshes: &'a [TriangleMesh],
    /// The background.
    pub background: Backdrop<'a>,
}

/// A picture that cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RenderError {
    /// The field cannot be reconstructed as the scene asks.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// Sample planes that fall together ([RAY-1]): k + ½ has no half from 2⁵² on.
    #[error("the volume reaches {planes:.1e} steps from the eye; f64 cannot distinguish sample planes that far away")]
    TooManyPlanes {
        /// The largest distance from the eye, in steps.
        planes: f64,
    },
    /// More samples than can be evaluated in months.
    #[error("the rays have about {samples:.1e} samples, more than {:.0e}; the picture would take months", MOST_SAMPLES)]
    Endless {
        /// Samples of all rays, if none is skipped.
        samples: f64,
    },
    /// The nodes make no function.
    #[error(transparent)]
    Nodes(#[from] NodesError),
    /// A quantity of the function is a volume that was not handed over.
    #[error("the transfer function is over a further volume, and none was loaded")]
    NoFurtherVolume,
    /// A quantity of the function reads labels, and there are none.
    #[error("the transfer function reads labels, and there are none")]
    NoLabels,
    /// A distance to a label that no voxel has.
    #[error("no voxel has the label {id}")]
    NoSuchLabel {
        /// The label.
        id: u32,
    },
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
