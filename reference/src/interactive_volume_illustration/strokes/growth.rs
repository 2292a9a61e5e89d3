//! Strokes along the lines of curvature, traced in both directions from their seeds ([HATCH-4], [HATCH-8], [HATCH-9],
//! [HATCH-11]).

use super::super::directions::{
    CellCache, DirectionEstimator, DirectionInputs, DirectionStorage, PrincipalDirections, ReferenceField,
    StoredDirections,
};
use super::super::seeds::Seed;
use super::counts::{DirectionCounts, HatchCounts, NoDirection, RejectCause, StrokeEnd};
use super::integrator::{Control, CubicSegment, EndCause, Goal, HalfCurve, LineField, trace};
use super::stroke_field::{StrokeField, inside, normal};
use crate::field::Field;
use crate::field::curvature::Curvature;
use crate::number::Vec3;
use drypoint_scene::glam::DVec3;
use drypoint_scene::math::{cos, scale_by_power_of_two};
use drypoint_scene::parallel;
use drypoint_scene::philox::uniform;
use drypoint_scene::space::Grid;
use drypoint_scene::strokes::Stroke;

/// The share by which one |κ| must exceed the other to count as larger.
const TIE: f64 = 0.01;

/// The largest step, in voxels. Its stages lie in neighbouring cells, so that no cell is skipped.
const LARGEST_STEP: f64 = 2.0;

/// The tolerance, in voxels, below which steps end at the faces of cells and narrow down to changes of the
/// directions' scale. An interpolated field has kinks and jumps there. A step across one errs by a few thousandths of
/// a voxel, and the difference of two stages near its end does not show this error.
const EXACT_BELOW: f64 = 0.005;

/// Distance from the iso-surface, in voxels, at which a step's end is put back onto it.
const DRIFT: f64 = 0.5;

/// The least share of a direction in the tangent plane, cos 60°. A direction with less does not belong to the place's
/// surface normal.
const TANGENT: f64 = 0.5;

/// Number of cells whose strokes one thread grows in a row.
const AT_ONCE: usize = 64;

/// Side of the boxes of cells whose strokes are grown one after the other, so that the data they read lie close
/// together.
const NEIGHBOURS: usize = 16;

/// Length that a curve must have before it can close, as a multiple of the distance at which it closes.
const OUT: f64 = 4.0;

/// The least distance of strokes from the surface beyond the chords' error, in voxels ([HATCH-7]).
const CLEARANCE: f64 = 0.05;

/// The lines of curvature that strokes follow. The value of the curvature tells the two families apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurvatureFamily {
    /// The lines of the curvature of larger magnitude at the seed. If the two differ by less than 1 %, those of κ₁.
    Larger,
    /// The lines of κ₁, the larger curvature.
    Max,
    /// The lines of κ₂, the smaller curvature.
    Min,
}

impl CurvatureFamily {
    /// Returns `Max` or `Min` for a stroke that begins at these curvatures.
    pub fn of(self, c: &Curvature<f64>) -> Self {
        match self {
            Self::Larger if c.k2.abs() > (1.0 + TIE) * c.k1.abs() => Self::Min,
            Self::Larger => Self::Max,
            named => named,
        }
    }

    /// The other family; `Larger` has no other.
    fn other(self) -> Self {
        match self {
            Self::Max => Self::Min,
            Self::Min => Self::Max,
            Self::Larger => Self::Larger,
        }
    }

    fn direction(self, c: &Curvature<f64>) -> DVec3 {
        match self {
            Self::Min => c.e2.to_glam(),
            Self::Max | Self::Larger => c.e1.to_glam(),
        }
    }
}

/// Largest distance of chords from their curve on the page, in mm ([HATCH-10]).
const MOST_OFF: f64 = 0.05;

/// Least chord distance and δ, in voxels. An eye inside the volume can make a voxel arbitrarily large on the page.
const FINEST: f64 = 0.01;

/// Parameters of growing strokes. Lengths are in world units, angles in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HatchParams {
    /// Length of a whole stroke, both halves together.
    pub length: f64,
    /// Length of a stroke along the second direction, as a share of `length`.
    pub cross_length: f64,
    /// Error tolerance of a step of the integration.
    pub tolerance: f64,
    /// Length of the smallest step.
    pub min_step: f64,
    /// δ, the distance of strokes in front of the surface. It is at least the chords' error plus 0.05 voxel.
    pub offset: f64,
    /// c, the largest distance of a chord from the curve.
    pub chord: f64,
    /// The largest angle to the seed's direction on each half; 180 allows any.
    pub max_angle: f64,
    /// The family of lines.
    pub family: CurvatureFamily,
    /// The rule that computes directions.
    pub rule: DirectionEstimator,
    /// The storage of directions. None computes them at every query.
    pub stored: Option<DirectionStorage>,
    /// The length over which stored directions are smoothed along the surface; 0 leaves them.
    pub smooth: f64,
    /// The reference field for the sense of the strokes.
    pub reference: ReferenceField,
    /// The random variation of `length`, as a share.
    pub jitter: f64,
    /// Key of the random numbers ([RAY-4]).
    pub seed: u64,
}

