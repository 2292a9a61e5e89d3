//! Parameters of phantoms: names, defaults that fit the grid, and what is allowed.

use super::Phantom;
use super::error::PhantomError;
use super::placed::{Edge, Formula, Placed};
use crate::nearest::nearest;
use crate::space::Grid;
use crate::volume::VoxelType;
use std::fmt;

/// The description of a phantom: one row of [`super::describe`].
#[derive(Clone, Copy, Debug)]
pub struct About {
    /// The name in a scene and on the command line.
    pub name: &'static str,
    /// One line that describes the phantom, with the formula if it is short.
    pub doc: &'static str,
    /// The parameters.
    pub params: &'static [Param],
    /// Makes the phantom; an error says which parameters contradict each other.
    pub(super) build: fn(&Args) -> Result<Box<dyn Phantom>, String>,
}

/// One parameter of a phantom.
#[derive(Clone, Copy, Debug)]
pub struct Param {
    /// The letter of the formula.
    pub name: &'static str,
    /// One line that describes the parameter.
    pub doc: &'static str,
    /// The value if none is given.
    pub default: Preset,
    /// The allowed values.
    pub allowed: Allowed,
}

/// A default that fits the grid. L is the smallest side of the field's box in world units. Axes of length 1 count only
/// if all axes have length 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Preset {
    /// A number.
    Number(f64),
    /// A multiple of L.
    Side(f64),
    /// Voxels ([SPACE-5]).
    Voxels(f64),
    /// Voxels where the stored type is an integer, 0 where it is a float.
    IntegerVoxels(f64),
    /// The top of the values: 255, but 127 where the stored type is i8.
    Top,
}

/// The set of values that a parameter can have. All of them are finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Allowed {
    /// Every number.
    Any,
    /// Above 0.
    Positive,
    /// 0 or above.
    NonNegative,
    /// A whole number between two, both included.
    Whole(f64, f64),
}

impl fmt::Display for Preset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(x) => write!(f, "{x}"),
            Self::Side(x) => write!(f, "{x} L"),
            Self::Voxels(x) => write!(f, "{x} voxels"),
            Self::IntegerVoxels(x) => write!(f, "{x} voxels for integer types, else 0"),
            Self::Top => write!(f, "255 (i8: 127)"),
        }
    }
}

impl fmt::Display for Allowed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Any => write!(f, "a finite number"),
            Self::Positive => write!(f, "a number above 0"),
            Self::NonNegative => write!(f, "a number that is 0 or above"),
            Self::Whole(lo, hi) => write!(f, "a whole number from {lo} to {hi}"),
        }
    }
}

impl Allowed {
    /// Whether a value is allowed.
    pub fn holds(&self, x: f64) -> bool {
        x.is_finite()
            && match self {
                Self::Any => true,
                Self::Positive => x > 0.0,
                Self::NonNegative => x >= 0.0,
                Self::Whole(lo, hi) => x == x.trunc() && (lo..=hi).contains(&&x),
            }
    }
}

/// The edge width of a distance phantom.
pub(super) const W: Param = Param {
    name: "w",
    doc: "edge width in world units: value = high / (1 + exp(−d/w)); 0: the distance d itself",
    default: Preset::IntegerVoxels(1.0),
    allowed: Allowed::NonNegative,
};

/// The value that the inside of a phantom approaches.
pub(super) const HIGH: Param =
    Param { name: "high", doc: "the highest value", default: Preset::Top, allowed: Allowed::Any };

/// Seed of the random numbers.
pub(super) const SEED: Param = Param {
    name: "seed",
    doc: "seed of the random numbers",
    default: Preset::Number(0.0),
    allowed: Allowed::Whole(0.0, 9_007_199_254_740_992.0),
};

/// The input to a phantom: the grid that it is sampled on, and a value for each of its parameters.
pub(super) struct Args<'a> {
    /// The grid that the phantom is sampled on.
    pub(super) grid: &'a Grid,
    values: Vec<f64>,
}

impl<'a> Args<'a> {
    /// Checks the parameters given against those of the phantom and fills in the defaults.
    pub(super) fn new(
        about: &About,
        grid: &'a Grid,
        voxel_type: VoxelType,
        given: &[(String, f64)],
    ) -> Result<Self, PhantomError> {
        // The parameters given, each known, allowed, and given once.
        let mut values = vec![None; about.params.len()];
        for (name, value) in given {
            let Some(i) = about.params.iter().position(|p| p.name == name) else {
                let known: Vec<_> = about.params.iter().map(|p| p.name).collect();
                let nearest = nearest(name, known.iter().copied());
                return Err(PhantomError::UnknownParam { phantom: about.name, param: name.clone(), nearest, known });
            };
            let param = &about.params[i];
            if !param.allowed.holds(*value) {
                let expected = param.allowed.to_string();
                return Err(PhantomError::OutOfRange {
                    phantom: about.name,
                    param: param.name,
                    value: *value,
                    expected,
                });
            }
            if values[i].replace(*value).is_some() {
                return Err(PhantomError::Repeated { phantom: about.name, param: param.name });
            }
        }
        // Defaults of the others, for this grid and voxel type.
        let default = |p: &Param| match p.default {
            Preset::Number(x) => x,
            Preset::Side(x) => x * smallest_side(grid),
            Preset::Voxels(x) => x * grid.voxel(),
            Preset::IntegerVoxels(x) => {
                if voxel_type.is_integer() {
                    x * grid.voxel()
                } else {
                    0.0
                }
            }
            Preset::Top => {
                if voxel_type == VoxelType::I8 {
                    127.0
                } else {
                    255.0
                }
            }
        };
        let values = values.iter().zip(about.params).map(|(v, p)| v.unwrap_or_else(|| default(p))).collect();
        Ok(Self { grid, values })
    }

    /// The values in the order of the phantom's table.
    ///
    /// # Panics
    /// If the table has another number of rows: a slip in the phantom's own file, never in its input.
    pub(super) fn values<const N: usize>(&self) -> [f64; N] {
        std::array::from_fn(|i| self.values[i])
    }

    /// A phantom whose formula is the value, centred on the grid's box.
    pub(super) fn field(&self, formula: impl Formula + 'static) -> Box<dyn Phantom> {
        self.distance(formula, 0.0, 1.0)
    }

    /// A phantom whose formula is a distance, centred on the grid's box. Its edge has the width `w`; 0 gives the
    /// distance itself.
    pub(super) fn distance(&self, formula: impl Formula + 'static, w: f64, high: f64) -> Box<dyn Phantom> {
        Box::new(Placed { formula, centre: self.grid.centre(), edge: Edge { w, high } })
    }
}

/// L: the smallest side of the field's box in world units. Axes of length 1 count only if all axes have length 1.
fn smallest_side(grid: &Grid) -> f64 {
    let (dims, spacing) = (grid.dims(), grid.spacing());
    let side = (0..3).filter(|&a| dims[a] > 1).map(|a| (dims[a] - 1) as f64 * spacing[a]).fold(f64::INFINITY, f64::min);
    if side.is_finite() { side } else { grid.voxel() }
}
