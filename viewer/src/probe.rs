//! The thread that tells what is seen at a pixel: the numbers of `drypoint pick` and of `drypoint probe`.
//!
//! It has a job of its own, with the volume of the frames. It is made for the first question about a scene, and kept while
//! only the camera moves.

use crate::background::{Background, Desk};
use crate::frames::{only_turns, shot};
use drypoint::job::{Job, RenderTarget};
use drypoint::picking::{pick_pixel, room_to_probe};
use drypoint::reference::field::probe::at_index;
use drypoint::reference::field::{Field, Reconstruction, Rung};
use drypoint::reference::ray::{Picked, Renderer};
use drypoint::scene::picture::LayerKind;
use drypoint::scene::source::Disk;
use drypoint::scene::tables::Scene;
use drypoint::scene::volume::Volume;
use drypoint::scene::volume::info::short;
use drypoint::scene::volume::labels::LabelNames;
use drypoint::{Failure, Failures};
use std::num::NonZeroUsize;
use std::sync::Arc;

/// A question: what is seen at a pixel?
#[derive(Clone, Debug)]
pub struct PixelQuery {
    /// The serial number of the scene, which the answer names.
    pub serial: u64,
    /// The scene.
    pub scene: Arc<Scene>,
    /// The scene's volume.
    pub volume: Arc<Volume>,
    /// Column and row of the pixel in the scene's picture.
    pub pixel: [usize; 2],
    /// Whether the cross-hair is to move there.
    pub is_click: bool,
}

/// The answer to a [`PixelQuery`].
#[derive(Clone, Debug)]
pub struct PixelReport {
    /// The serial number of the scene.
    pub serial: u64,
    /// The pixel.
    pub pixel: [usize; 2],
    /// Whether the cross-hair is to move there.
    pub is_click: bool,
    /// The first visible place; none if nothing is visible.
    pub place: Result<Option<ProbedPlace>, Failures>,
}

/// A visible place and the field there.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbedPlace {
    /// The place, as `drypoint pick` prints it.
    pub picked: Picked,
    /// The name of its label, if it has one.
    pub label_name: Option<String>,
    /// Derivatives of the field. None if the place has its value from a part that is moved or from a volume of its own, if
    /// it lies on a mesh, or if there is no memory for them.
    pub derivatives: Option<Derivatives>,
}

/// Derivatives at a place, as `drypoint probe` prints them with the scene's `[sampling]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Derivatives {
    /// |∇f|, in value per world unit.
    pub magnitude: f64,
    /// κ1, the larger principal curvature, per world unit.
    pub k1: f64,
    /// κ2, the smaller principal curvature, per world unit.
    pub k2: f64,
}

impl ProbedPlace {
    /// Returns the numbers as lines of text: name and number.
    pub fn lines(&self) -> Vec<[String; 2]> {
        let place = self.picked.world.to_array().map(short).join(", ");
        let mut lines = vec![["place".into(), place], ["value".into(), short(self.picked.value)]];
        if let Some(Derivatives { magnitude, k1, k2 }) = self.derivatives {
            let numbers = [("|grad f|", magnitude), ("κ1", k1), ("κ2", k2)];
            lines.extend(numbers.map(|(name, number)| [name.into(), short(number)]));
        }
        if let Some(id) = self.picked.label {
            let name = self.label_name.as_ref().map(|name| format!(", {name}")).unwrap_or_default();
            lines.push(["label".into(), format!("{id}{name}")]);
        }
        lines
    }
}

/// A handle of the thread, which ends when it is dropped.
pub struct Prober(Background<PixelQuery, PixelReport>);

impl Prober {
    /// Starts the thread. `wake` is called after each answer, on the thread.
    pub fn new(wake: Box<dyn Fn() + Send>) -> Self {
        Self(Background::new("probe", wake, |desk| run(&desk)))
    }

    /// Asks a question in place of all before it.
    pub fn ask(&self, query: PixelQuery) {
        self.0.ask(query);
    }

    /// Returns the answers since the last call.
    pub fn answers(&self) -> impl Iterator<Item = PixelReport> + '_ {
        self.0.answers()
    }
}