impl HatchParams {
    /// A scene's defaults for a grid.
    pub fn new(grid: &Grid) -> Self {
        let voxel = grid.voxel();
        Self {
            length: 40.0 * voxel,
            cross_length: 0.5,
            tolerance: 0.01 * voxel,
            min_step: 0.01 * voxel,
            offset: 0.15 * voxel,
            chord: 0.1 * voxel,
            max_angle: 90.0,
            family: CurvatureFamily::Larger,
            rule: DirectionEstimator::Scaled(Default::default()),
            stored: None,
            smooth: 0.0,
            reference: ReferenceField::cylindrical(grid),
            jitter: 0.0,
            seed: 1,
        }
    }

    /// Makes chords and δ as small as the page can show, for a largest scale of `scale` mm a world unit and a pen `width` mm
    /// wide ([HATCH-10]).
    #[must_use]
    pub fn on_page(mut self, scale: f64, width: f64, grid: &Grid) -> Self {
        let finest = FINEST * grid.voxel();
        self.chord = self.chord.min((MOST_OFF / scale).max(finest));
        self.offset = self.offset.min((0.5 * width / scale).max(finest));
        self
    }

    /// The random factor of the length of a cell's stroke: 1 ± `jitter`.
    fn scattered(&self, cell: [usize; 3]) -> f64 {
        if self.jitter == 0.0 {
            return 1.0;
        }
        1.0 + self.jitter * (2.0 * uniform(self.seed, cell.map(|i| i as u32), 4) - 1.0)
    }

    /// The effective δ: at least the chords' error plus 0.05 voxel.
    pub(in super::super) fn in_front(&self, grid: &Grid) -> f64 {
        self.offset.max(self.chord + CLEARANCE * grid.voxel())
    }
}

/// Strokes of seeds, in the order of the seeds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GrownStrokes {
    /// Strokes along the first direction, each with its seed.
    pub strokes: Vec<(Seed, Stroke)>,
    /// Strokes along the second direction, for the selected seeds.
    pub cross: Vec<(Seed, Stroke)>,
    /// Statistics of growing.
    pub counts: HatchCounts,
}

/// Grows strokes on a field.
pub struct StrokeGrower<'f, 'v> {
    ground: &'f dyn StrokeField,
    directions: PrincipalDirections<'f, 'v>,
    stored: Option<StoredDirections>,
    iso: Option<f64>,
    how: HatchParams,
    rounding: f64,
}

impl<'f, 'v> StrokeGrower<'f, 'v> {
    /// Strokes on the surface f = iso of a field. If `iso` is none, each stroke stays at the value of its cell's
    /// centre ([HATCH-16]). The field must be prepared for gradients, and for Hessians if the rule is `raw`. Nothing
    /// is computed yet.
    pub fn new(field: &'f Field<'v, f64>, iso: Option<f64>, how: HatchParams) -> Self {
        Self::with(field, PrincipalDirections::new(field, how.rule), iso, how)
    }

    /// Strokes on any ground, with the ground's own Hessians.
    pub fn on(ground: &'f dyn StrokeField, iso: Option<f64>, how: HatchParams) -> Self {
        Self::with(ground, PrincipalDirections::raw(), iso, how)
    }

    fn with(
        ground: &'f dyn StrokeField,
        directions: PrincipalDirections<'f, 'v>,
        iso: Option<f64>,
        how: HatchParams,
    ) -> Self {
        let stored = how.stored.map(|storing| StoredDirections::new(ground, storing.between));
        let grid = ground.grid();
        let farthest = grid.world_corners().map(|corner| corner.abs().max_element()).into_iter().fold(0.0, f64::max);
        let rows = grid.inverse_axes().transpose();
        let voxels = [rows.x_axis, rows.y_axis, rows.z_axis].map(|row| row.length()).into_iter().fold(0.0, f64::max);
        let rounding = 4.0 * f64::EPSILON * farthest * voxels;
        Self { ground, directions, stored, iso, how, rounding }
    }

