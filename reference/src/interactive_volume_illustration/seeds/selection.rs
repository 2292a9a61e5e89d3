//! Selection of the cells in which strokes begin (4.1; [HATCH-6]).

use super::measures::{LargestMeasure, VoxelMeasure, of_blocks};
use super::pyramid::{Pyramid, is_above};
use drypoint_scene::parallel;
use drypoint_scene::philox::uniform;
use drypoint_scene::volume::Volume;

/// The rule by which cells of an iso-surface get a stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SeedRule {
    /// At random: p = ½(κ + |∇|) if κ > C₀ and |∇| > C₁, otherwise 0.
    Curvature {
        /// The bound C₀.
        min_curvature: f64,
        /// The bound C₁.
        min_gradient: f64,
    },
    /// Every cell (Fig. 6, right).
    Dense,
}

impl SeedRule {
    /// The probability p of a block.
    pub fn probability(self, largest: LargestMeasure) -> f64 {
        match self {
            Self::Dense => 1.0,
            Self::Curvature { min_curvature, min_gradient } => {
                let LargestMeasure { curvature, gradient } = largest;
                let counts = is_above(curvature, min_curvature) && is_above(gradient, min_gradient);
                let [kappa, gradient] = [curvature, gradient].map(|b| f64::from(b) / 255.0);
                if counts { 0.5 * (kappa + gradient) } else { 0.0 }
            }
        }
    }

    /// C₀, if the rule has one.
    fn min_curvature(self) -> Option<f64> {
        match self {
            Self::Dense => None,
            Self::Curvature { min_curvature, .. } => Some(min_curvature),
        }
    }
}

/// The cells of an iso-surface, with the probability that a stroke begins in each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Seeds {
    /// Cells that hold the value, with their p; z slowest. Cells whose p the pyramid knows to be 0 are left out.
    pub cells: Vec<([usize; 3], f64)>,
    /// Number of voxels that were measured.
    pub measured: u64,
}

impl Seeds {
    /// Finds the cells of the surface f = `iso` and their probabilities: down the pyramid to blocks, then each cell
    /// of a block by its eight voxels. Cells with a masked voxel are empty ([PREC-2]). `measure` is called only if
    /// the rule needs it.
    pub fn new(
        pyramid: &Pyramid,
        volume: &Volume,
        iso: f64,
        rule: SeedRule,
        measure: impl Fn([usize; 3]) -> VoxelMeasure + Sync,
    ) -> Self {
        let counts = |[least, largest]: [f64; 2]| least <= iso && iso <= largest;
        Self::of_blocks(pyramid, volume, (pyramid.blocks(iso, rule.min_curvature()), counts), rule, measure)
    }

    /// Like [`new`](Self::new), for the cells in whose closed range of values one counts ([HATCH-16]).
    pub fn among(
        pyramid: &Pyramid,
        volume: &Volume,
        counts: impl Fn([f64; 2]) -> bool + Sync,
        rule: SeedRule,
        measure: impl Fn([usize; 3]) -> VoxelMeasure + Sync,
    ) -> Self {
        Self::of_blocks(pyramid, volume, (pyramid.blocks_among(&counts, rule.min_curvature()), counts), rule, measure)
    }

    fn of_blocks(
        pyramid: &Pyramid,
        volume: &Volume,
        (blocks, counts): (Vec<[usize; 3]>, impl Fn([f64; 2]) -> bool + Sync),
        rule: SeedRule,
        measure: impl Fn([usize; 3]) -> VoxelMeasure + Sync,
    ) -> Self {
        let has_one = |&block: &[usize; 3]| pyramid.cells_of_block(block).any(|cell| holds(volume, cell, &counts));
        let blocks = parallel::gather(blocks.len(), parallel::RUN, &|run, kept| {
            kept.extend(blocks[run].iter().copied().filter(has_one));
        });
        let (largest, measured) = match rule {
            SeedRule::Dense => (vec![LargestMeasure::default(); blocks.len()], 0),
            SeedRule::Curvature { .. } => of_blocks(&blocks, volume.dims(), measure),
        };
        let of_block = |(&block, &largest): (&[usize; 3], &LargestMeasure)| {
            let p = rule.probability(largest);
            pyramid.cells_of_block(block).filter(|&cell| holds(volume, cell, &counts)).map(move |cell| (cell, p))
        };
        let mut cells = parallel::gather(blocks.len(), parallel::RUN, &|run, cells| {
            cells.extend(blocks[run.clone()].iter().zip(&largest[run]).flat_map(of_block));
        });
        cells.sort_unstable_by_key(|&([x, y, z], _)| [z, y, x]);
        Self { cells, measured }
    }

    /// Draws the cells in which a stroke begins. A cell is drawn by its p and a random number of seed and cell
    /// ([RAY-4]), so that the result depends on neither camera nor light.
    pub fn draw(&self, seed: u64) -> impl Iterator<Item = [usize; 3]> {
        self.cells.iter().filter(move |(cell, p)| uniform(seed, cell.map(|i| i as u32), 0) < *p).map(|(cell, _)| *cell)
    }

