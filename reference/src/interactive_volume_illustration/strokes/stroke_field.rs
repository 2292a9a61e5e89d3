//! The field that strokes grow on, independent of its kernel.

use crate::field::normal::outward;
use crate::field::{Field, Outside, Sampler};
use crate::number::{Sym3, Vec3};
use drypoint_scene::glam::DVec3;
use drypoint_scene::space::Grid;

/// A field that strokes can grow on. Positions are in index space inside the box of [SPACE-1]; derivatives are in
/// world space, times 2^−e ([SPACE-4]).
pub trait StrokeField: Sync {
    /// The grid of the field.
    fn grid(&self) -> &Grid;

    /// The side of the surface that is outside ([NORM-1]).
    fn outside(&self) -> Outside;

    /// The lowest and the highest value.
    fn range(&self) -> [f64; 2];

    /// The exponent e.
    fn exponent(&self) -> i32;

    /// The length of a gradient, times 2^−e, at or below which it is rounding error ([PREC-3]).
    fn no_normal_below(&self) -> f64;

    /// Whether a cell touches a masked voxel ([PREC-2]).
    fn masked(&self, cell: [usize; 3]) -> bool;

    /// The cell of a position.
    fn cell(&self, index: Vec3<f64>) -> [usize; 3];

    /// Whether the cell of a position touches a masked voxel.
    fn masked_at(&self, index: Vec3<f64>) -> bool {
        self.masked(self.cell(index))
    }

    /// The value at a position.
    fn value(&self, index: Vec3<f64>) -> f64;

    /// The gradient by the field's estimator.
    fn gradient(&self, index: Vec3<f64>) -> Vec3<f64>;

    /// The Hessian by the field's estimator, after the gradient that it belongs to.
    fn second(&self, index: Vec3<f64>) -> (Vec3<f64>, Sym3<f64>);

    /// The gradient and the Hessian at a voxel, as [`second`](Self::second) gives them up to rounding.
    fn second_at_voxel(&self, voxel: [usize; 3]) -> (Vec3<f64>, Sym3<f64>) {
        let [x, y, z] = voxel.map(|i| i as f64);
        self.second(Vec3::new(x, y, z))
    }
}

impl StrokeField for Field<'_, f64> {
    fn grid(&self) -> &Grid {
        self.volume().grid()
    }

    fn outside(&self) -> Outside {
        self.reconstruction().outside
    }

    fn range(&self) -> [f64; 2] {
        self.volume().range()
    }

    fn exponent(&self) -> i32 {
        self.scale_exponent()
    }

    fn no_normal_below(&self) -> f64 {
        self.no_normal_below()
    }

    fn masked(&self, cell: [usize; 3]) -> bool {
        self.volume().mask().is_some_and(|mask| mask.touches_cell(cell))
    }

    fn cell(&self, index: Vec3<f64>) -> [usize; 3] {
        self.cell_of(index)
    }

    fn masked_at(&self, index: Vec3<f64>) -> bool {
        self.volume().mask().is_some_and(|mask| mask.touches_cell(self.cell_of(index)))
    }

    fn value(&self, index: Vec3<f64>) -> f64 {
        Sampler::value(self, index)
    }

    fn gradient(&self, index: Vec3<f64>) -> Vec3<f64> {
        Sampler::gradient(self, index)
    }

    fn second(&self, index: Vec3<f64>) -> (Vec3<f64>, Sym3<f64>) {
        self.hessian(index)
    }

    fn second_at_voxel(&self, voxel: [usize; 3]) -> (Vec3<f64>, Sym3<f64>) {
        self.voxel_hessian(voxel)
    }
}

/// Converts a place of the world to index space. Returns none outside the volume's box and in cells that touch a
/// masked voxel.
pub(in super::super) fn inside(ground: &dyn StrokeField, world: DVec3) -> Option<Vec3<f64>> {
    index_inside(ground, ground.grid().to_index(world))
}

/// Like [`inside`], but for a place in index space.
pub(super) fn index_inside(ground: &dyn StrokeField, index: DVec3) -> Option<Vec3<f64>> {
    let [lo, hi] = ground.grid().index_box();
    if !(index.cmpge(lo).all() && index.cmple(hi).all()) {
        return None;
    }
    let index = Vec3::from_glam(index);
    (!ground.masked_at(index)).then_some(index)
}

/// N and ‖g‖, in the value's unit per world unit times 2^−e. Returns none where the gradient is rounding error.
pub(in super::super) fn normal(ground: &dyn StrokeField, index: Vec3<f64>) -> Option<(DVec3, f64)> {
    let gradient = ground.gradient(index);
    outward(gradient, ground.outside(), ground.no_normal_below()).map(|n| (n.to_glam(), gradient.length()))
}
