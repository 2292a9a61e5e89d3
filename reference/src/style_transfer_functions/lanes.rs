//! The lookup of styles for eight samples side by side. The bits are the same.

use super::{SphereMap, Spheres, StyleIndex};
use crate::field::lanes::{LANES, whole};
use crate::number::Arithmetic;
use crate::number::lanes::columns;
use crate::transfer::lanes::NodePlaces;
use drypoint_scene::shot::Mix;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8, f64x4, f64x8, mask64x8};

/// The styles of each lane, like [`Blend`](super::Blend). w is that of the [`NodePlaces`] from which the blends are made.
pub(crate) struct Blends {
    /// j₀, or the only visible style.
    first: [u32; LANES],
    /// j₁.
    second: [u32; LANES],
    /// Lanes in which both styles have a share.
    mixed: u64,
}

impl Blends {
    /// Number of style pictures that a lookup of the lanes reads.
    #[inline(always)]
    pub(crate) fn lookups(&self, lanes: u64) -> u64 {
        u64::from(lanes.count_ones() + (lanes & self.mixed).count_ones())
    }
}

impl StyleIndex {
    /// [`blend`](Self::blend) of the visible lanes, for a function whose last node is `last`.
    #[inline(always)]
    pub(crate) fn blends<S: Simd>(&self, place: &NodePlaces<S>, last: usize) -> Blends {
        let nodes = place.nodes.each();
        let all = place.w.simd_ge(1.0).to_bitmask();
        let (mut first, mut second, mut differ) = ([0; LANES], [0; LANES], 0);
        for lane in 0..LANES {
            let node = nodes[lane] as usize;
            // At the last node w is 0.
            let (j0, j1) = (self.style(node) as u32, self.style(last.min(node + 1)) as u32);
            first[lane] = if all >> lane & 1 == 1 { j1 } else { j0 };
            second[lane] = j1;
            differ |= u64::from(j0 != j1) << lane;
        }
        let mixed = place.visible & place.w.simd_ne(0.0).to_bitmask() & !all & differ;
        Blends { first, second, mixed }
    }
}

impl Spheres<f64> {
    /// [`lookup`](Self::lookup) of the visible lanes: (r, g, b, α_d).
    #[inline(always)]
    pub(crate) fn lookup_lanes<S: Simd>(
        &self,
        blends: &Blends,
        place: &NodePlaces<S>,
        x: f64x8<S>,
        y: f64x8<S>,
    ) -> [f64x8<S>; 4] {
        let simd = x.simd;
        let mut texels = [f64x4::splat(simd, 0.0); LANES];
        self.read(&blends.first, place.visible, [x, y], &mut texels);
        if blends.mixed != 0 {
            let mut others = [f64x4::splat(simd, 0.0); LANES];
            self.read(&blends.second, blends.mixed, [x, y], &mut others);
            for lane in 0..LANES {
                if blends.mixed >> lane & 1 == 1 {
                    let (a, b, w) = (texels[lane], others[lane], f64x4::splat(simd, place.w[lane]));
                    texels[lane] = match self.mix {
                        Mix::Premultiplied => f64x4::lerp(a, b, w),
                        Mix::Printed => {
                            let mixed = f64x4::lerp(straight(a), straight(b), w);
                            let mut premultiplied = mixed * mixed[3];
                            premultiplied[3] = mixed[3];
                            premultiplied
                        }
                    };
                }
            }
        }
        columns(texels)
    }

    /// Reads one style in each of `lanes`, at the lane's normal. The other lanes get the first texel of their style.
    #[inline(always)]
    fn read<S: Simd>(&self, styles: &[u32; LANES], lanes: u64, [x, y]: [f64x8<S>; 2], texels: &mut [f64x4<S>; LANES]) {
        let simd = x.simd;
        let mut sides = [0.0; LANES];
        for (side, &j) in sides.iter_mut().zip(styles) {
            *side = self.map(j as usize).side as f64;
        }
        let side = f64x8::simd_from(simd, sides);
        let half_side = side * 0.5;
        let (i, wx) = cell((x + 1.0) * half_side - 0.5, side);
        let (j, wy) = cell((1.0 - y) * half_side - 0.5, side);
        let asked = mask64x8::from_bitmask(simd, lanes);
        let start = whole(asked.select(j * side + i, f64x8::splat(simd, 0.0)));
        // No branch for each lane, since it would be unpredictable.
        for (lane, texel) in texels.iter_mut().enumerate() {
            *texel = self.map(styles[lane] as usize).filtered(simd, start[lane], [wx[lane], wy[lane]]);
        }
    }
}

/// Premultiplied RGBA divided by its opacity; 0 where the opacity is 0.
#[inline(always)]
fn straight<S: Simd>(texel: f64x4<S>) -> f64x4<S> {
    let a = texel[3];
    if a == 0.0 {
        return f64x4::splat(texel.simd, 0.0);
    }
    let mut straight = texel / a;
    straight[3] = a;
    straight
}

