//! The validation of a graphics card against the reference, on one scene ([GPU-1], [GPU-2]).

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
use serde::Serialize;
use std::fmt;

/// The largest difference in f64, as a share of a stage's largest number, up to which algorithms count as the same.
pub const SAME: f64 = 1e-9;

/// The largest share of pixels at a decision or without a bound that a scene may have.
pub const MOST_OPEN: f64 = 0.1;

/// A larger bound says nothing about a colour.
const SAYS_NOTHING: f64 = 0.5;

/// The comparison of a graphics card with the reference on one scene.
#[derive(Clone, Debug, Serialize)]
pub struct Validation {
    /// The adapter.
    pub adapter: String,
    /// Stages of a sample, in the order in which they are computed.
    pub stages: Vec<Stage>,
    /// The first stage that differs in f64. None if no stage does, or if the adapter has no f64.
    pub parts_at: Option<&'static str>,
    /// The root mean square of the colours' difference in f32, over all pixels.
    pub rms: f64,
    /// The mean of FLIP of the colours in f32.
    pub flip: f64,
    /// The colours in f32 against their bounds. None if no bound is known; `unbounded` then gives the reason.
    pub bounded: Option<Bounded>,
    /// The reason why there are no bounds.
    pub unbounded: Option<String>,
    /// The pictures of the reference and of the card in f32, from which a picture of the difference is made.
    #[serde(skip)]
    pub pictures: [Picture; 2],
}

/// A stage of samples, compared as a layer.
#[derive(Clone, Debug, Serialize)]
pub struct Stage {
    /// The stage.
    pub name: &'static str,
    /// The layer.
    pub layer: String,
    /// The largest number of the layer.
    pub largest: f64,
    /// The largest difference with the card in f64; none if it has no f64.
    pub double: Option<f64>,
    /// The largest difference with the card in f32.
    pub single: f64,
    /// The largest ratio of a decided pixel's difference in f32 to its bound; none if no bound is known.
    pub share: Option<f64>,
}

/// Colours in f32 against the bounds of their errors.
#[derive(Clone, Debug, Serialize)]
pub struct Bounded {
    /// The median of the decided pixels' bounds.
    pub median: f64,
    /// The bound that 99 % of the decided pixels do not exceed.
    pub bound_of_99_percent: f64,
    /// The largest bound of a decided pixel.
    pub bound: f64,
    /// The largest difference of a decided pixel.
    pub measured: f64,
    /// The largest ratio of a difference to its bound.
    pub share: f64,
    /// Number of decided pixels whose difference exceeds their bound.
    pub exceeded: usize,
    /// The share of pixels whose bound exceeds ½, so that it says nothing.
    pub endless: f64,
    /// The share of pixels at a decision.
    pub undecided: f64,
    /// Number of pixels at each decision that is open somewhere.
    pub decisions: Vec<(&'static str, usize)>,
    /// The largest difference of a pixel at a decision.
    pub measured_at_decisions: f64,
}

/// The verdict of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// Colours in f32 keep their bounds.
    Kept,
    /// A bound is exceeded, a stage differs in f64, or too few pixels have a meaningful bound.
    Failed,
    /// No bound is known for the scene, so nothing is known of f32. Stages in f64 agree with the reference, if the adapter has
    /// f64.
    NotProven,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Kept => "kept",
            Self::Failed => "failed",
            Self::NotProven => "not proven: no bound of f32 is known for this scene",
        })
    }
}

impl Validation {
    /// Whether a bound is exceeded, or the algorithms differ.
    pub fn is_wrong(&self) -> bool {
        let exceeds = |stage: &Stage| stage.share.is_some_and(|share| share > 1.0);
        self.parts_at.is_some()
            || self.stages.iter().any(exceeds)
            || self.bounded.as_ref().is_some_and(|bounded| bounded.exceeded > 0)
    }

    /// Returns the verdict.
    pub fn verdict(&self) -> Verdict {
        let is_open = |bounded: &Bounded| bounded.undecided + bounded.endless > MOST_OPEN;
        if self.is_wrong() || self.bounded.as_ref().is_some_and(is_open) {
            Verdict::Failed
        } else if self.bounded.is_some() {
            Verdict::Kept
        } else {
            Verdict::NotProven
        }
    }

    /// Whether all stages were compared in f64.
    pub fn has_double(&self) -> bool {
        self.stages.iter().all(|stage| stage.double.is_some())
    }
}

impl fmt::Display for Validation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "adapter: {}", self.adapter)?;
        let [stage, layer, largest, double, single] = ["stage", "layer", "largest", "f64 differs", "f32 differs"];
        writeln!(f, "{stage:<10} {layer:<18} {largest:>10} {double:>12} {single:>12} {:>9}", "of bound")?;
        for stage in &self.stages {
            let double = stage.double.map_or_else(|| "no f64".to_owned(), |double| format!("{double:.1e}"));
            let share = stage.share.map_or_else(|| "no bound".to_owned(), |share| format!("{share:.3}"));
            let Stage { name, layer, largest, single, .. } = stage;
            writeln!(f, "{name:<10} {layer:<18} {largest:>10.3e} {double:>12} {single:>12.1e} {share:>9}")?;
        }
        match self.parts_at {
            Some(stage) => writeln!(f, "the {stage} is the first stage that parts in f64")?,
            None if self.has_double() => writeln!(f, "no stage parts in f64")?,
            None => {}
        }
        writeln!(f, "colours in f32: RMS {:.1e}, mean of FLIP {:.1e}", self.rms, self.flip)?;
        if let Some(why) = &self.unbounded {
            writeln!(f, "{why}")?;
        }
        if let Some(bounded) = &self.bounded {
            write!(f, "{bounded}")?;
        }
        write!(f, "verdict: {}", self.verdict())
    }
}

