//! The table `[hatching]` of a scene with its page: what hatching draws ([HATCH-6] … [HATCH-13]), and the gaps and dashes
//! that are cut into its lines ([HATCH-20]).

use super::growth::{growth_settings, line_light};
use super::lengths::{in_world, on_page, pen, value};
use crate::Failure;
use drypoint_reference::field::Field;
use drypoint_reference::interactive_volume_illustration as room;
use drypoint_scene::counts::Counts;
use drypoint_scene::marks::{Layer, Page, Pen, Vertex};
use drypoint_scene::memory;
use drypoint_scene::space::Grid;
use drypoint_scene::tables::{DirectionRule, HatchIso, Hatching as Table, Hidden, Scene, SeedsBy, Spacing};
use drypoint_scene::transfer::Function;
use drypoint_scene::view::View;
use std::time::Instant;

/// Bytes of memory, until it is written, for a vertex of a dash. It is in a list that may have grown to twice its need,
/// once more on the way to a file, and in its text.
const DASH_VERTEX: u64 = 5 * size_of::<Vertex>() as u64;

/// Bytes of memory for a node of a table of light on lines.
const TERMS: u64 = 16;

/// Faintest tone that spacing gives.
const LEAST: f64 = 0.08;

/// The most strokes that a distance of lines may ask for: a page of them takes about an hour.
const MOST_STROKES: f64 = 1e6;

/// Hatching of a scene on its page.
pub(super) struct HatchingSetup<'a> {
    pub(super) hatching: room::Hatching<'a>,
    /// Gap in mm, and the least distance in front of what cuts, in world units.
    gap: Option<[f64; 2]>,
    /// Lengths of dashes and gaps, in mm.
    dash: Option<[f64; 2]>,
    /// Place of the key that gives dashes.
    dash_place: String,
    /// Whether strokes are inside the picture of the volume, if there is one.
    pub(super) is_merged: bool,
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
        let (iso, visible) = match table.iso {
            HatchIso::Surface(iso) => (Some(value(scene, iso, "hatching.iso")?), None),
            HatchIso::Transfer => (None, Some(visible_values(scene, function)?)),
        };
        // Tolerances follow from the page: the finest details that it can show.
        let growth = growth_settings(scene, table, grid)?.on_page(scale, pen.width, grid);
        // The number of strokes follows from their distance and their length on the page.
        let distance = match spacing {
            Some(room::LineDistance::Everywhere(distance)) => Some((distance, "spacing")),
            Some(room::LineDistance::Tone { .. }) => Some((pen.width, table.pen.as_ref().map_or("width", |_| "pen"))),
            None => None,
        };
        if let Some((distance, key)) = distance {
            let length = (growth.length * scale).min(page.size.length()).max(room::SHORTEST * pen.width);
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
        let one_width = table.has_one_width();
        let is_merged = has_picture && table.is_merged(scene);
        let hatching = room::Hatching {
            iso,
            visible,
            seeds: match table.seeds {
                SeedsBy::Dense => room::SeedRule::Dense,
                SeedsBy::Curvature => {
                    let (min_curvature, min_gradient) = (table.min_curvature, table.min_gradient);
                    room::SeedRule::Curvature { min_curvature, min_gradient }
                }
            },
            measure: table.measure,
            gradient_range: scene.volume.gradient_range,
            growth,
            measures_noise: table.directions.rule == DirectionRule::Scaled && table.directions.deviation.is_none(),
            spacing,
            pen,
            cross_pen,
            one_width: [one_width, one_width || table.cross_pen.is_some()],
            cross: table.cross,
            min_width: on_page(scene, page, table.stroke.min_width, "hatching.stroke.min_width")?,
            ambient: table.stroke.ambient,
            tone: table.tone(),
            taper: table.taper(),
            depth: table.stroke.depth,
            light: table.stroke.light.unwrap_or(scene.light),
            lighting: table.lighting(scene).map(|lighting| line_light(&lighting)),
            is_pencil: table.is_pencil(scene),
            cuts_hidden: match table.hidden {
                Hidden::Cut => true,
                Hidden::Merged => !is_merged,
                Hidden::Drawn => false,
            },
        };
        let gap = gap.map(|gap| [gap, deeper]);
        Ok(Self { hatching, gap, dash, dash_place: scene.given.position("hatching.stroke.dash"), is_merged })
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
            let start = Instant::now();
            *counts.preprocess.entry("segments with gaps".into()).or_default() +=
                room::cut_gaps(gap, layers, own, view);
            *counts.seconds.entry("gaps of strokes".into()).or_default() += start.elapsed().as_secs_f64();
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

    /// Finds the seeds, and grows their strokes if no camera decides which grow.
    pub(super) fn grow(&'a self, field: &'a Field<'_, f64>, counts: &mut Counts) -> room::GrownHatching<'a> {
        let (pyramid, strokes) = self.hatching.strokes(field, counts);
        let pyramid = self.hatching.prepared(pyramid, &strokes, field, counts);
        let seeds = self.seeds_of(&pyramid, &strokes, field, counts);
        let start = Instant::now();
        let grown = self.hatching.grow(&seeds, strokes, field, counts);
        counts.seconds.insert("grown strokes".into(), start.elapsed().as_secs_f64());
        grown
    }

    /// Returns the cells that strokes can begin in.
    pub(super) fn seeds(&self, field: &Field<'_, f64>, counts: &mut Counts) -> room::Seeds {
        let (pyramid, strokes) = self.hatching.strokes(field, counts);
        self.seeds_of(&pyramid, &strokes, field, counts)
    }

    fn seeds_of(
        &self,
        pyramid: &room::Pyramid,
        strokes: &room::StrokeGrower<'_, '_>,
        field: &Field<'_, f64>,
        counts: &mut Counts,
    ) -> room::Seeds {
        let start = Instant::now();
        let seeds = self.hatching.seeds(pyramid, strokes, field, counts);
        counts.seconds.insert("seeds".into(), start.elapsed().as_secs_f64());
        seeds
    }
}

/// Reads the function of a scene whose strokes are where it shows something.
fn visible_values<'a>(scene: &Scene, function: Option<&'a Function>) -> Result<room::VisibleValues<'a>, Failure> {
    let at = |key| scene.given.position(key);
    let failure = |what: &str, remedy: &str| Failure::new(what, at("hatching.iso"), remedy);
    let function = function.filter(|_| scene.transfer.is_some()).ok_or_else(|| {
        failure("there is no transfer function that shows where strokes are", "add a [transfer] table")
    })?;
    let visible = room::VisibleValues::new(function)
        .map_err(|error| Failure::new(error, at("transfer.nodes"), "give them in ascending order"))?;
    visible.ok_or_else(|| {
        let what = "strokes are where a function of the value shows something, and [transfer] is over two quantities";
        failure(what, "give hatching.iso a value")
    })
}
