//! The brush: it is dragged over the picture and appends its dabs to the strokes of an object ([VS-6]).

use super::PictureArea;
use super::objects::new_object;
use crate::brush::{BrushPicker, BrushPlaces, BrushQuery, picker};
use crate::camera::{place, rounded};
use crate::document::Edit;
use crate::key::KeyPath;
use crate::session::Session;
use drypoint::scene::glam::DVec3;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::Scene;
use drypoint::scene::volume::Volume;
use eframe::egui::{Color32, DragValue, Pos2, Stroke, Ui};
use std::sync::Arc;
use toml_edit::InlineTable;

/// Share of the brush's radius between dabs of a drag.
const SPACING: f32 = 1.0 / 3.0;

/// Fewest points of the window between dabs.
const CLOSEST: f32 = 2.0;

/// The brush.
pub(super) struct PaintTool {
    /// Radius in voxels.
    radius: f64,
    /// The shape, as a scene file names it.
    shape: &'static str,
    is_erasing: bool,
    /// The thread, once the brush was on.
    picker: Option<BrushPicker>,
    /// The question that is not answered: whether it is of dabs, or else of the pointer.
    asked: Option<bool>,
    /// Pixels of dabs that are not asked yet.
    waiting: Vec<[usize; 2]>,
    /// The pointer's pixel that was asked last, and the scene's serial number.
    hovered: Option<(u64, [usize; 2])>,
    /// Whether the drag that goes on is the brush's; none while the button is up.
    is_dragged: Option<bool>,
    /// The place in the window of the last dab, while the button is down.
    last: Option<Pos2>,
    /// The places in the window of dabs that the picture does not show yet.
    trail: Vec<Pos2>,
    /// Strokes so far. Each is undone by itself.
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
            waiting: Vec::new(),
            hovered: None,
            is_dragged: None,
            last: None,
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
        if !session.is_painting {
            // The document may be another one by now.
            self.asked = self.asked.map(|_| false);
        }
        self.take(session, object);
        session.is_stroke_open = false;
        if !session.is_painting {
            (self.last, self.depth) = (None, None);
            self.waiting.clear();
            return false;
        }
        let (Some(scene), Some(data), Some(pose)) = (session.scene.clone(), session.data().cloned(), session.pose())
        else {
            return false;
        };
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
        match at.filter(|_| is_brush) {
            Some(at) => self.drag(picture, at, radius),
            None => self.last = None,
        }
        self.ask(ui, picture, session, &scene, &data.volume);
        session.is_stroke_open = self.last.is_some() || self.asked == Some(true) || !self.waiting.is_empty();
        if session.is_settled() && !session.is_stroke_open {
            self.trail.clear();
        }
        let painter = ui.painter_at(picture.rect);
        painter.line(self.trail.clone(), Stroke::new(2.0, Color32::from_white_alpha(160)));
        if let Some(at) = response.hover_pos().filter(|at| is_brush && picture.rect.contains(*at)) {
            let color = if self.is_erasing { Color32::from_rgb(255, 196, 64) } else { Color32::WHITE };
            painter.circle_stroke(at, radius.max(2.0), Stroke::new(3.0, Color32::from_black_alpha(120)));
            painter.circle_stroke(at, radius.max(2.0), Stroke::new(1.5, color));
        }
        is_brush
    }

    /// Adds dabs from the last one to a place in the window.
    fn drag(&mut self, picture: &PictureArea, to: Pos2, radius: f32) {
        let spacing = (radius * SPACING).max(CLOSEST);
        let mut places = Vec::new();
        match self.last {
            None => {
                self.strokes += 1;
                self.trail.clear();
                places.push(to);
            }
            Some(mut last) => {
                while last.distance(to) >= spacing {
                    last += (to - last).normalized() * spacing;
                    places.push(last);
                }
            }
        }
        for at in places {
            self.last = Some(at);
            self.trail.push(at);
            self.waiting.extend(picture.pixel_at(at));
        }
    }

    /// Asks for the places of dabs, or else for the place under the pointer. There is one question at a time, so none is
    /// lost.
    fn ask(&mut self, ui: &Ui, picture: &PictureArea, session: &Session, scene: &Scene, volume: &Arc<Volume>) {
        if self.asked.is_some() {
            return;
        }
        let is_dabs = !self.waiting.is_empty();
        let pixels = if is_dabs {
            std::mem::take(&mut self.waiting)
        } else {
            let hovered = picture.response.hover_pos().and_then(|at| picture.pixel_at(at));
            let hovered = hovered.map(|pixel| (session.serial(), pixel)).filter(|_| self.last.is_none());
            match hovered.filter(|_| hovered != self.hovered) {
                Some((_, pixel)) => {
                    self.hovered = hovered;
                    vec![pixel]
                }
                None => return,
            }
        };
        self.asked = Some(is_dabs);
        let picker = self.picker.get_or_insert_with(|| {
            let ctx = ui.ctx().clone();
            picker(Box::new(move || ctx.request_repaint()))
        });
        picker.ask(BrushQuery::new(scene, Arc::clone(volume), pixels));
    }

    /// Takes the answer to the question, and appends the dabs that it is of.
    fn take(&mut self, session: &mut Session, object: usize) {
        let answer: Option<BrushPlaces> = self.picker.as_ref().and_then(|picker| picker.answers().last());
        let Some((is_dabs, answer)) = self.asked.take_if(|_| answer.is_some()).zip(answer) else { return };
        let found = match answer {
            Ok(found) => found.into_iter().flatten().collect::<Vec<_>>(),
            Err(failures) => return session.notice = failures.to_string(),
        };
        self.depth = found.last().map(|picked| picked.depth).or(self.depth);
        let Some(data) = session.data().cloned().filter(|_| is_dabs && !found.is_empty()) else { return };
        let strokes = KeyPath::from("object").item(object).name("strokes");
        let dab = |at| Edit::Insert(strokes.clone(), usize::MAX, self.dab(at, data.volume.grid()));
        let mut edits = match session.document.get(&KeyPath::from("object").item(object)) {
            Some(_) => Vec::new(),
            None => new_object(session, object),
        };
        edits.extend(found.iter().map(|picked| dab(picked.world)));
        session.edit(&format!("paint stroke {}", self.strokes), edits);
    }

    /// A dab as the scene writes it.
    fn dab(&self, at: DVec3, grid: &Grid) -> InlineTable {
        InlineTable::from_iter([
            ("at", place(at, grid)),
            ("radius", format!("{} voxels", rounded(self.radius, 1)).into()),
            ("brush", self.shape.into()),
            ("mode", if self.is_erasing { "subtract" } else { "add" }.into()),
        ])
    }
}
