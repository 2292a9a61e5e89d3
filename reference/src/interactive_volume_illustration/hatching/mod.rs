//! Hatching with nothing left to decide: strokes grown once ([HATCH-6] … [HATCH-11]), and drawn for each camera as they
//! fall ([HATCH-13]) or evenly on the page ([HATCH-19]).

mod counts;
mod draw;
mod visible_values;

pub use draw::SHORTEST;
pub use visible_values::VisibleValues;

use super::{
    DirectionEstimator, HatchParams, LineDistance, LineLight, Pyramid, SeedRule, Seeds, StrokeGrower, deviation,
    gradient_range,
};
use crate::field::Field;
use drypoint_scene::counts::Counts;
use drypoint_scene::glam::DVec3;
use drypoint_scene::marks::Pen;
use drypoint_scene::shot::{GradientRange, LightDirection};
use drypoint_scene::strokes::{Measure, Stroke};

/// Where strokes begin, how they grow, and how they are drawn. Lengths on the page are in mm.
#[derive(Clone, Debug)]
pub struct Hatching<'a> {
    /// Value of the surface that strokes lie on; none: strokes are where [`visible`](Self::visible) shows something.
    pub iso: Option<f64>,
    /// The values that a transfer function shows; none with a surface ([HATCH-16]).
    pub visible: Option<VisibleValues<'a>>,
    /// The choice of the cells that strokes begin in ([HATCH-6]).
    pub seeds: SeedRule,
    /// The curvature that a seed's probability follows ([HATCH-5]).
    pub measure: Measure,
    /// The range of ‖g‖ for |∇| from 0 to 1 ([VAL-2]).
    pub gradient_range: GradientRange,
    /// The growth of strokes, with its random numbers and their jitter ([HATCH-8]).
    pub growth: HatchParams,
    /// Whether the noise of the data is measured near the surface ([HATCH-3]).
    pub measures_noise: bool,
    /// Distance of lines on the page ([HATCH-19]); none: strokes fall as their seeds do.
    pub spacing: Option<LineDistance>,
    /// The pen of the first direction.
    pub pen: Pen,
    /// The pen of crossing strokes.
    pub cross_pen: Pen,
    /// Whether strokes of the first direction, and crossing ones, have their pen's width throughout.
    pub one_width: [bool; 2],
    /// Angle in degrees to the light beyond which strokes are crossed; none: no stroke is ([HATCH-11]).
    pub cross: Option<f64>,
    /// Smallest width ([HATCH-13]).
    pub min_width: f64,
    /// Light that falls everywhere ([HATCH-13]).
    pub ambient: f64,
    /// a, the exponent of the tone in the width ([HATCH-13]).
    pub tone: f64,
    /// b, the share of a stroke that each end takes to its full width ([HATCH-13]).
    pub taper: f64,
    /// Share by which the farthest strokes are thinner ([HATCH-13]).
    pub depth: f64,
    /// Towards the light.
    pub light: LightDirection,
    /// Light on lines in two colours ([HATCH-12]); none: the pens' colours.
    pub lighting: Option<LineLight>,
    /// Whether opacity follows the tone, on grainy paper ([HATCH-13]).
    pub is_pencil: bool,
    /// Whether hidden parts are cut off ([HATCH-14]).
    pub cuts_hidden: bool,
}

/// Grown strokes of hatching.
pub struct GrownHatching<'a> {
    hatching: &'a Hatching<'a>,
    /// The growth of further strokes.
    pub strokes: StrokeGrower<'a, 'a>,
    /// The cells that strokes begin in.
    pub cells: Vec<[usize; 3]>,
    /// Strokes of all cells, if they fall as their seeds do.
    grown: Option<CrossedStrokes>,
}

/// Strokes of the first direction, and crossing ones with N at their seeds.
struct CrossedStrokes {
    first: Vec<Stroke>,
    across: Vec<(DVec3, Stroke)>,
}

