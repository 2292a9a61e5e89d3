//! Silhouette curves: voxels of boundaries that turn away from the eye (5.6, [STIP-13]).

use super::StippleError;
use crate::field::{Field, HessianEstimator, Reconstruction, Rung, Sampler};
use crate::number::Vec3;
use drypoint_scene::clip::ClipPlanes;
use drypoint_scene::glam::{DMat3, DVec3};
use drypoint_scene::parallel;
use drypoint_scene::points::PointVoxel;
use drypoint_scene::shot::Outside;
use drypoint_scene::shot::stipples::{Curves, CurvesTest};
use drypoint_scene::space::Grid;
use drypoint_scene::view::View;
use drypoint_scene::volume::{Volume, Voxels};
use std::borrow::Cow;

/// ‖n × E‖ below which a segment's direction is undefined.
const NO_DIRECTION: f64 = 1.0 / (1 << 20) as f64;

/// The largest distance of a snapped segment from its voxel's centre, in voxels along each axis. It is half a voxel,
/// plus a margin so that no segment is lost between two voxels.
const OWN: f64 = 0.55;

/// The voxels that can lie on a curve for some camera: V·LoG(V) < Th_LOG and ‖∇V‖ > Th_grad.
#[derive(Clone, Debug)]
pub struct CurveVoxels {
    grid: Grid,
    voxels: Vec<CurveVoxel>,
    /// Whether segments lie on the edge itself, rather than at the voxels' centres.
    is_snapped: bool,
}

/// A voxel that can lie on a curve.
#[derive(Clone, Copy, Debug)]
struct CurveVoxel {
    cell: [u32; 3],
    /// n, the outward normal in the world.
    normal: DVec3,
    /// ∂n/∂x in the world, the derivative of the normal by position.
    turning: DMat3,
    /// The vector from the voxel's centre to the edge, along n.
    to_edge: DVec3,
}

/// A segment of a curve, one voxel long.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveSegment {
    /// The segment's voxel.
    pub cell: [u32; 3],
    /// The outward normal in the world.
    pub normal: DVec3,
    /// The segment's ends in the world.
    pub ends: [DVec3; 2],
}

impl CurveSegment {
    /// The part of the segment that planes leave ([RAY-8]); none if they cut it away.
    pub fn clipped(self, clip: &ClipPlanes) -> Option<Self> {
        let [a, b] = self.ends;
        let [from, to] = clip.segment(self.ends)?;
        let start = if from == 0.0 { a } else { a.lerp(b, from) };
        let end = if to == 1.0 { b } else { a.lerp(b, to) };
        Some(Self { ends: [start, end], ..self })
    }
}

impl CurveVoxels {
    /// Measures the voxels of a volume. `voxels` are those with ‖∇V‖ above Th_grad. `range` holds the values for V =
    /// 0 and 1.
    ///
    /// LoG is the trace of the Hessian of V, a grid in [0, 1] smoothed by a Gaussian of σ = 1 voxel. It is divided by
    /// its largest magnitude in the volume. The derivative of the normal is that of the smoothed values.
    ///
    /// # Errors
    /// The volume does not make a field.
    pub fn new(
        volume: &Volume,
        voxels: &[PointVoxel],
        curves: &Curves,
        outside: Outside,
        range: [f64; 2],
    ) -> Result<Self, StippleError> {
        let voxels: Vec<PointVoxel> = voxels.iter().filter(|voxel| voxel.magnitude > curves.grad).copied().collect();
        let logs = laplacians(&within(volume, range), &voxels)?;
        let field = smoothed(volume, outside)?;
        let edge = |(voxel, log): (&PointVoxel, &f64)| {
            let (g, h) = at(&field, voxel.cell);
            let length = g.length();
            (voxel.value * log < curves.log && length > 0.0).then(|| {
                let n = g / length;
                let project = DMat3::IDENTITY - DMat3::from_cols(n * n.x, n * n.y, n * n.z);
                let sign = if outside == Outside::Low { -1.0 } else { 1.0 };
                let turning = project * h * (sign / length);
                CurveVoxel { cell: voxel.cell, normal: voxel.normal, turning, to_edge: DVec3::ZERO }
            })
        };
        let voxels = parallel::gather(voxels.len(), parallel::RUN, &|run, edges| {
            edges.extend(voxels[run.clone()].iter().zip(&logs[run]).filter_map(edge));
        });
        Ok(Self { grid: volume.grid().clone(), voxels, is_snapped: false })
    }

