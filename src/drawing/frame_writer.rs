//! Writing of frames: pixels, vectors or a list.

use super::{Frame, WriteReport};
use crate::job::{Job, RenderTarget, background_color, no_room_for_pixels};
use crate::{Failure, Format};
use drypoint_output::animation::apng::ApngAnimation;
use drypoint_output::animation::gif::GifAnimation;
use drypoint_output::vector::{VectorPage, pdf, svg};
use drypoint_output::{OutputError, exr, list, paint, plotter, png};
use drypoint_scene::atomic;
use drypoint_scene::marks::{Marks, Page, Vertex, mark_counts};
use drypoint_scene::memory;
use drypoint_scene::picture::{LayerKind, Picture, Provenance};
use drypoint_scene::tables::{Orbit, PageText, Scene};
use std::borrow::Cow;
use std::io;
use std::path::Path;

/// Bytes of memory for a vertex of a stroke that fills a dot, until the stroke is written.
const FILLING_VERTEX: u64 = 3 * size_of::<Vertex>() as u64;

/// The error that ended an animation before its last frame.
enum AnimationError {
    Drawing(Failure),
    System(io::Error),
}

impl From<Failure> for AnimationError {
    fn from(failure: Failure) -> Self {
        Self::Drawing(failure)
    }
}

impl From<io::Error> for AnimationError {
    fn from(error: io::Error) -> Self {
        Self::System(error)
    }
}

/// Writes the picture and the marks of one frame of an animation.
type ShowFrame<'f> = &'f mut dyn FnMut(Option<Picture>, &Marks) -> Result<(), Failure>;

/// Writer of a scene's frames.
pub(super) struct FrameWriter<'a> {
    pub(super) scene: &'a Scene,
    pub(super) target: RenderTarget,
    pub(super) provenance: Provenance,
}

/// Marks as they are drawn, and the report on them.
struct PlannedMarks<'a> {
    marks: Cow<'a, Marks>,
    written: WriteReport,
}

impl<'a> FrameWriter<'a> {
    pub(super) fn of(job: &'a Job, frame: usize) -> Self {
        Self { scene: &job.scene, target: job.target(), provenance: job.provenance_of(frame) }
    }

    /// See [`Frame::write`].
    pub(super) fn write(&self, frame: Frame, path: &Path) -> Result<WriteReport, Failure> {
        let format = Format::among(path, &Format::PAGES)?;
        let wrong = |error: OutputError| Failure::picture(&error, path.display());
        let whole = frame.marks();
        if let (Some(form), Some(marks)) = (list::ListFormat::of(path), &frame.marks) {
            if self.target == RenderTarget::Strokes {
                list::write_lines(marks, form, path).map_err(wrong)?;
                return Ok(WriteReport { marks: whole, notes: Vec::new() });
            }
            list::write_dots(marks, form, path).map_err(wrong)?;
            let [_, lines] = whole;
            let notes = (lines > 0).then(|| format!("{lines} lines are left out: a list has dots alone"));
            return Ok(WriteReport { marks: whole, notes: notes.into_iter().collect() });
        }
        let planned = frame.marks.as_ref().map(|marks| self.planned(marks)).transpose()?;
        let marks = planned.as_ref().map(|planned| &*planned.marks);
        match (format, marks) {
            (Format::Svg, Some(marks)) => svg::write_svg(&self.sheet(marks, frame.picture.as_ref()), path),
            (Format::Pdf, Some(marks)) => pdf::write_pdf(&self.sheet(marks, frame.picture.as_ref()), path),
            (Format::Exr, marks) => exr::write_exr(&self.painted(frame.picture, marks)?, &self.provenance, path),
            (_, marks) => {
                let picture = self.painted(frame.picture, marks)?;
                png::write_png(&picture, self.scene.picture.bits, &self.provenance, path)
            }
        }
        .map_err(wrong)?;
        let mut written = planned.map(|planned| planned.written).unwrap_or_default();
        written.marks[1] += frame.inside;
        written.notes.extend(frame.notes);
        Ok(written)
    }

