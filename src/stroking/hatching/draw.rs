//! Drawing of hatching for a camera: as strokes fall ([HATCH-13]), or evenly on the page ([HATCH-19]).

use super::growth_counts::{add, count_kept};
use super::{GrownHatching, GrownStrokes, HatchingSetup, SHORTEST};
use crate::stroking::StrokeCamera;
use drypoint_reference::interactive_volume_illustration as room;
use drypoint_scene::counts::Counts;
use drypoint_scene::glam::{DVec2, DVec3};
use drypoint_scene::marks::{Layer, Pen, Polyline};
use drypoint_scene::math;
use drypoint_scene::parallel;
use drypoint_scene::philox::uniform;
use drypoint_scene::space::Grid;
use drypoint_scene::strokes::Stroke;
use drypoint_scene::tables::{Hatching as Table, Spacing};
use drypoint_scene::view::View;
use std::time::Instant;

/// τ above which strokes are crossed if the tone is in the spacing ([HATCH-19]).
const CROSSED: f64 = 0.6;

/// Size of a pencil's grain on paper, in voxels.
const GRAIN: f64 = 0.4;

impl GrownHatching<'_> {
    /// Returns the strokes that a camera sees. Crossing strokes are a layer of their own.
    pub(in crate::stroking) fn draw(&self, frame: &StrokeCamera<'_>, counts: &mut Counts) -> Vec<Layer> {
        let HatchingSetup { table, pen, cross_pen, spacing, .. } = self.hatching;
        let start = Instant::now();
        let light = frame.view.towards(self.hatching.light);
        let tone = |normal: DVec3| 1.0 - (table.stroke.ambient + normal.dot(light)).clamp(0.0, 1.0);
        // Strokes lie in front of the surface themselves.
        let sight = frame.sight(0.0);
        let [lines, across] = match (&self.grown, *spacing) {
            (Some(grown), _) => self.as_they_fall(&sight, grown, light, &tone, counts),
            (None, Some(apart)) => self.evenly(&sight, apart, &tone, counts),
            (None, None) => Default::default(),
        };
        *counts.seconds.entry("hatching".into()).or_default() += start.elapsed().as_secs_f64();
        let crossed = table.cross.map(|_| Layer { lines: across, ..Layer::new(cross_pen.clone()) });
        std::iter::once(Layer { lines, ..Layer::new(pen.clone()) }).chain(crossed).collect()
    }

    /// Draws all strokes as `[hatching.stroke]` says, and crossing ones where the light falls flatly enough. If hidden
    /// strokes are drawn, too, and colours tell near from far, both are sorted by depth together.
    fn as_they_fall(
        &self,
        sight: &room::Sight<'_>,
        grown: &GrownStrokes,
        light: DVec3,
        tone: &(impl Fn(DVec3) -> f64 + Sync),
        counts: &mut Counts,
    ) -> [Vec<Polyline>; 2] {
        let HatchingSetup { table, pen, cross_pen, .. } = self.hatching;
        let may_be_seen = |stroke: &&Stroke| !self.turns_away(sight, stroke);
        // Strokes that may be seen. Crossing ones need flat light at their seeds.
        let mut first: Vec<&Stroke> = grown.first.iter().filter(may_be_seen).collect();
        let mut across: Vec<&Stroke> = table.cross.map_or_else(Vec::new, |angle| {
            let limit = math::cos(angle.to_radians());
            let flat = grown.across.iter().filter(|(normal, _)| normal.dot(light) < limit).map(|(_, stroke)| stroke);
            flat.filter(may_be_seen).collect()
        });
        let by_depth = self.hatching.lighting.is_some() && !self.hatching.is_cut();
        if by_depth {
            first.append(&mut across);
        }
        // Each direction in its pen: style along the stroke, then hidden parts cut off.
        let depths = Depths::new(sight.view, self.strokes.ground().grid());
        let one_width = [table.has_one_width(), table.has_one_width() || table.cross_pen.is_some()];
        let inks = [pen, cross_pen].into_iter().zip(one_width).map(|(pen, one)| (pen.width, one));
        let mut lines = inks.zip([first, across]).map(|(ink, strokes)| {
            let least = if ink.1 { 0.0 } else { 0.5 * self.hatching.min_width };
            let draw = |stroke: &&Stroke| {
                let length = if self.hatching.is_pencil { stroke.length() } else { 0.0 };
                let made = (*stroke, length, ink);
                room::drawn(stroke, least, |place| self.pen(sight, made, place, (light, depths), tone))
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
        sight: &room::Sight<'_>,
        (stroke, length, (widest, one_width)): (&Stroke, f64, (f64, bool)),
        room::StrokePoint { vertex, tangent }: &room::StrokePoint,
        (light, depths): (DVec3, Depths),
        tone: &impl Fn(DVec3) -> f64,
    ) -> room::PenState {
        let HatchingSetup { table, lighting, .. } = self.hatching;
        let width = if one_width {
            widest
        } else {
            let tapered =
                widest * math::pow(tone(vertex.normal), table.tone()) * taper(stroke, vertex.u, table.taper());
            tapered * self.scattered(stroke) * (1.0 - table.stroke.depth * depths.share(sight.view, vertex.world))
        };
        // Colour and opacity: light on lines, a pencil's grain, the transfer function.
        let lit = lighting.as_ref().map(|lighting| {
            let view = sight.view;
            let eye = if view.perspective { (view.eye - vertex.world).normalize_or_zero() } else { -view.forward };
            lighting.color(light, eye, *tangent, vertex.normal)
        });
        let (color, mut opacity) = lit.map_or((None, 1.0), |[r, g, b, opacity]| (Some([r, g, b]), opacity));
        if self.hatching.is_pencil {
            let grains = vertex.u * length / (GRAIN * self.strokes.ground().grid().voxel());
            opacity *= tone(vertex.normal) * room::grain(table.seed, stroke.key, grains);
        }
        if let Some(shown) = &self.hatching.seen {
            opacity *= self.strokes.value(vertex.world).map_or(0.0, |value| shown.opacity(value));
        }
        room::PenState { radius: width / 2.0, opacity, color }
    }

    /// Returns the random factor of a stroke's width, 1 ± jitter.
    fn scattered(&self, stroke: &Stroke) -> f64 {
        let Table { stroke: style, seed, .. } = self.hatching.table;
        let key = [stroke.key as u32, (stroke.key >> 32) as u32, 0];
        if style.jitter == 0.0 { 1.0 } else { 1.0 + style.jitter * (2.0 * uniform(*seed, key, 3) - 1.0) }
    }

    /// Whether a whole stroke turns away from the eye, so that its own surface hides it. False if another surface hides
    /// it ([HATCH-10]).
    fn turns_away(&self, sight: &room::Sight<'_>, stroke: &Stroke) -> bool {
        let view = sight.view;
        sight.surface.is_some_and(|surface| Some(surface.iso()) == self.hatching.iso && surface.front(view) > 0.0) && {
            let cone = room::NormalCone::new(stroke);
            if view.perspective { cone.culled(view.eye) } else { cone.culled_from(-view.forward) }
        }
    }

    /// Draws strokes that keep their distance on the page from others of the same direction.
    fn evenly(
        &self,
        sight: &room::Sight<'_>,
        apart: room::LineDistance,
        tone: &(impl Fn(DVec3) -> f64 + Sync),
        counts: &mut Counts,
    ) -> [Vec<Polyline>; 2] {
        let HatchingSetup { table, pen, cross_pen, .. } = self.hatching;
        let crossed = table.cross.is_some();
        let by_tone = table.spacing == Spacing::Tone;
        // Both directions together print 1 − (1 − τ₁)(1 − τ₂), which is the tone. With a constant distance the second
        // direction begins at the same tone.
        let first = |normal: DVec3| match (by_tone, crossed) {
            (true, true) => tone(normal).min(CROSSED),
            (true, false) => tone(normal),
            (false, _) => 1.0,
        };
        let second = |normal: DVec3| {
            if by_tone { (tone(normal) - CROSSED) / (1.0 - CROSSED) } else { f64::from(tone(normal) > CROSSED) }
        };
        let mut even_lines = |along, pen: &Pen, tone: &(dyn Fn(DVec3) -> f64 + Sync)| {
            let margin = DVec2::splat(sight.page.margin);
            let corners = [margin, sight.page.size - margin];
            let mut spread = room::LineSpacing::new(corners, pen.width, apart, SHORTEST * pen.width);
            let even = self.strokes.evenly(sight, (&self.cells, table.seed), along, tone, &mut spread);
            add(counts, &even.counts);
            *counts.preprocess.entry("looks for what hides".into()).or_default() += even.looks + even.seen;
            *counts.preprocess.entry("strokes tried".into()).or_default() += even.tried;
            even.lines
        };
        let lines = even_lines(room::StrokeDirection::First, pen, &first);
        let across = if crossed { even_lines(room::StrokeDirection::Second, cross_pen, &second) } else { Vec::new() };
        count_kept(counts, &self.strokes);
        [lines, across]
    }
}

/// Depths of the nearest and the farthest corner of a volume.
#[derive(Clone, Copy)]
struct Depths([f64; 2]);

impl Depths {
    fn new(view: &View, grid: &Grid) -> Self {
        let last = grid.dims().map(|n| n as f64 - 1.0);
        let corner =
            |i: usize| DVec3::from_array(std::array::from_fn(|axis| if i >> axis & 1 == 1 { last[axis] } else { 0.0 }));
        let depths = (0..8).map(|i| -view.to_eye(grid.to_world(corner(i))).z);
        Self(depths.fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], depth| [lo.min(depth), hi.max(depth)]))
    }

    /// Returns the relative depth: 0 at the nearest corner, 1 at the farthest.
    fn share(&self, view: &View, world: DVec3) -> f64 {
        let [near, far] = self.0;
        if far > near { ((-view.to_eye(world).z - near) / (far - near)).clamp(0.0, 1.0) } else { 0.0 }
    }
}

/// Returns the taper min(1, u/b, (1 − u)/b), and 1 on a stroke without ends.
fn taper(stroke: &Stroke, u: f64, b: f64) -> f64 {
    if stroke.closed || b == 0.0 { 1.0 } else { (u / b).min((1.0 - u) / b).clamp(0.0, 1.0) }
}