impl fmt::Display for Bounded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { median, bound_of_99_percent, bound, measured, share, exceeded, endless, undecided, .. } = self;
        writeln!(
            f,
            "bounds of pixels: median {median:.1e}, 99 % {bound_of_99_percent:.1e}, largest {bound:.1e}; measured {measured:.1e}, at \
             most {share:.3} of a pixel's own bound"
        )?;
        writeln!(f, "pixels over their bound: {exceeded}")?;
        if *endless > 0.0 {
            writeln!(f, "pixels whose bound says nothing: {:.3} %", endless * 100.0)?;
        }
        writeln!(
            f,
            "pixels at a decision: {:.3} %, differing by up to {:.1e}",
            undecided * 100.0,
            self.measured_at_decisions
        )?;
        self.decisions.iter().try_for_each(|(what, pixels)| writeln!(f, "  {pixels} at {what}"))
    }
}

/// Compares a graphics card with the reference on a job's scene.
///
/// # Errors
/// The errors of [`Job::renderer`], and those of the adapter.
pub fn validate(job: &Job, gpu: &Gpu) -> Result<Validation, Failure> {
    validate_edited(job, gpu, &|text| text)
}

/// Like [`validate`], but with edited shaders in f32. Tests use it to check that the bounds notice a fault.
///
/// # Errors
/// The errors of [`validate`].
pub fn validate_edited(job: &Job, gpu: &Gpu, edit: &dyn Fn(String) -> String) -> Result<Validation, Failure> {
    Truth::new(job, &[])?.validate(gpu, edit)
}

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
    /// Draws the scene of a job and derives its bounds. `further` are layers to compare beside those of the stages.
    ///
    /// # Errors
    /// The errors of [`Job::renderer`].
    pub fn new(job: &'j Job, further: &[LayerKind]) -> Result<Self, Failure> {
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
        let (picture, _) = reference.again(&|_| ());
        // Beside objects, meshes and halos the colours alone have bounds.
        let with_layers = bounds(job, &layered, lines.clone())?;
        let bounds = match with_layers {
            Err(_) if further.is_empty() => bounds(job, &plain, lines.clone())?,
            found => found,
        };
        Ok(Self { job, plain, layered, has_further: !further.is_empty(), stages, lines, picture, bounds })
    }

    /// Compares a graphics card with the reference, with edited shaders in f32.
    ///
    /// # Errors
    /// The errors of the adapter.
    pub fn validate(&self, gpu: &Gpu, edit: &dyn Fn(String) -> String) -> Result<Validation, Failure> {
        let on_card = |precision| GpuJob::of(self.job, gpu, &self.layered, precision);
        let double = match gpu.has_double() {
            true => Some(self.drawn(&on_card(Precision::Double)?, &|text| text)?),
            false => None,
        };
        let single = self.drawn(&on_card(Precision::Single)?, edit)?;
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
        Ok(Validation { adapter, stages: compared, parts_at, rms, flip, bounded, unbounded, pictures })
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
        let drawn = self.drawn(on_card, edit)?;
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

    /// A card's picture with an edited shader.
    fn drawn(&self, on_card: &GpuJob<'_>, edit: &dyn Fn(String) -> String) -> Result<Picture, Failure> {
        let mut renderer = on_card.edited(edit)?;
        let picture = renderer.merge(self.lines.clone()).and_then(|()| renderer.frame(&|_| ()));
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

#[cfg(test)]
mod tests {
    use super::*;

    fn validation(double: Option<f64>, bounded: Option<Bounded>) -> Validation {
        let stage = Stage { name: "colour", layer: "beauty".into(), largest: 1.0, double, single: 1e-6, share: None };
        let picture = || Picture { width: 0, height: 0, layers: Vec::new() };
        Validation {
            adapter: "a card".into(),
            stages: vec![stage],
            parts_at: double.filter(|&double| double > SAME).map(|_| "colour"),
            rms: 0.0,
            flip: 0.0,
            unbounded: bounded.is_none().then(|| "halos have no bounds".into()),
            bounded,
            pictures: [picture(), picture()],
        }
    }

    fn bounded(exceeded: usize, undecided: f64) -> Bounded {
        Bounded {
            median: 1e-4,
            bound_of_99_percent: 5e-4,
            bound: 1e-3,
            measured: 1e-4,
            share: 0.1,
            exceeded,
            endless: 0.0,
            undecided,
            decisions: vec![("a tone", 3)],
            measured_at_decisions: 0.0,
        }
    }

    /// Without bounds nothing is known of f32, so nothing is kept.
    #[test]
    fn verdicts() {
        for (double, bounds, verdict) in [
            (Some(0.0), None, Verdict::NotProven),
            (Some(1.0), None, Verdict::Failed),
            (None, None, Verdict::NotProven),
            (None, Some(bounded(0, 0.05)), Verdict::Kept),
            (None, Some(bounded(1, 0.05)), Verdict::Failed),
            (Some(0.0), Some(bounded(0, 0.2)), Verdict::Failed),
            (Some(1.0), Some(bounded(0, 0.0)), Verdict::Failed),
        ] {
            let found = validation(double, bounds);
            assert_eq!(found.verdict(), verdict, "{found}");
            assert!(found.to_string().ends_with(&format!("\nverdict: {verdict}")), "{found}");
        }
        let said = validation(None, None).to_string();
        assert!(said.ends_with("\nhalos have no bounds\nverdict: not proven: no bound of f32 is known for this scene"));
        assert!(validation(None, Some(bounded(0, 0.0))).to_string().contains("\n  3 at a tone\nverdict: kept"));
    }
}
