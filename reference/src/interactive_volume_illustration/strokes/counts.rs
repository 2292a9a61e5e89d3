//! Counts of strokes, rejected cells and ends of strokes, by cause ([HATCH-3], [HATCH-7], [HATCH-8]).

use std::ops::AddAssign;

/// The reason why a place has no direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoDirection {
    /// The place lies outside the volume, or in a cell that touches a masked voxel.
    Volume,
    /// The gradient is no larger than its rounding error ([PREC-3]).
    Gradient,
    /// No estimate is certain. Within the data's error the surface bends equally in all directions, or the estimates
    /// at two scales disagree, or the volume's border is too near.
    Umbilic,
}

/// The reason why a selected cell has no stroke.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RejectCause {
    /// The straight line along the gradient does not meet the surface within the cell's diagonal, or 60 evaluations
    /// find no crossing.
    NoSurface,
    /// The place where the line meets the surface has no direction.
    Direction(NoDirection),
    /// The stroke has fewer than two vertices.
    Short,
}

/// The reason why a stroke ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StrokeEnd {
    /// The stroke has its full length.
    Length,
    /// The direction differs too much from the first one.
    Angle,
    /// The stroke leaves the volume.
    Volume,
    /// The place has no direction.
    Direction,
    /// The gradient is too small.
    Gradient,
    /// The tolerance requires a step below the smallest one.
    Step,
    /// The directions turn within the smallest step.
    Turns,
    /// The stroke is closed: it is back at its beginning.
    Closed,
}

/// Numbers of ends of strokes, by cause. A stroke has two ends; a closed one counts as one end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[allow(missing_docs)]
pub struct StrokeEnds {
    pub length: u64,
    pub angle: u64,
    pub volume: u64,
    pub direction: u64,
    pub gradient: u64,
    pub step: u64,
    pub turns: u64,
    pub closed: u64,
}

impl StrokeEnds {
    /// Counts one end.
    pub(in super::super) fn count(&mut self, stop: StrokeEnd) {
        *match stop {
            StrokeEnd::Length => &mut self.length,
            StrokeEnd::Angle => &mut self.angle,
            StrokeEnd::Volume => &mut self.volume,
            StrokeEnd::Direction => &mut self.direction,
            StrokeEnd::Gradient => &mut self.gradient,
            StrokeEnd::Step => &mut self.step,
            StrokeEnd::Turns => &mut self.turns,
            StrokeEnd::Closed => &mut self.closed,
        } += 1;
    }

    /// Names and counts, in the order of [HATCH-8].
    pub fn named(&self) -> [(&'static str, u64); 8] {
        [
            ("length", self.length),
            ("angle", self.angle),
            ("volume", self.volume),
            ("direction", self.direction),
            ("gradient", self.gradient),
            ("step", self.step),
            ("turns", self.turns),
            ("closed", self.closed),
        ]
    }
}

impl AddAssign for StrokeEnds {
    fn add_assign(&mut self, b: Self) {
        self.length += b.length;
        self.angle += b.angle;
        self.volume += b.volume;
        self.direction += b.direction;
        self.gradient += b.gradient;
        self.step += b.step;
        self.turns += b.turns;
        self.closed += b.closed;
    }
}

/// Numbers of cells without a stroke, by cause.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[allow(missing_docs)]
pub struct RejectCounts {
    pub no_surface: u64,
    pub no_direction: u64,
    pub short: u64,
}

impl RejectCounts {
    /// Number of all cells without a stroke.
    pub fn total(&self) -> u64 {
        self.no_surface + self.no_direction + self.short
    }

    /// Counts one cell.
    pub(in super::super) fn count(&mut self, rejected: RejectCause) {
        *match rejected {
            RejectCause::NoSurface => &mut self.no_surface,
            RejectCause::Direction(_) => &mut self.no_direction,
            RejectCause::Short => &mut self.short,
        } += 1;
    }
}

impl AddAssign for RejectCounts {
    fn add_assign(&mut self, b: Self) {
        self.no_surface += b.no_surface;
        self.no_direction += b.no_direction;
        self.short += b.short;
    }
}

/// Numbers of queries of directions, by scale and cause ([HATCH-3]). With `rule = "raw"` the first scale stands for the
/// field's own Hessian.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DirectionCounts {
    /// Places that got a direction, by the scale that gave it: σ = 1, 2, 4 voxels.
    pub given: [u64; 3],
    /// Estimates refused because the volume's border is too near, by scale.
    pub border: [u64; 3],
    /// Estimates refused because the curvatures are nearly equal, by scale.
    pub umbilic: [u64; 3],
    /// Estimates refused because the difference of the curvatures may be noise of the data, by scale.
    pub noise: [u64; 3],
    /// Estimates refused because the lines at σ and 1.5 σ disagree, by scale.
    pub disagree: [u64; 3],
    /// Places whose gradient is no larger than its rounding error.
    pub gradient: u64,
    /// Places whose direction was interpolated between stored ones.
    pub between: u64,
    /// Places whose voxels have no directions, or directions that disagree.
    pub missing: u64,
}

impl DirectionCounts {
    /// Number of principal directions found.
    pub fn directions(&self) -> u64 {
        self.given.iter().sum::<u64>() + self.between
    }
}

impl AddAssign for DirectionCounts {
    fn add_assign(&mut self, b: Self) {
        for i in 0..3 {
            self.given[i] += b.given[i];
            self.border[i] += b.border[i];
            self.umbilic[i] += b.umbilic[i];
            self.noise[i] += b.noise[i];
            self.disagree[i] += b.disagree[i];
        }
        self.gradient += b.gradient;
        self.between += b.between;
        self.missing += b.missing;
    }
}

/// Statistics of growing strokes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct HatchCounts {
    /// Strokes along the first direction.
    pub strokes: u64,
    /// Strokes along the second direction ([HATCH-11]).
    pub cross: u64,
    /// Cells without a stroke.
    pub rejected: RejectCounts,
    /// Ends of all strokes.
    pub stops: StrokeEnds,
    /// Queries of directions.
    pub scales: DirectionCounts,
    /// Steps whose end was put back onto the iso-surface.
    pub put_back: u64,
    /// Strokes that lost a part because it dips behind the surface however finely it is divided.
    pub cut: u64,
}

impl AddAssign for HatchCounts {
    fn add_assign(&mut self, b: Self) {
        self.strokes += b.strokes;
        self.cross += b.cross;
        self.rejected += b.rejected;
        self.stops += b.stops;
        self.scales += b.scales;
        self.put_back += b.put_back;
        self.cut += b.cut;
    }
}