    /// Computes the directions of all voxels in parallel, if the storage asks for it.
    pub fn prepare(&self) {
        if let Some(stored) = self.stored.as_ref().filter(|_| self.is_prepared()) {
            stored.fill(&self.source());
        }
    }

    /// Stores the directions around the surface of some cells, smoothed along it.
    pub(in super::super) fn smooth(&self, cells: &[[usize; 3]]) {
        if let Some(stored) = &self.stored {
            stored.smooth(&self.source(), cells, self.how.smooth);
        }
    }

    /// Whether the directions of all voxels are computed in advance.
    pub(in super::super) fn is_prepared(&self) -> bool {
        self.how.stored.is_some_and(|storing| storing.all)
    }

    /// The largest change of values over the rounding of a place in the world, as a share of their range: a few units
    /// of rounding in voxels.
    pub(in super::super) fn rounding(&self) -> f64 {
        self.rounding
    }

    fn source(&self) -> DirectionInputs<'_, 'f, 'v> {
        DirectionInputs { ground: self.ground, directions: &self.directions }
    }

    /// Computes the directions of all voxels, with random signs.
    #[cfg(test)]
    pub(in super::super) fn turn_signs(&self) {
        if let Some(stored) = &self.stored {
            stored.turn_signs(&self.source());
        }
    }

    /// Number of voxels with a stored direction, and its size in bytes.
    pub fn stored(&self) -> [u64; 2] {
        self.stored.as_ref().map_or([0; 2], |stored| [stored.made(), stored.bytes()])
    }

    /// Curvatures and directions at a voxel.
    pub(in super::super) fn at_voxel(&self, voxel: [usize; 3]) -> Option<Curvature<f64>> {
        match &self.stored {
            Some(stored) => stored.voxel(&self.source(), voxel),
            None => {
                let [x, y, z] = voxel.map(|i| i as f64);
                self.directions.at(self.ground, Vec3::new(x, y, z), &mut DirectionCounts::default()).ok()
            }
        }
    }

    /// Curvatures and directions at a place in index space.
    pub(in super::super) fn curvature(
        &self,
        index: Vec3<f64>,
        counts: &mut DirectionCounts,
    ) -> Result<Curvature<f64>, NoDirection> {
        match &self.stored {
            Some(stored) => stored.curvature(&self.source(), index, counts),
            None => self.directions.at(self.ground, index, counts),
        }
    }

    /// The field on which strokes grow.
    pub fn ground(&self) -> &'f dyn StrokeField {
        self.ground
    }

    /// The principal directions.
    pub fn directions(&self) -> &PrincipalDirections<'f, 'v> {
        &self.directions
    }

    /// The surface's value; none if each stroke has its own.
    pub fn iso(&self) -> Option<f64> {
        self.iso
    }

    /// The parameters of growing.
    pub fn how(&self) -> &HatchParams {
        &self.how
    }

    /// Grows the strokes of cells, in parallel and in the order of the cells. If `cross` accepts a seed, a second
    /// stroke follows the other direction ([HATCH-11]).
    pub fn grow_all(&self, cells: &[[usize; 3]], cross: impl Fn(&Seed) -> bool + Sync) -> GrownStrokes {
        // Cells are visited box by box for locality; results are put back in the order of the cells.
        let mut order: Vec<usize> = (0..cells.len()).collect();
        order.sort_by_key(|&i| cells[i].map(|c| c / NEIGHBOURS));
        let some = |order: &[usize]| {
            let mut counts = HatchCounts::default();
            let of = |&i: &usize| match self
                .place(cells[i], &mut counts)
                .and_then(|seed| Ok((seed, self.grow(&seed, &mut counts)?)))
            {
                Ok((seed, stroke)) => {
                    let second = if cross(&seed) { self.grow_across(&seed, &mut counts) } else { None };
                    Some((i, seed, stroke, second))
                }
                Err(rejected) => {
                    counts.rejected.count(rejected);
                    None
                }
            };
            let made: Vec<_> = order.iter().filter_map(of).collect();
            (made, counts)
        };
        let all = parallel::map_of(order.chunks(AT_ONCE).collect(), &|_, order| some(order));
        let mut grown = GrownStrokes::default();
        let mut strokes: Vec<_> = (0..cells.len()).map(|_| None).collect();
        for (made, counts) in all {
            grown.counts += counts;
            for (i, seed, stroke, second) in made {
                strokes[i] = Some((seed, stroke, second));
            }
        }
        grown.strokes.reserve_exact(grown.counts.strokes as usize);
        grown.cross.reserve_exact(grown.counts.cross as usize);
        for (seed, stroke, second) in strokes.into_iter().flatten() {
            grown.strokes.push((seed, stroke));
            grown.cross.extend(second.map(|stroke| (seed, stroke)));
        }
        grown
    }

    /// Grows the stroke of a seed.
    ///
    /// # Errors
    /// The stroke has fewer than two vertices.
    pub fn grow(&self, seed: &Seed, counts: &mut HatchCounts) -> Result<Stroke, RejectCause> {
        let stroke = self.follow(seed, seed.family, self.how.length, counts).ok_or(RejectCause::Short)?;
        counts.strokes += 1;
        Ok(stroke)
    }

    /// Grows the shorter stroke of a seed along the other principal direction ([HATCH-11]). Returns none if it has
    /// fewer than two vertices.
    pub fn grow_across(&self, seed: &Seed, counts: &mut HatchCounts) -> Option<Stroke> {
        let length = self.how.length * self.how.cross_length;
        let stroke = self.follow(seed, seed.family.other(), length, counts)?;
        counts.cross += 1;
        Some(stroke)
    }

    fn follow(&self, seed: &Seed, family: CurvatureFamily, length: f64, counts: &mut HatchCounts) -> Option<Stroke> {
        let mut counted = *counts;
        let length = length * self.how.scattered(seed.cell);
        // The line field at the seed, and the sense of the stroke by the reference field.
        let mut lines = CurvatureLines::new(self, family, seed.target, &mut counted);
        let along = self.how.reference.signed(lines.at(seed.world).ok()?, seed.world);
        let scale = lines.scale;
        let voxel = self.ground.grid().voxel();
        let control = Control {
            tolerance: self.how.tolerance,
            first: voxel,
            min_step: self.how.min_step,
            max_step: LARGEST_STEP * voxel,
            length: 0.5 * length,
            cos_max_angle: if self.how.max_angle >= 180.0 { -1.0 } else { cos(self.how.max_angle.to_radians()) },
            goal: None,
        };
        // The tolerance is the sum of the curve's error and a chord's error: such a joint shows no kink.
        let within = self.how.chord + 5.0 * self.how.tolerance;
        let goal = |at: DVec3, along: DVec3, after: f64| Some(Goal { at, along, within, after });
        let back_again = goal(seed.world, along, OUT * within);
        // The forward half, which may come back to the seed; otherwise the backward half follows.
        let forward = trace(&mut lines, seed.world, along, &Control { goal: back_again, ..control });
        let stop = stop(&forward.end);
        let (segments, at_seed, stops) = if stop == StrokeEnd::Closed {
            (forward.segments, 0, [Some(stop), None])
        } else {
            // The other half may come round to the end of the first half. If that end lies just before the seed, it
            // does so at once.
            let far = forward.segments.last().filter(|_| stop == StrokeEnd::Length);
            let far = far.and_then(|segment| goal(segment.ends[1], -segment.tangents[1].normalize_or_zero(), 0.0));
            lines.scale = scale;
            let back = trace(&mut lines, seed.world, -along, &Control { goal: far, ..control });
            joined(&back, forward, stop)
        };
        let closed = stops.contains(&Some(StrokeEnd::Closed));
        let stroke = self.polyline(&segments, at_seed, closed, seed, &mut counted);
        if stroke.is_some() {
            stops.into_iter().flatten().for_each(|stop| counted.stops.count(stop));
        }
        *counts = counted;
        stroke
    }
}

