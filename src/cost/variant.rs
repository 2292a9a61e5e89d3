//! Output and time of settings.

use super::ErrorSubject;
use super::statistics::median;
use super::strokes::DrawnStrokes;
use super::tone::tone;
use crate::Failure;
use crate::backend::frames;
use crate::frames::Frames;
use crate::gpu::Gpu;
use crate::job::{Job, SceneVariant};
use crate::stippling::Stippling;
use crate::stroking::Stroking;
use drypoint_output::read::Image;
use drypoint_scene::counts::Counts;
use drypoint_scene::marks::{Marks, Page};
use drypoint_scene::tables::{Even, Scene};
use std::time::{Duration, Instant};

/// Bytes of prepared renderers that are kept from turn to turn. Beyond them a renderer is prepared anew each time.
const KEPT: u64 = 1 << 30;

/// Seconds beyond which a page of dots or strokes needs no warm-up and [`FEW`] turns suffice.
pub(super) const LONG: f64 = 2.0;

/// Number of turns of settings that take longer than [`LONG`].
pub(super) const FEW: usize = 3;

/// Number of strokes of a setting that are compared.
const STROKES: usize = 2000;

/// A scene that is drawn and timed. Several settings may lead to it.
pub(super) struct TimedVariant<'a> {
    job: &'a Job,
    pub(super) subject: ErrorSubject,
    pub(super) knobs: &'a SceneVariant,
    /// The graphics card that draws the volume; none stands for the reference.
    pub(super) card: Option<&'a Gpu>,
    /// Renderer for the next turn, if it may be kept.
    renderer: Option<Box<dyn Frames + 'a>>,
    /// Whether it may be kept.
    keeps: bool,
    /// Output and counts of the first turn, or its failure.
    pub(super) made: Option<Result<(SettingOutput, Counts), Failure>>,
    pub(super) seconds: Vec<f64>,
}

/// Output of a setting.
pub(super) enum SettingOutput {
    /// Output for [`ErrorSubject::Picture`].
    Picture(Image),
    /// Output for [`ErrorSubject::Dots`]: the tone of the page.
    Dots(Image),
    /// Output for [`ErrorSubject::Strokes`].
    Strokes(DrawnStrokes),
}

impl<'a> TimedVariant<'a> {
    pub(super) fn new(job: &'a Job, subject: ErrorSubject, knobs: &'a SceneVariant, card: Option<&'a Gpu>) -> Self {
        Self { job, subject, knobs, card, renderer: None, keeps: false, made: None, seconds: Vec::new() }
    }

    /// Whether the variant takes no more turns.
    pub(super) fn is_done(&self, runs: usize) -> bool {
        let is_long = self.subject != ErrorSubject::Picture && median(&self.seconds) > LONG;
        matches!(self.made, Some(Err(_))) || self.seconds.len() >= if is_long { runs.min(FEW) } else { runs }
    }

    /// Whether both variants draw the same points.
    fn has_points_of(&self, other: &Self) -> bool {
        let points = |scene: &Scene| {
            let mut scene = scene.clone();
            if let Some(stipples) = &mut scene.stipples {
                stipples.even = Even::None;
            }
            scene
        };
        [self.subject, other.subject] == [ErrorSubject::Dots; 2]
            && points(&self.knobs.scene) == points(&other.knobs.scene)
    }

    /// Times one frame of a picture. The first turn prepares and warms up. `kept` is the sum of kept bytes.
    fn take_picture(&mut self, kept: &mut u64) -> Result<(), Failure> {
        let mut counts = Counts::default();
        let mut renderer = match self.renderer.take() {
            Some(renderer) => renderer,
            None => frames(self.job, Some(self.knobs), self.card, &mut counts)?,
        };
        if self.made.is_some() {
            let start = Instant::now();
            renderer.show()?;
            self.seconds.push(start.elapsed().as_secs_f64());
            self.renderer = self.keeps.then_some(renderer);
            return Ok(());
        }
        let (picture, own) = renderer.frame(&|_| ())?;
        counts.add(&own);
        // A card that cannot show the picture is left out at once.
        if self.card.is_some() {
            renderer.show()?;
        }
        let shared = |name: &str| ["volume", "mask", "labels", "picture"].contains(&name);
        let own: u64 = counts.bytes.iter().filter(|(name, _)| !shared(name)).map(|(_, bytes)| bytes).sum();
        if *kept + own <= KEPT {
            *kept += own;
            self.keeps = true;
            self.renderer = Some(renderer);
        }
        self.made = Some(Ok((SettingOutput::Picture(Image::from(&picture)), counts)));
        Ok(())
    }

