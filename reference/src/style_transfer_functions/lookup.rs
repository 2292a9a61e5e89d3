//! The style transfer function (3.2, 4.1; [STF-3]): from a value to styles, and from styles to a colour.

use super::sphere_map::mix;
use super::{NodesError, Segments, SphereMap};
use crate::number::Real;
use drypoint_scene::style::Style;
use drypoint_scene::tables::Mix;

/// The texture `tft` with `ift` behind it (4.1): which styles a value shows, how they mix, and its uniform opacity.
/// Evaluated from the nodes themselves, not from a table of them.
#[derive(Clone, Debug, PartialEq)]
pub struct StyleFunction<R> {
    nodes: Segments<R>,
    opacity: Vec<R>,
    /// `ift`: node to style. None where node k has style k (M = N), for which the paper skips the lookup.
    index: Option<Vec<u32>>,
}

/// What a value shows: styles j₀ and j₁ in the shares 1 − w and w, with the uniform opacity α_u.
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

impl<R: Real> StyleFunction<R> {
    /// From nodes in non-decreasing order of `at`: uniform opacities in [0, 1], and indices into the styles.
    ///
    /// # Errors
    /// Lists of different length, an opacity outside [0, 1], and what [`Segments::new`] refuses.
    pub fn new(at: &[f64], opacity: &[f64], style: &[usize]) -> Result<Self, NodesError> {
        if at.len() != opacity.len() || at.len() != style.len() {
            return Err(NodesError::Lengths { at: at.len(), opacity: opacity.len(), style: style.len() });
        }
        if let Some(node) = opacity.iter().position(|a| !(0.0..=1.0).contains(a)) {
            return Err(NodesError::Opacity { node, opacity: opacity[node] });
        }
        let is_identity = style.iter().enumerate().all(|(k, &j)| k == j);
        Ok(Self {
            nodes: Segments::new(at)?,
            opacity: opacity.iter().map(|&a| R::from_f64(a)).collect(),
            index: (!is_identity).then(|| style.iter().map(|&j| j as u32).collect()),
        })
    }

    /// (i, α_u) = tft(s), i₀ = ⌊i⌋, i₁ = i₀ + 1, w = i − i₀, j = ift(i) (4.1, steps 1 to 3).
    #[inline]
    pub fn eval(&self, s: R) -> Blend<R> {
        let (k, t) = self.nodes.find(s);
        if t == R::ZERO {
            let j = self.style(k);
            return Blend { j0: j, j1: j, w: R::ZERO, alpha_u: self.opacity[k] };
        }
        let alpha_u = R::lerp(self.opacity[k], self.opacity[k + 1], t);
        let j1 = self.style(k + 1);
        // A value just below a node can round to the whole way; then the first style has no share.
        if t >= R::ONE {
            return Blend { j0: j1, j1, w: R::ZERO, alpha_u };
        }
        Blend { j0: self.style(k), j1, w: t, alpha_u }
    }

    #[inline]
    fn style(&self, k: usize) -> usize {
        self.index.as_ref().map_or(k, |ift| ift[k] as usize)
    }
}

impl<R: Real> Blend<R> {
    /// Whether one style alone is shown.
    #[inline]
    pub fn is_pure(&self) -> bool {
        self.j0 == self.j1 || self.w == R::ZERO
    }

    /// How many style pictures a lookup reads: one or two ([PLAN-2]).
    #[inline]
    pub fn lookups(&self) -> u64 {
        if self.is_pure() { 1 } else { 2 }
    }
}

/// The texture `sft` (4.1): the distinct styles of a transfer function.
#[derive(Clone, Debug, PartialEq)]
pub struct Spheres<R> {
    maps: Vec<SphereMap<R>>,
    mix: Mix,
}

impl<R: Real> Spheres<R> {
    /// The styles in the order of their indices j.
    pub fn new(styles: &[Style], mix: Mix) -> Self {
        Self { maps: styles.iter().map(SphereMap::new).collect(), mix }
    }

    /// Style j.
    pub fn map(&self, j: usize) -> &SphereMap<R> {
        &self.maps[j]
    }

