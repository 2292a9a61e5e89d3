//! The process against the formulas of the paper, by hand and by their laws.

use super::*;
use proptest::prelude::*;

/// Parameters without median and floor.
fn spread(from_gradient: bool, passes: u32, delta: f64, stretch: f64) -> SpreadParams {
    SpreadParams { from_gradient, passes, delta, stretch, median: false, floor: 0.0 }
}

/// H of a stage for given seeds.
fn made(size: [usize; 2], s: &[f64], params: SpreadParams, border: Border, process: Process) -> Vec<f64> {
    let mut field = HaloField::with_border(size, params, border);
    field.seeds_mut().copy_from_slice(s);
    let any = field.generate_as(process);
    assert_eq!(any, field.intensities().iter().any(|h| *h != 0.0));
    assert!(field.seeds_mut().iter().all(|s| *s == 0.0));
    field.intensities().to_vec()
}

/// A pixel anywhere, by the border.
fn read(size: [usize; 2], image: &[f64], border: Border, x: i64, y: i64) -> f64 {
    let nearest = [x.clamp(0, size[0] as i64 - 1), y.clamp(0, size[1] as i64 - 1)];
    if border == Border::Zero && nearest != [x, y] {
        return 0.0;
    }
    image[nearest[1] as usize * size[0] + nearest[0] as usize]
}

/// An image at a distance (u, v) of a pixel, between pixels bilinear.
fn tap(size: [usize; 2], image: &[f64], border: Border, [x, y]: [i64; 2], [u, v]: [f64; 2]) -> f64 {
    let at = |di: i64, dj: i64| read(size, image, border, x + u.floor() as i64 + di, y + v.floor() as i64 + dj);
    let [a, b] = [u - u.floor(), v - v.floor()];
    (1.0 - b) * ((1.0 - a) * at(0, 0) + a * at(1, 0)) + b * ((1.0 - a) * at(0, 1) + a * at(1, 1))
}

/// The formulas as they are printed, pixel by pixel, with nine taps.
fn formula(size: [usize; 2], s: &[f64], params: SpreadParams, border: Border, process: Process) -> Vec<f64> {
    let pixels = || (0..size[0] * size[1]).map(|t| [(t % size[0]) as i64, (t / size[0]) as i64]);
    let mut s = s.to_vec();
    if params.median {
        s = pixels()
            .map(|[x, y]| {
                let mut nine: Vec<f64> = (0..9).map(|k| read(size, &s, border, x + k % 3 - 1, y + k / 3 - 1)).collect();
                nine.sort_by(f64::total_cmp);
                nine[4]
            })
            .collect();
    }
    let q = params.stretch;
    let difference =
        |p, [u, v]: [f64; 2]| (tap(size, &s, border, p, [u, v]) - tap(size, &s, border, p, [-u, -v])) / 2.0;
    let gradient = |p| difference(p, [q, 0.0]).powi(2) + difference(p, [0.0, q]).powi(2);
    let h0: Vec<f64> = if params.from_gradient { pixels().map(|p| gradient(p).sqrt()).collect() } else { s.clone() };
    let mut h = h0.clone();
    let passes = if process == Process::Source { 0 } else { params.passes };
    for i in 1..=passes {
        let k = q * f64::from(1 << (passes - i));
        let f: Vec<f64> = pixels()
            .map(|p| {
                let taps = (0..9).map(|t| [t % 3 - 1, t / 3 - 1]);
                let weighted = |[u, v]: [i32; 2]| {
                    let w = f64::from((2 - u.abs()) * (2 - v.abs())) / 16.0;
                    w * tap(size, &h, border, p, [u, v].map(|t| k * f64::from(t)))
                };
                taps.map(weighted).sum()
            })
            .collect();
        h = match process {
            Process::LowPass => f,
            _ => f.iter().zip(&h0).map(|(f, h0)| params.delta * f + (1.0 - params.delta * f) * h0).collect(),
        };
    }
    h.into_iter().map(|h| if h < params.floor { 0.0 } else { h }).collect()
}

