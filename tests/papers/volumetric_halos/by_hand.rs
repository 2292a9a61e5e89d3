//! A picture with halos beside the same picture from the formulas of the paper, sample by sample, on a field that the
//! renderer reproduces exactly ([HALO-1] … [HALO-8]).

use crate::common::{Stage, quadratic_ball};
use drypoint::scene::picture::LayerKind;
use drypoint::scene::tables::{
    Exponents, GradientEstimator, Halo, HaloAccumulation, HaloKind, HaloSource, Kernel, Length, ProfileNode,
    SeedDirection, SeedValue,
};

/// Voxels along each side of the field, and R.
const N: usize = 16;
const R: f64 = 6.0;
/// The picture.
const SIZE: [usize; 2] = [28, 20];
/// World units between pixels.
const PIXEL: f64 = 0.5;
/// Δ and Δ₀.
const STEP: f64 = 0.75;

fn stage(halos: &[Halo]) -> Stage {
    let nodes = [(-1.0, [0.9, 0.4, 0.1], 0.0), (0.0, [0.8, 0.5, 0.3], 0.3), (2.0, [0.1, 0.2, 0.9], 0.6)];
    Stage::regular(quadratic_ball(N, R), &nodes).with(|s| {
        s.picture.size = SIZE;
        s.camera = crate::common::orthographic(Some(PIXEL * SIZE[1] as f64));
        s.camera.direction = [0.0, 1.0, 0.0].into();
        s.sampling.step = Length::World(STEP);
        s.sampling.reference_length = Length::World(1.0);
        s.sampling.kernel = Kernel::Bspline;
        s.sampling.gradient = GradientEstimator::Analytic;
        s.halos = halos.to_vec();
    })
}

fn halo(kind: HaloKind, every: u64, accumulate: HaloAccumulation) -> Halo {
    let node = |at, rgb, opacity| ProfileNode { at, rgb, opacity };
    let mut halo = Halo {
        kind,
        every,
        accumulate,
        exponents: Exponents::Numbers([0.5, 3.0]),
        profile: vec![node(0.0, [1.0, 0.0, 0.2], 0.1), node(0.5, [0.0, 0.5, 1.0], 0.9)],
        opacity: 0.8,
        floor: 0.01,
        ..Halo::default()
    };
    halo.seed.value = Some(SeedValue::Nodes(vec![[-1.5, 0.0], [-0.5, 1.0], [1.5, 0.5]]));
    halo.spread.passes = 2;
    halo.spread.delta = 0.9;
    halo
}

/// The piecewise-linear function through points, constant beyond.
fn piecewise(points: &[[f64; 2]], x: f64) -> f64 {
    match points.iter().position(|p| x < p[0]) {
        None => points[points.len() - 1][1],
        Some(0) => points[0][1],
        Some(i) => {
            let ([x0, y0], [x1, y1]) = (points[i - 1], points[i]);
            y0 + (x - x0) / (x1 - x0) * (y1 - y0)
        }
    }
}

/// An image with zeros around it.
struct Image {
    size: [i64; 2],
    pixels: Vec<f64>,
}

impl Image {
    fn new(size: [i64; 2]) -> Self {
        Self { size, pixels: vec![0.0; (size[0] * size[1]) as usize] }
    }

    fn at(&self, x: i64, y: i64) -> f64 {
        let inside = (0..self.size[0]).contains(&x) && (0..self.size[1]).contains(&y);
        if inside { self.pixels[(y * self.size[0] + x) as usize] } else { 0.0 }
    }

    fn of(size: [i64; 2], f: impl Fn(i64, i64) -> f64) -> Self {
        let pixels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| [x, y])).map(|[x, y]| f(x, y)).collect();
        Self { size, pixels }
    }
}

/// H of a seed image by the printed formulas.
fn spread(seeds: &Image, halo: &Halo) -> Image {
    let size = seeds.size;
    let h0 = match halo.spread.from {
        HaloSource::Seeds => Image::of(size, |x, y| seeds.at(x, y)),
        HaloSource::Gradient => Image::of(size, |x, y| {
            let dx = (seeds.at(x + 1, y) - seeds.at(x - 1, y)) / 2.0;
            let dy = (seeds.at(x, y + 1) - seeds.at(x, y - 1)) / 2.0;
            (dx * dx + dy * dy).sqrt().min(1.0)
        }),
    };
    let (n, delta) = (halo.spread.passes as u32, halo.spread.delta);
    let mut h = Image::of(size, |x, y| h0.at(x, y));
    for i in 1..=n {
        let k = 1i64 << (n - i);
        h = Image::of(size, |x, y| {
            let w = |u: i64, v: i64| ((2 - u.abs()) * (2 - v.abs())) as f64 / 16.0;
            let taps = (-1..=1).flat_map(|v| (-1..=1).map(move |u| (u, v)));
            let f: f64 = taps.map(|(u, v)| w(u, v) * h.at(x + k * u, y + k * v)).sum();
            delta * f + (1.0 - delta * f) * h0.at(x, y)
        });
    }
    Image::of(size, |x, y| if h.at(x, y) < halo.floor { 0.0 } else { h.at(x, y) })
}

