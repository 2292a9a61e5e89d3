//! Dots chosen on the page: weighted sample elimination to a local density ([STIP-19]).
//!
//! C. Yuksel, *Sample Elimination for Generating Poisson Disk Sample Sets*, Computer Graphics Forum 34(2), 2015: the
//! point most crowded by the others is removed, again and again, until the wanted number is left. A dot at the
//! density ρ occupies a disc of radius r = √(1/(2√3 ρ)), the closest packing. Two dots at distance d crowd each other
//! by (1 − d/2r)⁸, where r is the smaller radius. A grid over the page sums the density from the shares of all
//! candidates, so that faces in front of each other count together.

use drypoint_scene::glam::DVec2;
use drypoint_scene::parallel;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A point that may become a dot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DotCandidate {
    /// Place on the page.
    pub at: DVec2,
    /// Number of dots that the candidate stands for, at most 1. The sum over a region of the page is the number of
    /// dots there.
    pub share: f64,
}

/// Number of dots in the window for measuring the local density.
const WINDOW: f64 = 8.0;

/// β of section 3.1: distances below a share of 2r count as this share.
const BETA: f64 = 0.65;

/// Selects as many candidates as their shares add up to, spread as evenly on the page as possible. Returns their
/// indices in ascending order. The result is deterministic.
pub fn eliminate(candidates: &[DotCandidate]) -> Vec<usize> {
    let wanted = candidates.iter().map(|c| c.share).sum::<f64>().round_ties_even() as usize;
    if wanted >= candidates.len() {
        return (0..candidates.len()).collect();
    }
    if wanted == 0 {
        return Vec::new();
    }
    // Local radii from the local density, pairs that crowd each other, and each candidate's total weight.
    let cells = PointCells::new(candidates);
    let radii = cells.radii(candidates);
    let (crowds, first) = crowds(candidates, &cells, &radii, wanted as f64 / candidates.len() as f64);
    let mut weights: Vec<f64> =
        first.windows(2).map(|w| crowds[w[0]..w[1]].iter().map(|c| f64::from(c.weight)).sum()).collect();
    // The most crowded candidate comes first; among equals, the first of the list. Bit patterns of non-negative
    // floats are ordered like the floats. Weights only decrease, so an outdated entry is detected when it comes up.
    let key = |i: usize, weights: &[f64]| (weights[i].to_bits(), Reverse(i));
    let mut heap: BinaryHeap<(u64, Reverse<usize>)> = (0..candidates.len()).map(|i| key(i, &weights)).collect();
    let mut is_kept = vec![true; candidates.len()];
    let mut left = candidates.len();
    // Removes the most crowded candidate and relieves its neighbours, until the wanted number is left.
    while left > wanted
        && let Some((bits, Reverse(i))) = heap.pop()
    {
        if bits != weights[i].to_bits() {
            heap.push(key(i, &weights));
            continue;
        }
        is_kept[i] = false;
        left -= 1;
        for crowd in &crowds[first[i]..first[i + 1]] {
            let other = crowd.other as usize;
            // Rounding may leave a value slightly below 0.
            weights[other] = (weights[other] - f64::from(crowd.weight)).max(0.0);
        }
    }
    (0..candidates.len()).filter(|&i| is_kept[i]).collect()
}

/// The weight by which a point crowds another.
#[derive(Clone, Copy)]
struct Crowding {
    other: u32,
    weight: f32,
}

/// For each point the points that crowd it, and the start of its entries. `kept` is the share of points that remain.
fn crowds(points: &[DotCandidate], cells: &PointCells, radii: &[f64], kept: f64) -> (Vec<Crowding>, Vec<usize>) {
    // γ of section 3.1 is 3/2.
    let least = BETA * (1.0 - kept * kept.sqrt());
    let part = |part: &[usize]| {
        let (mut crowds, mut ends) = (Vec::new(), Vec::new());
        for &i in part {
            let at = points[i].at;
            cells.around(at, 2.0 * radii[i], |j| {
                let reach = 2.0 * radii[i].min(radii[j]);
                let far = (points[j].at.distance(at) / reach).max(least);
                if j != i && far < 1.0 {
                    let close = (1.0 - far) * (1.0 - far);
                    crowds.push(Crowding { other: j as u32, weight: (close * close * close * close) as f32 });
                }
            });
            ends.push(crowds.len());
        }
        (crowds, ends)
    };
    let order: Vec<usize> = (0..points.len()).collect();
    let parts = parallel::map_of(order.chunks(4096).collect(), &|_, order| part(order));
    let (mut crowds, mut first) = (Vec::new(), vec![0]);
    for (of_part, ends) in parts {
        first.extend(ends.into_iter().map(|end| crowds.len() + end));
        crowds.extend(of_part);
    }
    (crowds, first)
}

