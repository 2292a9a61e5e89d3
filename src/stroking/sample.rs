//! Samples of strokes as they grow, whether or not a camera sees them ([COST-1]).

use super::StrokeFrames;
use drypoint_scene::philox::uniform;
use drypoint_scene::strokes::Stroke;

impl StrokeFrames<'_> {
    /// Returns the strokes of at most `most` seeds of hatching; none without hatching. Random numbers of the seeds'
    /// cells choose them, so that two lists with nearly the same seeds give nearly the same sample.
    pub(crate) fn sample(&self, most: usize) -> Option<Vec<Stroke>> {
        let hatched = self.hatched.as_ref()?;
        let key = |cell: &[usize; 3]| uniform(0, cell.map(|i| i as u32), 0);
        let mut cells = hatched.cells.clone();
        cells.sort_by(|a, b| key(a).total_cmp(&key(b)));
        cells.truncate(most);
        let grown = hatched.strokes.grow_all(&cells, |_| false);
        Some(grown.strokes.into_iter().map(|(_, stroke)| stroke).collect())
    }
}
