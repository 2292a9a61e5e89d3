//! Positions of the data in the index space of another volume's grid, in the same world ([SPACE-2]).

use crate::space::Grid;
use glam::{DMat3, DVec3};

/// The affine map `other index = D_o⁻¹ (D · index + origin − origin_o)` and the boxes of both grids. Numbers are f64,
/// so that results do not depend on the number type of the samples.
#[derive(Clone, Copy, Debug)]
pub struct OtherGrid {
    linear: DMat3,
    offset: DVec3,
    data_box: [DVec3; 2],
    own_box: [DVec3; 2],
    /// The other grid's box, with the slack.
    reach: [DVec3; 2],
}

impl OtherGrid {
    /// Largest difference, in voxels, of two grids that count as equal. Headers may differ by rounding to single
    /// precision, or between a matrix and a quaternion. A position may lie outside the box of another grid by this
    /// difference.
    pub const SLACK: f64 = 1.0 / 1024.0;

    /// Makes the map from positions on one grid to positions on another. None if the voxels of both grids coincide.
    pub fn new(data: &Grid, other: &Grid) -> Option<Self> {
        let inverse = other.inverse_axes();
        let own_box = other.index_box();
        let map = Self {
            linear: inverse * data.axes(),
            offset: inverse * (data.origin() - other.origin()),
            data_box: data.index_box(),
            own_box,
            reach: [own_box[0] - Self::SLACK, own_box[1] + Self::SLACK],
        };
        (data.dims() != other.dims() || !map.is_identity()).then_some(map)
    }

    /// The linear part and the offset of the map.
    pub fn parts(&self) -> (DMat3, DVec3) {
        (self.linear, self.offset)
    }

    /// The other grid's box.
    pub fn own_box(&self) -> [DVec3; 2] {
        self.own_box
    }

    #[inline(always)]
    fn apply(&self, p: DVec3) -> DVec3 {
        self.linear * p + self.offset
    }

    /// The position on the other grid, if it lies in its box. Positions outside by no more than the slack are moved
    /// to the border.
    #[inline(always)]
    pub fn position(&self, p: DVec3) -> Option<DVec3> {
        let p = self.apply(p);
        let [lo, hi] = self.own_box;
        self.has(p).then(|| p.clamp(lo, hi))
    }

    /// The other grid's box, with the slack.
    pub fn reach(&self) -> [DVec3; 2] {
        self.reach
    }

    /// Whether the box [`reach`](Self::reach) contains a position of the other grid.
    #[inline(always)]
    pub fn has(&self, p: DVec3) -> bool {
        let [lo, hi] = self.reach;
        p.cmpge(lo).all() && p.cmple(hi).all()
    }

    /// Whether the map moves no corner of the data's box, and so no position in it, by more than the slack.
    fn is_identity(&self) -> bool {
        corners(self.data_box).all(|p| (self.apply(p) - p).abs().max_element() <= Self::SLACK)
    }

    /// Bounds of the positions, on the other grid, of a box of the data's cells, with a margin for rounding.
    pub fn bounds(&self, first: [usize; 3], end: [usize; 3]) -> [DVec3; 2] {
        let number = |i: [usize; 3]| DVec3::from_array(i.map(|i| i as f64));
        // On an axis of length 1, positions may lie outside its one cell.
        let flat = (self.data_box[0]).cmplt(DVec3::ZERO);
        let lo = DVec3::select(flat, self.data_box[0], number(first));
        let hi = DVec3::select(flat, self.data_box[1], number(end));
        let places = corners([lo, hi]).map(|p| self.apply(p));
        let [lo, hi] = places.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[lo, hi], p| [lo.min(p), hi.max(p)]);
        [lo - Self::SLACK, hi + Self::SLACK]
    }
}

/// The eight corners of a box.
fn corners([lo, hi]: [DVec3; 2]) -> impl Iterator<Item = DVec3> {
    (0..8).map(move |c| DVec3::from_array(std::array::from_fn(|a| if c >> a & 1 == 0 { lo[a] } else { hi[a] })))
}
