//! What one sample passes through, for eight of them side by side, to the same bits.

use super::{Contour, SphereMap, Spheres, StyleIndex};
use crate::field::lanes::{LANES, whole};
use crate::number::lanes::columns;
use crate::number::{Arithmetic, Vec3, lanes};
use crate::transfer::lanes::NodePlaces;
use drypoint_scene::shot::Turn;
use drypoint_scene::tables::{Mix, Transparency};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8, f64x4, f64x8, mask64x8};

/// [`Real::clamp_01`](crate::number::Real::clamp_01).
#[inline(always)]
pub(crate) fn clamp_01<S: Simd>(x: f64x8<S>) -> f64x8<S> {
    let (zero, one) = (f64x8::splat(x.simd, 0.0), f64x8::splat(x.simd, 1.0));
    let x = x.simd_lt(0.0).select(zero, x);
    x.simd_gt(1.0).select(one, x)
}

/// [`curvature_along_ray::kappa`](super::curvature_along_ray::kappa) in the lanes that have `both` normals, 0 in the others.
#[inline(always)]
pub(crate) fn kappa<S: Simd>(
    turn: Turn,
    n: Vec3<f64x8<S>>,
    before: Vec3<f64x8<S>>,
    both: u64,
    delta_ray: f64x8<S>,
) -> f64x8<S> {
    let zero = f64x8::splat(delta_ray.simd, 0.0);
    if both == 0 {
        return zero;
    }
    let cosine = n.dot(before);
    let cosine = match turn {
        Turn::OfNormals => cosine,
        Turn::OfLines => cosine.abs(),
    };
    let sine = n.cross(before).length();
    mask64x8::from_bitmask(zero.simd, both).select(lanes::angle(sine, cosine) / delta_ray, zero)
}

impl Contour<f64> {
    /// [`tau`](Self::tau).
    #[inline(always)]
    pub(crate) fn tau_lanes<S: Simd>(&self, kappa: f64x8<S>, g: f64x8<S>) -> f64x8<S> {
        let simd = kappa.simd;
        let (zero, one) = (f64x8::splat(simd, 0.0), f64x8::splat(simd, 1.0));
        let tau = match self.threshold {
            Some(threshold) => f64x8::splat(simd, threshold),
            None => {
                let t_kappa = kappa.abs() * self.thickness;
                let x = t_kappa.simd_gt(0.0).select(t_kappa, zero);
                let x = x.simd_gt(1.0).select(one, x);
                SimdFloat::sqrt(x * (one + one - x))
            }
        };
        let Some([lo, hi]) = self.fade else { return tau };
        if lo == hi {
            return tau * g.simd_lt(lo).select(zero, one);
        }
        let t = clamp_01((g - lo) / (hi - lo));
        tau * (t * t * (one + one + one - (t + t)))
    }
}

/// [`contour::push`](super::contour::push) in the lanes `on`.
#[inline(always)]
pub(crate) fn push<S: Simd>([x, y]: [f64x8<S>; 2], d: f64x8<S>, tau: f64x8<S>, on: mask64x8<S>) -> [f64x8<S>; 2] {
    let on = on & d.simd_le(tau) & tau.simd_ne(0.0);
    if on.all_false() {
        return [x, y];
    }
    let r = SimdFloat::sqrt(x * x + y * y);
    let on = on & r.simd_ne(0.0);
    let delta = d / tau;
    let scale = r.simd_lt(delta).select(delta, r);
    [on.select(x / scale, x), on.select(y / scale, y)]
}

/// [`transparency::share`](super::transparency::share) of the visible lanes.
#[inline(always)]
pub(crate) fn share<S: Simd>(
    transparency: Transparency,
    place: &NodePlaces<S>,
    n_dot_v: f64x8<S>,
    tau: f64x8<S>,
    g: f64x8<S>,
) -> f64x8<S> {
    let alpha_u = place.alpha_u;
    let between = place.visible & alpha_u.simd_ne(1.0).to_bitmask();
    if transparency == Transparency::Plain || between == 0 {
        return alpha_u;
    }
    let zero = f64x8::splat(alpha_u.simd, 0.0);
    let away = n_dot_v - tau;
    let away = away.simd_lt(0.0).select(zero, away);
    let exponent = away * (f64x8::splat(alpha_u.simd, 1.0) - g) + 0.5;
    let power = lanes::power(alpha_u, exponent, between);
    mask64x8::from_bitmask(alpha_u.simd, between).select(power, alpha_u)
}

