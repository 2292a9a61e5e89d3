//! Connected parts of a volume ([VOL-2]): sets of voxels that touch with their faces.
//!
//! A row of voxels is a list of runs. Runs of neighbouring rows that overlap belong to one part; a union–find over the
//! runs joins them. A part is known by its first voxel in the order of storage.

use super::{Access, Mask, ShownValues, Volume, Voxel};
use crate::memory::{self, NoRoom};
use crate::parallel;
use glam::DVec3;

/// The parts that are kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Keep {
    /// The given number of largest parts.
    Largest(usize),
    /// The parts with at least this share of the largest part's voxels.
    Share(f64),
    /// The part at a point of the world.
    At(DVec3),
}

/// One part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// Number of its voxels.
    pub size: usize,
    /// The linear index of its first voxel.
    pub first: usize,
}

/// A run of shown voxels along x, from `start` to before `end`.
#[derive(Clone, Copy, Debug)]
struct Run {
    start: usize,
    end: usize,
    /// Its part's position among [`Parts::all`]. While parts are found: a run that is nearer to the part's first one.
    part: usize,
}

/// All parts of a volume.
#[derive(Clone, Debug)]
pub struct Parts {
    dims: [usize; 3],
    /// Runs row after row.
    runs: Vec<Run>,
    /// The first run of each row, and the end of the last.
    rows: Vec<usize>,
    /// Parts by size, the largest first; of equal ones that with the lower first voxel.
    all: Vec<Part>,
}

impl Parts {
    /// Finds the parts of the voxels whose value is shown. Voxels that are not finite in the file belong to none.
    ///
    /// # Errors
    /// Memory that the budget does not allow.
    pub fn find(volume: &Volume, is_shown: &(dyn Fn(f64) -> bool + Sync)) -> Result<Self, NoRoom> {
        let shown = ShownValues::new(volume, is_shown);
        with_access!(volume, |access| Self::of(volume.dims(), access, |stored| shown.has(stored), volume.mask()))
    }

    fn of<A: Access>(
        dims: [usize; 3],
        access: A,
        shown: impl Fn(f64) -> bool + Sync,
        mask: Option<&Mask>,
    ) -> Result<Self, NoRoom> {
        let [nx, ny, nz] = dims;
        let visit = |row: usize, run: &mut dyn FnMut(usize, usize)| {
            let (y, z) = (row % ny, row / ny);
            let mut start = None;
            for x in 0..nx {
                let is_in = shown(access.at(x, y, z).to_f64()) && !mask.is_some_and(|mask| mask.voxel([x, y, z]));
                match (is_in, start) {
                    (true, None) => start = Some(x),
                    (false, Some(first)) => {
                        run(first, x);
                        start = None;
                    }
                    _ => {}
                }
            }
            if let Some(first) = start {
                run(first, nx);
            }
        };
        // Runs are counted before they are kept, so that the budget is asked for no more than there are.
        memory::room_for(ny as u64 * nz as u64 + 1, size_of::<usize>() as u64)?;
        let mut rows: Vec<usize> = vec![0; ny * nz + 1];
        parallel::chunks_mut(&mut rows[1..], ny, &|z, counts| {
            for (row, count) in (z * ny..).zip(counts) {
                visit(row, &mut |_, _| *count += 1);
            }
        });
        for row in 0..ny * nz {
            rows[row + 1] += rows[row];
        }
        // Every run may be a part of its own.
        memory::room_for(rows[ny * nz] as u64, (2 * size_of::<Run>() + size_of::<Part>()) as u64)?;
        let mut runs: Vec<Run> = parallel::gather(ny * nz, ny, &|slice, runs| {
            runs.reserve_exact(rows[slice.end] - rows[slice.start]);
            slice.for_each(|row| visit(row, &mut |start, end| runs.push(Run { start, end, part: 0 })));
        });
        join(&mut runs, &rows, dims);
        let all = order(&mut runs, &rows, nx);
        Ok(Self { dims, runs, rows, all })
    }

    /// Parts by size, the largest first. Of equal parts, the one with the lower first voxel comes first.
    pub fn all(&self) -> &[Part] {
        &self.all
    }

    /// Returns which of all parts are kept. None if there is no part at the point asked for.
    pub fn kept(&self, keep: Keep, volume: &Volume) -> Option<Vec<bool>> {
        let largest = self.all.first().map_or(0, |part| part.size);
        let kept = |keep: &dyn Fn(usize, &Part) -> bool| {
            Some(self.all.iter().enumerate().map(|(i, part)| keep(i, part)).collect())
        };
        match keep {
            Keep::Largest(n) => kept(&|i, _| i < n),
            Keep::Share(share) => kept(&|_, part| part.size as f64 >= share * largest as f64),
            Keep::At(point) => {
                let at = self.part_at(point, volume)?;
                kept(&|i, _| i == at)
            }
        }
    }

    /// The part at a point of the world: the part of the nearest voxel that has one, among the eight voxels around the
    /// point. Points of a surface lie between voxels that are shown and voxels that are not.
    fn part_at(&self, point: DVec3, volume: &Volume) -> Option<usize> {
        let grid = volume.grid();
        let index = grid.to_index(point);
        let [lo, hi] = grid.index_box();
        if !(index.cmpge(lo).all() && index.cmple(hi).all()) {
            return None;
        }
        let corners = (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(|i| i as f64));
        let near = corners.filter_map(|corner| {
            let voxel = (index.floor() + DVec3::from(corner)).clamp(DVec3::ZERO, hi.max(DVec3::ZERO).floor());
            let part = self.part_of(voxel.to_array().map(|i| i as usize))?;
            Some((grid.to_world(voxel).distance_squared(point), part))
        });
        near.reduce(|best, next| if next.0 < best.0 { next } else { best }).map(|(_, part)| part)
    }

