//! What accuracy costs: every knob of a scene turned from coarse to fine, error against time ([COST-1] … [COST-3]).
//!
//! One knob is turned at a time; all other keys stay as the scene has them. A row is a setting: how far its picture is
//! from the truth, how long it takes, what it evaluates and keeps.
//!
//! **Truth** ([COST-2]). For a phantom the field itself is known: the knobs that decide how close the samples come to
//! it (step, kernel, gradient, Hessian, κ) are compared with one picture of the phantom's formula and its exact
//! derivatives, at their finest settings, without early termination. Where the error no longer falls with finer steps,
//! what is left of it is the voxels'. The knobs that are no matter of the field (rays a pixel, number type, early
//! termination, biases of mip-maps) are compared with the same scene at the finest setting, and so is every knob where
//! the field is not known.
//!
//! **Error** of what a knob changes ([`ErrorSubject`]):
//! - a picture, as it is written, with its background, in linear premultiplied light: the RMS and the largest difference
//!   over R, G, B and A, and the mean of FLIP;
//! - dots, as the page of them alone, painted in pixels no finer than S_max, and blurred by a Gaussian of σ = 4 S_max, the
//!   same three: the tone of a place counts, and how even it is, and not where a dot lies. Random dots that cover c leave
//!   √(c/256) of noise for each list, hence 0.4 % of the light at c = 0.005 and 3 % at c = 0.25; evenly spread ones a
//!   fraction of it;
//! - strokes, as lines in the world, cut into pieces of 0.1 voxel: RMS and largest of the distances of their ends to the
//!   other line, both ways, in voxels (the largest is Hausdorff's), the median angle at equal arc lengths, a voxel apart, in
//!   degrees, and FLIP of the painted page. Hatching is compared by 2000 of its strokes, as they grow from seeds that both
//!   have: which of them a page shows, and where it cuts them off, is no matter of a stroke's error. RMS and largest are of
//!   the 95 in 100 that are nearest; the others end elsewhere, or part where lines of curvature meet, whatever the setting.
//!   Outlines are compared as lists.
//!
//! **Time** ([COST-3]): of a picture one frame of a prepared scene, as `render --repeat` has it; what is prepared once
//! (coefficients of a spline, the range of |g|) is not in it, and is seen in the bytes. Of dots and strokes all of it, from
//! the voxels to the page, since what their knobs cost is made once. After a warm-up all settings take turns,
//! forwards and backwards, so that whatever else the machine does falls on each of them; what is told is the median, with
//! the distance between the quartiles as its spread. A page of more than two seconds has no warm-up and three turns at the
//! most; dots that differ in `stipples.even` alone are drawn from points that are made once for all of them.

mod error;
mod front;
mod plot;
mod statistics;
mod strokes;
mod sweep_format;
mod table;
mod tone;
mod variant;

pub use front::front;
pub use statistics::median;
pub use sweep_format::SweepFormat;
pub use table::{csv, markdown};

use crate::job::{Job, KnobVariant};
use crate::{Failure, Failures};
use drypoint_output::read::Image;
use drypoint_scene::knobs::{Knob, Limit, knobs};
use drypoint_scene::phantom::{self, Phantom};
use drypoint_scene::picture::LayerKind;
use drypoint_scene::plan::{Pass, Plan};
use drypoint_scene::tables::{Scene, VolumeSource};
use error::{SettingError, error};
use statistics::quartiles;
use std::fmt;
use variant::{SettingOutput, TimedVariant, take_turn, together};

/// How to sweep.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SweepOptions {
    /// How often each setting is timed, after the warm-up; at least 1.
    pub runs: usize,
    /// The keys of the knobs to turn; empty: all that the scene uses.
    pub only: Vec<String>,
}

impl Default for SweepOptions {
    fn default() -> Self {
        Self { runs: 5, only: Vec::new() }
    }
}

/// What an error is measured against.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Truth {
    /// The phantom's formula, at the finest settings.
    Analytic,
    /// The same scene with the knob's finest setting.
    Finest(String),
}

impl fmt::Display for Truth {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Analytic => write!(f, "analytic"),
            Self::Finest(setting) => write!(f, "finest: {setting}"),
        }
    }
}

/// What a knob changes, and its error is measured on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorSubject {
    /// The picture of the volume: light.
    Picture,
    /// The page of dots, blurred: light.
    Dots,
    /// Strokes in the world: voxels.
    Strokes,
}

