//! Gaps in lines where nearer ones cross ([HATCH-20]).

use drypoint_reference::interactive_volume_illustration as room;
use drypoint_scene::counts::Counts;
use drypoint_scene::marks::{Layer, Polyline};
use drypoint_scene::view::View;
use std::time::Instant;

/// Cuts gaps into the lines of the first `own` layers near lines in front of them. All gaps refer to the lines before
/// any was cut.
pub(super) fn cut_gaps([gap, deeper]: [f64; 2], layers: &mut [Layer], own: usize, view: &View, counts: &mut Counts) {
    let start = Instant::now();
    let before: Vec<Vec<Polyline>> = layers.iter().map(|layer| layer.lines.clone()).collect();
    for (i, layer) in layers.iter_mut().take(own).enumerate() {
        let others = before.iter().enumerate().filter(|(other, _)| *other != i);
        let others: Vec<Polyline> = others.flat_map(|(_, lines)| lines.iter().cloned()).collect();
        let found = room::gapped(&layer.lines, &others, view, gap, deeper);
        *counts.preprocess.entry("segments with gaps".into()).or_default() += found.cuts;
        layer.lines = found.lines;
    }
    *counts.seconds.entry("gaps of strokes".into()).or_default() += start.elapsed().as_secs_f64();
}
