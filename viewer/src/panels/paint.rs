//! The brush: it is dragged over the picture and appends its dabs to the strokes of an object ([VS-6]).
//!
//! A dab is asked about with the scene on which it was drawn, and is written with the stroke's own radius, shape, mode and
//! object. So it does not matter what has changed before the answer comes; only with another document dabs are dropped.

use super::PictureArea;
use super::objects::{new_name, new_object};
use crate::brush::{BrushPicker, BrushQuery, picker};
use crate::camera::{place, rounded};
use crate::document::Edit;
use crate::frames::VolumeData;
use crate::key::KeyPath;
use crate::session::Session;
use drypoint::reference::ray::Picked;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::Scene;
use eframe::egui::{Color32, Context, DragValue, Pos2, Stroke, Ui};
use std::collections::VecDeque;
use std::sync::Arc;
use toml_edit::{InlineTable, Value};

/// Share of the brush's radius between dabs of a drag.
const SPACING: f32 = 1.0 / 3.0;

/// Fewest points of the window between dabs.
const CLOSEST: f32 = 2.0;

/// A stroke as it was begun.
struct OpenStroke {
    /// The label of its change. Each stroke is undone by itself.
    label: String,
    /// The name of the object that it paints.
    object: String,
    /// Whether it makes the object if there is none with that name.
    makes_object: bool,
    /// The keys of its dabs, apart from their place.
    dab: InlineTable,
}

/// Pixels of a question, with all that tells where they lie and what they paint.
struct Part {
    /// The document ([`Session::document_number`]).
    document: u64,
    scene: Arc<Scene>,
    data: Arc<VolumeData>,
    pixels: Vec<[usize; 2]>,
    /// The stroke that has a dab at each pixel. None: the pointer's place is asked, to know its depth.
    stroke: Option<Arc<OpenStroke>>,
}

impl Part {
    /// Whether both have dabs of one stroke.
    fn paints_like(&self, other: &Self) -> bool {
        self.stroke.as_ref().zip(other.stroke.as_ref()).is_some_and(|(stroke, other)| Arc::ptr_eq(stroke, other))
    }
}

/// The brush.
pub(super) struct PaintTool {
    /// Radius in voxels.
    radius: f64,
    /// The shape, as a scene file names it.
    shape: &'static str,
    is_erasing: bool,
    /// The thread, once the brush was on.
    picker: Option<BrushPicker>,
    /// The question that is not answered. There is one at a time, so none is lost.
    asked: Option<Part>,
    /// Questions that are not asked yet.
    waiting: VecDeque<Part>,
    /// The pointer's pixel that was asked last, and the scene's serial number.
    hovered: Option<(u64, [usize; 2])>,
    /// Whether the drag that goes on is the brush's; none while the button is up.
    is_dragged: Option<bool>,
    /// The stroke while the button is down, and the place in the window of its last dab.
    open: Option<(Arc<OpenStroke>, Pos2)>,
    /// The places in the window of dabs that the picture does not show yet.
    trail: Vec<Pos2>,
    /// Strokes so far.
    strokes: u64,
    /// Eye depth of the last place.
    depth: Option<f64>,
}

impl Default for PaintTool {
    fn default() -> Self {
        Self {
            radius: 5.0,
            shape: "gaussian",
            is_erasing: false,
            picker: None,
            asked: None,
            waiting: VecDeque::new(),
            hovered: None,
            is_dragged: None,
            open: None,
            trail: Vec::new(),
            strokes: 0,
            depth: None,
        }
    }
}

impl PaintTool {
    /// Shows the settings of the brush.
    pub(super) fn ui(&mut self, ui: &mut Ui, session: &mut Session) {
        ui.horizontal(|ui| {
            ui.toggle_value(&mut session.is_painting, "Paint").on_hover_text("B turns the brush on and off.");
            ui.selectable_value(&mut self.is_erasing, false, "add");
            ui.selectable_value(&mut self.is_erasing, true, "erase");
        });
        ui.horizontal(|ui| {
            let label = ui.label("radius in voxels").id;
            ui.add(DragValue::new(&mut self.radius).range(0.0..=1000.0).speed(0.1).max_decimals(1)).labelled_by(label);
            for shape in ["gaussian", "ball", "box"] {
                ui.selectable_value(&mut self.shape, shape, shape);
            }
        });
        ui.label(
            "A drag in the picture paints what is seen there. With Ctrl it turns the picture, with Shift it moves it.",
        );
    }

