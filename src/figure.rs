//! Figures: several scenes on one page, with letters, captions and insets.
//!
//! A figure is arranged from the sizes of its panels. Each panel is then drawn in its own place's size, and all pictures
//! and marks are put on one page, which is written like the page of one scene.

mod insets;
mod page_size;
mod ruler;

use crate::Failure;
use crate::annotating::{missing, plain};
use crate::drawing::{Drawing, WriteReport, paint_picture, write_picture};
use crate::gpu::Gpu;
use crate::job::{Job, background_color, figure_provenance};
use crate::marking::{Marking, add};
use drypoint_output::read::Image;
use drypoint_output::sheet::{PlacedPicture, lay_out};
use drypoint_output::text::font::extent;
use drypoint_output::{OutputError, paint};
use drypoint_reference::figure::{PanelGrid, PanelSize};
use drypoint_scene::counts::Counts;
use drypoint_scene::glam::DVec2;
use drypoint_scene::marks::{Layer, Marks, Page, Pen, Text};
use drypoint_scene::picture::{LayerKind, Picture, Provenance};
use drypoint_scene::tables::{Background, Figure, Length, PictureSettings, Scene};
use insets::with_insets;
use page_size::{check_columns, check_pixels, key_of_large};
use ruler::{Ruler, TextBlock};
use std::path::Path;

/// The size of the title, in sizes of the text.
const TITLE: f64 = 1.4;

/// The space between a picture and its text, in sizes of the text.
const ABOVE_TEXT: f64 = 0.3;

/// The width of the frames of insets, in mm.
const FRAME: f64 = 0.2;

/// A figure whose panels have their places.
pub struct FigureLayout<'a> {
    figure: &'a Figure,
    page: Page,
    /// Width and height in pixels, without the page's margin.
    size: [usize; 2],
    /// Width and height of a pixel, in mm.
    pixel: DVec2,
    places: Vec<PanelPlace>,
    texts: Vec<Text>,
}

/// The place of a panel or an inset, in pixels of the figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PanelPlace {
    /// Left and upper end.
    pub corner: [usize; 2],
    /// Width and height.
    pub size: [usize; 2],
    /// Whether it lies over the panel before it.
    pub is_inset: bool,
}

/// What a panel shows.
#[derive(Clone, Debug, Default)]
pub struct DrawnPanel {
    /// Pixels; none: the figure's background.
    pub picture: Option<Image>,
    /// Marks over the pixels, on a page that is the panel.
    pub marks: Option<Marks>,
    /// The provenance of a drawn scene.
    pub provenance: Option<Provenance>,
    /// Annotations that are left out, a sentence each.
    pub notes: Vec<String>,
}

impl DrawnPanel {
    /// Draws the first frame of a scene, which was fitted to its place. Labels stand beside insets. A graphics card, if there
    /// is one, draws the volume. `progress` is that of [`Drawing::frame`].
    ///
    /// # Errors
    /// The errors of [`Drawing::on`] and [`Drawing::frame`], and no memory for the pixels.
    pub fn draw(
        job: &Job,
        layout: &FigureLayout<'_>,
        place: &PanelPlace,
        card: Option<&Gpu>,
        progress: &(dyn Fn(f64) + Sync),
    ) -> Result<Self, Failure> {
        let mut counts = Counts::default();
        let marking = Marking::new(job, &mut counts, &|_| ())?;
        let mut drawing = Drawing::on(job, &marking, card, &mut counts)?;
        drawing.keep_labels_off(layout.insets_on(place));
        let (frame, _) = drawing.frame(0, progress)?;
        let background = background_color(&job.scene).filter(|color| *color != layout.figure.figure.background);
        let picture = match (&frame.picture, background.filter(|_| !layout.is_plotted())) {
            (Some(picture), _) => Some(Image::from(picture)),
            (None, Some(color)) => {
                let blank = paint::blank(&Page::of(&job.scene), Some(color));
                Some(Image::from(&blank.map_err(|error| Failure::picture(&error, "a panel"))?))
            }
            (None, None) => None,
        };
        Ok(Self { picture, marks: frame.marks, provenance: Some(job.provenance()), notes: frame.notes })
    }
}

