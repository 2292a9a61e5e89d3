//! The preprocess of section 4: from a volume to the voxels that get points, and their points ([STIP-1] … [STIP-4]).

use super::area::{box_side, mean_thickness, points_each, projected_area};
use super::curves::CurveVoxels;
use super::error::StippleError;
use super::frame::viewing_distance;
use super::layers::layers;
use super::norms::{norms, quantile_above};
use super::order::{self, Sites};
use super::resolution::boxes;
use super::ridge::{Norms, step, to_edge};
use super::surface_layer::SurfaceLayer;
use crate::field::{Field, Reconstruction, Rung, Sampler};
use drypoint_scene::counts::Counts;
use drypoint_scene::glam::DVec3;
use drypoint_scene::math;
use drypoint_scene::parallel;
use drypoint_scene::points::{PointVoxel, Points};
use drypoint_scene::shot::stipples::{DotDensity, PointsPerPixel, Snap, StippleOrder, Threshold};
use drypoint_scene::shot::{GradientRange, Outside, StippleParams};
use drypoint_scene::tone::{FULL, Tone};
use drypoint_scene::volume::Volume;
use std::borrow::Cow;

/// Points of a voxel over those drawn at T = 1, for the density on the page. Dots of a face that turns away lie closer
/// on the page in one direction, and even ones must be chosen from more ([STIP-21]).
const SPARE: f64 = 2.0;

/// The voxels of a volume that get points, and the number of these points.
#[derive(Clone, Debug)]
pub struct Preprocess<'a> {
    stipples: StippleParams,
    /// The data.
    data: &'a Volume,
    /// The volume at the adjusted resolution ([STIP-2]).
    volume: Cow<'a, Volume>,
    voxels: Vec<PointVoxel>,
    /// The displacement from each voxel's centre to the edge, in index space; empty if points are not moved.
    to_edge: Vec<DVec3>,
    slab: f64,
    /// A_vol ([STIP-3]).
    pub area: f64,
    /// m ([STIP-2]).
    pub box_side: usize,
    /// Number of points of each voxel: `full`, rounded up, or twice that for the density on the page.
    pub each: usize,
    /// Number of points drawn at T = 1 in a voxel that has the largest piece of a face. This is N_max of eq. 1 times
    /// the mean thickness of thin layers ([STIP-3], [STIP-4]). With `k_max = "auto"` it is the number that prints the
    /// full tone ([STIP-17]).
    pub full: f64,
    /// λa of dots of S_max on the page, in a face seen from the front at T = 1; 0 if tone is not needed ([STIP-17]).
    pub ink: f64,
    /// Mean number of voxels with points that overlap in a face; 1 if tone is not needed.
    pub layers: f64,
    /// Number of voxels whose gradient was measured.
    pub gradients: u64,
}

