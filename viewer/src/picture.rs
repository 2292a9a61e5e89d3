//! The picture in the window: it shows the frame, and turns, moves and scales the view as it is dragged.
//!
//! | pointer | |
//! |---|---|
//! | drag | turns |
//! | drag with Shift, or with the middle button | moves |
//! | drag with the right button, wheel, pinch | nearer and further |
//! | rest, click | see `pointer.rs` |

use crate::panels::{Panel, PictureArea};
use crate::pointer;
use crate::session::Session;
use eframe::egui::{self, Color32, PointerButton, Rect, Sense, Ui, Vec2, pos2};

/// Radians of a turn for a drag across the smaller side of the picture.
const TURN: f64 = std::f64::consts::PI;

/// Factor of a distance for a point of the wheel, or of a drag up or down.
const STEP: f64 = 1.002;

/// Shows the picture with the handles of panels over it.
pub fn picture(ui: &mut Ui, session: &mut Session, panels: &mut [Box<dyn Panel>]) {
    let area = ui.available_rect_before_wrap();
    let size = session.scene.as_ref().map_or([512, 512], |scene| scene.picture.size);
    let rect = fitted(area, size);
    // A frame larger than the window would take time for nothing.
    let points = f64::from(rect.width().max(rect.height())) * f64::from(ui.ctx().pixels_per_point());
    session.longest = (points.round() as usize).clamp(64, 4096);
    let response = ui.allocate_rect(area, Sense::click_and_drag());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Canvas, true, "Picture"));
    let picture = PictureArea { rect, size, response };
    let painter = ui.painter_at(area);
    painter.rect_filled(area, 0.0, ui.visuals().extreme_bg_color);
    match session.shown {
        Some(shown) => {
            checkerboard(&painter, rect);
            painter.image(shown.texture, rect, Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0)), Color32::WHITE);
        }
        None => {
            let text = if session.failures.is_some() {
                "This scene cannot be drawn yet"
            } else {
                "The volume is being read…"
            };
            painter.text(
                area.center(),
                egui::Align2::CENTER_CENTER,
                text,
                egui::FontId::proportional(16.0),
                ui.visuals().weak_text_color(),
            );
        }
    }
    let mut is_taken = false;
    for panel in panels {
        is_taken |= panel.over_picture(ui, &picture, session);
    }
    pointer::point(ui, session, &picture, is_taken);
    if !is_taken {
        drag(ui, session, &picture);
    }
}

/// Moves the camera as the picture is dragged and scrolled.
fn drag(ui: &Ui, session: &mut Session, picture: &PictureArea) {
    let response = &picture.response;
    let by = |button| response.dragged_by(button).then(|| response.drag_delta()).filter(|by| *by != Vec2::ZERO);
    let (shift, zoom, scroll) =
        ui.input(|input| (input.modifiers.shift, input.zoom_delta(), input.smooth_scroll_delta()));
    let middle = by(PointerButton::Middle).or_else(|| by(PointerButton::Primary).filter(|_| shift));
    let scale = picture.scale();
    if let Some(by) = middle {
        session.move_camera("move the view", |pose| pose.pan([by.x, by.y].map(|x| f64::from(x) * scale)));
    } else if let Some(by) = by(PointerButton::Primary) {
        let side = f64::from(picture.rect.width().min(picture.rect.height()));
        let [yaw, pitch] = [by.x, by.y].map(|x| -f64::from(x) * TURN / side);
        session.move_camera("turn the view", |pose| pose.orbit(yaw, pitch));
    } else if let Some(by) = by(PointerButton::Secondary) {
        let middle = picture.size.map(|side| side as f64 / 2.0);
        session.move_camera("scale the view", |pose| pose.dolly(STEP.powf(f64::from(by.y)), middle));
    }
    let factor = STEP.powf(-f64::from(scroll.y)) / f64::from(zoom);
    if let (true, Some(at)) = (factor != 1.0 && response.hovered(), response.hover_pos()) {
        session.move_camera("scale the view", |pose| pose.dolly(factor, picture.pixel(at)));
    }
}

/// The largest rectangle of a picture's shape in the middle of an area.
fn fitted(area: Rect, [width, height]: [usize; 2]) -> Rect {
    let size = Vec2::new(width as f32, height as f32);
    let scale = (area.width() / size.x).min(area.height() / size.y);
    Rect::from_center_size(area.center(), size * scale.max(0.0))
}

/// Paints what is seen through a transparent picture.
fn checkerboard(painter: &egui::Painter, rect: Rect) {
    const SIDE: f32 = 12.0;
    painter.rect_filled(rect, 0.0, Color32::from_gray(200));
    let [across, down] = [rect.width(), rect.height()].map(|length| (length / SIDE).ceil() as usize);
    let dark = (0..down).flat_map(|j| (0..across).filter(move |i| (i + j) % 2 == 1).map(move |i| [i, j]));
    let squares = dark.map(|at| {
        let [x, y] = at.map(|n| n as f32 * SIDE);
        let square = Rect::from_min_size(rect.min + Vec2::new(x, y), Vec2::splat(SIDE)).intersect(rect);
        egui::Shape::rect_filled(square, 0.0, Color32::from_gray(160))
    });
    painter.extend(squares);
}
