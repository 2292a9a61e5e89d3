//! Empty-space skipping ([RAY-2]): the bricks in which a transfer function can be visible, and their intersections with
//! rays.

use crate::number::{Real, Vec3};
use drypoint_scene::glam::DVec3;
use drypoint_scene::volume::{BRICK, Bricks};
use obvhs::aabb::Aabb;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};

/// A BVH over boxes of the visible bricks of a volume.
///
/// The intervals of a ray contain all its positions in visible bricks. They may contain positions in invisible bricks.
/// Samples there are evaluated, show nothing, and change no bit.
pub struct BrickOccupancy {
    nodes: Vec<TreeNode>,
    /// A bound on the coordinates inside the volume, for the rounding of positions.
    reach: f64,
}

/// A node of the tree, in f64, so that the traversal need not convert. The ends of boxes are integers or integers + ½,
/// which f32 holds exactly up to 2²³.
#[derive(Clone, Copy, Debug)]
struct TreeNode {
    /// Lowest and highest index coordinate on each axis.
    ends: [[f64; 2]; 3],
    /// Index of the first of two adjacent children. A leaf has 0, the index of the root.
    children: u32,
}

/// A box of bricks, both ends included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct BrickBox {
    lo: [usize; 3],
    hi: [usize; 3],
}

impl BrickOccupancy {
    /// Builds the tree over the bricks for which `can_see` holds. `can_see` receives the place of a brick and its
    /// range.
    pub fn new(bricks: &Bricks, can_see: impl Fn([usize; 3], [f64; 2]) -> bool) -> Self {
        let [nx, ny, _] = bricks.dims;
        let place = |i: usize| [i % nx, i / nx % ny, i / nx / ny];
        let visible: Vec<bool> = bricks.ranges.iter().enumerate().map(|(i, &r)| can_see(place(i), r)).collect();
        let boxes: Vec<Aabb> = blocks(&visible, bricks.dims).iter().map(|b| bounds(b, bricks.dims)).collect();
        let nodes = if boxes.is_empty() { Vec::new() } else { tree(&boxes) };
        let longest = bricks.dims.into_iter().max().unwrap_or(0);
        Self { nodes, reach: (longest * BRICK) as f64 }
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        size_of_val(self.nodes.as_slice())
    }

    /// The boxes of visible bricks that a beam of rays can meet. One traversal serves all rays of the beam. Nearer
    /// boxes mostly come before farther ones.
    pub fn boxes_in(&self, beam: &Beam) -> RayIntervals {
        let mut boxes = RayIntervals { reach: self.reach, ..RayIntervals::default() };
        let mut open: Vec<&TreeNode> =
            self.nodes.first().into_iter().filter(|root| beam.can_meet(&root.ends)).collect();
        while let Some(node) = open.pop() {
            if node.children == 0 {
                boxes.ends.push(node.ends);
                continue;
            }
            let children = node.children as usize;
            let (a, b) = (&self.nodes[children], &self.nodes[children + 1]);
            let (near, far) = if beam.is_nearer(&a.ends, &b.ends) { (a, b) } else { (b, a) };
            open.extend([far, near].into_iter().filter(|child| beam.can_meet(&child.ends)));
        }
        boxes
    }
}

/// Boxes of visible bricks, in index space, and the intervals in which the last line met them.
#[derive(Clone, Debug, Default)]
pub struct RayIntervals {
    ends: Vec<[[f64; 2]; 3]>,
    intervals: Vec<[f64; 2]>,
    reach: f64,
}

impl RayIntervals {
    /// Whether there are no boxes.
    pub(super) fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// Whether all boxes lie more than half a voxel inside a box of index space.
    pub(super) fn are_inside(&self, [lo, hi]: [DVec3; 2]) -> bool {
        let is_inside = |axis: usize, [from, to]: [f64; 2]| from > lo[axis] + 0.5 && to < hi[axis] - 0.5;
        self.ends.iter().all(|ends| (0..3).all(|axis| is_inside(axis, ends[axis])))
    }

    /// Lowest and highest index coordinate of each box on each axis.
    pub(super) fn ends(&self) -> &[[[f64; 2]; 3]] {
        &self.ends
    }

    /// A bound on the coordinates inside the volume.
    pub(super) fn reach(&self) -> f64 {
        self.reach
    }

    /// The line `origin + along · s`, prepared for positions rounded by `rounding` (relative).
    pub(super) fn line(&self, [origin, along]: [DVec3; 2], rounding: f64) -> Line {
        Line::new(origin, along, self.reach, rounding)
    }

