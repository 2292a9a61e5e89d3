//! Random points of a voxel: between two planes parallel to its tangent plane (4.3), or on the edge with `snap`
//! ([STIP-4]).

use super::ridge::nearest_axis;
use drypoint_scene::glam::{DMat3, DVec3};
use drypoint_scene::philox;

/// The part of a voxel, [−½, ½]³ about its centre in index space, within a distance h of the tangent plane through
/// the centre: |n·(D o)| ≤ h. It always contains the centre.
///
/// On an edge it is the piece of the tangent plane inside the voxel's column along the axis nearest to n, moved onto
/// the edge. Pieces of adjacent voxels meet without a gap, even where the plane leaves the voxel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slab {
    /// The axis along which the planes are closest.
    axis: usize,
    /// Dᵀn divided by its component along `axis`.
    slope: DVec3,
    /// Half the planes' distance along `axis`, in voxels.
    half: f64,
    /// The displacement from the plane through the centre to the edge, in index space.
    to_edge: Option<DVec3>,
}

/// Number of draws for a point. Fewer than half of the draws miss, so a row of as many misses does not occur.
pub(super) const TRIES: u32 = 64;

impl Slab {
    /// The slab between planes at the distance `h`, in world units, on both sides of the centre. `n` has length 1.
    pub(super) fn new(axes: DMat3, n: DVec3, h: f64) -> Self {
        let m = axes.transpose() * n;
        let axis = nearest_axis(m);
        Self { axis, slope: m / m[axis], half: h / m[axis].abs(), to_edge: None }
    }

    /// The piece of an edge at the displacement `to_edge` from the voxel's centre, in index space. `n` has length 1.
    pub(super) fn on_edge(axes: DMat3, n: DVec3, to_edge: DVec3) -> Self {
        Self { to_edge: Some(to_edge), ..Self::new(axes, n, 0.0) }
    }

    /// The point of one draw, uniform in the slab. Returns none if the draw falls outside.
    #[inline]
    pub(super) fn point(&self, seed: u64, cell: [u32; 3], draw: u32) -> Option<[f32; 3]> {
        let ([o], [is_inside]) = self.points(seed, cell, [draw]);
        is_inside.then_some(o)
    }

    /// The points of several draws side by side, and flags of those inside the slab.
    ///
    /// Two coordinates are uniform over the voxel's face. The third is uniform over the slab's width at that place,
    /// or over the voxel's if that is smaller. Points outside the other of the two are rejected.
    #[inline(always)]
    pub(super) fn points<const N: usize>(
        &self,
        seed: u64,
        cell: [u32; 3],
        draws: [u32; N],
    ) -> ([[f32; 3]; N], [bool; N]) {
        let [u, v, w, _] = philox::uniforms_of(seed, cell, draws);
        let (b, c) = ((self.axis + 1) % 3, (self.axis + 2) % 3);
        let (slope_b, slope_c) = (self.slope[b], self.slope[c]);
        let (mut points, mut is_inside) = ([[0.0; 3]; N], [false; N]);
        // On an edge the third coordinate is that of the tangent plane, and every draw counts.
        if let Some(to_edge) = self.to_edge {
            for l in 0..N {
                let (across, up) = (u[l] - 0.5, v[l] - 0.5);
                points[l][b] = (across + to_edge[b]) as f32;
                points[l][c] = (up + to_edge[c]) as f32;
                points[l][self.axis] = (to_edge[self.axis] - (slope_b * across + slope_c * up)) as f32;
            }
            return (points, [true; N]);
        }
        for l in 0..N {
            // Computed in f32, as stored: rounded to nearest, points stay inside.
            let (across, up) = ((u[l] - 0.5) as f32, (v[l] - 0.5) as f32);
            let plane = -(slope_b * f64::from(across) + slope_c * f64::from(up));
            let along;
            (along, is_inside[l]) = if self.half < 0.5 {
                let along = plane + (2.0 * w[l] - 1.0) * self.half;
                (along as f32, along.abs() <= 0.5)
            } else {
                let along = (w[l] - 0.5) as f32;
                (along, (f64::from(along) - plane).abs() <= self.half)
            };
            points[l][b] = across;
            points[l][c] = up;
            points[l][self.axis] = along;
        }
        (points, is_inside)
    }
}

#[cfg(test)]
mod tests {
    use super::super::ridge::to_edge;
    use super::*;
    use drypoint_scene::space::Grid;

    fn normal(i: u32) -> DVec3 {
        let [u, v, ..] = philox::uniforms(3, [i, 0, 0], 0);
        let (z, t) = (2.0 * u - 1.0, std::f64::consts::TAU * v);
        let r = (1.0 - z * z).max(0.0).sqrt();
        DVec3::new(r * t.cos(), r * t.sin(), z).normalize()
    }

