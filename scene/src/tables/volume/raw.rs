//! `raw = { … }` of `[volume]`: voxels without a header ([IO-1]).

use super::layout::{LONGEST_AXIS, SPACING, VOXEL_TYPE};
use crate::document::declare::key;
use crate::document::describe::{Key, Slot, Table};
use crate::document::kind::{Choice, ChoiceOption, Whole, Wholes};
pub use crate::volume::RawLayout;
use crate::volume::VoxelType;

/// The description of `raw = { … }`.
pub(super) static RAW: Table<RawLayout> = Table::new(
    "raw",
    "Layout of a file without a header.",
    || RawLayout { size: [0; 3], voxel_type: VoxelType::U8, big_endian: false, spacing: [1.0; 3], skip: 0 },
    &[
        key!(
            RawLayout.size,
            "Voxels along x, y, z; x is fastest.",
            "IO-1",
            Wholes {
                what: "a size [x, y, z]",
                each: Whole { lo: 1, hi: LONGEST_AXIS },
                product: u64::MAX >> 4,
                of_what: "voxels",
            }
        )
        .required(),
        Key::new(
            "type",
            "IO-1",
            "Stored type of a voxel.",
            &Slot { kind: VOXEL_TYPE, get: |t: &RawLayout| Some(t.voxel_type), set: |t, v| t.voxel_type = v },
        )
        .required(),
        Key::new(
            "endian",
            "IO-1",
            "Order of the bytes of a number.",
            &Slot {
                kind: Choice {
                    options: &[
                        ChoiceOption::new("little", false, "Lowest byte first."),
                        ChoiceOption::new("big", true, "Highest byte first."),
                    ],
                    later: &[],
                },
                get: |t: &RawLayout| Some(t.big_endian),
                set: |t, v| t.big_endian = v,
            },
        ),
        key!(RawLayout.spacing, "World units between voxels.", "SPACE-2", SPACING),
        key!(RawLayout.skip, "Bytes before the first voxel.", "IO-1", Whole { lo: 0, hi: i64::MAX as u64 }),
    ],
);