/// A raster of square cells with the points of each.
struct PointCells {
    /// The lower corner.
    from: DVec2,
    side: f64,
    /// Number of cells across and down.
    size: [usize; 2],
    /// The points cell by cell, x fastest, and the start of each cell's entries.
    points: Vec<u32>,
    first: Vec<usize>,
}

impl PointCells {
    fn new(points: &[DotCandidate]) -> Self {
        let (mut lo, mut hi) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for point in points {
            (lo, hi) = (lo.min(point.at), hi.max(point.at));
        }
        let extent = (hi - lo).max(DVec2::splat(f64::MIN_POSITIVE));
        // A cell has a few points if these cover the page evenly.
        let side = (2.0 * extent.x * extent.y / points.len() as f64).sqrt().max(extent.max_element() / 4096.0);
        let size = (extent / side).to_array().map(|n| n as usize + 1);
        let mut cells = Self { from: lo, side, size, points: vec![0; points.len()], first: Vec::new() };
        let mut first = vec![0usize; size[0] * size[1] + 1];
        for point in points {
            first[cells.index(point.at) + 1] += 1;
        }
        for i in 1..first.len() {
            first[i] += first[i - 1];
        }
        let mut next = first.clone();
        for (i, point) in points.iter().enumerate() {
            let cell = cells.index(point.at);
            cells.points[next[cell]] = i as u32;
            next[cell] += 1;
        }
        cells.first = first;
        cells
    }

    fn cell(&self, at: DVec2) -> [usize; 2] {
        let to = (at - self.from) / self.side;
        // `as` clamps at 0.
        [(to.x as usize).min(self.size[0] - 1), (to.y as usize).min(self.size[1] - 1)]
    }

    fn index(&self, at: DVec2) -> usize {
        let [x, y] = self.cell(at);
        y * self.size[0] + x
    }

    /// Visits the points in all cells within a distance, so some points are farther away.
    fn around(&self, at: DVec2, distance: f64, mut found: impl FnMut(usize)) {
        let ([x0, y0], [x1, y1]) = (self.cell(at - distance), self.cell(at + distance));
        for y in y0..=y1 {
            let row = y * self.size[0];
            for &i in &self.points[self.first[row + x0]..self.first[row + x1 + 1]] {
                found(i as usize);
            }
        }
    }

