//! The tables of a scene file ([SCN-1] … [SCN-4]), one file each, and the scene that they make.

pub mod camera;
pub mod contours;
pub mod length;
pub mod picture;
pub mod sampling;
pub mod shading;
pub mod styles;
pub mod transfer;
pub mod volume;

pub use camera::{Camera, Projection};
pub use contours::{Contours, Kappa, SignFlip};
pub use length::Length;
pub use picture::{Background, BlendSpace, PictureSettings};
pub use sampling::{GradientEstimator, HessianEstimator, Kernel, NormalSide, Number, Sampling, StepAlong};
pub use shading::{LightDirection, Shading};
pub use styles::{StyleFile, StyleSource, Styles};
pub use transfer::{Mix, Node, NodeColor, SphereFrame, Table, Transfer, TransferKind, Transparency, Unit};
pub use volume::{GradientRange, Outside, PhantomSource, RawLayout, VolumeSource, VolumeTable};

/// Everything that a picture is made of, with every default filled in. A table that is absent here is an effect that
/// does not exist ([SCN-1]).
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Towards the light, for all that is lit and says nothing else.
    pub light: LightDirection,
    /// What is seen.
    pub volume: VolumeTable,
    /// From where.
    pub camera: Camera,
    /// On what.
    pub picture: PictureSettings,
    /// How the field is sampled.
    pub sampling: Sampling,
    /// Colours or styles and opacities over the values; none: the volume itself is not drawn.
    pub transfer: Option<Transfer>,
    /// The styles that the transfer function names.
    pub styles: Styles,
    /// Blinn–Phong shading of a regular transfer function; none: unshaded.
    pub shading: Option<Shading>,
    /// Style contours; none: no contour.
    pub contours: Option<Contours>,
}
