//! What was grown and what was not, and why ([HATCH-3], [HATCH-7], [HATCH-8]).

use std::ops::AddAssign;

/// Why a place has no direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoDirection {
    /// It lies outside the volume, or in a cell that touches a masked voxel.
    Volume,
    /// The gradient is rounding ([PREC-3]).
    Gradient,
    /// Within the data's error the surface bends the same way in all directions, the estimates of the direction disagree, or
    /// the volume's border is too near to tell.
    Umbilic,
}

/// Why a cell that was drawn has no stroke.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rejected {
    /// The straight line of the gradient does not meet the surface within the cell's diagonal, or none was found in 60
    /// evaluations.
    NoSurface,
    /// There is no direction where it does.
    Direction(NoDirection),
    /// The stroke has no two vertices.
    Short,
}

/// Why a stroke ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// It has its length.
    Length,
    /// Its direction is too far from the first.
    Angle,
    /// It leaves the volume.
    Volume,
    /// There is no direction.
    Direction,
    /// The gradient is too small.
    Gradient,
    /// The tolerance asks for a step below the smallest.
    Step,
    /// The directions turn within the smallest step.
    Turns,
    /// It is back at its beginning.
    Closed,
}

/// Ends of strokes by cause: two each, one of those that are closed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[allow(missing_docs)]
pub struct Stops {
    pub length: u64,
    pub angle: u64,
    pub volume: u64,
    pub direction: u64,
    pub gradient: u64,
    pub step: u64,
    pub turns: u64,
    pub closed: u64,
}

impl Stops {
    /// Counts one.
    pub(super) fn count(&mut self, stop: Stop) {
        *match stop {
            Stop::Length => &mut self.length,
            Stop::Angle => &mut self.angle,
            Stop::Volume => &mut self.volume,
            Stop::Direction => &mut self.direction,
            Stop::Gradient => &mut self.gradient,
            Stop::Step => &mut self.step,
            Stop::Turns => &mut self.turns,
            Stop::Closed => &mut self.closed,
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

impl AddAssign for Stops {
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

/// Cells without a stroke by cause.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[allow(missing_docs)]
pub struct Rejections {
    pub no_surface: u64,
    pub no_direction: u64,
    pub short: u64,
}

impl Rejections {
    /// All of them.
    pub fn total(&self) -> u64 {
        self.no_surface + self.no_direction + self.short
    }

    /// Counts one.
    pub(super) fn count(&mut self, rejected: Rejected) {
        *match rejected {
            Rejected::NoSurface => &mut self.no_surface,
            Rejected::Direction(_) => &mut self.no_direction,
            Rejected::Short => &mut self.short,
        } += 1;
    }
}

impl AddAssign for Rejections {
    fn add_assign(&mut self, b: Self) {
        self.no_surface += b.no_surface;
        self.no_direction += b.no_direction;
        self.short += b.short;
    }
}

/// Places at which a direction was asked for, by scale and cause ([HATCH-3]); with `rule = "raw"` the first scale stands for
/// the field's own.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Scales {
    /// Places that got one, by the scale that counted: σ = 1, 2, 4 voxels.
    pub given: [u64; 3],
    /// By scale, estimates that were refused because the border of the volume is too near.
    pub border: [u64; 3],
    /// … because the curvatures are nearly equal.
    pub umbilic: [u64; 3],
    /// … because their difference may be the data's noise.
    pub noise: [u64; 3],
    /// … because the lines at σ and 1.5 σ disagree.
    pub disagree: [u64; 3],
    /// Places where the gradient is rounding.
    pub gradient: u64,
    /// Places that got one between stored ones.
    pub between: u64,
    /// Places between voxels that have none, or none that agree.
    pub missing: u64,
}

impl Scales {
    /// Principal directions that were given.
    pub fn directions(&self) -> u64 {
        self.given.iter().sum::<u64>() + self.between
    }
}

impl AddAssign for Scales {
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

/// What growing strokes did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct HatchCounts {
    /// Strokes along the first direction.
    pub strokes: u64,
    /// Strokes along the other one ([HATCH-11]).
    pub cross: u64,
    /// Cells without a stroke.
    pub rejected: Rejections,
    /// Ends of all strokes.
    pub stops: Stops,
    /// Directions.
    pub scales: Scales,
    /// Steps that were put back onto their iso-surface.
    pub put_back: u64,
    /// Strokes of which a part was cut off because it dips behind the surface whatever its vertices.
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