/// Numbers in [0, 1) without an order.
fn noise(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// An image with a share of pixels that are not zero.
fn image(size: [usize; 2], share: f64, seed: u64) -> Vec<f64> {
    let mut next = noise(seed);
    (0..size[0] * size[1]).map(|_| if next() < share { next() } else { 0.0 }).collect()
}

/// A square of ones in the middle of zeros, and the index of the first pixel outside it on its axis.
fn square(side: usize) -> ([usize; 2], Vec<f64>, usize) {
    let (n, begin) = (side + 90, 45);
    let inside = |t: usize| (begin..begin + side).contains(&t);
    let s = (0..n * n).map(|t| f64::from(u8::from(inside(t % n) && inside(t / n)))).collect();
    ([n, n], s, (begin + side / 2) * n + begin + side)
}

/// H in the first pixel outside a square, to four digits ([HALO-10]).
#[test]
fn a_dot_has_over_four_fifths_of_the_halo_of_a_large_square() {
    let halo = |side: usize, from_gradient: bool, delta: f64, process: Process| {
        let (size, s, outside) = square(side);
        made(size, &s, spread(from_gradient, 4, delta, 1.0), Border::Zero, process)[outside]
    };
    for (delta, dot, large) in
        [(0.70, 0.5789, 0.6700), (0.80, 0.5928, 0.7025), (0.90, 0.6074, 0.7376), (0.95, 0.6150, 0.7562)]
    {
        for (side, expected) in [(1, dot), (32, large)] {
            let h = halo(side, true, delta, Process::Spread);
            assert!((h - expected).abs() <= 5e-5, "δ = {delta}, {side} px: {h}");
        }
    }
    // Shares that a dot keeps of the large square's halo for δ = 0.9, in Fig. 3 (e), (c) and (b).
    for (from_gradient, process, expected) in
        [(true, Process::LowPass, 0.116), (false, Process::Spread, 0.231), (false, Process::LowPass, 0.008)]
    {
        let share = halo(1, from_gradient, 0.9, process) / halo(32, from_gradient, 0.9, process);
        assert!((share - expected).abs() <= 5e-4, "{from_gradient} {process:?}: {share}");
    }
}

/// N = 1, one seed of 1: F is w around it, so that H is 1 in the middle, δ·2/16 beside it, δ/16 at a corner.
#[test]
fn one_seed_and_one_pass_by_hand() {
    let mut s = vec![0.0; 25];
    s[12] = 1.0;
    for delta in [0.25, 0.8, 1.0] {
        let h = made([5, 5], &s, spread(false, 1, delta, 1.0), Border::Zero, Process::Spread);
        let (edge, corner) = (delta / 8.0, delta / 16.0);
        let rows = [[0.0; 5], [0.0, corner, edge, corner, 0.0], [0.0, edge, 1.0, edge, 0.0]];
        assert_eq!(h, [rows[0], rows[1], rows[2], rows[1], rows[0]].concat());
    }
    // Taps at 1.5: a half of the weight falls on each of the pixels at 1 and 2.
    let mut s = vec![0.0; 7];
    s[3] = 1.0;
    let h = made([7, 1], &s, spread(false, 1, 1.0, 1.5), Border::Replicate, Process::LowPass);
    assert_eq!(h, [0.0, 0.125, 0.125, 0.5, 0.125, 0.125, 0.0]);
}

/// A ramp of 1/8 a pixel has that gradient, and √2 of it along the diagonal; a step of one a half on both sides.
#[test]
fn gradients_by_hand() {
    let of = |s: &[f64], size, q| made(size, s, spread(true, 0, 0.8, q), Border::Replicate, Process::Spread);
    let ramp: Vec<f64> = (0..8).map(|x| f64::from(x) / 8.0).collect();
    assert_eq!(of(&ramp, [8, 1], 1.0)[1..7], [0.125; 6]);
    assert_eq!(of(&ramp, [1, 8], 2.0)[2..6], [0.25; 4]);
    let diagonal: Vec<f64> = (0..16).map(|t| f64::from(t % 4 + t / 4) / 8.0).collect();
    assert_eq!(of(&diagonal, [4, 4], 1.0)[5], (2.0f64 / 64.0).sqrt());
    let step = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0];
    assert_eq!(of(&step, [6, 1], 1.0), [0.0, 0.0, 0.5, 0.5, 0.0, 0.0]);
    // Taps at 1.5 see the step from four pixels: from two of them half of it.
    assert_eq!(of(&step, [6, 1], 1.5), [0.0, 0.25, 0.5, 0.5, 0.25, 0.0]);
}

