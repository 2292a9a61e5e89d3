//! Panels beside the picture. A panel edits keys of the document through the [`Session`] that all share.
//!
//! A further panel is a type with [`Panel`] and an entry in [`all`].

mod clip;
mod compare;
mod functions;
mod handle;
pub mod keys;
mod looks;
mod nodes;
mod objects;
mod paint;
mod slices;

use crate::session::Session;
use eframe::egui::{Rect, Response, Ui, pos2};
use std::path::PathBuf;

/// A panel of the window.
pub trait Panel {
    /// The title of its tab.
    fn title(&self) -> &'static str;

    /// Shows the panel.
    fn ui(&mut self, ui: &mut Ui, session: &mut Session);

    /// Whether something that it shows is still to come.
    fn is_busy(&self) -> bool {
        false
    }

    /// Paints handles over the picture and follows drags of them. Returns whether the pointer is on one of them; the
    /// picture then does not turn.
    fn over_picture(&mut self, ui: &mut Ui, picture: &PictureArea, session: &mut Session) -> bool {
        let _ = (ui, picture, session);
        false
    }
}

/// The picture in the window.
#[derive(Clone, Debug)]
pub struct PictureArea {
    /// Its rectangle in points of the window.
    pub rect: Rect,
    /// The size of the scene's picture in pixels.
    pub size: [usize; 2],
    /// The pointer on it.
    pub response: Response,
}

impl PictureArea {
    /// Returns the point of the picture, in the scene's pixels from its corner, at a place in the window.
    pub fn pixel(&self, at: eframe::egui::Pos2) -> [f64; 2] {
        let share = (at - self.rect.min) / self.rect.size();
        [f64::from(share.x) * self.size[0] as f64, f64::from(share.y) * self.size[1] as f64]
    }

    /// Returns the pixel of the scene's picture at a place in the window: column and row. None beside the picture.
    pub fn pixel_at(&self, at: eframe::egui::Pos2) -> Option<[usize; 2]> {
        let pixel = self.pixel(at);
        let inside = |axis: usize| (pixel[axis] as usize).min(self.size[axis].saturating_sub(1));
        self.rect.contains(at).then(|| [0, 1].map(inside))
    }

    /// Returns the place in the window of a point of the picture in the scene's pixels.
    pub fn place(&self, [x, y]: [f64; 2]) -> eframe::egui::Pos2 {
        let share = [x / self.size[0] as f64, y / self.size[1] as f64].map(|share| share as f32);
        pos2(self.rect.left() + share[0] * self.rect.width(), self.rect.top() + share[1] * self.rect.height())
    }

    /// Returns the scene's pixels in a point of the window.
    pub fn scale(&self) -> f64 {
        self.size[0] as f64 / f64::from(self.rect.width())
    }
}

/// Returns all panels, in the order of their tabs. `looks` is the folder of the user's own looks.
pub fn all(looks: Option<PathBuf>) -> Vec<Box<dyn Panel>> {
    vec![
        Box::new(functions::FunctionsPanel::default()),
        Box::new(looks::LooksPanel::new(looks)),
        Box::new(clip::ClipPanel),
        Box::new(objects::ObjectsPanel::default()),
        Box::new(slices::SlicesPanel::default()),
        Box::new(keys::KeysPanel::default()),
        Box::new(compare::ComparePanel::default()),
    ]
}