    /// The part of a voxel, if it has one.
    fn part_of(&self, [x, y, z]: [usize; 3]) -> Option<usize> {
        let row = z * self.dims[1] + y;
        let runs = &self.runs[self.rows[row]..self.rows[row + 1]];
        let next = runs.partition_point(|run| run.start <= x);
        next.checked_sub(1).map(|i| runs[i]).filter(|run| x < run.end).map(|run| run.part)
    }

    /// Gives the volume's outside value to the parts that are not kept, and to the voxels around them that touch no
    /// kept part. Voxels touch with faces, edges or corners. The outside value is the lowest finite one, or the highest.
    ///
    /// # Errors
    /// Memory that the budget does not allow.
    pub fn isolate(&self, kept: &[bool], volume: &mut Volume, outside_is_high: bool) -> Result<(), NoRoom> {
        if kept.iter().all(|&kept| kept) {
            return Ok(());
        }
        let [nx, ny, _] = self.dims;
        let voxels: usize = self.dims.iter().product();
        memory::room_for(2 * voxels.div_ceil(64) as u64, 8)?;
        // Voxels that touch a kept part or belong to it, and those of the other parts with the voxels around them.
        let mut near = Bits::new(voxels);
        self.grow(&mut near, |part| kept[part]);
        let mut flat = Bits::new(voxels);
        self.grow(&mut flat, |part| !kept[part]);
        flat.remove(&near);
        // A part that touches a kept one with an edge or a corner goes, too.
        for (row, runs) in self.rows.windows(2).enumerate() {
            for run in self.runs[runs[0]..runs[1]].iter().filter(|run| !kept[run.part]) {
                let from = (row / ny * ny + row % ny) * nx;
                flat.set(from + run.start..from + run.end);
            }
        }
        volume.flatten(&|i| flat.has(i), outside_is_high);
        Ok(())
    }

    /// Sets the voxels of some parts and all voxels that touch them.
    fn grow(&self, bits: &mut Bits, of: impl Fn(usize) -> bool) {
        let [nx, ny, nz] = self.dims;
        for (row, runs) in self.rows.windows(2).enumerate() {
            let (y, z) = (row % ny, row / ny);
            for run in self.runs[runs[0]..runs[1]].iter().filter(|run| of(run.part)) {
                let along = run.start.saturating_sub(1)..(run.end + 1).min(nx);
                for z in z.saturating_sub(1)..(z + 2).min(nz) {
                    for y in y.saturating_sub(1)..(y + 2).min(ny) {
                        let from = (z * ny + y) * nx;
                        bits.set(from + along.start..from + along.end);
                    }
                }
            }
        }
    }
}

/// Joins the runs that overlap a run of the row before or of the slice before. Each run then leads to the first run of
/// its part.
fn join(runs: &mut [Run], rows: &[usize], [_, ny, nz]: [usize; 3]) {
    for (i, run) in runs.iter_mut().enumerate() {
        run.part = i;
    }
    for row in 0..ny * nz {
        let before = [(!row.is_multiple_of(ny)).then(|| row - 1), row.checked_sub(ny)];
        for other in before.into_iter().flatten() {
            let (mut i, mut j) = (rows[row], rows[other]);
            while i < rows[row + 1] && j < rows[other + 1] {
                if runs[i].start < runs[j].end && runs[j].start < runs[i].end {
                    let (a, b) = (root(runs, i), root(runs, j));
                    runs[a.max(b)].part = a.min(b);
                }
                if runs[i].end < runs[j].end { i += 1 } else { j += 1 }
            }
        }
    }
}

/// The first run of a part. The path to it is halved on the way.
fn root(runs: &mut [Run], mut i: usize) -> usize {
    while runs[i].part != i {
        runs[i].part = runs[runs[i].part].part;
        i = runs[i].part;
    }
    i
}

/// Orders the parts by size, and gives each run the position of its part.
fn order(runs: &mut [Run], rows: &[usize], nx: usize) -> Vec<Part> {
    // Runs lead to earlier ones, so that the first of a part comes before its others.
    let mut found: Vec<(Part, usize)> = Vec::new();
    for (row, span) in rows.windows(2).enumerate() {
        for i in span[0]..span[1] {
            let (run, size) = (runs[i], runs[i].end - runs[i].start);
            let part = if run.part == i {
                found.push((Part { size: 0, first: row * nx + run.start }, found.len()));
                found.len() - 1
            } else {
                runs[run.part].part
            };
            runs[i].part = part;
            found[part].0.size += size;
        }
    }
    // The sort is stable: equal parts stay in the order of their first voxels.
    found.sort_by_key(|(part, _)| std::cmp::Reverse(part.size));
    let mut position = vec![0; found.len()];
    found.iter().enumerate().for_each(|(to, (_, from))| position[*from] = to);
    runs.iter_mut().for_each(|run| run.part = position[run.part]);
    found.into_iter().map(|(part, _)| part).collect()
}

/// A bit a voxel.
struct Bits(Vec<u64>);

impl Bits {
    fn new(n: usize) -> Self {
        Self(vec![0; n.div_ceil(64)])
    }

    fn has(&self, i: usize) -> bool {
        self.0[i / 64] >> (i % 64) & 1 == 1
    }

    fn set(&mut self, range: std::ops::Range<usize>) {
        range.for_each(|i| self.0[i / 64] |= 1 << (i % 64));
    }

    /// Clears the bits that are set in `other`.
    fn remove(&mut self, other: &Self) {
        self.0.iter_mut().zip(&other.0).for_each(|(mine, theirs)| *mine &= !theirs);
    }
}

#[cfg(test)]
mod tests;
