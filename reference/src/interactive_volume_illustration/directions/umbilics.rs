//! Certainty of principal directions: umbilics and the data's error ([HATCH-3]).
//!
//! On a sampled sphere the two curvatures differ by noise, and a plain formula makes a direction of it everywhere. So
//! a direction counts only under three conditions. The curvatures differ by a share of themselves. They differ by
//! more than the rounding of the stored numbers can cause. A somewhat larger scale gives the same direction. The
//! finest scale that meets all conditions is taken. A scale decides nothing where it reaches beyond the volume or
//! into voxels without a value.

use super::super::strokes::{DirectionCounts, NoDirection, StrokeField};
use super::mask_margin::MaskMargins;
use super::principal::principal;
use super::stored::VoxelBox;
use crate::field::curvature::Curvature;
use crate::field::normal::outward;
use crate::field::smoothed::{Smoothed, SmoothedBox};
use crate::field::{Field, Outside};
use crate::number::{Sym3, Vec3};
use drypoint_scene::glam::DVec3;
use drypoint_scene::math;
use drypoint_scene::space::Grid;
use drypoint_scene::volume::Volume;
use std::cell::OnceCell;
use std::sync::OnceLock;

/// Scales σ, in voxels.
const SCALES: [f64; 3] = [1.0, 2.0, 4.0];

/// The scale for the comparison of directions, in σ.
const LARGER: f64 = 1.5;

/// The least distance from the border along each axis, in σ. Samples beyond the border are continued by parabolas,
/// which a smoothed second derivative nearer to it takes for data. On spheres that touch or cross the border, 18 to
/// 90 % of the places within 2σ of it get a direction by this σ. No place farther away gets one.
const ROOM: f64 = 2.0;

/// The least distance from voxels without a value, in σ. These have the value of the nearest other voxel, which makes
/// a step. On a cylinder, rulings 2σ away are up to 10° off, and 3σ away 1.4°.
const MASK_ROOM: f64 = 3.0;

/// The constants of the rule `scaled`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thresholds {
    /// ε: |κ₁ − κ₂| > ε(|κ₁| + |κ₂|).
    pub gap: f64,
    /// The least |κ₁ − κ₂|·‖g‖, in standard deviations of its noise.
    pub noise: f64,
    /// The standard deviation of the values, if it exceeds that of their rounding.
    pub deviation: f64,
    /// The largest angle, in degrees, between the lines at σ and 1.5σ.
    pub agree: f64,
}

impl Default for Thresholds {
    fn default() -> Self {
        Self { gap: 0.1, noise: 8.0, deviation: 0.0, agree: 20.0 }
    }
}

/// The rule that computes directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DirectionEstimator {
    /// Gaussian derivatives at the first of σ = 1, 2, 4 voxels that is certain.
    Scaled(Thresholds),
    /// The paper's plain formula on the field's own Hessian.
    Raw,
}

/// Principal curvatures and directions of a field.
#[derive(Debug)]
pub struct PrincipalDirections<'f, 'v> {
    scaled: Option<ScaledRule<'f, 'v>>,
}

#[derive(Debug)]
struct ScaledRule<'f, 'v> {
    thresholds: Thresholds,
    /// Derivatives at σ and 1.5σ, for each scale.
    pairs: [[Smoothed<'f, 'v>; 2]; 3],
    /// The box in index space that is far enough from the border, for each σ.
    inner: [[DVec3; 2]; 3],
    /// Places far enough from masked voxels; computed at the first query of a direction.
    clear: OnceLock<Option<MaskMargins>>,
    volume: &'v Volume,
    /// The standard deviation of the values, times 2^−e.
    deviation: f64,
    /// Cosine of twice the angle within which two lines agree.
    cos_double: f64,
    outside: Outside,
    no_normal_below: f64,
}

