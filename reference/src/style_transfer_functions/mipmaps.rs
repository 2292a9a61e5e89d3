//! The level of detail at which a style is looked up (4.3; [STF-10]).

use super::SphereMap;
use crate::bilinear::mix;
use crate::number::Real;
use drypoint_scene::math;
use drypoint_scene::shot::LevelOfDetail;
use drypoint_scene::style::{MipLevel, Style};
use drypoint_scene::view::View;

/// p of [STF-10]: the number of rays side by side in a voxel's picture.
///
/// With `picture.samples = n` rays are 1/n of a pixel apart. Such a picture is therefore still the mean of the n times
/// larger picture ([RAY-6]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Footprint<R> {
    /// p at every depth.
    Orthographic(R),
    /// p at eye depth 1. p falls with the depth.
    Perspective(R),
}

impl<R: Real> Footprint<R> {
    /// p at an eye depth, which must be positive in perspective.
    #[inline]
    fn at(self, depth: R) -> R {
        match self {
            Self::Orthographic(p) => p,
            Self::Perspective(p) => p / depth,
        }
    }
}

/// λ of [STF-10], without the term of the style's size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Detail<R> {
    /// b_κ.
    pub curvature_bias: R,
    /// b_g.
    pub gradient_bias: R,
    /// ω₀, in radians per voxel: the least turn of a normal.
    pub turn: R,
    /// A voxel in world units.
    pub voxel: R,
    /// p.
    pub footprint: Footprint<R>,
}

impl<R: Real> Detail<R> {
    /// Prepares the level of detail for a picture of n×n rays for each pixel, and a voxel side in world units.
    pub fn new(level: &LevelOfDetail, view: &View, rays_across: usize, voxel: f64) -> Self {
        let rays = R::from_f64(voxel * rays_across as f64 / view.pixel);
        Self {
            curvature_bias: R::from_f64(level.curvature_bias),
            gradient_bias: R::from_f64(level.gradient_bias),
            turn: R::from_f64(level.turn),
            voxel: R::from_f64(voxel),
            footprint: if view.perspective { Footprint::Perspective(rays) } else { Footprint::Orthographic(rays) },
        }
    }

    /// λ − log₂ S = log₂( ½·max(ω₀, b_κ·min(|κ|·voxel, 1)) / p ) + b_g(1 − |g|), not yet clamped. It is the number of
    /// levels by which the lookup lies below the style's last level. κ is in reciprocal world units and |g| in [0, 1].
    ///
    /// A normal that turns by ω from one voxel to the next moves the lookup by at most ½Sω texels, within p rays.
    #[inline]
    pub fn below_last(&self, depth: R, kappa: R, g: R) -> R {
        let bend = self.curvature_bias * (kappa.abs() * self.voxel).min(R::ONE);
        let per_ray = R::HALF * self.turn.max(bend) / self.footprint.at(depth);
        R::monotone([per_ray], |[x]| math::log2(x)) + self.gradient_bias * (R::ONE - g)
    }
}

/// The levels of one style above the style itself, prepared for lookups.
#[derive(Clone, Debug, PartialEq)]
pub struct MipMap<R> {
    /// log₂ S.
    last: R,
    /// λ of each level, ascending, and its picture.
    levels: Vec<(R, SphereMap)>,
}

impl<R: Real> MipMap<R> {
    /// The chain of a style.
    pub fn new(style: &Style) -> Self {
        let levels = style.mip_levels();
        let sampled = |level: &MipLevel| (R::from_f64(level.lambda), SphereMap::from_texels(level.side, &level.texels));
        Self { last: R::from_f64(math::log2(style.side as f64)), levels: levels.iter().map(sampled).collect() }
    }

    /// The lookup of `style` at λ = clamp(`below_last` + log₂ S, 0, log₂ S), bilinear in the two levels about λ and
    /// linear between them. `self` must be the chain of `style`. At λ = 0 the result is the lookup of the style itself,
    /// bit for bit.
    #[inline]
    pub fn sample(&self, style: &SphereMap, nx: R, ny: R, below_last: R) -> [R; 4] {
        // In this order of operands NaN (ω = 0 with infinite p) counts as 0.
        let lambda = R::ZERO.max(below_last + self.last).min(self.last);
        let above = self.levels.iter().position(|(at, _)| *at > lambda).unwrap_or(self.levels.len());
        let (from, lower) = match above.checked_sub(1) {
            Some(below) => (self.levels[below].0, &self.levels[below].1),
            None => (R::ZERO, style),
        };
        let first = lower.sample(nx, ny);
        if lambda == from {
            return first;
        }
        // λ is at most that of the last level, so there is a level above each one that λ has passed.
        let Some((to, upper)) = self.levels.get(above) else { return first };
        mix(first, upper.sample(nx, ny), (lambda - from) / (*to - from))
    }

