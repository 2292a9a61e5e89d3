//! Dots of a step wedge: a square of one tone, to be printed and measured ([STIP-17], not in the paper).

use super::elimination::{DotCandidate, eliminate};
use drypoint_scene::glam::DVec2;
use drypoint_scene::philox;
use drypoint_scene::tone::Tone;
use std::f64::consts::PI;

/// Candidates for each dot.
const OVERSAMPLING: f64 = 4.0;

/// Returns λ, the number of dots of a nib in a square millimetre that print a tone: λ·π·(nib/2)² is their ink.
pub fn density(tone: &Tone, wanted: f64, nib: f64) -> f64 {
    tone.ink(wanted) / (0.25 * PI * nib * nib)
}

/// Returns the number of candidates for a square with `density` dots a unit area, above 0.
pub fn candidates(side: f64, density: f64) -> f64 {
    let CandidateGrid { cells, .. } = CandidateGrid::new(side, density);
    cells * cells
}

/// Returns evenly spread points in a square, `density` a unit area.
pub fn even_dots(side: f64, density: f64, seed: u64, patch: u32) -> Vec<DVec2> {
    if density <= 0.0 {
        return Vec::new();
    }
    // A random candidate in each cell: the density is the same everywhere.
    let CandidateGrid { cell, border, cells } = CandidateGrid::new(side, density);
    let cells = cells as u32;
    let at = |i: u32| {
        let [x, y, ..] = philox::uniforms(seed, [i, patch, 0], 0);
        (DVec2::new(f64::from(i % cells), f64::from(i / cells)) + DVec2::new(x, y)) * cell - border
    };
    let all = 0..cells * cells;
    let candidates: Vec<DotCandidate> = all.map(|i| DotCandidate { at: at(i), share: 1.0 / OVERSAMPLING }).collect();
    let places = eliminate(&candidates).into_iter().map(|i| candidates[i].at);
    places.filter(|p| p.min_element() >= 0.0 && p.max_element() <= side).collect()
}

/// Grid of candidates for a square of dots, one a cell. It is larger than the square, since chosen dots lie closer
/// together at its border.
struct CandidateGrid {
    cell: f64,
    border: f64,
    /// Cells in a row, and number of rows.
    cells: f64,
}

impl CandidateGrid {
    /// Makes the grid for `density` dots a unit area, above 0.
    fn new(side: f64, density: f64) -> Self {
        let (cell, border) = (1.0 / (OVERSAMPLING * density).sqrt(), 4.0 / density.sqrt());
        Self { cell, border, cells: ((side + 2.0 * border) / cell).ceil() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Random points of the same number lie about 0.5/√λ apart, and the nearest two far less.
    #[test]
    fn dots_have_the_density_and_keep_apart() {
        let (side, lambda) = (10.0, 4.0);
        let dots = even_dots(side, lambda, 7, 0);
        let wanted = lambda * side * side;
        assert!((dots.len() as f64 - wanted).abs() < 0.05 * wanted, "{}", dots.len());
        let apart = |i: usize| dots[..i].iter().fold(f64::INFINITY, |least: f64, dot| least.min(dot.distance(dots[i])));
        let nearest = (0..dots.len()).map(apart).fold(f64::INFINITY, f64::min);
        assert!(nearest > 0.4 / lambda.sqrt(), "{nearest}");
        assert!(even_dots(side, 0.0, 7, 0).is_empty());
    }

    /// Two borders of 4/√λ and a side of n/√λ are 2(n + 8) cells in a row.
    #[test]
    fn candidates_by_hand() {
        assert_eq!([candidates(1.0, 4.0), candidates(2.0, 1.0)], [400.0; 2]);
    }

    /// A dot of a nib of 2 mm has π mm² of ink.
    #[test]
    fn a_density_prints_its_ink() {
        let tone = Tone::ideal();
        assert_eq!(density(&tone, 0.5, 2.0), tone.ink(0.5) / PI);
    }
}
