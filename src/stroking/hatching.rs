//! Hatching on the page: grown once ([HATCH-6] … [HATCH-11]), drawn for each camera ([HATCH-13], [HATCH-19]).

use super::{Frame, in_world, on_page, pen, value};
use crate::Failure;
use drypoint_reference::field::Field;
use drypoint_reference::interactive_volume_illustration as room;
use drypoint_reference::shading::towards;
use drypoint_scene::counts::Counts;
use drypoint_scene::glam::DVec3;
use drypoint_scene::marks::{Layer, Page, Pen, Polyline};
use drypoint_scene::math;
use drypoint_scene::strokes::{Stroke, StrokeVertex};
use drypoint_scene::tables::{DirectionRule, Family, Hatching, LightDirection, Reference, Scene, SeedsBy, Spacing};
use std::time::Instant;

/// τ above which strokes are crossed where the tone is in the spacing ([HATCH-19]).
const CROSSED: f64 = 0.6;

/// The faintest tone that spacing gives.
const LEAST: f64 = 0.08;

/// The shortest line on the page, in pen's widths.
const SHORTEST: f64 = 6.0;

/// Strokes of a surface.
pub(super) struct Hatched<'a> {
    table: &'a Hatching,
    light: LightDirection,
    iso: f64,
    pen: Pen,
    /// In mm.
    min_width: f64,
    spacing: Option<room::Apart>,
    strokes: Vec<Stroke>,
    /// With N at their seeds.
    cross: Vec<(DVec3, Stroke)>,
}

impl<'a> Hatched<'a> {
    /// Finds the seeds and grows their strokes.
    pub(super) fn new(
        scene: &'a Scene,
        table: &'a Hatching,
        field: &Field<'_, f64>,
        page: &Page,
        counts: &mut Counts,
    ) -> Result<Self, Failure> {
        let start = Instant::now();
        let iso = value(scene, table.iso, "hatching.iso")?;
        let pen = pen(scene, "hatching", page, table.pen.as_deref(), (table.width, table.color))?;
        let spacing = match table.spacing {
            Spacing::Random => None,
            Spacing::Tone => Some(room::Apart::Tone { least: LEAST }),
            Spacing::Length(length) => Some(room::Apart::Everywhere(on_page(scene, page, length, "hatching.spacing")?)),
        };
        let min_width = on_page(scene, page, table.stroke.min_width, "hatching.stroke.min_width")?;
        let volume = field.volume();
        let pyramid = room::Pyramid::new(volume);
        counts.bytes.insert("pyramid".into(), pyramid.bytes());
        let strokes = room::Strokes::new(field, Some(iso), how(scene, table, field)?);
        let rule = match table.seeds {
            SeedsBy::Dense => room::SeedRule::Dense,
            SeedsBy::Curvature => {
                room::SeedRule::Curvature { min_curvature: table.min_curvature, min_gradient: table.min_gradient }
            }
        };
        let range = match table.seeds {
            SeedsBy::Dense => [0.0; 2],
            SeedsBy::Curvature => {
                let (range, voxels) = room::gradient_range(field, scene.volume.gradient_range);
                *counts.preprocess.entry("gradients".into()).or_default() += voxels;
                range
            }
        };
        let seeds = strokes.seeds(&pyramid, field, iso, rule, (table.measure, range));
        counts.preprocess.insert("measures of seeds".into(), seeds.measured);
        counts.preprocess.insert("pyramid".into(), pyramid.entries());
        counts.seconds.insert("seeds".into(), start.elapsed().as_secs_f64());

        let start = Instant::now();
        let cells: Vec<[usize; 3]> = seeds.draw(table.seed).collect();
        let crossed = table.cross.is_some();
        let grown = strokes.grow_all(&cells, |_| crossed);
        counts.directions += grown.counts.scales.directions() + seeds.measured;
        for (cause, number) in grown.counts.stops.named() {
            *counts.stops.entry(cause.into()).or_default() += number;
        }
        counts.preprocess.insert("seeds".into(), cells.len() as u64);
        counts.preprocess.insert("seeds without a stroke".into(), grown.counts.rejected.total());
        counts.bytes.insert("smoothed bricks".into(), strokes.directions().bytes());
        counts.seconds.insert("grown strokes".into(), start.elapsed().as_secs_f64());
        Ok(Self {
            table,
            light: table.stroke.light.unwrap_or(scene.light),
            iso,
            pen,
            min_width,
            spacing,
            strokes: grown.strokes.into_iter().map(|(_, stroke)| stroke).collect(),
            cross: grown.cross.into_iter().map(|(seed, stroke)| (seed.normal, stroke)).collect(),
        })
    }

    /// The value of the surface that they lie on.
    pub(super) fn iso(&self) -> f64 {
        self.iso
    }

