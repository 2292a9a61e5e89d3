//! The window: menus, the picture with panels beside it, a status line, and the work of the commands.

use crate::camera::Side;
use crate::commands::{Action, COMMANDS, Command, MENUS};
use crate::dialogs::{Dialogs, Wish};
use crate::document::{Document, Edit};
use crate::export::{Export, Outcome};
use crate::frames::Worker;
use crate::open;
use crate::palette::Palette;
use crate::panels::{self, Panel};
use crate::picture::picture;
use crate::screen::Screen;
use crate::session::Session;
use crate::state::State;
use drypoint::Failure;
use drypoint::gpu::Gpu;
use drypoint::output::png::write_png;
use drypoint::scene::color::srgb_to_linear;
use drypoint::scene::picture::{Layer, LayerKind, Picture, Provenance};
use drypoint::scene::tables::Projection;
use eframe::egui::{self, Align2, CentralPanel, Context, RichText, Ui, ViewportCommand};
use eframe::egui_wgpu::RenderState;
use egui_tiles::{Tile, TileId, Tiles, Tree};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Radians of a turn by a key.
const TURN: f64 = std::f64::consts::PI / 36.0;

/// Factor of a distance by a key.
const STEP: f64 = 1.1;

/// Time between looks at the file, and between keeping texts that are not saved.
const LOOK: Duration = Duration::from_secs(1);

/// A pane of the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Pane {
    Picture,
    /// The panel of an index.
    Panel(usize),
}

/// What draws the frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Backend {
    /// The card, unless it is software, which is many times slower than the reference.
    #[default]
    Auto,
    /// The card, or the software that stands for one.
    Card,
    /// The reference.
    Reference,
}

/// The window's state.
pub struct Viewer {
    /// The document with all that is shown of it.
    pub session: Session,
    panels: Vec<Box<dyn Panel>>,
    tree: Tree<Pane>,
    state: State,
    dialogs: Dialogs,
    palette: Palette,
    export: Option<Export>,
    /// The text of an earlier session that was not saved, until the user decides on it.
    recovered: Option<String>,
    is_asking_to_close: bool,
    may_close: bool,
    looked: Instant,
    /// The revision whose text was kept.
    kept: u64,
    /// A file for a picture of the window, once the frame is exact.
    screenshot: Option<PathBuf>,
}

impl Viewer {
    /// A window over a document. The device of `render` is shared with the thread that draws. It has the features of
    /// [`Gpu::descriptor`].
    pub fn new(ctx: &Context, render: Option<RenderState>, backend: Backend, document: Document, state: State) -> Self {
        let card = render
            .as_ref()
            .map(|render| Gpu::of(render.adapter.get_info(), render.device.clone(), render.queue.clone()))
            .filter(|gpu| backend == Backend::Card || backend == Backend::Auto && !gpu.is_software());
        let waker = ctx.clone();
        let worker = Worker::new(card, Box::new(move || waker.request_repaint()));
        let panels = panels::all();
        let tree = tree(panels.len());
        let session = Session::new(document, Screen::new(render), worker);
        let mut viewer = Self {
            session,
            panels,
            tree,
            state,
            dialogs: Dialogs::default(),
            palette: Palette::default(),
            export: None,
            recovered: None,
            is_asking_to_close: false,
            may_close: false,
            looked: Instant::now(),
            kept: 0,
            screenshot: None,
        };
        viewer.look(ctx);
        viewer.opened();
        viewer
    }

    /// Writes a picture of the window to a PNG file once the frame is exact, and closes the window.
    pub fn take_screenshot(&mut self, path: PathBuf) {
        self.screenshot = Some(path);
    }

    /// Opens a scene or a volume in place of the document.
    pub fn open(&mut self, path: &Path) {
        match open::open(path) {
            Ok(document) => {
                self.state.opened(path);
                self.session.take(document);
                self.opened();
            }
            Err(failures) => failures.iter().take(1).for_each(|failure| self.session.report(failure)),
        }
    }

    /// Looks for the text of an earlier session.
    fn opened(&mut self) {
        let document = &self.session.document;
        self.recovered = self.state.unsaved(document.path(), document.text());
        self.kept = document.revision();
    }

    /// Applies the look of the window.
    fn look(&self, ctx: &Context) {
        ctx.set_theme(if self.state.is_dark { egui::Theme::Dark } else { egui::Theme::Light });
        ctx.set_zoom_factor(self.state.scale);
        ctx.options_mut(|options| options.zoom_with_keyboard = false);
    }

