//! Intersections of rays and lines with iso-surfaces: the first root of f = iso, visibility, and the foot of a point
//! (Nagy et al. 2002, 4.3.2; [HATCH-7], [HATCH-14], [STIP-15]).
//!
//! The trilinear interpolation of a cell is a cubic along a line, whose first root is found. Other kernels are
//! evaluated every quarter of a voxel, and a change of sign is narrowed down to neighbouring numbers. A pair of roots
//! closer than that is missed.
//!
//! A root is a place where f − iso is 0 or changes its sign. So a plateau at the value begins where the line enters
//! it. A volume that equals iso everywhere is met at its face. A field that touches the value has a root if its
//! extremum, as computed, is at the value or beyond.
//!
//! Cells that touch a masked voxel contain no surface ([PREC-2]).

mod active;
mod clipped;
mod cubic;
mod first_root;
mod foot;
mod traversal;
mod visibility;

pub(crate) use clipped::{Clipped, SurfaceHit};
pub(crate) use cubic::bracketed;
pub(crate) use first_root::{RootFinder, STEP};

use crate::field::{Field, Rung, Sampler};
use drypoint_scene::clip::{ClipPlanes, NO_PLANES};
use drypoint_scene::glam::DVec3;
use drypoint_scene::measured::Measured;
use drypoint_scene::volume::BRICK;

/// The surface f = iso of a field.
///
/// ```
/// use drypoint_reference::field::{Field, Reconstruction, Rung};
/// use drypoint_reference::surface::IsoSurface;
/// use drypoint_scene::{glam::DVec3, space::Grid, volume::{Volume, Voxels}};
///
/// // f = x on a row of four voxels, 2 apart.
/// let grid = Grid::with_spacing([4, 2, 2], [2.0, 1.0, 1.0]).unwrap();
/// let values = (0..16).map(|i| f64::from(i % 4 * 2)).collect();
/// let volume = Volume::new(grid, Voxels::F64(values), 1.0, 0.0).unwrap();
/// let field = Field::new(&volume, Reconstruction::default(), Rung::Gradient).unwrap();
/// let surface = IsoSurface::new(&field, 4.5);
/// let (origin, direction) = (DVec3::new(10.0, 0.3, 0.7), DVec3::new(-1.0, 0.0, 0.0));
/// assert_eq!(surface.first_root(origin, direction, [0.0, 100.0]), Some(5.5));
/// assert_eq!(surface.first_root(origin, direction, [0.0, 5.0]), None);
/// ```
#[derive(Clone, Debug)]
pub struct IsoSurface<'f, 'v> {
    field: &'f Field<'v, f64>,
    roots: RootFinder,
    /// Planes that cut parts of the surface away.
    clip: &'f ClipPlanes,
}

impl<'f, 'v> IsoSurface<'f, 'v> {
    /// The surface of a field. The field must be prepared for gradients if feet are needed. The ranges of the field's
    /// bricks are computed at once, so that lines skip bricks that exclude the value.
    pub fn new(field: &'f Field<'v, f64>, iso: f64) -> Self {
        Self { field, roots: RootFinder::new(field, iso, Some(&field.bricks())), clip: &NO_PLANES }
    }

    /// Like [`new`](Self::new), but without the bricks' ranges: every cell on a line is tested. Results are the same
    /// ([RAY-2]).
    pub fn without_skipping(field: &'f Field<'v, f64>, iso: f64) -> Self {
        Self { field, roots: RootFinder::new(field, iso, None), clip: &NO_PLANES }
    }

    /// Cuts the surface by planes ([RAY-8]). Parts that are cut away hide nothing. Where the inside is cut open, the
    /// cut hides the points behind it. Roots and feet are those of the whole surface.
    pub fn clipped(self, clip: &'f ClipPlanes) -> Self {
        Self { clip, ..self }
    }

    /// The planes that cut the surface.
    pub fn clip(&self) -> &'f ClipPlanes {
        self.clip
    }

    /// The value of the surface.
    pub fn iso(&self) -> f64 {
        self.roots.iso()
    }

    /// The field of the surface.
    pub fn field(&self) -> &'f Field<'v, f64> {
        self.field
    }

    /// The facts of the field that another renderer needs to search the surface.
    pub fn measured(&self) -> Measured {
        Measured { bricks: Some(self.field.bricks()), ..self.field.measured(Rung::Gradient) }
    }

    /// The bricks of cells in which the field can have the value, in their order ([RAY-2]).
    pub(crate) fn bricks(&self) -> Vec<[usize; 3]> {
        self.roots.bricks().unwrap_or_else(|| {
            let [nx, ny, nz] = self.field.volume().dims().map(|n| (n.max(2) - 1).div_ceil(BRICK));
            (0..nx * ny * nz).map(|i| [i % nx, i / nx % ny, i / (nx * ny)]).collect()
        })
    }

    /// Size in bytes, without the field.
    pub fn bytes(&self) -> usize {
        self.roots.bytes()
    }

    /// The smallest t in a closed range at which origin + t·direction, in world space, is on the surface. The range may end
    /// at ±∞.
    pub fn first_root(&self, origin: DVec3, direction: DVec3, range: [f64; 2]) -> Option<f64> {
        let grid = self.field.volume().grid();
        self.first_root_in_index(grid.to_index(origin), grid.inverse_axes() * direction, range)
    }

    /// Like [`first_root`](Self::first_root), but in index space.
    pub fn first_root_in_index(&self, origin: DVec3, direction: DVec3, range: [f64; 2]) -> Option<f64> {
        let mask = self.field.volume().mask();
        self.roots.first(self.field, mask, [origin, direction], range)
    }

    /// The value at a place in index space. Returns none outside the volume's box.
    fn value(&self, index: DVec3) -> Option<f64> {
        let at = crate::number::Vec3::from_glam(index);
        self.holds(index).then(|| self.field.value(at))
    }

    fn holds(&self, index: DVec3) -> bool {
        let [lo, hi] = self.field.volume().grid().index_box();
        index.cmpge(lo).all() && index.cmple(hi).all()
    }
}

#[cfg(test)]
mod tests;
