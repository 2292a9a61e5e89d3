//! The thread that owns a scene's data and draws its frames.
//!
//! A request is the scene as it stands. The newest request is drawn, and stops the one before it. A request that only
//! moves the camera prepares nothing. While requests come quickly, frames are coarse if exact ones would take long.
//!
//! | the scene | with a card | without one |
//! |---|---|---|
//! | the volume alone | [`GpuFrames::show`](drypoint::frames::Frames::show) into a texture of the window's device | the reference, in pixels |
//! | with points, lines or annotations | the volume while the camera moves, then [`Drawing`] | the same |

use crate::canvas::{self, Canvas, Drawn, Pace, Pixels};
use crate::mailbox::{Mail, Mailbox};
use crate::present::Presenter;
use drypoint::drawing::Drawing;
use drypoint::frames::ReferenceFrames;
use drypoint::gpu::{Gpu, GpuFrames};
use drypoint::job::{Job, RenderTarget, read_volume};
use drypoint::marking::Marking;
use drypoint::scene::counts::Counts;
use drypoint::scene::shot::Shot;
use drypoint::scene::source::Disk;
use drypoint::scene::tables::{Camera, Scene, VolumeTable};
use drypoint::scene::view::View;
use drypoint::scene::volume::Volume;
use drypoint::scene::volume::histogram::Histogram;
use drypoint::{Failure, Failures};
use std::num::NonZeroUsize;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Bins of a volume's histogram.
const BINS: usize = 256;

/// Pause after which a camera is taken to rest.
const REST: Duration = Duration::from_millis(150);

/// A scene to draw.
#[derive(Clone, Debug)]
pub struct Request {
    /// The revision of the document, which the answers name.
    pub revision: u64,
    /// The scene.
    pub scene: Scene,
    /// Most pixels of the longer side. A larger picture is drawn smaller, unless it has lengths on a page.
    pub longest: usize,
}

/// A frame.
pub struct Frame {
    /// The revision of the document that it shows.
    pub revision: u64,
    /// Width and height in pixels.
    pub size: [usize; 2],
    /// The pixels.
    pub pixels: Pixels,
    /// Whether an exact frame follows.
    pub is_coarse: bool,
    /// Seconds of drawing.
    pub seconds: f64,
}

/// The volume of a scene with its histogram.
#[derive(Clone, Debug)]
pub struct VolumeData {
    /// The volume.
    pub volume: Arc<Volume>,
    /// Counts of its values.
    pub histogram: Histogram,
}

/// An answer of the thread.
pub enum Answer {
    /// Another volume was loaded.
    Loaded(Arc<VolumeData>),
    /// A job was made, with these warnings. Its scene has what was found in the data.
    Prepared(Arc<Scene>, Vec<String>),
    /// A frame was drawn.
    Drawn(Frame),
    /// The scene of a revision could not be drawn.
    Failed(u64, Failures),
}

/// A handle of the thread, which ends when it is dropped.
pub struct Worker {
    mailbox: Arc<Mailbox<Box<Request>>>,
    answers: Receiver<Answer>,
    thread: Option<JoinHandle<()>>,
}

impl Worker {
    /// Starts the thread. `wake` is called after each answer, on the thread.
    pub fn new(card: Option<Gpu>, wake: Box<dyn Fn() + Send>) -> Self {
        let mailbox = Arc::new(Mailbox::new());
        let (sender, answers) = channel();
        let (card, mailbox_of) = (card.map(Presenter::new), Arc::clone(&mailbox));
        let artist =
            Artist { mailbox: mailbox_of, sender, wake, card, on_card: None, data: None, pace: Pace::default() };
        let thread = std::thread::Builder::new().name("frames".into()).spawn(|| artist.run()).ok();
        Self { mailbox, answers, thread }
    }

    /// Asks for frames of a scene, in place of all before.
    pub fn ask(&self, request: Request) {
        self.mailbox.put(Box::new(request));
    }

    /// Returns the answers since the last call.
    pub fn answers(&self) -> impl Iterator<Item = Answer> + '_ {
        self.answers.try_iter()
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.mailbox.close();
        // A thread that panicked has nothing to hand over.
        let _ = self.thread.take().map(JoinHandle::join);
    }
}

