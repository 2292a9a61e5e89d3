//! The tables of a scene file ([SCN-1] … [SCN-4]), one file each, and the scene that they make.
//!
//! A file declares its keys once, with the macros of `document::declare`: field, default, doc comment, rule and kind.
//! Checking, `--full`, the schema and the reference page are made from that. The needs of a table and its knobs stand
//! beside the plan (`plan::rules`), since they read the whole scene.

pub mod annotation;
pub mod camera;
pub mod clip;
pub mod combine;
pub mod contours;
mod dab;
pub mod figure;
pub mod halo;
mod halo_presets;
pub mod hatching;
pub mod intersection;
pub mod mesh;
pub mod nodes;
pub mod object;
pub mod orbit;
pub mod outlines;
pub mod over;
pub mod page;
pub mod pen;
pub mod picture;
mod preset;
pub(crate) mod root;
pub mod sampling;
pub mod scene;
pub mod shading;
pub mod stipples;
pub mod style_mipmaps;
pub mod styles;
pub mod surface;
pub mod toon;
mod toon_presets;
pub mod transfer;
mod transfer_rules;
mod unit_pairs;
pub mod volume;

pub use crate::length::Length;
pub use annotation::{
    AnnotatedPlace, Annotations, ArrowEnds, ArrowTable, BoxShown, BoxTable, Corner, FanShape, FanTable, LabelAnchor,
    LabelLayout, LabelSource, LabelTable, LabelsTable, Legend, LegendEntry, LegendRow, LineStyle, Orientation,
    ScaleBar,
};
pub use camera::{Camera, Projection};
pub use clip::{Clip, ClipSpace};
pub use combine::{Combine, Fuzzy};
pub use contours::{Contours, Kappa, SignFlip};
pub use dab::Dab;
pub use figure::{Figure, FigureSettings, Inset, Panel, PanelCameras, PanelLetters, PanelSource};
pub use halo::{
    Exponents, FocusPoints, Halo, HaloAccumulation, HaloFocus, HaloKind, HaloSource, ProfileNode, SeedBy,
    SeedDirection, SeedValue, Seeding, Spreading,
};
pub use hatching::{
    DirectionRule, DirectionSource, Directions, Family, HatchIso, HatchStyle, Hatching, Hidden, Interpolate,
    LineLighting, Reference, SeedsBy, Spacing, StoredAt, StrokeStyle,
};
pub use intersection::{IntersectionColor, IntersectionOpacity, IntersectionTable, Opposite};
pub use mesh::MeshTable;
pub use nodes::{Row, RowAt, Stand};
pub use object::{
    Brush, Connectivity, Cut, GhostTable, InteractionState, Motion, ObjectTable, PaintMode, PaintStroke, PaintTarget,
    PartName, Role, Rotation,
};
pub use orbit::Orbit;
pub use outlines::{Crease, Outlines};
pub use over::{Axis, LabelKey, Over};
pub use page::{PageSettings, PageText};
pub use pen::PenSettings;
pub use picture::{Background, BlendSpace, PictureSettings, RaysPerPixel};
pub use sampling::{GradientEstimator, HessianEstimator, Kernel, NormalSide, Number, Sampling, StepAlong};
pub use scene::Scene;
pub use shading::{LightDirection, Shading, ShadingModel};
pub use stipples::{
    Boundary, Curves, CurvesTest, Distance, DotColor, DotDensity, Even, FactorRange, Ink, Interior, Lighting,
    PointsPerPixel, Resolution, Silhouette, Snap, StippleGradient, StippleOrder, Stipples, Threshold,
};
pub use style_mipmaps::StyleMipmaps;
pub use styles::{StyleFile, StyleSource, Styles};
pub use surface::{Iso, Surface, SurfaceLook};
pub use toon::{SilhouetteShading, Tone, ToonShading};
pub use transfer::{Mix, Node, NodeColor, SphereFrame, Table, Transfer, TransferKind, Transparency, Unit};
pub use volume::{
    GradientRange, Ids, Keep, LabelLookup, Outside, PartsTable, PhantomSource, RawLayout, VolumeSource, VolumeTable,
};
