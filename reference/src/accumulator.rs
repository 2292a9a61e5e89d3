//! The only *over* operator ([VAL-3]).

use crate::number::Arithmetic;

/// Accumulated premultiplied colour C and opacity A, of one ray or of rays side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Accumulator<T> {
    /// C, in the blend space.
    pub(crate) rgb: [T; 3],
    /// A.
    pub(crate) opacity: T,
}

impl<T: Arithmetic> Accumulator<T> {
    /// An empty accumulator, made from a given 0.
    #[inline(always)]
    pub(crate) fn empty(zero: T) -> Self {
        Self { rgb: [zero; 3], opacity: zero }
    }

    /// Composites a straight colour c of opacity α behind the accumulated one: w = (1 − A)·α, C ← C + w·c, A ← A + w.
    /// Returns w.
    #[inline(always)]
    pub(crate) fn over(&mut self, rgb: [T; 3], alpha: T) -> T {
        let (w, opacity) = self.opacity.laid_before(alpha);
        self.add(rgb, w);
        self.opacity = opacity;
        w
    }

    /// Like [`over`](Self::over), in the lanes of a mask.
    #[inline(always)]
    pub(crate) fn over_where(&mut self, mask: T::Mask, rgb: [T; 3], alpha: T) {
        let mut with = *self;
        with.over(rgb, alpha);
        for (before, with) in self.rgb.iter_mut().zip(with.rgb) {
            *before = T::select(mask, with, *before);
        }
        self.opacity = T::select(mask, with.opacity, self.opacity);
    }

    /// Composites a premultiplied colour B of opacity A_B behind the accumulated one: C ← C + (1 − A)·B, A ← A + (1 −
    /// A)·A_B ([IO-6]).
    #[inline(always)]
    pub(crate) fn over_premultiplied(&mut self, [r, g, b, opacity]: [T; 4]) {
        let through = self.opacity.one() - self.opacity;
        self.add([r, g, b], through);
        self.opacity = self.opacity + through * opacity;
    }

    /// Composites an opaque colour behind the accumulated one, after which A is exactly 1. Returns w = 1 − A.
    #[inline(always)]
    pub(crate) fn end(&mut self, rgb: [T; 3]) -> T {
        let w = self.opacity.one() - self.opacity;
        self.add(rgb, w);
        self.opacity = self.opacity.one();
        w
    }

    #[inline(always)]
    fn add(&mut self, [r, g, b]: [T; 3], w: T) {
        let [before_r, before_g, before_b] = self.rgb;
        self.rgb = [before_r + w * r, before_g + w * g, before_b + w * b];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn over_by_hand() {
        let mut front = Accumulator::empty(0.0);
        assert_eq!(front.over([1.0, 0.5, 0.0], 0.5), 0.5);
        assert_eq!(front, Accumulator { rgb: [0.5, 0.25, 0.0], opacity: 0.5 });
        assert_eq!(front.over([0.0, 1.0, 1.0], 0.5), 0.25);
        assert_eq!(front, Accumulator { rgb: [0.5, 0.5, 0.25], opacity: 0.75 });
        assert_eq!(front.end([1.0; 3]), 0.25);
        assert_eq!(front, Accumulator { rgb: [0.75, 0.75, 0.5], opacity: 1.0 });
    }

    /// However 1 − A rounds, an opaque colour leaves A = 1.
    #[test]
    fn opaque_is_opaque() {
        for i in 0..1000 {
            let mut front = Accumulator::empty(0.0);
            front.over([0.3; 3], f64::from(i) / 999.0);
            front.end([0.3; 3]);
            assert_eq!(front.opacity, 1.0);
            assert!((front.rgb[0] - 0.3).abs() < 1e-16 * 2.0);
        }
    }
}
