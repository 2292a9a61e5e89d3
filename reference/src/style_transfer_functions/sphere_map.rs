//! The lookup of a lit sphere by a normal (3.1; [STF-1]).

use crate::bilinear::{cell, mix};
use crate::number::Real;
use drypoint_scene::color::Rgba;
use drypoint_scene::style::Style;

/// The picture of one style, prepared for lookups.
///
/// Texels are rounded to f32 once, for every precision of the samples. This is the precision of a graphics card's
/// texture, and far finer than any painted picture. A style of 192² texels then takes 0.6 MB, and a core keeps two of
/// them in its cache.
#[derive(Clone, Debug, PartialEq)]
pub struct SphereMap {
    pub(super) side: usize,
    pub(super) texels: Vec<[f32; 4]>,
    /// The least and the largest texel of each channel.
    ranges: [[f32; 2]; 4],
}

impl SphereMap {
    /// The map of a decoded style, whose texels outside the disk are already extended from its rim.
    pub fn new(style: &Style) -> Self {
        Self::from_texels(style.side, &style.texels)
    }

    /// The map of S × S texels that are extended from the rim.
    pub(super) fn from_texels(side: usize, texels: &[Rgba]) -> Self {
        let texels: Vec<[f32; 4]> = texels.iter().map(|texel| texel.map(|c| c as f32)).collect();
        let range = |c: usize| {
            let channel = || texels.iter().map(|texel| texel[c]);
            [channel().fold(f32::INFINITY, f32::min), channel().fold(f32::NEG_INFINITY, f32::max)]
        };
        let ranges = std::array::from_fn(range);
        Self { side, texels, ranges }
    }