    /// Follows the pointer over the picture, and paints on an object. Returns whether the pointer is the brush's.
    pub(super) fn over_picture(
        &mut self,
        ui: &Ui,
        picture: &PictureArea,
        session: &mut Session,
        object: usize,
    ) -> bool {
        self.take(session);
        let follows = if session.is_painting { self.follow(ui, picture, session, object) } else { None };
        if follows.is_none() {
            (self.open, self.depth) = (None, None);
        }
        self.ask(ui.ctx());
        let is_dab = |part: &Part| part.stroke.is_some() && part.document == session.document_number();
        let is_out = self.waiting.iter().chain(&self.asked).any(is_dab);
        session.is_stroke_open = is_out || self.open.is_some();
        if session.is_settled() && !session.is_stroke_open {
            self.trail.clear();
        }
        let line = Stroke::new(2.0, Color32::from_white_alpha(160));
        ui.painter_at(picture.rect).line(self.trail.clone(), line);
        follows == Some(true)
    }

    /// Draws the stroke of a drag, and shows the brush. Returns whether the pointer is the brush's; none while the volume
    /// is read.
    fn follow(&mut self, ui: &Ui, picture: &PictureArea, session: &Session, object: usize) -> Option<bool> {
        let (scene, data, pose) = (session.scene.clone()?, session.data().cloned()?, session.pose()?);
        // The size of the brush on the window, at the depth of the volume under it.
        let depth = if pose.view.perspective { self.depth.unwrap_or_else(|| pose.depth()) } else { 1.0 };
        let pixels = self.radius * data.volume.grid().voxel() / (pose.view.pixel * depth);
        let radius = (pixels / picture.scale()) as f32;
        let (modifiers, is_down) = ui.input(|input| (input.modifiers, input.pointer.primary_down()));
        let response = &picture.response;
        let at = response.interact_pointer_pos().filter(|_| is_down && response.is_pointer_button_down_on());
        // A drag stays what it was when the button was pressed.
        let is_free = !modifiers.command && !modifiers.shift;
        self.is_dragged = at.map(|_| self.is_dragged.unwrap_or(is_free));
        let is_brush = self.is_dragged.unwrap_or(is_free);
        let part = |pixels, stroke| {
            let (scene, data) = (Arc::clone(&scene), Arc::clone(&data));
            Part { document: session.document_number(), scene, data, pixels, stroke }
        };
        match at.filter(|_| is_brush) {
            Some(at) => {
                let pixels = self.drag(picture, at, radius, &scene, object);
                let stroke = self.open.as_ref().map(|(stroke, _)| Arc::clone(stroke));
                self.wait(part(pixels, stroke));
            }
            None => self.open = None,
        }
        let hovered = response.hover_pos().filter(|at| is_brush && picture.rect.contains(*at));
        if let Some(at) = hovered {
            let painter = ui.painter_at(picture.rect);
            let color = if self.is_erasing { Color32::from_rgb(255, 196, 64) } else { Color32::WHITE };
            painter.circle_stroke(at, radius.max(2.0), Stroke::new(3.0, Color32::from_black_alpha(120)));
            painter.circle_stroke(at, radius.max(2.0), Stroke::new(1.5, color));
        }
        let is_idle = self.open.is_none() && self.asked.is_none() && self.waiting.is_empty();
        let pixel = hovered.filter(|_| is_idle).and_then(|at| picture.pixel_at(at));
        if let Some(pixel) = pixel.filter(|pixel| self.hovered != Some((session.serial(), *pixel))) {
            self.hovered = Some((session.serial(), pixel));
            self.wait(part(vec![pixel], None));
        }
        Some(is_brush)
    }

    /// Puts a part behind those that are not asked yet. Dabs of one stroke on one scene are one question.
    fn wait(&mut self, part: Part) {
        let is_same = |last: &&mut Part| Arc::ptr_eq(&last.scene, &part.scene) && last.paints_like(&part);
        match self.waiting.back_mut().filter(is_same) {
            Some(last) => last.pixels.extend(part.pixels),
            None if part.pixels.is_empty() => {}
            None => self.waiting.push_back(part),
        }
    }

