//! Region growing: the accepted voxels that are connected with a seed ([VS-6]).

use drypoint_scene::memory::{self, NoRoom};
use drypoint_scene::tables::Connectivity;

/// A set of voxels.
#[derive(Clone, Debug)]
pub struct VoxelSet {
    dims: [usize; 3],
    /// One bit for each voxel, x fastest.
    bits: Vec<u64>,
    bounds: [[usize; 3]; 2],
    count: usize,
}

impl VoxelSet {
    fn has_index(&self, i: usize) -> bool {
        self.bits[i / 64] >> (i % 64) & 1 == 1
    }

    fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.dims[1] + y) * self.dims[0] + x
    }

    fn add(&mut self, voxel: [usize; 3]) {
        let i = self.index(voxel);
        self.bits[i / 64] |= 1 << (i % 64);
        let [lo, hi] = self.bounds;
        self.bounds = [std::array::from_fn(|a| lo[a].min(voxel[a])), std::array::from_fn(|a| hi[a].max(voxel[a] + 1))];
        self.count += 1;
    }

    /// Whether the region has a voxel.
    ///
    /// # Panics
    /// If the voxel lies outside the volume.
    pub fn has(&self, voxel: [usize; 3]) -> bool {
        self.has_index(self.index(voxel))
    }

    /// The first voxel of the box about the region, and the voxel after its last.
    pub fn bounds(&self) -> [[usize; 3]; 2] {
        self.bounds
    }

    /// Number of voxels.
    pub fn count(&self) -> usize {
        self.count
    }
}

/// The offsets to the neighbours of a voxel.
pub(super) fn steps(connect: Connectivity) -> Vec<[isize; 3]> {
    let most = match connect {
        Connectivity::Faces => 1,
        Connectivity::Edges => 2,
        Connectivity::Corners => 3,
    };
    let all = (0..27).map(|i| [i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1]);
    let along = |step: &[isize; 3]| step.iter().map(|d| d.abs()).sum::<isize>();
    all.filter(|step| (1..=most).contains(&along(step))).collect()
}

/// The neighbour of a voxel, if there is one.
pub(super) fn neighbour(dims: [usize; 3], voxel: [usize; 3], step: [isize; 3]) -> Option<[usize; 3]> {
    let mut next = [0; 3];
    for a in 0..3 {
        next[a] = voxel[a].checked_add_signed(step[a]).filter(|&i| i < dims[a])?;
    }
    Some(next)
}

/// The seed, and all accepted voxels that are connected with it through accepted voxels.
///
/// # Errors
/// The budget does not allow the memory.
pub fn grown(
    dims: [usize; 3],
    seed: [usize; 3],
    connect: Connectivity,
    accepts: impl Fn([usize; 3]) -> bool,
) -> Result<VoxelSet, NoRoom> {
    let voxels: usize = dims.iter().product();
    // A bit for each voxel, and at most one entry in the list for it.
    memory::room_for(voxels as u64, size_of::<usize>() as u64 + 1)?;
    let mut region =
        VoxelSet { dims, bits: vec![0; voxels.div_ceil(64)], bounds: [seed, seed.map(|i| i + 1)], count: 0 };
    region.add(seed);
    let steps = steps(connect);
    let mut open = vec![region.index(seed)];
    while let Some(i) = open.pop() {
        let voxel = [i % dims[0], i / dims[0] % dims[1], i / (dims[0] * dims[1])];
        for next in steps.iter().filter_map(|&step| neighbour(dims, voxel, step)) {
            if !region.has(next) && accepts(next) {
                region.add(next);
                open.push(region.index(next));
            }
        }
    }
    Ok(region)
}
