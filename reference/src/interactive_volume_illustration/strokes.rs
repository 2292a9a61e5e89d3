//! Strokes along the lines of curvature, traced both ways from their seeds ([HATCH-4], [HATCH-8], [HATCH-9], [HATCH-11]).

use super::counts::{HatchCounts, NoDirection, Rejected, Scales, Stop};
use super::ground::{Ground, inside, normal};
use super::integrator::{Control, End, Goal, Half, Lines, Piece, trace};
use super::orientation::Reference;
use super::placement::Seed;
use super::stored::{Near, Source, Stored, Storing};
use super::umbilics::{Directions, Rule};
use crate::field::Field;
use crate::field::curvature::Curvature;
use crate::number::Vec3;
use drypoint_scene::glam::DVec3;
use drypoint_scene::math::{cos, scale_by_power_of_two};
use drypoint_scene::philox::uniform;
use drypoint_scene::space::Grid;
use drypoint_scene::strokes::Stroke;
use rayon::prelude::*;

/// The share by which the larger |κ| must exceed the other to be called so.
const TIE: f64 = 0.01;

/// The largest step, in voxels: stages are then in neighbouring cells, and nothing is stepped over.
const LARGEST_STEP: f64 = 2.0;

/// The tolerance, in voxels, below which steps end at the faces of cells and narrow down to where the scale of the directions
/// changes. There an interpolated field has kinks and jumps; what a step across one errs by, a few thousandths of a voxel, the
/// difference of two stages near its end does not show.
const EXACT_BELOW: f64 = 0.005;

/// How far, in voxels, a step may come off its iso-surface before it is put back.
const DRIFT: f64 = 0.5;

/// The least part of a direction that lies in the tangent plane, cos 60°: surface and derivatives are of one place.
const TANGENT: f64 = 0.5;

/// Cells whose strokes one thread grows in a row.
const AT_ONCE: usize = 64;

/// The side of the boxes of cells whose strokes are grown one after the other: what these read lies near together.
const NEIGHBOURS: usize = 16;

/// How many times the distance that closes a curve it must have gone before it can come back to its beginning.
const OUT: f64 = 4.0;

/// What δ is at least beyond the chords' error, in voxels ([HATCH-7]).
const CLEARANCE: f64 = 0.05;

/// Which lines of curvature strokes follow; all are told apart by the value of their curvature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Those of the curvature that is larger in magnitude at the seed; within 1 %, of the larger one.
    Larger,
    /// Those of κ₁, the larger one.
    Max,
    /// Those of κ₂.
    Min,
}

impl Family {
    /// `Max` or `Min`, for a stroke that begins where these are the curvatures.
    pub fn of(self, c: &Curvature<f64>) -> Self {
        match self {
            Self::Larger if c.k2.abs() > (1.0 + TIE) * c.k1.abs() => Self::Min,
            Self::Larger => Self::Max,
            named => named,
        }
    }

    /// The other one; of `Larger` nothing.
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

/// How strokes are grown; lengths are in world units, angles in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hatching {
    /// Of a whole stroke, both ways together.
    pub length: f64,
    /// Of a stroke along the other direction, as a share of it.
    pub cross_length: f64,
    /// Of a step of the integration.
    pub tolerance: f64,
    /// The least step.
    pub min_step: f64,
    /// δ, how far strokes lie in front of the surface; what chords take and 0.05 voxel at least.
    pub offset: f64,
    /// c, how far a chord may be from the curve.
    pub chord: f64,
    /// From the seed's direction, each way; 180: any.
    pub max_angle: f64,
    /// Which lines.
    pub family: Family,
    /// How directions are found.
    pub rule: Rule,
    /// How they are stored; none: they are computed wherever they are asked for.
    pub stored: Option<Storing>,
    /// Which way they run.
    pub reference: Reference,
    /// The share of `length` by which strokes are longer or shorter, at random.
    pub jitter: f64,
    /// Key of those random numbers ([RAY-4]).
    pub seed: u64,
}

impl Hatching {
    /// The defaults of a scene for a grid.
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
            family: Family::Larger,
            rule: Rule::Scaled(Default::default()),
            stored: None,
            reference: Reference::cylindrical(grid),
            jitter: 0.0,
            seed: 1,
        }
    }

    /// What the length of a cell's stroke is multiplied by: 1 ± `jitter`.
    fn scattered(&self, cell: [usize; 3]) -> f64 {
        if self.jitter == 0.0 {
            return 1.0;
        }
        1.0 + self.jitter * (2.0 * uniform(self.seed, cell.map(|i| i as u32), 4) - 1.0)
    }

    /// δ, but no less than the chords and 0.05 voxel.
    pub(super) fn in_front(&self, grid: &Grid) -> f64 {
        self.offset.max(self.chord + CLEARANCE * grid.voxel())
    }
}

/// Strokes of seeds, in their order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Grown {
    /// Along the first direction, each with its seed.
    pub strokes: Vec<(Seed, Stroke)>,
    /// Along the other one, of the seeds that were to have one.
    pub cross: Vec<(Seed, Stroke)>,
    /// What was done.
    pub counts: HatchCounts,
}

