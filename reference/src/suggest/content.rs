//! The content of a volume as runs of voxels, which a camera frames and on which an object stands.

use drypoint_scene::memory::{self, NoRoom};
use drypoint_scene::parallel;
use drypoint_scene::shot::Outside;
use drypoint_scene::volume::{Access, Volume, Voxel};
use drypoint_scene::with_access;

/// Connected parts with less than this share of the largest part's solid voxels are not framed, such as specks and
/// head rests.
const PART: f64 = 0.01;

/// The range of values that are content.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ContentRange {
    /// The last value of the content, on the way outwards.
    pub value: f64,
    /// The side on which values are outside.
    pub outside: Outside,
}

impl ContentRange {
    /// Half the depth of a value inside the content, negative outside. It is halved because the whole difference may
    /// overflow.
    pub(super) fn depth(self, value: f64) -> f64 {
        let above = 0.5 * value - 0.5 * self.value;
        if self.outside == Outside::Low { above } else { -above }
    }
}

/// A run of voxels from `first` to `last` along x.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct VoxelRun {
    pub first: usize,
    pub last: usize,
    pub y: usize,
    pub z: usize,
    /// Number of voxels all of whose six neighbours are content, and a little for the other voxels.
    solid: f64,
}

/// The content's voxels, without small parts.
#[derive(Clone, Debug)]
pub(super) struct VolumeContent {
    dims: [usize; 3],
    runs: Vec<VoxelRun>,
}

impl VolumeContent {
    /// Finds the content of a volume. If no value is inside, everything is content.
    ///
    /// # Errors
    /// Memory that the budget does not allow.
    pub(super) fn of(volume: &Volume, inside: ContentRange) -> Result<Self, NoRoom> {
        let dims = volume.dims();
        let (runs, starts) = with_access!(volume, |a| runs(volume, a, inside))?;
        let runs = large_parts(runs, &starts, dims);
        if runs.is_empty() {
            let [nx, ny, nz] = dims;
            memory::room_for(ny as u64 * nz as u64, size_of::<VoxelRun>() as u64)?;
            let row = |i: usize| VoxelRun { last: nx - 1, y: i % ny, z: i / ny, ..VoxelRun::default() };
            return Ok(Self { dims, runs: (0..ny * nz).map(row).collect() });
        }
        Ok(Self { dims, runs })
    }

    /// The runs of voxels.
    pub(super) fn runs(&self) -> &[VoxelRun] {
        &self.runs
    }

    /// Number of the content's voxels in each slice across an axis.
    pub(super) fn slices(&self, axis: usize) -> Vec<f64> {
        let mut slices = vec![0.0; self.dims[axis]];
        for run in &self.runs {
            match axis {
                0 => slices[run.first..=run.last].iter_mut().for_each(|n| *n += 1.0),
                1 => slices[run.y] += (run.last - run.first + 1) as f64,
                _ => slices[run.z] += (run.last - run.first + 1) as f64,
            }
        }
        slices
    }
}

/// The runs row after row, and the first run of each row with the end of the last.
fn runs<A: Access>(volume: &Volume, a: A, inside: ContentRange) -> Result<(Vec<VoxelRun>, Vec<usize>), NoRoom> {
    /// Bytes of a run while parts are found: itself, and its part's first run and size.
    const RUN: u64 = (size_of::<VoxelRun>() + size_of::<usize>() + size_of::<f64>()) as u64;
    let [nx, ny, nz] = a.dims();
    let (slope, intercept) = (volume.slope(), volume.intercept());
    let shown = |x: usize, y: usize, z: usize| inside.depth(slope * a.at(x, y, z).to_f64() + intercept) >= 0.0;
    // Voxels beyond the box count as content: a cut is not a surface.
    let solid = |x: usize, y: usize, z: usize| {
        (y == 0 || shown(x, y - 1, z))
            && (y + 1 == ny || shown(x, y + 1, z))
            && (z == 0 || shown(x, y, z - 1))
            && (z + 1 == nz || shown(x, y, z + 1))
    };
    // Visits the first and the last voxel of each run of a row.
    let visit = |y: usize, z: usize, run: &mut dyn FnMut(usize, usize)| {
        let mut first = None;
        for x in 0..nx {
            match (shown(x, y, z), first) {
                (true, None) => first = Some(x),
                (false, Some(start)) => {
                    run(start, x - 1);
                    first = None;
                }
                _ => {}
            }
        }
        if let Some(start) = first {
            run(start, nx - 1);
        }
    };
    // Runs are counted before they are kept, so that the budget is asked for no more than there are.
    memory::room_for(ny as u64 * nz as u64 + 1, size_of::<usize>() as u64)?;
    let mut starts = vec![0; ny * nz + 1];
    parallel::chunks_mut(&mut starts[1..], ny, &|z, counts| {
        for (y, count) in counts.iter_mut().enumerate() {
            visit(y, z, &mut |_, _| *count += 1);
        }
    });
    for row in 0..ny * nz {
        starts[row + 1] += starts[row];
    }
    memory::room_for(starts[ny * nz] as u64, RUN)?;
    // The runs of each slice fill their own part of the list.
    let mut all = vec![VoxelRun::default(); starts[ny * nz]];
    let (mut slices, mut rest) = (Vec::with_capacity(nz), all.as_mut_slice());
    for z in 0..nz {
        let (slice, after) = rest.split_at_mut(starts[(z + 1) * ny] - starts[z * ny]);
        slices.push(slice);
        rest = after;
    }
    parallel::each_of(slices, &|z, slice: &mut [VoxelRun]| {
        let mut places = slice.iter_mut();
        for y in 0..ny {
            visit(y, z, &mut |first, last| {
                let inner = if first == 0 { 0 } else { first + 1 }..if last + 1 == nx { nx } else { last };
                let whole = inner.filter(|&x| solid(x, y, z)).count();
                // Thin parts have no solid voxels. Their length decides among them.
                let solid = whole as f64 + 1e-3 * (last - first + 1) as f64;
                if let Some(place) = places.next() {
                    *place = VoxelRun { first, last, y, z, solid };
                }
            });
        }
    });
    Ok((all, starts))
}

