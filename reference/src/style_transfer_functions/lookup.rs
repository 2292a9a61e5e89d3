//! The style transfer function (3.2, 4.1; [STF-3]): from a value to styles, and from styles to a colour.

use super::{MipMap, SphereMap};
use crate::bilinear::mix;
use crate::number::Real;
use crate::transfer::{NodePatch, NodePlace};
use drypoint_scene::shot::Mix;
use drypoint_scene::style::Style;

/// The index function `ift` (4.1): from the nodes of `tft` to the M distinct styles.
#[derive(Clone, Debug, PartialEq)]
pub struct StyleIndex {
    /// The style of each node. None if node k has style k (M = N), for which the paper skips the lookup.
    of_node: Option<Vec<u32>>,
}

/// The styles of a value: j₀ and j₁ in the shares 1 − w and w, with the uniform opacity α_u.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blend<R> {
    /// j₀.
    pub j0: usize,
    /// j₁.
    pub j1: usize,
    /// w, the share of style j₁, in [0, 1).
    pub w: R,
    /// α_u, per reference length.
    pub alpha_u: R,
}

impl StyleIndex {
    /// The index of styles from the style of each node.
    pub fn new(style: &[usize]) -> Self {
        let is_identity = style.iter().enumerate().all(|(k, &j)| k == j);
        Self { of_node: (!is_identity).then(|| style.iter().map(|&j| j as u32).collect()) }
    }

    /// The blend at (i, α_u) = tft(s), i = i₀ + w: j₀ = ift(i₀) and j₁ = ift(i₀ + 1) (4.1, steps 2 and 3).
    #[inline]
    pub fn blend<R: Real>(&self, place: &NodePlace<R>) -> Blend<R> {
        let &NodePlace { node, w, alpha_u } = place;
        if w == R::ZERO {
            let j = self.style(node);
            return Blend { j0: j, j1: j, w, alpha_u };
        }
        let j1 = self.style(node + 1);
        // For a value just below a node, w can round to 1. Then the first style has no share.
        if w >= R::ONE {
            return Blend { j0: j1, j1, w: R::ZERO, alpha_u };
        }
        Blend { j0: self.style(node), j1, w, alpha_u }
    }

    #[inline]
    pub(super) fn style(&self, k: usize) -> usize {
        self.of_node.as_ref().map_or(k, |ift| ift[k] as usize)
    }
}

impl<R: Real> Blend<R> {
    /// Whether only one style is visible.
    #[inline]
    pub fn is_pure(&self) -> bool {
        self.j0 == self.j1 || self.w == R::ZERO
    }

    /// Number of style pictures that a lookup reads: one or two ([PLAN-2]).
    #[inline]
    pub fn lookups(&self) -> u64 {
        if self.is_pure() { 1 } else { 2 }
    }
}

/// The styles of two quantities (4.2): the blends of two rows, mixed in the shares 1 − w and w.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blend2<R> {
    /// j₀₀ and j₁₀, j₀₁ and j₁₁, each pair with w_x.
    pub rows: [Blend<R>; 2],
    /// w_y, the share of the second row, in [0, 1).
    pub w: R,
}

impl<R: Real> Blend2<R> {
    /// The blend at the places in two rows, by four lookups in ift.
    #[inline]
    pub fn new(index: &StyleIndex, patch: &NodePatch<R>) -> Self {
        Self { rows: patch.rows.each_ref().map(|place| index.blend(place)), w: patch.w }
    }

    /// j₀₀, j₁₀, j₀₁, j₁₁. A style without a share is replaced by its neighbour.
    #[inline]
    fn styles(&self) -> [usize; 4] {
        let [a, b] = self.rows.map(|row| [row.j0, if row.is_pure() { row.j0 } else { row.j1 }]);
        let b = if self.w == R::ZERO { a } else { b };
        [a[0], a[1], b[0], b[1]]
    }