/// Grows strokes on a field.
pub struct Strokes<'f, 'v> {
    ground: &'f dyn Ground,
    directions: Directions<'f, 'v>,
    stored: Option<Stored>,
    iso: Option<f64>,
    how: Hatching,
    rounding: f64,
}

impl<'f, 'v> Strokes<'f, 'v> {
    /// On the surface f = iso of a field; without a value each stroke stays at the value of its cell's centre ([HATCH-16]). The
    /// field has to be prepared for gradients, with the rule `raw` for Hessians. Nothing is computed yet.
    pub fn new(field: &'f Field<'v, f64>, iso: Option<f64>, how: Hatching) -> Self {
        Self::with(field, Directions::new(field, how.rule), iso, how)
    }

    /// On whatever ground, by the ground's own Hessians.
    pub fn on(ground: &'f dyn Ground, iso: Option<f64>, how: Hatching) -> Self {
        Self::with(ground, Directions::raw(), iso, how)
    }

    fn with(ground: &'f dyn Ground, directions: Directions<'f, 'v>, iso: Option<f64>, how: Hatching) -> Self {
        let stored = how.stored.map(|storing| Stored::new(ground, storing.between));
        let grid = ground.grid();
        let farthest = grid.world_corners().map(|corner| corner.abs().max_element()).into_iter().fold(0.0, f64::max);
        let rows = grid.inverse_axes().transpose();
        let voxels = [rows.x_axis, rows.y_axis, rows.z_axis].map(|row| row.length()).into_iter().fold(0.0, f64::max);
        let rounding = 4.0 * f64::EPSILON * farthest * voxels;
        Self { ground, directions, stored, iso, how, rounding }
    }

    /// Makes the directions of all voxels, in parallel, where that was asked for.
    pub fn prepare(&self) {
        if let Some(stored) = self.stored.as_ref().filter(|_| self.is_prepared()) {
            stored.fill(&self.source());
        }
    }

    /// Whether directions of all voxels are made before.
    pub(super) fn is_prepared(&self) -> bool {
        self.how.stored.is_some_and(|storing| storing.all)
    }

    /// How far values may change by over the rounding of a place in the world, over their range: some units of it in voxels.
    pub(super) fn rounding(&self) -> f64 {
        self.rounding
    }

    fn source(&self) -> Source<'_, 'f, 'v> {
        Source { ground: self.ground, directions: &self.directions }
    }

    /// Makes the directions of all voxels, each with signs at random.
    #[cfg(test)]
    pub(super) fn turn_signs(&self) {
        if let Some(stored) = &self.stored {
            stored.turn_signs(&self.source());
        }
    }

    /// Voxels with a stored direction, and the bytes that they take.
    pub fn stored(&self) -> [u64; 2] {
        self.stored.as_ref().map_or([0; 2], |stored| [stored.made(), stored.bytes()])
    }

    /// Curvatures and directions at a voxel.
    pub(super) fn at_voxel(&self, voxel: [usize; 3]) -> Option<Curvature<f64>> {
        match &self.stored {
            Some(stored) => stored.voxel(&self.source(), voxel),
            None => {
                let [x, y, z] = voxel.map(|i| i as f64);
                self.directions.at(self.ground, Vec3::new(x, y, z), &mut Scales::default()).ok()
            }
        }
    }

    /// Curvatures and directions at a place in index space.
    pub(super) fn curvature(&self, index: Vec3<f64>, counts: &mut Scales) -> Result<Curvature<f64>, NoDirection> {
        match &self.stored {
            Some(stored) => stored.curvature(&self.source(), index, counts),
            None => self.directions.at(self.ground, index, counts),
        }
    }

    /// What they grow on.
    pub fn ground(&self) -> &'f dyn Ground {
        self.ground
    }

    /// The principal directions.
    pub fn directions(&self) -> &Directions<'f, 'v> {
        &self.directions
    }

    /// The surface's value.
    pub fn iso(&self) -> Option<f64> {
        self.iso
    }

    /// How they are grown.
    pub fn how(&self) -> &Hatching {
        &self.how
    }

    /// The strokes of cells, in parallel and in their order; a second one along the other direction where `cross` says so for
    /// the seed ([HATCH-11]).
    pub fn grow_all(&self, cells: &[[usize; 3]], cross: impl Fn(&Seed) -> bool + Sync) -> Grown {
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
        let all: Vec<_> = order.par_chunks(AT_ONCE).map(some).collect();
        let mut grown = Grown::default();
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

    /// The stroke of a seed.
    ///
    /// # Errors
    /// It has no two vertices.
    pub fn grow(&self, seed: &Seed, counts: &mut HatchCounts) -> Result<Stroke, Rejected> {
        let stroke = self.follow(seed, seed.family, self.how.length, counts).ok_or(Rejected::Short)?;
        counts.strokes += 1;
        Ok(stroke)
    }

    /// The shorter stroke of a seed along the other principal direction ([HATCH-11]); none if it has no two vertices.
    pub fn grow_across(&self, seed: &Seed, counts: &mut HatchCounts) -> Option<Stroke> {
        let length = self.how.length * self.how.cross_length;
        let stroke = self.follow(seed, seed.family.other(), length, counts)?;
        counts.cross += 1;
        Some(stroke)
    }

    fn follow(&self, seed: &Seed, family: Family, length: f64, counts: &mut HatchCounts) -> Option<Stroke> {
        let mut counted = *counts;
        let length = length * self.how.scattered(seed.cell);
        let mut lines = OnSurface::new(self, family, seed.target, &mut counted);
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
        // As near as its own error and a chord's: what is joined there shows no kink.
        let within = self.how.chord + 5.0 * self.how.tolerance;
        let goal = |at: DVec3, along: DVec3, after: f64| Some(Goal { at, along, within, after });
        let back_again = goal(seed.world, along, OUT * within);
        let forward = trace(&mut lines, seed.world, along, &Control { goal: back_again, ..control });
        let stop = stop(&forward.end);
        let (pieces, at_seed, stops) = if stop == Stop::Closed {
            (forward.pieces, 0, [Some(stop), None])
        } else {
            // The other half may come round to where this one ended, at once where that is just before the seed.
            let far = forward.pieces.last().filter(|_| stop == Stop::Length);
            let far = far.and_then(|piece| goal(piece.ends[1], -piece.tangents[1].normalize_or_zero(), 0.0));
            lines.scale = scale;
            let back = trace(&mut lines, seed.world, -along, &Control { goal: far, ..control });
            joined(&back, forward, stop)
        };
        let closed = stops.contains(&Some(Stop::Closed));
        let stroke = self.polyline(&pieces, at_seed, closed, seed, &mut counted);
        if stroke.is_some() {
            stops.into_iter().flatten().for_each(|stop| counted.stops.count(stop));
        }
        *counts = counted;
        stroke
    }
}