#[test]
fn separable_passes_are_the_nine_taps() {
    let mut case = 0;
    for size in [[1, 1], [2, 7], [23, 17], [64, 40], [5, 90]] {
        for (passes, stretch) in (0..=5).flat_map(|n| [1.0, 1.5, 3.7].map(|q| (n, q))) {
            for (border, process) in [Border::Zero, Border::Replicate]
                .into_iter()
                .flat_map(|border| [Process::Spread, Process::LowPass].map(|process| (border, process)))
            {
                case += 1;
                let s = image(size, [0.003, 0.05, 1.0][case % 3], case as u64);
                let params = SpreadParams {
                    from_gradient: case % 2 == 0,
                    passes,
                    delta: [0.0, 0.3, 0.8, 1.0][case / 3 % 4],
                    stretch,
                    median: case % 5 == 0,
                    floor: 0.0,
                };
                let expected = formula(size, &s, params, border, process);
                let h = made(size, &s, params, border, process);
                let most = h.iter().zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(most <= 1e-15, "{size:?} {params:?} {border:?} {process:?}: {most:e}");
            }
        }
    }
}

/// A field that is used again and again holds nothing of the images before.
#[test]
fn nothing_is_left_of_earlier_images() {
    let size = [90, 70];
    for (median, from_gradient) in [(false, true), (true, true), (false, false), (true, false)] {
        let params = SpreadParams { median, floor: 1.0 / 255.0, ..spread(from_gradient, 3, 0.8, 1.0) };
        let mut field = HaloField::new(size, params);
        for (share, seed) in [(1.0, 1), (0.001, 2), (0.0, 3), (0.0005, 4), (0.2, 5), (0.001, 6)] {
            let s = image(size, share, seed);
            field.seeds_mut().copy_from_slice(&s);
            field.generate();
            assert_eq!(field.intensities(), made(size, &s, params, Border::Zero, Process::Spread), "{seed}");
            for y in 0..size[1] {
                let (row, range) = (&field.intensities()[y * size[0]..][..size[0]], field.intensity_range(y));
                assert!(row.iter().enumerate().all(|(x, h)| *h == 0.0 || range.contains(&x)));
            }
        }
        assert!(!field.generate(), "no seed since");
        assert!(field.intensities().iter().all(|h| *h == 0.0));
    }
}

/// What the guard band is for: H at a pixel has the same bits wherever the image begins.
#[test]
fn a_crop_has_the_bits_of_the_whole() {
    let size = [300, 260];
    for (median, from_gradient, stretch, passes) in [(false, true, 1.0, 4), (true, true, 1.5, 3), (true, false, 3.7, 2)]
    {
        let params = SpreadParams { median, floor: 1.0 / 255.0, ..spread(from_gradient, passes, 0.8, stretch) };
        let guard = params.guard();
        // Seeds everywhere, and seeds here and there.
        for share in [1.0, 0.01] {
            let s = image(size, share, 7);
            let whole = made(size, &s, params, Border::Zero, Process::Spread);
            for [left, top, w, h] in [[guard + 3, guard, 40, 30], [guard, guard, 9, 61], [100, 70, 101, 95]] {
                let crop = [w + 2 * guard, h + 2 * guard];
                let at = |x: usize, y: usize| s[(top - guard + y) * size[0] + left - guard + x];
                let seeds: Vec<f64> = (0..crop[0] * crop[1]).map(|t| at(t % crop[0], t / crop[0])).collect();
                let part = made(crop, &seeds, params, Border::Zero, Process::Spread);
                for (x, y) in (0..w * h).map(|t| (t % w, t / w)) {
                    let [a, b] = [part[(y + guard) * crop[0] + x + guard], whole[(top + y) * size[0] + left + x]];
                    assert_eq!(a.to_bits(), b.to_bits(), "({x}, {y}) of {w} × {h}");
                }
            }
        }
    }
}

