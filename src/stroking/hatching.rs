//! Hatching on the page: grown once ([HATCH-6] … [HATCH-11]), drawn for each camera ([HATCH-13], [HATCH-19]).

use super::shown::Shown;
use super::{Frame, in_world, on_page, pen, value};
use crate::Failure;
use drypoint_reference::field::Field;
use drypoint_reference::interactive_volume_illustration as room;
use drypoint_reference::shading::towards;
use drypoint_scene::counts::Counts;
use drypoint_scene::glam::{DVec2, DVec3};
use drypoint_scene::marks::{Layer, Page, Pen, Polyline};
use drypoint_scene::math;
use drypoint_scene::philox::uniform;
use drypoint_scene::space::Grid;
use drypoint_scene::strokes::Stroke;
use drypoint_scene::tables::{
    DirectionRule, DirectionSource, Family, GradientRange, HatchIso, Hatching as Table, Hidden, Interpolate,
    LightDirection, LineLighting, Reference, Scene, SeedsBy, Spacing, StoredAt,
};
use drypoint_scene::transfer::Function;
use drypoint_scene::view::View;
use rayon::prelude::*;
use std::time::Instant;

/// τ above which strokes are crossed where the tone is in the spacing ([HATCH-19]).
const CROSSED: f64 = 0.6;

/// How far chords may be off on the page, in mm ([HATCH-10]).
const MOST_OFF: f64 = 0.05;

/// In voxels, what the page's measures leave chords and δ at the least: from an eye inside the volume a voxel is as large as
/// one likes.
const FINEST: f64 = 0.01;

/// The least `chord`, in voxels: the vertices of a stroke grow with 1/√c, and a default one has some 600 there.
const LEAST_CHORD: f64 = 1e-4;

/// The faintest tone that spacing gives.
const LEAST: f64 = 0.08;

/// A grain of pencil on paper, in voxels.
const GRAIN: f64 = 0.4;

/// The shortest line on the page, in pen's widths.
const SHORTEST: f64 = 6.0;

/// What hatching is made by.
pub(super) struct Hatching<'a> {
    table: &'a Table,
    light: LightDirection,
    /// Of the surface that strokes lie on; none: they are where the function shows something.
    iso: Option<f64>,
    seen: Option<Shown<'a>>,
    pen: Pen,
    cross_pen: Pen,
    /// In mm.
    min_width: f64,
    spacing: Option<room::Apart>,
    how: room::Hatching,
    gradient_range: GradientRange,
    lighting: Option<room::LineLight>,
    /// In mm, and how much nearer what cuts is, in world units.
    gap: Option<[f64; 2]>,
    /// On and off, in mm.
    dash: Option<[f64; 2]>,
    is_pencil: bool,
    is_merged: bool,
}

/// The strokes of a surface.
pub(super) struct Hatched<'a> {
    hatching: &'a Hatching<'a>,
    pub(super) strokes: room::Strokes<'a, 'a>,
    pub(super) cells: Vec<[usize; 3]>,
    /// Of all cells, where they fall as their seeds do: the first, and those that cross, with N at their seeds.
    grown: Option<Grown>,
}

struct Grown {
    first: Vec<Stroke>,
    across: Vec<(DVec3, Stroke)>,
}