    /// The depths at which the line `origin + along · s` can be in one of the boxes, in order and without overlap. The
    /// intervals are widened so that no position rounded by `rounding` (relative) is missed.
    pub fn intervals(&mut self, line: [DVec3; 2], rounding: f64) -> &[[f64; 2]] {
        let line = self.line(line, rounding);
        self.intervals.clear();
        for ends in &self.ends {
            if let Some(range) = line.meets(ends) {
                add(&mut self.intervals, range);
            }
        }
        merge(&mut self.intervals);
        &self.intervals
    }
}

/// Half-spaces, in index space, that hold all positions of the rays of a tile.
///
/// Each plane goes through two neighbouring corner rays. Positions lie between the corner rays up to rounding, for
/// which the half-spaces are enlarged.
#[derive(Clone, Copy, Debug)]
pub struct Beam {
    planes: [Plane; 4],
    /// Roughly the direction of the rays.
    along: DVec3,
}

/// The half-space n·p ≥ `least`.
#[derive(Clone, Copy, Debug)]
struct Plane {
    normal: DVec3,
    /// The end of a box on each axis, 0 or 1, that its farthest corner along the normal has.
    farthest: [usize; 3],
    least: f64,
}

impl Beam {
    /// The beam of four corner rays in cyclic order, each given by its origin and its displacement for one unit of
    /// depth, rounded as for all rays. A side whose corners coincide bounds nothing.
    pub fn new<R: Real>(corners: [[Vec3<R>; 2]; 4]) -> Self {
        let (corners, rounding) = (corners.map(|ray| ray.map(|v| v.to_glam())), R::EPSILON.to_f64());
        let at_depth_1 = corners.map(|[origin, along]| origin + along);
        let centre = (at_depth_1[0] + at_depth_1[1] + at_depth_1[2] + at_depth_1[3]) * 0.25;
        let planes = std::array::from_fn(|i| {
            let ([origin, along], p) = (corners[i], at_depth_1[i]);
            let normal = (at_depth_1[(i + 1) % 4] - p).cross(along);
            let side = normal.dot(centre - p);
            if side == 0.0 || !side.is_finite() {
                return Plane { normal: DVec3::ZERO, farthest: [0; 3], least: 0.0 };
            }
            let normal = normal * side.signum();
            let size = normal.abs().dot(origin.abs() + DVec3::splat(INDEX_SCALE));
            // Errors, in half ε: the corner rays and the ray between them are off by one each of |origin| + |position|,
            // at most twice the size. The position is off by three more, and the products here by five times the size.
            // The sum is ten.
            let farthest = normal.to_array().map(|n| usize::from(n > 0.0));
            Plane { normal, farthest, least: normal.dot(origin) - 16.0 * rounding * size }
        });
        Self { planes, along: corners.iter().map(|[_, along]| *along).sum() }
    }

    /// Whether the centre of a box is nearer than that of another box.
    #[inline]
    fn is_nearer(&self, [x, y, z]: &[[f64; 2]; 3], other: &[[f64; 2]; 3]) -> bool {
        let centre = DVec3::new(x[0] + x[1], y[0] + y[1], z[0] + z[1]);
        let [x, y, z] = other;
        let other = DVec3::new(x[0] + x[1], y[0] + y[1], z[0] + z[1]);
        self.along.dot(centre - other) < 0.0
    }

    /// Whether a box can meet the beam: its farthest corner lies in each half-space.
    #[inline]
    fn can_meet(&self, ends: &[[f64; 2]; 3]) -> bool {
        self.planes.iter().all(|plane| {
            let [x, y, z] = plane.farthest;
            plane.normal.dot(DVec3::new(ends[0][x], ends[1][y], ends[2][z])) >= plane.least
        })
    }
}

/// A bound on the coordinates inside a volume, for the rounding of positions: 2²⁰ voxels along an axis.
const INDEX_SCALE: f64 = 1_048_576.0;

/// Builds a BVH over at least one box.
fn tree(boxes: &[Aabb]) -> Vec<TreeNode> {
    let indices = (0..boxes.len() as u32).collect();
    let built = PlocBuilder::new().build(PlocSearchDistance::Low, boxes, indices, SortPrecision::U64, 0);
    let node = |n: &Bvh2Node| TreeNode {
        ends: [0, 1, 2].map(|a| [f64::from(n.aabb().min[a]), f64::from(n.aabb().max[a])]),
        children: if n.is_leaf() { 0 } else { n.first_index },
    };
    built.nodes.iter().map(node).collect()
}

