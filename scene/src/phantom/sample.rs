//! A phantom on a grid.

use super::PhantomSource;
use super::{Phantom, PhantomError, of_source};
use crate::memory;
use crate::parallel;
use crate::space::Grid;
use crate::volume::{KeptVoxels, Subset, Volume, VoxelType, Voxels};
use glam::DVec3;

/// The phantom's value at each voxel centre. Integer types are rounded to the nearest (ties to even) and clamped to
/// their range. A stored integer is therefore within ½ of an analytic value that is in range. f32 rounds to the
/// nearest. The result does not depend on the number of threads.
///
/// # Errors
/// A volume that does not fit in memory, or one without a finite value (world coordinates beyond 10¹⁵⁰ or so).
pub fn sample(phantom: &dyn Phantom, grid: Grid, voxel_type: VoxelType) -> Result<Volume, PhantomError> {
    let all = KeptVoxels::all(grid.dims());
    sample_kept(phantom, &grid, &all, voxel_type)
}

/// Like [`sample`], at the kept voxels of a grid alone.
fn sample_kept(
    phantom: &dyn Phantom,
    grid: &Grid,
    kept: &KeptVoxels,
    voxel_type: VoxelType,
) -> Result<Volume, PhantomError> {
    let value = |p: DVec3| phantom.value(p);
    macro_rules! stored {
        ($variant:ident, $type:ty, rounded) => {
            Voxels::$variant(fill(grid, kept, |p| value(p).round_ties_even() as $type)?)
        };
        ($variant:ident, $type:ty) => {
            Voxels::$variant(fill(grid, kept, |p| value(p) as $type)?)
        };
    }
    let voxels = match voxel_type {
        VoxelType::U8 => stored!(U8, u8, rounded),
        VoxelType::I8 => stored!(I8, i8, rounded),
        VoxelType::U16 => stored!(U16, u16, rounded),
        VoxelType::I16 => stored!(I16, i16, rounded),
        VoxelType::U32 => stored!(U32, u32, rounded),
        VoxelType::I32 => stored!(I32, i32, rounded),
        VoxelType::U64 => stored!(U64, u64, rounded),
        VoxelType::I64 => stored!(I64, i64, rounded),
        VoxelType::F32 => stored!(F32, f32),
        VoxelType::F64 => stored!(F64, f64),
    };
    Ok(Volume::new(kept.grid(grid)?, voxels, 1.0, 0.0)?)
}

/// A volume of f64 voxels: the value of a formula at each voxel centre, in world space.
///
/// # Errors
/// Same errors as [`sample`].
pub fn from_fn(grid: Grid, value: impl Fn(DVec3) -> f64 + Sync) -> Result<Volume, PhantomError> {
    let voxels = Voxels::F64(fill(&grid, &KeptVoxels::all(grid.dims()), value)?);
    Ok(Volume::new(grid, voxels, 1.0, 0.0)?)
}

/// The phantom's label at each voxel centre, as u16; all 0 where it has none.
///
/// # Errors
/// A volume that does not fit in memory.
pub fn sample_labels(phantom: &dyn Phantom, grid: Grid) -> Result<Volume, PhantomError> {
    let voxels = Voxels::U16(fill(&grid, &KeptVoxels::all(grid.dims()), |p| phantom.label(p))?);
    Ok(Volume::new(grid, voxels, 1.0, 0.0)?)
}

/// The volume that a scene's `phantom` key names.
///
/// # Errors
/// The errors of [`of_source`] and [`sample`].
pub fn generate(source: &PhantomSource) -> Result<Volume, PhantomError> {
    generate_part(source, &Subset::default())
}

/// Like [`generate`], at the voxels of a subset alone ([VOL-1]).
///
/// # Errors
/// The errors of [`generate`], and voxels that the phantom does not have.
pub fn generate_part(source: &PhantomSource, subset: &Subset) -> Result<Volume, PhantomError> {
    let (phantom, grid) = of_source(source)?;
    let kept = subset.of(grid.dims())?;
    sample_kept(phantom.as_ref(), &grid, &kept, source.voxel_type)
}

/// One number a kept voxel, x fastest.
fn fill<T: Copy + Default + Send>(
    grid: &Grid,
    kept: &KeptVoxels,
    at: impl Fn(DVec3) -> T + Sync,
) -> Result<Vec<T>, PhantomError> {
    memory::room_for(kept.len() as u64, size_of::<T>() as u64)
        .map_err(|no_room| PhantomError::Memory { dims: grid.dims(), no_room })?;
    let mut voxels = vec![T::default(); kept.len()];
    let index = |i: usize| DVec3::from(kept.index(i).map(|n| n as f64));
    // Voxels of a simple formula take nanoseconds.
    const RUN: usize = 1 << 12;
    parallel::chunks_mut(&mut voxels, RUN, &|run, voxels| {
        (run * RUN..).zip(voxels).for_each(|(i, voxel)| *voxel = at(grid.to_world(index(i))));
    });
    Ok(voxels)
}
