//! Kinds that phantoms and raw voxels share: types, spacings and how many there may be.

use crate::document::kind::{Bounds, Choice, ChoiceOption, Numbers, Rule};
use crate::volume::VoxelType;

/// Voxels along an axis of a phantom or of raw data, at most: the product of three stays below 2⁶⁴.
pub(super) const LONGEST_AXIS: u64 = 1 << 20;

/// Stored types by name.
pub(super) const VOXEL_TYPE: Choice<VoxelType> = Choice {
    options: &[
        ChoiceOption::new("u8", VoxelType::U8, "Unsigned 8-bit."),
        ChoiceOption::new("i8", VoxelType::I8, "Signed 8-bit."),
        ChoiceOption::new("u16", VoxelType::U16, "Unsigned 16-bit."),
        ChoiceOption::new("i16", VoxelType::I16, "Signed 16-bit."),
        ChoiceOption::new("u32", VoxelType::U32, "Unsigned 32-bit."),
        ChoiceOption::new("i32", VoxelType::I32, "Signed 32-bit."),
        ChoiceOption::new("u64", VoxelType::U64, "Unsigned 64-bit."),
        ChoiceOption::new("i64", VoxelType::I64, "Signed 64-bit."),
        ChoiceOption::new("f32", VoxelType::F32, "IEEE 754 binary32."),
        ChoiceOption::new("f64", VoxelType::F64, "IEEE 754 binary64."),
    ],
};

/// World units between voxels.
pub(super) const SPACING: Numbers<3> =
    Numbers { what: "a spacing [x, y, z]", bounds: Bounds::POSITIVE, rule: Rule::Free };