impl<'a> FigureLayout<'a> {
    /// Arranges a figure. `sizes` has width and height, in any unit, of the pictures of [`Figure::sources`].
    ///
    /// # Errors
    /// A page of too many pixels, narrow columns, or an inset that does not fit.
    pub fn new(figure: &'a Figure, sizes: &[[usize; 2]]) -> Result<Self, Failure> {
        let settings = &figure.figure;
        let ruler = Ruler::new(figure)?;
        let gap = ruler.pixels(ruler.mm(settings.gap)).min(paint::MOST_PIXELS);
        let grid = PanelGrid { width: ruler.width, columns: settings.columns, gap };
        check_columns(figure, &grid)?;
        let spans: Vec<usize> = figure.panels.iter().map(|panel| panel.columns).collect();
        let widths = grid.widths(&spans);
        let size = ruler.mm(settings.size);
        let title = ruler.block(settings.title.as_deref().unwrap_or_default(), TITLE * size, grid.width);
        let caption = ruler.block(settings.caption.as_deref().unwrap_or_default(), size, grid.width);
        let numbered = figure.panels.iter().enumerate().zip(&widths);
        let captions: Vec<TextBlock> = numbered
            .map(|((i, panel), width)| {
                let words = settings.letters.letter(i).into_iter().chain(panel.caption.clone());
                ruler.block(&words.collect::<Vec<_>>().join(" "), size, *width)
            })
            .collect();
        // Panels in rows, with their insets.
        let mut sizes = sizes.iter().copied();
        let each = widths.iter().enumerate();
        let panels: Vec<Vec<PanelPlace>> = each
            .map(|(i, &width)| with_insets(figure, i, width, grid.gap / 2, &mut sizes))
            .collect::<Result<_, _>>()?;
        let sized = panels.iter().zip(&spans).zip(&captions).map(|((places, &columns), caption)| PanelSize {
            columns,
            height: places[0].size[1],
            text: caption.height,
        });
        let (placed, bottom) = grid.place(&sized.collect::<Vec<_>>(), title.height);
        let in_pixels = [grid.width, bottom.saturating_add(caption.height)];
        let margin = figure.page.as_ref().map_or(0.0, |page| ruler.mm(page.margin));
        let extent = DVec2::from(in_pixels.map(|n| n as f64)) * ruler.pixel;
        let page = Page::in_millimetres(extent, margin, settings.dpi);
        check_pixels(figure, (page.size * page.pixels_per_mm()).element_product())?;
        paint::pixels(&page).map_err(|error| wrong(&error, figure))?;
        // Everything at its place.
        let (places, texts) = (Vec::new(), Vec::new());
        let mut layout = Self { figure, page, size: in_pixels, pixel: ruler.pixel, places, texts };
        layout.write(&title, [0, 0], None);
        layout.write(&caption, [0, bottom], None);
        for (((places, caption), at), width) in panels.iter().zip(&captions).zip(&placed).zip(&widths) {
            let [left, top] = at.corner;
            layout.places.extend(places.iter().map(|place| {
                let [x, y] = place.corner;
                PanelPlace { corner: [left + x, top + y], ..*place }
            }));
            // A single line stands in the middle.
            layout.write(caption, [left, at.text], (caption.lines.len() == 1).then_some(*width));
        }
        Ok(layout)
    }

    /// The places of the pictures of [`Figure::sources`].
    pub fn places(&self) -> &[PanelPlace] {
        &self.places
    }

    /// Gives a scene the size of its place. Its page is the panel, and the figure's settings hold for the page.
    pub fn fit(&self, scene: &mut Scene, place: &PanelPlace) {
        let [width, height] = place.size;
        let lengths =
            [width as f64 * self.pixel.x, height as f64 * self.pixel.y].map(|mm| Some(Length::Millimetres(mm)));
        let picture = &mut scene.picture;
        (picture.dpi, picture.size, picture.lengths) = (self.figure.figure.dpi, place.size, lengths);
        picture.layers = vec![LayerKind::Beauty];
        (scene.orbit, scene.page) = (None, self.figure.page.clone());
        if let Some(page) = &mut scene.page {
            page.margin = Length::Millimetres(0.0);
        }
    }

    /// The corners of the insets over a panel, in mm of the panel's page.
    fn insets_on(&self, place: &PanelPlace) -> Vec<[DVec2; 2]> {
        let after = self.places.iter().skip_while(|other| *other != place).skip(1);
        let insets = after.take_while(|other| other.is_inset);
        let from = |at| self.on_page(at) - self.on_page(place.corner);
        insets.map(|PanelPlace { corner: [x, y], size: [w, h], .. }| [[*x, *y], [x + w, y + h]].map(from)).collect()
    }

    /// Puts what the panels show on one page, and writes it. The report's notes begin with what is left out.
    ///
    /// # Errors
    /// A picture without colours, and the errors of [`Frame::write`](crate::drawing::Frame::write).
    pub fn write_panels(&self, panels: Vec<DrawnPanel>, path: &Path) -> Result<WriteReport, Failure> {
        let provenances: Vec<_> = panels.iter().filter_map(|panel| panel.provenance.clone()).collect();
        let (picture, marks, notes) = self.compose(panels)?;
        let provenance = figure_provenance(self.figure, &provenances);
        let mut report = write_picture(picture, marks, &self.scene(), provenance, path)?;
        report.notes.splice(0..0, notes);
        Ok(report)
    }

