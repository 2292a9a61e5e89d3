//! A handle over the picture, which is dragged along a line of the world.

use super::PictureArea;
use drypoint::scene::glam::DVec3;
use drypoint::scene::view::View;
use eframe::egui::{self, Color32, Id, Rect, Role, Sense, Stroke, Ui, Vec2};

/// Fewest points of the window from foot to tip with which a handle can be dragged.
const SHORTEST: f32 = 4.0;

/// A disc at its foot with an arrow to its tip, both in the world.
pub(super) struct Handle<'a> {
    pub(super) name: &'a str,
    pub(super) foot: DVec3,
    pub(super) tip: DVec3,
    pub(super) color: Color32,
}

/// What the pointer does with a handle.
#[derive(Default)]
pub(super) struct Grip {
    /// Whether the pointer is on it.
    pub(super) is_taken: bool,
    /// The way by which it is dragged along its arrow, in the world.
    pub(super) by: Option<DVec3>,
}

impl Handle<'_> {
    /// Shows the handle, unless its foot is beside the picture.
    pub(super) fn show(&self, ui: &Ui, id: Id, picture: &PictureArea, view: &View) -> Grip {
        let ends = [self.foot, self.tip].map(|p| view.point_of(p).map(|p| picture.place(p)));
        let [Some(from), Some(to)] = ends else { return Grip::default() };
        if !picture.rect.contains(from) {
            return Grip::default();
        }
        let handle = ui.interact(Rect::from_center_size(from, Vec2::splat(18.0)), id, Sense::drag());
        handle.widget_info(|| egui::WidgetInfo::labeled(Role::Slider, true, self.name));
        let is_taken = handle.hovered() || handle.dragged();
        let color = if is_taken { Color32::WHITE } else { self.color };
        let painter = ui.painter_at(picture.rect);
        let along = to - from;
        painter.arrow(from, along, Stroke::new(4.0, Color32::from_black_alpha(160)));
        painter.arrow(from, along, Stroke::new(2.0, color));
        painter.circle(from, 6.0, color, Stroke::new(1.5, Color32::BLACK));
        // The share of the arrow that the pointer moved along it.
        let is_moved = handle.dragged() && along.length() > SHORTEST;
        let share = f64::from(handle.drag_delta().dot(along) / along.length_sq());
        Grip { is_taken, by: is_moved.then(|| (self.tip - self.foot) * share) }
    }
}
