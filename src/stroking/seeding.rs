//! Maps of seeds (Fig. 1 of Nagy et al.; [HATCH-17]): the cells that strokes can begin in, with their probabilities, as
//! a table and as a picture.

use super::Stroking;
use crate::Failure;
use drypoint_output::atomic;
use drypoint_reference::interactive_volume_illustration::{Seeds, Sight};
use drypoint_scene::counts::Counts;
use drypoint_scene::glam::DVec3;
use drypoint_scene::marks::{Dot, Layer, Marks, Pen};
use drypoint_scene::parallel;
use drypoint_scene::view::View;
use std::fmt::Write;
use std::path::Path;

/// Number of tones of the picture, from the lightest, p = 0, to black, p = 1.
const TONES: usize = 16;

/// Light of a cell in which no stroke ever begins.
const LIGHTEST: f64 = 0.8;

/// Distance in front of its centre at which a cell is tested for visibility, in voxels. It is more than half of the
/// cell's diagonal.
const BEFORE: f64 = 1.0;

/// Cells of hatching, and their probabilities.
pub struct SeedMap(Seeds);

impl Stroking<'_> {
    /// Returns the cells that strokes of the scene's hatching can begin in; none without hatching.
    pub fn seeds(&self, counts: &mut Counts) -> Option<SeedMap> {
        self.hatching.as_ref().map(|hatching| SeedMap(hatching.seeds(&self.field, counts)))
    }

    /// Returns the page of the cells that a camera sees. Each is a dot as large as the cell, the darker the more
    /// probable a stroke is.
    pub fn seed_page(&self, map: &SeedMap, view: &View, counts: &mut Counts) -> Marks {
        let surfaces = self.surfaces();
        let hides = self.hatching.as_ref().and_then(|hatching| self.hides.or(hatching.iso));
        let surface = hides.and_then(|iso| surfaces.iter().find(|surface| surface.iso() == iso));
        let sight = Sight { view, page: &self.page, near: self.near, surface, clip: &self.clip, offset: 0.0 };
        let grid = self.field.volume().grid();
        let dot = |&(cell, p): &([usize; 3], f64)| {
            let world = grid.to_world(DVec3::from_array(cell.map(|i| i as f64 + 0.5)));
            let eye = if view.perspective { (view.eye - world).normalize_or_zero() } else { -view.forward };
            let at = sight.place(world).filter(|_| !self.clip.cut_in_world(world))?;
            let depth = if view.perspective { -view.to_eye(world).z } else { 1.0 };
            let pixel = (self.page.size.x - 2.0 * self.page.margin) / view.size[0] as f64;
            let radius = 0.5 * 3f64.sqrt() * grid.voxel() * pixel / (view.pixel * depth);
            let seen = sight.sees(world + eye * (BEFORE * grid.voxel()));
            seen.then_some(((p * (TONES - 1) as f64).round() as usize, Dot { at, world, radius, opacity: 1.0 }))
        };
        let cells = &map.0.cells;
        let dots = parallel::gather(cells.len(), parallel::RUN, &|run, dots| {
            dots.extend(cells[run].iter().filter_map(dot));
        });
        counts.preprocess.insert("looks for what hides".into(), map.0.cells.len() as u64);
        let layer = |tone: usize| {
            let share = tone as f64 / (TONES - 1) as f64;
            let light = LIGHTEST * (1.0 - share);
            let pen =
                Pen { number: tone + 1, name: format!("p {share:.2}"), width: 0.1, color: [light, light, light, 1.0] };
            let of_tone = dots.iter().filter(|dot| dot.0 == tone).map(|dot| dot.1);
            Layer { dots: of_tone.collect(), ..Layer::new(pen) }
        };
        let layers = (0..TONES).map(layer).filter(|layer| !layer.dots.is_empty()).collect();
        let mut marks = Marks { page: self.page, layers };
        marks.settle();
        marks
    }
}

impl SeedMap {
    /// Returns the number of cells and Σp, the expected number of strokes.
    pub fn sums(&self) -> (usize, f64) {
        // The sum of no numbers is −0.
        (self.0.cells.len(), self.0.expected() + 0.0)
    }

    /// Returns each cell, by its lowest voxel, with its p.
    pub fn cells(&self) -> &[([usize; 3], f64)] {
        &self.0.cells
    }

    /// Writes `x,y,z,p`, a row a cell, z slowest; the file appears whole or not at all.
    ///
    /// # Errors
    /// Errors of the operating system.
    pub fn write(&self, path: &Path) -> Result<(), Failure> {
        let mut out = String::from("x,y,z,p\n");
        for ([x, y, z], p) in &self.0.cells {
            // Writing to a string does not fail.
            let _ = writeln!(out, "{x},{y},{z},{p}");
        }
        atomic::write(path, out.as_bytes()).map_err(|error| Failure::picture(&error, path.display()))
    }
}