    /// Points lie in the voxel and in the slab, for coincident planes and for planes that leave the voxel. f32 rounds
    /// each of three numbers of at most ½ by at most 2⁻²⁶.
    #[test]
    fn points_lie_in_the_voxel_and_between_the_planes() {
        let sheared =
            DMat3::from_cols(DVec3::new(1.0, 0.1, 0.0), DVec3::new(-0.2, 2.0, 0.3), DVec3::new(0.0, 0.5, 4.0));
        for axes in [DMat3::IDENTITY, sheared] {
            for h in [0.0, 0.3, 1.0] {
                for i in 0..10_000 {
                    let n = normal(i);
                    let slab = Slab::new(axes, n, h);
                    let points: Vec<_> = (0..TRIES).filter_map(|draw| slab.point(1, [i, 2, 3], draw)).take(3).collect();
                    assert_eq!(points.len(), 3, "{n}, h = {h}");
                    for o in points {
                        assert!(o.iter().all(|x| x.abs() <= 0.5), "{o:?}");
                        let off = n.dot(axes * DVec3::from_array(o.map(f64::from))).abs();
                        let rounding = 3.0 * 2f64.powi(-26) * (axes.transpose() * n).abs().max_element();
                        assert!(off <= h + rounding, "{n}: {off} beyond {h}");
                    }
                }
            }
        }
    }

    /// Points lie on the edge's plane, and in the voxel's column apart from the displacement, whatever the plane's
    /// slope. Three numbers of at most 2½ are rounded to f32.
    #[test]
    fn points_on_an_edge_are_all_of_its_piece() {
        let axes = DMat3::from_diagonal(DVec3::new(1.0, 1.5, 4.0));
        for i in 0..1000 {
            let (n, to_edge) = (normal(i), normal(i + 1000));
            let slab = Slab::on_edge(axes, n, to_edge);
            let points: Vec<_> = (0..200).map(|draw| slab.point(1, [i, 2, 3], draw).unwrap()).collect();
            let off = |o: &[f32; 3]| DVec3::from_array(o.map(f64::from)) - to_edge;
            for o in &points {
                assert!(n.dot(axes * off(o)).abs() < 3.0 * 2f64.powi(-23) * 4.0, "{n}");
            }
            for a in (0..3).filter(|&a| a != slab.axis) {
                let least = points.iter().map(|o| off(o)[a]).fold(1.0, f64::min);
                let most = points.iter().map(|o| off(o)[a]).fold(-1.0, f64::max);
                // The odds that none of 200 draws lies in the outer twentieth are 4·10⁻⁵.
                assert!((-0.5001..-0.45).contains(&least) && (0.45..0.5001).contains(&most), "{n}: {least} {most}");
            }
        }
    }

    /// If two or three axes are equally near to the normal, points move along the axis whose columns have the pieces.
    /// Otherwise pieces of neighbours would not meet.
    #[test]
    fn of_axes_as_near_pieces_and_the_way_to_them_take_the_same() {
        for spacing in [[1.0; 3], [1.0, 1.0, 4.0], [2.0, 1.0, 0.5]] {
            let grid = Grid::with_spacing([8; 3], spacing).unwrap();
            for steps in [[1.0, 1.0, 0.0], [0.0, 1.0, 1.0], [-1.0, 0.0, 1.0], [1.0; 3], [1.0, -1.0, -1.0]] {
                // Powers of two, so that all three are the same to the last bit.
                let n = DVec3::from_array(steps) / DVec3::from_array(spacing);
                let way = to_edge(&grid, n / n.length(), true).abs();
                let axis = Slab::on_edge(grid.axes(), n / n.length(), DVec3::ZERO).axis;
                assert!((0..3).all(|a| a == axis || way[a] < way[axis]), "{spacing:?} {steps:?}: {way}, {axis}");
            }
        }
    }

    /// The mean of o·o over the slab equals that of a fine regular grid of the same voxel.
    #[test]
    fn points_are_uniform_in_the_slab() {
        let n = DVec3::new(1.0, 2.0, 3.0).normalize();
        for h in [0.2, 0.5, 1.0] {
            let (mut sum, mut count) = (DVec3::ZERO, 0.0);
            for i in 0..60usize.pow(3) {
                let at = |k: usize| (k as f64 + 0.5) / 60.0 - 0.5;
                let o = DVec3::new(at(i % 60), at(i / 60 % 60), at(i / 3600));
                if n.dot(o).abs() <= h {
                    (sum, count) = (sum + o * o, count + 1.0);
                }
            }
            let want = sum / count;
            let slab = Slab::new(DMat3::IDENTITY, n, h);
            let (mut sum, mut count) = (DVec3::ZERO, 0.0);
            for draw in 0..100_000 {
                if let Some(o) = slab.point(1, [0; 3], draw) {
                    let o = DVec3::from_array(o.map(f64::from));
                    (sum, count) = (sum + o * o, count + 1.0);
                }
            }
            // The square of a number in [−½, ½] spreads by at most 0.125: five standard errors of 5·10⁴ draws are 0.0028.
            assert!((sum / count - want).abs().max_element() < 0.0028, "{h}: {} {want}", sum / count);
        }
    }
}