impl ErrorSubject {
    /// Each of them.
    pub const ALL: [Self; 3] = [Self::Picture, Self::Dots, Self::Strokes];

    /// What a knob of a scene changes: what its table draws, or the first that reads the field.
    fn of(knob: &Knob, plan: &Plan) -> Self {
        match knob.key.split(['.', '[']).next() {
            Some("stipples") => Self::Dots,
            Some("hatching") => Self::Strokes,
            _ if plan.has_pass(Pass::Rays) => Self::Picture,
            _ if plan.has_pass(Pass::HiddenPoints) => Self::Dots,
            _ => Self::Strokes,
        }
    }
}

/// A setting of a knob, and what it costs.
#[derive(Clone, Debug, PartialEq)]
pub struct CostRow {
    /// The scene key.
    pub knob: String,
    /// What the error is of.
    pub subject: ErrorSubject,
    /// What it was set to.
    pub setting: String,
    /// Whether it is what the scene says.
    pub own: bool,
    /// Root mean square difference: of light, or of places in voxels ([`ErrorSubject`]).
    pub rms: f64,
    /// Largest difference.
    pub max: f64,
    /// Mean of FLIP.
    pub flip: f64,
    /// Of hatching: degrees between strokes at equal arc lengths, the median.
    pub angle: Option<f64>,
    /// Median seconds of a frame; of dots and strokes with what is made once.
    pub seconds: f64,
    /// Seconds between the quartiles.
    pub spread: f64,
    /// Samples evaluated.
    pub samples: u64,
    /// Bytes of all buffers: the volume, what was prepared, the picture.
    pub bytes: u64,
    /// What the error is measured against.
    pub truth: Truth,
}

/// What a sweep found.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// The knobs in the order of the scene's tables, each from coarse to fine; a setting of the scene's own that is none
    /// of the knob's comes first.
    pub rows: Vec<CostRow>,
    /// Settings that cannot be rendered, and why.
    pub left_out: Vec<(String, String, Failure)>,
    /// Times each setting was timed.
    pub runs: usize,
    /// Threads that rendered.
    pub threads: usize,
    /// Pixels of the picture.
    pub size: [usize; 2],
}