    /// Number of style pictures that a lookup reads, each once: one to four ([PLAN-2]).
    #[inline]
    pub fn lookups(&self) -> u64 {
        let j = self.styles();
        (0..4).map(|i| u64::from(!j[..i].contains(&j[i]))).sum()
    }
}

/// The texture `sft` (4.1): the distinct styles of a transfer function.
#[derive(Clone, Debug, PartialEq)]
pub struct Spheres<R> {
    maps: Vec<SphereMap>,
    /// The mip chain of each style, if the scene has `[style_mipmaps]`.
    chains: Vec<MipMap<R>>,
    pub(super) mix: Mix,
}

impl<R: Real> Spheres<R> {
    /// The styles in the order of their indices j.
    pub fn new(styles: &[Style], mix: Mix) -> Self {
        Self { maps: styles.iter().map(SphereMap::new).collect(), chains: Vec::new(), mix }
    }

    /// Adds a mip chain for each style. `styles` must be those from which `self` was made.
    pub fn with_mipmaps(self, styles: &[Style]) -> Self {
        Self { chains: styles.iter().map(MipMap::new).collect(), ..self }
    }

    /// The size of the mip chains in bytes. Returns none without mip chains.
    pub fn mipmap_bytes(&self) -> Option<usize> {
        (!self.chains.is_empty()).then(|| self.chains.iter().map(MipMap::bytes).sum())
    }

    /// Style j.
    pub fn map(&self, j: usize) -> &SphereMap {
        &self.maps[j]
    }

    /// (r, g, b, α_d) = (sft(n, j₀₀)(1 − w_x) + sft(n, j₁₀) w_x)(1 − w_y) + (sft(n, j₀₁)(1 − w_x) + sft(n, j₁₁) w_x)
    /// w_y (4.2). Mixed like [`lookup`](Self::lookup).
    #[inline]
    pub fn lookup2(&self, blend: &Blend2<R>, nx: R, ny: R) -> [R; 4] {
        self.mixed2(blend, |j| self.maps[j].sample(nx, ny))
    }

    /// Like [`lookup2`](Self::lookup2), in the mip chains ([STF-10]). See [`Spheres::lookup_level`].
    #[inline(never)]
    pub fn lookup2_level(&self, blend: &Blend2<R>, nx: R, ny: R, below_last: R) -> [R; 4] {
        self.mixed2(blend, |j| self.chains[j].sample(&self.maps[j], nx, ny, below_last))
    }

    /// The mix of the lookups in each style of two rows.
    #[inline(always)]
    fn mixed2(&self, blend: &Blend2<R>, sft: impl Fn(usize) -> [R; 4]) -> [R; 4] {
        let j = blend.styles();
        let same = j.iter().all(|&k| k == j[0]);
        if same || blend.w == R::ZERO {
            return self.mixed(&blend.rows[0], sft);
        }
        let mut texels = [[R::ZERO; 4]; 4];
        for i in 0..4 {
            texels[i] = match j[..i].iter().position(|&k| k == j[i]) {
                Some(read) => texels[read],
                None => {
                    let texel = sft(j[i]);
                    if self.mix == Mix::Printed { straight(texel) } else { texel }
                }
            };
        }
        // A row of one style has the same texel twice. Every share returns this texel exactly.
        let row = |i: usize| mix(texels[2 * i], texels[2 * i + 1], blend.rows[i].w);
        let [r, g, b, a] = mix(row(0), row(1), blend.w);
        match self.mix {
            Mix::Premultiplied => [r, g, b, a],
            Mix::Printed => [r * a, g * a, b * a, a],
        }
    }

    /// (r, g, b, α_d) = sft(n, j₀)(1 − w) + sft(n, j₁) w (4.1, step 4), linear and premultiplied by α_d. A style
    /// without a share is not read.
    ///
    /// [`Mix::Premultiplied`] mixes the premultiplied lookups. [`Mix::Printed`] mixes straight colour and opacity
    /// separately, so that a transparent style still lends its colour, and multiplies afterwards.
    #[inline]
    pub fn lookup(&self, blend: &Blend<R>, nx: R, ny: R) -> [R; 4] {
        self.mixed(blend, |j| self.maps[j].sample(nx, ny))
    }

