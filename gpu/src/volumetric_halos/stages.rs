//! Stages of spreading that one dispatch runs: H₀ from the seeds, and the passes ([HALO-4], [HALO-5]).

/// Pixels along the side of a tile of the images: a workgroup, which WebGPU allows 256 invocations.
pub(super) const TILE: usize = 16;

/// Bytes of images in the memory of a workgroup. With its flags they fit in the 16384 that WebGPU promises.
pub(super) const TILE_BYTES: usize = 16_320;

/// The number of the stage that makes H₀, above the exponents of all passes: a scene has at most 12.
pub(super) const SOURCE: u32 = 12;

/// The stages from one to another that follow each other in a dispatch: [`SOURCE`], then the exponents of passes down to 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Stages {
    pub(super) from: u32,
    pub(super) to: u32,
}

impl Stages {
    /// The pixels that stages of a halo keep in the memory of a workgroup.
    fn pixels(self, reaches: &[usize]) -> usize {
        let passes = reaches.get(self.to as usize..reaches.len().min(self.from as usize + 1)).unwrap_or_default();
        // The square about a tile on which an image is needed before some last passes.
        let square = |last: usize| {
            let margin = passes[..last].iter().fold(0, |sum: usize, &reach| sum.saturating_add(reach));
            TILE.saturating_add(margin.saturating_mul(2)).saturating_pow(2)
        };
        // The first image, and two that take turns. H₀ is kept; another first image is free after a pass.
        let turns = if self.from == SOURCE { 2 } else { 1 };
        let images = (1..passes.len()).rev().take(turns).map(square);
        images.fold(square(passes.len()), usize::saturating_add)
    }
}

/// The dispatches of a group of planes: all stages in one if a workgroup has memory for their images, else H₀ alone, then as
/// many passes in each as it has. A pass alone reads and writes buffers, and can reach as far as it likes. `reaches` holds, for
/// each halo, how far the taps of its passes reach by their exponents, and `memory` is a number of pixels.
pub(super) fn dispatches(reaches: &[Vec<usize>], memory: usize) -> Vec<Stages> {
    let fits = |stages: Stages| reaches.iter().all(|reaches| stages.pixels(reaches) <= memory);
    let whole = Stages { from: SOURCE, to: 0 };
    if fits(whole) {
        return vec![whole];
    }
    // The last dispatch takes what fits, then the one before it.
    let mut dispatches = Vec::new();
    let mut to = 0;
    let passes = reaches.iter().map(Vec::len).max().unwrap_or(0) as u32;
    while to < passes {
        let from = (to + 1..passes).take_while(|&from| fits(Stages { from, to })).last().unwrap_or(to);
        dispatches.push(Stages { from, to });
        to = from + 1;
    }
    dispatches.push(Stages { from: SOURCE, to: SOURCE });
    dispatches.reverse();
    dispatches
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: q = 1 and N = 4 reach 15 pixels: squares of 46, 30, 22 and 18 pixels.
    #[test]
    fn memory_by_hand() {
        let reaches = [1, 2, 4, 8];
        let of = |from, to| Stages { from, to }.pixels(&reaches);
        assert_eq!(of(SOURCE, 0), 46 * 46 + 30 * 30 + 22 * 22);
        assert_eq!([of(3, 0), of(2, 0), of(1, 0)], [46 * 46 + 30 * 30, 30 * 30 + 22 * 22, 22 * 22 + 18 * 18]);
        assert_eq!(Stages { from: SOURCE, to: 0 }.pixels(&[]), TILE * TILE);
    }

    /// All stages are run, once each and in their order, whatever the reach and the memory; what fits in f32 is one dispatch.
    #[test]
    fn every_stage_is_in_one_dispatch() {
        let [single, double] = [4, 8].map(|size| TILE_BYTES / size);
        let of = |passes: u32, q: usize| (0..passes).map(|exponent| q << exponent).collect::<Vec<usize>>();
        let stages = |from, to| Stages { from, to };
        assert_eq!(dispatches(&[of(4, 1)], single), [stages(SOURCE, 0)]);
        let expected = [stages(SOURCE, SOURCE), stages(3, 3), stages(2, 0)];
        assert_eq!(dispatches(&[of(4, 1)], double), expected);
        assert_eq!(dispatches(&[of(0, 1)], double), [stages(SOURCE, 0)]);
        assert_eq!(dispatches(&[of(2, 1), of(4, 2)], single), expected);
        for (passes, q, memory) in [(12, 1, single), (12, 700, single), (5, 3, double), (6, 1, 0), (3, 1 << 20, double)]
        {
            let found = dispatches(&[of(passes, q), of(2, q)], memory);
            assert_eq!(found[0], stages(SOURCE, SOURCE));
            let exponents: Vec<u32> = found[1..].iter().flat_map(|own| (own.to..=own.from).rev()).collect();
            assert_eq!(exponents, (0..passes).rev().collect::<Vec<_>>());
        }
    }
}