/// A line with a smaller component is treated as perpendicular to the axis.
pub(super) const LEAST_ALONG: f64 = 1e-290;

/// A line prepared for slab tests.
#[derive(Clone, Copy)]
pub(super) struct Line {
    /// 1/along.
    inverse: [f64; 3],
    /// The end of a box, 0 or 1, that the line meets first on each axis.
    first: [usize; 3],
    /// origin · `inverse` plus the margin. A line enters a box at the depth end · `inverse` − `enter`, slightly too
    /// early.
    enter: [f64; 3],
    /// origin · `inverse` minus the margin. A line leaves a box at the depth end · `inverse` − `leave`, slightly too
    /// late.
    leave: [f64; 3],
}

impl Line {
    fn new(origin: DVec3, along: DVec3, reach: f64, rounding: f64) -> Self {
        // A line perpendicular to the axis meets the ends on this axis very far away, or not at all.
        let inverse = along.to_array().map(|d| if d.abs() < LEAST_ALONG { 1.0 / LEAST_ALONG } else { 1.0 / d });
        // Positions inside the volume are sums of numbers up to |origin| and the volume's own coordinates.
        let margin = |axis: usize| (origin[axis].abs() + reach) * 8.0 * rounding * inverse[axis].abs();
        let at = |axis: usize| origin[axis] * inverse[axis];
        Self {
            inverse,
            first: inverse.map(|i| usize::from(i < 0.0)),
            enter: [0, 1, 2].map(|a| at(a) + margin(a)),
            leave: [0, 1, 2].map(|a| at(a) - margin(a)),
        }
    }

    /// Depths at which the line is in a box.
    #[inline(always)]
    pub(super) fn meets(&self, ends: &[[f64; 2]; 3]) -> Option<[f64; 2]> {
        let enter = |a: usize| ends[a][self.first[a]] * self.inverse[a] - self.enter[a];
        let leave = |a: usize| ends[a][1 - self.first[a]] * self.inverse[a] - self.leave[a];
        let later = |a: f64, b: f64| if b > a { b } else { a };
        let earlier = |a: f64, b: f64| if b < a { b } else { a };
        let range = [later(later(enter(0), enter(1)), enter(2)), earlier(earlier(leave(0), leave(1)), leave(2))];
        (range[0] <= range[1]).then_some(range)
    }
}

/// Appends an interval, or joins it to the last one. Mostly it begins where the last one ends.
#[inline(always)]
pub(super) fn add(intervals: &mut Vec<[f64; 2]>, [from, to]: [f64; 2]) {
    match intervals.last_mut() {
        Some(last) if last[0] <= from && from <= last[1] => last[1] = last[1].max(to),
        _ => intervals.push([from, to]),
    }
}

/// Sorts intervals and joins those that touch. They come nearly in order, since boxes come nearly in the order of the
/// ray.
pub(super) fn merge(intervals: &mut Vec<[f64; 2]>) {
    for i in 1..intervals.len() {
        let interval = intervals[i];
        let mut to = i;
        while to > 0 && intervals[to - 1][0] > interval[0] {
            intervals[to] = intervals[to - 1];
            to -= 1;
        }
        intervals[to] = interval;
    }
    let mut kept = 0;
    for i in 1..intervals.len() {
        if intervals[i][0] <= intervals[kept][1] {
            intervals[kept][1] = intervals[kept][1].max(intervals[i][1]);
        } else {
            kept += 1;
            intervals[kept] = intervals[i];
        }
    }
    intervals.truncate(kept + 1);
}

/// The box of a block in index space, in f32, grown outwards. The first and the last block of an axis reach half a voxel
/// farther, for the box of an axis of length 1.
fn bounds(block: &BrickBox, dims: [usize; 3]) -> Aabb {
    let lo = block.lo.map(|i| if i == 0 { -0.5 } else { (i * BRICK) as f32 }.next_down());
    let hi = std::array::from_fn::<f32, 3, _>(|a| {
        let end = ((block.hi[a] + 1) * BRICK) as f32;
        if block.hi[a] + 1 == dims[a] { end + 0.5 } else { end }.next_up()
    });
    Aabb::new(lo.into(), hi.into())
}