impl<'a> Preprocess<'a> {
    /// Finds the voxels above the threshold. A constant volume has none. `tone` is the tone curve of a pen, or of discs of
    /// S_max. It is given if tone is needed: with `k_max = "auto"` or a measured pen ([STIP-17]).
    ///
    /// # Errors
    /// The volume makes no field, a length is in the wrong space, or there are too many voxels or points per voxel.
    pub fn new(stipples: StippleParams, data: &'a Volume, tone: Option<&Tone>) -> Result<Self, StippleError> {
        let (volume, &StippleParams { ref view, near, square, dot_area, .. }) = (data, &stipples);
        // 4.2: the resolution, adjusted to the projected area.
        let area = projected_area(volume.grid(), view, near) / (square * square);
        let m = stipples.box_side.map_or_else(|| box_side(area, volume.dims()), |m| m as usize);
        let fine = volume.range();
        let (volume, m) = boxes(volume, m).map_or((Cow::Borrowed(volume), 1), |boxed| (Cow::Owned(boxed), m));
        // In voxels of the grid in which points are made.
        let slab = stipples.slab.world(volume.grid()).ok_or(StippleError::Slab)?;
        // 4.1: gradients, and the voxels above the threshold.
        let field = field_of(&volume, &stipples)?;
        let range = stipples.range.unwrap_or(fine);
        let BoundaryVoxels { voxels, to_edge, layers } = above(&field, &stipples, tone.is_some(), range);
        // Voxels per pixel of a face seen from the front.
        let density = |layers: f64| {
            let pixel =
                view.pixel * if view.perspective { viewing_distance(view, volume.grid().centre(), near) } else { 1.0 };
            let grid = volume.grid();
            layers * grid.voxel() / grid.axes().determinant().abs() * pixel * pixel
        };
        // Eq. 1: points per voxel, or the number that prints the full tone.
        let full = match (stipples.k_max, tone) {
            (PointsPerPixel::Number(k_max), _) => {
                let thickness = if stipples.is_thin() { mean_thickness(volume.grid(), view, near) } else { 1.0 };
                points_each(k_max, area, volume.dims()) as f64 * thickness
            }
            (PointsPerPixel::Auto, Some(tone)) => tone.ink_of_layers(FULL, layers) / (density(layers) * dot_area),
            // Dots of size 0 print nothing, however many there are.
            (PointsPerPixel::Auto, None) => 1.0,
        };
        // `as` saturates. A number that exceeds memory is refused before any allocation.
        let spare = if stipples.density == DotDensity::Page { SPARE } else { 1.0 };
        let each = ((spare * full).ceil() as usize).max(1);
        let ink = tone.map_or(0.0, |_| full * density(layers) * dot_area);
        if voxels.len() > order::MOST_VOXELS {
            return Err(StippleError::TooMany { voxels: voxels.len(), most: order::MOST_VOXELS });
        }
        if each > order::MOST_EACH && !voxels.is_empty() {
            return Err(StippleError::TooDense { each, most: order::MOST_EACH });
        }
        let gradients = volume.grid().len() as u64;
        Ok(Self {
            stipples,
            data,
            volume,
            voxels,
            to_edge,
            slab,
            area,
            box_side: m,
            each,
            full,
            ink,
            layers,
            gradients,
        })
    }

    /// The voxels whose ‖∇V‖ exceeds `magnitude`, at the adjusted resolution, regardless of the threshold of points.
    /// Curves are made of these ([STIP-13]).
    ///
    /// # Errors
    /// Only errors that [`new`](Self::new) has already found.
    pub fn voxels_above(&self, magnitude: f64) -> Result<Vec<PointVoxel>, StippleError> {
        let threshold = Threshold::Magnitude(magnitude);
        let stipples = StippleParams { threshold, thin: false, snap: Snap::None, ..self.stipples.clone() };
        self.above(&stipples).map(|above| above.voxels)
    }

    /// The voxels above the threshold of other stipples.
    fn above(&self, stipples: &StippleParams) -> Result<BoundaryVoxels, StippleError> {
        let field = field_of(&self.volume, stipples)?;
        Ok(above(&field, stipples, false, self.range()))
    }

    /// Values for V = 0 and 1 ([VAL-1]).
    fn range(&self) -> [f64; 2] {
        self.stipples.range.unwrap_or(self.data.range())
    }

    /// The camera-independent candidates for curves. Returns none if the scene has no curves. With `thin` and `snap`
    /// they are the voxels of the points, and their segments lie on the edge.
    ///
    /// # Errors
    /// Only errors that [`new`](Self::new) has already found.
    pub fn edges(&self, counts: &mut Counts) -> Result<Option<CurveVoxels>, StippleError> {
        let Some(curves) = &self.stipples.curves else { return Ok(None) };
        let threshold = Threshold::Magnitude(curves.grad);
        let BoundaryVoxels { voxels, to_edge, .. } =
            self.above(&StippleParams { threshold, ..self.stipples.clone() })?;
        // ‖∇V‖ is computed again, and LoG once to find its largest value.
        *counts.preprocess.entry("stipple gradients".into()).or_default() += self.gradients;
        counts.preprocess.insert("curve Hessians".into(), self.gradients);
        let edges = CurveVoxels::new(&self.volume, &voxels, curves, self.stipples.outside, self.range())?;
        Ok(Some(if to_edge.is_empty() { edges } else { edges.snapped(&voxels, &to_edge) }))
    }

    /// Number of points.
    pub fn len(&self) -> u64 {
        (self.voxels.len() as u64).saturating_mul(self.each as u64)
    }

    /// Whether there are no points.
    pub fn is_empty(&self) -> bool {
        self.voxels.is_empty()
    }

