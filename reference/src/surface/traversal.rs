//! Traversal of the cells on a line, from face to face.

use drypoint_scene::glam::DVec3;
use drypoint_scene::space::Grid;

/// A line in index space: its origin, and its displacement for one unit of the parameter t.
pub(super) type IndexLine = [DVec3; 2];

/// The cells of a grid's box ([SPACE-1]).
#[derive(Clone, Copy, Debug)]
pub(super) struct CellBox {
    /// The last cell along each axis.
    last: [usize; 3],
    /// The ends of the box along each axis.
    ends: [[f64; 2]; 3],
    /// Whether an axis has length 1; its coordinate is ignored.
    flat: [bool; 3],
}

impl CellBox {
    pub(super) fn new(grid: &Grid) -> Self {
        let [lo, hi] = grid.index_box();
        let dims = grid.dims();
        Self { last: dims.map(|n| n.max(2) - 2), ends: [0, 1, 2].map(|a| [lo[a], hi[a]]), flat: dims.map(|n| n == 1) }
    }
}

impl CellBox {
    /// Whether the box contains a place in index space.
    pub(super) fn holds(&self, index: DVec3) -> bool {
        self.ends.iter().zip(index.to_array()).all(|([lo, hi], x)| (*lo..=*hi).contains(&x))
    }
}

/// The state of a line's traversal of the cells of a box.
///
/// The line crosses face i of axis a at t = (i − origin)/along, computed anew for each face, in the order of (t,
/// axis). So the cells and their ranges depend on the line alone. Skipped cells change nothing for later ones, and no
/// cell between two faces is lost to rounding.
#[derive(Clone, Copy, Debug)]
pub(super) struct CellTraversal {
    bounds: CellBox,
    origin: [f64; 3],
    along: [f64; 3],
    inverse: [f64; 3],
    /// The t at which the traversal ends.
    end: f64,
    cell: [usize; 3],
    /// The t at which the line enters the cell, and the axis of that face; none if the line begins inside.
    enters: Crossing,
    /// The t at which the line leaves the cell, and the axis of that face; none if the line ends inside.
    leaves: Crossing,
}

/// A place on the line, and the axis of the face that lies there.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Crossing {
    t: f64,
    axis: Option<usize>,
}

impl CellTraversal {
    /// The traversal of a box for t in a closed range. Returns none if they have no place in common.
    pub(super) fn new(bounds: &CellBox, [origin, along]: IndexLine, [start, end]: [f64; 2]) -> Option<Self> {
        let (origin, along) = (origin.to_array(), along.to_array());
        let inverse = along.map(|d| 1.0 / d);
        let none = Crossing { t: f64::NEG_INFINITY, axis: None };
        let mut walk = Self { bounds: *bounds, origin, along, inverse, end, cell: [0; 3], enters: none, leaves: none };
        let (mut enters, mut leaves) = (none, f64::INFINITY);
        for a in 0..3 {
            let [lo, hi] = bounds.ends[a];
            if along[a] == 0.0 {
                if !(origin[a] >= lo && origin[a] <= hi) {
                    return None;
                }
                continue;
            }
            let (near, far) = if along[a] > 0.0 { (lo, hi) } else { (hi, lo) };
            let t = walk.crosses(a, near);
            if t >= enters.t {
                enters = Crossing { t, axis: Some(a) };
            }
            leaves = leaves.min(walk.crosses(a, far));
        }
        if start > enters.t || enters.axis.is_none() {
            enters = Crossing { t: start, axis: None };
        }
        let finite = enters.t.is_finite() && leaves.min(end).is_finite();
        if !(finite && enters.t <= leaves && enters.t <= end) {
            return None;
        }
        if let Some(a) = enters.axis {
            walk.cell[a] = if along[a] > 0.0 { 0 } else { bounds.last[a] };
        }
        walk.seek(enters);
        Some(walk)
    }

    /// The t at which the line crosses a face of an axis to which it is not parallel.
    fn crosses(&self, a: usize, face: f64) -> f64 {
        (face - self.origin[a]) * self.inverse[a]
    }

