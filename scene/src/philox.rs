//! Philox4x32-10, the counter-based random numbers of [RAY-4].
//!
//! J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw: Parallel random numbers: as easy as 1, 2, 3. SC '11, 2011.
//! A number is a function of seed and counter alone. Threads, order and machine do not affect it.

/// The multipliers of the two S-boxes.
const MULTIPLIERS: [u32; 2] = [0xD251_1F53, 0xCD9E_8D57];
/// The constants added to the key after each round: the golden ratio and √3 − 1 as fractions of 2³².
const WEYL: [u32; 2] = [0x9E37_79B9, 0xBB67_AE85];

/// The four words of a counter under a key.
pub fn philox4x32_10(counter: [u32; 4], key: [u32; 2]) -> [u32; 4] {
    words(counter.map(|word| [word]), key).map(|[word]| word)
}

/// The words of counters side by side.
#[inline(always)]
fn words<const N: usize>(mut counter: [[u32; N]; 4], mut key: [u32; 2]) -> [[u32; N]; 4] {
    for _ in 0..10 {
        let [a, b, c, d] = counter;
        for l in 0..N {
            let (p, q) = (u64::from(MULTIPLIERS[0]) * u64::from(a[l]), u64::from(MULTIPLIERS[1]) * u64::from(c[l]));
            counter[0][l] = (q >> 32) as u32 ^ b[l] ^ key[0];
            counter[1][l] = q as u32;
            counter[2][l] = (p >> 32) as u32 ^ d[l] ^ key[1];
            counter[3][l] = p as u32;
        }
        key = [key[0].wrapping_add(WEYL[0]), key[1].wrapping_add(WEYL[1])];
    }
    counter
}

/// Four independent numbers in [0, 1) for draw `draw` at the cell (x, y, z) of a grid: u = (word >> 8) · 2⁻²⁴, exact
/// in f32 and f64 ([RAY-4]). The key is the seed, low word first.
pub fn uniforms(seed: u64, cell: [u32; 3], draw: u32) -> [f64; 4] {
    uniforms_of(seed, cell, [draw]).map(|[u]| u)
}

/// [`uniforms`] of several draws side by side. The numbers of all draws' first words come first.
#[inline(always)]
pub fn uniforms_of<const N: usize>(seed: u64, [x, y, z]: [u32; 3], draws: [u32; N]) -> [[f64; N]; 4] {
    let words = words([[x; N], [y; N], [z; N], draws], [seed as u32, (seed >> 32) as u32]);
    let mut uniforms = [[0.0; N]; 4];
    for (uniforms, words) in uniforms.iter_mut().zip(words) {
        for l in 0..N {
            // 24 bits have no sign: processors turn signed numbers into f64 at once.
            uniforms[l] = f64::from((words[l] >> 8) as i32) * (1.0 / 16_777_216.0);
        }
    }
    uniforms
}

/// The first of [`uniforms`].
pub fn uniform(seed: u64, cell: [u32; 3], draw: u32) -> f64 {
    uniforms(seed, cell, draw)[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_vectors_that_the_authors_publish() {
        // Random123, tests/kat_vectors, philox4x32 with 10 rounds.
        assert_eq!(philox4x32_10([0; 4], [0; 2]), [0x6627_e8d5, 0xe169_c58d, 0xbc57_ac4c, 0x9b00_dbd8]);
        assert_eq!(philox4x32_10([!0; 4], [!0; 2]), [0x408f_276d, 0x41c8_3b0e, 0xa20b_c7c6, 0x6d54_51fd]);
        assert_eq!(
            philox4x32_10([0x243f_6a88, 0x85a3_08d3, 0x1319_8a2e, 0x0370_7344], [0xa409_3822, 0x299f_31d0]),
            [0xd16c_fe09, 0x94fd_cceb, 0x5001_e420, 0x2412_6ea1]
        );
    }

    #[test]
    fn a_uniform_is_the_upper_24_bits() {
        let u = uniforms(0, [0; 3], 0);
        assert_eq!(u[0], f64::from(0x66_27e8u32) / 16_777_216.0);
        assert!(u.into_iter().all(|u| f64::from(u as f32) == u && (0.0..1.0).contains(&u)));
        // The seed's upper word is the key's second.
        let [word, ..] = philox4x32_10([1, 2, 3, 4], [5, 6]);
        assert_eq!(uniform(5 | 6 << 32, [1, 2, 3], 4), f64::from(word >> 8) / 16_777_216.0);
    }

    #[test]
    fn side_by_side_or_one_by_one() {
        let draws = [0, 1, 64, u32::MAX, 7, 6, 5, 4];
        let all = uniforms_of(3 | 9 << 40, [1, 2, 3], draws);
        for (l, draw) in draws.into_iter().enumerate() {
            assert_eq!(all.map(|word| word[l]), uniforms(3 | 9 << 40, [1, 2, 3], draw));
        }
    }

    #[test]
    fn uniforms_are_uniform() {
        // 20 bins of 10⁵ numbers: χ² with 19 degrees of freedom stays below 43.8 but once in a thousand seeds.
        let mut bins = [0u32; 20];
        for i in 0..25_000 {
            for u in uniforms(7, [i, i / 3, 0], 2) {
                bins[(u * 20.0) as usize] += 1;
            }
        }
        let chi2: f64 = bins.iter().map(|&n| (f64::from(n) - 5000.0).powi(2) / 5000.0).sum();
        assert!(chi2 < 43.8, "{chi2}");
    }
}