/// The styles of each lane, as [`Blend`](super::Blend); w is that of the [`NodePlaces`] that they are made from.
pub(crate) struct Blends {
    /// j₀, or the one style that is shown.
    first: [u32; LANES],
    /// j₁.
    second: [u32; LANES],
    /// Lanes in which both have a share.
    mixed: u64,
}

impl Blends {
    /// How many style pictures a lookup of the lanes reads.
    #[inline(always)]
    pub(crate) fn lookups(&self, lanes: u64) -> u64 {
        u64::from(lanes.count_ones() + (lanes & self.mixed).count_ones())
    }
}

impl StyleIndex {
    /// [`blend`](Self::blend) of the visible lanes; of a function whose last node this is.
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

    /// Reads a style in each of some lanes, at one normal; in the others its first texel.
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
        // Without a branch for each lane, which nothing predicts.
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
    /// Bilinear in the cell whose first texel this is: x, then y.
    #[inline(always)]
    fn filtered<S: Simd>(&self, simd: S, start: usize, [wx, wy]: [f64; 2]) -> f64x4<S> {
        let (wx, wy) = (f64x4::splat(simd, wx), f64x4::splat(simd, wy));
        if self.side == 1 {
            // The cell has no second texel, and the weights are 0.
            return f64x4::simd_from(simd, self.texels[0].map(f64::from));
        }
        let row = |at: usize| f32x8::from_slice(simd, self.texels[at..][..2].as_flattened());
        let ((a, b), (c, d)) = (simd.widen_f32x8(row(start)), simd.widen_f32x8(row(start + self.side)));
        let (upper, lower) = (f64x4::lerp(a, b, wx), f64x4::lerp(c, d, wx));
        f64x4::lerp(upper, lower, wy)
    }
}