    /// Like [`lookup`](Self::lookup), in the mip chains ([STF-10]), at the level of detail `below_last` of
    /// [`Detail::below_last`]. Each style is interpolated between its own levels first; styles are mixed afterwards.
    /// Never inlined: scenes without mip-maps do without its code.
    ///
    /// [`Detail::below_last`]: super::Detail::below_last
    #[inline(never)]
    pub fn lookup_level(&self, blend: &Blend<R>, nx: R, ny: R, below_last: R) -> [R; 4] {
        self.mixed(blend, |j| self.chains[j].sample(&self.maps[j], nx, ny, below_last))
    }

    /// The mix of the lookups in each style.
    #[inline(always)]
    fn mixed(&self, blend: &Blend<R>, sft: impl Fn(usize) -> [R; 4]) -> [R; 4] {
        let first = sft(blend.j0);
        if blend.is_pure() {
            return first;
        }
        let second = sft(blend.j1);
        match self.mix {
            Mix::Premultiplied => mix(first, second, blend.w),
            Mix::Printed => {
                let [r, g, b, a] = mix(straight(first), straight(second), blend.w);
                [r * a, g * a, b * a, a]
            }
        }
    }
}

/// Premultiplied RGBA divided by its opacity; 0 where the opacity is 0.
#[inline(always)]
fn straight<R: Real>([r, g, b, a]: [R; 4]) -> [R; 4] {
    if a == R::ZERO { [R::ZERO; 4] } else { [r / a, g / a, b / a, a] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transfer::Piecewise;

    /// A style of straight linear texels.
    fn style(side: usize, texel: impl Fn(usize, usize) -> [f64; 4]) -> Style {
        let texels: Vec<_> = (0..side * side).map(|t| texel(t % side, t / side)).collect();
        Style::from_straight("test", side, &texels, true).unwrap()
    }

    fn blend_at(at: &[f64], opacity: &[f64], style: &[usize], s: f64) -> Option<Blend<f64>> {
        Piecewise::new(at, opacity).unwrap().locate(s).map(|place| StyleIndex::new(style).blend(&place))
    }

    #[test]
    fn the_function_by_hand() {
        // Three nodes: wax, wax, metal.
        let at = |s| blend_at(&[60.0, 90.0, 180.0], &[0.0, 0.1, 0.9], &[0, 0, 1], s);
        let blend = |j0, j1, w, alpha_u| Some(Blend { j0, j1, w, alpha_u });
        assert_eq!(at(75.0), blend(0, 0, 0.5, 0.05));
        assert_eq!(at(135.0), blend(0, 1, 0.5, 0.5));
        // Beyond the ends the end nodes hold; at them they hold exactly.
        assert_eq!(at(180.0), blend(1, 1, 0.0, 0.9));
        assert_eq!(at(1e9), blend(1, 1, 0.0, 0.9));
        assert_eq!([at(60.0), at(-1e9)], [None, None]);
        assert_eq!([75.0, 135.0, 180.0].map(|s| at(s).unwrap().lookups()), [1, 2, 1]);
    }

    #[test]
    fn mip_chains_are_counted_where_there_are_some() {
        let styles = [style(2, |_, _| [1.0; 4]), style(4, |_, _| [1.0; 4])];
        let spheres = Spheres::<f64>::new(&styles, Mix::Premultiplied);
        assert_eq!(spheres.mipmap_bytes(), None);
        let bytes: usize = styles.iter().map(|s| MipMap::<f64>::new(s).bytes()).sum();
        assert_eq!(spheres.with_mipmaps(&styles).mipmap_bytes(), Some(bytes));
        assert!(bytes > 0);
    }

    #[test]
    fn a_step_shows_the_later_node_at_its_value() {
        let at = |s| blend_at(&[0.0, 10.0, 10.0, 20.0], &[0.2, 0.4, 0.6, 0.8], &[0, 1, 2, 3], s).unwrap();
        assert_eq!(at(10.0), Blend { j0: 2, j1: 2, w: 0.0, alpha_u: 0.6 });
        let below = at(10.0 - 1e-9);
        assert_eq!((below.j0, below.j1), (0, 1));
        assert!((below.alpha_u - 0.4).abs() < 1e-9);
    }

    #[test]
    fn one_style_per_node_needs_no_index() {
        let same = |style: &[usize]| StyleIndex::new(style).of_node.is_none();
        assert!(same(&[0, 1, 2]));
        assert!(!same(&[0, 1, 0]) && !same(&[1, 0, 2]));
        let got = blend_at(&[0.0, 1.0, 2.0], &[1.0; 3], &[0, 1, 0], 1.25);
        assert_eq!(got, Some(Blend { j0: 1, j1: 0, w: 0.25, alpha_u: 1.0 }));
    }

    #[test]
    fn styles_mix_premultiplied_or_as_printed() {
        // A transparent red and an opaque blue, half and half.
        let styles = [style(1, |_, _| [1.0, 0.0, 0.0, 0.0]), style(1, |_, _| [0.0, 0.0, 1.0, 1.0])];
        let half = Blend { j0: 0, j1: 1, w: 0.5, alpha_u: 1.0 };
        let premultiplied = Spheres::<f64>::new(&styles, Mix::Premultiplied).lookup(&half, 0.0, 0.0);
        assert_eq!(premultiplied, [0.0, 0.0, 0.5, 0.5]);
        // Printed, on a red of opacity ½: RGBA (1, 0, 0, ½) and (0, 0, 1, 1) mix to (½, 0, ½, ¾), times ¾.
        let styles = [style(1, |_, _| [1.0, 0.0, 0.0, 0.5]), styles[1].clone()];
        let printed = Spheres::<f64>::new(&styles, Mix::Printed).lookup(&half, 0.0, 0.0);
        assert_eq!(printed, [0.375, 0.0, 0.375, 0.75]);
        let premultiplied = Spheres::<f64>::new(&styles, Mix::Premultiplied).lookup(&half, 0.0, 0.0);
        assert_eq!(premultiplied, [0.25, 0.0, 0.5, 0.75]);
    }

    fn blend2(j: [usize; 4], wx: [f64; 2], w: f64) -> Blend2<f64> {
        let row = |j0, j1, w| Blend { j0, j1, w, alpha_u: 1.0 };
        Blend2 { rows: [row(j[0], j[1], wx[0]), row(j[2], j[3], wx[1])], w }
    }

    #[test]
    fn four_styles_by_hand() {
        // Straight red, green, blue and white of opacities 1, ½, ½ and 0; a quarter across, half way down.
        let color = |r, g, b, a| style(1, move |_, _| [r, g, b, a]);
        let styles = [
            color(1.0, 0.0, 0.0, 1.0),
            color(0.0, 1.0, 0.0, 0.5),
            color(0.0, 0.0, 1.0, 0.5),
            color(1.0, 1.0, 1.0, 0.0),
        ];
        let blend = blend2([0, 1, 2, 3], [0.25, 0.25], 0.5);
        assert_eq!(blend.lookups(), 4);
        // The shares are 3/8, 1/8, 3/8, 1/8 of (1, 0, 0, 1), (0, ½, 0, ½), (0, 0, ½, ½), 0.
        let premultiplied = Spheres::<f64>::new(&styles, Mix::Premultiplied).lookup2(&blend, 0.0, 0.0);
        assert_eq!(premultiplied, [0.375, 0.0625, 0.1875, 0.625]);
        // Printed: a lookup of opacity 0 has no colour; RGB (3/8, 1/8, 3/8), times 5/8.
        let printed = Spheres::<f64>::new(&styles, Mix::Printed).lookup2(&blend, 0.0, 0.0);
        assert_eq!(printed, [0.234375, 0.078125, 0.234375, 0.625]);
    }

    #[test]
    fn each_style_is_read_once_and_only_where_it_has_a_share() {
        assert_eq!(blend2([0, 1, 1, 0], [0.5, 0.5], 0.5).lookups(), 2);
        assert_eq!(blend2([0, 0, 0, 0], [0.5, 0.5], 0.5).lookups(), 1);
        assert_eq!(blend2([0, 1, 2, 3], [0.5, 0.0], 0.5).lookups(), 3);
        assert_eq!(blend2([0, 1, 2, 3], [0.5, 0.5], 0.0).lookups(), 2);
        let poison = Style { name: "poison".into(), side: 1, texels: vec![[f64::NAN; 4]] };
        let styles = [style(1, |_, _| [0.5, 0.25, 0.125, 1.0]), style(1, |_, _| [0.25, 0.5, 0.0, 1.0]), poison];
        for mix in [Mix::Premultiplied, Mix::Printed] {
            let spheres = Spheres::<f64>::new(&styles, mix);
            assert_eq!(spheres.lookup2(&blend2([0, 1, 2, 2], [0.5, 0.5], 0.0), 0.0, 0.0), [0.375, 0.375, 0.0625, 1.0]);
            assert_eq!(spheres.lookup2(&blend2([0, 2, 1, 2], [0.0, 0.0], 0.5), 0.0, 0.0), [0.375, 0.375, 0.0625, 1.0]);
        }
    }

    #[test]
    fn two_rows_alike_are_one() {
        let styles =
            [style(4, |i, j| [i as f64 / 3.0, 0.2, j as f64, 0.3]), style(2, |_, j| [0.7, j as f64, 0.3, 0.9])];
        for mix in [Mix::Premultiplied, Mix::Printed] {
            let spheres = Spheres::<f64>::new(&styles, mix);
            for (j1, w) in [(1, 0.3), (0, 0.3), (1, 0.0)] {
                let row = Blend { j0: 0, j1, w, alpha_u: 1.0 };
                let both = Blend2 { rows: [row; 2], w: 0.7 };
                assert_eq!(spheres.lookup2(&both, 0.3, -0.2), spheres.lookup(&row, 0.3, -0.2));
            }
        }
    }

    #[test]
    fn opaque_styles_mix_alike_both_ways() {
        let styles = [style(4, |i, _| [i as f64 / 3.0, 0.2, 0.1, 1.0]), style(2, |_, j| [0.7, j as f64, 0.3, 1.0])];
        let [a, b] = [Mix::Premultiplied, Mix::Printed].map(|mix| Spheres::<f64>::new(&styles, mix));
        for w in [0.0, 0.25, 0.6] {
            let blend = Blend { j0: 0, j1: 1, w, alpha_u: 0.5 };
            assert_eq!(a.lookup(&blend, 0.3, -0.2), b.lookup(&blend, 0.3, -0.2));
        }
    }

    #[test]
    fn a_style_of_opacity_zero_is_nothing() {
        let styles = [style(3, |i, j| [i as f64, j as f64, 1.0, 0.0])];
        for mix in [Mix::Premultiplied, Mix::Printed] {
            let blend = Blend { j0: 0, j1: 0, w: 0.0, alpha_u: 1.0 };
            assert_eq!(Spheres::<f64>::new(&styles, mix).lookup(&blend, 0.1, 0.2), [0.0; 4]);
        }
    }

    #[test]
    fn a_style_without_a_share_is_not_read() {
        // Reading the second style would poison the result.
        let poison = Style { name: "poison".into(), side: 1, texels: vec![[f64::NAN; 4]] };
        let styles = [style(1, |_, _| [0.5, 0.25, 0.125, 1.0]), poison];
        for mix in [Mix::Premultiplied, Mix::Printed] {
            let blend = Blend { j0: 0, j1: 1, w: 0.0, alpha_u: 1.0 };
            assert_eq!(Spheres::<f64>::new(&styles, mix).lookup(&blend, 0.0, 0.0), [0.5, 0.25, 0.125, 1.0]);
        }
    }
}
