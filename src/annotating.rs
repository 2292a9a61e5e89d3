//! Annotations of a job's pictures: boxes, fans, arrows, labels, a scale bar, the directions of the data and a legend
//! ([VS-8], [VS-10]).

mod labels;
mod legend;
mod lines;
mod margin;
mod room;

use crate::Failure;
use crate::job::{Job, RenderTarget, pen_named};
use drypoint_output::text::{font::missing_characters, missing_strokes};
use drypoint_reference::ray::Renderer;
use drypoint_reference::volumeshop::conventions::{ArrowCurve, Fan, edge_points, edges};
use drypoint_scene::annotations::AnnotationLayout;
use drypoint_scene::glam::{DVec2, DVec3};
use drypoint_scene::marks::{Area, Layer, Marks, Page, Pen, Text};
use drypoint_scene::picture::Overlay;
use drypoint_scene::tables::{
    AnnotatedPlace, Annotations, ArrowEnds, ArrowTable, BoxShown, BoxTable, FanTable, Length, LineStyle, ObjectTable,
    PartName,
};
use drypoint_scene::view::View;
use labels::Anchored;
use legend::NamedRow;
use lines::Seen;
pub(crate) use lines::plain;
use room::MarginRoom;

/// The most points of one line.
const MOST_POINTS: usize = 20_000;

/// Frames of a job's annotations.
pub(crate) struct Annotating<'a> {
    job: &'a Job,
    tables: Annotations,
    /// The rows of the legend.
    rows: Vec<NamedRow>,
    page: Page,
    /// The objects where they are in the frame.
    pub(crate) objects: Vec<ObjectTable>,
    /// Rectangles that pictures of a figure cover, in mm.
    pub(crate) insets: Vec<[DVec2; 2]>,
    /// The places that labels lead to, found in the first frame.
    anchors: Option<Vec<Anchored>>,
    /// The labels of the frame before.
    previous: Option<AnnotationLayout>,
}

/// Annotations of one frame.
pub(crate) struct AnnotationFrame {
    /// The layers, from the lowest.
    pub(crate) layers: Vec<Layer>,
    /// Pixels of the picture below all layers: the spheres of a legend.
    pub(crate) overlays: Vec<Overlay>,
    /// Labels and characters that are left out, a sentence each.
    pub(crate) notes: Vec<String>,
}

/// Returns the name of a label, as words.
fn name_of_label(job: &Job, id: u32) -> String {
    job.label_names.name(id).map_or_else(|| format!("label {id}"), words)
}

/// Returns an identifier as words.
fn words(name: &str) -> String {
    name.replace('_', " ")
}

/// The characters of texts that no letters are drawn for, in a sentence; none if all are.
pub(crate) fn missing<'t>(texts: impl IntoIterator<Item = &'t Text>, is_plotted: bool) -> Option<String> {
    let all: String = texts.into_iter().map(|text| text.characters.as_str()).collect();
    let missing = if is_plotted { missing_strokes(&all) } else { missing_characters(&all) };
    let missing: String = missing.into_iter().collect();
    (!missing.is_empty()).then(|| format!("boxes stand for the characters {missing:?}, which the letters lack"))
}

impl<'a> Annotating<'a> {
    /// Makes frames of a job's annotations. Returns none if there are none, or if the picture lacks the layer `beauty`,
    /// over which they are drawn.
    ///
    /// # Errors
    /// A legend whose names are not as many as its rows.
    pub(crate) fn new(job: &'a Job) -> Result<Option<Self>, Failure> {
        let is_shown = match job.target() {
            RenderTarget::Picture => job.shows_beauty(),
            RenderTarget::Marks => true,
            RenderTarget::Points | RenderTarget::Strokes => false,
        };
        let tables = job.scene.all_annotations();
        if !is_shown || tables.is_empty() {
            return Ok(None);
        }
        let (rows, page) = (legend::rows(job)?, Page::of(&job.scene));
        let objects = job.scene.objects.clone();
        Ok(Some(Self { job, tables, rows, page, objects, insets: Vec::new(), anchors: None, previous: None }))
    }

    /// Returns the annotations that a camera sees. `renderer` is at this camera; without it nothing hides a line.
    ///
    /// # Errors
    /// A pen that the scene does not have, or a label whose structure does not exist.
    pub(crate) fn draw(&mut self, view: &View, renderer: Option<&Renderer<'_>>) -> Result<AnnotationFrame, Failure> {
        let mut notes = Vec::new();
        let mut layers = self.boxes(view, renderer)?;
        let ways = self.ways(view, renderer, &mut notes)?;
        let mut room = MarginRoom::new(&self.page);
        room.taken.clone_from(&self.insets);
        let legend = self.legend(view, &mut room, &mut notes)?;
        let margin = self.margin(view, &mut room, &mut notes)?;
        let mut ways = Marks { page: self.page, layers: ways };
        ways.settle();
        let of_ways = ways.layers.iter().flat_map(lines::rectangles);
        let obstacles = room.taken.into_iter().chain(of_ways).collect();
        layers.extend(ways.layers);
        layers.extend(self.labels(view, renderer, obstacles, &mut notes)?);
        layers.extend(margin);
        let (layer, overlays) = legend.map(|legend| (legend.layer, legend.spheres)).unzip();
        layers.extend(layer);
        notes.extend(missing(layers.iter().flat_map(|layer| &layer.texts), self.is_plotted()));
        let mut marks = Marks { page: self.page, layers };
        marks.settle();
        Ok(AnnotationFrame { layers: marks.layers, overlays: overlays.unwrap_or_default(), notes })
    }

