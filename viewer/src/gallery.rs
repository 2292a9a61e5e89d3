//! Styles as lit spheres, for the places where one is chosen.

use drypoint::output::png::rgba_codes;
use drypoint::reference::style_transfer_functions::preview;
use drypoint::scene::source::Disk;
use drypoint::scene::style::Theme;
use drypoint::scene::tables::StyleSource;
use eframe::egui::{self, Color32, ColorImage, Image, Response, TextureHandle, TextureOptions, Ui, Vec2};
use std::collections::BTreeMap;

/// Pixels across a sphere.
const SIDE: usize = 64;

/// The styles of a theme with their spheres, which are drawn when they are first shown.
#[derive(Default)]
pub struct Gallery {
    theme: Option<Theme>,
    source: Option<StyleSource>,
    spheres: BTreeMap<String, Option<(TextureHandle, Color32)>>,
}

impl Gallery {
    /// Opens a theme, if it is not open. Without one that can be opened the gallery is empty.
    pub fn open(&mut self, source: &StyleSource) {
        if self.source.as_ref() != Some(source) {
            let theme = Theme::open(&Disk, source).ok();
            *self = Self { theme, source: Some(source.clone()), spheres: BTreeMap::new() };
        }
    }

    /// Returns the names of the styles.
    pub fn names(&self) -> Vec<String> {
        self.theme.iter().flat_map(Theme::names).map(str::to_owned).collect()
    }

    /// Returns the sphere of a style and the colour of its middle.
    pub fn sphere(&mut self, ctx: &egui::Context, name: &str) -> Option<(TextureHandle, Color32)> {
        if !self.spheres.contains_key(name) {
            let drawn = self.draw(ctx, name);
            self.spheres.insert(name.to_owned(), drawn);
        }
        self.spheres.get(name)?.clone()
    }

    fn draw(&self, ctx: &egui::Context, name: &str) -> Option<(TextureHandle, Color32)> {
        let style = self.theme.as_ref()?.style(&Disk, name)?.ok()?;
        let bytes = rgba_codes(&preview(&style, SIDE), 8).ok()?;
        let mut image = ColorImage::from_rgba_unmultiplied([SIDE; 2], &bytes);
        // Outside the disc the window is seen.
        for (i, pixel) in image.pixels.iter_mut().enumerate() {
            let [x, y] = [i % SIDE, i / SIDE].map(|n| n as f32 + 0.5 - SIDE as f32 / 2.0);
            if x.hypot(y) > SIDE as f32 / 2.0 {
                *pixel = Color32::TRANSPARENT;
            }
        }
        let middle = image.pixels[SIDE * SIDE / 2 + SIDE / 2];
        Some((ctx.load_texture(format!("style {name}"), image, TextureOptions::LINEAR), middle))
    }

    /// Shows a button with the sphere of a style that opens the gallery. Returns the style that was chosen.
    pub fn button(&mut self, ui: &mut Ui, chosen: &str) -> Option<String> {
        let sphere = self.image(ui, chosen, 18.0);
        let text = if chosen.is_empty() { "style…" } else { chosen };
        let mut picked = None;
        let mut pick = |ui: &mut Ui, gallery: &mut Self| {
            egui::Grid::new("styles").spacing([4.0, 4.0]).show(ui, |ui| {
                for (i, name) in gallery.names().into_iter().enumerate() {
                    if i > 0 && i % 5 == 0 {
                        ui.end_row();
                    }
                    if gallery.item(ui, &name, name == chosen).clicked() {
                        picked = Some(name);
                        ui.close();
                    }
                }
            });
        };
        match sphere {
            Some(sphere) => ui.menu_image_text_button(sphere, text, |ui| pick(ui, self)),
            None => ui.menu_button(text, |ui| pick(ui, self)),
        };
        picked
    }

    /// Shows a style of the gallery: its sphere over its name.
    fn item(&mut self, ui: &mut Ui, name: &str, is_chosen: bool) -> Response {
        let sphere = self.image(ui, name, 40.0);
        ui.vertical_centered(|ui| {
            ui.set_width(62.0);
            let button = match sphere {
                Some(sphere) => egui::Button::image(sphere),
                None => egui::Button::new("?"),
            };
            let response = ui.add(button.selected(is_chosen).min_size(Vec2::splat(44.0))).on_hover_text(name);
            ui.small(name);
            response
        })
        .inner
    }

    fn image(&mut self, ui: &Ui, name: &str, side: f32) -> Option<Image<'static>> {
        let (texture, _) = self.sphere(ui.ctx(), name)?;
        Some(Image::new((texture.id(), Vec2::splat(side))).alt_text(format!("the style {name}")))
    }
}