    /// See [`super::write_animation`].
    pub(super) fn write_animation(
        &self,
        frames: usize,
        path: &Path,
        mut draw: impl FnMut(usize) -> Result<Frame, Failure>,
    ) -> Result<(), Failure> {
        let format = Format::among(path, &[Format::Gif, Format::Apng, Format::Svg])?;
        let wrong = |error: OutputError| Failure::picture(&error, path.display());
        let fps = self.scene.orbit.map_or(Orbit::default().fps, |orbit| orbit.fps);
        let written = atomic::write(path, |out| {
            let nothing = Marks { page: Page::of(self.scene), layers: Vec::new() };
            // Draws all frames; `show` writes one with its marks.
            let mut each = |show: ShowFrame<'_>| {
                (0..frames).try_for_each(|i| {
                    let frame = draw(i)?;
                    let planned = self.planned(frame.marks.as_ref().unwrap_or(&nothing))?;
                    show(frame.picture, &planned.marks)
                })
            };
            match format {
                Format::Gif => {
                    let mut gif = GifAnimation::new(out, self.pixels(), fps, &self.provenance, path).map_err(wrong)?;
                    each(&mut |picture, marks| gif.frame(&self.painted(picture, Some(marks))?).map_err(wrong))?;
                    gif.finish().map_err(wrong)?;
                }
                Format::Apng => {
                    let (size, bits, times) = (self.pixels(), self.scene.picture.bits, [frames, fps]);
                    let apng = ApngAnimation::new(out, size, bits, times, &self.provenance, path);
                    let mut apng = apng.map_err(wrong)?;
                    each(&mut |picture, marks| apng.frame(&self.painted(picture, Some(marks))?).map_err(wrong))?;
                    apng.finish().map_err(wrong)?;
                }
                _ => {
                    let mut animation = svg::Animation::new(out, frames, 1.0 / fps as f64);
                    each(&mut |picture, marks| {
                        animation.frame(&self.sheet(marks, picture.as_ref()), path).map_err(wrong)
                    })?;
                }
            }
            Ok(())
        });
        written.map_err(|stopped| match stopped {
            AnimationError::Drawing(failure) => failure,
            AnimationError::System(source) => wrong(OutputError::Io { path: path.into(), action: "written", source }),
        })
    }

    /// See [`Frame::painted`].
    pub(super) fn painted(&self, picture: Option<Picture>, marks: Option<&Marks>) -> Result<Picture, Failure> {
        let (window, blank) = self.window();
        let wrong = |error: OutputError| self.refused(&error);
        let mut picture = match picture {
            Some(picture) => picture,
            None => paint::blank(&blank, background_color(self.scene)).map_err(wrong)?,
        };
        if let Some(marks) = marks.filter(|_| picture.layer(LayerKind::Beauty).is_some()) {
            paint::paint(marks, &window, self.scene.picture.blend_space, &mut picture).map_err(wrong)?;
        }
        Ok(picture)
    }

    /// See [`super::room_for_page`].
    pub(super) fn room(&self, path: &Path) -> Result<(), Failure> {
        let has_pixels = |format| Format::PICTURES.contains(&format) || Format::ANIMATIONS.contains(&format);
        if !Format::of(path).is_some_and(has_pixels) {
            return Ok(());
        }
        paint::pixels(&self.window().1).map(drop).map_err(|error| self.refused(&error))
    }

    /// Returns the part of the page that pixels show, and the page that they fill. A picture has its own size, without
    /// the page's margin.
    fn window(&self) -> (paint::PageWindow, Page) {
        let (page, settings) = (Page::of(self.scene), &self.scene.picture);
        match self.target {
            RenderTarget::Marks | RenderTarget::Points | RenderTarget::Strokes => {
                (paint::PageWindow::page(&page), page)
            }
            RenderTarget::Picture => {
                (paint::PageWindow::frame(&page, settings.size), Page::in_pixels(settings.size, 0.0, settings.dpi))
            }
        }
    }

    /// Returns width and height of a painted frame in pixels.
    fn pixels(&self) -> [usize; 2] {
        self.window().1.pixels()
    }

    /// Returns the failure of a page that cannot be painted in pixels.
    fn refused(&self, error: &OutputError) -> Failure {
        match error {
            OutputError::NoRoom { size, no_room, .. } => no_room_for_pixels(self.scene, *size, no_room),
            _ => Failure::picture(error, self.scene.given.position("picture")),
        }
    }

    fn sheet<'s>(&'s self, marks: &'s Marks, picture: Option<&'s Picture>) -> VectorPage<'s> {
        // Paper has its own colour, and programs that ignore % in labels would draw around the page.
        let background = background_color(self.scene).filter(|_| !self.plotter());
        let beziers = self.scene.hatching.as_ref().is_some_and(|hatching| hatching.beziers);
        VectorPage {
            marks,
            background,
            picture,
            plotter: self.plotter(),
            beziers,
            outlined: self.scene.page.as_ref().is_some_and(|page| page.text == PageText::Outlines),
            provenance: &self.provenance,
        }
    }

    fn plotter(&self) -> bool {
        self.scene.page.as_ref().is_some_and(|page| page.plotter)
    }

    /// Returns marks as they are drawn. With a plotter these are the marks of its plan.
    ///
    /// # Errors
    /// Dots are so large for the nib that the memory budget does not allow the strokes that fill them.
    fn planned<'m>(&self, marks: &'m Marks) -> Result<PlannedMarks<'m>, Failure> {
        if !self.plotter() {
            let written = WriteReport { marks: mark_counts(&marks.layers), notes: Vec::new() };
            return Ok(PlannedMarks { marks: Cow::Borrowed(marks), written });
        }
        let vertices = plotter::filling_vertices(marks);
        memory::room_for(vertices as u64, FILLING_VERTEX).map_err(|no_room| {
            let what =
                format!("strokes of {vertices:.1e} vertices, which fill dots larger than the nib, need {no_room}");
            Failure::new(what, self.scene.given.position("page.plotter"), "take a wider pen, or smaller or fewer dots")
        })?;
        let plan = plotter::plan(marks, &plotter::Speed::default());
        let [touches, lines] = mark_counts(&plan.marks.layers);
        let written = WriteReport { marks: [touches + plan.larger, lines - plan.larger], notes: travel(&plan) };
        Ok(PlannedMarks { marks: Cow::Owned(plan.marks), written })
    }
}

/// Returns a plotter's plan in words, a sentence a layer.
fn travel(plan: &plotter::PlotterPlan) -> Vec<String> {
    let layers = plan.marks.layers.iter().zip(&plan.travel);
    let mut notes: Vec<String> = layers
        .map(|(layer, t)| {
            let (name, down, up) = (layer.pen.label(), t.pen_down / 1000.0, t.pen_up / 1000.0);
            let minutes = t.seconds / 60.0;
            format!("{name}: {} touches, {down:.1} m drawn, {up:.1} m between, about {minutes:.0} minutes", t.touches)
        })
        .collect();
    if plan.dropped > 0 {
        notes.push(format!("{} dots are left out: they are closer than 0.7 nib to another", plan.dropped));
    }
    if plan.plain > 0 {
        notes.push(format!("{} lines lose taper, colour or faintness: the nib draws one width in one ink", plan.plain));
    }
    if plan.unfilled > 0 {
        notes.push(format!("{} areas are drawn as outlines: the nib does not fill them", plan.unfilled));
    }
    notes
}