impl SphereMap {
    /// Bilinear interpolation in the cell whose first texel is `start`: x, then y.
    #[inline(always)]
    fn filtered<S: Simd>(&self, simd: S, start: usize, [wx, wy]: [f64; 2]) -> f64x4<S> {
        let (wx, wy) = (f64x4::splat(simd, wx), f64x4::splat(simd, wy));
        if self.side == 1 {
            // If the style has one texel, the cell has no second one, and the weights are 0.
            return f64x4::simd_from(simd, self.texels[0].map(f64::from));
        }
        let row = |at: usize| f32x8::from_slice(simd, self.texels[at..][..2].as_flattened());
        let ((a, b), (c, d)) = (simd.widen_f32x8(row(start)), simd.widen_f32x8(row(start + self.side)));
        let (upper, lower) = (f64x4::lerp(a, b, wx), f64x4::lerp(c, d, wx));
        f64x4::lerp(upper, lower, wy)
    }
}

/// The cell of a coordinate and the fraction in it, as for a single normal.
#[inline(always)]
fn cell<S: Simd>(x: f64x8<S>, side: f64x8<S>) -> (f64x8<S>, f64x8<S>) {
    let simd = x.simd;
    let (zero, one, end) = (f64x8::splat(simd, 0.0), f64x8::splat(simd, 1.0), side - 1.0);
    let x = x.simd_lt(zero).select(zero, x);
    let x = x.simd_gt(end).select(end, x);
    let i = x.floor();
    let w = x - i;
    let last = i.simd_ge(end) & i.simd_gt(zero);
    (last.select(i - one, i), last.select(w + one, w))
}

#[cfg(test)]
mod tests {
    use super::super::Blend;
    use super::*;
    use crate::number::lanes::testing::{column, numbers};
    use crate::transfer::Piecewise;
    use drypoint_scene::style::Style;
    use fearless_simd::{Level, dispatch};

    #[test]
    fn lookups_are_those_of_one() {
        let level = Level::new();
        let paint = |side: usize, k: f64| {
            let mut noise = numbers(side as u64);
            let texels: Vec<_> = (0..side * side).map(|_| [0; 4].map(|_| noise.next().unwrap() * k)).collect();
            Style::from_straight("test", side, &texels, true).unwrap()
        };
        let styles = [paint(9, 1.0), paint(1, 0.7), paint(16, 0.0), paint(2, 1.0)];
        let [mut a, mut b, mut c] = [9, 10, 11].map(numbers);
        // One style for a while, two that mix, a step, and the last node's own stretch.
        let at = [0.1, 0.3, 0.5, 0.6, 0.6, 0.8, 0.9];
        let function = Piecewise::<f64>::new(&at, &[1.0, 0.5, 0.5, 0.2, 0.0, 0.0, 1.0]).unwrap();
        for (mix, index) in [Mix::Premultiplied, Mix::Printed]
            .into_iter()
            .flat_map(|mix| [[0, 0, 1, 2, 3, 0, 2], [3, 1, 0, 0, 2, 2, 1]].map(|index| (mix, StyleIndex::new(&index))))
        {
            let spheres = Spheres::<f64>::new(&styles, mix);
            for near in (0..800).map(|i| i % 2 == 0) {
                let spread = if near { 0.02 } else { 1.1 };
                let start = a.next().unwrap();
                let s = column(&mut a).map(|s| start + s * spread);
                let (x, y) = (column(&mut b).map(|x| 2.0 * x - 1.0), column(&mut c).map(|y| 2.0 * y - 1.0));
                let got: Option<(u64, u64, [[f64; LANES]; 4])> = dispatch!(level, simd => {
                    function.locate_lanes(s.simd_into(simd), mask64x8::splat(simd, true)).map(|place| {
                        let blends = index.blends(&place, function.last());
                        let rgba = spheres.lookup_lanes(&blends, &place, x.simd_into(simd), y.simd_into(simd));
                        (place.visible, blends.lookups(place.visible), rgba.map(|c| c.into()))
                    })
                });
                let alone: [Option<Blend<f64>>; LANES] = s.map(|s| function.locate(s).map(|place| index.blend(&place)));
                let Some((visible, lookups, got)) = got else {
                    assert!(alone.iter().all(Option::is_none));
                    continue;
                };
                assert_eq!(lookups, alone.iter().flatten().map(Blend::lookups).sum::<u64>());
                for (lane, blend) in alone.iter().enumerate() {
                    assert_eq!(visible >> lane & 1 == 1, blend.is_some());
                    if let Some(blend) = blend {
                        let want = spheres.lookup(blend, x[lane], y[lane]).map(f64::to_bits);
                        assert_eq!(got.map(|c| c[lane].to_bits()), want, "{} {blend:?}", s[lane]);
                    }
                }
            }
        }
    }
}