    /// Size in bytes of the allocations of [`points`](Self::points): the result and the temporary data of ordering
    /// ([PLAN-2]).
    pub fn bytes(&self) -> u64 {
        let each = self.each as u64;
        // A point, the draw that made it, and its share of the voxel's data.
        let kept = each.saturating_mul(12 + 4).saturating_add(size_of::<PointVoxel>() as u64);
        let way = if self.to_edge.is_empty() { 0 } else { size_of::<DVec3>() as u64 };
        let each = kept.saturating_add(way).saturating_add(order::bytes_a_voxel(self.each));
        (self.voxels.len() as u64).saturating_mul(each)
    }

    /// Makes the points. `done` receives the number of finished ranks, out of `each`.
    ///
    /// # Errors
    /// Only errors that [`new`](Self::new) has already found.
    pub fn points(&self, counts: &mut Counts, done: &(dyn Fn(usize) + Sync)) -> Result<Points, StippleError> {
        let stipples = &self.stipples;
        let grid = self.volume.grid();
        let cells: Vec<[u32; 3]> = self.voxels.iter().map(|voxel| voxel.cell).collect();
        let normals: Vec<DVec3> = self.voxels.iter().map(|voxel| voxel.normal).collect();
        let sites = Sites {
            cells: &cells,
            normals: &normals,
            axes: grid.axes(),
            voxel: grid.voxel(),
            slab: self.slab,
            to_edge: &self.to_edge,
            seed: stipples.seed,
            neighbours: stipples.order == StippleOrder::Neighbours,
        };
        // Memory bounds `each`, except for a volume without a boundary, which needs none.
        let offsets = if cells.is_empty() { Vec::new() } else { order::points(&sites, self.each, done) };
        let (each, full) = (self.each, self.full);
        let points = Points { grid: grid.clone(), each, full, voxels: self.voxels.clone(), offsets };
        counts.preprocess.insert("stipple gradients".into(), self.gradients);
        counts.preprocess.insert("stipple points".into(), points.len() as u64);
        counts.bytes.insert("points".into(), points.bytes());
        Ok(points)
    }
}

/// The field with the estimator of [STIP-1], prepared for gradients.
fn field_of<'a>(volume: &'a Volume, stipples: &StippleParams) -> Result<Field<'a, f64>, StippleError> {
    let &StippleParams { gradient, outside, .. } = stipples;
    Ok(Field::new(volume, Reconstruction { gradient, outside, ..Reconstruction::default() }, Rung::Gradient)?)
}

/// Voxels above the threshold, with measurements.
struct BoundaryVoxels {
    /// The voxels in linear order.
    voxels: Vec<PointVoxel>,
    /// The displacement from each voxel's centre to the edge, in index space, with `snap` only ([STIP-4]).
    to_edge: Vec<DVec3>,
    /// Mean number of overlapping voxels, if tone is needed ([STIP-17]).
    layers: f64,
}