impl<'f, 'v> PrincipalDirections<'f, 'v> {
    /// Prepares the rule. Nothing is smoothed before the first query of a direction.
    pub fn new(field: &'f Field<'v, f64>, rule: DirectionEstimator) -> Self {
        match rule {
            DirectionEstimator::Raw => Self::raw(),
            DirectionEstimator::Scaled(thresholds) => Self {
                scaled: Some(ScaledRule {
                    thresholds,
                    pairs: SCALES.map(|s| [s, LARGER * s].map(|sigma| Smoothed::new(field, sigma))),
                    inner: SCALES.map(|sigma| inner(field.volume().grid(), ROOM * sigma)),
                    clear: OnceLock::new(),
                    volume: field.volume(),
                    deviation: math::scale_by_power_of_two(thresholds.deviation, -field.scale_exponent()),
                    cos_double: math::cos((2.0 * thresholds.agree).to_radians()),
                    outside: field.reconstruction().outside,
                    no_normal_below: field.no_normal_below(),
                }),
            },
        }
    }

    /// The paper's plain formula, for any ground.
    pub fn raw() -> Self {
        Self { scaled: None }
    }

    /// The derivatives at the finest scale; none under the rule `raw`.
    pub(in super::super) fn finest(&self) -> Option<&Smoothed<'f, 'v>> {
        self.scaled.as_ref().map(|scaled| &scaled.pairs[0][0])
    }

    /// Whether the finest scale is certain of the direction at a place.
    pub(in super::super) fn is_certain_at_finest(&self, at: DVec3) -> bool {
        let place = QueryPoint::Between(Vec3::from_glam(at));
        let estimate = |scaled: &ScaledRule<'_, '_>| scaled.estimate(0, at, place, &SmoothedRegions::default());
        self.scaled.as_ref().is_some_and(|scaled| estimate(scaled).is_ok())
    }

    /// Size of the smoothed bricks and the mask's margins in bytes.
    pub fn bytes(&self) -> u64 {
        let Some(scaled) = &self.scaled else { return 0 };
        let clear = scaled.clear.get().and_then(Option::as_ref).map_or(0, MaskMargins::bytes);
        clear + scaled.pairs.iter().flatten().map(Smoothed::bytes).sum::<u64>()
    }

    /// Returns the curvatures and their directions at a position in index space inside the box of [SPACE-1].
    ///
    /// # Errors
    /// The position has no direction.
    ///
    /// # Panics
    /// With the rule `raw`, if the ground has no Hessian because its field was prepared for a lower rung.
    pub fn at(
        &self,
        ground: &dyn StrokeField,
        index: Vec3<f64>,
        counts: &mut DirectionCounts,
    ) -> Result<Curvature<f64>, NoDirection> {
        match &self.scaled {
            Some(scaled) => scaled.at(index.to_glam(), QueryPoint::Between(index), &SmoothedRegions::default(), counts),
            None => plain(ground, ground.second(index), counts),
        }
    }

    /// Returns the curvatures and their directions at a voxel, as they are stored. The result equals [`at`](Self::at)
    /// to rounding and takes less time.
    ///
    /// # Errors
    /// The voxel has no direction.
    ///
    /// # Panics
    /// Under the same condition as [`at`](Self::at).
    pub fn at_voxel(
        &self,
        ground: &dyn StrokeField,
        voxel: [usize; 3],
        counts: &mut DirectionCounts,
    ) -> Result<Curvature<f64>, NoDirection> {
        self.with_regions(ground, voxel, &SmoothedRegions::default(), counts)
    }

    /// Returns a function that computes the curvatures of the voxels of a box. It owns the samples that are smoothed
    /// for the box.
    pub(super) fn of_voxels(
        &self,
        ground: &dyn StrokeField,
        voxels: VoxelBox,
    ) -> impl FnMut([usize; 3]) -> Option<Curvature<f64>> {
        let regions = SmoothedRegions { voxels: Some(voxels), ..SmoothedRegions::default() };
        let mut counts = DirectionCounts::default();
        move |voxel| self.with_regions(ground, voxel, &regions, &mut counts).ok()
    }