    /// Those that a camera sees.
    pub(super) fn draw(&self, frame: &Frame<'_>, counts: &mut Counts) -> Option<Layer> {
        let light = towards(self.light, frame.view);
        let tone = |normal: DVec3| 1.0 - (self.table.stroke.ambient + normal.dot(light)).clamp(0.0, 1.0);
        let crossed = self.table.cross.is_some();
        let by_tone = self.table.spacing == Spacing::Tone;
        // Of what both families print, 1 − (1 − τ₁)(1 − τ₂) is the tone.
        let first = |tau: f64| if crossed { tau.min(CROSSED) } else { tau };
        let second = |tau: f64| (tau - CROSSED) / (1.0 - CROSSED);
        let mut lines = self.lines(frame, &self.strokes, &tone, first, counts);
        if let Some(angle) = self.table.cross {
            let limit = math::cos(angle.to_radians());
            let chosen = self.cross.iter().filter(|(normal, _)| by_tone || normal.dot(light) < limit);
            let chosen: Vec<Stroke> = chosen.map(|(_, stroke)| stroke.clone()).collect();
            lines.extend(self.lines(frame, &chosen, &tone, second, counts));
        }
        (!lines.is_empty()).then(|| Layer { lines, ..Layer::new(self.pen.clone()) })
    }

    /// The lines of some strokes; `share` is how much of the tone they print.
    fn lines(
        &self,
        frame: &Frame<'_>,
        strokes: &[Stroke],
        tone: &(impl Fn(DVec3) -> f64 + Sync),
        share: impl Fn(f64) -> f64 + Sync,
        counts: &mut Counts,
    ) -> Vec<Polyline> {
        let start = Instant::now();
        let by_tone = self.table.spacing == Spacing::Tone;
        let one_width = self.table.has_one_width();
        let style = self.table.stroke;
        let nib = |stroke: &Stroke, vertex: &StrokeVertex| {
            let opacity = if by_tone { share(tone(vertex.normal)).max(0.0) } else { 1.0 };
            let width = if one_width {
                self.pen.width
            } else {
                let width =
                    self.pen.width * math::pow(tone(vertex.normal), style.tone) * taper(stroke, vertex.u, style.taper);
                if width < self.min_width { 0.0 } else { width }
            };
            room::Pen { radius: width / 2.0, opacity }
        };
        // They lie in front of the surface themselves.
        let seen = frame.sight(0.0).seen(strokes, nib);
        *counts.preprocess.entry("looks for what hides".into()).or_default() += seen.looks;
        *counts.seconds.entry("hidden strokes".into()).or_default() += start.elapsed().as_secs_f64();
        let start = Instant::now();
        let lines = match self.spacing {
            Some(apart) => room::spread(seen.lines, self.pen.width, apart, SHORTEST * self.pen.width),
            None => seen.lines,
        };
        *counts.seconds.entry("spacing of strokes".into()).or_default() += start.elapsed().as_secs_f64();
        lines
    }
}

/// min(1, u/b, (1 − u)/b); 1 on a stroke without ends.
fn taper(stroke: &Stroke, u: f64, b: f64) -> f64 {
    if stroke.closed || b == 0.0 { 1.0 } else { (u / b).min((1.0 - u) / b).clamp(0.0, 1.0) }
}

/// The table in world units.
fn how(scene: &Scene, table: &Hatching, field: &Field<'_, f64>) -> Result<room::Hatching, Failure> {
    let grid = field.volume().grid();
    let length = |length, key: &str| in_world(scene, length, &format!("hatching.{key}"), grid);
    let directions = &table.directions;
    let axis = directions.axis.unwrap_or_else(|| room::longest_axis(grid));
    let center = directions.center.unwrap_or_else(|| grid.centre());
    Ok(room::Hatching {
        length: length(table.length, "length")?,
        cross_length: table.cross_length,
        tolerance: length(table.tolerance, "tolerance")?,
        min_step: length(table.min_step, "min_step")?,
        offset: length(table.offset, "offset")?,
        chord: length(table.chord, "chord")?,
        max_angle: table.max_angle,
        family: match table.family {
            Family::Larger => room::Family::Larger,
            Family::Max => room::Family::Max,
            Family::Min => room::Family::Min,
        },
        rule: match directions.rule {
            DirectionRule::Raw => room::Rule::Raw,
            DirectionRule::Scaled => room::Rule::Scaled(room::Thresholds {
                gap: directions.gap,
                noise: directions.noise,
                agree: directions.agree,
            }),
        },
        reference: match directions.reference {
            Reference::Cylindrical => room::Reference::Cylindrical { axis, center },
            Reference::Axial => room::Reference::Axial { axis },
            Reference::Radial => room::Reference::Radial { center },
        },
    })
}
