//! The validation of a graphics card against the reference, on one scene ([GPU-1], [GPU-2]).

mod truth;

pub use truth::Truth;

use crate::Failure;
use crate::gpu::Gpu;
use crate::job::Job;
use drypoint_scene::picture::Picture;
use serde::Serialize;
use std::fmt;
use std::sync::atomic::AtomicBool;

/// The largest difference in f64, as a share of a stage's largest number, up to which algorithms count as the same.
pub const SAME: f64 = 1e-9;

/// The largest share of pixels at a decision or without a bound that a scene may have.
pub const MOST_OPEN: f64 = 0.1;

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
    let found = Truth::new(job, &[])?.validate(gpu, edit, &AtomicBool::new(false))?;
    Ok(found.unwrap_or_else(|| unreachable!("nothing stops the comparison")))
}

/// Like [`validate`]. Once `stop` is true, the comparison ends without a result. It is not looked at while bounds are
/// derived.
///
/// # Errors
/// The errors of [`validate`].
pub fn validate_until(job: &Job, gpu: &Gpu, stop: &AtomicBool) -> Result<Option<Validation>, Failure> {
    let Some(truth) = Truth::until(job, &[], stop)? else { return Ok(None) };
    truth.validate(gpu, &|text| text, stop)
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
