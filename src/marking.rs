//! Points and lines of a scene: stipples ([STIP-1]) and strokes ([HATCH-18]), drawn over or without the volume. Work
//! that does not depend on the camera is done once.

use crate::Failure;
use crate::gpu::{Gpu, point_test};
use crate::job::{Job, RenderTarget, room_for_passes};
use crate::stippling::{DotFrames, PointsProgress, Stippling};
use crate::stroking::{StrokeFrames, Stroking};
use drypoint_scene::counts::Counts;
use drypoint_scene::marks::{Layer, Marks, Page};
use drypoint_scene::view::View;

/// Points and lines of a job's scene.
pub struct Marking<'a> {
    page: Page,
    stippling: Option<Stippling<'a>>,
    stroking: Option<Stroking<'a>>,
}

/// Frames of points and lines.
pub struct MarkFrames<'a> {
    page: Page,
    dots: Option<DotFrames<'a>>,
    strokes: Option<StrokeFrames<'a>>,
}

impl<'a> Marking<'a> {
    /// Makes the points and lines that do not depend on the camera. The result is empty without points and lines. It is
    /// also empty if the picture lacks the layer `beauty`, over which they are drawn. `progress` receives the state of
    /// the points, on any thread.
    ///
    /// # Errors
    /// The errors of [`Stippling::new`] and [`Stroking::new`].
    pub fn new(job: &'a Job, counts: &mut Counts, progress: &(dyn Fn(PointsProgress) + Sync)) -> Result<Self, Failure> {
        room_for_passes(&job.scene, &job.volume, &job.plan)?;
        let (scene, target) = (&job.scene, job.target());
        let shown = target != RenderTarget::Picture || job.shows_beauty();
        let stippled = shown && target.has_points() && scene.stipples.is_some();
        let hatched = target.has_hatching() && scene.hatching.is_some();
        let stroked = shown && (hatched || scene.outlines.is_some());
        Ok(Self {
            page: Page::of(scene),
            stippling: if stippled { Some(Stippling::new(job, counts, progress)?) } else { None },
            stroking: if stroked { Some(Stroking::new(job, counts)?) } else { None },
        })
    }

    /// Whether there is nothing to draw.
    pub fn is_empty(&self) -> bool {
        self.stippling.is_none() && self.stroking.is_none()
    }

    /// Makes frames of the points and lines.
    pub fn frames(&self, counts: &mut Counts) -> Option<MarkFrames<'_>> {
        let dots = self.stippling.as_ref().map(Stippling::frames);
        let strokes = self.stroking.as_ref().map(|stroking| stroking.frames(counts));
        (!self.is_empty()).then_some(MarkFrames { page: self.page, dots, strokes })
    }
}

impl MarkFrames<'_> {
    /// Makes a graphics card test points for visibility.
    ///
    /// # Errors
    /// Errors of the adapter.
    pub(crate) fn on_gpu(&mut self, job: &Job, gpu: &Gpu) -> Result<(), Failure> {
        let Some(dots) = &mut self.dots else { return Ok(()) };
        let test = dots.hiding().map(|(surface, near)| point_test(job, gpu, surface, near)).transpose()?;
        test.into_iter().for_each(|test| dots.test_by(test));
        Ok(())
    }

    /// Returns the marks that a camera sees: dots, and strokes over them. A pen has one layer.
    ///
    /// # Errors
    /// Same errors as [`StrokeFrames::draw`].
    pub fn draw(&mut self, view: &View, counts: &mut Counts) -> Result<Marks, Failure> {
        let [mut over, inside] = self.draw_apart(view, counts)?;
        inside.layers.into_iter().for_each(|layer| add(&mut over.layers, layer));
        Ok(over)
    }

    /// Returns the marks over a picture of the volume, and the strokes inside it ([HATCH-14] d).
    ///
    /// # Errors
    /// Same errors as [`DotFrames::draw`] and [`StrokeFrames::draw`].
    pub fn draw_apart(&mut self, view: &View, counts: &mut Counts) -> Result<[Marks; 2], Failure> {
        let page = self.page;
        let nothing = || Marks { page, layers: Vec::new() };
        let mut marks = match &mut self.dots {
            Some(dots) => dots.draw(view, counts)?,
            None => nothing(),
        };
        let strokes = self.strokes.as_mut().map(|strokes| strokes.draw(view, counts)).transpose()?;
        let [over, inside] = strokes.unwrap_or_default();
        over.into_iter().for_each(|layer| add(&mut marks.layers, layer));
        Ok([marks, Marks { page, layers: inside }])
    }
}

/// Adds a layer to its pen's layer, or as one of its own under an unused number.
pub(crate) fn add(layers: &mut Vec<Layer>, mut layer: Layer) {
    if let Some(same) = layers.iter_mut().find(|other| other.pen == layer.pen) {
        same.dots.append(&mut layer.dots);
        same.lines.append(&mut layer.lines);
        same.areas.append(&mut layer.areas);
        same.texts.append(&mut layer.texts);
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
