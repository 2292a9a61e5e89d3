//! `raw = { … }` of `[volume]`: voxels without a header ([IO-1]).

use super::layout::{LONGEST_AXIS, SPACING, VOXEL_TYPE};
use crate::document::declare::keys;
use crate::document::describe::Table;
use crate::document::kind::{Choice, ChoiceOption, Whole, Wholes};
pub use crate::volume::RawLayout;
use crate::volume::VoxelType;

/// Voxels along each axis.
const SIZE: Wholes<3> = Wholes {
    what: "a size [x, y, z]",
    each: Whole { lo: 1, hi: LONGEST_AXIS },
    product: u64::MAX >> 4,
    of_what: "voxels",
};

/// Whether the bytes of a number come highest first.
const IS_BIG_ENDIAN: Choice<bool> = Choice {
    options: &[
        ChoiceOption::new("little", false, "Lowest byte first."),
        ChoiceOption::new("big", true, "Highest byte first."),
    ],
};

/// The description of `raw = { … }`.
pub(super) static RAW: Table<RawLayout> = Table::new(
    "raw",
    "Layout of a file without a header.",
    || RawLayout { size: [0; 3], voxel_type: VoxelType::U8, big_endian: false, spacing: [1.0; 3], skip: 0 },
    keys! { RawLayout {
        /// Voxels along x, y, z; x is fastest.
        size: key("IO-1", SIZE).required();
        /// Stored type of a voxel.
        voxel_type: key("IO-1", VOXEL_TYPE).named("type").required();
        /// Order of the bytes of a number.
        big_endian: key("IO-1", IS_BIG_ENDIAN).named("endian");
        /// World units between voxels.
        spacing: key("SPACE-2", SPACING);
        /// Bytes before the first voxel.
        skip: key("IO-1", Whole { lo: 0, hi: i64::MAX as u64 });
    } },
);
