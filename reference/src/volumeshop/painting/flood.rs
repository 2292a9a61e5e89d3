//! Watershed by a priority flood: water rises from markers over a relief, and each marker's water forms a basin
//! ([VS-6]).

use super::region::{neighbour, steps};
use drypoint_scene::memory::{self, NoRoom};
use drypoint_scene::tables::Connectivity;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A voxel from which a basin rises.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Marker {
    /// The voxel.
    pub voxel: [usize; 3],
    /// The basin, from 1 on.
    pub basin: u32,
}

/// Bytes of a voxel in the queue.
const WAITING: u64 = size_of::<(u64, u64, usize)>() as u64;

/// The basin of each voxel, x fastest; 0 if no flood reaches it.
///
/// The lowest voxel at the water's edge is flooded next. Of equally low ones, the water takes the first that it
/// reached. A voxel below the water gets the water's height. It belongs to the basin that reached it first. Water flows
/// through faces, and only through voxels that let it pass. `relief` is called once for each of these voxels. The queue
/// takes far longer than a call of either function, so one compiled copy serves all volumes and fields.
///
/// # Errors
/// The budget does not allow the memory.
pub fn basins(
    dims: [usize; 3],
    markers: &[Marker],
    passes: &dyn Fn([usize; 3]) -> bool,
    relief: &mut dyn FnMut([usize; 3]) -> f64,
) -> Result<Vec<u32>, NoRoom> {
    let voxels: usize = dims.iter().product();
    memory::room_for(voxels as u64, size_of::<u32>() as u64 + WAITING)?;
    let mut basins = vec![0; voxels];
    let index = |[x, y, z]: [usize; 3]| (z * dims[1] + y) * dims[0] + x;
    let mut edge = BinaryHeap::new();
    let mut age = 0u64;
    for marker in markers {
        // If two markers lie at one voxel, the last one counts.
        let basin: &mut u32 = &mut basins[index(marker.voxel)];
        if *basin == 0 {
            edge.push(Reverse((height(relief(marker.voxel)), age, index(marker.voxel))));
            age += 1;
        }
        *basin = marker.basin;
    }
    let steps = steps(Connectivity::Faces);
    while let Some(Reverse((water, _, i))) = edge.pop() {
        let voxel = [i % dims[0], i / dims[0] % dims[1], i / (dims[0] * dims[1])];
        for next in steps.iter().filter_map(|&step| neighbour(dims, voxel, step)) {
            let at = index(next);
            if basins[at] == 0 && passes(next) {
                basins[at] = basins[i];
                edge.push(Reverse((height(relief(next)).max(water), age, at)));
                age += 1;
            }
        }
    }
    Ok(basins)
}

/// An integer with the order of the numbers. 0 and −0 are equal.
fn height(relief: f64) -> u64 {
    let bits = (relief + 0.0).to_bits();
    if bits >> 63 == 0 { bits | 1 << 63 } else { !bits }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heights_are_in_the_order_of_numbers() {
        let numbers = [f64::NEG_INFINITY, -2.0, -1e-300, 0.0, 1e-300, 1.5, f64::INFINITY];
        assert!(numbers.windows(2).all(|pair| height(pair[0]) < height(pair[1])));
        assert_eq!(height(-0.0), height(0.0));
    }

    /// Two valleys and a ridge between them: each marker floods its valley, and the ridge goes to the lower side, whose water
    /// comes to its foot first.
    #[test]
    fn the_ridge_parts_the_basins() {
        let relief = [3.0, 1.0, 2.0, 9.0, 4.0, 0.0, 5.0];
        let marker = |x, basin| Marker { voxel: [x, 0, 0], basin };
        let flood = |markers: &[Marker]| basins([7, 1, 1], markers, &|_| true, &mut |[x, ..]| relief[x]).unwrap();
        assert_eq!(flood(&[marker(1, 1), marker(5, 2)]), [1, 1, 1, 1, 2, 2, 2]);
        assert_eq!(flood(&[marker(5, 7)]), [7; 7]);
        assert_eq!(flood(&[]), [0; 7]);
        assert_eq!(flood(&[marker(5, 7), marker(5, 3)]), [3; 7]);
        let wall = basins([7, 1, 1], &[marker(1, 1)], &|[x, ..]| x != 3, &mut |[x, ..]| relief[x]).unwrap();
        assert_eq!(wall, [1, 1, 1, 0, 0, 0, 0]);
    }
}