    /// Moves the segments onto the curve. Along n the edge of ‖∇V‖ is at the displacements `to_edge` from the centres
    /// of `voxels`; on it n·E is 0. `voxels` must equal those given to [`new`](Self::new).
    pub(super) fn snapped(mut self, voxels: &[PointVoxel], to_edge: &[DVec3]) -> Self {
        // Both lists are in linear order.
        let mut all = voxels.iter().zip(to_edge);
        for edge in &mut self.voxels {
            if let Some((PointVoxel { normal, .. }, way)) = all.find(|(voxel, _)| voxel.cell == edge.cell) {
                edge.to_edge = normal * normal.dot(self.grid.axes() * *way);
            }
        }
        self.is_snapped = true;
        self
    }

    /// The grid of the voxels.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Returns the segments that a camera sees, in the order of the voxels.
    pub fn segments(&self, curves: &Curves, view: &View) -> Vec<CurveSegment> {
        let voxel = self.grid.voxel();
        let segment = |edge: &CurveVoxel| {
            let centre = self.grid.to_world(DVec3::from_array(edge.cell.map(f64::from)));
            let (e, distance) = towards_eye(view, centre);
            let facing = edge.normal.dot(e);
            // E changes with the position as well if the eye is near: ∂E/∂x = −(I − EEᵀ)/distance.
            let turning = edge.turning.transpose() * e - (edge.normal - e * facing) / distance;
            let mut passes = match curves.test {
                CurvesTest::Literal => facing < curves.eye,
                CurvesTest::TwoSided => facing.abs() < curves.c * turning.length() * voxel,
            };
            let mut centre = centre;
            if self.is_snapped && curves.test == CurvesTest::TwoSided {
                // A Newton step in the tangent plane leads to n·E = 0. A voxel keeps its segment if the result lies
                // inside it.
                let within = turning - edge.normal * edge.normal.dot(turning);
                let to_curve = within * (-facing / within.length_squared());
                passes &= (self.grid.inverse_axes() * to_curve).abs().max_element() <= OWN;
                centre += edge.to_edge + to_curve;
            }
            let along = edge.normal.cross(e);
            let length = along.length();
            (passes && length >= NO_DIRECTION).then(|| {
                let half = along * (0.5 * voxel / length);
                CurveSegment { cell: edge.cell, normal: edge.normal, ends: [centre - half, centre + half] }
            })
        };
        parallel::gather(self.voxels.len(), parallel::RUN, &|run, segments| {
            segments.extend(self.voxels[run].iter().filter_map(segment));
        })
    }
}

/// The grid smoothed by a Gaussian of σ = 1 voxel, with its derivatives.
fn smoothed(volume: &Volume, outside: Outside) -> Result<Field<'_, f64>, StippleError> {
    let (hessian, scale) = (HessianEstimator::Gaussian, volume.grid().voxel());
    let how = Reconstruction { hessian, scale, outside, ..Reconstruction::default() };
    Ok(Field::new(volume, how, Rung::Hessian)?)
}

/// Gradient and Hessian at a voxel.
fn at(field: &Field<'_, f64>, cell: [u32; 3]) -> (DVec3, DMat3) {
    let (g, h) = field.hessian(Vec3::from_glam(DVec3::from_array(cell.map(f64::from))));
    let rows = [[h.xx, h.xy, h.xz], [h.xy, h.yy, h.yz], [h.xz, h.yz, h.zz]];
    (g.to_glam(), DMat3::from_cols_array_2d(&rows))
}

