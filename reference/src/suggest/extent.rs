//! The extent of content: its surface lies up to a voxel beyond its outermost voxels.

use super::content::{ContentRange, VolumeContent};
use drypoint_scene::glam::DVec3;
use drypoint_scene::volume::Volume;

/// Number of parts of a cell's edge; lines through the cell are one part apart. The field is linear along a line, so its
/// crossing is exact.
const PARTS: usize = 4;

/// Returns the greatest values of linear functions over the surface of a volume's content, within the closed box of
/// the field. The functions of the world position are given by their gradients. The surface is the trilinear surface
/// of the values `seen`, where it lies less than a voxel beyond the content.
pub(super) fn reach<const N: usize>(
    volume: &Volume,
    body: &VolumeContent,
    seen: ContentRange,
    gradients: [DVec3; N],
) -> [f64; N] {
    let grid = volume.grid();
    // In index space a function has one step for each axis.
    let steps = gradients.map(|g| grid.axes().transpose() * g);
    // The surface is at most a voxel from the content's voxels, along every axis.
    let margin = steps.map(|step| step.abs().element_sum());
    let at = |x: usize, y: usize, z: usize| DVec3::new(x as f64, y as f64, z as f64);
    let mut most = [f64::NEG_INFINITY; N];
    let raise = |most: &mut [f64; N], p: DVec3| {
        most.iter_mut().zip(steps).for_each(|(most, step)| *most = most.max(step.dot(p)));
    };
    for run in body.runs() {
        raise(&mut most, at(run.first, run.y, run.z));
        raise(&mut most, at(run.last, run.y, run.z));
    }
    // Few voxels can exceed the maxima of the voxels alone. The surface is searched only around these.
    let adds = |most: &[f64; N], p: DVec3| (0..N).any(|k| steps[k].dot(p) + margin[k] > most[k]);
    for run in body.runs() {
        if adds(&most, at(run.first, run.y, run.z)) || adds(&most, at(run.last, run.y, run.z)) {
            for x in run.first..=run.last {
                let p = at(x, run.y, run.z);
                if adds(&most, p) {
                    let near = Neighbourhood::of(volume, seen, [x, run.y, run.z]);
                    near.ends(&mut |offset| raise(&mut most, p + offset));
                }
            }
        }
    }
    std::array::from_fn(|k| most[k] + gradients[k].dot(grid.origin()))
}

/// The eight cells around a voxel.
struct Neighbourhood {
    /// Depths of the voxel and its neighbours, x fastest. Beyond the borders of the box the border's voxels are
    /// repeated.
    depth: [f64; 27],
    /// Extent of the box to either side, along each axis.
    room: [[f64; 2]; 3],
}

impl Neighbourhood {
    fn of(volume: &Volume, seen: ContentRange, voxel: [usize; 3]) -> Self {
        let dims = volume.dims();
        let [lo, hi] = volume.grid().index_box().map(|corner| corner.to_array());
        let depth = std::array::from_fn(|i| {
            let offset = [i % 3, i / 3 % 3, i / 9];
            let p = [0, 1, 2].map(|a| (voxel[a] + offset[a]).saturating_sub(1).min(dims[a] - 1));
            seen.depth(volume.value(p))
        });
        let room = [0, 1, 2].map(|a| [(voxel[a] as f64 - lo[a]).min(1.0), (hi[a] - voxel[a] as f64).min(1.0)]);
        Self { depth, room }
    }