/// The guard band has no pixel too few: a seed at its edge is seen by the median, one before the edge by the gradient.
#[test]
fn guard_bands_by_hand() {
    assert_eq!(spread(true, 4, 0.8, 1.0).guard(), 17);
    assert_eq!(SpreadParams { median: true, ..spread(true, 4, 0.8, 1.0) }.guard(), 18);
    // 6 + 3 + 2 of the passes, 2 of the gradient, 1.
    assert_eq!(spread(true, 3, 0.8, 1.5).guard(), 14);
    assert_eq!(spread(true, 0, 0.8, 1.0).guard(), 2);
    assert_eq!(spread(true, 500, 0.8, 1.0).guard(), usize::MAX);
    for (passes, stretch) in (0..=4).flat_map(|n| [1.0, 1.5, 3.7].map(|q| (n, q))) {
        let params = spread(true, passes, 1.0, stretch);
        let n = 2 * params.guard() + 1;
        let mut s = vec![0.0; n * n];
        s[n / 2 * n + n / 2] = 1.0;
        let h = made([n, n], &s, params, Border::Zero, Process::Spread);
        let farthest = (0..n).filter(|x| h[n / 2 * n + x] != 0.0).map(|x| x.abs_diff(n / 2)).max().unwrap();
        assert_eq!(farthest + 1, params.guard(), "{params:?}");
    }
}

#[test]
fn limits() {
    let size = [20, 12];
    let s = image(size, 0.1, 1);
    // δ = 0 and N = 0 leave H₀ as it is.
    for params in [spread(false, 4, 0.0, 1.0), spread(false, 0, 0.8, 1.0)] {
        assert_eq!(made(size, &s, params, Border::Zero, Process::Spread), s);
    }
    let h0 = made(size, &s, spread(true, 0, 0.8, 1.0), Border::Zero, Process::Spread);
    assert_eq!(made(size, &s, spread(true, 4, 0.0, 1.0), Border::Zero, Process::Spread), h0);
    // No seeds, no halo, and no pass.
    let mut field = HaloField::new(size, spread(true, 4, 1.0, 1.0));
    field.seeds_mut();
    assert!(!field.generate() && field.passes_done() == 0);
    // Ones everywhere have no gradient; with a zero border the frame is an edge.
    let ones = vec![1.0; 240];
    let params = spread(true, 4, 0.8, 1.0);
    assert_eq!(made(size, &ones, params, Border::Replicate, Process::Spread), [0.0; 240]);
    assert!(made(size, &ones, params, Border::Zero, Process::Spread)[0] > 0.5);
    assert_eq!(made(size, &ones, spread(false, 4, 1.0, 1.0), Border::Replicate, Process::LowPass), ones);
    // Images without pixels, and distances beyond all images.
    for size in [[0, 0], [0, 3], [3, 0]] {
        assert!(made(size, &[], params, Border::Zero, Process::Spread).is_empty());
    }
    for passes in [60, 70, u32::from(u16::MAX)] {
        let h = made(size, &s, spread(true, passes, 1.0, 1e300), Border::Replicate, Process::Spread);
        assert!(h.iter().all(|h| (0.0..=1.0).contains(h)));
    }
}

/// Values below the floor are 0 in H, and not in H₀: with N = 1 a tap of 0.01 still gives its share.
#[test]
fn the_floor_is_for_new_intensities() {
    let s = [0.0, 0.0, 0.5, 0.01, 0.0];
    let params = SpreadParams { floor: 0.04, ..spread(false, 1, 1.0, 1.0) };
    // In one row with a zero border F is [1 2 1]/8: 0.5/8 = 0.0625 beside the seed, 0.01/8 beyond.
    let h = made([5, 1], &s, params, Border::Zero, Process::Spread);
    let f = [0.0, 0.5 / 8.0, (1.0 + 0.01) / 8.0, (0.5 + 0.02) / 8.0, 0.01 / 8.0];
    for (x, h) in h.iter().enumerate() {
        let expected = if x == 4 { 0.0 } else { f[x] + (1.0 - f[x]) * s[x] };
        assert!((h - expected).abs() < 1e-16, "{x}: {h}");
    }
    assert_eq!(made([5, 1], &s, SpreadParams { passes: 0, ..params }, Border::Zero, Process::Spread)[3], 0.0);
}

#[test]
fn counts_and_bytes() {
    let mut field = HaloField::new([40, 30], SpreadParams { median: true, ..spread(true, 4, 0.8, 1.0) });
    field.seeds_mut()[45] = 1.0;
    field.seeds_mut()[46] = 1.0;
    field.generate();
    assert_eq!(field.passes_done(), 6);
    assert_eq!(field.bytes(), 4 * (40 * 30 * 8 + 30 * 16) + 40 * 8);
    assert_eq!(HaloField::bytes_of([usize::MAX; 2]), u64::MAX);
}

