//! Styles as lit spheres, for the places where one is chosen.

use drypoint::output::png::rgba_codes;
use drypoint::reference::style_transfer_functions::preview;
use drypoint::scene::source::Disk;
use drypoint::scene::style::Theme;
use drypoint::scene::tables::StyleSource;
use eframe::egui::{
    self, Color32, ColorImage, DragAndDrop, Id, Image, Rect, Sense, TextureHandle, TextureOptions, Ui, Vec2,
};
use std::collections::BTreeMap;

/// Pixels across a sphere.
const SIDE: usize = 64;

/// The name of a style that is dragged from the gallery.
pub struct DraggedStyle(pub String);

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

    /// Shows the spheres of all styles. They can be dragged to where a [`DraggedStyle`] is taken. Returns the style that was
    /// clicked.
    pub fn strip(&mut self, ui: &mut Ui, chosen: &str) -> Option<String> {
        let mut clicked = None;
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing = Vec2::splat(2.0);
            ui.spacing_mut().button_padding = Vec2::splat(2.0);
            for name in self.names() {
                let Some(sphere) = self.image(ui, &name, 26.0) else { continue };
                let button = egui::Button::image(sphere).frame_when_inactive(false).sense(Sense::click_and_drag());
                let response = ui.add(button.selected(name == chosen)).on_hover_text(&name);
                response.dnd_set_drag_payload(DraggedStyle(name.clone()));
                if response.clicked() {
                    clicked = Some(name);
                }
            }
        });
        // The sphere goes with the pointer.
        let dragged = DragAndDrop::payload::<DraggedStyle>(ui.ctx()).zip(ui.ctx().pointer_interact_pos());
        if let Some((style, at)) = dragged
            && let Some((texture, _)) = self.sphere(ui.ctx(), &style.0)
        {
            let layer = egui::LayerId::new(egui::Order::Tooltip, Id::unique("dragged style"));
            let whole = Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
            let place = Rect::from_center_size(at, Vec2::splat(30.0));
            ui.ctx().layer_painter(layer).image(texture.id(), place, whole, Color32::WHITE);
        }
        clicked
    }

    /// Returns the sphere of a style as an image.
    pub fn image(&mut self, ui: &Ui, name: &str, side: f32) -> Option<Image<'static>> {
        let (texture, _) = self.sphere(ui.ctx(), name)?;
        Some(Image::new((texture.id(), Vec2::splat(side))).alt_text(format!("the style {name}")))
    }
}
