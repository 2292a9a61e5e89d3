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
//! **Error**: of the picture as it is written, with its background, in linear premultiplied light: the RMS and the
//! largest difference over R, G, B and A, and the mean of FLIP.
//!
//! **Time** ([COST-3]): of one frame of a prepared scene, as `render --repeat` has it; what is prepared once (coefficients
//! of a spline, the range of |g|) is not in it, and is seen in the bytes. After a warm-up all settings take turns,
//! forwards and backwards, so that whatever else the machine does falls on each of them; what is told is the median, with
//! the distance between the quartiles as its spread.

mod form;
mod front;
mod plot;
mod statistics;
mod table;

pub use form::Form;
pub use front::front;
pub use table::{csv, markdown};

use crate::job::{Job, Turned};
use crate::{Failure, Failures};
use drypoint_output::compare::{Options as How, compare};
use drypoint_output::read::Image;
use drypoint_reference::ray::Renderer;
use drypoint_scene::counts::Counts;
use drypoint_scene::knobs::{Knob, Limit, knobs};
use drypoint_scene::phantom::{self, Phantom};
use drypoint_scene::picture::LayerKind;
use drypoint_scene::tables::{Scene, VolumeSource};
use statistics::{median, quartiles};
use std::fmt;
use std::time::Instant;

/// How to sweep.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Options {
    /// How often each setting is timed, after the warm-up; at least 1.
    pub runs: usize,
    /// The keys of the knobs to turn; empty: all that the scene uses.
    pub only: Vec<String>,
}

impl Default for Options {
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

/// A setting of a knob, and what it costs.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The scene key.
    pub knob: String,
    /// What it was set to.
    pub setting: String,
    /// Whether it is what the scene says.
    pub own: bool,
    /// Root mean square difference.
    pub rms: f64,
    /// Largest difference.
    pub max: f64,
    /// Mean of FLIP.
    pub flip: f64,
    /// Median seconds of a frame.
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
    pub rows: Vec<Row>,
    /// Settings that cannot be rendered, and why.
    pub left_out: Vec<(String, String, Failure)>,
    /// Times each setting was timed.
    pub runs: usize,
    /// Threads that rendered.
    pub threads: usize,
    /// Pixels of the picture.
    pub size: [usize; 2],
}

/// Bytes that are kept prepared from turn to turn; what is more is prepared anew each time.
const KEPT: u64 = 1 << 30;

/// A scene that is rendered, whatever knobs lead to it.
struct Variant<'a> {
    job: &'a Job,
    turned: &'a Turned,
    /// Ready for the next turn, where it may be kept.
    renderer: Option<Renderer<'a>>,
    /// Its picture and its counts, or why there is none.
    made: Result<(Image, Counts), Failure>,
    seconds: Vec<f64>,
}

impl<'a> Variant<'a> {
    /// Prepares and warms up; `kept` counts what the variants keep.
    fn new(job: &'a Job, turned: &'a Turned, kept: &mut u64) -> Self {
        let mut renderer = None;
        let made = job.renderer_of(turned).map(|ready| {
            let (picture, counts) = ready.frame(&|_| ());
            let shared = |name: &str| ["volume", "mask", "labels", "picture"].contains(&name);
            let own: u64 = counts.bytes.iter().filter(|(name, _)| !shared(name)).map(|(_, bytes)| bytes).sum();
            if *kept + own <= KEPT {
                *kept += own;
                renderer = Some(ready);
            }
            (Image::from(&picture), counts)
        });
        Self { job, turned, renderer, made, seconds: Vec::new() }
    }

    /// Times one frame.
    fn take_turn(&mut self) -> Result<(), Failure> {
        let anew;
        let renderer = match &self.renderer {
            Some(renderer) => renderer,
            None => {
                anew = self.job.renderer_of(self.turned)?;
                &anew
            }
        };
        let start = Instant::now();
        renderer.frame(&|_| ());
        self.seconds.push(start.elapsed().as_secs_f64());
        Ok(())
    }
}