/// Turns every knob of a job's scene. `progress` hears the share that is done.
///
/// # Errors
/// A key among `only` that is no knob of the scene, a truth that cannot be drawn.
pub fn sweep(job: &Job, options: &SweepOptions, progress: &dyn Fn(f64)) -> Result<Sweep, Failures> {
    // Other layers are no part of the error, and would be part of the time.
    let mut base = job.scene.clone();
    base.picture.layers = vec![LayerKind::Beauty];
    let plan = job.variant(base.clone()).plan;
    let all = knobs(&base, &plan);
    let turned = chosen(&all, &options.only, job)?;
    if let Some((knob, own)) = all.iter().find_map(|knob| Some((knob, knob.of(&base)?))) {
        // Through the text that all settings go through, so that equal scenes are equal.
        base = knob.set(&base, &own)?;
    }
    let phantom = match &base.volume.source {
        VolumeSource::Phantom(source) => phantom::of_source(source).ok().map(|(phantom, _)| phantom),
        VolumeSource::File { .. } => None,
    };
    let mut different: Vec<(ErrorSubject, KnobVariant)> = Vec::new();
    let mut settings: Vec<(&Knob, String, usize)> = Vec::new();
    for knob in &turned {
        let subject = ErrorSubject::of(knob, &plan);
        let mut scenes = Vec::new();
        for setting in knob.settings {
            scenes.push(((*setting).to_owned(), knob.set(&base, setting)?));
        }
        if scenes.iter().all(|(_, scene)| *scene != base)
            && let Some(own) = knob.of(&base)
        {
            scenes.insert(0, (own, base.clone()));
        }
        for (setting, scene) in scenes {
            let known = different.iter().position(|other| other.0 == subject && other.1.scene == scene);
            let at = known.unwrap_or(different.len());
            if known.is_none() {
                different.push((subject, job.variant(scene)));
            }
            settings.push((knob, setting, at));
        }
    }
    let is_of_field =
        |knob: &Knob| knob.limit == Limit::Field && ErrorSubject::of(knob, &plan) == ErrorSubject::Picture;
    let of_field = turned.iter().any(|knob| is_of_field(knob));
    let analytic = phantom.filter(|_| of_field).map(|phantom| exact(job, &base, &all, &*phantom)).transpose()?;
    let mut variants: Vec<TimedVariant> =
        different.iter().map(|(subject, knobs)| TimedVariant::new(job, *subject, knobs)).collect();
    time(&mut variants, options.runs.max(1), progress)?;

    let mut found = Sweep {
        rows: Vec::new(),
        left_out: Vec::new(),
        runs: options.runs.max(1),
        threads: rayon::current_num_threads(),
        size: base.picture.size,
    };
    for (knob, setting, at) in &settings {
        let variant = &variants[*at];
        let finest = settings.iter().rev().find(|(other, ..)| other.key == knob.key).map_or(*at, |(.., at)| *at);
        let (truth, of_truth) = match &analytic {
            Some(image) if is_of_field(knob) => (Truth::Analytic, image),
            _ => match &variants[finest].made {
                Some(Ok((made, _))) => (Truth::Finest(knob.finest().into()), made),
                Some(Err(failure)) => return Err(failure.clone().into()),
                // Each takes a first turn.
                None => continue,
            },
        };
        let left_out = |failure: &Failure| (knob.key.clone(), setting.clone(), failure.clone());
        let (made, counts) = match &variant.made {
            Some(Ok(made)) => made,
            Some(Err(failure)) => {
                found.left_out.push(left_out(failure));
                continue;
            }
            None => continue,
        };
        let SettingError { rms, max, flip, angle } = match error(job, made, of_truth) {
            Ok(error) => error,
            Err(failure) => {
                found.left_out.push(left_out(&failure));
                continue;
            }
        };
        let quartiles = quartiles(&variant.seconds);
        found.rows.push(CostRow {
            knob: knob.key.clone(),
            subject: variant.subject,
            setting: setting.clone(),
            own: variant.knobs.scene == base,
            rms,
            max,
            flip,
            angle,
            seconds: median(&variant.seconds),
            spread: quartiles[1] - quartiles[0],
            samples: counts.samples,
            bytes: counts.bytes.values().sum(),
            truth,
        });
    }
    Ok(found)
}

/// The knobs that were asked for.
fn chosen<'k>(all: &'k [Knob], only: &[String], job: &Job) -> Result<Vec<&'k Knob>, Failures> {
    let unknown = |key: &&String| all.iter().all(|knob| knob.key != **key);
    Failures::check(only.iter().filter(unknown).map(|key| {
        let keys: Vec<&str> = all.iter().map(|knob| knob.key.as_str()).collect();
        let remedy = format!("the knobs of this scene are {}", keys.join(", "));
        Failure::new(format!("{key:?} is no knob that the scene uses"), job.scene.given.position(""), remedy)
    }))?;
    Ok(all.iter().filter(|knob| only.is_empty() || only.contains(&knob.key)).collect())
}

/// The picture of a phantom's formula, every knob of the field at its finest.
fn exact(job: &Job, base: &Scene, all: &[Knob], phantom: &dyn Phantom) -> Result<SettingOutput, Failures> {
    let mut scene = base.clone();
    for knob in all.iter().filter(|knob| knob.limit == Limit::Field) {
        scene = knob.set(&scene, knob.finest())?;
    }
    scene.sampling.stop_below = 0.0;
    let turned = job.variant(scene);
    let (picture, _) = job.exact_renderer_of(&turned, phantom)?.frame(&|_| ());
    Ok(SettingOutput::Picture(Image::from(&picture)))
}

/// Draws and times every setting, in turns.
fn time(variants: &mut [TimedVariant], runs: usize, progress: &dyn Fn(f64)) -> Result<(), Failure> {
    let groups = together(variants);
    let total = (runs + 1) * groups.len();
    let (mut kept, mut done) = (0, 0);
    // The first turn warms up.
    for turn in 0..=runs {
        let forwards = 0..groups.len();
        let turns: Vec<usize> = if turn % 2 == 0 { forwards.collect() } else { forwards.rev().collect() };
        for at in turns {
            let group = &groups[at];
            if !group.iter().all(|&at| variants[at].is_done(runs)) {
                take_turn(variants, group, &mut kept)?;
            }
            done += 1;
            progress(done as f64 / total as f64);
        }
    }
    Ok(())
}
