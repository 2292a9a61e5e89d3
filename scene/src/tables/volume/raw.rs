//! `raw = { … }` of `[volume]`: voxels without a header ([IO-1]).

use super::layout::{LONGEST_AXIS, SPACING, VOXEL_TYPE};
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
        Key::new(
            "size",
            "IO-1",
            "Voxels along x, y, z; x is fastest.",
            &Slot {
                kind: Wholes {
                    what: "a size [x, y, z]",
                    each: Whole { lo: 1, hi: LONGEST_AXIS },
                    product: u64::MAX >> 4,
                    of_what: "voxels",
                },
                get: |t: &RawLayout| Some(t.size),
                set: |t, v| t.size = v,
            },
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
        Key::new(
            "spacing",
            "SPACE-2",
            "World units between voxels.",
            &Slot { kind: SPACING, get: |t: &RawLayout| Some(t.spacing), set: |t, v| t.spacing = v },
        ),
        Key::new(
            "skip",
            "IO-1",
            "Bytes before the first voxel.",
            &Slot {
                kind: Whole { lo: 0, hi: i64::MAX as u64 },
                get: |t: &RawLayout| Some(t.skip),
                set: |t, v| t.skip = v,
            },
        ),
    ],
);
