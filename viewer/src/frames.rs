//! The thread that owns a scene's data and draws its frames.
//!
//! A request is the scene as it stands. The newest request is drawn, and stops the one before it. A request that only
//! moves the camera prepares nothing. While requests come quickly, frames are coarse if exact ones would take long.
//!
//! | the scene | while the camera moves | then |
//! |---|---|---|
//! | the volume alone | by a card into a texture of the window's device, or by the reference, in pixels | the same |
//! | the volume with points, lines or annotations | the volume | the thread of `page.rs` |
//! | points and lines alone | those that were made for the first camera | the thread of `page.rs` |

use crate::background::{Background, Desk};
use crate::canvas::{self, Canvas, Drawn, Pace, Pixels};
use crate::mailbox::{Mail, Mailbox};
use crate::page::{PageRequest, pages};
use crate::present::Presenter;
use crate::slice::ValueColors;
use drypoint::drawing::Drawing;
use drypoint::frames::ReferenceFrames;
use drypoint::gpu::{Gpu, GpuFrames};
use drypoint::job::{Job, RenderTarget, read_volume};
use drypoint::marking::Marking;
use drypoint::scene::counts::Counts;
use drypoint::scene::glam::DVec3;
use drypoint::scene::shot::Shot;
use drypoint::scene::source::Disk;
use drypoint::scene::tables::{Camera, PaintTarget, PartName, Scene, VolumeTable};
use drypoint::scene::view::View;
use drypoint::scene::volume::Volume;
use drypoint::scene::volume::histogram::Histogram;
use drypoint::{Failure, Failures};
use std::num::NonZeroUsize;
use std::sync::Arc;
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
    /// The table that it was read for.
    pub table: VolumeTable,
    /// The volume.
    pub volume: Arc<Volume>,
    /// Counts of its values.
    pub histogram: Histogram,
}

/// A scene as a job completes it, and what it tells of it.
#[derive(Clone, Debug)]
pub struct Prepared {
    /// The revision of the document that the job was made of.
    pub revision: u64,
    /// The scene, with what was found in the data.
    pub scene: Arc<Scene>,
    /// Warnings.
    pub warnings: Vec<String>,
    /// The colours of the volume's values in the scene's function.
    pub colors: Arc<ValueColors>,
    /// The box of each object in the world where it is not moved, x fastest.
    pub boxes: Vec<Option<[DVec3; 8]>>,
}

/// An answer of the thread.
pub enum Answer {
    /// Another volume was loaded.
    Loaded(Arc<VolumeData>),
    /// A job was made.
    Prepared(Prepared),
    /// A frame was drawn.
    Drawn(Frame),
    /// The scene of a revision could not be drawn.
    Failed(u64, Failures),
}

/// A handle of the threads, which end when it is dropped.
pub struct Worker {
    frames: Background<Box<Request>, Answer>,
    pages: Background<PageRequest, Answer>,
}

impl Worker {
    /// Starts the threads. `wake` is called after each answer, on a thread.
    pub fn new(card: Option<Gpu>, wake: impl Fn() + Clone + Send + 'static) -> Self {
        let pages = pages(card.clone(), Box::new(wake.clone()));
        let (card, asked) = (card.map(Presenter::new), pages.mailbox());
        let run = |desk| Artist { desk, pages: asked, card, on_card: None, data: None, pace: Pace::default() }.run();
        Self { frames: Background::new("frames", Box::new(wake), run), pages }
    }

    /// Asks for frames of a scene, in place of all before.
    pub fn ask(&self, request: Request) {
        self.frames.ask(Box::new(request));
    }

    /// Returns the answers since the last call.
    pub fn answers(&self) -> impl Iterator<Item = Answer> + '_ {
        self.frames.answers().chain(self.pages.answers())
    }
}

/// The thread's own state.
struct Artist {
    desk: Desk<Box<Request>, Answer>,
    /// Requests to the thread that draws with points, lines and annotations.
    pages: Arc<Mailbox<PageRequest>>,
    card: Option<Presenter>,
    /// Frames on the card, which outlive the jobs that they were made from.
    on_card: Option<Box<GpuFrames>>,
    data: Option<Arc<VolumeData>>,
    pace: Pace,
}