    fn with_regions(
        &self,
        ground: &dyn StrokeField,
        voxel: [usize; 3],
        regions: &SmoothedRegions,
        counts: &mut DirectionCounts,
    ) -> Result<Curvature<f64>, NoDirection> {
        match &self.scaled {
            Some(scaled) => {
                let at = DVec3::from_array(voxel.map(|i| i as f64));
                scaled.at(at, QueryPoint::Voxel(voxel), regions, counts)
            }
            None => plain(ground, ground.second_at_voxel(voxel), counts),
        }
    }
}

/// The paper's plain formula.
fn plain(
    ground: &dyn StrokeField,
    (gradient, hessian): (Vec3<f64>, Sym3<f64>),
    counts: &mut DirectionCounts,
) -> Result<Curvature<f64>, NoDirection> {
    if outward(gradient, ground.outside(), ground.no_normal_below()).is_none() {
        counts.gradient += 1;
        return Err(NoDirection::Gradient);
    }
    let c = principal(gradient, hessian, ground.outside());
    if c.k1 == c.k2 {
        counts.umbilic[0] += 1;
        return Err(NoDirection::Umbilic);
    }
    counts.given[0] += 1;
    Ok(c)
}

/// The place at which derivatives are computed.
#[derive(Clone, Copy)]
enum QueryPoint {
    Voxel([usize; 3]),
    Between(Vec3<f64>),
}

/// Smoothed samples of a box of voxels, computed on demand. Without a box, the bricks' samples serve.
#[derive(Default)]
struct SmoothedRegions {
    voxels: Option<VoxelBox>,
    made: [[OnceCell<SmoothedBox>; 2]; 3],
}

/// Converts a margin in voxels to index space along each axis. Axes of two samples need no margin: a continuation
/// cannot add curvature to them.
fn along_axes(grid: &Grid, room: f64) -> [f64; 3] {
    let (n, spacing) = (grid.dims(), grid.spacing());
    std::array::from_fn(|a| if n[a] > 2 { room * grid.voxel() / spacing[a] } else { 0.0 })
}

/// The box in index space of the places that are at least `room` voxels from the border.
fn inner(grid: &Grid, room: f64) -> [DVec3; 2] {
    let [lo, hi] = grid.index_box();
    let room = DVec3::from_array(along_axes(grid, room));
    [lo.max(room), hi.min(DVec3::from_array(grid.dims().map(|n| n as f64 - 1.0)) - room)]
}

/// The reason why a scale is uncertain.
enum Uncertainty {
    Border,
    Gradient,
    Umbilic,
    Noise,
    Disagree,
}

impl ScaledRule<'_, '_> {
    fn at(
        &self,
        at: DVec3,
        place: QueryPoint,
        regions: &SmoothedRegions,
        counts: &mut DirectionCounts,
    ) -> Result<Curvature<f64>, NoDirection> {
        let mut flat = true;
        for i in 0..SCALES.len() {
            match self.estimate(i, at, place, regions) {
                Ok(curvature) => {
                    counts.given[i] += 1;
                    return Ok(curvature);
                }
                Err(Uncertainty::Gradient) => continue,
                Err(Uncertainty::Border) => counts.border[i] += 1,
                Err(Uncertainty::Umbilic) => counts.umbilic[i] += 1,
                Err(Uncertainty::Noise) => counts.noise[i] += 1,
                Err(Uncertainty::Disagree) => counts.disagree[i] += 1,
            }
            flat = false;
        }
        counts.gradient += u64::from(flat);
        Err(if flat { NoDirection::Gradient } else { NoDirection::Umbilic })
    }

