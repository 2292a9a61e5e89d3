//! White noise: one random number a voxel, f = high · u(x, y, z), from the nearest voxel.
//!
//! u is [RAY-4]'s number with counter (x, y, z, draw 0) of the phantom's own grid. Piecewise constant: all derivatives
//! are 0. The pattern continues outside the box, with indices modulo 2³².

use super::Phantom;
use super::jet::{Jet, Scalar};
use super::params::{About, HIGH, SEED};
use crate::philox;
use crate::space::Grid;
use glam::DVec3;

pub(super) const WHITE_NOISE: About = About {
    name: "white-noise",
    doc: "one random number a voxel, uniform in 0…high",
    params: &[SEED, HIGH],
    build: |args| {
        let [seed, high] = args.values();
        Ok(Box::new(WhiteNoise { grid: args.grid.clone(), seed: seed as u64, high }))
    },
};

struct WhiteNoise {
    grid: Grid,
    seed: u64,
    high: f64,
}

impl Phantom for WhiteNoise {
    fn value(&self, p: DVec3) -> f64 {
        let index = self.grid.to_index(p).to_array();
        let voxel = index.map(|x| (x + 0.5).floor() as i64 as u32);
        self.high * philox::uniform(self.seed, voxel, 0)
    }

    fn jet(&self, p: DVec3) -> Jet {
        Jet::constant(self.value(p))
    }

    fn label(&self, _: DVec3) -> u16 {
        0
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::assert_near;
    use super::super::{by_name, sample};
    use crate::philox;
    use crate::space::Grid;
    use crate::volume::VoxelType;

    #[test]
    fn voxels_have_their_own_numbers() {
        let grid = Grid::with_spacing([20, 30, 40], [0.3, 1.0, 7.0]).unwrap();
        let params = [("seed".to_owned(), 11.0), ("high".to_owned(), 1.0)];
        let noise = by_name("white-noise", &grid, &params).unwrap();
        let volume = sample(noise.as_ref(), grid, VoxelType::F64).unwrap();
        assert_eq!(volume.value([3, 5, 7]), philox::uniform(11, [3, 5, 7], 0));
        // The mean of 24 000 uniforms is ½ within five standard deviations of 1/√(12 · 24000).
        let mean = (0..volume.voxels().len()).map(|i| volume.voxels().get(i)).sum::<f64>() / 24_000.0;
        assert_near(mean, 0.5, 5.0 / (12.0f64 * 24_000.0).sqrt());
    }
}
