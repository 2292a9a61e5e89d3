//! Drawing of hatching for a camera: as strokes fall ([HATCH-13]), or evenly on the page ([HATCH-19]).

use super::counts::{add, count_kept};
use super::{CrossedStrokes, GrownHatching, Hatching};
use crate::interactive_volume_illustration::{
    DepthRange, LineDistance, LineSpacing, NormalCone, PenState, Sight, StrokeDirection, StrokePoint, WidthShares,
    crossed_tone, crossed_tones, drawn, grain, scatter, surface_tone,
};
use drypoint_scene::counts::Counts;
use drypoint_scene::glam::{DVec2, DVec3};
use drypoint_scene::marks::{Layer, Pen, Polyline};
use drypoint_scene::math;
use drypoint_scene::parallel;
use drypoint_scene::strokes::Stroke;

/// Shortest line on the page, in widths of the pen.
pub const SHORTEST: f64 = 6.0;

impl GrownHatching<'_> {
    /// Returns the strokes that a camera sees. Crossing strokes are a layer of their own. Strokes lie in front of the
    /// surface themselves, so the offset of `sight` is 0.
    pub fn draw(&self, sight: &Sight<'_>, counts: &mut Counts) -> Vec<Layer> {
        let Hatching { ambient, pen, cross_pen, spacing, .. } = self.hatching;
        let light = sight.view.towards(self.hatching.light);
        let tone = |normal: DVec3| surface_tone(*ambient, normal, light);
        let [lines, across] = match (&self.grown, *spacing) {
            (Some(grown), _) => self.as_they_fall(sight, grown, light, &tone, counts),
            (None, Some(apart)) => self.evenly(sight, apart, &tone, counts),
            (None, None) => Default::default(),
        };
        let crossed = self.hatching.cross.map(|_| Layer { lines: across, ..Layer::new(cross_pen.clone()) });
        std::iter::once(Layer { lines, ..Layer::new(pen.clone()) }).chain(crossed).collect()
    }

    /// Draws all strokes as `[hatching.stroke]` says, and crossing ones where the light falls flatly enough. If hidden
    /// strokes are drawn, too, and colours tell near from far, both are sorted by depth together.
    fn as_they_fall(
        &self,
        sight: &Sight<'_>,
        grown: &CrossedStrokes,
        light: DVec3,
        tone: &(impl Fn(DVec3) -> f64 + Sync),
        counts: &mut Counts,
    ) -> [Vec<Polyline>; 2] {
        let Hatching { cross, pen, cross_pen, one_width, .. } = self.hatching;
        let may_be_seen = |stroke: &&Stroke| !self.turns_away(sight, stroke);
        // Strokes that may be seen. Crossing ones need flat light at their seeds.
        let mut first: Vec<&Stroke> = grown.first.iter().filter(may_be_seen).collect();
        let mut across: Vec<&Stroke> = cross.map_or_else(Vec::new, |angle| {
            let limit = math::cos(angle.to_radians());
            let flat = grown.across.iter().filter(|(normal, _)| normal.dot(light) < limit).map(|(_, stroke)| stroke);
            flat.filter(may_be_seen).collect()
        });
        let by_depth = self.hatching.lighting.is_some() && !self.hatching.cuts_hidden;
        if by_depth {
            first.append(&mut across);
        }
        // Each direction in its pen: style along the stroke, then hidden parts cut off.
        let depths = DepthRange::new(sight.view, self.strokes.ground().grid());
        let inks = [pen, cross_pen].into_iter().zip(*one_width).map(|(pen, one)| (pen.width, one));
        let mut lines = inks.zip([first, across]).map(|(ink, strokes)| {
            let least = if ink.1 { 0.0 } else { 0.5 * self.hatching.min_width };
            let draw = |stroke: &&Stroke| {
                let length = if self.hatching.is_pencil { stroke.length() } else { 0.0 };
                let made = (*stroke, length, ink);
                drawn(stroke, least, |place| self.pen(sight, made, place, (light, depths), tone))
            };
            let drawn = parallel::gather(strokes.len(), 1, &|run, drawn| {
                drawn.extend(strokes[run].iter().flat_map(draw));
            });
            let mut seen = sight.seen_drawn(&drawn);
            if by_depth {
                sight.far_to_near(&mut seen.lines);
            }
            *counts.preprocess.entry("looks for what hides".into()).or_default() += seen.looks;
            seen.lines
        });
        [lines.next().unwrap_or_default(), lines.next().unwrap_or_default()]
    }

    /// Returns width, opacity and colour of a stroke at a point.
    fn pen(
        &self,
        sight: &Sight<'_>,
        (stroke, length, (widest, one_width)): (&Stroke, f64, (f64, bool)),
        StrokePoint { vertex, tangent }: &StrokePoint,
        (light, depths): (DVec3, DepthRange),
        tone: &impl Fn(DVec3) -> f64,
    ) -> PenState {
        let Hatching { growth, lighting, .. } = self.hatching;
        let width = if one_width {
            widest
        } else {
            let shares = WidthShares {
                tone: (tone(vertex.normal), self.hatching.tone),
                taper: (vertex.u, if stroke.closed { 0.0 } else { self.hatching.taper }),
                scatter: scatter(growth.jitter, growth.seed, stroke.key),
                depth: (depths.share(sight.view, vertex.world), self.hatching.depth),
            };
            shares.width(widest)
        };
        // Colour and opacity: light on lines, a pencil's grain, the transfer function.
        let lit = lighting.as_ref().map(|lighting| {
            let view = sight.view;
            let eye = if view.perspective { (view.eye - vertex.world).normalize_or_zero() } else { -view.forward };
            lighting.color(light, eye, *tangent, vertex.normal)
        });
        let (color, mut opacity) = lit.map_or((None, 1.0), |[r, g, b, opacity]| (Some([r, g, b]), opacity));
        if self.hatching.is_pencil {
            let voxel = self.strokes.ground().grid().voxel();
            opacity *= tone(vertex.normal) * grain(growth.seed, stroke.key, vertex.u * length, voxel);
        }
        if let Some(shown) = &self.hatching.visible {
            opacity *= self.strokes.value(vertex.world).map_or(0.0, |value| shown.opacity(value));
        }
        PenState { radius: width / 2.0, opacity, color }
    }

    /// Whether a whole stroke turns away from the eye, so that its own surface hides it. False if another surface hides
    /// it ([HATCH-10]).
    fn turns_away(&self, sight: &Sight<'_>, stroke: &Stroke) -> bool {
        let view = sight.view;
        sight.surface.is_some_and(|surface| Some(surface.iso()) == self.hatching.iso && surface.front(view) > 0.0) && {
            let cone = NormalCone::new(stroke);
            if view.perspective { cone.culled(view.eye) } else { cone.culled_from(-view.forward) }
        }
    }

    /// Draws strokes that keep their distance on the page from others of the same direction.
    fn evenly(
        &self,
        sight: &Sight<'_>,
        apart: LineDistance,
        tone: &(impl Fn(DVec3) -> f64 + Sync),
        counts: &mut Counts,
    ) -> [Vec<Polyline>; 2] {
        let Hatching { growth, pen, cross_pen, .. } = self.hatching;
        let crossed = self.hatching.cross.is_some();
        let by_tone = matches!(apart, LineDistance::Tone { .. });
        let printed = |normal: DVec3| match (by_tone, crossed) {
            (true, true) => crossed_tones(tone(normal)),
            (true, false) => [tone(normal), 0.0],
            (false, _) => [1.0, crossed_tone(tone(normal))],
        };
        let [first, second] = [0, 1].map(|direction| move |normal: DVec3| printed(normal)[direction]);
        let mut even_lines = |along, pen: &Pen, tone: &(dyn Fn(DVec3) -> f64 + Sync)| {
            let margin = DVec2::splat(sight.page.margin);
            let corners = [margin, sight.page.size - margin];
            let mut spread = LineSpacing::new(corners, pen.width, apart, SHORTEST * pen.width);
            let even = self.strokes.evenly(sight, (&self.cells, growth.seed), along, tone, &mut spread);
            add(counts, &even.counts);
            *counts.preprocess.entry("looks for what hides".into()).or_default() += even.looks + even.seen;
            *counts.preprocess.entry("strokes tried".into()).or_default() += even.tried;
            even.lines
        };
        let lines = even_lines(StrokeDirection::First, pen, &first);
        let across = if crossed { even_lines(StrokeDirection::Second, cross_pen, &second) } else { Vec::new() };
        count_kept(counts, &self.strokes);
        [lines, across]
    }
}