    /// Returns the curvatures at one scale, if the border is far enough and all three conditions hold.
    #[inline]
    fn estimate(
        &self,
        i: usize,
        at: DVec3,
        place: QueryPoint,
        regions: &SmoothedRegions,
    ) -> Result<Curvature<f64>, Uncertainty> {
        let [lo, hi] = self.inner[i];
        if !(at.cmpge(lo).all() && at.cmple(hi).all() && self.is_clear(i, at)) {
            return Err(Uncertainty::Border);
        }
        let (gradient, hessian) = self.derivatives([i, 0], place, regions)?;
        let Thresholds { gap, noise, .. } = self.thresholds;
        let shape = ShapeOperator::new(gradient, hessian);
        let difference = shape.difference_squared();
        if difference <= gap * gap * shape.sum_squared() {
            return Err(Uncertainty::Umbilic);
        }
        let one = &self.pairs[i][0];
        let deviation = match place {
            QueryPoint::Voxel(voxel) => one.noise_in(one.cell_of(voxel), self.deviation),
            QueryPoint::Between(index) => one.noise(index, self.deviation),
        };
        if difference <= (noise * deviation).powi(2) {
            return Err(Uncertainty::Noise);
        }
        let (larger_gradient, larger_hessian) = self.derivatives([i, 1], place, regions)?;
        // For an umbilic the cosine is NaN, and the comparison is false.
        if shape.cos_double(&ShapeOperator::new(larger_gradient, larger_hessian)) > self.cos_double {
            Ok(principal(gradient, hessian, self.outside))
        } else {
            Err(Uncertainty::Disagree)
        }
    }

    /// Whether no masked voxel is nearby.
    #[inline]
    fn is_clear(&self, i: usize, at: DVec3) -> bool {
        if self.volume.mask().is_none() {
            return true;
        }
        let rooms = || SCALES.map(|sigma| along_axes(self.volume.grid(), MASK_ROOM * sigma));
        self.clear
            .get_or_init(|| MaskMargins::new(self.volume, rooms()))
            .as_ref()
            .is_none_or(|clear| clear.is_clear(i, at))
    }

    /// Gradient and Hessian at one scale.
    #[inline]
    fn derivatives(
        &self,
        [i, larger]: [usize; 2],
        place: QueryPoint,
        regions: &SmoothedRegions,
    ) -> Result<(Vec3<f64>, Sym3<f64>), Uncertainty> {
        let scale = &self.pairs[i][larger];
        let bound = self.no_normal_below;
        match place {
            QueryPoint::Between(index) => {
                Some(scale.derivatives(index)).filter(|(gradient, _)| gradient.length() > bound)
            }
            QueryPoint::Voxel(voxel) => {
                let region = regions
                    .voxels
                    .map(|voxels| regions.made[i][larger].get_or_init(|| scale.region(voxels.first, voxels.sides())));
                scale.at_voxel(voxel, bound, region)
            }
        }
        .ok_or(Uncertainty::Gradient)
    }
}

/// The shape operator times ∓‖g‖ for a test without eigenvectors: PHP, P = I − nnᵀ, as a multiple m of P and a
/// trace-free part D. The conditions of [HATCH-3] need neither the lines nor the length of the gradient.
struct ShapeOperator {
    mean: f64,
    d: Sym3<f64>,
}

impl ShapeOperator {
    #[inline(always)]
    fn new(g: Vec3<f64>, h: Sym3<f64>) -> Self {
        let u = g * (1.0 / g.dot(g));
        let along = h.apply(g);
        let across = u.dot(along);
        let mean = 0.5 * (h.xx + h.yy + h.zz - across);
        // PHP = H − uwᵀ − wuᵀ.
        let w = along - g * (0.5 * across);
        let d = Sym3 {
            xx: h.xx - 2.0 * u.x * w.x - mean * (1.0 - g.x * u.x),
            xy: h.xy - (u.x * w.y + w.x * u.y) + mean * (g.x * u.y),
            xz: h.xz - (u.x * w.z + w.x * u.z) + mean * (g.x * u.z),
            yy: h.yy - 2.0 * u.y * w.y - mean * (1.0 - g.y * u.y),
            yz: h.yz - (u.y * w.z + w.y * u.z) + mean * (g.y * u.z),
            zz: h.zz - 2.0 * u.z * w.z - mean * (1.0 - g.z * u.z),
        };
        Self { mean, d }
    }