    /// Goes on with the stroke from its last dab to a place in the window, or begins one there. Returns the pixels of the
    /// new dabs.
    fn drag(&mut self, picture: &PictureArea, to: Pos2, radius: f32, scene: &Scene, object: usize) -> Vec<[usize; 2]> {
        let spacing = (radius * SPACING).max(CLOSEST);
        let mut places = Vec::new();
        match &mut self.open {
            None => {
                self.strokes += 1;
                self.trail.clear();
                self.open = Some((Arc::new(self.begun(scene, object)), to));
                places.push(to);
            }
            Some((_, last)) => {
                while last.distance(to) >= spacing {
                    *last += (to - *last).normalized() * spacing;
                    places.push(*last);
                }
            }
        }
        self.trail.extend(&places);
        places.into_iter().filter_map(|at| picture.pixel_at(at)).collect()
    }

    /// A stroke with the settings as they are, on an object or on a new one.
    fn begun(&self, scene: &Scene, object: usize) -> OpenStroke {
        let object = scene.objects.get(object);
        OpenStroke {
            label: format!("paint stroke {}", self.strokes),
            object: object.map_or_else(|| new_name(scene), |object| object.name.clone()),
            makes_object: object.is_none(),
            dab: InlineTable::from_iter([
                ("radius", Value::from(format!("{} voxels", rounded(self.radius, 1)))),
                ("brush", self.shape.into()),
                ("mode", if self.is_erasing { "subtract" } else { "add" }.into()),
            ]),
        }
    }

    /// Asks the next question.
    fn ask(&mut self, ctx: &Context) {
        if self.asked.is_none()
            && let Some(part) = self.waiting.pop_front()
        {
            let picker = self.picker.get_or_insert_with(|| {
                let ctx = ctx.clone();
                picker(Box::new(move || ctx.request_repaint()))
            });
            picker.ask(BrushQuery::new(&part.scene, Arc::clone(&part.data.volume), part.pixels.clone()));
            self.asked = Some(part);
        }
    }

    /// Takes the answer to the question, and appends the dabs that it is of.
    fn take(&mut self, session: &mut Session) {
        if self.asked.is_some() && self.picker.as_ref().is_some_and(|picker| !picker.is_alive()) {
            // The next question starts another thread.
            self.picker = None;
            let lost = self.asked.take().into_iter().chain(self.waiting.drain(..));
            if lost.filter(|part| part.stroke.is_some()).count() > 0 {
                session.notice = "The thread of the brush has ended; dabs without an answer are lost.".into();
            }
            return;
        }
        let answer = self.picker.as_ref().and_then(|picker| picker.answers().last());
        let Some((part, answer)) = self.asked.take_if(|_| answer.is_some()).zip(answer) else { return };
        let found: Vec<Picked> = match answer {
            Ok(found) => found.into_iter().flatten().collect(),
            Err(failures) => return session.notice = failures.to_string(),
        };
        self.depth = found.last().map(|picked| picked.depth).or(self.depth);
        let is_of_document = part.document == session.document_number();
        if let Some(stroke) = part.stroke.filter(|_| is_of_document && !found.is_empty()) {
            append(session, &stroke, &found, part.data.volume.grid());
        }
    }
}

/// Appends the dabs of a stroke to its object. They are dropped if the object is gone, or is not painted any more.
fn append(session: &mut Session, stroke: &OpenStroke, found: &[Picked], grid: &Grid) {
    let Some(scene) = session.scene.clone() else { return };
    let index = scene.objects.iter().position(|object| object.name == stroke.object);
    let strokes = KeyPath::from("object").item(index.unwrap_or(scene.objects.len())).name("strokes");
    let mut edits = match index {
        Some(_) if session.document.get(&strokes).is_some() => Vec::new(),
        None if stroke.makes_object => new_object(session, &scene, &stroke.object),
        _ => return,
    };
    edits.extend(found.iter().map(|picked| {
        let mut dab = InlineTable::from_iter([("at", voxel(picked, grid))]);
        dab.extend(stroke.dab.clone());
        Edit::Insert(strokes.clone(), usize::MAX, dab)
    }));
    session.edit(&stroke.label, edits);
}

/// The middle of the voxel about which a brush at a picked place is centred: the nearest one, and of two the one with the
/// lower index. Written so, no rounding of the place leads to another voxel.
fn voxel(picked: &Picked, grid: &Grid) -> Value {
    place(grid.to_world((picked.index - 0.5).ceil()), grid)
}