    /// Σp, the expected number of strokes.
    pub fn expected(&self) -> f64 {
        self.cells.iter().map(|(_, p)| p).sum()
    }
}

/// Whether the closed range of a cell's voxels counts and no voxel is masked.
fn holds(volume: &Volume, [x, y, z]: [usize; 3], counts: impl Fn([f64; 2]) -> bool) -> bool {
    if volume.mask().is_some_and(|mask| mask.touches_cell([x, y, z])) {
        return false;
    }
    let dims = volume.dims();
    let (mut least, mut largest) = (f64::INFINITY, f64::NEG_INFINITY);
    for corner in 0..8 {
        let at = [x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2)];
        let value = volume.value([0, 1, 2].map(|axis| at[axis].min(dims[axis] - 1)));
        (least, largest) = (least.min(value), largest.max(value));
    }
    counts([least, largest])
}

#[cfg(test)]
mod tests {
    use super::super::pyramid::cells_of;
    use super::*;
    use drypoint_scene::philox::uniforms;
    use drypoint_scene::space::Grid;
    use drypoint_scene::volume::Voxels;

    const RULE: SeedRule = SeedRule::Curvature { min_curvature: 0.02, min_gradient: 0.05 };

    fn volume(dims: [usize; 3], value: impl Fn([usize; 3]) -> f64) -> Volume {
        let voxels = (0..dims.iter().product())
            .map(|i: usize| value([i % dims[0], i / dims[0] % dims[1], i / dims[0] / dims[1]]));
        let grid = Grid::with_spacing(dims, [1.0; 3]).unwrap();
        Volume::new(grid, Voxels::F64(voxels.collect()), 1.0, 0.0).unwrap()
    }

    fn noise(dims: [usize; 3]) -> Volume {
        volume(dims, |at| uniform(1, at.map(|i| i as u32), 0))
    }

    /// Pseudo-random measures of a voxel, unrelated to its value.
    fn measure(at: [usize; 3]) -> VoxelMeasure {
        let [a, b, ..] = uniforms(2, at.map(|i| i as u32 / 3), 0);
        VoxelMeasure { gradient: a, curvature: if b < 0.3 { 0.0 } else { b * b } }
    }

    /// All cells by brute force: the block's 27 voxels and the cell's own eight.
    fn exhaustive(volume: &Volume, iso: f64, rule: SeedRule) -> Vec<([usize; 3], f64)> {
        let dims = volume.dims();
        let [nx, ny, nz] = cells_of(dims);
        let all = (0..nz).flat_map(|z| (0..ny).flat_map(move |y| (0..nx).map(move |x| [x, y, z])));
        all.filter(|&cell| holds(volume, cell, |[least, largest]| least <= iso && iso <= largest))
            .map(|cell| {
                let first = cell.map(|i| i / 2 * 2);
                let mut largest = LargestMeasure::default();
                for k in 0..27 {
                    let at = [first[0] + k % 3, first[1] + k / 3 % 3, first[2] + k / 9];
                    if (0..3).all(|axis| at[axis] < dims[axis]) {
                        let m = measure(at);
                        largest.gradient = largest.gradient.max((m.gradient * 255.0).ceil() as u8);
                        largest.curvature = largest.curvature.max((m.curvature * 255.0).ceil() as u8);
                    }
                }
                (cell, rule.probability(largest))
            })
            .collect()
    }

    #[test]
    fn p_by_hand() {
        let p = |gradient, curvature| RULE.probability(LargestMeasure { gradient, curvature });
        assert_eq!(p(255, 255), 1.0);
        assert_eq!(p(51, 102), 0.5 * (0.2 + 0.4));
        // C₀ = 0.02 is 5.1 bytes, C₁ = 0.05 is 12.75.
        assert_eq!([p(255, 5), p(255, 6), p(12, 255), p(13, 255)].map(|p| p > 0.0), [false, true, false, true]);
        // At the bound itself the probability is 0.
        let at = SeedRule::Curvature { min_curvature: 0.2, min_gradient: 0.2 };
        assert_eq!(at.probability(LargestMeasure { gradient: 51, curvature: 255 }), 0.0);
        assert_eq!(at.probability(LargestMeasure { gradient: 255, curvature: 51 }), 0.0);
        assert_eq!(SeedRule::Dense.probability(LargestMeasure::default()), 1.0);
    }

    #[test]
    fn seeds_are_those_of_a_search_through_all_cells() {
        for dims in [[8, 9, 10], [2, 2, 2], [1, 7, 5], [17, 3, 6]] {
            for volume in [noise(dims), volume(dims, |_| 0.5), volume(dims, |[x, ..]| x as f64)] {
                let pyramid = Pyramid::new(&volume);
                for rule in [RULE, SeedRule::Dense] {
                    for iso in [0.25, 0.5, 1.0, 2.0] {
                        let found = Seeds::new(&pyramid, &volume, iso, rule, measure);
                        assert_eq!(found.cells, exhaustive(&volume, iso, rule), "{dims:?} {iso}");
                        assert_eq!(found.measured > 0, rule == RULE && !found.cells.is_empty());
                    }
                }
            }
        }
    }