impl Hatching<'_> {
    /// Returns the pyramid that finds cells of the surface, and the strokes that grow there, with the noise of the data
    /// near the surface ([HATCH-3]).
    pub fn strokes<'f, 'v>(&self, field: &'f Field<'v, f64>, counts: &mut Counts) -> (Pyramid, StrokeGrower<'f, 'v>) {
        let pyramid = Pyramid::new(field.volume());
        counts.bytes.insert("pyramid".into(), pyramid.bytes());
        counts.preprocess.insert("pyramid".into(), pyramid.entries());
        let mut how = self.growth;
        if let (DirectionEstimator::Scaled(thresholds), true, Some(iso)) =
            (&mut how.rule, self.measures_noise, self.iso)
        {
            thresholds.deviation = deviation(field.volume(), &pyramid, iso, field.reconstruction().outside);
        }
        (pyramid, StrokeGrower::new(field, self.iso, how))
    }

    /// Computes the directions that are stored in advance, and gives the pyramid the curvatures that seeds follow.
    pub fn prepared(
        &self,
        pyramid: Pyramid,
        strokes: &StrokeGrower<'_, '_>,
        field: &Field<'_, f64>,
        counts: &mut Counts,
    ) -> Pyramid {
        strokes.prepare();
        if let Some(iso) = self.iso.filter(|_| self.growth.smooth > 0.0) {
            let surface = strokes.seeds(&pyramid, field, iso, SeedRule::Dense, (self.measure, [0.0; 2]));
            let cells: Vec<_> = surface.cells.into_iter().map(|(cell, _)| cell).collect();
            strokes.smooth(&cells);
        }
        let pyramid = match self.seeds {
            SeedRule::Curvature { .. } => strokes.with_curvature(pyramid, self.measure),
            SeedRule::Dense => pyramid,
        };
        counts.bytes.insert("pyramid".into(), pyramid.bytes());
        pyramid
    }

    /// Returns the cells that strokes can begin in, with their probabilities.
    pub fn seeds(
        &self,
        pyramid: &Pyramid,
        strokes: &StrokeGrower<'_, '_>,
        field: &Field<'_, f64>,
        counts: &mut Counts,
    ) -> Seeds {
        let range = match self.seeds {
            SeedRule::Dense => [0.0; 2],
            SeedRule::Curvature { .. } => {
                let (range, voxels) = gradient_range(field, self.gradient_range);
                *counts.preprocess.entry("gradients".into()).or_default() += voxels;
                range
            }
        };
        let by = (self.measure, range);
        let seeds = match (self.iso, &self.visible) {
            (Some(iso), _) => strokes.seeds(pyramid, field, iso, self.seeds, by),
            (None, Some(shown)) => strokes.seeds_among(pyramid, field, |range| shown.has(range), self.seeds, by),
            (None, None) => Seeds::default(),
        };
        counts.preprocess.insert("measures of seeds".into(), seeds.measured);
        seeds
    }

    /// Draws the seeds by their probabilities and grows their strokes, if no camera decides which grow.
    pub fn grow<'a>(
        &'a self,
        seeds: &Seeds,
        strokes: StrokeGrower<'a, 'a>,
        field: &Field<'_, f64>,
        counts: &mut Counts,
    ) -> GrownHatching<'a> {
        let mut cells: Vec<[usize; 3]> = seeds.draw(self.growth.seed).collect();
        counts.preprocess.insert("seeds".into(), cells.len() as u64);
        if let Some(shown) = &self.visible {
            // A stroke stays at the value of its seed. If that value is invisible, so is the whole stroke.
            let drawn = cells.len();
            cells.retain(|cell| {
                let centre = field.volume().grid().to_world(DVec3::from_array(cell.map(|i| i as f64 + 0.5)));
                strokes.value(centre).is_some_and(|value| shown.opacity(value) > 0.0)
            });
            counts.preprocess.insert("seeds at values that nothing shows".into(), (drawn - cells.len()) as u64);
        }
        let grown = self.spacing.is_none().then(|| {
            let crossed = self.cross.is_some();
            let grown = strokes.grow_all(&cells, |_| crossed);
            counts::add(counts, &grown.counts);
            CrossedStrokes {
                first: grown.strokes.into_iter().map(|(_, stroke)| stroke).collect(),
                across: grown.cross.into_iter().map(|(seed, stroke)| (seed.normal, stroke)).collect(),
            }
        });
        counts::count_kept(counts, &strokes);
        GrownHatching { hatching: self, strokes, cells, grown }
    }
}