/// LoG at voxels, over its largest magnitude in the volume. Returns 0 where the field has no second derivatives.
fn laplacians(volume: &Volume, voxels: &[PointVoxel]) -> Result<Vec<f64>, StippleError> {
    let field = smoothed(volume, Outside::Low)?;
    let [nx, ny, nz] = volume.dims();
    let cell = |i: usize| [i % nx, i / nx % ny, i / (nx * ny)].map(|i| i as u32);
    let laplacian = |cell: [u32; 3]| {
        let (_, h) = at(&field, cell);
        h.x_axis.x + h.y_axis.y + h.z_axis.z
    };
    let largest = parallel::map(ny * nz, &|row| {
        (row * nx..(row + 1) * nx).fold(0.0, |largest: f64, i| largest.max(laplacian(cell(i)).abs()))
    });
    let largest = largest.into_iter().fold(0.0, f64::max);
    let log = |voxel: &PointVoxel| if largest > 0.0 { laplacian(voxel.cell) / largest } else { 0.0 };
    Ok(parallel::gather(voxels.len(), parallel::RUN, &|run, logs| logs.extend(voxels[run].iter().map(log))))
}

/// Clamps the volume's values to a range, for V from 0 to 1. Values beyond it then have no Laplacian.
fn within(volume: &Volume, [lo, hi]: [f64; 2]) -> Cow<'_, Volume> {
    let [least, most] = volume.range();
    if lo <= least && most <= hi {
        return Cow::Borrowed(volume);
    }
    let [nx, ny, _] = volume.dims();
    let value = |i: usize| volume.value([i % nx, i / nx % ny, i / (nx * ny)]).max(lo).min(hi);
    let values = parallel::gather(volume.grid().len(), nx, &|row, values| values.extend(row.map(value)));
    // Finite values on a valid grid make a volume.
    Volume::new(volume.grid().clone(), Voxels::F64(values), 1.0, 0.0).map_or(Cow::Borrowed(volume), Cow::Owned)
}

/// E, the unit vector towards the eye, and the eye's distance, infinite in an orthographic view.
fn towards_eye(view: &View, at: DVec3) -> (DVec3, f64) {
    if !view.perspective {
        return (-view.forward, f64::INFINITY);
    }
    let to = view.eye - at;
    let distance = to.length();
    if distance > 0.0 { (to / distance, distance) } else { (-view.forward, f64::INFINITY) }
}

/// Reference implementation of the test by exhaustive search, over voxels with ‖∇V‖ > Th_grad. A voxel is found if
/// n·E has the opposite sign at one of its 26 neighbours, and its own |n·E| is the smaller one. `voxels` and the
/// result are in linear order.
pub fn exhaustive(grid: &Grid, voxels: &[PointVoxel], curves: &Curves, view: &View) -> Vec<[u32; 3]> {
    let key = |cell: [u32; 3]| (cell[2], cell[1], cell[0]);
    let passing: Vec<(PointVoxel, f64)> = voxels
        .iter()
        .filter(|voxel| voxel.magnitude > curves.grad)
        .map(|voxel| (*voxel, voxel.normal.dot(towards_eye(view, grid.to_world(voxel.centre())).0)))
        .collect();
    let facing = |cell: [u32; 3]| {
        let found = passing.binary_search_by(|(voxel, _)| key(voxel.cell).cmp(&key(cell)));
        found.ok().map(|i| passing[i].1)
    };
    let is_on_curve = |(voxel, own): &&(PointVoxel, f64)| {
        (0..27u32).filter(|&k| k != 13).any(|k| {
            let step = [k % 3, k / 3 % 3, k / 9];
            let mut cell = [0; 3];
            for a in 0..3 {
                let Some(to) = (voxel.cell[a] + step[a]).checked_sub(1) else { return false };
                cell[a] = to;
            }
            facing(cell).is_some_and(|other| (*own < 0.0) != (other < 0.0) && own.abs() <= other.abs())
        })
    };
    passing.iter().filter(is_on_curve).map(|(voxel, _)| voxel.cell).collect()
}
