//! The reference's part of a validation: its picture, its bounds, and what a card's picture is of them.

use super::{Bounded, SAME, Stage, Validation};
use crate::Failure;
use crate::cost::quantile;
use crate::gpu::{Gpu, GpuJob, Precision};
use crate::job::{Job, SceneVariant, render_failure};
use crate::marking::Marking;
use drypoint_output::compare::{CompareOptions, compare};
use drypoint_output::paint::fragments;
use drypoint_output::read::Image;
use drypoint_reference::number::Decision;
use drypoint_reference::ray::Renderer;
use drypoint_reference::ray::bounds::{Bounds, BoundsError, RayOrigin};
use drypoint_scene::counts::Counts;
use drypoint_scene::fragments::Fragments;
use drypoint_scene::picture::{LayerKind, Picture};
use drypoint_scene::plan::Pass;
use drypoint_scene::shot::KappaSource;
use std::sync::atomic::AtomicBool;

/// A larger bound says nothing about a colour.
const SAYS_NOTHING: f64 = 0.5;

/// All that a comparison takes from the reference on one scene. Cards and edited shaders are compared with it.
pub struct Truth<'j> {
    job: &'j Job,
    /// The scene with the beauty alone.
    plain: SceneVariant,
    /// The scene with the layers of all stages.
    layered: SceneVariant,
    /// Whether there are layers beside those of the stages.
    has_further: bool,
    stages: Vec<(&'static str, LayerKind)>,
    lines: Option<Fragments>,
    /// The picture with the layers of all stages.
    picture: Picture,
    /// The bounds in f32, or the reason why there are none.
    bounds: Result<Bounds, String>,
}

impl<'j> Truth<'j> {
    /// Draws the scene of a job and derives its bounds. `further` are layers to compare beside those of the stages. Returns none
    /// if `stop` becomes true while the picture is drawn.
    ///
    /// # Errors
    /// The errors of [`Job::renderer`].
    pub fn until(job: &'j Job, further: &[LayerKind], stop: &AtomicBool) -> Result<Option<Self>, Failure> {
        let mut scene = job.scene.clone();
        scene.picture.layers = vec![LayerKind::Beauty];
        let plain = job.variant(scene.clone());
        let mut stages = stages(job, &plain)?;
        for &layer in further {
            if stages.iter().all(|(_, known)| *known != layer) {
                stages.push(("layer", layer));
            }
        }
        scene.picture.layers = stages.iter().map(|(_, layer)| *layer).collect();
        let layered = job.variant(scene);
        let mut reference = job.renderer_of(&layered)?;
        let lines = lines_inside(job, &reference)?;
        reference.merge(lines.clone());
        let Some((picture, _)) = reference.again_until(&|_| (), stop) else { return Ok(None) };
        // Beside objects, meshes and halos the colours alone have bounds.
        let with_layers = bounds(job, &layered, lines.clone())?;
        let bounds = match with_layers {
            Err(_) if further.is_empty() => bounds(job, &plain, lines.clone())?,
            found => found,
        };
        let has_further = !further.is_empty();
        Ok(Some(Self { job, plain, layered, has_further, stages, lines, picture, bounds }))
    }

    /// Draws the scene of a job and derives its bounds. See [`until`](Self::until).
    ///
    /// # Errors
    /// The errors of [`Job::renderer`].
    pub fn new(job: &'j Job, further: &[LayerKind]) -> Result<Self, Failure> {
        let truth = Self::until(job, further, &AtomicBool::new(false))?;
        Ok(truth.unwrap_or_else(|| unreachable!("nothing stops the reference")))
    }

    /// Compares a graphics card with the reference, with edited shaders in f32. Once `stop` is true, the comparison ends
    /// without a result before the card draws on.
    ///
    /// # Errors
    /// The errors of the adapter.
    pub fn validate(
        &self,
        gpu: &Gpu,
        edit: &dyn Fn(String) -> String,
        stop: &AtomicBool,
    ) -> Result<Option<Validation>, Failure> {
        let on_card = |precision| GpuJob::of(self.job, gpu, &self.layered, precision);
        let mut double = None;
        if gpu.has_double() {
            double = self.drawn(&on_card(Precision::Double)?, &|text| text, stop)?;
            if double.is_none() {
                return Ok(None);
            }
        }
        let Some(single) = self.drawn(&on_card(Precision::Single)?, edit, stop)? else { return Ok(None) };
        let compared: Vec<Stage> = self
            .stages
            .iter()
            .map(|&(name, layer)| {
                let differs = |other: &Picture| largest_difference(&self.picture, other, layer);
                let (largest, double) = (self.largest(layer), double.as_ref().map(differs));
                let share = self.bounds.as_ref().ok().and_then(|bounds| largest_share(bounds, &single, layer));
                Stage { name, layer: layer.to_string(), largest, double, single: differs(&single), share }
            })
            .collect();
        let parts = |stage: &&Stage| stage.double.is_some_and(|double| double > SAME * stage.largest);
        let parts_at = compared.iter().find(parts).map(|stage| stage.name);
        let bounded = self.bounds.as_ref().ok().map(|bounds| against(bounds, &single));
        let pictures = [self.picture.clone(), single];
        let [a, b] = pictures.each_ref().map(Image::from);
        let whole = compare(&a, &b, &CompareOptions::default())
            .map_err(|error| Failure::picture(&error, self.job.scene.given.position("picture")))?;
        let rms = whole.layers.iter().find(|layer| layer.name == "beauty").map_or(f64::NAN, |layer| layer.rms);
        let (adapter, flip) = (gpu.describe(), whole.flip.unwrap_or(f64::NAN));
        let unbounded = self.bounds.as_ref().err().cloned();
        Ok(Some(Validation { adapter, stages: compared, parts_at, rms, flip, bounded, unbounded, pictures }))
    }

