//! The points and lines of a scene, all that is drawn over or without the volume: stipples ([STIP-1]) and strokes
//! ([HATCH-18]). What no camera changes is made once.

use crate::Failure;
use crate::job::{Job, RenderTarget, room_for_passes};
use crate::stippling::{DotFrames, PointsProgress, Stippling};
use crate::stroking::{StrokeFrames, Stroking};
use drypoint_scene::counts::Counts;
use drypoint_scene::marks::{Layer, Marks, Page};
use drypoint_scene::tables::Scene;
use drypoint_scene::view::View;

/// What a job wants of its scene's points and lines.
pub struct Marking<'a> {
    page: Page,
    stippling: Option<Stippling<'a>>,
    stroking: Option<Stroking<'a>>,
}

/// Frames of them.
pub struct MarkFrames<'a> {
    page: Page,
    dots: Option<DotFrames<'a>>,
    strokes: Option<StrokeFrames<'a>>,
}

impl<'a> Marking<'a> {
    /// Makes what no camera changes; nothing of a scene without points and lines, or where nothing shows them: they are drawn
    /// over the layer `beauty`. `progress` hears how far the points are, from any thread.
    ///
    /// # Errors
    /// As [`Stippling::new`] and [`Stroking::new`].
    pub fn new(job: &'a Job, counts: &mut Counts, progress: &(dyn Fn(PointsProgress) + Sync)) -> Result<Self, Failure> {
        let target = job.target();
        let shown = target != RenderTarget::Picture || job.shows_beauty();
        let target = shown.then_some(target);
        Self::of(job, &job.scene, target, (counts, progress))
    }

    /// The same of a scene that differs from the job's in its knobs alone ([COST-1]), of which something or nothing is target.
    ///
    /// # Errors
    /// As [`Stippling::new`] and [`Stroking::new`].
    pub(crate) fn of(
        job: &'a Job,
        scene: &'a Scene,
        target: Option<RenderTarget>,
        (counts, progress): (&mut Counts, &(dyn Fn(PointsProgress) + Sync)),
    ) -> Result<Self, Failure> {
        room_for_passes(job, &job.plan)?;
        let stippled = target.is_some_and(RenderTarget::has_points) && scene.stipples.is_some();
        let stroked = target.is_some_and(RenderTarget::has_strokes) && scene.has_strokes();
        Ok(Self {
            page: Page::of(scene),
            stippling: if stippled { Some(Stippling::of(job, scene, counts, progress)?) } else { None },
            stroking: if stroked { Some(Stroking::of(job, scene, counts)?) } else { None },
        })
    }

    /// Whether there is nothing to draw.
    pub fn is_empty(&self) -> bool {
        self.stippling.is_none() && self.stroking.is_none()
    }

    /// Makes frames of what there is to draw.
    pub fn frames(&self, counts: &mut Counts) -> Option<MarkFrames<'_>> {
        let dots = self.stippling.as_ref().map(Stippling::frames);
        let strokes = self.stroking.as_ref().map(|stroking| stroking.frames(counts));
        (!self.is_empty()).then_some(MarkFrames { page: self.page, dots, strokes })
    }
}

impl MarkFrames<'_> {
    /// The marks that a camera sees: dots, and over them strokes. A pen has one layer.
    ///
    /// # Errors
    /// As [`StrokeFrames::draw`].
    pub fn draw(&mut self, view: &View, counts: &mut Counts) -> Result<Marks, Failure> {
        let [mut over, inside] = self.draw_apart(view, counts)?;
        inside.layers.into_iter().for_each(|layer| add(&mut over.layers, layer));
        Ok(over)
    }

    /// The same apart: what is drawn over a picture of the volume, and strokes that are inside it ([HATCH-14] d).
    ///
    /// # Errors
    /// As [`StrokeFrames::draw`].
    pub fn draw_apart(&mut self, view: &View, counts: &mut Counts) -> Result<[Marks; 2], Failure> {
        let page = self.page;
        let nothing = || Marks { page, layers: Vec::new() };
        let mut marks = self.dots.as_mut().map_or_else(nothing, |dots| dots.draw(view, counts));
        let strokes = self.strokes.as_mut().map(|strokes| strokes.draw(view, counts)).transpose()?;
        let [over, inside] = strokes.unwrap_or_default();
        over.into_iter().for_each(|layer| add(&mut marks.layers, layer));
        Ok([marks, Marks { page, layers: inside }])
    }
}

/// Adds what a pen draws to its layer, or as one of its own, under a number that no other has.
fn add(layers: &mut Vec<Layer>, mut layer: Layer) {
    if let Some(same) = layers.iter_mut().find(|other| other.pen == layer.pen) {
        same.dots.append(&mut layer.dots);
        same.lines.append(&mut layer.lines);
        return;
    }
    if layers.iter().any(|other| other.pen.number == layer.pen.number) {
        layer.pen.number = layers.iter().map(|other| other.pen.number).max().unwrap_or(0) + 1;
    }
    layers.push(layer);
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::marks::Pen;

    #[test]
    fn a_pen_has_one_layer_and_a_layer_a_number_of_its_own() {
        let pen = |number, name: &str| Pen { number, name: name.into(), width: 0.3, color: [0.0, 0.0, 0.0, 1.0] };
        let mut layers = Vec::new();
        for pen in [pen(1, "stipples"), pen(4, "red"), pen(1, "outlines"), pen(4, "red")] {
            add(&mut layers, Layer::new(pen));
        }
        let found: Vec<(usize, &str)> = layers.iter().map(|l| (l.pen.number, l.pen.name.as_str())).collect();
        assert_eq!(found, [(1, "stipples"), (4, "red"), (5, "outlines")]);
    }
}
