//! Hatching on the page: grown once ([HATCH-6] … [HATCH-11]), drawn for each camera ([HATCH-13], [HATCH-19]).

mod draw;
mod gaps;
mod growth_counts;
mod growth_settings;

use super::visible_values::VisibleValues;
use super::{in_world, on_page, pen, value};
use crate::Failure;
use drypoint_reference::field::Field;
use drypoint_reference::interactive_volume_illustration as room;
use drypoint_scene::counts::Counts;
use drypoint_scene::glam::DVec3;
use drypoint_scene::marks::{Layer, Page, Pen, Vertex};
use drypoint_scene::memory;
use drypoint_scene::space::Grid;
use drypoint_scene::strokes::Stroke;
use drypoint_scene::tables::{
    GradientRange, HatchIso, Hatching as Table, Hidden, LightDirection, Scene, SeedsBy, Spacing,
};
use drypoint_scene::transfer::Function;
use drypoint_scene::view::View;
use gaps::cut_gaps;
use growth_counts::{add, count_kept};
use growth_settings::{growth_settings, line_light};
use std::time::Instant;

/// Shortest line on the page, in widths of the pen.
const SHORTEST: f64 = 6.0;

/// Largest distance of chords from their curve on the page, in mm ([HATCH-10]).
const MOST_OFF: f64 = 0.05;

/// Least chord distance and δ, in voxels. An eye inside the volume can make a voxel arbitrarily large on the page.
const FINEST: f64 = 0.01;

/// Bytes of memory, until it is written, for a vertex of a dash. It is in a list that may have grown to twice its need,
/// once more on the way to a file, and in its text.
const DASH_VERTEX: u64 = 5 * size_of::<Vertex>() as u64;

/// Bytes of memory for a node of a table of light on lines.
const TERMS: u64 = 16;

/// Faintest tone that spacing gives.
const LEAST: f64 = 0.08;

/// The most strokes that a distance of lines may ask for: a page of them takes about an hour.
const MOST_STROKES: f64 = 1e6;

/// Settings of hatching for a scene and its page.
pub(super) struct HatchingSetup<'a> {
    table: &'a Table,
    light: LightDirection,
    /// Iso-value of the surface that strokes lie on; none: strokes are where the function shows something.
    pub(super) iso: Option<f64>,
    seen: Option<VisibleValues<'a>>,
    pen: Pen,
    cross_pen: Pen,
    /// Least width, in mm.
    min_width: f64,
    spacing: Option<room::LineDistance>,
    how: room::HatchParams,
    gradient_range: GradientRange,
    lighting: Option<room::LineLight>,
    /// Gap in mm, and the least distance in front of what cuts, in world units.
    gap: Option<[f64; 2]>,
    /// Lengths of dashes and gaps, in mm.
    dash: Option<[f64; 2]>,
    /// Place of the key that gives dashes.
    dash_place: String,
    is_pencil: bool,
    /// Whether strokes are inside the picture of the volume, if there is one.
    pub(super) is_merged: bool,
}

/// Grown strokes of hatching.
pub(super) struct GrownHatching<'a> {
    hatching: &'a HatchingSetup<'a>,
    pub(super) strokes: room::StrokeGrower<'a, 'a>,
    pub(super) cells: Vec<[usize; 3]>,
    /// Strokes of all cells, if they fall as their seeds do.
    grown: Option<GrownStrokes>,
}

/// Strokes of the first direction, and crossing ones with N at their seeds.
struct GrownStrokes {
    first: Vec<Stroke>,
    across: Vec<(DVec3, Stroke)>,
}

/// Checks that lines of a distance and a length in mm, that of a key of `[hatching]`, fill the page with a number of
/// strokes that can be drawn.
fn check_strokes(scene: &Scene, page: &Page, [distance, length]: [f64; 2], key: &str) -> Result<(), Failure> {
    let area = page.picture().x * page.picture().y;
    let strokes = (area / (distance * length)).min(f64::MAX);
    if strokes <= MOST_STROKES {
        return Ok(());
    }
    let what = format!(
        "hatching.{key} puts lines {distance:.1e} mm apart: about {strokes:.1e} strokes on the page, and at most \
         {MOST_STROKES:.0e} are drawn"
    );
    // Two digits round by 5 % at the most.
    let least = 1.06 * area / (MOST_STROKES * length);
    let remedy = format!("make the distance {least:.1e} mm or more");
    Err(Failure::new(what, scene.given.position(&format!("hatching.{key}")), remedy))
}

