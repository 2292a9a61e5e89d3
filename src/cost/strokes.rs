//! Distances between strokes of two settings ([COST-1]).

use super::statistics::median;
use drypoint_output::compare::line_distance::{LineDistance, WorldLine, angles, line_distance};
use drypoint_scene::marks::{Marks, Polyline};
use drypoint_scene::parallel;
use drypoint_scene::strokes::Stroke;
use std::collections::BTreeMap;

/// Longest piece of a stroke, in voxels.
const PIECE: f64 = 0.1;

/// Share of strokes, the nearest ones, whose distances count. The others end elsewhere, or separate where lines of
/// curvature meet. They are then as far away as they are long, whatever the setting.
const TOGETHER: f64 = 0.95;

/// Strokes that a setting draws.
pub(super) struct DrawnStrokes {
    /// Some strokes of hatching as they grow, including those that the camera does not see.
    pub(super) strokes: Option<Vec<Stroke>>,
    /// All marks on the page.
    pub(super) marks: Marks,
}

/// Returns the distances of strokes to others in voxels, and their angle in degrees. Hatching is compared stroke by stroke,
/// by seed; other lines as lists. Returns none if there is nothing to compare.
pub(super) fn distances(drawn: &DrawnStrokes, truth: &DrawnStrokes, voxel: f64) -> Option<(LineDistance, Option<f64>)> {
    let (Some(a), Some(b)) = (&drawn.strokes, &truth.strokes) else {
        let LineDistance { rms, max } = line_distance(lines(&drawn.marks), lines(&truth.marks), PIECE * voxel)?;
        return Some((LineDistance { rms: rms / voxel, max: max / voxel }, None));
    };
    let by_seed: BTreeMap<u64, &Stroke> = b.iter().map(|stroke| (stroke.key, stroke)).collect();
    let pairs: Vec<(&Stroke, &Stroke)> = a.iter().filter_map(|a| Some((a, *by_seed.get(&a.key)?))).collect();
    let compared = parallel::map(pairs.len(), &|i| of_pair(pairs[i], voxel));
    let mut compared: Vec<(LineDistance, Vec<f64>)> = compared.into_iter().flatten().collect();
    if compared.is_empty() {
        return None;
    }
    compared.sort_by(|a, b| a.0.max.total_cmp(&b.0.max));
    let together = &compared[..(TOGETHER * compared.len() as f64).ceil() as usize];
    let squares: f64 = together.iter().map(|(apart, _)| apart.rms * apart.rms).sum();
    let max = together.iter().map(|(apart, _)| apart.max).fold(0.0, f64::max);
    let turned: Vec<f64> = compared.iter().flat_map(|(_, angles)| angles.iter().map(|a| a.to_degrees())).collect();
    let rms = (squares / together.len() as f64).sqrt();
    let angle = (!turned.is_empty()).then(|| median(&turned));
    Some((LineDistance { rms: rms / voxel, max: max / voxel }, angle))
}

/// Returns the distances of two strokes, and the angles between them at steps of a voxel. Closed strokes have no common
/// start, hence no angles.
fn of_pair((a, b): (&Stroke, &Stroke), voxel: f64) -> Option<(LineDistance, Vec<f64>)> {
    let found = line_distance([a].into_iter(), [b].into_iter(), PIECE * voxel)?;
    let turned =
        if a.closed || b.closed { Vec::new() } else { angles(&WorldLine::from(a), &WorldLine::from(b), voxel) };
    Some((found, turned))
}

fn lines(marks: &Marks) -> impl Iterator<Item = &Polyline> {
    marks.layers.iter().flat_map(|layer| &layer.lines)
}
