//! Cost of accuracy: error against time for every knob of a scene, from coarse to fine ([COST-1] … [COST-3]).
//!
//! One knob is changed at a time; all other keys stay as in the scene. A row is a setting: its error against the truth,
//! its time, its samples and its bytes.
//!
//! **Truth** ([COST-2]). The field of a phantom is known. Knobs of the field (step, kernel, gradient, Hessian, κ)
//! decide how close samples come to it. They are compared with one picture of the phantom's formula and its exact
//! derivatives, at their finest settings and without early termination. Where finer steps no longer reduce the error,
//! the rest is due to the voxels. Other knobs (rays a pixel, number type, early termination, biases of mip-maps) are
//! compared with the same scene at the finest setting. So is every knob of a field that is not known.
//!
//! With `picture.samples = "auto"` a setting can change which pixels are refined at edges. This is then part of its
//! error. Scenes with one ray for each pixel measure a knob alone.
//!
//! **Error** of a knob's output, by its subject ([`ErrorSubject`]):
//! - A picture as written, with its background, in linear premultiplied light: RMS and largest difference over R, G, B
//!   and A, and the mean of FLIP.
//! - Dots: the same three for the page of dots alone. It is painted in pixels no finer than S_max and blurred by a
//!   Gaussian of σ = 4 S_max. The tone and evenness of a place count, not where a dot lies. Random dots of coverage c
//!   leave noise of √(c/256) for each list, hence 0.4 % of the light at c = 0.005 and 3 % at c = 0.25. Evenly spread
//!   dots leave a fraction of it.
//! - Strokes, as lines in the world, cut into pieces of 0.1 voxel. RMS and largest distance of the pieces' ends to the
//!   other line, both ways, are in voxels; the largest is Hausdorff's distance. The median angle at equal arc lengths,
//!   a voxel apart, is in degrees; FLIP is of the painted page. Hatching is compared by 2000 of its strokes, grown from
//!   seeds that both have. Which strokes a page shows, and where it cuts them, is no error. RMS and largest are of the
//!   nearest 95 %; the others end elsewhere, or part where lines of curvature meet, whatever the setting. Outlines are
//!   compared as lists.
//!
//! **Time** ([COST-3]) of a picture is one frame of a prepared scene, as in `render --repeat`. A graphics card has it in a
//! texture then, as a viewer does. Work done once
//! (coefficients of a spline, the range of |g|) is not in the time but in the bytes. Time of dots and strokes is
//! everything from the voxels to the page, since their knobs change work done once. After a warm-up all settings take
//! turns, forwards and backwards, so that other load falls on each of them. The result is the median, and the distance
//! between the quartiles is its spread. A page of more than two seconds has no warm-up and at most three turns. Dots
//! that differ in `stipples.even` alone share points made once.

mod error;
mod front;
#[cfg(feature = "plots")]
mod plot;
mod statistics;
mod strokes;
#[cfg(feature = "plots")]
mod sweep_format;
mod table;
mod tone;
mod variant;

pub use front::front;
pub use statistics::median;
#[cfg(feature = "gpu")]
pub(crate) use statistics::quantile;
#[cfg(feature = "plots")]
pub use sweep_format::SweepFormat;
pub use table::{csv, markdown};

use crate::gpu::Gpu;
use crate::job::{Job, SceneVariant};
use crate::{Failure, Failures};
use drypoint_output::read::Image;
use drypoint_scene::knobs::{Knob, Limit, knobs};
use drypoint_scene::parallel;
use drypoint_scene::phantom::{self, Phantom};
use drypoint_scene::picture::LayerKind;
use drypoint_scene::plan::{Pass, Plan};
use drypoint_scene::tables::{Scene, VolumeSource};
use error::{SettingError, error};
use statistics::quartiles;
use std::fmt;
use variant::{SettingOutput, TimedVariant, take_turn, together};

/// The key of the knob that selects the renderer of the volume.
pub const BACKEND: &str = "backend";

/// The finest setting of [`BACKEND`].
const REFERENCE: &str = "reference";

/// Settings of a sweep.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SweepOptions {
    /// Number of times each setting is timed after the warm-up; at least 1.
    pub runs: usize,
    /// Keys of the knobs to change. Empty stands for all knobs that the scene uses.
    pub only: Vec<String>,
}