/// Turns every knob of a job's scene. `progress` hears the share that is done.
///
/// # Errors
/// A key among `only` that is no knob of the scene, a scene without a knob, a truth that cannot be rendered.
pub fn sweep(job: &Job, options: &Options, progress: &dyn Fn(f64)) -> Result<Sweep, Failures> {
    if !job.draws_volume() {
        let what = "what accuracy costs is measured on the volume, which this scene does not draw itself";
        return Err(Failure::new(what, job.scene.given.position("transfer"), "add a [transfer] table").into());
    }
    // Other layers are no part of the error, and would be part of the time.
    let mut base = job.scene.clone();
    base.picture.layers = vec![LayerKind::Beauty];
    let all = knobs(&base, &job.turned(base.clone()).plan);
    let turned = chosen(&all, &options.only, job)?;
    if let Some((knob, own)) = all.iter().find_map(|knob| Some((knob, knob.of(&base)?))) {
        // Through the text that all settings go through, so that equal scenes are equal.
        base = knob.set(&base, &own)?;
    }
    let phantom = match &base.volume.source {
        VolumeSource::Phantom(source) => phantom::of_source(source).ok().map(|(phantom, _)| phantom),
        VolumeSource::File { .. } => None,
    };
    let mut different: Vec<Turned> = Vec::new();
    let mut settings: Vec<(&Knob, String, usize)> = Vec::new();
    for knob in &turned {
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
            let known = different.iter().position(|other| other.scene == scene);
            let at = known.unwrap_or(different.len());
            if known.is_none() {
                different.push(job.turned(scene));
            }
            settings.push((knob, setting, at));
        }
    }
    let of_field = turned.iter().any(|knob| knob.limit == Limit::Field);
    let analytic = phantom.filter(|_| of_field).map(|phantom| exact(job, &base, &all, &*phantom)).transpose()?;
    let mut kept = 0;
    let mut variants: Vec<Variant> = different.iter().map(|scene| Variant::new(job, scene, &mut kept)).collect();
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
        let (truth, image) = match (&analytic, knob.limit) {
            (Some(image), Limit::Field) => (Truth::Analytic, image),
            _ => match &variants[finest].made {
                Ok((image, _)) => (Truth::Finest(knob.finest().into()), image),
                Err(failure) => return Err(failure.clone().into()),
            },
        };
        match &variant.made {
            Ok((picture, counts)) => {
                let error = compare(picture, image, &How::default())
                    .map_err(|error| Failure::picture(&error, job.scene.given.position("picture.size")))?;
                let quartiles = quartiles(&variant.seconds);
                found.rows.push(Row {
                    knob: knob.key.clone(),
                    setting: setting.clone(),
                    own: variant.turned.scene == base,
                    rms: error.rms,
                    max: error.max,
                    // Both pictures have colours.
                    flip: error.flip.unwrap_or(f64::NAN),
                    seconds: median(&variant.seconds),
                    spread: quartiles[1] - quartiles[0],
                    samples: counts.samples,
                    bytes: counts.bytes.values().sum(),
                    truth,
                });
            }
            Err(failure) => found.left_out.push((knob.key.clone(), setting.clone(), failure.clone())),
        }
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
fn exact(job: &Job, base: &Scene, all: &[Knob], phantom: &dyn Phantom) -> Result<Image, Failures> {
    let mut scene = base.clone();
    for knob in all.iter().filter(|knob| knob.limit == Limit::Field) {
        scene = knob.set(&scene, knob.finest())?;
    }
    scene.sampling.stop_below = 0.0;
    let turned = job.turned(scene);
    let (picture, _) = job.exact_renderer_of(&turned, phantom)?.frame(&|_| ());
    Ok(Image::from(&picture))
}

/// Times every picture that there is, in turns.
fn time(variants: &mut [Variant], runs: usize, progress: &dyn Fn(f64)) -> Result<(), Failure> {
    let total = runs * variants.len();
    let mut done = 0;
    for run in 0..runs {
        let forwards = 0..variants.len();
        let turns: Vec<usize> = if run % 2 == 0 { forwards.collect() } else { forwards.rev().collect() };
        for at in turns {
            let variant = &mut variants[at];
            if variant.made.is_ok() {
                variant.take_turn()?;
            }
            done += 1;
            progress(done as f64 / total as f64);
        }
    }
    Ok(())
}