impl<'a> Hatching<'a> {
    /// `scale` is the most millimetres of the page that a world unit takes.
    pub(super) fn new(
        (scene, function): (&'a Scene, Option<&'a Function>),
        table: &'a Table,
        grid: &Grid,
        (page, scale): (&Page, f64),
        has_picture: bool,
    ) -> Result<Self, Failure> {
        let spacing = match table.spacing {
            Spacing::Random => None,
            Spacing::Tone => Some(room::Apart::Tone { least: LEAST }),
            Spacing::Length(length) => Some(room::Apart::Everywhere(on_page(scene, page, length, "hatching.spacing")?)),
        };
        let ink = (table.width, table.color);
        let cross_pen = match (&table.cross_pen, &table.pen) {
            (Some(named), _) => pen(scene, "hatching.cross_pen", page, Some(named), ink)?,
            (None, Some(named)) => pen(scene, "hatching.pen", page, Some(named), ink)?,
            (None, None) => Pen { name: "cross".into(), ..pen(scene, "hatching", page, None, ink)? },
        };
        let pen = pen(scene, "hatching", page, table.pen.as_deref(), ink)?;
        let (iso, seen) = match table.iso {
            HatchIso::Surface(iso) => (Some(value(scene, iso, "hatching.iso")?), None),
            HatchIso::Transfer => (None, Some(Shown::new(scene, function)?)),
        };
        let mut how = how(scene, table, grid)?;
        let finest = FINEST * grid.voxel();
        how.chord = how.chord.min((MOST_OFF / scale).max(finest));
        how.offset = how.offset.min((0.5 * pen.width / scale).max(finest));
        let deeper = in_world(scene, table.gap_depth, "hatching.gap_depth", grid)?;
        let gap = table.gap.map(|gap| on_page(scene, page, gap, "hatching.gap")).transpose()?;
        let dash = match table.stroke.dash {
            Some([on, off]) => {
                let length = |length| on_page(scene, page, length, "hatching.stroke.dash");
                Some([length(on)?, length(off)?])
            }
            None => None,
        };
        Ok(Self {
            table,
            light: table.stroke.light.unwrap_or(scene.light),
            iso,
            seen,
            pen,
            cross_pen,
            min_width: on_page(scene, page, table.stroke.min_width, "hatching.stroke.min_width")?,
            spacing,
            how,
            gradient_range: scene.volume.gradient_range,
            lighting: table.lighting(scene).map(|lighting| line_light(&lighting)),
            gap: gap.map(|gap| [gap, deeper]),
            dash,
            is_pencil: table.is_pencil(scene),
            is_merged: has_picture && table.is_merged(scene),
        })
    }

    /// The value of the surface that strokes lie on, where they lie on one.
    pub(super) fn iso(&self) -> Option<f64> {
        self.iso
    }

    /// The lines of its `own` first layers with gaps where nearer ones of any layer cross them ([HATCH-20]), and in dashes.
    pub(super) fn cut(&self, layers: &mut [Layer], own: usize, view: &View, counts: &mut Counts) {
        if let Some(gap) = self.gap {
            cut_gaps(gap, layers, own, view, counts);
        }
        if let Some(dash) = self.dash {
            layers.iter_mut().take(own).for_each(|layer| layer.lines = room::dashed(&layer.lines, dash));
        }
    }

    /// Whether what is hidden of strokes is cut off.
    pub(super) fn is_cut(&self) -> bool {
        match self.table.hidden {
            Hidden::Cut => true,
            Hidden::Merged => !self.is_merged,
            Hidden::Drawn => false,
        }
    }

    /// Whether strokes are inside the picture of the volume, where there is one.
    pub(super) fn is_merged(&self) -> bool {
        self.is_merged
    }