/// One thread and several give the same bits, in images so large that they share the work.
#[test]
fn threads_change_no_bit() {
    let size = [301, 299];
    let s = image(size, 1.0, 3);
    let params = SpreadParams { median: true, ..spread(true, 4, 0.8, 1.5) };
    let [one, three] = [1, 3].map(|n| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build().unwrap();
        pool.install(|| made(size, &s, params, Border::Zero, Process::Spread))
    });
    assert_eq!(one, three);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// H is a convex mix of δF and 1 by H₀: in [0, 1] to the bit, and it grows with H₀ and with δ.
    #[test]
    fn intensities_are_shares_and_grow_with_seeds_and_delta(
        width in 1usize..40,
        height in 1usize..40,
        share in 0.0..1.0f64,
        seed: u64,
        passes in 0u32..6,
        deltas in prop::array::uniform2(0.0..=1.0f64),
        stretch in 1.0..4.0f64,
        gains in 0.0..1.0f64,
        replicate: bool,
    ) {
        let (size, border) = ([width, height], if replicate { Border::Replicate } else { Border::Zero });
        let s = image(size, share, seed);
        let [less, more] = if deltas[0] < deltas[1] { deltas } else { [deltas[1], deltas[0]] };
        let of = |s: &[f64], from_gradient, delta| {
            made(size, s, spread(from_gradient, passes, delta, stretch), border, Process::Spread)
        };
        let ones: Vec<f64> = s.iter().map(|s| f64::from(u8::from(*s > 0.0))).collect();
        for h in [of(&s, true, 1.0), of(&ones, true, 1.0), of(&ones, false, 1.0)] {
            prop_assert!(h.iter().all(|h| (0.0..=1.0).contains(h)));
        }
        let mut next = noise(seed ^ 5);
        let grown: Vec<f64> = s.iter().map(|s| s + (1.0 - s) * gains * next()).collect();
        let middle = of(&s, false, less);
        for (larger, smaller) in [(of(&grown, false, less), &middle), (of(&s, false, more), &middle)] {
            prop_assert!(larger.iter().zip(smaller).all(|(a, b)| *a >= b - 1e-15));
        }
        let [a, b] = [of(&s, true, more), of(&s, true, less)];
        prop_assert!(a.iter().zip(&b).all(|(a, b)| *a >= b - 1e-15));
    }
}

/// Milliseconds of a generation, by hand: `cargo test --release -p drypoint-reference halo_field -- --ignored --nocapture`.
#[test]
#[ignore = "prints times and asserts nothing"]
fn milliseconds() {
    let size = [546, 546];
    let ring = |t: usize, middle: f64| {
        let [x, y] = [(t % 546) as f64 - middle, (t / 546) as f64 - middle];
        f64::from(u8::from(((x * x + y * y).sqrt() - 30.0).abs() < 1.5))
    };
    let empty = vec![0.0; 546 * 546];
    let one: Vec<f64> = (0..546 * 546).map(|t| ring(t, 273.0)).collect();
    let ends: Vec<f64> = (0..546 * 546).map(|t| ring(t, 60.0) + ring(t, 480.0)).collect();
    let full = image(size, 1.0, 1);
    for (name, s) in [("empty", empty), ("ring", one), ("two rings", ends), ("full", full)] {
        for (median, q) in [(false, 1.0), (true, 1.0), (false, 1.5)] {
            let params = SpreadParams { median, ..spread(true, 4, 0.8, q) };
            let mut field = HaloField::new(size, SpreadParams { floor: 1.0 / 255.0, ..params });
            let mut times: Vec<f64> = (0..101)
                .map(|_| {
                    field.seeds_mut().copy_from_slice(&s);
                    let begin = std::time::Instant::now();
                    field.generate();
                    begin.elapsed().as_secs_f64() * 1e3
                })
                .collect();
            times.sort_by(f64::total_cmp);
            println!("{name}, q = {q}, median {median}: {:.3} ms, least {:.3} ms", times[50], times[0]);
        }
    }
}