impl Default for SweepOptions {
    fn default() -> Self {
        Self { runs: 5, only: Vec::new() }
    }
}

/// The truth against which an error is measured.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Truth {
    /// The phantom's formula, at the finest settings.
    Analytic,
    /// The scene itself with the knob's finest setting.
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

/// The output that a knob changes, on which its error is measured.
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
    /// Returns the subject of a knob: the output of its table, or else the first output that reads the field.
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

/// A setting of a knob, with its error and its cost.
#[derive(Clone, Debug, PartialEq)]
pub struct CostRow {
    /// The scene key.
    pub knob: String,
    /// The output on which the error is measured.
    pub subject: ErrorSubject,
    /// The setting.
    pub setting: String,
    /// Whether the setting is the scene's own.
    pub own: bool,
    /// Root mean square difference: of light, or of places in voxels ([`ErrorSubject`]).
    pub rms: f64,
    /// Largest difference.
    pub max: f64,
    /// Mean of FLIP.
    pub flip: f64,
    /// Median angle between strokes of hatching at equal arc lengths, in degrees.
    pub angle: Option<f64>,
    /// Median seconds of a frame. For dots and strokes it includes the work done once.
    pub seconds: f64,
    /// Seconds between the quartiles.
    pub spread: f64,
    /// Samples evaluated.
    pub samples: u64,
    /// Bytes of all buffers: the volume, prepared data, the picture.
    pub bytes: u64,
    /// The truth against which the error is measured.
    pub truth: Truth,
}

/// The result of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// Rows in the order of the scene's tables, each knob from coarse to fine. If the scene's own setting is not one of
    /// the knob's settings, it comes first.
    pub rows: Vec<CostRow>,
    /// Settings that cannot be rendered: knob, setting and reason.
    pub left_out: Vec<(String, String, Failure)>,
    /// Number of times each setting was timed.
    pub runs: usize,
    /// Number of threads.
    pub threads: usize,
    /// Pixels of the picture.
    pub size: [usize; 2],
}