    /// Finds the seeds, and grows their strokes where no camera has a say in which.
    pub(super) fn grow(&'a self, field: &'a Field<'_, f64>, counts: &mut Counts) -> Hatched<'a> {
        let (pyramid, strokes) = self.strokes(field, counts);
        strokes.prepare();
        let seeds = self.seeds_of(&pyramid, &strokes, field, counts);
        let table = self.table;
        let mut cells: Vec<[usize; 3]> = seeds.draw(table.seed).collect();
        counts.preprocess.insert("seeds".into(), cells.len() as u64);
        if let Some(shown) = &self.seen {
            // A stroke stays at the value of its seed: from one that is not seen all of it is transparent.
            let drawn = cells.len();
            cells.retain(|cell| {
                let centre = field.volume().grid().to_world(DVec3::from_array(cell.map(|i| i as f64 + 0.5)));
                strokes.value(centre).is_some_and(|value| shown.opacity(value) > 0.0)
            });
            counts.preprocess.insert("seeds at values that nothing shows".into(), (drawn - cells.len()) as u64);
        }

        let start = Instant::now();
        let grown = self.spacing.is_none().then(|| {
            let crossed = table.cross.is_some();
            let grown = strokes.grow_all(&cells, |_| crossed);
            add(counts, &grown.counts);
            Grown {
                first: grown.strokes.into_iter().map(|(_, stroke)| stroke).collect(),
                across: grown.cross.into_iter().map(|(seed, stroke)| (seed.normal, stroke)).collect(),
            }
        });
        count_kept(counts, &strokes);
        counts.seconds.insert("grown strokes".into(), start.elapsed().as_secs_f64());
        Hatched { hatching: self, strokes, cells, grown }
    }

    /// The cells that strokes can begin in.
    pub(super) fn seeds(&self, field: &Field<'_, f64>, counts: &mut Counts) -> room::Seeds {
        let (pyramid, strokes) = self.strokes(field, counts);
        self.seeds_of(&pyramid, &strokes, field, counts)
    }

    /// The way to the cells of the surface, and what grows there, with the noise of the data as it is there ([HATCH-3]).
    fn strokes<'f, 'v>(
        &self,
        field: &'f Field<'v, f64>,
        counts: &mut Counts,
    ) -> (room::Pyramid, room::Strokes<'f, 'v>) {
        let pyramid = room::Pyramid::new(field.volume());
        counts.bytes.insert("pyramid".into(), pyramid.bytes());
        counts.preprocess.insert("pyramid".into(), pyramid.entries());
        let mut how = self.how;
        if let (room::Rule::Scaled(thresholds), None, Some(iso)) =
            (&mut how.rule, self.table.directions.deviation, self.iso)
        {
            thresholds.deviation = room::deviation(field.volume(), &pyramid, iso, field.reconstruction().outside);
        }
        (pyramid, room::Strokes::new(field, self.iso, how))
    }

    fn seeds_of(
        &self,
        pyramid: &room::Pyramid,
        strokes: &room::Strokes<'_, '_>,
        field: &Field<'_, f64>,
        counts: &mut Counts,
    ) -> room::Seeds {
        let start = Instant::now();
        let table = self.table;
        let (rule, range) = match table.seeds {
            SeedsBy::Dense => (room::SeedRule::Dense, [0.0; 2]),
            SeedsBy::Curvature => {
                let (range, voxels) = room::gradient_range(field, self.gradient_range);
                *counts.preprocess.entry("gradients".into()).or_default() += voxels;
                let (min_curvature, min_gradient) = (table.min_curvature, table.min_gradient);
                (room::SeedRule::Curvature { min_curvature, min_gradient }, range)
            }
        };
        let by = (table.measure, range);
        let seeds = match (self.iso, &self.seen) {
            (Some(iso), _) => strokes.seeds(pyramid, field, iso, rule, by),
            (None, Some(shown)) => strokes.seeds_among(pyramid, field, |range| shown.has(range), rule, by),
            (None, None) => room::Seeds::default(),
        };
        counts.preprocess.insert("measures of seeds".into(), seeds.measured);
        counts.seconds.insert("seeds".into(), start.elapsed().as_secs_f64());
        seeds
    }
}

impl Hatched<'_> {
    /// Those that a camera sees, and where some cross the others those as a layer of their own.
    pub(super) fn draw(&self, frame: &Frame<'_>, counts: &mut Counts) -> Vec<Layer> {
        let Hatching { table, pen, cross_pen, spacing, .. } = self.hatching;
        let start = Instant::now();
        let light = towards(self.hatching.light, frame.view);
        let tone = |normal: DVec3| 1.0 - (table.stroke.ambient + normal.dot(light)).clamp(0.0, 1.0);
        // They lie in front of the surface themselves.
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

    /// All strokes, drawn as `[hatching.stroke]` says, and those that cross, where the light falls flatly enough; where all
    /// are seen and their colours tell near from far, together.
    fn as_they_fall(
        &self,
        sight: &room::Sight<'_>,
        grown: &Grown,
        light: DVec3,
        tone: &(impl Fn(DVec3) -> f64 + Sync),
        counts: &mut Counts,
    ) -> [Vec<Polyline>; 2] {
        let Hatching { table, pen, cross_pen, .. } = self.hatching;
        let may_be_seen = |stroke: &&Stroke| !self.turns_away(sight, stroke);
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
            let drawn: Vec<room::Drawn> = strokes.par_iter().flat_map_iter(draw).collect();
            let mut seen = sight.seen_drawn(&drawn);
            if by_depth {
                sight.far_to_near(&mut seen.lines);
            }
            *counts.preprocess.entry("looks for what hides".into()).or_default() += seen.looks;
            seen.lines
        });
        [lines.next().unwrap_or_default(), lines.next().unwrap_or_default()]
    }

    /// What a stroke is drawn with at a place.
    fn pen(
        &self,
        sight: &room::Sight<'_>,
        (stroke, length, (widest, one_width)): (&Stroke, f64, (f64, bool)),
        room::Place { vertex, tangent }: &room::Place,
        (light, depths): (DVec3, Depths),
        tone: &impl Fn(DVec3) -> f64,
    ) -> room::Pen {
        let Hatching { table, lighting, .. } = self.hatching;
        let width = if one_width {
            widest
        } else {
            let tapered =
                widest * math::pow(tone(vertex.normal), table.tone()) * taper(stroke, vertex.u, table.taper());
            tapered * self.scattered(stroke) * (1.0 - table.stroke.depth * depths.share(sight.view, vertex.world))
        };
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
        room::Pen { radius: width / 2.0, opacity, color }
    }

    /// What the width of a stroke is multiplied by: 1 ± jitter.
    fn scattered(&self, stroke: &Stroke) -> f64 {
        let Table { stroke: style, seed, .. } = self.hatching.table;
        let key = [stroke.key as u32, (stroke.key >> 32) as u32, 0];
        if style.jitter == 0.0 { 1.0 } else { 1.0 + style.jitter * (2.0 * uniform(*seed, key, 3) - 1.0) }
    }

    /// Whether all of a stroke turns away from the eye, so that its own surface hides it; unknown where another one hides
    /// ([HATCH-10]).
    fn turns_away(&self, sight: &room::Sight<'_>, stroke: &Stroke) -> bool {
        let view = sight.view;
        sight.surface.is_some_and(|surface| Some(surface.iso()) == self.hatching.iso && surface.front(view) > 0.0) && {
            let cone = room::NormalCone::new(stroke);
            if view.perspective { cone.culled(view.eye) } else { cone.culled_from(-view.forward) }
        }
    }

    /// Strokes that keep their distance on the page, those of each direction among themselves.
    fn evenly(
        &self,
        sight: &room::Sight<'_>,
        apart: room::Apart,
        tone: &(impl Fn(DVec3) -> f64 + Sync),
        counts: &mut Counts,
    ) -> [Vec<Polyline>; 2] {
        let Hatching { table, pen, cross_pen, .. } = self.hatching;
        let crossed = table.cross.is_some();
        let by_tone = table.spacing == Spacing::Tone;
        // Of what both print together 1 − (1 − τ₁)(1 − τ₂) is the tone. Where the distance is the same everywhere the second
        // begins at the same tone.
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
            let mut spread = room::Spread::new(corners, pen.width, apart, SHORTEST * pen.width);
            let even = self.strokes.evenly(sight, (&self.cells, table.seed), along, tone, &mut spread);
            add(counts, &even.counts);
            *counts.preprocess.entry("looks for what hides".into()).or_default() += even.looks + even.seen;
            *counts.preprocess.entry("strokes tried".into()).or_default() += even.tried;
            even.lines
        };
        let lines = even_lines(room::Along::First, pen, &first);
        let across = if crossed { even_lines(room::Along::Across, cross_pen, &second) } else { Vec::new() };
        count_kept(counts, &self.strokes);
        [lines, across]
    }
}