    /// If the pyramid knows the curvature, the cells that can have a seed are the same, and no more voxels are
    /// measured.
    #[test]
    fn seeds_are_the_same_where_the_pyramid_knows_the_curvature() {
        let can = |cells: &[([usize; 3], f64)]| cells.iter().copied().filter(|(_, p)| *p > 0.0).collect::<Vec<_>>();
        for dims in [[20, 9, 10], [2, 2, 2], [1, 7, 5]] {
            let volume = noise(dims);
            let pyramid = Pyramid::new(&volume);
            let flat = |at: [usize; 3]| VoxelMeasure { curvature: if at[0] < 9 { 0.01 } else { 0.5 }, ..measure(at) };
            let curved = pyramid.clone().with_curvature(dims, |at| flat(at).curvature);
            let counts = |[least, largest]: [f64; 2]| least < 0.06 && largest > 0.05;
            let all = [
                [&pyramid, &curved].map(|pyramid| Seeds::new(pyramid, &volume, 0.5, RULE, flat)),
                [&pyramid, &curved].map(|pyramid| Seeds::among(pyramid, &volume, counts, RULE, flat)),
            ];
            for [without, with] in all {
                assert_eq!(can(&without.cells), can(&with.cells), "{dims:?}");
                assert!(without.draw(1).eq(with.draw(1)) && without.expected() == with.expected());
                assert!(with.measured < without.measured || without.measured == 0, "{dims:?}");
            }
            let dense = |pyramid| Seeds::new(pyramid, &volume, 0.5, SeedRule::Dense, flat);
            assert_eq!(dense(&pyramid), dense(&curved));
        }
    }

    /// Values in two ranges count: the cells equal those of a search through all.
    #[test]
    fn cells_whose_values_count() {
        let counts = |[least, largest]: [f64; 2]| (least < 0.06 && largest > 0.05) || (least < 0.9 && largest > 0.88);
        for dims in [[8, 9, 10], [33, 17, 5]] {
            let volume = volume(dims, |[x, y, z]| uniform(3, [x as u32 / 4, y as u32 / 4, z as u32 / 4], 0));
            let found = Seeds::among(&Pyramid::new(&volume), &volume, counts, SeedRule::Dense, measure);
            let [nx, ny, nz] = cells_of(dims);
            let all = (0..nz).flat_map(|z| (0..ny).flat_map(move |y| (0..nx).map(move |x| [x, y, z])));
            let wanted: Vec<_> = all.filter(|&cell| holds(&volume, cell, counts)).map(|cell| (cell, 1.0)).collect();
            assert!(!wanted.is_empty() && wanted.len() < nx * ny * nz);
            assert_eq!(found.cells, wanted);
        }
    }

    /// |n − Σp| ≤ 5√Σp(1 − p) for 20 seeds. Also n is binomial among the cells whose p lies in one of ten bins. χ² of
    /// all bins over 20 seeds has at most 200 degrees of freedom. It exceeds 268 in 10⁻³ of all cases and 282 in
    /// 10⁻⁴.
    #[test]
    fn as_many_seeds_as_their_probabilities_say() {
        let volume = noise([40, 40, 40]);
        let seeds = Seeds::new(&Pyramid::new(&volume), &volume, 0.5, RULE, measure);
        let deviation = seeds.cells.iter().map(|(_, p)| p * (1.0 - p)).sum::<f64>().sqrt();
        let bin = |p: f64| ((p * 10.0) as usize).min(9);
        let (mut expected, mut variance) = ([0.0; 10], [0.0; 10]);
        for &(_, p) in &seeds.cells {
            expected[bin(p)] += p;
            variance[bin(p)] += p * (1.0 - p);
        }
        let mut chi2 = 0.0;
        for seed in 0..20 {
            let drawn: Vec<[usize; 3]> = seeds.draw(seed).collect();
            assert!((drawn.len() as f64 - seeds.expected()).abs() <= 5.0 * deviation, "{seed}: {}", drawn.len());
            let mut found = [0.0; 10];
            let mut drawn = drawn.into_iter().peekable();
            for &(cell, p) in &seeds.cells {
                if drawn.next_if_eq(&cell).is_some() {
                    found[bin(p)] += 1.0;
                }
            }
            assert_eq!(drawn.next(), None);
            for k in (0..10).filter(|&k| variance[k] > 20.0) {
                chi2 += (found[k] - expected[k]).powi(2) / variance[k];
            }
        }
        assert!(chi2 < 282.0, "{chi2}");
    }

    #[test]
    fn a_masked_voxel_empties_its_cells() {
        let holed = volume([6, 6, 6], |[x, y, z]| if [x, y, z] == [2, 2, 2] { f64::NAN } else { x as f64 });
        let seeds = Seeds::new(&Pyramid::new(&holed), &holed, 1.5, SeedRule::Dense, measure);
        // 21 of 25 cells between x = 1 and 2: four cells touch the masked voxel.
        assert_eq!(seeds.cells.len(), 21);
    }
}