    /// Whether a plotter draws the page.
    fn is_plotted(&self) -> bool {
        self.job.scene.page.as_ref().is_some_and(|page| page.plotter)
    }

    fn tables(&self) -> &Annotations {
        &self.tables
    }

    /// Whether rays tell what is drawn.
    pub(crate) fn asks_rays(&self) -> bool {
        self.tables.asks_rays()
    }

    /// Boxes of parts.
    fn boxes(&self, view: &View, renderer: Option<&Renderer<'_>>) -> Result<Vec<Layer>, Failure> {
        let mut layers = Vec::new();
        let shown = |(_, table): &(usize, &BoxTable)| table.show == BoxShown::Always;
        for (i, table) in self.tables().boxes.iter().enumerate().filter(shown) {
            let Some(corners) = self.corners_of(&table.of) else { continue };
            let pen = self.pen(&table.line, "box", &format!("box[{i}].pen"))?;
            let seen = self.seen(view, renderer.filter(|_| table.occluded), &pen);
            let lines = edges(corners)
                .into_iter()
                .flat_map(|edge| seen.line(&edge_points(view, edge, MOST_POINTS), lines::Course::Straight));
            layers.push(Layer { lines: lines.collect(), ..Layer::new(pen) });
        }
        Ok(layers)
    }

    /// Fans and arrows, which lead from one place to another.
    fn ways(
        &self,
        view: &View,
        renderer: Option<&Renderer<'_>>,
        notes: &mut Vec<String>,
    ) -> Result<Vec<Layer>, Failure> {
        let tables = self.tables();
        let mut layers = Vec::new();
        for (i, table) in tables.fans.iter().enumerate() {
            layers.extend(self.fan(view, table, i)?);
        }
        for (i, table) in tables.arrows.iter().enumerate() {
            layers.extend(self.arrow(view, renderer.filter(|_| table.occluded), table, (i, notes))?);
        }
        Ok(layers)
    }

    /// The outlines of a fan on the page, in mm. Returns none if an end is not before the eye.
    fn fan_outlines(&self, view: &View, table: &FanTable) -> Option<Fan> {
        let ends = [(&table.from, false), (&table.to, true)].map(|(end, is_to)| self.end(end, is_to));
        let [from, to] = ends.map(|end| end.map(|end| self.on_page(view, &self.corners(&end))));
        Fan::new(table.shape, [&from?, &to?])
    }

    /// A fan: its area, then its outlines.
    fn fan(&self, view: &View, table: &FanTable, i: usize) -> Result<Vec<Layer>, Failure> {
        let Some(fan) = self.fan_outlines(view, table) else { return Ok(Vec::new()) };
        let pen = self.pen(&table.line, "fan", &format!("fan[{i}].pen"))?;
        let width = pen.width;
        let closed = fan.outlines.iter().map(|outline| lines::plain(outline, width, 1.0, true));
        let joints = fan.joints.iter().map(|joint| lines::plain(joint, width, 1.0, false));
        let outlines = Layer { lines: closed.chain(joints).collect(), ..Layer::new(pen) };
        let mut layers = Vec::new();
        if table.fill[3] > 0.0 {
            let pen = Pen { number: 1, name: "fan area".into(), width, color: table.fill };
            let areas = vec![Area { outlines: fan.area, opacity: 1.0, color: None }];
            layers.push(Layer { areas, ..Layer::new(pen) });
        }
        layers.push(outlines);
        Ok(layers)
    }