    /// The size of the texels in memory.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(self.texels.as_slice())
    }

    /// Linear premultiplied (r, g, b, α_d) of the normal (N_x, N_y, ±N_z): bilinear, x then y, at
    /// x = (N_x + 1)S/2 − ½, y = (1 − N_y)S/2 − ½, both clamped to [0, S − 1]. Each step is a + w(b − a), which
    /// returns a constant style exactly.
    #[inline]
    pub fn sample<R: Real>(&self, nx: R, ny: R) -> [R; 4] {
        let half_side = R::from_f64(self.side as f64) * R::HALF;
        let (i, wx) = cell((nx + R::ONE) * half_side - R::HALF, self.side);
        let (j, wy) = cell((R::ONE - ny) * half_side - R::HALF, self.side);
        // A single texel has no neighbour, and the neighbour's weight is 0.
        let next = usize::from(self.side > 1);
        let row = |j: usize| {
            let texel = |at: usize| self.texels[at].map(|c| R::from_f64(f64::from(c)));
            let at = j * self.side + i;
            mix(texel(at), texel(at + next), wx)
        };
        let found = mix(row(j), row(j + next), wy);
        std::array::from_fn(|c| found[c].known_within(self.ranges[c]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Vec3;
    use crate::style_transfer_functions::frame::on_sphere;
    use drypoint_scene::style::is_inside;
    use drypoint_scene::tables::SphereFrame;
    use proptest::prelude::*;

    /// A style of straight linear texels.
    fn style(side: usize, texel: impl Fn(usize, usize) -> [f64; 4]) -> Style {
        let texels: Vec<_> = (0..side * side).map(|t| texel(t % side, t / side)).collect();
        Style::from_straight("test", side, &texels, true).unwrap()
    }

    /// A number at a texel's precision.
    fn in_a_texture(c: f64) -> f64 {
        f64::from(c as f32)
    }

    fn sphere(side: usize, texel: impl Fn(usize, usize) -> [f64; 4]) -> SphereMap {
        SphereMap::new(&style(side, texel))
    }

    #[test]
    fn texel_centres_return_their_texels() {
        let side = 8;
        let map = sphere(side, |i, j| [i as f64, j as f64, 0.0, 1.0]);
        for j in 0..side {
            for i in 0..side {
                if is_inside(side, i, j) {
                    // N_x = (2i + 1)/S − 1, N_y = 1 − (2j + 1)/S: exact in eighths.
                    let nx = (2 * i + 1) as f64 / side as f64 - 1.0;
                    let ny = 1.0 - (2 * j + 1) as f64 / side as f64;
                    assert_eq!(map.sample(nx, ny), [i as f64, j as f64, 0.0, 1.0], "({i}, {j})");
                }
            }
        }
    }

    #[test]
    fn two_by_two_by_hand() {
        // Texel centres at N = ±½. Columns 0, 1 hold red 0, 1; rows 0, 1 hold green 0, 1.
        let map = sphere(2, |i, j| [i as f64, j as f64, (i * j) as f64, 1.0]);
        // x = (0.25 + 1) − ½ = ¾; y = (1 − 0) − ½ = ½; blue is the product ¾ · ½.
        assert_eq!(map.sample(0.25, 0.0), [0.75, 0.5, 0.375, 1.0]);
        // Beyond the centres the coordinate is clamped.
        assert_eq!(map.sample(0.9, 0.9), [1.0, 0.0, 0.0, 1.0]);
        assert_eq!(map.sample(-1.0, 0.0), [0.0, 0.5, 0.0, 1.0]);
        assert_eq!(map.sample(0.0, -1.0), [0.5, 1.0, 0.5, 1.0]);
    }

    #[test]
    fn one_texel_is_a_constant() {
        let map = sphere(1, |_, _| [0.3, 0.2, 0.1, 0.7]);
        let texel = [0.3 * 0.7, 0.2 * 0.7, 0.1 * 0.7, 0.7].map(in_a_texture);
        for (nx, ny) in [(0.0, 0.0), (1.0, 0.0), (0.0, -1.0), (-0.6, 0.8)] {
            assert_eq!(map.sample(nx, ny), texel);
        }
    }

    #[test]
    fn the_circumference_lies_on_the_outer_half_texel() {
        // At N_x = 1, x = S − ½ is clamped to S − 1: the last column.
        let map = sphere(16, |i, _| [i as f64, 0.0, 0.0, 1.0]);
        assert_eq!(map.sample(1.0, 0.0)[0], 15.0);
        assert_eq!(map.sample(-1.0, 0.0)[0], 0.0);
    }

    #[test]
    fn a_picture_that_is_linear_in_the_normal_is_reproduced() {
        // Where all four texels are inside, bilinear filtering is exact on bilinear pictures.
        let side = 32;
        let centre = |k: usize| (2 * k + 1) as f64 / side as f64 - 1.0;
        let map = sphere(side, |i, j| [0.5 + 0.25 * centre(i) - 0.125 * centre(j), 0.0, 0.0, 1.0]);
        for (nx, ny) in [(0.0f64, 0.0), (0.3, 0.4), (-0.61, 0.2), (0.05, -0.83)] {
            let expected = 0.5 + 0.25 * nx + 0.125 * ny;
            assert!((map.sample(nx, ny)[0] - expected).abs() < 4.0 * f64::EPSILON, "{nx}, {ny}");
        }
    }

    #[test]
    fn the_lookup_folds_over_the_rim() {
        let map = sphere(16, |i, j| [i as f64 / 15.0, j as f64 / 15.0, 0.5, 1.0]);
        let v = Vec3::new(0.0, 0.0, 1.0);
        let at = |z: f64| {
            let n = on_sphere(SphereFrame::Eye, Vec3::new(0.6, -0.48, z), v);
            map.sample(n.x, n.y)
        };
        assert_eq!(at(0.64), at(-0.64));
        // A flipped normal is another place, the antipodal one.
        assert_ne!(map.sample(0.6, -0.48), map.sample(-0.6, 0.48));
    }

    #[test]
    fn f32_agrees_to_its_rounding() {
        let picture = style(16, |i, j| [i as f64 / 15.0, j as f64 / 15.0, 0.5, 1.0]);
        let map = SphereMap::new(&picture);
        for k in 0..200 {
            let angle = f64::from(k) * 0.1;
            let [nx, ny] = [angle.cos(), angle.sin()].map(|c| c * f64::from(k) / 200.0);
            let (a, b) = (map.sample(nx, ny), map.sample(nx as f32, ny as f32));
            for c in 0..4 {
                // Coordinates up to 16 are rounded to 2⁻²⁰, the picture's slope is 1/15 a texel.
                assert!((a[c] - f64::from(b[c])).abs() < 1e-6);
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(300))]

        /// Constants come back with the bits of their texels wherever they are looked up, so a rim or a filter weight leaves no
        /// trace ([STF-12]'s constant style).
        #[test]
        fn a_constant_style_returns_its_colour_exactly(
            side in 1usize..20, angle in 0.0..6.3f64, r in 0.0..=1.0f64, c in prop::array::uniform4(0.0..=1.0f64),
        ) {
            let map = sphere(side, |_, _| c);
            let texel = [c[0] * c[3], c[1] * c[3], c[2] * c[3], c[3]].map(in_a_texture);
            prop_assert_eq!(map.sample(r * angle.cos(), r * angle.sin()), texel);
        }

        /// Texels outside the disk never affect a lookup.
        #[test]
        fn nothing_outside_the_disk_is_read(side in 1usize..24, angle in 0.0..6.3f64, r in 0.0..=1.0f64) {
            let paint = |outside: f64| sphere(side, |i, j| {
                if is_inside(side, i, j) { [i as f64, j as f64, 1.0, 1.0] } else { [outside; 4] }
            });
            let [nx, ny] = [r * angle.cos(), r * angle.sin()];
            let clean = paint(0.0).sample(nx, ny);
            prop_assert!(clean.iter().all(|c| c.is_finite()));
            prop_assert_eq!(paint(f64::NAN).sample(nx, ny), clean);
        }

        /// The lookup is continuous: bilinear, so its slope is at most S/2 times the largest step between texels.
        #[test]
        fn neighbouring_normals_look_alike(side in 2usize..24, angle in 0.0..6.3f64, r in 0.0..=1.0f64, seed in 0usize..99) {
            let map = sphere(side, |i, j| [((i * 7 + j * 13 + seed) % 5) as f64 / 4.0, 0.0, 0.0, 1.0]);
            let [nx, ny] = [r * angle.cos(), r * angle.sin()];
            let h = 1e-7;
            let step = (map.sample(nx + h, ny)[0] - map.sample(nx, ny)[0]).abs();
            prop_assert!(step <= h * side as f64 / 2.0 * 1.000_001 + 1e-14);
        }
    }
}