    /// Moves to the crossing of a face, in the cell behind it. The cell along the face's own axis must be set before.
    fn seek(&mut self, enters: Crossing) {
        for a in (0..3).filter(|a| Some(*a) != enters.axis) {
            let last = self.bounds.last[a];
            // Rounded down; negative numbers become 0.
            let guess = (self.origin[a] + self.along[a] * enters.t) as usize;
            let mut cell = guess.min(last);
            let crossed = |face: usize| {
                let t = self.crosses(a, face as f64);
                t < enters.t || t == enters.t && enters.axis.is_none_or(|axis| a < axis)
            };
            if self.along[a] > 0.0 {
                while cell < last && crossed(cell + 1) {
                    cell += 1;
                }
                while cell > 0 && !crossed(cell) {
                    cell -= 1;
                }
            } else if self.along[a] < 0.0 {
                while cell > 0 && crossed(cell) {
                    cell -= 1;
                }
                while cell < last && !crossed(cell + 1) {
                    cell += 1;
                }
            }
            self.cell[a] = cell;
        }
        self.enters = enters;
        self.leaves = self.leaves_block(1).0;
    }

    /// The crossing at which the line leaves the aligned block of cells with this side, and the next cell along the
    /// axis of the face. There is no next cell outside the box.
    fn leaves_block(&self, side: usize) -> (Crossing, Option<usize>) {
        let mut first = (Crossing { t: f64::INFINITY, axis: None }, None);
        for a in 0..3 {
            let block = self.cell[a] / side * side;
            let (face, behind) = if self.along[a] > 0.0 {
                let next = block + side;
                if next <= self.bounds.last[a] { (next as f64, Some(next)) } else { (self.bounds.ends[a][1], None) }
            } else if self.along[a] < 0.0 {
                if block > 0 { (block as f64, Some(block - 1)) } else { (self.bounds.ends[a][0], None) }
            } else {
                continue;
            };
            let t = self.crosses(a, face);
            if t < first.0.t {
                first = (Crossing { t, axis: Some(a) }, behind);
            }
        }
        first
    }

    /// The current cell.
    pub(super) fn cell(&self) -> [usize; 3] {
        self.cell
    }

    /// The t at which the line enters the cell, and the t at which it leaves the cell or ends.
    pub(super) fn range(&self) -> [f64; 2] {
        [self.enters.t, self.leaves.t.min(self.end)]
    }

    /// Moves on behind the aligned block of cells with this side. Returns `false` if the line has ended.
    pub(super) fn pass(&mut self, side: usize) -> bool {
        let (leaves, behind) = self.leaves_block(side);
        let (Some(axis), Some(behind)) = (leaves.axis, behind) else { return false };
        if leaves.t > self.end {
            return false;
        }
        self.cell[axis] = behind;
        self.seek(leaves);
        true
    }

    /// Coordinates within the cell at which the line enters it. On a crossed face the coordinate is exactly 0 or 1,
    /// so that both cells at the face agree.
    pub(super) fn entry(&self) -> [f64; 3] {
        self.weights(self.enters.t, self.enters.axis, 0.0)
    }

    /// Coordinates within the cell at which the line leaves it or ends.
    pub(super) fn exit(&self) -> [f64; 3] {
        let axis = if self.leaves.t <= self.end { self.leaves.axis } else { None };
        self.weights(self.leaves.t.min(self.end), axis, 1.0)
    }

    /// Coordinates within the cell at t.
    pub(super) fn at(&self, t: f64) -> [f64; 3] {
        self.weights(t, None, 0.0)
    }

