//! Smooth noise: random numbers on a lattice, blended by quintic curves, in octaves.
//!
//! One octave: v(q) = trilinear blend of u(⌊q⌋ + {0, 1}³) with weights s(t) = 6t⁵ − 15t⁴ + 10t³, t = q − ⌊q⌋ (Perlin:
//! Improving noise, 2002), whose first two derivatives vanish at t = 0 and 1, so the field is C². u is [RAY-4]'s
//! number with counter (lattice point, draw 1 + o). f = high · Σ 2^−o v(2^o p / s) / Σ 2^−o over the octaves
//! o = 0 … n − 1, so 0 ≤ f < high.

use super::jet::Scalar;
use super::params::{About, Allowed, HIGH, Param, Preset, SEED};
use super::placed::Formula;
use crate::philox;

pub(super) const NOISE: About = About {
    name: "noise",
    doc: "smooth (C²) random field in 0…high",
    params: &[
        Param {
            name: "s",
            doc: "cell of the coarsest lattice",
            default: Preset::Side(0.125),
            allowed: Allowed::Positive,
        },
        Param {
            name: "n",
            doc: "octaves, each with half the cell and half the weight",
            default: Preset::Number(3.0),
            allowed: Allowed::Whole(1.0, 16.0),
        },
        SEED,
        HIGH,
    ],
    build: |args| {
        let [cell, octaves, seed, high] = args.values();
        Ok(args.field(Noise { cell, octaves: octaves as u32, seed: seed as u64, high }))
    },
};

struct Noise {
    cell: f64,
    octaves: u32,
    seed: u64,
    high: f64,
}

impl Formula for Noise {
    fn at<S: Scalar>(&self, p: [S; 3]) -> S {
        let (mut sum, mut weights, mut weight, mut scale) = (S::constant(0.0), 0.0, 1.0, 1.0 / self.cell);
        for octave in 0..self.octaves {
            sum = sum + self.octave(p.map(|x| x * scale), 1 + octave) * weight;
            weights += weight;
            weight *= 0.5;
            scale *= 2.0;
        }
        sum * (self.high / weights)
    }
}

impl Noise {
    /// v(q) with its own draw.
    fn octave<S: Scalar>(&self, q: [S; 3], draw: u32) -> S {
        let floor = q.map(|x| x.real().floor());
        let blend: [S; 3] = std::array::from_fn(|a| {
            let t = q[a] - floor[a];
            t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
        });
        let corner = |i: usize| {
            let lattice = std::array::from_fn(|a| (floor[a] as i64 + (i >> a & 1) as i64) as u32);
            S::constant(philox::uniform(self.seed, lattice, draw))
        };
        let mix = |a: S, b: S, w: S| a + w * (b - a);
        let along_x: [S; 4] = std::array::from_fn(|i| mix(corner(2 * i), corner(2 * i + 1), blend[0]));
        mix(mix(along_x[0], along_x[1], blend[1]), mix(along_x[2], along_x[3], blend[1]), blend[2])
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{assert_near, made};
    use crate::philox;
    use glam::{DMat3, DVec3};

    #[test]
    fn lattice_points_have_their_numbers_and_no_slope() {
        let (noise, centre) = made("noise", &[("s", 0.25), ("n", 1.0), ("seed", 3.0), ("high", 10.0)]);
        let jet = noise.jet(centre + DVec3::new(0.25, -0.5, 0.0));
        assert_eq!(jet.value, 10.0 * philox::uniform(3, [1, u32::MAX - 1, 0], 1));
        assert_eq!((jet.gradient, jet.hessian), (DVec3::ZERO, DMat3::ZERO));
        // s(½) = ½: halfway between two lattice points is their mean.
        let u = |x: u32| philox::uniform(3, [x, 0, 0], 1);
        assert_near(noise.value(centre + DVec3::new(0.125, 0.0, 0.0)), 5.0 * (u(0) + u(1)), 1e-14);
    }

    #[test]
    fn octaves_add_with_half_the_weight() {
        let one = |n: f64| made("noise", &[("s", 0.25), ("n", n), ("high", 1.0)]);
        let ((both, centre), (coarse, _)) = (one(2.0), one(1.0));
        // At the centre both octaves are on lattice point 0, with draws 1 and 2.
        let want = (coarse.value(centre) + 0.5 * philox::uniform(0, [0; 3], 2)) / 1.5;
        assert_near(both.value(centre), want, 1e-16);
    }
}
