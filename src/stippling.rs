//! From a scene to a page of dots: volume stippling (Lu et al. 2002), written as vectors, pixels or a list.

use crate::job::{load_volume, provenance};
use crate::{Failure, Failures, memory};
use drypoint_output::vector::{Sheet, pdf, svg};
use drypoint_output::{OutputError, exr, list, paint, plotter, png};
use drypoint_reference::volume_stippling::{
    Drawn, FrameInputs, Frames, Inputs, PenTone, Preprocess, StippleError, joined,
};
use drypoint_scene::counts::Counts;
use drypoint_scene::marks::{Layer, Marks, Page, Pen};
use drypoint_scene::plan::Plan;
use drypoint_scene::tables::{Background, Ids, Ink, Length, PageSettings, PointsPerPixel, Scene, Stipples};
use drypoint_scene::tone::Tone;
use drypoint_scene::view::View;
use drypoint_scene::volume::Volume;
use std::path::Path;
use std::time::Instant;

/// A scene with `[stipples]` and its volume.
pub struct Stippling {
    /// The scene.
    pub scene: Scene,
    /// Its volume.
    pub volume: Volume,
    stipples: Stipples,
    pen: Pen,
}

impl Stippling {
    /// Loads the volume of a scene that has a table `[stipples]`.
    ///
    /// # Errors
    /// No such table, a volume that cannot be read, a pen that there is not.
    pub fn load(scene: Scene) -> Result<Self, Failures> {
        let volume = load_volume(&scene.volume, &scene.given)?;
        Self::with_volume(scene, volume)
    }

    /// The same for a volume that is already loaded.
    ///
    /// # Errors
    /// As [`Stippling::load`].
    pub fn with_volume(mut scene: Scene, volume: Volume) -> Result<Self, Failures> {
        let Some(mut stipples) = scene.stipples.clone() else {
            let remedy = "add a table [stipples], or write preset = \"stipple\"";
            return Err(Failure::new("the scene has no stipples", scene.given.position("stipples"), remedy).into());
        };
        let volume = match scene.volume.ids {
            Ids::Values => volume,
            Ids::Mask => volume.present(),
        };
        if let Background::Picture(_) = &scene.picture.background {
            let (what, remedy) = ("a page has no picture behind it", "give a colour, or \"none\"");
            return Err(Failure::new(what, scene.given.position("picture.background"), remedy).into());
        }
        let pen = pen(&scene, &stipples)?;
        if scene.page.as_ref().is_some_and(|page| page.plotter) {
            // A nib has no opacity: a dot that fades would be drawn whole, and too much ink in all ([STIP-5]).
            stipples.ink = Ink::Opaque;
        }
        // The volume itself is not drawn, so nothing of that is called for.
        (scene.transfer, scene.shading, scene.contours, scene.style_mipmaps) = (None, None, None, None);
        Ok(Self { scene, volume, stipples, pen })
    }

