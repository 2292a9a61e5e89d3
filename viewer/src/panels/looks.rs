//! Looks with pictures of the volume: a click draws the scene so, and the look of the scene can be kept.

use super::Panel;
use crate::background::Background;
use crate::canvas::Pixels;
use crate::looks::{self, Look, LookPicture, LooksQuery, painter};
use crate::session::Session;
use crate::widgets::named;
use drypoint::scene::volume::Volume;
use eframe::egui::{self, ColorImage, Image, RichText, ScrollArea, TextureHandle, TextureOptions, Ui, Vec2};
use std::path::PathBuf;
use std::sync::Arc;

/// Points of the window across a picture.
const SIDE: f32 = 112.0;

/// Points of the window between pictures.
const GAP: f32 = 10.0;

/// Pictures are shown smaller than they are.
const REDUCED: TextureOptions =
    TextureOptions { mipmap_mode: Some(egui::TextureFilter::Linear), ..TextureOptions::LINEAR };

/// The panel of looks.
pub(super) struct LooksPanel {
    /// The folder of own looks.
    folder: Option<PathBuf>,
    looks: Vec<Look>,
    /// The picture of each look, or the reason why there is none.
    pictures: Vec<Option<Result<TextureHandle, String>>>,
    /// The thread, once the panel was open.
    painter: Option<Background<LooksQuery, LookPicture>>,
    /// The number of the last question, and the document and volume that it was about.
    asked: (u64, Option<(u64, Arc<Volume>)>),
    /// The name of the next look to be kept.
    name: String,
}

impl LooksPanel {
    pub(super) fn new(folder: Option<PathBuf>) -> Self {
        Self { folder, looks: Vec::new(), pictures: Vec::new(), painter: None, asked: (0, None), name: String::new() }
    }
}

impl Panel for LooksPanel {
    fn title(&self) -> &'static str {
        "Looks"
    }

    fn is_busy(&self) -> bool {
        self.asked.1.is_some() && self.pictures.iter().any(Option::is_none)
    }

    fn ui(&mut self, ui: &mut Ui, session: &mut Session) {
        self.follow(ui, session);
        ui.horizontal(|ui| {
            let field = egui::TextEdit::singleline(&mut self.name).hint_text("name").desired_width(120.0);
            named(&ui.add(field), "Name of the look");
            let can_keep = !self.name.trim().is_empty() && self.folder.is_some();
            if ui.add_enabled(can_keep, egui::Button::new("Keep this look")).clicked()
                && let Some(folder) = &self.folder
            {
                match looks::keep(&session.document, folder, &self.name) {
                    Ok(()) => self.name.clear(),
                    Err(error) => session.notice = error,
                }
                self.asked.1 = None;
            }
            if ui.button("Draw anew").on_hover_text("Draws the looks from this side.").clicked() {
                self.asked.1 = None;
            }
        });
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            let columns = ((ui.available_width() / (SIDE + GAP)) as usize).max(1);
            let mut forgotten = None;
            egui::Grid::new("looks").spacing([GAP, GAP]).show(ui, |ui| {
                for (i, (look, picture)) in self.looks.iter().zip(&self.pictures).enumerate() {
                    if item(ui, session, look, picture.as_ref()) {
                        forgotten = look.file.clone();
                    }
                    if (i + 1) % columns == 0 {
                        ui.end_row();
                    }
                }
            });
            if let Some(file) = forgotten {
                if let Err(error) = std::fs::remove_file(&file) {
                    session.notice = format!("{}: {error}", file.display());
                }
                self.asked.1 = None;
            }
        });
    }
}

impl LooksPanel {
    /// Asks for the pictures of another volume, and takes those that have come.
    fn follow(&mut self, ui: &Ui, session: &Session) {
        let (Some(data), None) = (session.data(), &session.failures) else {
            // The looks are drawn once the scene can be.
            if self.asked.1.as_ref().is_some_and(|asked| asked.0 != session.document_number()) {
                self.asked.1 = None;
                self.pictures.fill(None);
            }
            return;
        };
        let about = (session.document_number(), Arc::clone(&data.volume));
        let is_same = |asked: &(u64, Arc<Volume>)| asked.0 == about.0 && Arc::ptr_eq(&asked.1, &about.1);
        let painter = self.painter.get_or_insert_with(|| {
            let ctx = ui.ctx().clone();
            painter(Box::new(move || ctx.request_repaint()))
        });
        if !self.asked.1.as_ref().is_some_and(is_same) {
            self.looks = looks::all(self.folder.as_deref());
            self.pictures = vec![None; self.looks.len()];
            self.asked = (self.asked.0 + 1, Some(about));
            let scene = (session.document.text().to_owned(), session.document.path().to_owned());
            let looks = self.looks.clone();
            painter.ask(LooksQuery { number: self.asked.0, scene, volume: Arc::clone(&data.volume), looks });
        }
        for (number, i, drawn) in painter.answers() {
            let Some(picture) = self.pictures.get_mut(i).filter(|_| number == self.asked.0) else { continue };
            *picture = match drawn {
                Ok(frame) => match frame.pixels {
                    Pixels::Bytes(bytes) => {
                        let image = ColorImage::from_rgba_unmultiplied(frame.size, &bytes);
                        Some(Ok(ui.ctx().load_texture(format!("look {i}"), image, REDUCED)))
                    }
                    Pixels::Texture(_) => None,
                },
                Err(failures) => Some(Err(failures.to_string())),
            };
        }
    }
}

/// Shows a look, which takes the place of the scene's if it is clicked. Returns whether it is to be forgotten.
fn item(ui: &mut Ui, session: &mut Session, look: &Look, picture: Option<&Result<TextureHandle, String>>) -> bool {
    let mut is_forgotten = false;
    ui.vertical(|ui| {
        ui.set_width(SIDE);
        let button = match picture {
            Some(Ok(texture)) => {
                let size = texture.size_vec2();
                let image = Image::new((texture.id(), size * (SIDE / size.max_elem())));
                egui::Button::image(image.corner_radius(3.0).alt_text(format!("the look {}", look.name)))
            }
            Some(Err(_)) => egui::Button::new("cannot be drawn"),
            None => egui::Button::new("…"),
        };
        let doc = match picture {
            Some(Err(error)) => error,
            _ => &look.doc,
        };
        let can_draw = !matches!(picture, Some(Err(_)));
        let response = ui
            .add_enabled(can_draw, button.frame(false).min_size(Vec2::new(SIDE, SIDE * 0.75)))
            .on_hover_text(doc)
            .on_disabled_hover_text(doc);
        if response.clicked()
            && let Some(text) = looks::applied(session.document.text(), &look.text)
        {
            session.document.replace(&format!("the look {}", look.name), text);
            session.document.seal();
        }
        ui.horizontal(|ui| {
            ui.label(RichText::new(&look.name).small());
            if look.file.is_some() && ui.small_button("×").on_hover_text(format!("Forget {}", look.name)).clicked() {
                is_forgotten = true;
            }
        });
    });
    is_forgotten
}
