//! The data that a shot names.

use drypoint_scene::backdrop::Backdrop;
use drypoint_scene::intersection_picture::IntersectionPicture;
use drypoint_scene::measured::Measured;
use drypoint_scene::mesh::TriangleMesh;
use drypoint_scene::style::Style;
use drypoint_scene::volume::Selection;
use drypoint_scene::volume::labels::LabelVolume;

/// The data that a shot names, beside the volume's numbers.
#[derive(Clone, Debug)]
pub struct Inputs<'a> {
    /// The volume: its grid and its mask.
    pub volume: &'a drypoint_scene::volume::Volume,
    /// The facts of the volume.
    pub measured: &'a Measured,
    /// The labels beside the volume, where the function reads them ([STF-13]).
    pub labels: Option<&'a LabelVolume>,
    /// The further volumes that the function is over, one for each of its quantities that is one ([STF-4]).
    pub further: [Option<&'a drypoint_scene::volume::Volume>; 2],
    /// The styles that the function names, then those of caps.
    pub styles: &'a [Style],
    /// The background.
    pub background: Backdrop<'a>,
    /// The meshes of the shot, in its order, in the world ([VS-12]).
    pub meshes: &'a [TriangleMesh],
    /// Whether frames can have lines inside the volume ([HATCH-14] d).
    pub has_lines: bool,
    /// The data that the shot's objects name ([VS-2]).
    pub objects: ObjectInputs<'a>,
}

/// The data that the objects of a shot name, each list in the shot's order.
#[derive(Clone, Debug, Default)]
pub struct ObjectInputs<'a> {
    /// The data of selections and ghosts.
    pub parts: Vec<PartInputs<'a>>,
    /// The selection volumes; none where the selection is another one.
    pub selections: Vec<Option<&'a Selection>>,
    /// The pictures of intersections whose colour is one.
    pub pictures: Vec<Option<&'a IntersectionPicture>>,
}

/// The data that a selection or a ghost names.
#[derive(Clone, Debug)]
pub struct PartInputs<'a> {
    /// The data of the part as a picture of its own.
    pub inputs: Inputs<'a>,
    /// The place of its volume among those that are uploaded.
    pub place: usize,
}