    /// Coordinates within the cell at t. On `axis` the coordinate is that of the crossed face: `face` for a line that
    /// runs upwards, else 1 − `face`.
    fn weights(&self, t: f64, axis: Option<usize>, face: f64) -> [f64; 3] {
        std::array::from_fn(|a| {
            if self.bounds.flat[a] {
                0.0
            } else if axis == Some(a) {
                if self.along[a] > 0.0 { face } else { 1.0 - face }
            } else {
                let along = if self.along[a] == 0.0 { 0.0 } else { self.along[a] * t };
                (self.origin[a] + along - self.cell[a] as f64).clamp(0.0, 1.0)
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn bounds(dims: [usize; 3]) -> CellBox {
        CellBox::new(&Grid::with_spacing(dims, [1.0; 3]).unwrap())
    }

    const ALL: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

    /// Cells with the t at which the line enters and leaves them: all, or those that `jumps` does not skip.
    fn cells(walk: Option<CellTraversal>, jumps: impl Fn([usize; 3]) -> Option<usize>) -> Vec<([usize; 3], [u64; 2])> {
        let mut all = Vec::new();
        let Some(mut walk) = walk else { return all };
        loop {
            let side = jumps(walk.cell());
            if side.is_none() {
                all.push((walk.cell(), walk.range().map(f64::to_bits)));
            }
            if !walk.pass(side.unwrap_or(1)) {
                return all;
            }
        }
    }

    #[test]
    fn along_an_axis_on_a_face_and_along_a_diagonal() {
        let line = |o: [f64; 3], d: [f64; 3]| [DVec3::from_array(o), DVec3::from_array(d)];
        let through = |o, d| -> Vec<[usize; 3]> {
            cells(CellTraversal::new(&bounds([5, 4, 3]), line(o, d), ALL), |_| None)
                .into_iter()
                .map(|(c, _)| c)
                .collect()
        };
        let row: Vec<[usize; 3]> = (0..4).map(|x| [x, 1, 1]).collect();
        assert_eq!(through([-9.0, 1.5, 1.5], [1.0, 0.0, 0.0]), row);
        assert_eq!(
            through([-9.0, 1.0, 2.0], [1.0, 0.0, 0.0]),
            row,
            "a face belongs to the cell behind it, or the last"
        );
        assert_eq!(through([9.0, 1.5, 1.5], [-2.0, 0.0, 0.0]), row.into_iter().rev().collect::<Vec<_>>());
        // On a diagonal through voxels three faces coincide: cells between them have length 0.
        let diagonal = through([0.0; 3], [1.0; 3]);
        assert!(diagonal.contains(&[0; 3]) && diagonal.contains(&[1; 3]) && diagonal.len() <= 6, "{diagonal:?}");
        assert!(through([0.0, 3.1, 0.0], [1.0, 0.0, 0.0]).is_empty());
        assert!(through([-1.0, 0.0, 0.0], [1.0, 4.0, 0.0]).is_empty());
        // An axis of length 1 extends half a voxel to either side.
        let flat = CellTraversal::new(&bounds([1, 3, 3]), line([0.0, 0.2, 0.2], [1.0, 0.0, 0.0]), ALL).unwrap();
        assert_eq!((flat.range(), flat.entry(), flat.exit()), ([-0.5, 0.5], [0.0, 0.2, 0.2], [0.0, 0.2, 0.2]));
    }

    proptest! {
        /// Cells follow each other across one face without a gap and contain the line. Skipping blocks changes none
        /// of them.
        #[test]
        fn cells_follow_each_other(
            dims in prop::array::uniform3(2usize..24),
            from in prop::array::uniform3(-30.0..30.0f64),
            to in prop::array::uniform3(-4i32..28),
            scale in prop::sample::select(vec![1e-3, 1.0, 7e5]),
            start in 0.0..1.0f64,
        ) {
            let to = DVec3::from_array(to.map(|x| f64::from(x) * 0.5));
            let from = DVec3::from_array(from);
            let line = [from - (to - from) * 3.0, (to - from) / scale];
            let bounds = bounds(dims);
            let range = [scale * (2.0 + start), f64::INFINITY];
            let all = cells(CellTraversal::new(&bounds, line, range), |_| None);
            for pair in all.windows(2) {
                let [(a, in_a), (b, in_b)] = [pair[0], pair[1]];
                let steps: usize = (0..3).map(|i| a[i].abs_diff(b[i])).sum();
                prop_assert_eq!(steps, 1);
                prop_assert_eq!(in_a[1], in_b[0]);
            }
            for (cell, range) in &all {
                let [t0, t1] = range.map(f64::from_bits);
                prop_assert!(t0 <= t1);
                let middle = line[0] + line[1] * (0.5 * (t0 + t1));
                for a in 0..3 {
                    let off = middle[a] - cell[a] as f64;
                    prop_assert!((-1e-10..=1.0 + 1e-10).contains(&off), "{off}");
                }
            }
            let odd = |c: [usize; 3]| (c[0] / 8 + c[1] / 8 + c[2] / 8) % 2 == 1;
            let jumped = cells(CellTraversal::new(&bounds, line, range), |c| odd(c).then_some(8));
            let kept: Vec<_> = all.into_iter().filter(|(c, _)| !odd(*c)).collect();
            prop_assert_eq!(jumped, kept);
        }
    }
}
