//! Counts of growing strokes ([PLAN-2]).

use crate::interactive_volume_illustration::{HatchCounts, StrokeGrower};
use drypoint_scene::counts::Counts;

/// Counts the directions that strokes have stored.
pub(super) fn count_kept(counts: &mut Counts, strokes: &StrokeGrower<'_, '_>) {
    let [made, bytes] = strokes.stored();
    counts.preprocess.insert("stored directions".into(), made);
    counts.bytes.insert("stored directions".into(), bytes);
    counts.bytes.insert("smoothed bricks".into(), strokes.directions().bytes());
}

/// Adds the counts of growing.
pub(super) fn add(counts: &mut Counts, grown: &HatchCounts) {
    counts.directions += grown.scales.directions();
    for (cause, number) in grown.stops.named() {
        *counts.stops.entry(cause.into()).or_default() += number;
    }
    *counts.preprocess.entry("seeds without a stroke".into()).or_default() += grown.rejected.total();
    let (scales, rejected) = (&grown.scales, &grown.rejected);
    let named = [
        ("seeds beside the surface", rejected.no_surface),
        ("seeds without a direction", rejected.no_direction),
        ("seeds of strokes without length", rejected.short),
        ("crossing strokes", grown.cross),
        ("steps put back", grown.put_back),
        ("strokes cut where they dip", grown.cut),
        ("directions between stored ones", scales.between),
        ("places without stored directions", scales.missing),
        ("directions at σ = 1", scales.given[0]),
        ("directions at σ = 2", scales.given[1]),
        ("directions at σ = 4", scales.given[2]),
        ("estimates near the border", scales.border.iter().sum()),
        ("estimates of umbilics", scales.umbilic.iter().sum()),
        ("estimates within the noise", scales.noise.iter().sum()),
        ("estimates that disagree", scales.disagree.iter().sum()),
    ];
    for (name, number) in named {
        if number > 0 {
            *counts.preprocess.entry(name.into()).or_default() += number;
        }
    }
}
