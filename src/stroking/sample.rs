//! A few strokes as they grow, whatever a camera sees of them ([COST-1]).

use super::StrokeFrames;
use drypoint_scene::philox::uniform;
use drypoint_scene::strokes::Stroke;

impl StrokeFrames<'_> {
    /// The strokes of at most `most` seeds of hatching; none without hatching. Random numbers of their cells choose them, so
    /// that of two lists with nearly the same seeds nearly the same are chosen.
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
