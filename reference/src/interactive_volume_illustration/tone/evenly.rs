//! Strokes that lie evenly on the page, grown where the page is free ([HATCH-19]).
//!
//! A page has room for some thousand strokes, but a hundred thousand cells could begin one. So only strokes that may
//! still begin are grown, in groups, in the order of the cells' random numbers.

use super::super::sight::{PenState, Sight};
use super::super::strokes::{HatchCounts, RejectCause, StrokeGrower, inside, normal};
use super::line_spacing::LineSpacing;
use drypoint_scene::glam::{DVec2, DVec3};
use drypoint_scene::marks::Polyline;
use drypoint_scene::parallel;
use drypoint_scene::philox::uniforms;
use drypoint_scene::strokes::{Stroke, StrokeVertex};

/// Number of strokes that are grown in parallel before any of them takes its place.
const GROUP: usize = 256;

/// Distance in front of the surface at which a place's visibility is tested, in voxels.
const BEFORE: f64 = 1.0;

/// Size of a cell on the page for each place drawn in it, in distances of the densest lines. A line is as long as
/// many cells, and each of these has offered a place beside the line.
const DISTANCES: f64 = 2.0;

/// The largest number of places in a cell.
const MOST: f64 = 32.0;

/// The direction that strokes follow in their cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StrokeDirection {
    /// The direction of the table's family.
    First,
    /// The second direction ([HATCH-11]).
    Second,
}

/// Strokes that were placed evenly, with statistics.
#[derive(Clone, Debug, Default)]
pub struct EvenStrokes {
    /// Lines on the page, in the order in which they took their places.
    pub lines: Vec<Polyline>,
    /// Number of places that the camera sees.
    pub seen: u64,
    /// Number of places at which growing a stroke was tried.
    pub tried: u64,
    /// Number of queries of the hiding surface.
    pub looks: u64,
    /// Statistics of growing.
    pub counts: HatchCounts,
}

/// A place on the surface that the camera sees.
struct StrokeCandidate {
    order: f64,
    cell: [usize; 3],
    /// Place in world space, and the value there.
    place: (DVec3, f64),
    at: DVec2,
    tone: f64,
}

impl StrokeGrower<'_, '_> {
    /// Returns the lines of strokes that begin in cells where the page is still free, and adds them to `spread`.
    /// `tone` maps N to τ, the tone that the lines print.
    pub fn evenly(
        &self,
        sight: &Sight<'_>,
        (cells, seed): (&[[usize; 3]], u64),
        along: StrokeDirection,
        tone: impl Fn(DVec3) -> f64 + Sync,
        spread: &mut LineSpacing,
    ) -> EvenStrokes {
        // Visible places of all cells, in random order.
        let mut candidates = parallel::gather(cells.len(), 64, &|run, all| {
            let of_cell = |&cell: &[usize; 3]| self.candidates(sight, cell, seed, spread.least(), &tone);
            all.extend(cells[run].iter().flat_map(of_cell));
        });
        candidates.sort_by(|a, b| a.order.total_cmp(&b.order).then(a.cell.cmp(&b.cell)));
        let mut even = EvenStrokes { seen: candidates.len() as u64, ..EvenStrokes::default() };
        let mut left = candidates.iter();
        loop {
            // The next candidates whose place is still free. They are grown in parallel, and only then accepted in
            // order.
            let group: Vec<&StrokeCandidate> =
                left.by_ref().filter(|c| spread.is_open(c.at, c.tone)).take(GROUP).collect();
            if group.is_empty() {
                return even;
            }
            // A first test without the hiding surface: it is queried only if there is room for a line.
            let ink = |_: &Stroke, vertex: &StrokeVertex| PenState {
                radius: 0.0,
                opacity: tone(vertex.normal).max(0.0),
                color: None,
            };
            let bare = Sight { surface: None, ..*sight };
            let has_room = |stroke: &Stroke| spread.has_room(&bare.seen(std::slice::from_ref(stroke), ink).lines);
            let grown = parallel::map(group.len(), &|i| {
                let (stroke, counts) = self.stroke_of(group[i], along);
                (stroke.filter(has_room), counts)
            });
            even.tried += group.len() as u64;
            let mut strokes = Vec::new();
            for (candidate, (stroke, counts)) in group.iter().zip(grown) {
                match stroke {
                    Some(stroke) => strokes.push(stroke),
                    // Other strokes that begin there would fail, too.
                    None => spread.close(candidate.at),
                }
                even.counts += counts;
            }
            // The visible parts of the grown strokes take their places on the page.
            let seen = sight.seen(&strokes, ink);
            even.looks += seen.looks;
            even.lines.extend(spread.add(&seen.lines));
        }
    }

    /// Returns the places of a cell at which a line could begin. A cell has more than one place if its size on the
    /// page is many times `least`, the smallest distance of lines.
    fn candidates(
        &self,
        sight: &Sight<'_>,
        cell: [usize; 3],
        seed: u64,
        least: f64,
        tone: &(impl Fn(DVec3) -> f64 + Sync),
    ) -> Vec<StrokeCandidate> {
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
    ) -> Option<StrokeCandidate> {
        let [order, x, y, z] = uniforms(seed, cell.map(|i| i as u32), 1 + number);
        let place = self.on_surface(cell, [x, y, z]).ok()?;
        let ground = self.ground();
        let (normal, _) = normal(ground, inside(ground, place.0)?)?;
        let at = sight.place(place.0).filter(|_| !sight.clip.cut_in_world(place.0))?;
        let tone = tone(normal);
        let front = place.0 + normal * (BEFORE * ground.grid().voxel());
        (tone > 0.0 && sight.sees(front)).then_some(StrokeCandidate { order, cell, place, at, tone })
    }

    fn stroke_of(&self, candidate: &StrokeCandidate, along: StrokeDirection) -> (Option<Stroke>, HatchCounts) {
        let mut counts = HatchCounts::default();
        let &StrokeCandidate { cell, place: (world, target), .. } = candidate;
        let seed = self.seed(cell, world, target, &mut counts).map_err(RejectCause::Direction);
        let grown = seed.and_then(|seed| match along {
            StrokeDirection::First => self.grow(&seed, &mut counts).map(Some),
            StrokeDirection::Second => Ok(self.grow_across(&seed, &mut counts)),
        });
        let stroke = grown.unwrap_or_else(|rejected| {
            counts.rejected.count(rejected);
            None
        });
        (stroke, counts)
    }
}