    /// Shows the window, and does what the user asks for.
    pub fn ui(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        self.follow(&ctx);
        let mut actions = self.keys(&ctx);
        egui::Panel::top("menus").show(ui, |ui| actions.extend(self.menus(ui)));
        egui::Panel::bottom("status").show(ui, |ui| self.status(ui));
        self.banners(ui);
        CentralPanel::no_frame().show(ui, |ui| {
            let mut behavior = Layout { session: &mut self.session, panels: &mut self.panels };
            self.tree.ui(&mut behavior, ui);
        });
        actions.extend(self.palette.ui(&ctx, &mut |wish, path| self.dialogs.put(wish, path)));
        self.ask_to_close(&ctx);
        for action in actions {
            self.run(&ctx, action);
        }
        // What is changed in this pass is drawn at once, and the end of a drag ends its group.
        if ctx.input(|input| input.pointer.any_released() || input.keys_down.is_empty() && !input.pointer.any_down()) {
            self.session.document.seal();
        }
        self.session.update(&ctx);
    }

    /// Takes what came from outside: answers of dialogs, files, and the end of an export.
    fn follow(&mut self, ctx: &Context) {
        self.session.update(ctx);
        while let Some((wish, path)) = self.dialogs.answer() {
            match wish {
                Wish::Open => self.open(&path),
                Wish::SaveAs => self.save_as(&path),
                Wish::Export => self.start_export(ctx, path),
            }
        }
        let dropped = ctx.input(|input| input.raw.dropped_files.first().map(|file| file.path().to_owned()));
        if let Some(path) = dropped {
            self.open(&path);
        }
        if let Some(end) = self.export.as_ref().and_then(Export::end) {
            let path = self.export.take().map(|export| export.path().to_owned()).unwrap_or_default();
            match end {
                Ok(Outcome::Written) => self.session.notice = format!("Exported {}", path.display()),
                Ok(Outcome::Stopped) => self.session.notice = "The export was cancelled".into(),
                Err(failures) => failures.iter().take(1).for_each(|failure| self.session.report(failure)),
            }
        }
        self.screenshot(ctx);
        if self.looked.elapsed() >= LOOK {
            self.looked = Instant::now();
            match self.session.document.follow_file() {
                Ok(true) => self.session.notice = "The file was changed by another program and is read anew".into(),
                Ok(false) => {}
                Err(failure) => self.session.report(&failure),
            }
            self.keep();
        }
        ctx.request_repaint_after(LOOK);
    }

    /// Writes the picture of the window once the frame is exact, and closes the window.
    fn screenshot(&mut self, ctx: &Context) {
        if let Some(path) = self.screenshot.take_if(|_| self.session.is_settled()) {
            let window = ctx.clone();
            ctx.request_screenshot(move |image| {
                if let Err(failure) = write_image(&image, &path) {
                    eprintln!("{failure}");
                }
                window.send_viewport_cmd(ViewportCommand::Close);
            });
        }
    }

    /// Keeps the text while it is not saved, and forgets it once it is.
    fn keep(&mut self) {
        let document = &self.session.document;
        if self.recovered.is_none() && self.kept != document.revision() {
            self.kept = document.revision();
            match document.is_changed() {
                true => self.state.keep_unsaved(document.path(), document.text()),
                false => self.state.forget_unsaved(document.path()),
            }
        }
    }

    /// Returns the commands whose keys were pressed. Keys without modifiers belong to text fields while one is edited.
    fn keys(&self, ctx: &Context) -> Vec<Action> {
        let is_typing = ctx.memory(|memory| memory.focused().is_some());
        let pressed = |command: &&Command| {
            let keys = command.keys.filter(|keys| !is_typing || keys.modifiers.any());
            keys.is_some_and(|keys| ctx.input_mut(|input| input.consume_shortcut(&keys)))
        };
        COMMANDS.iter().filter(pressed).map(|command| command.action).collect()
    }