impl<'a> HatchingSetup<'a> {
    /// Converts the table. `scale` is the largest number of mm on the page a world unit takes.
    pub(super) fn new(
        (scene, function): (&'a Scene, Option<&'a Function>),
        table: &'a Table,
        grid: &Grid,
        (page, scale): (&Page, f64),
        has_picture: bool,
    ) -> Result<Self, Failure> {
        let spacing = match table.spacing {
            Spacing::Random => None,
            Spacing::Tone => Some(room::LineDistance::Tone { least: LEAST }),
            Spacing::Length(length) => {
                Some(room::LineDistance::Everywhere(on_page(scene, page, length, "hatching.spacing")?))
            }
        };
        // Pens: crossing strokes have their own, or the pen of the first direction.
        let ink = (table.width, table.color);
        let cross_pen = match (&table.cross_pen, &table.pen) {
            (Some(named), _) => pen(scene, "hatching.cross_pen", page, Some(named), ink)?,
            (None, Some(named)) => pen(scene, "hatching.pen", page, Some(named), ink)?,
            (None, None) => Pen { name: "cross".into(), ..pen(scene, "hatching", page, None, ink)? },
        };
        let pen = pen(scene, "hatching", page, table.pen.as_deref(), ink)?;
        // The surface that strokes lie on, or the values at which the function shows something.
        let (iso, seen) = match table.iso {
            HatchIso::Surface(iso) => (Some(value(scene, iso, "hatching.iso")?), None),
            HatchIso::Transfer => (None, Some(VisibleValues::new(scene, function)?)),
        };
        // Tolerances follow from the page: the finest details that it can show.
        let mut how = growth_settings(scene, table, grid)?;
        let finest = FINEST * grid.voxel();
        how.chord = how.chord.min((MOST_OFF / scale).max(finest));
        how.offset = how.offset.min((0.5 * pen.width / scale).max(finest));
        // The number of strokes follows from their distance and their length on the page.
        let distance = match spacing {
            Some(room::LineDistance::Everywhere(distance)) => Some((distance, "spacing")),
            Some(room::LineDistance::Tone { .. }) => Some((pen.width, table.pen.as_ref().map_or("width", |_| "pen"))),
            None => None,
        };
        if let Some((distance, key)) = distance {
            let length = (how.length * scale).min(page.size.length()).max(SHORTEST * pen.width);
            check_strokes(scene, page, [distance, length], key)?;
        }
        // Gaps, the table of light, and dashes, each checked.
        let deeper = in_world(scene, table.gap_depth, "hatching.gap_depth", grid)?;
        let gap = table.gap.map(|gap| on_page(scene, page, gap, "hatching.gap")).transpose()?;
        if let Some(side) = table.lighting(scene).and_then(|lighting| lighting.table) {
            memory::room_for(side as u64 * side as u64, TERMS).map_err(|no_room| {
                let what = format!("a table of {side} × {side} terms of light needs {no_room}");
                let remedy = format!("{} would fit", no_room.fitting_size([side; 2])[0]);
                Failure::new(what, scene.given.position("hatching.lighting.table"), remedy)
            })?;
        }
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
            dash_place: scene.given.position("hatching.stroke.dash"),
            is_pencil: table.is_pencil(scene),
            is_merged: has_picture && table.is_merged(scene),
        })
    }

    /// Cuts gaps into the lines of the first `own` layers where nearer lines of any layer cross them ([HATCH-20]), then
    /// dashes.
    ///
    /// # Errors
    /// Dashes that the memory budget does not allow.
    pub(super) fn cut(
        &self,
        layers: &mut [Layer],
        own: usize,
        view: &View,
        counts: &mut Counts,
    ) -> Result<(), Failure> {
        if let Some(gap) = self.gap {
            cut_gaps(gap, layers, own, view, counts);
        }
        let Some(dash) = self.dash else { return Ok(()) };
        let vertices: f64 = layers.iter().take(own).map(|layer| room::dash_vertices(&layer.lines, dash)).sum();
        memory::room_for(vertices as u64, DASH_VERTEX).map_err(|no_room| {
            let what = format!("dashes with {vertices:.1e} ends and bends need {no_room}");
            let remedy = match no_room.enlarged(dash[0] + dash[1]) {
                Some(length) => format!("make a dash and its gap longer: together {length} mm would fit"),
                None => "make a dash and its gap longer, or leave hatching.stroke.dash out".into(),
            };
            Failure::new(what, self.dash_place.clone(), remedy)
        })?;
        layers.iter_mut().take(own).for_each(|layer| layer.lines = room::dashed(&layer.lines, dash));
        Ok(())
    }

    /// Whether hidden parts of strokes are cut off.
    pub(super) fn is_cut(&self) -> bool {
        match self.table.hidden {
            Hidden::Cut => true,
            Hidden::Merged => !self.is_merged,
            Hidden::Drawn => false,
        }
    }

    /// Finds the seeds, and grows their strokes if no camera decides which grow.
    pub(super) fn grow(&'a self, field: &'a Field<'_, f64>, counts: &mut Counts) -> GrownHatching<'a> {
        let (pyramid, strokes) = self.strokes(field, counts);
        strokes.prepare();
        let pyramid = match self.table.seeds {
            SeedsBy::Curvature => strokes.with_curvature(pyramid, self.table.measure),
            SeedsBy::Dense => pyramid,
        };
        counts.bytes.insert("pyramid".into(), pyramid.bytes());
        let seeds = self.seeds_of(&pyramid, &strokes, field, counts);
        let table = self.table;
        let mut cells: Vec<[usize; 3]> = seeds.draw(table.seed).collect();
        counts.preprocess.insert("seeds".into(), cells.len() as u64);
        if let Some(shown) = &self.seen {
            // A stroke stays at the value of its seed. If that value is invisible, so is the whole stroke.
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
            GrownStrokes {
                first: grown.strokes.into_iter().map(|(_, stroke)| stroke).collect(),
                across: grown.cross.into_iter().map(|(seed, stroke)| (seed.normal, stroke)).collect(),
            }
        });
        count_kept(counts, &strokes);
        counts.seconds.insert("grown strokes".into(), start.elapsed().as_secs_f64());
        GrownHatching { hatching: self, strokes, cells, grown }
    }

    /// Returns the cells that strokes can begin in.
    pub(super) fn seeds(&self, field: &Field<'_, f64>, counts: &mut Counts) -> room::Seeds {
        let (pyramid, strokes) = self.strokes(field, counts);
        self.seeds_of(&pyramid, &strokes, field, counts)
    }

    /// Returns the pyramid that finds cells of the surface, and the strokes that grow there, with the noise of the data
    /// near the surface ([HATCH-3]).
    fn strokes<'f, 'v>(
        &self,
        field: &'f Field<'v, f64>,
        counts: &mut Counts,
    ) -> (room::Pyramid, room::StrokeGrower<'f, 'v>) {
        let pyramid = room::Pyramid::new(field.volume());
        counts.bytes.insert("pyramid".into(), pyramid.bytes());
        counts.preprocess.insert("pyramid".into(), pyramid.entries());
        let mut how = self.how;
        if let (room::DirectionEstimator::Scaled(thresholds), None, Some(iso)) =
            (&mut how.rule, self.table.directions.deviation, self.iso)
        {
            thresholds.deviation = room::deviation(field.volume(), &pyramid, iso, field.reconstruction().outside);
        }
        (pyramid, room::StrokeGrower::new(field, self.iso, how))
    }

    fn seeds_of(
        &self,
        pyramid: &room::Pyramid,
        strokes: &room::StrokeGrower<'_, '_>,
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