    /// An arrow: its shaft and its head. There is none between places that are equal.
    fn arrow(
        &self,
        view: &View,
        renderer: Option<&Renderer<'_>>,
        table: &ArrowTable,
        (i, notes): (usize, &mut Vec<String>),
    ) -> Result<Option<Layer>, Failure> {
        let pen = self.pen(&table.line, "arrow", &format!("arrow[{i}].pen"))?;
        let (Some(from), Some(to)) = (self.end(&table.from, false), self.end(&table.to, true)) else {
            return Ok(None);
        };
        let places = [&from, &to].map(|end| self.centre(end));
        let Some(curve) = ArrowCurve::new(view, places, table.bend) else {
            notes.extend(undrawn(view, places).map(|why| format!("the arrow {i} is left out: {why}")));
            return Ok(None);
        };
        // The part between the boxes' outlines.
        let [mut begin, mut tip] = [0.0, 1.0];
        if table.ends == ArrowEnds::Box {
            let inside = |end: &AnnotatedPlace| {
                let corners = self.corners(end);
                let points: Vec<DVec2> = corners.iter().filter_map(|&p| view.point_of(p)).map(DVec2::from).collect();
                curve.inside(&points)
            };
            let [before, after] = [inside(&from), inside(&to)];
            (begin, tip) = (before.map_or(0.0, |[_, last]| last), after.map_or(1.0, |[first, _]| first));
            if begin >= tip {
                [begin, tip] = [0.0, 1.0];
            }
        }
        let half = curve.length([begin, tip]) / 2.0;
        let head = (self.mm(table.head) * self.pixels_per_mm(view)).min(half);
        let neck = curve.before(tip, head * 0.8).max(begin);
        let seen = self.seen(view, renderer, &pen);
        let shaft = seen.line(&curve.points([begin, neck], MOST_POINTS), lines::Course::Curved);
        let outline = curve.head(tip, head);
        let depth = curve.at(tip).depth;
        let color = seen.area(&outline, depth);
        let areas = color.filter(|_| head > 0.0).map(|color| Area {
            outlines: vec![outline.iter().map(|&at| self.page.place(at, view.size)).collect()],
            opacity: 1.0,
            color,
        });
        Ok(Some(Layer { lines: shaft, areas: areas.into_iter().collect(), ..Layer::new(pen) }))
    }

    /// Returns the place of an end; by default the ghost, or the selection, of the only object that is moved.
    fn end(&self, end: &Option<AnnotatedPlace>, is_to: bool) -> Option<AnnotatedPlace> {
        end.clone().or_else(|| {
            let scene = &self.job.scene;
            let moved = (0..scene.objects.len()).find(|&i| scene.leaves_ghost(i))?;
            let name = scene.objects[moved].name.clone();
            Some(AnnotatedPlace::Part(if is_to { PartName::Selection(name) } else { PartName::Ghost(name) }))
        })
    }

    /// Returns the corners of a place; of a point the point itself.
    fn corners(&self, place: &AnnotatedPlace) -> Vec<DVec3> {
        match place {
            AnnotatedPlace::Point(point) => vec![*point],
            AnnotatedPlace::Part(part) => self.corners_of(part).map(Vec::from).unwrap_or_default(),
        }
    }

    /// Returns the corners of the box of a part in the frame. See [`Job::corners`].
    fn corners_of(&self, part: &PartName) -> Option<[DVec3; 8]> {
        self.job.corners(&self.objects, part)
    }

    /// Returns the centre of a place.
    fn centre(&self, place: &AnnotatedPlace) -> DVec3 {
        let corners = self.corners(place);
        corners.iter().sum::<DVec3>() / corners.len().max(1) as f64
    }

    /// Returns points in world space on the page, in mm. Points behind the eye are left out.
    fn on_page(&self, view: &View, points: &[DVec3]) -> Vec<DVec2> {
        let seen = points.iter().filter_map(|&point| view.point_of(point));
        seen.map(|at| self.page.place(DVec2::from(at), view.size)).collect()
    }

    /// Returns what lies before lines of a pen.
    fn seen<'s>(&'s self, view: &'s View, renderer: Option<&'s Renderer<'s>>, pen: &Pen) -> Seen<'s> {
        let [r, g, b, _] = pen.color;
        Seen { page: &self.page, view, renderer, rgb: [r, g, b], width: pen.width }
    }

    /// Returns the pen of a line style. `key` names the key of its name.
    fn pen(&self, style: &LineStyle, name: &str, key: &str) -> Result<Pen, Failure> {
        match &style.pen {
            Some(name) => pen_named(&self.job.scene, &self.page, name, key),
            None => {
                let width = lines::on_step(self.mm(style.width));
                Ok(Pen { number: 1, name: name.into(), width, color: style.color })
            }
        }
    }

    /// Returns a length on the page, in mm.
    fn mm(&self, length: Length) -> f64 {
        self.page.length(length).unwrap_or_default()
    }

    fn pixels_per_mm(&self, view: &View) -> f64 {
        view.size[1] as f64 / self.page.picture().y
    }
}

/// The reason why there is no arrow between two places. Returns none if both are one place for the eye.
fn undrawn(view: &View, places: [DVec3; 2]) -> Option<&'static str> {
    let ends = places.map(|place| view.point_of(place).map(DVec2::from));
    let [near, far] = places.map(|place| view.to_eye(place).z);
    match ends {
        [Some(from), Some(to)] if from == to && from.is_finite() => {
            (near != far).then_some("it is seen along its direction; try another bend")
        }
        [Some(_), Some(_)] => Some("it is too long for the picture; try a smaller bend, or nearer places"),
        _ => Some("one of its ends is not before the eye"),
    }
}
