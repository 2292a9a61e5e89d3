//! Maps of seeds (Fig. 1 of Nagy et al.; [HATCH-17]): the cells that strokes can begin in, with their probabilities, as
//! a table and as a picture.

use super::Stroking;
use crate::Failure;
use drypoint_output::atomic;
use drypoint_reference::interactive_volume_illustration::{Seeds, Sight, seed_layers};
use drypoint_scene::counts::Counts;
use drypoint_scene::marks::Marks;
use drypoint_scene::view::View;
use std::fmt::Write;
use std::path::Path;

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
        let hides = self.hatching.as_ref().and_then(|setup| self.hides.or(setup.hatching.iso));
        let surface = hides.and_then(|iso| surfaces.iter().find(|surface| surface.iso() == iso));
        let sight = Sight { view, page: &self.page, near: self.near, surface, clip: &self.clip, offset: 0.0 };
        counts.preprocess.insert("looks for what hides".into(), map.0.cells.len() as u64);
        let mut marks = Marks { page: self.page, layers: seed_layers(&map.0, &sight, self.field.volume().grid()) };
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