/// Colour and opacity of a halo's profile.
fn profile(halo: &Halo, h: f64) -> ([f64; 3], f64) {
    if h == 0.0 {
        return ([0.0; 3], 0.0);
    }
    let of = |f: &dyn Fn(&ProfileNode) -> f64| {
        piecewise(&halo.profile.iter().map(|node| [node.at, f(node)]).collect::<Vec<_>>(), h)
    };
    (std::array::from_fn(|c| of(&|node| node.rgb[c])), halo.opacity * of(&|node| node.opacity))
}

/// The premultiplied picture, and the largest H of each halo, by the formulas.
fn by_hand(stage: &Stage) -> (Vec<[f64; 4]>, Vec<Vec<f64>>) {
    let halos = &stage.scene.halos;
    // Wide enough for any reach.
    let band = 8i64;
    let size = [SIZE[0] as i64 + 2 * band, SIZE[1] as i64 + 2 * band];
    let centre = (N - 1) as f64 / 2.0;
    let pixels = SIZE[0] * SIZE[1];
    let (mut rgba, mut largest) = (vec![[0.0f64; 4]; pixels], vec![vec![0.0f64; pixels]; halos.len()]);
    let images = || halos.iter().map(|_| Image::new(size)).collect::<Vec<_>>();
    let (mut seeds, mut field, mut occlusion) = (images(), images(), images());
    let alpha_u = |f: f64| piecewise(&[[-1.0, 0.0], [0.0, 0.3], [2.0, 0.6]], f);
    let rgb_at = |f: f64| -> [f64; 3] {
        let nodes = [(-1.0, [0.9, 0.4, 0.1]), (0.0, [0.8, 0.5, 0.3]), (2.0, [0.1, 0.2, 0.9])];
        std::array::from_fn(|c| piecewise(&nodes.map(|(at, rgb)| [at, rgb[c]]), f))
    };
    for k in -40i64..40 {
        let depth = (k as f64 + 0.5) * STEP;
        for y in 0..size[1] {
            for x in 0..size[0] {
                // The sample, from the centre of the ball: right, towards the viewer's far side, up.
                let [i, j] = [x - band, y - band];
                let right = (i as f64 + 0.5 - SIZE[0] as f64 / 2.0) * PIXEL;
                let up = (SIZE[1] as f64 / 2.0 - (j as f64 + 0.5)) * PIXEL;
                let has_sample = [right, depth, up].iter().all(|c| c.abs() <= centre);
                let square = right * right + depth * depth + up * up;
                let f = (R * R - square) / (2.0 * R);
                let inside = (0..SIZE[0] as i64).contains(&i) && (0..SIZE[1] as i64).contains(&j);
                if inside {
                    let pixel = &mut rgba[j as usize * SIZE[0] + i as usize];
                    let mix = |rgb: [f64; 3], acts: &dyn Fn(&Halo) -> bool| {
                        let mut rgb = rgb;
                        for (halo, o) in halos.iter().zip(&occlusion).rev() {
                            if halo.kind == HaloKind::Occlusive && acts(halo) {
                                let (c, m) = profile(halo, o.at(x, y));
                                rgb = std::array::from_fn(|i| (1.0 - m) * rgb[i] + m * c[i]);
                            }
                        }
                        rgb
                    };
                    let mut over = |rgb: [f64; 3], alpha: f64| {
                        let w = (1.0 - pixel[3]) * (1.0 - (1.0 - alpha).powf(STEP));
                        (0..3).for_each(|c| pixel[c] += w * rgb[c]);
                        pixel[3] += w;
                    };
                    if has_sample && alpha_u(f) > 0.0 {
                        over(mix(rgb_at(f), &|_| true), alpha_u(f));
                    }
                    for (n, (halo, h)) in halos.iter().zip(&field).enumerate() {
                        let at = j as usize * SIZE[0] + i as usize;
                        largest[n][at] = largest[n][at].max(h.at(x, y));
                        if halo.kind == HaloKind::Emissive {
                            let (c, alpha) = profile(halo, h.at(x, y));
                            over(mix(c, &|by: &Halo| by.tints.contains(&halo.name)), alpha);
                        }
                    }
                }
                if has_sample {
                    for (halo, seeds) in halos.iter().zip(&mut seeds) {
                        let Some(SeedValue::Nodes(nodes)) = &halo.seed.value else { unreachable!() };
                        let distance = square.sqrt();
                        let h_d = halo.seed.direction.map_or(1.0, |d: SeedDirection| {
                            let theta = right.atan2(up).to_degrees();
                            let apart = (theta - d.toward).rem_euclid(360.0);
                            let t = ((apart.min(360.0 - apart) - d.width / 2.0) / d.softness).clamp(0.0, 1.0);
                            1.0 - t * t * (3.0 - 2.0 * t)
                        });
                        let [a, b] = halo.exponents.numbers();
                        let side = (1.0 - (depth / distance).abs()).powf(b);
                        let s = (piecewise(nodes, f) * h_d * (distance / R).min(1.0).powf(a) * side).clamp(0.0, 1.0);
                        let s = if s < halo.floor { 0.0 } else { s };
                        let pixel = &mut seeds.pixels[(y * size[0] + x) as usize];
                        *pixel = match halo.accumulate {
                            HaloAccumulation::Max => pixel.max(s),
                            HaloAccumulation::Mean => *pixel + s / halo.every as f64,
                        };
                    }
                }
            }
        }
        for (n, halo) in halos.iter().enumerate() {
            if (k + 1).rem_euclid(halo.every as i64) == 0 {
                field[n] = spread(&seeds[n], halo);
                seeds[n] = Image::new(size);
                for (o, h) in occlusion[n].pixels.iter_mut().zip(&field[n].pixels) {
                    *o = o.max(*h);
                }
            }
        }
    }
    (rgba, largest)
}