    /// Records a page that took `took`. The first turn is a warm-up: it keeps the output, and its time only if it is
    /// long.
    fn take_page(
        &mut self,
        took: Duration,
        made: impl FnOnce(&Job) -> Result<SettingOutput, Failure>,
        counts: Counts,
    ) -> Result<(), Failure> {
        let seconds = took.as_secs_f64();
        if self.made.is_some() || seconds > LONG {
            self.seconds.push(seconds);
        }
        if self.made.is_none() {
            self.made = Some(Ok((made(self.job)?, counts)));
        }
        Ok(())
    }
}

/// Returns groups of variants that take turns together. Dots of the same points form a group, whose points are made
/// once.
pub(super) fn together(variants: &[TimedVariant<'_>]) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for (at, variant) in variants.iter().enumerate() {
        match groups.iter_mut().find(|group| group.iter().any(|&first| variants[first].has_points_of(variant))) {
            Some(group) => group.push(at),
            None => groups.push(vec![at]),
        }
    }
    groups
}

/// Takes a turn of a group: one frame of a picture, or all of a page of dots or strokes, from the voxels on. A variant
/// that fails the first time takes no more turns.
pub(super) fn take_turn(variants: &mut [TimedVariant<'_>], group: &[usize], kept: &mut u64) -> Result<(), Failure> {
    for (place, &at) in group.iter().enumerate() {
        let is_first = variants[at].made.is_none();
        let done = match variants[at].subject {
            ErrorSubject::Picture => variants[at].take_picture(kept),
            ErrorSubject::Dots if place == 0 => take_dots(variants, group),
            ErrorSubject::Dots => Ok(()),
            ErrorSubject::Strokes => take_strokes(&mut variants[at]),
        };
        match done {
            Err(failure) if is_first => {
                group[place..].iter().for_each(|&at| variants[at].made = Some(Err(failure.clone())))
            }
            done => done?,
        }
    }
    Ok(())
}

/// Makes points and draws them for each variant of a group. The shared time counts for each.
fn take_dots(variants: &mut [TimedVariant<'_>], group: &[usize]) -> Result<(), Failure> {
    let TimedVariant { job, knobs, .. } = variants[group[0]];
    let mut counts = counts_of(job);
    let start = Instant::now();
    let mut stippling = Stippling::of(job, &knobs.scene, &mut counts, &|_| ())?;
    let shared = start.elapsed();
    for &at in group {
        let (variant, mut counts) = (&mut variants[at], counts.clone());
        let scene = &variant.knobs.scene;
        let start = Instant::now();
        if let Some(stipples) = &scene.stipples {
            stippling.set_even(stipples.even);
        }
        let marks = stippling.frames().draw(&job.view()?, &mut counts)?;
        let took = shared + start.elapsed();
        variant.take_page(took, |job| Ok(SettingOutput::Dots(tone(job, scene, &marks)?)), counts)?;
    }
    Ok(())
}

fn take_strokes(variant: &mut TimedVariant<'_>) -> Result<(), Failure> {
    let (job, scene) = (variant.job, &variant.knobs.scene);
    let mut counts = counts_of(job);
    let start = Instant::now();
    let stroking = Stroking::of(job, scene, &mut counts)?;
    let mut frames = stroking.frames(&mut counts);
    let [over, inside] = frames.draw(&job.view()?, &mut counts)?;
    let took = start.elapsed();
    let marks = || Marks { page: Page::of(scene), layers: over.into_iter().chain(inside).collect() };
    variant.take_page(
        took,
        |_| Ok(SettingOutput::Strokes(DrawnStrokes { strokes: frames.sample(STROKES), marks: marks() })),
        counts,
    )
}

fn counts_of(job: &Job) -> Counts {
    let mut counts = Counts::default();
    counts.bytes.insert("volume".into(), job.volume.voxels().bytes() as u64);
    counts
}
