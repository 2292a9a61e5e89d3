//! Strokes that lie evenly on the page, grown where it is free ([HATCH-19]).
//!
//! Of a hundred thousand cells in which a stroke could begin a page has room for some thousand, so strokes are grown only
//! where one may still begin: in the order of the cells' random numbers, by groups.

use super::counts::{HatchCounts, Rejected};
use super::ground::{inside, normal};
use super::sight::{Pen, Sight};
use super::spacing::Spread;
use super::strokes::Strokes;
use drypoint_scene::glam::{DVec2, DVec3};
use drypoint_scene::marks::Polyline;
use drypoint_scene::philox::uniforms;
use drypoint_scene::strokes::{Stroke, StrokeVertex};
use rayon::prelude::*;

/// Strokes that are grown side by side, before any of them takes its place.
const GROUP: usize = 256;

/// How far in front of a place it is asked whether the place is seen, in voxels.
const BEFORE: f64 = 1.0;

/// Lines begin at places drawn in their cells: so many distances of the densest lines make another one. A line is as long as
/// many cells, each of which had a place to offer beside it.
const DISTANCES: f64 = 2.0;

/// The most places in a cell.
const MOST: f64 = 32.0;

/// Which of the two directions of their cells strokes follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Along {
    /// That of the table's family.
    First,
    /// The other one ([HATCH-11]).
    Across,
}

/// What came of cells.
#[derive(Clone, Debug, Default)]
pub struct Even {
    /// On the page, in the order in which they took their places.
    pub lines: Vec<Polyline>,
    /// Places in cells that the camera sees.
    pub seen: u64,
    /// Of those, strokes that were grown, or could not be.
    pub tried: u64,
    /// How often the surface was asked for.
    pub looks: u64,
    /// What growing did.
    pub counts: HatchCounts,
}

/// A place on the surface that the camera sees.
struct Candidate {
    order: f64,
    cell: [usize; 3],
    /// In world space, with the value there.
    place: (DVec3, f64),
    at: DVec2,
    tone: f64,
}

impl Strokes<'_, '_> {
    /// The lines of the strokes that begin in cells where the page is still free, and that take their places on it; `tone` is τ
    /// by N, what the lines print.
    pub fn evenly(
        &self,
        sight: &Sight<'_>,
        (cells, seed): (&[[usize; 3]], u64),
        along: Along,
        tone: impl Fn(DVec3) -> f64 + Sync,
        spread: &mut Spread,
    ) -> Even {
        let mut candidates: Vec<Candidate> =
            cells.par_iter().flat_map_iter(|&cell| self.candidates(sight, cell, seed, spread.least(), &tone)).collect();
        candidates.par_sort_by(|a, b| a.order.total_cmp(&b.order).then(a.cell.cmp(&b.cell)));
        let mut even = Even { seen: candidates.len() as u64, ..Even::default() };
        let mut left = candidates.iter();
        loop {
            let group: Vec<&Candidate> = left.by_ref().filter(|c| spread.is_open(c.at, c.tone)).take(GROUP).collect();
            if group.is_empty() {
                return even;
            }
            // What hides is asked for only where there is room for a line.
            let ink = |_: &Stroke, vertex: &StrokeVertex| Pen {
                radius: 0.0,
                opacity: tone(vertex.normal).max(0.0),
                color: None,
            };
            let bare = Sight { surface: None, ..*sight };
            let has_room = |stroke: &Stroke| spread.has_room(&bare.seen(std::slice::from_ref(stroke), ink).lines);
            let grown: Vec<(Option<Stroke>, HatchCounts)> = group
                .par_iter()
                .map(|candidate| self.stroke_of(candidate, along))
                .map(|(stroke, counts)| (stroke.filter(has_room), counts))
                .collect();
            even.tried += group.len() as u64;
            let mut strokes = Vec::new();
            for (candidate, (stroke, counts)) in group.iter().zip(grown) {
                match stroke {
                    Some(stroke) => strokes.push(stroke),
                    // Nor does any come of another that begins there.
                    None => spread.close(candidate.at),
                }
                even.counts += counts;
            }
            let seen = sight.seen(&strokes, ink);
            even.looks += seen.looks;
            even.lines.extend(spread.add(&seen.lines));
        }
    }

    /// The places of a cell where a line could begin; more than one where a cell is many times as large on the page as lines
    /// are apart, which is at `least` so much.
    fn candidates(
        &self,
        sight: &Sight<'_>,
        cell: [usize; 3],
        seed: u64,
        least: f64,
        tone: &(impl Fn(DVec3) -> f64 + Sync),
    ) -> Vec<Candidate> {
        let grid = self.ground().grid();
        let middle = grid.to_world(DVec3::from(cell.map(|i| i as f64 + 0.5)));
        let aside = sight.view.right * grid.voxel();
        let size = match [sight.place(middle), sight.place(middle + aside)] {
            [Some(a), Some(b)] => a.distance(b),
            _ => 0.0,
        };
        let places = (size / (DISTANCES * least)).ceil().clamp(1.0, MOST) as u32;
        (0..places).filter_map(|place| self.candidate(sight, (cell, place), seed, tone)).collect()
    }

    fn candidate(
        &self,
        sight: &Sight<'_>,
        (cell, number): ([usize; 3], u32),
        seed: u64,
        tone: &(impl Fn(DVec3) -> f64 + Sync),
    ) -> Option<Candidate> {
        let [order, x, y, z] = uniforms(seed, cell.map(|i| i as u32), 1 + number);
        let place = self.on_surface(cell, [x, y, z]).ok()?;
        let ground = self.ground();
        let (normal, _) = normal(ground, inside(ground, place.0)?)?;
        let at = sight.place(place.0)?;
        let tone = tone(normal);
        let front = place.0 + normal * (BEFORE * ground.grid().voxel());
        (tone > 0.0 && sight.sees(front)).then_some(Candidate { order, cell, place, at, tone })
    }

    fn stroke_of(&self, candidate: &Candidate, along: Along) -> (Option<Stroke>, HatchCounts) {
        let mut counts = HatchCounts::default();
        let &Candidate { cell, place: (world, target), .. } = candidate;
        let seed = self.seed(cell, world, target, &mut counts).map_err(Rejected::Direction);
        let grown = seed.and_then(|seed| match along {
            Along::First => self.grow(&seed, &mut counts).map(Some),
            Along::Across => Ok(self.grow_across(&seed, &mut counts)),
        });
        let stroke = grown.unwrap_or_else(|rejected| {
            counts.rejected.count(rejected);
            None
        });
        (stroke, counts)
    }
}