    /// The size of the levels in memory.
    pub fn bytes(&self) -> usize {
        self.levels.iter().map(|(_, map)| map.bytes()).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::style_transfer_functions::{Blend, Spheres};
    use drypoint_scene::style::is_inside;
    use drypoint_scene::tables::Mix;
    use proptest::prelude::*;

    /// The settings of an empty `[style_mipmaps]` table, on unit voxels of p pixels.
    fn detail(p: f64) -> Detail<f64> {
        Detail {
            curvature_bias: 1.0,
            gradient_bias: 1.0,
            turn: 2.0 / 256.0,
            voxel: 1.0,
            footprint: Footprint::Orthographic(p),
        }
    }

    /// λ of a style of S texels a side.
    fn lambda(detail: &Detail<f64>, side: f64, kappa: f64, g: f64) -> f64 {
        let last = side.log2();
        (detail.below_last(1.0, kappa, g) + last).clamp(0.0, last)
    }

    fn style(side: usize, texel: impl Fn(usize, usize) -> [f64; 4]) -> Style {
        let texels: Vec<_> = (0..side * side).map(|t| texel(t % side, t / side)).collect();
        Style::from_straight("test", side, &texels, true).unwrap()
    }

    fn noise(side: usize) -> Style {
        style(side, |i, j| drypoint_scene::philox::uniforms(5, [i as u32, j as u32, 0], 0))
    }

    #[test]
    fn the_formula_by_hand() {
        // S = 256, p = 1, κ = 0, |g| = 1: ½·256·2/256 = 1 texel a pixel.
        assert_eq!(lambda(&detail(1.0), 256.0, 0.0, 1.0), 0.0);
        // S = 1024: 4 texels a pixel. Of half the size, 8.
        assert_eq!(lambda(&detail(1.0), 1024.0, 0.0, 1.0), 2.0);
        assert_eq!(lambda(&detail(0.5), 1024.0, 0.0, 1.0), 3.0);
        // κ = ¼ a voxel: ½·1024/4 = 128. The sign of κ does not count, and beyond one radian nothing is added.
        assert_eq!(lambda(&detail(1.0), 1024.0, 0.25, 1.0), 7.0);
        assert_eq!(lambda(&detail(1.0), 1024.0, -0.25, 1.0), 7.0);
        assert_eq!(lambda(&detail(1.0), 1024.0, 1e9, 1.0), 9.0);
        assert_eq!(lambda(&Detail { curvature_bias: 0.5, ..detail(1.0) }, 1024.0, 0.25, 1.0), 6.0);
        assert_eq!(lambda(&Detail { curvature_bias: 0.0, ..detail(1.0) }, 1024.0, 0.25, 1.0), 2.0);
        // Voxels of 2: κ·voxel = ½.
        assert_eq!(lambda(&Detail { voxel: 2.0, ..detail(1.0) }, 1024.0, 0.25, 1.0), 8.0);
        // |g| = ¼: ¾ of a level, or 3 of them.
        assert_eq!(lambda(&detail(1.0), 1024.0, 0.0, 0.25), 2.75);
        assert_eq!(lambda(&Detail { gradient_bias: 4.0, ..detail(1.0) }, 1024.0, 0.0, 0.25), 5.0);
        // Clamped at both ends.
        assert_eq!(lambda(&detail(4.0), 64.0, 0.0, 1.0), 0.0);
        assert_eq!(lambda(&detail(1e-9), 64.0, 0.0, 1.0), 6.0);
        // Eight voxels away a voxel of 8 pixels at depth 1 has one.
        let far = Detail { footprint: Footprint::Perspective(8.0), ..detail(0.0) };
        assert_eq!(far.below_last(8.0, 0.0, 1.0), detail(1.0).below_last(123.0, 0.0, 1.0));
        // f32 agrees up to its rounding: everything above is a power of two.
        let single = Detail {
            curvature_bias: 1f32,
            gradient_bias: 1.0,
            turn: 2.0 / 256.0,
            voxel: 1.0,
            footprint: Footprint::Orthographic(1.0),
        };
        assert_eq!(single.below_last(1.0, 0.25, 0.25), -2.25);
    }

    #[test]
    fn nothing_to_tell_apart_is_level_0() {
        let flat = Detail { turn: 0.0, ..detail(1.0) };
        assert_eq!(lambda(&flat, 512.0, 0.0, 0.0), 0.0);
        let (picture, chain) = (SphereMap::new(&noise(8)), MipMap::<f64>::new(&noise(8)));
        for below_last in [f64::NEG_INFINITY, f64::NAN, -1e300] {
            assert_eq!(chain.sample(&picture, 0.3, 0.2, below_last), picture.sample(0.3, 0.2));
        }
        let texel = chain.sample(&picture, 0.3, 0.2, f64::INFINITY);
        assert_eq!(texel, chain.sample(&picture, -0.9, 0.1, 0.0));
    }

    #[test]
    fn the_last_level_is_the_mean_of_the_disk() {
        for side in [1, 2, 3, 7, 16, 100] {
            let style = noise(side);
            let inside: Vec<_> =
                (0..side * side).filter(|t| is_inside(side, t % side, t / side)).map(|t| style.texels[t]).collect();
            let found = MipMap::new(&style).sample(&SphereMap::new(&style), 0.4, -0.7, 0.0);
            for c in 0..4 {
                let mean = inside.iter().map(|t| t[c]).sum::<f64>() / inside.len() as f64;
                // One rounding for each texel, and one to f32.
                let bound = inside.len() as f64 * f64::EPSILON + 0.5 * f64::from(f32::EPSILON);
                assert!((found[c] - mean).abs() <= bound, "{side}");
            }
        }
    }

    /// Chains are the styles' own: one that has no share is not read at any level.
    #[test]
    fn styles_do_not_mix_in_their_chains() {
        let poison = Style { name: "poison".into(), side: 4, texels: vec![[f64::NAN; 4]; 16] };
        let styles = [noise(4), poison];
        for mix in [Mix::Premultiplied, Mix::Printed] {
            let spheres = Spheres::<f64>::new(&styles, mix).with_mipmaps(&styles);
            let blend = Blend { j0: 0, j1: 1, w: 0.0, alpha_u: 1.0 };
            for below_last in [-2.0, -1.3, -1.0, 0.0] {
                let alone = MipMap::new(&styles[0]).sample(&SphereMap::new(&styles[0]), 0.1, 0.2, below_last);
                assert_eq!(spheres.lookup_level(&blend, 0.1, 0.2, below_last), alone);
            }
        }
    }

    /// The lookup on a whole level reads this level alone; between two levels it interpolates in proportion. The levels
    /// 6, 3, 2, 1 of a side of 12 stand at log₂ of 2, 4, 6 and 12.
    #[test]
    fn levels_are_mixed_by_their_lambdas() {
        let style = noise(12);
        let (picture, chain) = (SphereMap::new(&style), MipMap::<f64>::new(&style));
        let last = math::log2(12.0);
        let at = |lambda: f64| chain.sample(&picture, 0.31, -0.42, lambda - last);
        let alone = |k: usize| match k {
            0 => picture.sample(0.31, -0.42),
            _ => chain.levels[k - 1].1.sample(0.31, -0.42),
        };
        let stands = [1.0, 2.0, 4.0, 6.0, 12.0].map(math::log2);
        for k in 0..4 {
            for w in [0.0, 0.25, 0.5, 0.875] {
                let found = at(stands[k] + w * (stands[k + 1] - stands[k]));
                for (found, (a, b)) in found.into_iter().zip(alone(k).into_iter().zip(alone(k + 1))) {
                    // λ loses an ulp of log₂ 12 on its way, over a distance between levels of at least log₂ 1.5.
                    assert!((found - (a + w * (b - a))).abs() < 8.0 * f64::EPSILON, "{k} {w}");
                }
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]

        #[test]
        fn level_0_is_the_style_bit_for_bit(
            side in 1usize..40, angle in 0.0..6.3f64, r in 0.0..=1.0f64, below in -30.0..=0.0f64,
        ) {
            let style = noise(side);
            let (picture, chain) = (SphereMap::new(&style), MipMap::<f64>::new(&style));
            let [nx, ny] = [r * angle.cos(), r * angle.sin()];
            let below_last = below - math::log2(side as f64);
            prop_assert_eq!(chain.sample(&picture, nx, ny, below_last), picture.sample(nx, ny));
        }

        /// Means of texels never leave their range, whatever the level: what a scene can give is what its styles have.
        #[test]
        fn levels_stay_within_the_style(
            side in 1usize..40, angle in 0.0..6.3f64, r in 0.0..=1.0f64, below in -7.0..0.5f64, c in 0.0..=1.0f64,
        ) {
            let [nx, ny] = [r * angle.cos(), r * angle.sin()];
            let lookup = |style: &Style| MipMap::<f64>::new(style).sample(&SphereMap::new(style), nx, ny, below);
            prop_assert!(lookup(&noise(side)).iter().all(|v| (0.0..=1.0).contains(v)));
            let constant = lookup(&style(side, |_, _| [c, 1.0, 0.0, 1.0]));
            // The sum of n equal numbers rounds n times, and a texel once to f32.
            let bound = (side * side) as f64 * f64::EPSILON + 0.5 * f64::from(f32::EPSILON);
            prop_assert!((constant[0] - c).abs() <= bound);
            prop_assert_eq!([constant[1], constant[2], constant[3]], [1.0, 0.0, 1.0]);
        }

        /// λ rises with curvature and falls with |g| and with the size of a voxel in the picture.
        #[test]
        fn laws(k in 0.0..3.0f64, more in 0.0..2.0f64, g in 0.0..=1.0f64, p in 0.01..50.0f64) {
            let here = detail(p).below_last(1.0, k, g);
            prop_assert!(detail(p).below_last(1.0, k + more, g) >= here);
            prop_assert!(detail(p).below_last(1.0, k, g * (1.0 - more / 2.0)) >= here);
            prop_assert!(detail(p * (1.0 + more)).below_last(1.0, k, g) <= here);
        }
    }
}