/// The thread's own state.
struct Artist {
    mailbox: Arc<Mailbox<Box<Request>>>,
    sender: Sender<Answer>,
    wake: Box<dyn Fn() + Send>,
    card: Option<Presenter>,
    /// Frames on the card, which outlive the jobs that they were made from.
    on_card: Option<Box<GpuFrames>>,
    data: Option<(VolumeTable, Arc<VolumeData>)>,
    pace: Pace,
}

/// The end of the work on a job.
enum Next {
    Request(Box<Request>),
    Closed,
}

impl Artist {
    fn run(mut self) {
        let mut next = self.wait();
        while let Next::Request(mut request) = next {
            request.scene.picture.size = shown_size(&request.scene, request.longest);
            let revision = request.revision;
            let served = self.job(&request.scene).and_then(|job| Ok(self.serve(&job, request)?));
            next = served.unwrap_or_else(|failures| {
                self.answer(Answer::Failed(revision, failures));
                self.wait()
            });
        }
    }

    fn answer(&self, answer: Answer) {
        // Nobody listens only while the window closes.
        let _ = self.sender.send(answer);
        (self.wake)();
    }

    fn wait(&self) -> Next {
        match self.mailbox.take(None) {
            Mail::Request(request) => Next::Request(request),
            Mail::Nothing | Mail::Closed => Next::Closed,
        }
    }

    /// Makes the job of a scene. The volume is read only if `[volume]` has changed.
    fn job(&mut self, scene: &Scene) -> Result<Job, Failures> {
        let volume = match &self.data {
            Some((table, data)) if *table == scene.volume => Arc::clone(&data.volume),
            _ => {
                let volume = Arc::new(read_volume(scene, &Disk)?);
                let data =
                    Arc::new(VolumeData { histogram: Histogram::new(&volume, BINS), volume: Arc::clone(&volume) });
                self.data = Some((scene.volume.clone(), Arc::clone(&data)));
                self.answer(Answer::Loaded(data));
                volume
            }
        };
        Job::with_volume_for(scene.clone(), volume, RenderTarget::Picture, Arc::new(Disk))
    }

    /// Draws a job, and the requests after it that only move its camera.
    fn serve(&mut self, job: &Job, mut request: Box<Request>) -> Result<Next, Failure> {
        let mut warnings: Vec<String> = job.plan.warnings.iter().map(ToString::to_string).collect();
        let mut canvas = if job.draws_volume() { Some(self.canvas(job, &mut warnings)?) } else { None };
        self.answer(Answer::Prepared(Arc::new(job.scene.clone()), warnings));
        // The job keeps the first camera.
        let mut is_turned = false;
        loop {
            let next = match self.draw(job, &mut canvas, &request, is_turned)? {
                Some(next) => next,
                None => self.wait(),
            };
            let Next::Request(mut newer) = next else { return Ok(next) };
            newer.scene.picture.size = shown_size(&newer.scene, newer.longest);
            if !only_turns(&request.scene, &newer.scene) {
                if let Some(Canvas::Card(frames)) = canvas {
                    self.on_card = Some(frames);
                }
                return Ok(Next::Request(newer));
            }
            (request, is_turned) = (newer, true);
        }
    }