    /// The scene on a graphics card, for [`notices`](Self::notices): colours in f32 if bounds are known and no further layers
    /// are compared, else all stages in f64.
    ///
    /// # Errors
    /// The errors of the adapter.
    pub fn on_card(&self, gpu: &'j Gpu) -> Result<GpuJob<'j>, Failure> {
        match self.of_colours() {
            Some(_) => GpuJob::of(self.job, gpu, &self.plain, Precision::Single),
            None => GpuJob::of(self.job, gpu, &self.layered, Precision::Double),
        }
    }

    /// The bounds, if colours alone are compared.
    fn of_colours(&self) -> Option<&Bounds> {
        self.bounds.as_ref().ok().filter(|_| !self.has_further)
    }

    /// Whether an edited shader shows [on a card](Self::on_card): a pixel exceeds its bound in f32, or a stage parts in f64
    /// ([`SAME`]).
    ///
    /// # Errors
    /// The errors of the adapter.
    pub fn notices(&self, on_card: &GpuJob<'_>, edit: &dyn Fn(String) -> String) -> Result<bool, Failure> {
        let drawn = self.drawn(on_card, edit, &AtomicBool::new(false))?;
        let Some(drawn) = drawn else { unreachable!("nothing stops the frame") };
        let parts = |layer| largest_difference(&self.picture, &drawn, layer) > SAME * self.largest(layer);
        Ok(match self.of_colours() {
            Some(bounds) => against(bounds, &drawn).exceeded > 0,
            None => self.stages.iter().any(|&(_, layer)| parts(layer)),
        })
    }

    /// The largest number of a layer.
    fn largest(&self, layer: LayerKind) -> f64 {
        let channels = self.picture.layer(layer).into_iter().flat_map(|layer| layer.channels.iter().flatten());
        channels.filter(|c| c.is_finite()).fold(0.0, |largest: f64, c| largest.max(c.abs()))
    }

    /// A card's picture with an edited shader; none if it was stopped.
    fn drawn(
        &self,
        on_card: &GpuJob<'_>,
        edit: &dyn Fn(String) -> String,
        stop: &AtomicBool,
    ) -> Result<Option<Picture>, Failure> {
        let mut renderer = on_card.edited(edit)?;
        let picture = renderer.merge(self.lines.clone()).and_then(|()| renderer.frame_until(&|_| (), stop));
        picture.map_err(|error| on_card.failure(&error))
    }
}

/// The stages of a scene, with their layers. First come stages of the first visible sample of a ray, which do not
/// depend on opacities. Then come depths, which opacities move, then quantities weighted by opacities.
fn stages(job: &Job, variant: &SceneVariant) -> Result<Vec<(&'static str, LayerKind)>, Failure> {
    let query = job.shot_of(variant)?.objects[0].query;
    let has_kappa = query.kappa != KappaSource::None;
    let stages = [
        (true, "value", LayerKind::First),
        (query.gradient, "normal", LayerKind::FirstNormal),
        (has_kappa, "curvature", LayerKind::FirstCurvatureAlongView),
        (true, "opacity", LayerKind::Depth),
        (query.gradient, "gradient", LayerKind::Gradient),
    ];
    let of_samples = stages.into_iter().filter(|(has, ..)| *has).map(|(_, stage, layer)| (stage, layer));
    let of_halos = (0..variant.scene.halos.len()).map(|halo| ("halo", LayerKind::Halo(halo)));
    Ok(of_samples.chain(of_halos).chain([("colour", LayerKind::Beauty)]).collect())
}

/// The lines inside the volume of a job. Returns none if it has none.
fn lines_inside(job: &Job, renderer: &Renderer<'_>) -> Result<Option<Fragments>, Failure> {
    if !job.plan.has_pass(Pass::MergedStrokes) {
        return Ok(None);
    }
    let (view, mut counts) = (job.view()?, Counts::default());
    let marking = Marking::new(job, &mut counts, &|_| ())?;
    let Some(mut frames) = marking.frames(&mut counts) else { return Ok(None) };
    let [_, inside] = frames.draw_apart(&view, &mut counts)?;
    Ok(Some(fragments(&inside, &view, renderer.rays_across())))
}

/// The reference's picture with its bounds, or the reason why there are none.
fn bounds(job: &Job, variant: &SceneVariant, lines: Option<Fragments>) -> Result<Result<Bounds, String>, Failure> {
    let shot = job.shot_of(variant)?;
    match Renderer::bounds(&shot, job.inputs(&shot), lines, RayOrigin::Middle) {
        Ok(bounds) => Ok(Ok(bounds)),
        Err(unknown @ BoundsError::Unknown { .. }) => Ok(Err(unknown.to_string())),
        Err(BoundsError::Render(error)) => Err(render_failure(&error, &job.scene)),
    }
}

/// The largest difference of two pictures in a layer. If only one of two numbers is finite, or only one is NaN, their
/// difference is infinite.
fn largest_difference(a: &Picture, b: &Picture, layer: LayerKind) -> f64 {
    let channels = |picture: &Picture| picture.layer(layer).map_or_else(Vec::new, |layer| layer.channels.clone());
    let pairs = channels(a).into_iter().flatten().zip(channels(b).into_iter().flatten());
    pairs.map(|(a, b)| apart(a, b)).fold(0.0, f64::max)
}

/// The largest ratio of a decided pixel's difference in a layer to its bound; none of a layer without bounds. Numbers
/// without a bound are left out.
fn largest_share(bounds: &Bounds, single: &Picture, layer: LayerKind) -> Option<f64> {
    let channels = |picture: &'_ Picture| picture.layer(layer).map(|layer| layer.channels.clone());
    let (values, errors, single) = (channels(&bounds.values)?, channels(&bounds.errors)?, channels(single)?);
    let is_decided = |at: &usize| bounds.undecided[*at].is_none();
    let of_channel = |c: usize| {
        (0..values[c].len()).filter(is_decided).fold(0.0, |most: f64, at| {
            let (difference, bound) = (apart(values[c][at], single[c][at]), errors[c][at]);
            if difference == 0.0 || bound == f64::INFINITY { most } else { most.max(difference / bound) }
        })
    };
    Some((0..values.len()).map(of_channel).fold(0.0, f64::max))
}

/// |a − b|. It is infinite if only one number is finite, or only one is NaN.
fn apart(a: f64, b: f64) -> f64 {
    let difference = if a == b { 0.0 } else { (a - b).abs() };
    if difference.is_nan() { f64::INFINITY } else { difference }
}

/// A card's colours in f32 against their bounds.
fn against(bounds: &Bounds, single: &Picture) -> Bounded {
    let channels = |picture: &Picture| picture.layer(LayerKind::Beauty).map_or_else(Vec::new, |l| l.channels.clone());
    let (values, errors, single) = (channels(&bounds.values), channels(&bounds.errors), channels(single));
    let mut of_pixels = Vec::new();
    let mut found = Bounded {
        median: 0.0,
        bound_of_99_percent: 0.0,
        bound: 0.0,
        measured: 0.0,
        share: 0.0,
        exceeded: 0,
        endless: 0.0,
        undecided: 0.0,
        decisions: Vec::new(),
        measured_at_decisions: 0.0,
    };
    for (at, undecided) in bounds.undecided.iter().enumerate() {
        let differences = (0..values.len()).map(|c| (apart(values[c][at], single[c][at]), errors[c][at]));
        if undecided.is_some() {
            found.undecided += 1.0 / bounds.undecided.len() as f64;
            found.measured_at_decisions = differences.fold(found.measured_at_decisions, |d, (found, _)| d.max(found));
            continue;
        }
        let mut exceeds = false;
        if errors.iter().any(|channel| channel[at].is_nan() || channel[at] > SAYS_NOTHING) {
            found.endless += 1.0 / bounds.undecided.len() as f64;
            continue;
        }
        of_pixels.push(errors.iter().map(|channel| channel[at]).fold(0.0, f64::max));
        for (difference, bound) in differences {
            found.measured = found.measured.max(difference);
            exceeds |= difference > bound;
            if bound > 0.0 {
                found.share = found.share.max(difference / bound);
            }
        }
        found.exceeded += usize::from(exceeds);
    }
    if !of_pixels.is_empty() {
        [found.median, found.bound_of_99_percent, found.bound] = [0.5, 0.99, 1.0].map(|q| quantile(&of_pixels, q));
    }
    for decision in Decision::ALL {
        let pixels = bounds.undecided.iter().filter(|open| **open == Some(decision)).count();
        if pixels > 0 {
            found.decisions.push((decision.sentence(), pixels));
        }
    }
    found
}
