//! The bars around the panes: menus, the status line, and what asks for attention.

use super::Viewer;
use crate::commands::{Action, COMMANDS, MENUS};
use crate::views::SavedView;
use eframe::egui::containers::menu::{MenuButton, MenuConfig};
use eframe::egui::{self, Align2, Context, PopupCloseBehavior, RichText, Ui, ViewportCommand};

impl Viewer {
    pub(super) fn menus(&mut self, ui: &mut Ui) -> Vec<Action> {
        let mut actions = Vec::new();
        egui::MenuBar::new().ui(ui, |ui| {
            for menu in MENUS {
                // Buttons close their menu themselves, so that a text can be typed in one.
                let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
                MenuButton::new(menu).config(config).ui(ui, |ui| {
                    for command in COMMANDS.iter().filter(|command| command.menu == menu) {
                        let keys = command.keys.map(|keys| ui.ctx().format_shortcut(&keys)).unwrap_or_default();
                        let button = egui::Button::new(command.name).shortcut_text(keys);
                        if ui.add_enabled(self.is_possible(command.action), button).clicked() {
                            actions.push(command.action);
                            ui.close();
                        }
                    }
                    match menu {
                        "File" => self.recent(ui),
                        "View" => self.saved_views(ui),
                        _ => {}
                    }
                });
            }
        });
        actions
    }

    fn recent(&mut self, ui: &mut Ui) {
        ui.separator();
        ui.weak("Recent");
        let mut chosen = None;
        for path in &self.state.recent {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            if ui.button(name).on_hover_text(path.display().to_string()).clicked() {
                chosen = Some(path.clone());
                ui.close();
            }
        }
        chosen.into_iter().for_each(|path| self.open(&path));
    }

    /// Saves the camera by a name, and lists those of this scene.
    fn saved_views(&mut self, ui: &mut Ui) {
        ui.separator();
        ui.weak("Saved views");
        ui.horizontal(|ui| {
            let field = egui::TextEdit::singleline(&mut self.view_name).hint_text("name").desired_width(120.0);
            crate::widgets::named(&ui.add(field), "Name of the view");
            let name = self.view_name.trim();
            if ui.add_enabled(!name.is_empty(), egui::Button::new("Save the view")).clicked() {
                let view = SavedView::of(&self.session.document, name);
                self.state.views.retain(|other| !other.replaces(&view));
                self.state.views.push(view);
                self.state.write();
                self.view_name.clear();
            }
        });
        let mut forgotten = None;
        for (i, view) in self.state.views.iter().enumerate() {
            if !view.is_of(&self.session.document) {
                continue;
            }
            ui.horizontal(|ui| {
                if ui.button(&view.name).clicked() {
                    let edits = view.edits(&self.session.document);
                    self.session.edit_camera("take a saved view", edits);
                    ui.close();
                }
                if ui.small_button("×").on_hover_text(format!("Forget {}", view.name)).clicked() {
                    forgotten = Some(i);
                }
            });
        }
        if let Some(i) = forgotten {
            self.state.views.remove(i);
            self.state.write();
        }
    }

    fn is_possible(&self, action: Action) -> bool {
        match action {
            Action::Undo => self.session.document.history().next_undo().is_some(),
            Action::Redo => self.session.document.history().next_redo().is_some(),
            Action::Export => self.session.scene.is_some() && self.export.is_none(),
            Action::FocusHalos => self.session.cross.is_some() && self.session.document.get(&"halo".into()).is_some(),
            Action::RemoveCross => self.session.cross.is_some(),
            Action::Copy => self.session.shown.is_some(),
            _ => true,
        }
    }

    /// The line at the bottom: the document, the frame, and what was said last.
    pub(super) fn status(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            let document = &self.session.document;
            let name = document.path().file_name().unwrap_or_default().to_string_lossy().into_owned();
            let mark = if document.is_changed() { "(changed)" } else { "" };
            ui.label(format!("{name} {mark}")).on_hover_text(document.path().display().to_string());
            ui.separator();
            if let Some(shown) = self.session.shown {
                let [width, height] = shown.size;
                let kind = if shown.is_coarse { "coarse" } else { "exact" };
                ui.label(format!("{width} × {height}, {kind}, {:.0} ms", shown.seconds * 1e3));
            }
            if let Some(export) = &self.export {
                ui.separator();
                ui.add(egui::ProgressBar::new(export.share() as f32).desired_width(120.0).show_percentage());
                if ui.small_button("Cancel the export").clicked() {
                    export.stop();
                }
            }
            if let Some(warning) = self.session.warnings.first() {
                ui.separator();
                let all = self.session.warnings.join("\n");
                ui.add(
                    egui::Label::new(RichText::new(format!("Warning: {warning}")).color(ui.visuals().warn_fg_color))
                        .truncate(),
                )
                .on_hover_text(all);
            }
            if !self.session.notice.is_empty() {
                ui.separator();
                ui.add(egui::Label::new(&self.session.notice).truncate()).on_hover_text(&self.session.notice);
            }
        });
    }

    /// Notices above the picture: faults of the scene, and a text of an earlier session.
    pub(super) fn banners(&mut self, ui: &mut Ui) {
        if let Some(text) = self.recovered.take() {
            let mut is_open = true;
            egui::Panel::top("recovered").show(ui, |ui| {
                ui.horizontal_wrapped(|ui| {
                    ui.label("Changes of an earlier window were not saved.");
                    if ui.button("Restore them").clicked() {
                        self.session.document.replace("restore", text.clone());
                        is_open = false;
                    }
                    if ui.button("Forget them").clicked() {
                        self.state.forget_unsaved(self.session.document.path());
                        is_open = false;
                    }
                });
            });
            self.recovered = is_open.then_some(text);
        }
        if let Some(failures) = self.session.failures.clone() {
            egui::Panel::top("faults").show(ui, |ui| {
                for failure in failures.iter().take(3) {
                    ui.label(RichText::new(&failure.what).color(ui.visuals().error_fg_color).strong());
                    ui.label(format!("{} — {}", failure.place, failure.remedy));
                }
                if ui.button("Undo the last change").clicked() {
                    self.run(ui.ctx(), Action::Undo);
                }
            });
        }
    }

    /// Asks what to do with changes that are not saved before the window is closed.
    pub(super) fn ask_to_close(&mut self, ctx: &Context) {
        if ctx.input(|input| input.viewport().close_requested())
            && (self.session.document.is_changed() || self.session.is_stroke_open)
            && !self.may_close
        {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.is_asking_to_close = true;
        }
        if !self.is_asking_to_close {
            return;
        }
        egui::Window::new("Save the changes?")
            .collapsible(false)
            .resizable(false)
            .anchor(Align2::CENTER_CENTER, [0.0; 2])
            .show(ctx, |ui| {
                ui.label(format!("{} was changed.", self.session.document.path().display()));
                ui.horizontal(|ui| {
                    if ui.button("Save").clicked() {
                        self.is_asking_to_close = false;
                        self.run(ctx, Action::Save);
                        if !self.session.document.is_changed() {
                            ctx.send_viewport_cmd(ViewportCommand::Close);
                        }
                    }
                    if ui.button("Close without saving").clicked() {
                        self.may_close = true;
                        self.state.forget_unsaved(self.session.document.path());
                        ctx.send_viewport_cmd(ViewportCommand::Close);
                    }
                    if ui.button("Cancel").clicked() {
                        self.is_asking_to_close = false;
                    }
                });
            });
    }
}