    /// Prepares the frames of a job's volume: on the card, or by the reference where the card lacks an effect or memory.
    fn canvas<'j>(&mut self, job: &'j Job, warnings: &mut Vec<String>) -> Result<Canvas<'j>, Failure> {
        if let Some(card) = &self.card {
            let prepared = match self.on_card.take() {
                Some(mut frames) => frames.change(job).map(|()| frames),
                None => GpuFrames::new(job, card.gpu()).map(Box::new),
            };
            match prepared {
                Ok(frames) => return Ok(Canvas::Card(frames)),
                Err(failure) => warnings.push(format!("the CPU draws this scene, more slowly: {}", failure.what)),
            }
        }
        Ok(Canvas::Memory(Box::new(ReferenceFrames::new(job.renderer()?, &job.scene))))
    }

    /// Draws a request: a coarse frame if an exact one takes long, then the exact one. Returns the next request if it
    /// came before the end.
    fn draw(
        &mut self,
        job: &Job,
        canvas: &mut Option<Canvas<'_>>,
        request: &Request,
        is_turned: bool,
    ) -> Result<Option<Next>, Failure> {
        let on_page = request.scene.draws_on_page();
        if let Some(canvas) = canvas {
            let divisors = self.pace.divisors(canvas.is_slow(self.card.as_ref()));
            for (i, &divisor) in divisors.iter().enumerate() {
                let is_coarse = divisor > NonZeroUsize::MIN;
                let drawn = match canvas.turn(&shot(job, request, divisor)?) {
                    // Frames with funnels have one size on a card.
                    Err(_) if is_coarse => continue,
                    turned => turned.and_then(|()| canvas.draw(self.card.as_ref(), self.mailbox.stop()))?,
                };
                if let Some(Drawn { size, pixels, seconds }) = drawn {
                    self.pace.learn(divisor, seconds);
                    let is_coarse = is_coarse || on_page;
                    let frame = Frame { revision: request.revision, size, pixels, is_coarse, seconds };
                    self.answer(Answer::Drawn(frame));
                }
                if is_coarse || on_page {
                    let rest = if i == 0 { REST } else { Duration::ZERO };
                    match self.mailbox.take(Some(rest)) {
                        Mail::Request(newer) => return Ok(Some(Next::Request(newer))),
                        Mail::Closed => return Ok(Some(Next::Closed)),
                        Mail::Nothing => {}
                    }
                }
            }
        }
        if on_page || canvas.is_none() {
            self.draw_page(job, request, is_turned)?;
        }
        Ok(None)
    }

    /// Draws the volume with points, lines and annotations.
    fn draw_page(&self, job: &Job, request: &Request, is_turned: bool) -> Result<(), Failure> {
        let start = Instant::now();
        let turned = is_turned.then(|| {
            let volume = self.data.as_ref().map_or(&job.volume, |(_, data)| &data.volume);
            Job::with_volume_for(request.scene.clone(), Arc::clone(volume), RenderTarget::Picture, Arc::new(Disk))
        });
        let turned = match turned.transpose() {
            Ok(turned) => turned,
            Err(failures) => {
                self.answer(Answer::Failed(request.revision, failures));
                return Ok(());
            }
        };
        let (job, mut counts) = (turned.as_ref().unwrap_or(job), Counts::default());
        let marking = Marking::new(job, &mut counts, &|_| ())?;
        let card = self.card.as_ref().map(Presenter::gpu);
        let mut drawing = Drawing::on(job, &marking, card, &mut counts)?;
        let Some((frame, _)) = drawing.frame_until(0, &|_| (), self.mailbox.stop())? else { return Ok(()) };
        let (size, pixels) = canvas::codes(&frame.painted(job)?)?;
        let seconds = start.elapsed().as_secs_f64();
        self.answer(Answer::Drawn(Frame { revision: request.revision, size, pixels, is_coarse: false, seconds }));
        Ok(())
    }
}

/// Returns the size in which a scene is shown: its own, or a smaller one of the same shape. Lengths on a page keep theirs.
fn shown_size(scene: &Scene, longest: usize) -> [usize; 2] {
    let [width, height] = scene.picture.size;
    let own = width.max(height);
    if own <= longest || scene.draws_on_page() {
        [width, height]
    } else {
        [width, height].map(|n| (n * longest).div_ceil(own))
    }
}

/// Whether a scene differs from the one before it in the place and the direction of its camera alone, and nothing is found
/// at a pixel.
fn only_turns(before: &Scene, after: &Scene) -> bool {
    let picks = before.halos.iter().any(|halo| halo.seed.focus.as_ref().is_some_and(|focus| focus.pixels().is_some()))
        || before.objects.iter().any(|object| object.strokes.is_some());
    let Camera { projection, near, .. } = after.camera;
    let camera = Camera { projection, near, ..before.camera.clone() };
    !picks && Scene { camera, ..after.clone() } == *before
}

/// Returns the shot of a job from a request's camera, with sides divided by `divisor`.
fn shot(job: &Job, request: &Request, divisor: NonZeroUsize) -> Result<Shot, Failure> {
    let shot = if divisor == NonZeroUsize::MIN { job.shot() } else { job.coarse_shot(divisor) }?;
    let view = View::new(&request.scene.camera, job.volume.grid(), shot.view.size);
    let view = view.map_err(|error| Failure::new(error, "camera", "undo the last change"))?;
    Ok(shot.seen_from(view))
}