/// Finds the voxels above the threshold. `range` holds the values for V = 0 and 1. `prints` says whether tone is needed.
fn above(field: &Field<'_, f64>, stipples: &StippleParams, prints: bool, range: [f64; 2]) -> BoundaryVoxels {
    let volume = field.volume();
    let dims = volume.dims();
    // ‖∇V‖ of every voxel, its range and its threshold.
    let norms = norms(field);
    let bound = field.no_normal_below();
    let quantile = |q| quantile_above(&norms, bound, q).unwrap_or(0.0);
    let scaled = |norm: f64| math::scale_by_power_of_two(norm, -field.scale_exponent());
    let [lo, hi] = match stipples.gradient_range {
        GradientRange::Fixed(range) => range.map(scaled),
        GradientRange::Quantile(q) => [0.0, quantile(q)],
    };
    let magnitude = |norm: f64| if hi > lo { ((norm - lo) / (hi - lo)).clamp(0.0, 1.0) } else { 0.0 };
    let exceeds: Box<dyn Fn(f64) -> bool + Sync> = match stipples.threshold {
        Threshold::Magnitude(t) => Box::new(move |norm| magnitude(norm) > t),
        Threshold::Quantile(q) => {
            let t = quantile(q);
            Box::new(move |norm| norm > t)
        }
    };
    // Voxels above the threshold, or at the surface. A thin layer keeps only those on the ridge.
    let grid = volume.grid();
    let to_step = |normal: DVec3| step(grid, normal, stipples.is_thin());
    let outward = if stipples.outside == Outside::Low { -1.0 } else { 1.0 };
    // The layer of one surface in place of all boundaries ([STIP-20]).
    let layer = stipples.iso.map(|iso| SurfaceLayer { volume, iso });
    let bells = layer.map(|layer| layer.bells(&norms, field.scale_exponent(), bound));
    let ridge = Norms { dims, all: bells.as_ref().unwrap_or(&norms) };
    let is_above = |cell, norm| norm > bound && layer.map_or_else(|| exceeds(norm), |layer| layer.crosses(cell));
    let voxel = |x: usize, y: usize, z: usize, norm: f64| {
        let cell = [x, y, z];
        let normal = (field.voxel_gradient(cell).to_glam() * (outward / norm)).normalize();
        let keeps = !stipples.is_thin() || ridge.is_largest(cell, to_step(normal));
        keeps.then(|| PointVoxel {
            cell: cell.map(|i| i as u32),
            value: if layer.is_some() { 1.0 } else { normalized(field.smoothed_value(cell), range) },
            magnitude: if layer.is_some() { 1.0 } else { magnitude(norm) },
            normal,
        })
    };
    let mut voxels = parallel::gather(norms.len(), dims[0], &|row, voxels| {
        let (y, z) = (row.start / dims[0] % dims[1], row.start / dims[0] / dims[1]);
        let candidates = norms[row].iter().enumerate().filter(|&(x, &norm)| is_above([x, y, z], norm));
        voxels.extend(candidates.filter_map(|(x, &norm)| voxel(x, y, z, norm)));
    });
    // With `snap` points move to the ridge, and V and ‖∇V‖ are taken there.
    let onto_edge = |v: &mut PointVoxel| {
        let cell = v.cell.map(|i| i as usize);
        let top = ridge.top(cell, to_step(v.normal));
        let way = to_edge(grid, v.normal, stipples.is_thin()) * top;
        // V is taken at the moved point. V at the voxel's centre would show the distance from the edge as terraces.
        if layer.is_none() {
            v.value = normalized(smoothed_at(field, cell, way), range);
            v.magnitude = magnitude(ridge.at(cell, way));
        }
        way
    };
    let snaps = stipples.snap == Snap::Edge;
    let to_edge = if snaps {
        let parts = voxels.chunks_mut(1 << 10).collect();
        parallel::map_of(parts, &|_, voxels: &mut [PointVoxel]| voxels.iter_mut().map(onto_edge).collect::<Vec<_>>())
            .concat()
    } else {
        Vec::new()
    };
    // A thin face has one layer. Its voxels draw points in proportion to their pieces of the face.
    let layers = if prints && !stipples.is_thin() {
        let to_step = grid.inverse_axes() * grid.voxel();
        let steps: Vec<([u32; 3], DVec3)> = voxels.iter().map(|v| (v.cell, to_step * v.normal)).collect();
        layers(dims, &norms, |norm| norm > bound && exceeds(norm), &steps)
    } else {
        1.0
    };
    BoundaryVoxels { voxels, to_edge, layers }
}

/// The smoothed value at a step from a voxel in index space, at most one voxel along each axis. It is linear between
/// voxels and constant beyond the border.
fn smoothed_at(field: &Field<'_, f64>, cell: [usize; 3], step: DVec3) -> f64 {
    let (step, dims) = (step.to_array(), field.volume().dims());
    let next = |a: usize| {
        let to = if step[a] < 0.0 { cell[a].saturating_sub(1) } else { (cell[a] + 1).min(dims[a] - 1) };
        [cell[a], to]
    };
    let ends = [next(0), next(1), next(2)];
    let value = |i: usize| field.smoothed_value(std::array::from_fn(|a| ends[a][i >> a & 1]));
    let along = |a: usize, at: f64, to: f64| at + step[a].abs() * (to - at);
    let x = [0, 2, 4, 6].map(|i| along(0, value(i), value(i + 1)));
    along(2, along(1, x[0], x[1]), along(1, x[2], x[3]))
}

/// V, clamped to [0, 1] ([VAL-1]): at a border the fit can leave the range of the values. If the range has length 0,
/// V is 1 above it.
fn normalized(value: f64, [lo, hi]: [f64; 2]) -> f64 {
    // Half values, so that the difference of two finite numbers cannot overflow.
    let t = (value * 0.5 - lo * 0.5) / (hi * 0.5 - lo * 0.5);
    if t.is_nan() { 0.0 } else { t.clamp(0.0, 1.0) }
}