/// Compares pictures and the layers of all halos.
fn compare(what: &str, halos: &[Halo]) {
    let layers: Vec<LayerKind> = (0..halos.len()).map(LayerKind::Halo).collect();
    let stage = stage(halos).layers(&layers);
    let (shown, (rgba, largest)) = (stage.render(), by_hand(&stage));
    let worst = |pairs: &mut dyn Iterator<Item = (f64, f64)>| pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let pixels = shown.pixels();
    let apart = worst(&mut pixels.iter().flatten().copied().zip(rgba.iter().flatten().copied()));
    assert!(apart < 1e-11, "{what}: {apart}");
    for (n, largest) in largest.iter().enumerate() {
        let apart = worst(&mut shown.one(LayerKind::Halo(n)).into_iter().zip(largest.iter().copied()));
        assert!(apart < 1e-11, "{what}: halo {n}: {apart}");
        assert!(largest.iter().any(|h| *h > 0.05), "{what}: halo {n} is nowhere");
    }
}

#[test]
fn one_halo_of_each_kind() {
    for kind in [HaloKind::Emissive, HaloKind::Occlusive] {
        for accumulate in [HaloAccumulation::Max, HaloAccumulation::Mean] {
            for every in [1, 2, 3, 5] {
                compare(&format!("{kind:?} {accumulate:?} {every}"), &[halo(kind, every, accumulate)]);
            }
        }
    }
}

#[test]
fn seeds_as_they_are_from_one_side() {
    let mut one_sided = halo(HaloKind::Emissive, 1, HaloAccumulation::Max);
    one_sided.spread.from = HaloSource::Seeds;
    one_sided.seed.direction = Some(SeedDirection { toward: 130.0, width: 60.0, softness: 50.0 });
    compare("one-sided", &[one_sided]);
}

/// Several halos with groups of different sizes; one tints the glow of another.
#[test]
fn several_halos() {
    let named = |name: &str, halo: Halo| Halo { name: name.into(), ..halo };
    let mut glow = named("glow", halo(HaloKind::Emissive, 3, HaloAccumulation::Mean));
    glow.seed.value = Some(SeedValue::Nodes(vec![[0.5, 0.0], [1.0, 1.0]]));
    let shade = halo(HaloKind::Occlusive, 2, HaloAccumulation::Max);
    let shade = named("shade", Halo { tints: vec!["glow".into()], ..shade });
    let rim = named("rim", halo(HaloKind::Emissive, 1, HaloAccumulation::Max));
    let second = named("second", Halo { opacity: 0.3, ..halo(HaloKind::Occlusive, 1, HaloAccumulation::Mean) });
    compare("several", &[glow, shade, rim, second]);
}
