//! Strokes that lie evenly on the page, grown where it is free ([HATCH-19]).
//!
//! Of a hundred thousand cells in which a stroke could begin a page has room for some thousand, so strokes are grown only
//! where one may still begin: in the order of the cells' random numbers, by groups.

use super::counts::HatchCounts;
use super::ground::{index_inside, normal};
use super::sight::{Pen, Sight};
use super::spacing::Spread;
use super::strokes::Strokes;
use drypoint_scene::glam::{DVec2, DVec3};
use drypoint_scene::marks::Polyline;
use drypoint_scene::philox::uniform;
use drypoint_scene::strokes::{Stroke, StrokeVertex};
use rayon::prelude::*;

/// Strokes that are grown side by side, before any of them takes its place.
const GROUP: usize = 256;

/// How far in front of a cell it is asked whether the cell is seen, in voxels.
const BEFORE: f64 = 1.0;

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
    /// Cells that the camera sees.
    pub seen: u64,
    /// Of those, strokes that were grown, or could not be.
    pub tried: u64,
    /// How often the surface was asked for.
    pub looks: u64,
    /// What growing did.
    pub counts: HatchCounts,
}

/// A cell that the camera sees.
struct Candidate {
    order: f64,
    cell: [usize; 3],
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
            cells.par_iter().filter_map(|&cell| self.candidate(sight, cell, seed, &tone)).collect();
        candidates.par_sort_by(|a, b| a.order.total_cmp(&b.order));
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
                .map(|candidate| self.stroke_of(candidate.cell, along))
                .map(|(stroke, counts)| (stroke.filter(has_room), counts))
                .collect();
            even.tried += group.len() as u64;
            // Whatever comes of them, it comes of no other that begins there.
            group.iter().for_each(|candidate| spread.close(candidate.at));
            let mut strokes = Vec::new();
            for (stroke, counts) in grown {
                strokes.extend(stroke);
                even.counts += counts;
            }
            let seen = sight.seen(&strokes, ink);
            even.looks += seen.looks;
            even.lines.extend(spread.add(&seen.lines));
        }
    }

    fn candidate(
        &self,
        sight: &Sight<'_>,
        cell: [usize; 3],
        seed: u64,
        tone: impl Fn(DVec3) -> f64,
    ) -> Option<Candidate> {
        let ground = self.ground();
        let grid = ground.grid();
        let dims = grid.dims();
        let middle = DVec3::from([0, 1, 2].map(|a| if dims[a] == 1 { 0.0 } else { cell[a] as f64 + 0.5 }));
        let (normal, _) = normal(ground, index_inside(ground, middle)?)?;
        let front = grid.to_world(middle) + normal * (BEFORE * grid.voxel());
        let place = sight.place(front)?;
        let tone = tone(normal);
        (tone > 0.0 && sight.sees(front)).then(|| Candidate {
            order: uniform(seed, cell.map(|i| i as u32), 1),
            cell,
            at: place,
            tone,
        })
    }

    fn stroke_of(&self, cell: [usize; 3], along: Along) -> (Option<Stroke>, HatchCounts) {
        let mut counts = HatchCounts::default();
        let grown = self.place(cell, &mut counts).and_then(|seed| match along {
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