/// The depths of the nearest and the farthest corner of a volume.
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

    /// 0 at the nearest, 1 at the farthest.
    fn share(&self, view: &View, world: DVec3) -> f64 {
        let [near, far] = self.0;
        if far > near { ((-view.to_eye(world).z - near) / (far - near)).clamp(0.0, 1.0) } else { 0.0 }
    }
}

/// What strokes keep of the directions that they asked for.
fn count_kept(counts: &mut Counts, strokes: &room::Strokes<'_, '_>) {
    let [made, bytes] = strokes.stored();
    counts.preprocess.insert("stored directions".into(), made);
    counts.bytes.insert("stored directions".into(), bytes);
    counts.bytes.insert("smoothed bricks".into(), strokes.directions().bytes());
}

/// Adds what growing did.
fn add(counts: &mut Counts, grown: &room::HatchCounts) {
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

/// The lines of the `own` first layers without what is near a line in front of them, all as they were before any was cut.
fn cut_gaps([gap, deeper]: [f64; 2], layers: &mut [Layer], own: usize, view: &View, counts: &mut Counts) {
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

/// The table's light on lines.
fn line_light(table: &LineLighting) -> room::LineLight {
    room::LineLight {
        diffuse: table.diffuse,
        p: table.p,
        specular: table.specular,
        s: table.s,
        front: table.front,
        back: table.back,
        self_shadow: table.self_shadow,
        table: table.table.map(|side| room::TermsTable::new(side, table.p, table.s)),
    }
}

/// min(1, u/b, (1 − u)/b); 1 on a stroke without ends.
fn taper(stroke: &Stroke, u: f64, b: f64) -> f64 {
    if stroke.closed || b == 0.0 { 1.0 } else { (u / b).min((1.0 - u) / b).clamp(0.0, 1.0) }
}

/// The table in world units.
fn how(scene: &Scene, table: &Table, grid: &Grid) -> Result<room::Hatching, Failure> {
    let length = |length, key: &str| in_world(scene, length, &format!("hatching.{key}"), grid);
    let directions = &table.directions;
    let chord = length(table.chord, "chord")?;
    if chord < LEAST_CHORD * grid.voxel() {
        let what = format!("hatching.chord is below {LEAST_CHORD} voxels, where strokes have no end of vertices");
        let place = scene.given.position("hatching.chord");
        return Err(Failure::new(what, place, format!("write \"{LEAST_CHORD} voxels\" or more")));
    }
    let axis = directions.axis.unwrap_or_else(|| room::longest_axis(grid));
    let center = directions.center.unwrap_or_else(|| grid.centre());
    Ok(room::Hatching {
        length: length(table.length, "length")?,
        cross_length: table.cross_length,
        jitter: table.stroke.jitter,
        seed: table.seed,
        tolerance: length(table.tolerance, "tolerance")?,
        min_step: length(table.min_step, "min_step")?,
        offset: length(table.offset, "offset")?,
        chord,
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
                deviation: directions.deviation.unwrap_or(0.0),
                agree: directions.agree,
            }),
        },
        stored: (directions.from == DirectionSource::Stored).then_some(room::Storing {
            between: match directions.interpolate {
                Interpolate::Tensor => room::Between::Tensor,
                Interpolate::Flipped => room::Between::Flipped,
            },
            all: directions.grid == StoredAt::All,
        }),
        reference: match directions.reference {
            Reference::Cylindrical => room::Reference::Cylindrical { axis, center },
            Reference::Axial => room::Reference::Axial { axis },
            Reference::Radial => room::Reference::Radial { center },
        },
    })
}