    /// (r, g, b, α_d) = sft(n, j₀)(1 − w) + sft(n, j₁) w (4.1, step 4), linear and premultiplied by α_d. A style
    /// without a share is not read.
    ///
    /// [`Mix::Premultiplied`] mixes the premultiplied lookups. [`Mix::Printed`] mixes straight colour and opacity each
    /// by itself, so that a transparent style still lends its colour, and multiplies afterwards.
    #[inline]
    pub fn lookup(&self, blend: &Blend<R>, nx: R, ny: R) -> [R; 4] {
        let first = self.maps[blend.j0].sample(nx, ny);
        if blend.is_pure() {
            return first;
        }
        let second = self.maps[blend.j1].sample(nx, ny);
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

    /// A style of straight linear texels.
    fn style(side: usize, texel: impl Fn(usize, usize) -> [f64; 4]) -> Style {
        let texels: Vec<_> = (0..side * side).map(|t| texel(t % side, t / side)).collect();
        Style::from_straight("test", side, &texels, true).unwrap()
    }

    fn function(at: &[f64], opacity: &[f64], style: &[usize]) -> StyleFunction<f64> {
        StyleFunction::new(at, opacity, style).unwrap()
    }

    #[test]
    fn the_function_by_hand() {
        // The nodes of the scene-file page: wax, wax, metal.
        let tft = function(&[60.0, 90.0, 180.0], &[0.0, 0.1, 0.9], &[0, 0, 1]);
        let blend = |j0, j1, w, alpha_u| Blend { j0, j1, w, alpha_u };
        assert_eq!(tft.eval(60.0), blend(0, 0, 0.0, 0.0));
        assert_eq!(tft.eval(75.0), blend(0, 0, 0.5, 0.05));
        assert_eq!(tft.eval(135.0), blend(0, 1, 0.5, 0.5));
        // Beyond the ends the end nodes hold; at them they hold exactly.
        assert_eq!(tft.eval(180.0), blend(1, 1, 0.0, 0.9));
        assert_eq!(tft.eval(1e9), blend(1, 1, 0.0, 0.9));
        assert_eq!(tft.eval(-1e9), blend(0, 0, 0.0, 0.0));
        assert_eq!([60.0, 75.0, 135.0, 180.0].map(|s| tft.eval(s).lookups()), [1, 1, 2, 1]);
    }

    #[test]
    fn a_step_shows_the_later_node_at_its_value() {
        let tft = function(&[0.0, 10.0, 10.0, 20.0], &[0.2, 0.4, 0.6, 0.8], &[0, 1, 2, 3]);
        assert_eq!(tft.eval(10.0), Blend { j0: 2, j1: 2, w: 0.0, alpha_u: 0.6 });
        let below = tft.eval(10.0 - 1e-9);
        assert_eq!((below.j0, below.j1), (0, 1));
        assert!((below.alpha_u - 0.4).abs() < 1e-9);
    }

    #[test]
    fn one_style_per_node_needs_no_index() {
        let same = |style: &[usize]| function(&[0.0, 1.0, 2.0], &[1.0; 3], style).index.is_none();
        assert!(same(&[0, 1, 2]));
        assert!(!same(&[0, 1, 0]) && !same(&[1, 0, 2]));
        assert_eq!(
            function(&[0.0, 1.0, 2.0], &[1.0; 3], &[0, 1, 0]).eval(1.25),
            Blend { j0: 1, j1: 0, w: 0.25, alpha_u: 1.0 }
        );
    }

    #[test]
    fn what_is_no_function_is_refused() {
        let new = StyleFunction::<f64>::new;
        assert_eq!(new(&[0.0], &[], &[0]), Err(NodesError::Lengths { at: 1, opacity: 0, style: 1 }));
        assert_eq!(new(&[0.0, 1.0], &[0.5, 1.5], &[0, 0]), Err(NodesError::Opacity { node: 1, opacity: 1.5 }));
        assert!(new(&[0.0], &[f64::NAN], &[0]).is_err());
        assert_eq!(new(&[], &[], &[]), Err(NodesError::Empty));
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