/// Changes every knob of a job's scene. `cards` are graphics cards with their names, from coarse to fine. They are
/// settings of the knob [`BACKEND`], whose finest setting is the reference. `progress` receives the finished share.
///
/// # Errors
/// A key in `only` is not a knob of the scene, or a truth cannot be drawn.
pub fn sweep(
    job: &Job,
    options: &SweepOptions,
    cards: &[(&'static str, Gpu)],
    progress: &dyn Fn(f64),
) -> Result<Sweep, Failures> {
    // The scene and its knobs. Other layers are not part of the error and would add time.
    let mut base = job.scene.clone();
    base.picture.layers = vec![LayerKind::Beauty];
    let plan = job.variant(base.clone()).plan;
    let mut all = knobs(&base, &plan);
    if !cards.is_empty() && plan.has_pass(Pass::Rays) {
        all.push(Knob { key: BACKEND.into(), settings: &[REFERENCE], limit: Limit::Finest });
    }
    let turned = chosen(&all, &options.only, job)?;
    let keys = || all.iter().filter(|knob| knob.key != BACKEND);
    if let Some((knob, own)) = keys().find_map(|knob| Some((knob, knob.of(&base)?))) {
        // The base goes through the same text as all settings, so that equal scenes compare equal.
        base = knob.set(&base, &own)?;
    }
    let (different, settings) = settings(&turned, job, (&base, &plan), cards)?;
    // The truth of a phantom is its formula, which serves all knobs of the field.
    let phantom = match &base.volume.source {
        // The formula has all parts, and objects are drawn from voxels.
        VolumeSource::Phantom(source) if base.volume.parts.is_none() && base.objects.is_empty() => {
            phantom::of_source(source).ok().map(|(phantom, _)| phantom)
        }
        VolumeSource::Phantom(_) | VolumeSource::File { .. } => None,
    };
    let is_of_field =
        |knob: &Knob| knob.limit == Limit::Field && ErrorSubject::of(knob, &plan) == ErrorSubject::Picture;
    let of_field = turned.iter().any(|knob| is_of_field(knob));
    let analytic = phantom.filter(|_| of_field).map(|phantom| exact(job, &base, &all, &*phantom)).transpose()?;
    // Output and time of every scene.
    let mut variants: Vec<TimedVariant> =
        different.iter().map(|(subject, knobs, card)| TimedVariant::new(job, *subject, knobs, *card)).collect();
    time(&mut variants, options.runs.max(1), progress)?;

    // Rows: each setting against its truth.
    let mut found = Sweep {
        rows: Vec::new(),
        left_out: Vec::new(),
        runs: options.runs.max(1),
        threads: parallel::threads(),
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
                // Every variant has taken its first turn.
                None => continue,
            },
        };
        // Every variant has taken its first turn.
        let Some(made) = &variant.made else { continue };
        let compared = made.as_ref().map_err(Clone::clone).and_then(|(made, counts)| {
            let error = error(job, made, of_truth)?;
            Ok((error, counts))
        });
        let (SettingError { rms, max, flip, angle }, counts) = match compared {
            Ok(compared) => compared,
            Err(failure) => {
                found.left_out.push((knob.key.clone(), setting.clone(), failure));
                continue;
            }
        };
        let quartiles = quartiles(&variant.seconds);
        found.rows.push(CostRow {
            knob: knob.key.clone(),
            subject: variant.subject,
            setting: setting.clone(),
            own: variant.knobs.scene == base && variant.card.is_none(),
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

/// Returns the requested knobs.
fn chosen<'k>(all: &'k [Knob], only: &[String], job: &Job) -> Result<Vec<&'k Knob>, Failures> {
    let unknown = |key: &&String| all.iter().all(|knob| knob.key != **key);
    Failures::check(only.iter().filter(unknown).map(|key| {
        let keys: Vec<&str> = all.iter().map(|knob| knob.key.as_str()).collect();
        let remedy = format!("the knobs of this scene are {}", keys.join(", "));
        Failure::new(format!("{key:?} is no knob that the scene uses"), job.scene.given.position(""), remedy)
    }))?;
    Ok(all.iter().filter(|knob| only.is_empty() || only.contains(&knob.key)).collect())
}

/// A scene that is drawn for its output, and the graphics card that draws it; none: the reference.
type DistinctScene<'c> = (ErrorSubject, SceneVariant, Option<&'c Gpu>);

/// A knob, its setting, and the index of the scene to which it leads.
type KnobSetting<'k> = (&'k Knob, String, usize);

/// The distinct scenes to which the settings of knobs lead, and every setting.
fn settings<'k, 'c>(
    turned: &[&'k Knob],
    job: &Job,
    (base, plan): (&Scene, &Plan),
    cards: &'c [(&'static str, Gpu)],
) -> Result<(Vec<DistinctScene<'c>>, Vec<KnobSetting<'k>>), Failures> {
    let mut different: Vec<DistinctScene> = Vec::new();
    let mut settings = Vec::new();
    for &knob in turned {
        let subject = ErrorSubject::of(knob, plan);
        // The scenes of this knob, from coarse to fine; the scene's own setting first if it is none of them.
        let mut scenes = Vec::new();
        if knob.key == BACKEND {
            scenes.extend(cards.iter().map(|(name, gpu)| ((*name).to_owned(), base.clone(), Some(gpu))));
            scenes.push((REFERENCE.to_owned(), base.clone(), None));
        } else {
            for setting in knob.settings {
                scenes.push(((*setting).to_owned(), knob.set(base, setting)?, None));
            }
            if scenes.iter().all(|(_, scene, _)| scene != base)
                && let Some(own) = knob.of(base)
            {
                scenes.insert(0, (own, base.clone(), None));
            }
        }
        // A scene that is already there is not drawn again.
        for (setting, scene, card) in scenes {
            let is_same = |other: &DistinctScene| {
                let place = |card: Option<&Gpu>| card.map(std::ptr::from_ref);
                other.0 == subject && place(other.2) == place(card) && other.1.scene == scene
            };
            let known = different.iter().position(is_same);
            let at = known.unwrap_or(different.len());
            if known.is_none() {
                different.push((subject, job.variant(scene), card));
            }
            settings.push((knob, setting, at));
        }
    }
    Ok((different, settings))
}

/// Draws a phantom's formula with every knob of the field at its finest setting.
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