impl Artist {
    fn run(mut self) {
        let mut next = self.desk.wait();
        while let Some(mut request) = next {
            request.scene.picture.size = shown_size(&request.scene, request.longest);
            let served = self.job(&request.scene).and_then(|job| Ok(self.serve(&job, &mut request)?));
            next = served.unwrap_or_else(|failures| {
                self.desk.answer(Answer::Failed(request.revision, failures));
                self.desk.wait()
            });
        }
    }

    /// Makes the job of a scene. The volume is read only if `[volume]` has changed.
    fn job(&mut self, scene: &Scene) -> Result<Job, Failures> {
        let volume = match &self.data {
            Some(data) if data.table == scene.volume => Arc::clone(&data.volume),
            _ => {
                let volume = Arc::new(read_volume(scene, &Disk)?);
                let (table, histogram) = (scene.volume.clone(), Histogram::new(&volume, BINS));
                let data = Arc::new(VolumeData { table, volume: Arc::clone(&volume), histogram });
                self.data = Some(Arc::clone(&data));
                self.desk.answer(Answer::Loaded(data));
                volume
            }
        };
        Job::with_volume_for(scene.clone(), volume, RenderTarget::Picture, Arc::new(Disk))
    }

    /// Draws a job, and the requests after it that only move its camera. Each takes the place of the one before, so that
    /// a failure is that of `request`. Returns the next request; none if the window is closed.
    fn serve(&mut self, job: &Job, request: &mut Box<Request>) -> Result<Option<Box<Request>>, Failure> {
        let mut warnings: Vec<String> = job.plan.warnings.iter().map(ToString::to_string).collect();
        let mut canvas = if job.draws_volume() { Some(self.canvas(job, &mut warnings)?) } else { None };
        let range = self.data.as_ref().map_or(job.volume.range(), |data| [data.histogram.lo, data.histogram.hi]);
        let colors = Arc::new(ValueColors::of(job, range));
        let boxes = job
            .scene
            .objects
            .iter()
            .map(|object| job.corners(&job.scene.objects, &PartName::Ghost(object.name.clone())))
            .collect();
        let scene = Arc::new(job.scene.clone());
        self.desk.answer(Answer::Prepared(Prepared { revision: request.revision, scene, warnings, colors, boxes }));
        // The job keeps the first camera, and so do points and lines alone.
        let (gpu, mut counts) = (self.card.as_ref().map(|card| card.gpu().clone()), Counts::default());
        let marking = canvas.is_none().then(|| Marking::new(job, &mut counts, &|_| ())).transpose()?;
        let drawing = |marking| Drawing::on(job, marking, gpu.as_ref(), &mut counts);
        let mut drawing = marking.as_ref().map(drawing).transpose()?;
        let mut is_turned = false;
        loop {
            self.pages.interrupt();
            let drawn = match (&mut canvas, &mut drawing) {
                (Some(canvas), _) => self.draw(job, canvas, request)?,
                (None, Some(drawing)) => self.sketch(job, drawing, request, is_turned)?,
                (None, None) => Mail::Nothing,
            };
            let next = match drawn {
                Mail::Nothing => self.desk.wait(),
                Mail::Request(newer) => Some(newer),
                Mail::Closed => None,
            };
            let Some(mut newer) = next else { return Ok(None) };
            newer.scene.picture.size = shown_size(&newer.scene, newer.longest);
            if !only_turns(&request.scene, &newer.scene) {
                if let Some(Canvas::Card(frames)) = canvas {
                    self.on_card = Some(frames);
                }
                return Ok(Some(newer));
            }
            (*request, is_turned) = (newer, true);
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

    /// Draws a request: a coarse frame if an exact one takes long, then the exact one. Returns the mail that came before
    /// the end.
    fn draw(&mut self, job: &Job, canvas: &mut Canvas<'_>, request: &Request) -> Result<Mail<Box<Request>>, Failure> {
        let on_page = request.scene.draws_on_page();
        let divisors = self.pace.divisors(canvas.is_slow(self.card.as_ref()));
        for (i, &divisor) in divisors.iter().enumerate() {
            let is_coarse = divisor > NonZeroUsize::MIN;
            let drawn = match canvas.turn(&shot(job, &request.scene.camera, divisor)?) {
                // Frames with funnels have one size on a card.
                Err(_) if is_coarse => continue,
                turned => turned.and_then(|()| canvas.draw(self.card.as_ref(), self.desk.mailbox.stop()))?,
            };
            if let Some(Drawn { size, pixels, seconds }) = drawn {
                self.pace.learn(divisor, seconds);
                let is_coarse = is_coarse || on_page;
                let frame = Frame { revision: request.revision, size, pixels, is_coarse, seconds };
                self.desk.answer(Answer::Drawn(frame));
            }
            if is_coarse || on_page {
                let rest = if i == 0 { REST } else { Duration::ZERO };
                match self.desk.mailbox.take(Some(rest)) {
                    Mail::Nothing => {}
                    mail => return Ok(mail),
                }
            }
        }
        if on_page {
            self.ask_page(job, request);
        }
        Ok(Mail::Nothing)
    }

    /// Draws points and lines alone. They are those of the first camera, so a further one gets its own once it rests.
    /// Returns the mail that came before the end.
    fn sketch(
        &self,
        job: &Job,
        drawing: &mut Drawing<'_>,
        request: &Request,
        is_turned: bool,
    ) -> Result<Mail<Box<Request>>, Failure> {
        let start = Instant::now();
        if is_turned {
            drawing.turn(view(job, &request.scene.camera, job.scene.picture.size)?)?;
        }
        if let Some((frame, _)) = drawing.frame_until(0, &|_| (), self.desk.mailbox.stop())? {
            let (size, pixels) = canvas::codes(&frame.painted(job)?)?;
            let (revision, seconds) = (request.revision, start.elapsed().as_secs_f64());
            self.desk.answer(Answer::Drawn(Frame { revision, size, pixels, is_coarse: is_turned, seconds }));
        }
        let mail = if is_turned { self.desk.mailbox.take(Some(REST)) } else { Mail::Nothing };
        if is_turned && matches!(mail, Mail::Nothing) {
            self.ask_page(job, request);
        }
        Ok(mail)
    }

    /// Asks for the exact frame with points, lines and annotations.
    fn ask_page(&self, job: &Job, request: &Request) {
        let volume = Arc::clone(self.data.as_ref().map_or(&job.volume, |data| &data.volume));
        self.pages.put(PageRequest { revision: request.revision, scene: request.scene.clone(), volume });
    }
}

/// Returns the size in which a scene is shown: its own, or a smaller one of the same shape. Scenes with lengths on a page or
/// places at pixels keep theirs.
pub fn shown_size(scene: &Scene, longest: usize) -> [usize; 2] {
    let [width, height] = scene.picture.size;
    let own = width.max(height);
    if own <= longest || scene.draws_on_page() || picks(scene) {
        [width, height]
    } else {
        [width, height].map(|n| (n * longest).div_ceil(own))
    }
}

/// Whether something is found at a pixel of the picture: a focus of halos, or a stroke. Brushes at points of the world are
/// not.
pub(crate) fn picks(scene: &Scene) -> bool {
    scene.halos.iter().any(|halo| halo.seed.focus.as_ref().is_some_and(|focus| focus.pixels().is_some()))
        || scene
            .objects
            .iter()
            .flat_map(|object| object.strokes.iter().flatten())
            .any(|stroke| matches!(stroke.target, PaintTarget::Pixel(_)))
}

/// Whether a scene differs from the one before it in the place and the direction of its camera alone, and nothing is found
/// at a pixel.
pub(crate) fn only_turns(before: &Scene, after: &Scene) -> bool {
    let Camera { projection, near, .. } = after.camera;
    let camera = Camera { projection, near, ..before.camera.clone() };
    !picks(before) && Scene { camera, ..after.clone() } == *before
}

/// Returns the shot of a job from another camera, with sides divided by `divisor`.
pub(crate) fn shot(job: &Job, camera: &Camera, divisor: NonZeroUsize) -> Result<Shot, Failure> {
    let shot = if divisor == NonZeroUsize::MIN { job.shot() } else { job.coarse_shot(divisor) }?;
    let view = view(job, camera, shot.view.size)?;
    Ok(shot.seen_from(view))
}

/// Returns the view of a camera on a job's volume, in a picture of a size.
fn view(job: &Job, camera: &Camera, size: [usize; 2]) -> Result<View, Failure> {
    let view = View::new(camera, job.volume.grid(), size);
    view.map_err(|error| Failure::new(error, "camera", "undo the last change"))
}