    /// Paints what the panels show on one page.
    ///
    /// # Errors
    /// A picture without colours, and the errors of [`Frame::painted`](crate::drawing::Frame::painted).
    pub fn paint_panels(&self, panels: Vec<DrawnPanel>) -> Result<Picture, Failure> {
        let (picture, marks, _) = self.compose(panels)?;
        paint_picture(picture, &marks, &self.scene())
    }

    /// The pixels and the marks of the page, and what is left out, a sentence each. Without pixels of panels there are none.
    fn compose(&self, panels: Vec<DrawnPanel>) -> Result<(Option<Picture>, Marks, Vec<String>), Failure> {
        let (mut pictures, mut notes) = (Vec::new(), Vec::new());
        let mut marks = Marks { page: self.page, layers: Vec::new() };
        for ((place, panel), (table, _)) in self.places.iter().zip(panels).zip(self.figure.sources()) {
            let PanelPlace { corner, size, is_inset } = *place;
            pictures.extend(panel.picture.map(|image| PlacedPicture { corner, size, image }));
            let corners = [corner, [corner[0] + size[0], corner[1] + size[1]]].map(|at| self.on_page(at));
            if is_inset {
                let table = table.split('.').next().unwrap_or_default();
                let covered = marks.cut_out(corners, &corners_of).into_iter();
                notes.extend(covered.map(|Text { characters, .. }| {
                    format!("{table}: the text {characters:?} is left out: an inset lies over it")
                }));
            }
            if let Some(mut drawn) = panel.marks {
                drawn.shift(corners[0]);
                drawn.layers.into_iter().for_each(|layer| add(&mut marks.layers, layer));
            }
            if is_inset {
                let [DVec2 { x: left, y: top }, DVec2 { x: right, y: bottom }] = corners;
                let frame = [(left, top), (right, top), (right, bottom), (left, bottom)].map(DVec2::from);
                add(
                    &mut marks.layers,
                    Layer { lines: vec![plain(&frame, FRAME, 1.0, true)], ..Layer::new(self.pen()) },
                );
            }
        }
        notes.extend(missing(&self.texts, self.is_plotted()));
        add(&mut marks.layers, Layer { texts: self.texts.clone(), ..Layer::new(self.pen()) });
        marks.settle();
        let background = self.figure.figure.background;
        let picture = (!pictures.is_empty()).then(|| lay_out(self.size, background, &pictures)).transpose();
        Ok((picture.map_err(|error| wrong(&error, self.figure))?, marks, notes))
    }

    /// A scene with the page of the figure, by which it is written.
    fn scene(&self) -> Scene {
        let settings = &self.figure.figure;
        let picture = self.page.picture();
        Scene {
            picture: PictureSettings {
                dpi: settings.dpi,
                size: self.size,
                lengths: [picture.x, picture.y].map(|mm| Some(Length::Millimetres(mm))),
                background: Background::Color(settings.background),
                ..PictureSettings::default()
            },
            page: self.figure.page.clone(),
            given: self.figure.given.clone(),
            ..Scene::default()
        }
    }

    /// Adds lines of text from a place in pixels, each in the middle of a width if one is given.
    fn write(&mut self, block: &TextBlock, at: [usize; 2], width: Option<usize>) {
        let size = block.size;
        let line = extent("", size);
        let start = self.on_page(at) + DVec2::new(0.0, ABOVE_TEXT * size + line.ascent);
        for (i, characters) in block.lines.iter().enumerate() {
            let free = width.map_or(0.0, |width| width as f64 * self.pixel.x - extent(characters, size).advance);
            let at = start + DVec2::new(free.max(0.0) / 2.0, i as f64 * (line.ascent + line.descent));
            self.texts.push(Text { characters: characters.clone(), at, size, opacity: 1.0 });
        }
    }

    /// The place of a pixel's corner on the page, in mm.
    fn on_page(&self, at: [usize; 2]) -> DVec2 {
        DVec2::splat(self.page.margin) + DVec2::from(at.map(|n| n as f64)) * self.pixel
    }

    /// The pen of texts and of the frames of insets.
    fn pen(&self) -> Pen {
        Pen { number: 1, name: "figure".into(), width: FRAME, color: self.figure.figure.color }
    }

    fn is_plotted(&self) -> bool {
        self.figure.page.as_ref().is_some_and(|page| page.plotter)
    }
}

/// The failure of a page that cannot be painted.
fn wrong(error: &OutputError, figure: &Figure) -> Failure {
    Failure::picture(error, figure.given.position(key_of_large(figure)))
}

/// The upper left and the lower right corner of a text.
fn corners_of(text: &Text) -> [DVec2; 2] {
    let extent = extent(&text.characters, text.size);
    [text.at - DVec2::new(0.0, extent.ascent), text.at + DVec2::new(extent.advance, extent.descent)]
}

#[cfg(test)]
mod tests;