/// The cell of a coordinate and the place in it, as that of one normal.
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
    use super::super::{Blend, contour, curvature_along_ray, transparency};
    use super::*;
    use crate::transfer::Piecewise;
    use drypoint_scene::style::Style;
    use drypoint_scene::tables::Kappa;
    use fearless_simd::{Level, dispatch};

    /// Numbers in [0, 1), a sequence for each seed, with the ends among them.
    fn numbers(seed: u64) -> impl Iterator<Item = f64> {
        (0u64..).map(move |i| match i % 11 {
            0 if i % 3 == 0 => 0.0,
            5 if i % 2 == 0 => 1.0,
            _ => {
                (i * 2 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15 ^ seed.wrapping_mul(0xff51_afd7_ed55_8ccd)) as f64
                    / 2f64.powi(64)
            }
        })
    }

    fn column(numbers: &mut impl Iterator<Item = f64>) -> [f64; LANES] {
        std::array::from_fn(|_| numbers.next().unwrap())
    }

    fn same(got: [f64; LANES], want: impl Fn(usize) -> f64) {
        for (lane, got) in got.into_iter().enumerate() {
            assert_eq!(got.to_bits(), want(lane).to_bits(), "lane {lane}: {got} {}", want(lane));
        }
    }

    #[test]
    fn thresholds_and_pushes_are_those_of_one() {
        let level = Level::new();
        let [mut a, mut b, mut c, mut d] = [1, 2, 3, 4].map(numbers);
        let contours = [
            Contour::new(2.0, Kappa::Ray, None),
            Contour::new(0.7, Kappa::Ray, Some([0.2, 0.6])),
            Contour::new(0.7, Kappa::Ray, Some([0.5, 0.5])),
            Contour::new(0.0, Kappa::Ray, None),
            Contour::new(1.0, Kappa::None { threshold: 0.4 }, Some([0.0, 0.3])),
        ];
        for contour in contours.iter().cycle().take(2000) {
            let (kappa, g, d_v) = (column(&mut a).map(|k| 3.0 * k), column(&mut b), column(&mut c));
            let (x, y) = (column(&mut d), column(&mut a).map(|y| 0.5 - y));
            let (tau, [px, py]): ([f64; LANES], [[f64; LANES]; 2]) = dispatch!(level, simd => {
                let tau = contour.tau_lanes(kappa.simd_into(simd), g.simd_into(simd));
                let on = mask64x8::from_bitmask(simd, 0b1101_1111);
                let [px, py] = push([x.simd_into(simd), y.simd_into(simd)], d_v.simd_into(simd), tau, on);
                (tau.into(), [px.into(), py.into()])
            });
            same(tau, |lane| contour.tau(kappa[lane], g[lane]));
            let one = |lane: usize| match lane {
                5 => (x[lane], y[lane]),
                _ => contour::push(x[lane], y[lane], d_v[lane], tau[lane]),
            };
            same(px, |lane| one(lane).0);
            same(py, |lane| one(lane).1);
        }
    }

    #[test]
    fn curvatures_are_those_of_one() {
        let level = Level::new();
        let mut all: Vec<_> = (0..6).map(numbers).collect();
        for turn in [Turn::OfNormals, Turn::OfLines].into_iter().cycle().take(2000) {
            let mut unit = |i: usize| {
                let [mut x, mut y, mut z] = [0, 1, 2].map(|a| column(&mut all[i + a]).map(|c| c - 0.4));
                for lane in 0..LANES {
                    let scale = 1.0 / Vec3::new(x[lane], y[lane], z[lane]).length();
                    (x[lane], y[lane], z[lane]) = (x[lane] * scale, y[lane] * scale, z[lane] * scale);
                }
                [x, y, z]
            };
            let (n, before) = (unit(0), unit(3));
            let vector = |[x, y, z]: [[f64; LANES]; 3], lane: usize| Vec3::new(x[lane], y[lane], z[lane]);
            let got: [f64; LANES] = dispatch!(level, simd => {
                let [n, before] =
                    [n, before].map(|[x, y, z]| Vec3::new(x.simd_into(simd), y.simd_into(simd), z.simd_into(simd)));
                kappa(turn, n, before, 0b0111_1111, f64x8::splat(simd, 0.3)).into()
            });
            same(got, |lane| {
                let before = (lane < 7).then(|| vector(before, lane));
                curvature_along_ray::kappa(turn, vector(n, lane), before, 0.3)
            });
        }
    }

    #[test]
    fn opacities_are_those_of_one() {
        let level = Level::new();
        let ramp = Piecewise::<f64>::new(&[0.0, 1.0], &[0.0, 1.0]).unwrap();
        let [mut a, mut b, mut c, mut d] = [5, 6, 7, 8].map(numbers);
        for transparency in [Transparency::Illustrative, Transparency::Plain].into_iter().cycle().take(2000) {
            let (s, n_dot_v, tau, g) = (column(&mut a), column(&mut b), column(&mut c), column(&mut d));
            let got: Option<(u64, [f64; LANES])> = dispatch!(level, simd => {
                ramp.locate_lanes(s.simd_into(simd), mask64x8::from_bitmask(simd, 0b1111_0111)).map(|place| {
                    let share = share(
                        transparency, &place, n_dot_v.simd_into(simd), tau.simd_into(simd), g.simd_into(simd),
                    );
                    (place.visible, share.into())
                })
            });
            let (visible, got) = got.unwrap();
            for lane in (0..LANES).filter(|lane| visible >> lane & 1 == 1) {
                let want = transparency::share(transparency, s[lane], n_dot_v[lane], tau[lane], g[lane]);
                assert_eq!(got[lane].to_bits(), want.to_bits(), "{} {}", s[lane], got[lane]);
            }
        }
    }

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