/// The runs of connected parts that are not small compared with the largest. Voxels that share a corner are
/// connected.
fn large_parts(mut all: Vec<VoxelRun>, starts: &[usize], [_, ny, nz]: [usize; 3]) -> Vec<VoxelRun> {
    let mut parent: Vec<usize> = (0..all.len()).collect();
    for z in 0..nz {
        for y in 0..ny {
            // Each pair of neighbouring rows once.
            for (dy, dz) in [(-1, 0), (-1, -1), (0, -1), (1, -1)] {
                let (Some(v), Some(w)) = (y.checked_add_signed(dy).filter(|v| *v < ny), z.checked_add_signed(dz))
                else {
                    continue;
                };
                let (mut i, mut j) = (starts[z * ny + y], starts[w * ny + v]);
                let (end_i, end_j) = (starts[z * ny + y + 1], starts[w * ny + v + 1]);
                while i < end_i && j < end_j {
                    if all[i].first <= all[j].last + 1 && all[j].first <= all[i].last + 1 {
                        let (a, b) = (root(&mut parent, i), root(&mut parent, j));
                        parent[a.max(b)] = a.min(b);
                    }
                    if all[i].last < all[j].last { i += 1 } else { j += 1 }
                }
            }
        }
    }
    let mut size = vec![0.0; all.len()];
    for (i, run) in all.iter().enumerate() {
        size[root(&mut parent, i)] += run.solid;
    }
    let least = PART * size.iter().copied().fold(0.0, f64::max);
    let mut runs = 0..all.len();
    all.retain(|_| runs.next().is_some_and(|i| size[root(&mut parent, i)] >= least));
    all
}

/// The first run of a part. The path to it is halved on the way.
fn root(parent: &mut [usize], mut i: usize) -> usize {
    while parent[i] != i {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    i
}

#[cfg(test)]
mod tests {
    use super::super::tests::volume;
    use super::*;

    fn from(value: f64) -> ContentRange {
        ContentRange { value, outside: Outside::Low }
    }

    fn ends(body: &VolumeContent) -> [[usize; 3]; 2] {
        let (mut lo, mut hi) = ([usize::MAX; 3], [0; 3]);
        for run in body.runs() {
            for (a, [first, last]) in [[run.first, run.last], [run.y; 2], [run.z; 2]].into_iter().enumerate() {
                (lo[a], hi[a]) = (lo[a].min(first), hi[a].max(last));
            }
        }
        [lo, hi]
    }

    #[test]
    fn specks_and_sheets_are_not_framed_and_thin_branches_are() {
        let block = |[x, y, z]: [usize; 3]| (8..20).contains(&x) && (8..20).contains(&y) && (8..20).contains(&z);
        let branch = |[x, y, z]: [usize; 3]| (19..30).contains(&x) && y == x - 10 && z == 12;
        let speck = |p: [usize; 3]| p == [2, 2, 2] || p == [2, 2, 3];
        let sheet = |[x, y, _]: [usize; 3]| y == 29 && x > 3;
        let v = volume(|p| if block(p) || branch(p) || speck(p) || sheet(p) { 9.0 } else { 0.0 });
        let body = VolumeContent::of(&v, from(5.0)).unwrap();
        assert_eq!(ends(&body), [[8; 3], [29, 19, 19]]);
        let slices = body.slices(0);
        assert_eq!((slices[7], slices[8], slices[19], slices[29], slices[30]), (0.0, 144.0, 144.0, 1.0, 0.0));
        assert_eq!((body.slices(1)[19], body.slices(2)[12]), (145.0, 154.0));
    }

    #[test]
    fn lines_alone_are_content() {
        let body = VolumeContent::of(&volume(|[x, y, z]| if y == 4 && z == 5 && x > 6 { 1.0 } else { 0.0 }), from(0.5))
            .unwrap();
        assert_eq!(ends(&body), [[7, 4, 5], [31, 4, 5]]);
    }

    #[test]
    fn what_is_dark_can_be_content() {
        let block = |p: [usize; 3]| p.iter().all(|i| (8..20).contains(i));
        let body = VolumeContent::of(
            &volume(|p| if block(p) { -4.0 } else { 9.0 }),
            ContentRange { value: 5.0, outside: Outside::High },
        )
        .unwrap();
        assert_eq!(ends(&body), [[8; 3], [19; 3]]);
    }

    #[test]
    fn nothing_is_everything() {
        let body = VolumeContent::of(&volume(|_| 0.0), from(1.0)).unwrap();
        assert_eq!(ends(&body), [[0; 3], [31; 3]]);
    }
}