/// Both halves as one curve from its tail, the number of the piece that begins at the seed, and why the ends are there.
fn joined(
    back: &Half<NoDirection>,
    forward: Half<NoDirection>,
    stop_forward: Stop,
) -> (Vec<Piece>, usize, [Option<Stop>; 2]) {
    let stop_back = stop(&back.end);
    let pieces = back.pieces.iter().rev().map(Piece::reversed).chain(forward.pieces).collect();
    // Where they meet there is one end, not two.
    let first = (stop_back != Stop::Closed).then_some(stop_forward);
    (pieces, back.pieces.len(), [first, Some(stop_back)])
}

fn stop(end: &End<NoDirection>) -> Stop {
    match end {
        End::Length => Stop::Length,
        End::Angle => Stop::Angle,
        End::Field(NoDirection::Volume) => Stop::Volume,
        End::Field(NoDirection::Gradient) => Stop::Gradient,
        End::Field(NoDirection::Umbilic) => Stop::Direction,
        End::Turns => Stop::Turns,
        End::Step => Stop::Step,
        End::Closed => Stop::Closed,
    }
}

/// The lines of curvature of one family near the surface f = target.
pub(super) struct OnSurface<'s, 'f, 'v> {
    strokes: &'s Strokes<'f, 'v>,
    family: Family,
    target: f64,
    counts: &'s mut HatchCounts,
    /// Which σ the last direction is of.
    scale: usize,
    /// The tolerance where steps end at faces, in world units.
    exact: Option<f64>,
    /// How far, in world units, a step may come off its surface.
    drift: f64,
    /// Stored directions about the last place.
    near: Near,
    /// The last place, in the world and in index space, and ‖g‖ there.
    last: Option<(DVec3, Vec3<f64>, f64)>,
}

impl<'s, 'f, 'v> OnSurface<'s, 'f, 'v> {
    /// `family` is `Max` or `Min`.
    pub(super) fn new(strokes: &'s Strokes<'f, 'v>, family: Family, target: f64, counts: &'s mut HatchCounts) -> Self {
        let tolerance = strokes.how.tolerance;
        let voxel = strokes.ground.grid().voxel();
        let exact = (tolerance < EXACT_BELOW * voxel).then_some(tolerance);
        let (near, last) = (Near::default(), None);
        Self { strokes, family, target, counts, scale: 0, exact, drift: DRIFT * voxel, near, last }
    }
}

impl OnSurface<'_, '_, '_> {
    /// The principal direction, projected onto the tangent plane of ∇f there ([HATCH-9]). `like` is the current one.
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

impl Lines for OnSurface<'_, '_, '_> {
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

    /// Where it leaves its cell, farther from its ends than the tolerance: what is nearer does not count.
    fn kink(&self, piece: &Piece) -> Option<f64> {
        let grid = self.strokes.ground.grid();
        let near = self.exact? / piece.ends[0].distance(piece.ends[1]);
        let piece = piece.mapped(|x| grid.to_index(x), |t| grid.inverse_axes() * t);
        piece.face([near, 1.0 - near])
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
        // f − target over ‖g‖, without dividing.
        if scale_by_power_of_two(over.abs(), -ground.exponent()) <= self.drift * slope {
            return None;
        }
        let back = self.strokes.put_back(x, self.target)?;
        self.counts.put_back += 1;
        Some(back)
    }
}
