//! The window: menus, the picture with panels beside it, a status line, and the work of the commands.

mod bars;
mod layout;
mod screenshot;
mod work;

use crate::commands::{Action, COMMANDS, Command};
use crate::dialogs::{Dialogs, Wish};
use crate::document::Document;
use crate::export::{Export, Outcome};
use crate::frames::Worker;
use crate::open;
use crate::palette::Palette;
use crate::panels::{self, Panel};
use crate::probe::Prober;
use crate::screen::Screen;
use crate::session::Session;
use crate::state::State;
use drypoint::gpu::{Gpu, wgpu};
use eframe::egui::{self, CentralPanel, Context, Ui, ViewportCommand};
use eframe::egui_wgpu::RenderState;
use egui_tiles::{Tile, Tree};
use layout::{Layout, Pane};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Time between looks at the file, and between keeping texts that are not saved.
const LOOK: Duration = Duration::from_secs(1);

/// Pause after which a further change is undone by itself.
const PAUSE: Duration = Duration::from_millis(700);

/// The adapter or the library that draws the frames.
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
    /// The name of the next view to be saved.
    view_name: String,
    /// Commands that were given while a stroke was painted. They follow it.
    deferred: Vec<Action>,
    is_asking_to_close: bool,
    may_close: bool,
    looked: Instant,
    /// The revision whose text was kept.
    kept: u64,
    /// The revision of the last change, and its time.
    changed: (u64, Instant),
    /// A file for a picture of the window, once the frame is exact.
    screenshot: Option<PathBuf>,
}

impl Viewer {
    /// A window over a document. The device of `render` is shared with the thread that draws. It has the features of
    /// [`Gpu::descriptor`].
    pub fn new(ctx: &Context, render: Option<RenderState>, backend: Backend, document: Document, state: State) -> Self {
        let [drawing, comparing] =
            [backend, Backend::Card].map(|backend| render.as_ref().and_then(|render| card(render, backend)));
        let ctx_of_threads = ctx.clone();
        let wake = move || ctx_of_threads.request_repaint();
        let (worker, prober) = (Worker::new(drawing, wake.clone()), Prober::new(Box::new(wake)));
        let panels = panels::all(state.looks());
        let tree = layout::tree(panels.len());
        let session = Session::new(document, Screen::new(render), comparing, worker, prober);
        let mut viewer = Self {
            session,
            panels,
            tree,
            state,
            dialogs: Dialogs::default(),
            palette: Palette::default(),
            export: None,
            recovered: None,
            view_name: String::new(),
            deferred: Vec::new(),
            is_asking_to_close: false,
            may_close: false,
            looked: Instant::now(),
            kept: 0,
            changed: (0, Instant::now()),
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

    /// Opens the panel with a title.
    pub fn open_panel(&mut self, title: &str) {
        let panels = &self.panels;
        let has_title = |i: &usize| panels.get(*i).is_some_and(|panel| panel.title().eq_ignore_ascii_case(title));
        self.tree.make_active(|_, tile| matches!(tile, Tile::Pane(Pane::Panel(i)) if has_title(i)));
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

    /// Looks for the text of an earlier session. Commands that wait were given for another document.
    fn opened(&mut self) {
        self.deferred.clear();
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
        let deferred = std::mem::take(&mut self.deferred);
        for action in deferred.into_iter().chain(actions) {
            self.run(&ctx, action);
        }
        self.seal(&ctx);
        self.session.update(&ctx);
    }

    /// Ends the group of changes that are undone together: when a button is released, and after a pause without one.
    fn seal(&mut self, ctx: &Context) {
        let revision = self.session.document.revision();
        if self.changed.0 != revision {
            self.changed = (revision, Instant::now());
        }
        let (is_released, is_down) = ctx.input(|input| (input.pointer.any_released(), input.pointer.any_down()));
        let is_over = is_released || !is_down && self.changed.1.elapsed() > PAUSE;
        if is_over && !self.session.is_stroke_open {
            self.session.document.seal();
        }
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

    /// Writes the picture of the window once the frame is exact and panels show all, and closes the window.
    fn screenshot(&mut self, ctx: &Context) {
        let is_settled = self.session.is_settled() && !self.panels.iter().any(|panel| panel.is_busy());
        if let Some(path) = self.screenshot.take_if(|_| is_settled) {
            let window = ctx.clone();
            ctx.request_screenshot(move |image| {
                if let Err(failure) = screenshot::write_image(&image, &path) {
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
}

/// Returns the card of a window's device, if a back end draws with it. OpenGL lacks what the shaders need.
fn card(render: &RenderState, backend: Backend) -> Option<Gpu> {
    let info = render.adapter.get_info();
    let is_there = info.backend != wgpu::Backend::Gl && backend != Backend::Reference;
    let gpu = is_there.then(|| Gpu::of(info, render.device.clone(), render.queue.clone()));
    gpu.filter(|gpu| backend == Backend::Card || !gpu.is_software())
}