/// Joins visible bricks into disjoint boxes: runs along x, then equal runs of neighbouring rows, then equal sheets of
/// neighbouring planes.
fn blocks(visible: &[bool], [nx, ny, nz]: [usize; 3]) -> Vec<BrickBox> {
    let mut done = Vec::new();
    let mut sheets: Vec<BrickBox> = Vec::new();
    for z in 0..nz {
        let mut rows: Vec<BrickBox> = Vec::new();
        let mut open: Vec<BrickBox> = Vec::new();
        for y in 0..ny {
            let mut next = Vec::new();
            for run in runs(&visible[(z * ny + y) * nx..][..nx]) {
                let fresh = BrickBox { lo: [run[0], y, z], hi: [run[1], y, z] };
                next.push(match open.iter().position(|b| b.lo[0] == run[0] && b.hi[0] == run[1]) {
                    Some(i) => BrickBox { hi: fresh.hi, ..open.swap_remove(i) },
                    None => fresh,
                });
            }
            rows.append(&mut open);
            open = next;
        }
        rows.append(&mut open);
        let mut next = Vec::new();
        for row in rows {
            let same = |b: &BrickBox| b.lo[..2] == row.lo[..2] && b.hi[..2] == row.hi[..2];
            next.push(match sheets.iter().position(same) {
                Some(i) => BrickBox { hi: row.hi, ..sheets.swap_remove(i) },
                None => row,
            });
        }
        done.append(&mut sheets);
        sheets = next;
    }
    done.append(&mut sheets);
    done
}