    /// Visits the ends of the content on lines through the cells along each axis, as offsets from the voxel.
    fn ends(&self, end: &mut impl FnMut(DVec3)) {
        let parts = PARTS as i32;
        let part = |i: i32| f64::from(i) / f64::from(PARTS as i32);
        for along in 0..3 {
            let (u, v) = ((along + 1) % 3, (along + 2) % 3);
            let lines = (-parts..=parts).flat_map(|i| (-parts..=parts).map(move |j| (i, j)));
            for ((i, j), side) in lines.flat_map(|line| [(line, 0), (line, 1)]) {
                let room = self.room[along][side];
                let mut offset = DVec3::ZERO;
                (offset[u], offset[v]) = (part(i), part(j));
                if !self.has(u, offset[u]) || !self.has(v, offset[v]) || room == 0.0 {
                    continue;
                }
                let mut far = offset;
                far[along] = if side == 0 { -room } else { room };
                let (a, b) = (self.at(offset), self.at(far));
                if a >= 0.0 {
                    end(offset);
                }
                if b >= 0.0 {
                    end(far);
                }
                if (a >= 0.0) != (b >= 0.0) {
                    end(offset + (far - offset) * (a / (a - b)));
                }
            }
        }
    }

    /// Whether the box extends to an offset.
    fn has(&self, axis: usize, offset: f64) -> bool {
        (-self.room[axis][0]..=self.room[axis][1]).contains(&offset)
    }

    /// The depth of a place, trilinear between the voxels.
    fn at(&self, offset: DVec3) -> f64 {
        let weights = offset.to_array().map(|o| [(-o).max(0.0), 1.0 - o.abs(), o.max(0.0)]);
        let weight = |i: usize| weights[0][i % 3] * weights[1][i / 3 % 3] * weights[2][i / 9];
        (0..27).map(|i| weight(i) * self.depth[i]).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{radius, volume};
    use super::*;
    use drypoint_scene::shot::Outside;
    use drypoint_scene::space::Grid;
    use drypoint_scene::volume::Voxels;

    fn reached<const N: usize>(volume: &Volume, value: f64, gradients: [DVec3; N]) -> [f64; N] {
        let inside = ContentRange { value, outside: Outside::Low };
        reach(volume, &VolumeContent::of(volume, inside).unwrap(), inside, gradients)
    }

    #[test]
    fn one_voxel_reaches_to_where_its_three_tents_meet_the_value() {
        // 200 (1 − |x|)(1 − |y|)(1 − |z|) ≥ 25 around voxel (20, 12, 9): 7/8 along an axis; along the diagonal of a face
        // (1 − t)² = 1/8; along that of the cell (1 − t)³ = 1/8, so t = 1/2.
        let one = volume(|p| if p == [20, 12, 9] { 200.0 } else { 0.0 });
        let [x, y, z, xy, xyz] =
            reached(&one, 25.0, [DVec3::X, -DVec3::Y, DVec3::Z, DVec3::new(1.0, 1.0, 0.0), DVec3::ONE]);
        assert_eq!([x, y, z], [20.875, -11.125, 9.875]);
        // Lines a quarter of a voxel apart do not meet t = 0.646: the nearest are at 1/2 and cross at 3/4.
        assert_eq!([xy, xyz], [32.0 + 0.5 + 0.75, 41.0 + 1.5]);
    }

    #[test]
    fn a_ball_reaches_as_far_as_its_radius() {
        // The distance field is trilinear up to the curvature, 1/(8 R) of a voxel squared along each axis.
        for r in [1.5, 2.0, 3.0, 4.0, 9.5] {
            let ball = volume(|p| -radius(p));
            let direction = DVec3::new(0.6, -0.48, 0.64);
            let [there, back] = reached(&ball, -r, [direction, -direction]);
            assert!(((there + back) / 2.0 - r).abs() < 3.0 / (8.0 * r), "{r}: {there} {back}");
        }
    }

    #[test]
    fn the_box_ends_it() {
        let grid =
            Grid::new([3, 3, 1], drypoint_scene::glam::DMat3::from_diagonal(DVec3::new(2.0, 3.0, 4.0)), DVec3::X);
        let all = Volume::new(grid.unwrap(), Voxels::U8(vec![7; 9]), 1.0, 0.0).unwrap();
        // An axis of one voxel goes half a voxel to either side.
        assert_eq!(reached(&all, 5.0, [DVec3::X, -DVec3::X, DVec3::Y, DVec3::Z]), [5.0, -1.0, 6.0, 2.0]);
    }
}