    /// Makes the points and draws one frame of them: a layer with the dots and, where the scene has them, silhouette curves.
    /// `progress` hears the share of the points that is made, from any thread.
    ///
    /// # Errors
    /// A camera without direction, lengths of the wrong space, more points than there is memory for.
    pub fn marks(&self, counts: &mut Counts, progress: &(dyn Fn(f64) + Sync)) -> Result<Marks, Failure> {
        let Self { scene, volume, stipples, pen } = self;
        let start = Instant::now();
        let grid = volume.grid();
        let at = |key: &str| scene.given.position(key);
        let view = View::new(&scene.camera, grid, scene.picture.size).map_err(|error| {
            Failure::new(error, at("camera"), "give the camera a direction and a size in the world")
        })?;
        let near = scene.camera.near.unwrap_or(scene.sampling.step).world(grid).ok_or_else(|| {
            Failure::new("the length is on the page, not in the volume", at("camera.near"), "give it in voxels")
        })?;
        let page = Page::of(scene);
        let size = page.length(stipples.size).ok_or_else(|| {
            let what = "the length is in the volume, not on the page";
            Failure::new(what, at("stipples.size"), "give it in mm, px or %")
        })?;
        // A_vol is in pixels, or in squares of side S_max where the picture is in mm ([STIP-3]).
        let in_mm = scene.picture.extent().is_some_and(|e| e.iter().any(|l| matches!(l, Length::Millimetres(_))));
        let square = if in_mm { size * page.pixels_per_mm() } else { 1.0 };
        let (measured, ideal) = (self.tone()?, Tone::ideal());
        let asked = (stipples.k_max == PointsPerPixel::Auto).then_some(&ideal);
        // S_max's area, in pixels.
        let diameter = size * page.pixels_per_mm();
        let dot = 0.25 * std::f64::consts::PI * (diameter * diameter);
        let tone = measured.as_ref().or(asked).map(|tone| (tone, dot));
        let inputs = Inputs { stipples, table: &scene.volume, volume, view: &view, near, square, tone };
        let wrong = |error: StippleError| self.failure(&error);
        let preprocess = Preprocess::new(inputs).map_err(wrong)?;
        memory::room(preprocess.bytes()).map_err(|no_room| {
            let what = format!("{} points need {no_room}", preprocess.len());
            Failure::new(what, at("stipples.k_max"), "make k_max smaller, or threshold larger")
        })?;
        let made = preprocess.each.max(1) as f64;
        let points = preprocess.points(counts, &|ranks| progress(ranks as f64 / made)).map_err(wrong)?;
        counts.seconds.insert("points".into(), start.elapsed().as_secs_f64());
        let start = Instant::now();
        let nib = stipples.pen.as_ref().map(|_| pen.width);
        let light = scene.light;
        let tone = measured.as_ref().map(|tone| PenTone { tone, ink: preprocess.ink, layers: preprocess.layers });
        let inputs = FrameInputs { stipples, points: &points, light, grid, reference: &view, near, size, nib, tone };
        let frames = Frames::new(&inputs);
        let mut drawn = Drawn::default();
        frames.draw(&view, &page, &mut drawn);
        let mut layer = Layer::new(pen.clone());
        layer.dots = drawn.to_vec();
        if let (Some(curves), Some(edges)) = (&stipples.curves, preprocess.edges().map_err(wrong)?) {
            let segments = edges.segments(curves, &view);
            layer.lines = joined(&segments, &points.grid, &view, &page, near, nib.unwrap_or(size) / 2.0);
        }
        let mut marks = Marks { page, layers: vec![layer] };
        marks.settle();
        counts.points += marks.layers.iter().map(|layer| layer.dots.len() as u64).sum::<u64>();
        counts.seconds.insert("frame".into(), start.elapsed().as_secs_f64());
        Ok(marks)
    }

    /// What the pen prints, if that was measured ([STIP-17]).
    fn tone(&self) -> Result<Option<Tone>, Failure> {
        let pens = &self.scene.pens;
        let pen = pens.iter().find(|pen| self.stipples.pen.as_ref() == Some(&pen.name));
        pen.and_then(|pen| pen.tone.as_ref()).map(|path| tone(path)).transpose()
    }

    fn failure(&self, error: &StippleError) -> Failure {
        let (key, remedy) = match error {
            StippleError::Field(_) => ("volume", "convert the volume"),
            StippleError::Length { key } => (*key, "give it in voxels or world units"),
            StippleError::TooMany { .. } => ("stipples.threshold", "make it larger"),
            StippleError::TooDense { .. } => ("stipples.k_max", "make it smaller"),
        };
        Failure::new(error, self.scene.given.position(key), remedy)
    }
}

/// A measured step wedge ([STIP-17]).
///
/// # Errors
/// A file that cannot be read, or a line of it that is none of a step wedge.
pub fn tone(path: &Path) -> Result<Tone, Failure> {
    let remedy = "the command wedge writes the table; fill in what was measured";
    Tone::read(path).map_err(|error| Failure::new(&error, error.place(), remedy))
}

/// What draws: the pen that the table names, or its colour with dots of any size.
fn pen(scene: &Scene, stipples: &Stipples) -> Result<Pen, Failure> {
    let page = Page::of(scene);
    let Some(name) = &stipples.pen else {
        let width = page.length(stipples.size).unwrap_or_default();
        return Ok(Pen { number: 1, name: "stipples".into(), width, color: stipples.color });
    };
    Pen::of(&scene.pens, &page).into_iter().find(|pen| pen.name == *name).ok_or_else(|| {
        let names: Vec<&str> = scene.pens.iter().map(|pen| pen.name.as_str()).collect();
        let remedy = if names.is_empty() {
            "add a table [[pen]] with that name".into()
        } else {
            format!("write one of {}", names.join(", "))
        };
        Failure::new(format!("there is no pen {name:?}"), scene.given.position("stipples.pen"), remedy)
    })
}

