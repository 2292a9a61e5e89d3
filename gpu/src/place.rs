//! The place of a volume in a picture.

use drypoint_scene::glam::{DMat3, DVec3};
use drypoint_scene::shot::{Shot, StepAlong};
use drypoint_scene::space::Grid;

/// The place of a volume as it is drawn.
#[derive(Clone, Debug)]
pub(crate) struct GridPlacement {
    /// Its grid at that place.
    pub(crate) grid: Grid,
    /// The box of its samples in index space.
    pub(crate) index_box: [DVec3; 2],
    /// The plane from which planes are counted, which is that of the picture's volume.
    pub(crate) anchor: f64,
    /// The smallest voxel side of the picture's volume, in world units.
    pub(crate) voxel: f64,
    /// The transpose of L_T of [VS-2], which maps gradients of the volume to those of the moved field; none if it is
    /// not moved.
    pub(crate) moved: Option<DMat3>,
}

impl GridPlacement {
    /// The place of the picture's own volume.
    pub(crate) fn own(shot: &Shot, grid: &Grid) -> Self {
        let (anchor, voxel) = (anchor(shot, grid), grid.voxel());
        Self { grid: grid.clone(), index_box: grid.index_box(), anchor, voxel, moved: None }
    }

    /// The place of another grid in the picture. `axes` are those of its data, which differ if it is moved.
    pub(crate) fn beside(&self, grid: Grid, axes: DMat3) -> Self {
        // L_T maps vectors of the picture's world to those of the data's.
        let moved = (grid.axes() != axes).then(|| (axes * grid.inverse_axes()).transpose());
        Self { index_box: grid.index_box(), grid, moved, ..*self }
    }
}

/// The plane in the middle of the volume, counted from the eye, from which shaders count planes.
pub(crate) fn anchor(shot: &Shot, grid: &Grid) -> f64 {
    let Shot { view, lattice, .. } = shot;
    let centre = view.to_eye(grid.centre());
    let away = if view.perspective && lattice.along == StepAlong::Ray { centre.length() } else { -centre.z };
    (away / lattice.step).floor()
}