    fn menus(&mut self, ui: &mut Ui) -> Vec<Action> {
        let mut actions = Vec::new();
        egui::MenuBar::new().ui(ui, |ui| {
            for menu in MENUS {
                ui.menu_button(menu, |ui| {
                    for command in COMMANDS.iter().filter(|command| command.menu == menu) {
                        let keys = command.keys.map(|keys| ui.ctx().format_shortcut(&keys)).unwrap_or_default();
                        let button = egui::Button::new(command.name).shortcut_text(keys);
                        if ui.add_enabled(self.is_possible(command.action), button).clicked() {
                            actions.push(command.action);
                            ui.close();
                        }
                    }
                    if menu == "File" {
                        self.recent(ui);
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

    fn is_possible(&self, action: Action) -> bool {
        match action {
            Action::Undo => self.session.document.history().next_undo().is_some(),
            Action::Redo => self.session.document.history().next_redo().is_some(),
            Action::Export => self.session.scene.is_some() && self.export.is_none(),
            Action::Copy => self.session.shown.is_some(),
            _ => true,
        }
    }

    /// The line at the bottom: the document, the frame, and what was said last.
    fn status(&mut self, ui: &mut Ui) {
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
                    egui::Label::new(RichText::new(format!("⚠ {warning}")).color(ui.visuals().warn_fg_color))
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

    /// What asks for attention above the picture: faults of the scene, and a text of an earlier session.
    fn banners(&mut self, ui: &mut Ui) {
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
                    self.session.document.undo();
                }
            });
        }
    }

    /// Asks what to do with changes that are not saved before the window is closed.
    fn ask_to_close(&mut self, ctx: &Context) {
        if ctx.input(|input| input.viewport().close_requested())
            && self.session.document.is_changed()
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

    /// Does the work of a command.
    pub fn run(&mut self, ctx: &Context, action: Action) {
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
            Action::Quit => ctx.send_viewport_cmd(ViewportCommand::Close),
            Action::Undo => drop(session.document.undo()),
            Action::Redo => drop(session.document.redo()),
            Action::Look(side) => self.look_from(side),
            Action::Whole => {
                let forward = session.pose().map(|pose| pose.look([pose.view.forward, pose.up]));
                if let (Some(pose), Some(scene)) = (forward, session.scene.clone()) {
                    let whole = drypoint::scene::tables::Camera { eye: None, target: None, ..scene.camera.clone() };
                    let mut edits = pose.edits(&whole, &pose);
                    edits.extend(["camera.eye", "camera.target", "camera.height"].map(Edit::remove));
                    session.edit("show the whole volume", edits);
                }
            }
            Action::Turn(right, up) => {
                let [yaw, pitch] = [right, up].map(|steps| f64::from(steps) * TURN);
                session.move_camera("turn the view", |pose| pose.orbit(yaw, -pitch));
                session.document.seal();
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
                session.edit("change the projection", edits);
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
            Action::Panels => self.tree = tree(self.panels.len()),
        }
    }

    fn look_from(&mut self, side: Side) {
        let anatomy = self.session.data.as_ref().and_then(|data| data.volume.anatomy());
        self.session.move_camera("look from a side", |pose| pose.look(side.directions(anatomy)));
    }

    fn save(&mut self) {
        match self.session.document.save() {
            Ok(()) => self.saved(),
            Err(failure) => self.session.report(&failure),
        }
    }

    fn save_as(&mut self, path: &Path) {
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

/// Writes pixels of the window as a PNG file.
fn write_image(image: &egui::ColorImage, path: &Path) -> Result<(), Failure> {
    let [width, height] = image.size;
    let channel = |c: usize| image.pixels.iter().map(move |pixel| pixel.to_array()[c]);
    let linear = |c: usize| channel(c).map(|code| srgb_to_linear(f64::from(code) / 255.0)).collect();
    let channels = vec![linear(0), linear(1), linear(2), vec![1.0; width * height]];
    let picture = Picture { width, height, layers: vec![Layer { kind: LayerKind::Beauty, channels }] };
    write_png(&picture, 8, &Provenance::default(), path).map_err(|error| Failure::picture(&error, path.display()))
}

/// The first arrangement: the picture, and the panels as tabs beside it.
fn tree(panels: usize) -> Tree<Pane> {
    let mut tiles = Tiles::default();
    let picture = tiles.insert_pane(Pane::Picture);
    let tabs = (0..panels).map(|i| tiles.insert_pane(Pane::Panel(i))).collect();
    let tabs = tiles.insert_tab_tile(tabs);
    let root = tiles.insert_horizontal_tile(vec![picture, tabs]);
    if let Some(Tile::Container(egui_tiles::Container::Linear(linear))) = tiles.get_mut(root) {
        linear.shares.set_share(picture, 0.68);
        linear.shares.set_share(tabs, 0.32);
    }
    Tree::new(egui::Id::unique("panes"), root, tiles)
}

/// The panes as the tree asks for them.
struct Layout<'v> {
    session: &'v mut Session,
    panels: &'v mut Vec<Box<dyn Panel>>,
}

impl egui_tiles::Behavior<Pane> for Layout<'_> {
    fn pane_ui(&mut self, ui: &mut Ui, _: TileId, pane: &mut Pane) -> egui_tiles::UiResponse {
        match *pane {
            Pane::Picture => picture(ui, self.session, self.panels),
            Pane::Panel(i) => {
                if let Some(panel) = self.panels.get_mut(i) {
                    ui.painter().rect_filled(ui.max_rect(), 0.0, ui.visuals().panel_fill);
                    egui::Frame::new().inner_margin(8).show(ui, |ui| panel.ui(ui, self.session));
                }
            }
        }
        egui_tiles::UiResponse::None
    }

    fn tab_title_for_pane(&mut self, pane: &Pane) -> egui::WidgetText {
        match *pane {
            Pane::Picture => "Picture".into(),
            Pane::Panel(i) => self.panels.get(i).map_or("", |panel| panel.title()).into(),
        }
    }

    fn simplification_options(&self) -> egui_tiles::SimplificationOptions {
        egui_tiles::SimplificationOptions { all_panes_must_have_tabs: false, ..Default::default() }
    }
}
