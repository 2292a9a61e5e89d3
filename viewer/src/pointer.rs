//! The pointer on the picture, apart from drags: where it rests the place is probed, and a click moves the cross-hair there.

use crate::panels::PictureArea;
use crate::session::Session;
use eframe::egui::{self, Align2, Color32, Stroke, Ui, Vec2};
use std::time::Duration;

/// Time after which a pointer is taken to rest.
const REST: Duration = Duration::from_millis(250);

/// Points of the window from the cross-hair's middle to its ends.
const ARM: f32 = 12.0;

/// Shows the numbers of the place under a pointer that rests, and the cross-hair. `is_taken`: the pointer is on a handle.
pub(crate) fn point(ui: &Ui, session: &mut Session, picture: &PictureArea, is_taken: bool) {
    let pixel = picture.response.hover_pos().and_then(|at| picture.pixel_at(at));
    if let Some(pixel) = pixel.filter(|_| !is_taken) {
        let rested = ui.input(|input| input.pointer.time_since_last_movement());
        if picture.response.clicked() {
            session.ask_pixel(pixel, true);
        } else if rested >= REST.as_secs_f32() {
            // While frames are drawn the processor is theirs.
            if session.is_settled() {
                session.ask_pixel(pixel, false);
            }
            show_place(ui, session, picture, pixel);
        } else {
            ui.ctx().request_repaint_after(REST);
        }
    }
    let cross = session.cross.and_then(|cross| session.pose()?.view.point_of(cross));
    if let Some(at) = cross.map(|point| picture.place(point)) {
        let painter = ui.painter_at(picture.rect);
        for arm in [Vec2::X, Vec2::Y, -Vec2::X, -Vec2::Y] {
            for (width, color) in [(3.0, Color32::from_black_alpha(160)), (1.0, Color32::WHITE)] {
                painter.line_segment([at + arm * 3.0, at + arm * ARM], Stroke::new(width, color));
            }
        }
    }
}

/// Shows the numbers of a pixel in the lower left corner of the picture, once they are known.
fn show_place(ui: &Ui, session: &Session, picture: &PictureArea, pixel: [usize; 2]) {
    let is_of = |report: &&crate::probe::PixelReport| report.serial == session.serial() && report.pixel == pixel;
    let Some(report) = session.probed.as_ref().filter(is_of) else { return };
    // Faults of the scene have their own place.
    let Ok(place) = &report.place else { return };
    let area = egui::Area::new(ui.scope_id().with("place"))
        .fixed_pos(picture.rect.left_bottom() + Vec2::new(8.0, -8.0))
        .pivot(Align2::LEFT_BOTTOM)
        .interactable(false);
    area.show(ui.ctx(), |ui| {
        egui::Frame::popup(ui.style()).show(ui, |ui| match place {
            Some(place) => {
                egui::Grid::new("numbers").num_columns(2).spacing([12.0, 2.0]).show(ui, |ui| {
                    for [name, number] in place.lines() {
                        ui.weak(name);
                        ui.label(number);
                        ui.end_row();
                    }
                });
            }
            None => drop(ui.weak("Nothing is seen here")),
        });
    });
}
