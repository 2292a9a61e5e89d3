//! Errors in a phantom's name and parameters.

use crate::memory::NoRoom;
use crate::space::SpaceError;
use crate::volume::{NotInVolume, VolumeError};

/// A fault that makes a phantom impossible.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PhantomError {
    /// No phantom has that name.
    #[error("no phantom is called `{name}`{}; phantoms: {}", suggestion(nearest), known.join(", "))]
    UnknownName {
        /// The name given.
        name: String,
        /// The known name that is nearest, if one is near.
        nearest: Option<&'static str>,
        /// Every known name.
        known: Vec<&'static str>,
    },
    /// The phantom has no parameter of that name.
    #[error("phantom `{phantom}` has no parameter `{param}`{}; parameters: {}", suggestion(nearest), known.join(", "))]
    UnknownParam {
        /// The phantom's name.
        phantom: &'static str,
        /// The name given.
        param: String,
        /// The known name that is nearest, if one is near.
        nearest: Option<&'static str>,
        /// Every parameter of this phantom.
        known: Vec<&'static str>,
    },
    /// A parameter is given twice.
    #[error("phantom `{phantom}`: parameter `{param}` is given twice")]
    Repeated {
        /// The phantom's name.
        phantom: &'static str,
        /// The parameter's name.
        param: &'static str,
    },
    /// A parameter's value is not allowed.
    #[error("phantom `{phantom}`: parameter `{param}` is {value}, expected {expected}")]
    OutOfRange {
        /// The phantom's name.
        phantom: &'static str,
        /// The parameter's name.
        param: &'static str,
        /// The value given.
        value: f64,
        /// The values allowed, in words.
        expected: String,
    },
    /// Parameters that are allowed one by one, but not together.
    #[error("phantom `{phantom}`: {fault}")]
    Together {
        /// The phantom's name.
        phantom: &'static str,
        /// The parameters, and the condition that they must meet.
        fault: String,
    },
    /// Voxels that the phantom does not have.
    #[error(transparent)]
    NotInVolume(#[from] NotInVolume),
    /// The phantom's grid is impossible.
    #[error(transparent)]
    Space(#[from] SpaceError),
    /// The phantom's volume is impossible.
    #[error(transparent)]
    Volume(#[from] VolumeError),
    /// The memory budget does not allow the voxels.
    #[error("{} × {} × {} voxels need {no_room}", dims[0], dims[1], dims[2])]
    Memory {
        /// Voxels along x, y, z.
        dims: [usize; 3],
        /// The need, and the memory that is free.
        no_room: NoRoom,
    },
}

fn suggestion(nearest: &Option<&'static str>) -> String {
    nearest.map(|n| format!(", did you mean `{n}`?")).unwrap_or_default()
}
