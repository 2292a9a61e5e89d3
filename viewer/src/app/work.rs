//! The work of the commands.

use super::{Viewer, layout};
use crate::camera::Side;
use crate::commands::Action;
use crate::document::Edit;
use crate::export::Export;
use crate::focus::focus;
use crate::open;
use drypoint::scene::tables::{Camera, Projection};
use eframe::egui::{Context, ViewportCommand};
use std::path::{Path, PathBuf};

/// Radians of a turn by a key.
const TURN: f64 = std::f64::consts::PI / 36.0;

/// Factor of a distance by a key.
const STEP: f64 = 1.1;

impl Viewer {
    /// Does the work of a command, once no dab of a stroke is still to come: a stroke is undone and saved as a whole.
    pub fn run(&mut self, ctx: &Context, action: Action) {
        if self.session.is_stroke_open {
            self.deferred.push(action);
            return;
        }
        let session = &mut self.session;
        match action {
            Action::Open => self.dialogs.open(),
            Action::Example => {
                session.take(open::example());
                self.opened();
            }
            Action::Save if session.document.is_untitled() => self.dialogs.save_as(session.document.path()),
            Action::Save => self.save(),
            Action::SaveAs => self.dialogs.save_as(session.document.path()),
            Action::Export => self.dialogs.export(session.document.path()),
            Action::Copy => session.image().into_iter().for_each(|image| ctx.copy_image(image)),
            Action::FocusHalos => match (session.cross, &session.scene, session.data()) {
                (Some(at), Some(scene), Some(data)) => {
                    let edits = focus(scene, data.volume.grid(), at);
                    session.edit("focus the halos", edits);
                }
                _ => session.notice = "A click in the picture tells where the focus is".into(),
            },
            Action::Paint => session.is_painting = !session.is_painting,
            Action::RemoveCross => session.cross = None,
            Action::Quit => ctx.send_viewport_cmd(ViewportCommand::Close),
            Action::Undo => drop(session.document.undo()),
            Action::Redo => drop(session.document.redo()),
            Action::Look(side) => self.look_from(side),
            Action::Whole => {
                if let (Some(pose), Some(scene)) = (session.pose(), session.scene.clone()) {
                    let whole = Camera { eye: None, target: None, ..scene.camera.clone() };
                    let mut edits = pose.edits(&whole, &pose);
                    edits.extend(["camera.eye", "camera.target", "camera.height"].map(Edit::remove));
                    session.edit_camera("show the whole volume", edits);
                }
            }
            Action::Turn(right, up) => {
                let [yaw, pitch] = [right, up].map(|steps| f64::from(steps) * TURN);
                session.move_camera("turn the view", |pose| pose.orbit(yaw, -pitch));
            }
            Action::Dolly(steps) => {
                let factor = STEP.powi(i32::from(steps));
                session.move_camera("scale the view", |pose| {
                    let middle = pose.view.size.map(|side| side as f64 / 2.0);
                    pose.dolly(factor, middle)
                });
            }
            Action::Projection => {
                let is_parallel = session
                    .scene
                    .as_ref()
                    .is_some_and(|scene| matches!(scene.camera.projection, Projection::Orthographic { .. }));
                let (name, other) = if is_parallel { ("perspective", "height") } else { ("orthographic", "fov") };
                let edits =
                    vec![Edit::set("camera.projection", name), Edit::remove(format!("camera.{other}").as_str())];
                session.edit_camera("change the projection", edits);
            }
            Action::Theme => {
                self.state.is_dark = !self.state.is_dark;
                self.look(ctx);
                self.state.write();
            }
            Action::Scale(steps) => {
                self.state.scale = (self.state.scale * 1.1f32.powi(i32::from(steps))).clamp(0.5, 3.0);
                self.look(ctx);
                self.state.write();
            }
            Action::Palette => self.palette.open(),
            Action::Panels => self.tree = layout::tree(self.panels.len()),
        }
    }

    fn look_from(&mut self, side: Side) {
        let anatomy = self.session.data().and_then(|data| data.volume.anatomy());
        self.session.move_camera("look from a side", |pose| pose.look(side.directions(anatomy)));
    }

    fn save(&mut self) {
        match self.session.document.save() {
            Ok(()) => self.saved(),
            Err(failure) => self.session.report(&failure),
        }
    }

    pub(super) fn save_as(&mut self, path: &Path) {
        let before = self.session.document.path().to_owned();
        match self.session.document.save_as(path) {
            Ok(()) => {
                self.state.forget_unsaved(&before);
                self.saved();
            }
            Err(failure) => self.session.report(&failure),
        }
    }

    fn saved(&mut self) {
        let path = self.session.document.path().to_owned();
        self.session.notice = format!("Saved {}", path.display());
        self.state.forget_unsaved(&path);
        self.state.opened(&path);
        self.kept = self.session.document.revision();
    }

    /// Starts to render the scene into a file.
    pub fn start_export(&mut self, ctx: &Context, path: PathBuf) {
        match self.session.document.scene() {
            Ok(scene) => {
                let waker = ctx.clone();
                self.export = Some(Export::start(scene, path, Box::new(move || waker.request_repaint())));
            }
            Err(failures) => self.session.failures = Some(failures),
        }
    }
}