/// Joins both halves to one curve from its tail. Returns the curve, the index of the segment that begins at the seed,
/// and the causes of its ends.
fn joined(
    back: &HalfCurve<NoDirection>,
    forward: HalfCurve<NoDirection>,
    stop_forward: StrokeEnd,
) -> (Vec<CubicSegment>, usize, [Option<StrokeEnd>; 2]) {
    let stop_back = stop(&back.end);
    let segments = back.segments.iter().rev().map(CubicSegment::reversed).chain(forward.segments).collect();
    // The halves meet in one end, which counts once.
    let first = (stop_back != StrokeEnd::Closed).then_some(stop_forward);
    (segments, back.segments.len(), [first, Some(stop_back)])
}

fn stop(end: &EndCause<NoDirection>) -> StrokeEnd {
    match end {
        EndCause::Length => StrokeEnd::Length,
        EndCause::Angle => StrokeEnd::Angle,
        EndCause::Field(NoDirection::Volume) => StrokeEnd::Volume,
        EndCause::Field(NoDirection::Gradient) => StrokeEnd::Gradient,
        EndCause::Field(NoDirection::Umbilic) => StrokeEnd::Direction,
        EndCause::Turns => StrokeEnd::Turns,
        EndCause::Step => StrokeEnd::Step,
        EndCause::Closed => StrokeEnd::Closed,
    }
}