    /// The product D:E.
    #[inline(always)]
    fn product(&self, other: &Self) -> f64 {
        let (d, e) = (&self.d, &other.d);
        d.xx * e.xx + d.yy * e.yy + d.zz * e.zz + 2.0 * (d.xy * e.xy + d.xz * e.xz + d.yz * e.yz)
    }

    /// ((κ₁ − κ₂)‖g‖)² = 2 D:D.
    #[inline(always)]
    fn difference_squared(&self) -> f64 {
        2.0 * self.product(self)
    }

    /// ((|κ₁| + |κ₂|)‖g‖)². The sum is |κ₁ + κ₂| for curvatures of one sign, otherwise |κ₁ − κ₂|.
    #[inline(always)]
    fn sum_squared(&self) -> f64 {
        self.difference_squared().max(4.0 * self.mean * self.mean)
    }

    /// D:E/(‖D‖‖E‖), the cosine of twice the angle between the lines if the tangent planes are equal. The result is
    /// NaN if D or E is 0.
    #[inline(always)]
    fn cos_double(&self, other: &Self) -> f64 {
        self.product(other) / (self.product(self).sqrt() * other.product(other).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::philox::uniform;

    /// Compares with the curvatures and lines of both, by their double angles. The tangent planes are up to 60°
    /// apart.
    #[test]
    fn shapes_know_differences_sums_and_angles_without_lines() {
        for i in 0..20_000 {
            let r = |k: u32| 2.0 * uniform(13, [i, k, 0], 0) - 1.0;
            let vector = |k: u32| Vec3::new(r(k), r(k + 1), r(k + 2));
            let hessian =
                |k: u32| Sym3 { xx: r(k), xy: r(k + 1), xz: r(k + 2), yy: r(k + 3), yz: r(k + 4), zz: r(k + 5) };
            let size = 10f64.powi(i as i32 % 41 - 20);
            let (g, h, other) = (vector(0), hessian(10), hessian(20).scaled(size));
            let turned = (g + vector(30) * 0.5) * size;
            let shapes = [ShapeOperator::new(g, h), ShapeOperator::new(turned, other)];
            for outside in [Outside::Low, Outside::High] {
                let [c, d] = [principal(g, h, outside), principal(turned, other, outside)];
                for (shape, c, g, h) in [(&shapes[0], &c, g, 1.0), (&shapes[1], &d, turned, size)] {
                    let bound = 32.0 * f64::EPSILON * 3.0 * h;
                    let near = |square: f64, want: f64| (square.sqrt() - want * g.length()).abs() <= bound;
                    assert!(near(shape.difference_squared(), c.k1 - c.k2), "{i}");
                    assert!(near(shape.sum_squared(), c.k1.abs() + c.k2.abs()), "{i}");
                }
                let square = |a: Vec3<f64>, b: Vec3<f64>| a.dot(b) * a.dot(b);
                let want = 0.5 * (square(c.e1, d.e1) - square(c.e1, d.e2) - square(c.e2, d.e1) + square(c.e2, d.e2));
                let found = shapes[0].cos_double(&shapes[1]);
                let gaps = [g.length() * (c.k1 - c.k2), turned.length() / size * (d.k1 - d.k2)];
                let bound = 64.0 * f64::EPSILON * 3.0 / gaps[0].min(gaps[1]);
                assert!((found - want).abs() <= bound, "{i}: {found} {want} {bound:e}");
            }
        }
        let round = Sym3 { xx: -1.0, yy: -1.0, zz: -1.0, ..Sym3::default() };
        let around = Sym3 { zz: 0.0, ..round };
        let [umbilic, cylinder] = [
            ShapeOperator::new(Vec3::new(0.0, 0.0, 2.0), round),
            ShapeOperator::new(Vec3::new(-2.0, 0.0, 0.0), around),
        ];
        assert_eq!([umbilic.difference_squared(), umbilic.sum_squared()], [0.0, 4.0]);
        assert_eq!([cylinder.difference_squared(), cylinder.sum_squared()], [1.0, 1.0]);
        assert!(cylinder.cos_double(&umbilic).is_nan());
    }
}