/// A format that marks are written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MarksFormat {
    /// Vectors, a millimetre a unit.
    Svg,
    /// The same as PDF.
    Pdf,
    /// Pixels of 8 or 16 bits.
    Png,
    /// Pixels in linear light.
    Exr,
    /// A row a dot.
    Csv,
}

impl MarksFormat {
    /// The format of a name, by its suffix; case does not count.
    ///
    /// # Errors
    /// A suffix of no format.
    pub fn of(path: &Path) -> Result<Self, Failure> {
        let suffix = path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
        match suffix.as_str() {
            "svg" => Ok(Self::Svg),
            "pdf" => Ok(Self::Pdf),
            "png" => Ok(Self::Png),
            "exr" => Ok(Self::Exr),
            "csv" => Ok(Self::Csv),
            _ => {
                let remedy = "give a name that ends in .svg, .pdf, .png, .exr or .csv";
                Err(Failure::new("the suffix is that of no format for points", path.display(), remedy))
            }
        }
    }
}

/// Writes marks on the page of a scene. What a plotter will do is returned, a sentence a layer. A list has the dots as they
/// are, whatever draws them.
///
/// # Errors
/// What the operating system refuses, or a page of no or too many pixels.
pub fn write(marks: &Marks, scene: &Scene, path: &Path) -> Result<Vec<String>, Failure> {
    let format = MarksFormat::of(path)?;
    let wrong = |error: OutputError| Failure::picture(&error, path.display());
    if format == MarksFormat::Csv {
        list::write_dots(marks, path).map_err(wrong)?;
        let lines: usize = marks.layers.iter().map(|layer| layer.lines.len()).sum();
        return Ok(if lines > 0 {
            vec![format!("{lines} lines are left out: a list has dots alone")]
        } else {
            Vec::new()
        });
    }
    let plotter = scene.page.as_ref().is_some_and(|PageSettings { plotter, .. }| *plotter);
    let plan = plotter.then(|| plotter::plan(marks, &plotter::Speed::default()));
    let (marks, said) = match &plan {
        Some(plan) => (&plan.marks, travel(plan)),
        None => (marks, Vec::new()),
    };
    let background = match scene.picture.background {
        Background::Color(color) => Some(color),
        Background::None | Background::Picture(_) => None,
    };
    let provenance = provenance(scene, &Plan::new(scene));
    let sheet = Sheet { marks, background, picture: None, plotter, provenance: &provenance };
    match format {
        MarksFormat::Svg => svg::write_svg(&sheet, path),
        MarksFormat::Pdf => pdf::write_pdf(&sheet, path),
        _ => {
            let mut picture = paint::blank(&marks.page, background).map_err(wrong)?;
            paint::paint(marks, &paint::Window::page(&marks.page), scene.picture.blend_space, &mut picture)
                .map_err(wrong)?;
            match format {
                MarksFormat::Png => png::write_png(&picture, scene.picture.bits, &provenance, path),
                _ => exr::write_exr(&picture, &provenance, path),
            }
        }
    }
    .map_err(wrong)?;
    Ok(said)
}

/// What a plotter does, a sentence a layer.
fn travel(plan: &plotter::Plan) -> Vec<String> {
    let layers = plan.marks.layers.iter().zip(&plan.travel);
    let mut said: Vec<String> = layers
        .map(|(layer, t)| {
            let (name, down, up) = (layer.pen.label(), t.pen_down / 1000.0, t.pen_up / 1000.0);
            let minutes = t.seconds / 60.0;
            format!("{name}: {} touches, {down:.1} m drawn, {up:.1} m between, about {minutes:.0} minutes", t.touches)
        })
        .collect();
    if plan.dropped > 0 {
        said.push(format!("{} dots are left out: they are closer than 0.7 nib to another", plan.dropped));
    }
    said
}
