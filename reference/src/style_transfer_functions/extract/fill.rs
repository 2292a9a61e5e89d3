//! Texels that the picture does not show ([STF-2]): beyond its edge, or with normals that an outline does not have.
//!
//! They take the harmonic continuation of the known texels, which is the smoothest one and has no seams. By the maximum
//! principle each channel stays between its least and its largest known value. No flux crosses the circumference. The
//! equation is solved from coarse to fine, as in Bornemann and Deuflhard's cascadic multigrid (1996), with a fixed
//! number of sweeps.

use drypoint_scene::color::Rgba;
use drypoint_scene::style::is_inside;

/// Gauss–Seidel sweeps for each level. The correction from the coarser level leaves only short waves.
const SWEEPS: usize = 24;

/// A texel of one level.
#[derive(Clone, Copy, Debug, PartialEq)]
enum TexelState {
    /// A texel off the disk.
    Outside,
    Known(Rgba),
    Unknown,
}

/// Colours for all texels inside the disk of S × S; transparent black outside. Returns none if no texel is known.
pub(super) fn fill(side: usize, texels: &[Option<Rgba>]) -> Option<Vec<Rgba>> {
    let cell = |t: usize| match texels[t] {
        _ if !is_inside(side, t % side, t / side) => TexelState::Outside,
        Some(color) => TexelState::Known(color),
        None => TexelState::Unknown,
    };
    let cells: Vec<TexelState> = (0..side * side).map(cell).collect();
    solve(side, &cells)
}

fn solve(side: usize, cells: &[TexelState]) -> Option<Vec<Rgba>> {
    let value = |cell: &TexelState| if let TexelState::Known(color) = cell { *color } else { [0.0; 4] };
    let mut colors: Vec<Rgba> = cells.iter().map(value).collect();
    if !cells.contains(&TexelState::Unknown) {
        return cells.iter().any(|cell| matches!(cell, TexelState::Known(_))).then_some(colors);
    }
    if side == 1 {
        return None;
    }
    // The start: the solution on the grid of half the side.
    let half = side.div_ceil(2);
    let coarse = solve(half, &coarser(side, cells))?;
    let unknown: Vec<usize> = (0..cells.len()).filter(|&t| cells[t] == TexelState::Unknown).collect();
    for &t in &unknown {
        colors[t] = coarse[t / side / 2 * half + t % side / 2];
    }
    // Gauss–Seidel for Δ = 0: each unknown texel becomes the mean of its neighbours inside the disk.
    for _ in 0..SWEEPS {
        for &t in &unknown {
            let [i, j] = [t % side, t / side];
            let places = [
                (i > 0).then(|| t - 1),
                (i + 1 < side).then(|| t + 1),
                (j > 0).then(|| t - side),
                (j + 1 < side).then(|| t + side),
            ];
            let (mut sum, mut count) = ([0.0; 4], 0.0);
            for at in places.into_iter().flatten().filter(|&at| cells[at] != TexelState::Outside) {
                sum = std::array::from_fn(|c| sum[c] + colors[at][c]);
                count += 1.0;
            }
            if count > 0.0 {
                colors[t] = sum.map(|s| s / count);
            }
        }
    }
    Some(colors)
}

/// The level of half the side. A texel is the mean of the known ones among four, and unknown only if none of them is
/// known.
fn coarser(side: usize, cells: &[TexelState]) -> Vec<TexelState> {
    let half = side.div_ceil(2);
    let merge = |t: usize| {
        let (mut sum, mut known, mut unknown) = ([0.0; 4], 0.0, false);
        for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let [i, j] = [t % half * 2 + dx, t / half * 2 + dy];
            match (i < side && j < side).then(|| cells[j * side + i]) {
                Some(TexelState::Known(color)) => {
                    sum = std::array::from_fn(|c| sum[c] + color[c]);
                    known += 1.0;
                }
                Some(TexelState::Unknown) => unknown = true,
                Some(TexelState::Outside) | None => {}
            }
        }
        match (known > 0.0, unknown) {
            (true, _) => TexelState::Known(sum.map(|s: f64| s / known)),
            (false, true) => TexelState::Unknown,
            (false, false) => TexelState::Outside,
        }
    };
    (0..half * half).map(merge).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn filled(side: usize, known: impl Fn(usize, usize) -> Option<f64>) -> Vec<f64> {
        let texels: Vec<Option<Rgba>> = (0..side * side).map(|t| known(t % side, t / side).map(|v| [v; 4])).collect();
        fill(side, &texels).unwrap().into_iter().map(|c| c[0]).collect()
    }

    #[test]
    fn what_is_known_stays_and_nothing_known_fills_nothing() {
        let side = 9;
        let all = filled(side, |i, j| Some((i * j) as f64));
        for (t, &v) in all.iter().enumerate() {
            let inside = is_inside(side, t % side, t / side);
            assert_eq!(v, if inside { (t % side * (t / side)) as f64 } else { 0.0 });
        }
        for side in [1, 2, 7, 64] {
            assert_eq!(fill(side, &vec![None; side * side]), None);
        }
    }

    #[test]
    fn a_gap_is_bridged_evenly() {
        // Known left and right of a gap of 20 columns: on a ramp the continuation is the ramp. The rim of the disk lets
        // nothing through, which bends it near its ends; in the middle row by less than a tenth of the gap's rise.
        let (side, gap) = (64, 22..42);
        let ramp = filled(side, |i, _| (!gap.contains(&i)).then_some(i as f64));
        for i in 0..side {
            assert!((ramp[32 * side + i] - i as f64).abs() < 2.0, "{i}: {}", ramp[32 * side + i]);
        }
        let middle = &ramp[32 * side..33 * side];
        assert!(middle.windows(2).all(|pair| pair[1] > pair[0]), "{middle:?}");
    }

    #[test]
    fn it_stays_between_the_least_and_the_largest() {
        // A single speck known at 0.7 and a patch of two colours on the left.
        let side = 50;
        let known = |i: usize, j: usize| match (i, j) {
            (40, 40) => Some(0.7),
            (8..14, 20..30) => Some(if j < 25 { 0.2 } else { 0.9 }),
            _ => None,
        };
        for (t, v) in filled(side, known).into_iter().enumerate() {
            assert!(!is_inside(side, t % side, t / side) || (0.2..=0.9).contains(&v), "{t}: {v}");
        }
        // One colour alone fills all with itself, but for the rounding of a mean.
        let one = filled(side, |i, j| (i == 25 && j == 3).then_some(0.3));
        assert!((0..side * side).all(|t| !is_inside(side, t % side, t / side) || (one[t] - 0.3).abs() < 1e-15));
    }
}