type ProbeDesk = Desk<PixelQuery, PixelReport>;

fn run(desk: &ProbeDesk) {
    let mut next = desk.wait();
    while let Some(mut query) = next {
        let served = load(&query).and_then(|(job, names)| Ok(serve(desk, &job, &names, &mut query)?));
        next = served.unwrap_or_else(|failures| {
            let PixelQuery { serial, pixel, is_click, .. } = query;
            desk.answer(PixelReport { serial, pixel, is_click, place: Err(failures) });
            desk.wait()
        });
    }
}

/// Makes the job of a question, with its labels.
fn load(query: &PixelQuery) -> Result<(Job, LabelNames), Failures> {
    let mut scene = Scene::clone(&query.scene);
    scene.picture.layers = vec![LayerKind::Beauty];
    let mut job = Job::with_volume_for(scene, Arc::clone(&query.volume), RenderTarget::Picture, Arc::new(Disk))?;
    let names = job.load_labels()?;
    Ok((job, names))
}

/// Answers a question, and those after it whose scenes only move the camera. Each takes the place of the one before, so
/// that a failure is that of `query`. Returns the next question; none if the window is closed.
fn serve(
    desk: &ProbeDesk,
    job: &Job,
    names: &LabelNames,
    query: &mut PixelQuery,
) -> Result<Option<PixelQuery>, Failure> {
    let mut renderer = job.renderer()?;
    let mut field = None;
    loop {
        let PixelQuery { serial, pixel, is_click, .. } = *query;
        let picked = pick_pixel(&renderer, pixel);
        let report = |field: Option<&Field<'_, f64>>, is_click: bool| {
            let place = picked.map(|picked| ProbedPlace {
                label_name: picked.label.and_then(|id| names.name(id)).map(str::to_owned),
                derivatives: field.and_then(|field| derivatives(field, &picked)),
                picked,
            });
            desk.answer(PixelReport { serial, pixel, is_click, place: Ok(place) });
        };
        // To smooth a large volume takes seconds, so the place is told before.
        match &field {
            Some(field) => report(Option::as_ref(field), is_click),
            None => {
                report(None, is_click);
                report(field.insert(second_derivatives(job)).as_ref(), false);
            }
        }
        let Some(newer) = desk.wait() else { return Ok(None) };
        let before = std::mem::replace(query, newer);
        let is_same = Arc::ptr_eq(&before.volume, &query.volume);
        if !is_same || !follow(job, &mut renderer, [&before.scene, &query.scene])? {
            return Ok(Some(query.clone()));
        }
    }
}

/// Turns a job's renderer from one scene to another. Returns whether only the camera differs, as it must.
pub(crate) fn follow(job: &Job, renderer: &mut Renderer<'_>, [from, to]: [&Scene; 2]) -> Result<bool, Failure> {
    if !only_turns(from, to) {
        return Ok(false);
    }
    if to.camera != from.camera {
        let turned = renderer.turn(&shot(job, &to.camera, NonZeroUsize::MIN)?);
        turned.map_err(|error| Failure::new(error, "camera", "undo the last change"))?;
    }
    Ok(true)
}

/// Returns the field of a job with its second derivatives, if there is memory for it.
fn second_derivatives(job: &Job) -> Option<Field<'_, f64>> {
    let how = Reconstruction::of(&job.scene, job.volume.grid()).ok()?;
    room_to_probe(&job.volume, &how).ok()?;
    Field::new(&job.volume, how, Rung::Hessian).ok()
}

/// Share of the values' range by which the value of a picked place may differ from the field's there. On an iso-surface the
/// place is exact but for rounding, with a renderer in f32 to seven digits.
const SAME_VALUE: f64 = 1e-5;

fn derivatives(field: &Field<'_, f64>, picked: &Picked) -> Option<Derivatives> {
    let probed = at_index(field, picked.index, None)?;
    let [lo, hi] = field.volume().range();
    let is_own = picked.mesh.is_none() && (probed.value - picked.value).abs() <= SAME_VALUE * (hi - lo);
    is_own.then(|| Derivatives { magnitude: probed.gradient.length(), k1: probed.k1, k2: probed.k2 })
}
