//! One brick: its voxels, and their precomputed range, box and hash.

use crate::volume::Voxel;

/// Voxels along the side of a brick. `benches/runs/bricks.md` compares sides.
pub const SIDE: usize = 16;

/// Voxels of a brick.
pub(super) const VOXELS: usize = SIDE * SIDE * SIDE;

/// [`SIDE`]³ voxels, x fastest. Voxels beyond the border of the volume repeat the last ones inside.
#[derive(Debug)]
pub struct Brick<V> {
    voxels: Box<[V]>,
    range: [V; 2],
    occupied: Option<[[u8; 3]; 2]>,
    hash: u64,
}

impl<V: Voxel> Brick<V> {
    /// Makes a brick of voxels, and measures them. Voxels before `extent` lie in the volume.
    ///
    /// # Panics
    /// If there are not [`SIDE`]³ voxels, or no extent.
    pub(super) fn new(mut voxels: Box<[V]>, extent: [usize; 3]) -> Self {
        assert_eq!(voxels.len(), VOXELS);
        repeat_last(&mut voxels, extent);
        let (mut range, mut occupied) = ([voxels[0]; 2], None);
        for (row, line) in voxels.chunks_exact(SIDE).enumerate() {
            for &v in line {
                range = [if v < range[0] { v } else { range[0] }, if v > range[1] { v } else { range[1] }];
            }
            let is_set = |v: &V| v.to_f64() != 0.0;
            if let (Some(first), Some(last)) = (line.iter().position(is_set), line.iter().rposition(is_set)) {
                let [y, z] = [row % SIDE, row / SIDE];
                let [lo, hi] = [[first, y, z], [last, y, z]].map(|voxel| voxel.map(|i| i as u8));
                let [least, most] = occupied.unwrap_or([lo, hi]);
                occupied =
                    Some([std::array::from_fn(|a| lo[a].min(least[a])), std::array::from_fn(|a| hi[a].max(most[a]))]);
            }
        }
        Self { range, occupied, hash: hash(&voxels), voxels }
    }

    /// The voxels, x fastest.
    #[inline(always)]
    pub fn voxels(&self) -> &[V] {
        &self.voxels
    }

    /// The lowest and the highest voxel.
    pub fn range(&self) -> [V; 2] {
        self.range
    }

    /// The first and the last voxel of the smallest box around the voxels that are not 0; none if all are 0. Voxels
    /// that the border repeats count.
    pub fn occupied(&self) -> Option<[[usize; 3]; 2]> {
        self.occupied.map(|ends| ends.map(|voxel| voxel.map(usize::from)))
    }

    /// The brick's hash. Equal bricks have equal hashes.
    pub(super) fn hash(&self) -> u64 {
        self.hash
    }

    /// Whether two bricks have the same voxels, bit by bit.
    pub(super) fn equals(&self, other: &Self) -> bool {
        self.hash == other.hash && same(&self.voxels, &other.voxels)
    }
}

/// Whether two values are the same number. 0 and −0 differ.
#[inline(always)]
pub(super) fn is_same<V: Voxel>(a: V, b: V) -> bool {
    a == b && a.to_f64().to_bits() == b.to_f64().to_bits()
}

/// Whether voxels are the same, bit by bit.
pub(super) fn same<V: Voxel>(a: &[V], b: &[V]) -> bool {
    a.iter().zip(b).all(|(&a, &b)| is_same(a, b))
}

/// Hashes the voxels of a brick in four chains, since each step waits for the previous one.
pub(super) fn hash<V: Voxel>(voxels: &[V]) -> u64 {
    const ODD: u64 = 0x9e37_79b9_7f4a_7c15;
    let mix = |hash: u64, bits: u64| (hash.rotate_left(5) ^ bits).wrapping_mul(ODD);
    let mut lanes = [1u64, 2, 3, 4];
    for four in voxels.chunks_exact(4) {
        for (lane, v) in lanes.iter_mut().zip(four) {
            *lane = mix(*lane, v.to_f64().to_bits());
        }
    }
    lanes.into_iter().fold(0, mix)
}

/// Replaces the voxels beyond the volume's border by the last ones inside.
pub(super) fn repeat_last<V: Voxel>(voxels: &mut [V], extent: [usize; 3]) {
    let [nx, ny, nz] = extent;
    if nx < SIDE {
        for line in voxels.chunks_exact_mut(SIDE) {
            let last = line[nx - 1];
            line[nx..].fill(last);
        }
    }
    if ny < SIDE {
        for slice in voxels.chunks_exact_mut(SIDE * SIDE) {
            (ny..SIDE).for_each(|y| slice.copy_within((ny - 1) * SIDE..ny * SIDE, y * SIDE));
        }
    }
    let slice = SIDE * SIDE;
    (nz..SIDE).for_each(|z| voxels.copy_within((nz - 1) * slice..nz * slice, z * slice));
}