    /// Radius r at each point, from the density in the smallest square of cells with enough shares.
    fn radii(&self, points: &[DotCandidate]) -> Vec<f64> {
        let [width, height] = self.size;
        // A summed-area table with a leading row and column of zeros.
        let mut sums = vec![0.0; (width + 1) * (height + 1)];
        for y in 0..height {
            let mut row = 0.0;
            for x in 0..width {
                let cell = y * width + x;
                let own = &self.points[self.first[cell]..self.first[cell + 1]];
                row += own.iter().map(|&i| points[i as usize].share).sum::<f64>();
                sums[(y + 1) * (width + 1) + x + 1] = sums[y * (width + 1) + x + 1] + row;
            }
        }
        let sum = |x: usize, y: usize| sums[y * (width + 1) + x];
        // The smallest square window around a cell with enough shares gives the density ρ, and r = √(1/(2√3 ρ)).
        let window = |[x, y]: [usize; 2]| {
            for reach in 1.. {
                let (x0, y0) = (x.saturating_sub(reach), y.saturating_sub(reach));
                let (x1, y1) = ((x + reach + 1).min(width), (y + reach + 1).min(height));
                let shares = sum(x1, y1) - sum(x0, y1) - sum(x1, y0) + sum(x0, y0);
                if shares >= WINDOW || (x0, y0, x1, y1) == (0, 0, width, height) {
                    let area = ((x1 - x0) * (y1 - y0)) as f64 * self.side * self.side;
                    return (area / (2.0 * 3f64.sqrt() * shares.max(f64::MIN_POSITIVE))).sqrt();
                }
            }
            0.0
        };
        let mut of_cells = vec![f64::NAN; width * height];
        for point in points {
            let cell = self.cell(point.at);
            let radius = &mut of_cells[cell[1] * width + cell[0]];
            if radius.is_nan() {
                *radius = window(cell);
            }
        }
        points.iter().map(|point| of_cells[self.index(point.at)]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::philox::uniforms;

    fn random(count: u32, share: impl Fn(DVec2) -> f64) -> Vec<DotCandidate> {
        let at = |i| uniforms(5, [i, 0, 0], 0);
        let at = (0..count).map(at).map(|[x, y, ..]| DVec2::new(100.0 * x, 100.0 * y));
        at.map(|at| DotCandidate { at, share: share(at) }).collect()
    }

    /// The mean distance to the nearest neighbour, times √density, in a window away from the border.
    fn nearest(points: &[DVec2], inside: impl Fn(&DVec2) -> bool, density: f64) -> f64 {
        let chosen: Vec<&DVec2> = points.iter().filter(|p| inside(p)).collect();
        let near = |p: &DVec2| {
            points.iter().filter(|q| *q != p).map(|q| q.distance_squared(*p)).fold(f64::INFINITY, f64::min).sqrt()
        };
        chosen.iter().map(|p| near(p)).sum::<f64>() / chosen.len() as f64 * density.sqrt()
    }

    /// Yuksel's own figure: from white noise with four to five times the wanted points, the relative radius is 0.7 to
    /// 0.75 of the largest possible one. The nearest neighbours' mean distance is larger.
    #[test]
    fn white_noise_becomes_even() {
        let candidates = random(12_000, |_| 0.2);
        let kept = eliminate(&candidates);
        assert_eq!(kept.len(), 2400);
        let points: Vec<DVec2> = kept.iter().map(|&i| candidates[i].at).collect();
        let inside = |p: &DVec2| (*p - 50.0).abs().max_element() < 45.0;
        let density = points.iter().filter(|p| inside(p)).count() as f64 / 8100.0;
        let found = nearest(&points, inside, density);
        assert!(found > 0.8, "{found}");
    }

    /// A region with three times the shares has three times the dots, and both regions are even.
    #[test]
    fn the_local_density_is_what_the_shares_ask_for() {
        let right = |p: &DVec2| p.x > 50.0;
        // A third of the candidates on the left.
        let candidates = random(24_000, |_| 0.25);
        let is_there = |(i, c): &(usize, DotCandidate)| right(&c.at) || i % 3 == 0;
        let candidates: Vec<DotCandidate> =
            candidates.into_iter().enumerate().filter(is_there).map(|(_, c)| c).collect();
        let points: Vec<DVec2> = eliminate(&candidates).into_iter().map(|i| candidates[i].at).collect();
        for is_right in [true, false] {
            let inside =
                |p: &DVec2| right(p) == is_right && (p.x - 50.0).abs() > 5.0 && (*p - 50.0).abs().max_element() < 45.0;
            let asked: f64 = candidates.iter().filter(|c| inside(&c.at)).map(|c| c.share).sum();
            let count = points.iter().filter(|p| inside(p)).count() as f64;
            assert!((count / asked - 1.0).abs() < 0.03, "{is_right}: {count} of {asked}");
            let found = nearest(&points, inside, count / 3600.0);
            assert!(found > 0.75, "{is_right}: {found}");
        }
    }

    #[test]
    fn all_or_none_and_points_that_coincide() {
        let same = |share, count| vec![DotCandidate { at: DVec2::ONE, share }; count];
        assert_eq!(eliminate(&same(1.0, 3)), [0, 1, 2]);
        assert!(eliminate(&same(0.1, 3)).is_empty() && eliminate(&[]).is_empty());
        // Of equal candidates the first is removed first.
        assert_eq!(eliminate(&same(0.5, 4)), [2, 3]);
    }
}