/// The first and the last index of each run of `true`.
fn runs(row: &[bool]) -> impl Iterator<Item = [usize; 2]> + '_ {
    let mut x = 0;
    std::iter::from_fn(move || {
        let start = x + row[x..].iter().position(|&v| v)?;
        let length = row[start..].iter().take_while(|&&v| v).count();
        x = start + length;
        Some([start, x - 1])
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn bricks(dims: [usize; 3], visible: &[bool]) -> Bricks {
        Bricks { dims, ranges: visible.iter().map(|&v| if v { [1.0; 2] } else { [0.0; 2] }).collect() }
    }

    proptest! {
        #[test]
        fn blocks_cover_the_visible_bricks_once(visible in prop::collection::vec(any::<bool>(), 60)) {
            let dims = [5, 4, 3];
            let mut times = vec![0; 60];
            for b in blocks(&visible, dims) {
                for z in b.lo[2]..=b.hi[2] {
                    for y in b.lo[1]..=b.hi[1] {
                        for x in b.lo[0]..=b.hi[0] {
                            times[(z * 4 + y) * 5 + x] += 1;
                        }
                    }
                }
            }
            let want: Vec<i32> = visible.iter().map(|&v| i32::from(v)).collect();
            prop_assert_eq!(times, want);
        }

        #[test]
        fn no_visible_position_is_outside_the_intervals(
            visible in prop::collection::vec(prop::bool::weighted(0.2), 60),
            from in prop::array::uniform3(-10.0..30.0f64),
            to in prop::array::uniform3(0.0..12.0f64),
            axis_parallel in 0usize..4,
            perspective in any::<bool>(),
            // Where the ray stands between the corners of its beam, and how wide that is.
            between in prop::array::uniform2(0.0..1.0f64),
            width in prop_oneof![Just(0.0), 1e-9..1e-6f64, 0.01..1.0f64],
        ) {
            let skip = BrickOccupancy::new(&bricks([5, 4, 3], &visible), |_, r| r[1] > 0.5);
            let (from, mut along) = (DVec3::from_array(from), DVec3::from_array(to) - DVec3::from_array(from));
            if axis_parallel < 3 {
                along[axis_parallel] = 0.0;
            }
            prop_assume!(along.length() > 1e-3);
            let right = along.any_orthonormal_vector() * width;
            let up = along.normalize().cross(right);
            let ray = |x: f64, y: f64| {
                let aside = right * x + up * y;
                if perspective { [from, along + aside] } else { [from + aside, along] }
            };
            let corners = [ray(-0.5, -0.5), ray(0.5, -0.5), ray(0.5, 0.5), ray(-0.5, 0.5)];
            let [origin, along] = ray(between[0] - 0.5, between[1] - 0.5);
            let mut boxes = skip.boxes_in(&Beam::new(corners.map(|ray| ray.map(Vec3::<f64>::from_glam))));
            let got = boxes.intervals([origin, along], f64::EPSILON).to_vec();
            prop_assert!(got.windows(2).all(|w| w[0][1] < w[1][0]));
            // Behind a perspective eye there are no samples.
            for i in (if perspective { 0 } else { -100 })..300 {
                let s = f64::from(i) * 0.02;
                let p = origin + along * s;
                let end = DVec3::new(5.0, 4.0, 3.0) * BRICK as f64 - 1.0;
                let inside = p.cmpge(DVec3::ZERO).all() && p.cmple(end).all();
                let brick = [p.x, p.y, p.z].map(|x| x as usize / BRICK);
                if inside && visible[(brick[2] * 4 + brick[1]) * 5 + brick[0]] {
                    prop_assert!(got.iter().any(|r| r[0] <= s && s <= r[1]), "{s} {p} {got:?}");
                }
            }
        }
    }

    /// A beam that is bounded nowhere.
    fn everything() -> Beam {
        Beam::new([[Vec3::<f64>::from_glam(DVec3::ZERO); 2]; 4])
    }

    /// Tiles at that distance that are no wider than its rounding: each ray has been rounded for itself, and what lies at its
    /// positions is in the beam of the corner rays.
    #[test]
    fn rays_that_are_rounded_out_of_their_tile_are_in_its_beam() {
        let mut outside = 0;
        for i in 0..400 {
            let aside = f64::from(i) * 0.01;
            let eye = DVec3::new(-1e6 - aside, 4e5 + 3.0 * aside, 1e4 - aside);
            let along = (DVec3::new(10.0, 6.0 + 0.3 * aside, 5.0) - eye) / 1e6;
            let right = along.any_orthonormal_vector() * 3e-7;
            let up = along.normalize().cross(right);
            let ray = |x: f64, y: f64| [eye, along + right * x + up * y].map(Vec3::<f32>::from_glam);
            let corners = [ray(0.0, 0.0), ray(1.0, 0.0), ray(1.0, 1.0), ray(0.0, 1.0)];
            let exact = Beam::new(corners.map(|ray| ray.map(|v| Vec3::<f64>::from_glam(v.to_glam()))));
            let rounded = Beam::new(corners);
            for k in 0..64 {
                let [origin, along] = ray(f64::from(k % 8) / 7.0, f64::from(k / 8) / 7.0);
                let p = (origin + along * 1e6f32).to_glam().to_array().map(|x| [x; 2]);
                outside += u32::from(!exact.can_meet(&p));
                assert!(rounded.can_meet(&p), "{i} {k} {p:?}");
            }
        }
        assert!(outside > 1000, "{outside}");
    }

    /// From so far away that f32 rounds positions to 2⁻⁷: the rounded position decides, wherever the line itself runs.
    #[test]
    fn positions_that_are_rounded_into_a_box_are_in_its_interval() {
        let visible: Vec<bool> = (0..60).map(|i| i == 27).collect();
        let [lo, hi] = [DVec3::new(8.0, 4.0, 4.0), DVec3::new(12.0, 8.0, 8.0)];
        let within = |p: DVec3| p.cmpge(lo).all() && p.cmplt(hi).all();
        let skip = BrickOccupancy::new(&bricks([5, 4, 3], &visible), |_, r| r[1] > 0.5);
        let mut boxes = skip.boxes_in(&everything());
        let f32s = |v: DVec3| v.to_array().map(|x| x as f32);
        let mut moved = 0;
        for i in 0..400 {
            let aside = f64::from(i) * 0.01;
            let eye = f32s(DVec3::new(-1e5 - aside, 4e4 + 3.0 * aside, 1e3 - aside));
            let along = f32s((DVec3::new(10.0, 6.0 + 0.3 * aside, 5.0) - DVec3::from_array(eye.map(f64::from))) / 1e5);
            let exactly = [eye, along].map(|v| DVec3::from_array(v.map(f64::from)));
            let intervals = boxes.intervals(exactly, f64::from(f32::EPSILON)).to_vec();
            for k in 0..4000 {
                let s = 99_990.0 + k as f32 / 128.0;
                let p = DVec3::from_array([0, 1, 2].map(|a| f64::from(eye[a] + along[a] * s)));
                if within(p) {
                    let s = f64::from(s);
                    moved += u32::from(!within(exactly[0] + exactly[1] * s));
                    assert!(intervals.iter().any(|r| r[0] <= s && s <= r[1]), "{i} {s} {p} {intervals:?}");
                }
            }
        }
        assert!(moved > 100, "{moved}");
    }

    #[test]
    fn nothing_visible_is_no_interval() {
        let skip = BrickOccupancy::new(&bricks([1, 1, 1], &[false]), |_, r| r[1] > 0.5);
        assert!(skip.boxes_in(&everything()).intervals([DVec3::ZERO, DVec3::X], f64::EPSILON).is_empty());
    }
}