/// The lines of curvature of one family near the surface f = target.
pub(in super::super) struct CurvatureLines<'s, 'f, 'v> {
    strokes: &'s StrokeGrower<'f, 'v>,
    family: CurvatureFamily,
    target: f64,
    counts: &'s mut HatchCounts,
    /// Index of the last direction's σ.
    scale: usize,
    /// The tolerance, in world units, if steps end at faces.
    exact: Option<f64>,
    /// Distance from the surface, in world units, at which a step's end is put back.
    drift: f64,
    /// Stored directions read around the last place.
    near: CellCache,
    /// The last place in the world and in index space, and ‖g‖ there.
    last: Option<(DVec3, Vec3<f64>, f64)>,
}

impl<'s, 'f, 'v> CurvatureLines<'s, 'f, 'v> {
    /// `family` is `Max` or `Min`.
    pub(in super::super) fn new(
        strokes: &'s StrokeGrower<'f, 'v>,
        family: CurvatureFamily,
        target: f64,
        counts: &'s mut HatchCounts,
    ) -> Self {
        let tolerance = strokes.how.tolerance;
        let voxel = strokes.ground.grid().voxel();
        let exact = (tolerance < EXACT_BELOW * voxel).then_some(tolerance);
        let (near, last) = (CellCache::default(), None);
        Self { strokes, family, target, counts, scale: 0, exact, drift: DRIFT * voxel, near, last }
    }
}

impl CurvatureLines<'_, '_, '_> {
    /// The principal direction, projected onto the tangent plane of ∇f ([HATCH-9]). `like` is the current direction.
    fn tangent(&mut self, x: DVec3, like: Option<DVec3>) -> Result<DVec3, NoDirection> {
        let (strokes, ground) = (self.strokes, self.strokes.ground);
        let index = inside(ground, x).ok_or(NoDirection::Volume)?;
        let (n, slope) = normal(ground, index).ok_or(NoDirection::Gradient)?;
        self.last = Some((x, index, slope));
        let counts = &mut self.counts.scales;
        let e = match &strokes.stored {
            Some(stored) => stored.line(&strokes.source(), index, self.family, like, &mut self.near, counts)?,
            None => {
                let before = counts.given;
                let curvature = strokes.directions.at(ground, index, counts)?;
                self.scale = before.iter().zip(counts.given).position(|(b, a)| a > *b).unwrap_or(0);
                self.family.direction(&curvature)
            }
        };
        let tangent = e - n * e.dot(n);
        let length = tangent.length();
        if length > TANGENT { Ok(tangent / length) } else { Err(NoDirection::Umbilic) }
    }
}

impl LineField for CurvatureLines<'_, '_, '_> {
    type Cause = NoDirection;

    fn at(&mut self, x: DVec3) -> Result<DVec3, NoDirection> {
        self.tangent(x, None)
    }

    fn at_along(&mut self, x: DVec3, like: DVec3) -> Result<DVec3, NoDirection> {
        self.tangent(x, Some(like))
    }
    fn formula(&self) -> usize {
        if self.exact.is_some() { self.scale } else { 0 }
    }

    /// The parameter at which a segment leaves its cell. Crossings nearer to an end than the tolerance are ignored.
    fn kink(&self, segment: &CubicSegment) -> Option<f64> {
        let grid = self.strokes.ground.grid();
        let near = self.exact? / segment.ends[0].distance(segment.ends[1]);
        let segment = segment.mapped(|x| grid.to_index(x), |t| grid.inverse_axes() * t);
        segment.face([near, 1.0 - near])
    }

    fn put_back(&mut self, x: DVec3) -> Option<DVec3> {
        let ground = self.strokes.ground;
        let (_, index, slope) = match self.last {
            Some(last) if last.0 == x => last,
            _ => {
                let index = inside(ground, x)?;
                (x, index, normal(ground, index)?.1)
            }
        };
        let over = ground.value(index) - self.target;
        // The test |f − target|/‖g‖ ≤ drift, without a division.
        if scale_by_power_of_two(over.abs(), -ground.exponent()) <= self.drift * slope {
            return None;
        }
        let back = self.strokes.put_back(x, self.target)?;
        self.counts.put_back += 1;
        Some(back)
    }
}
