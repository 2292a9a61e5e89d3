//! Three slices of the volume, which share the cross-hair with the picture.

use super::Panel;
use crate::frames::VolumeData;
use crate::session::Session;
use crate::slice::{SlicePlane, ValueColors};
use drypoint::scene::glam::DVec3;
use drypoint::scene::volume::info::short;
use eframe::egui::{
    self, Align2, Color32, FontId, Rect, Sense, Stroke, TextureHandle, TextureOptions, Ui, Vec2, pos2, vec2,
};
use std::sync::Arc;

/// Points of the wheel for a slice: those of one notch.
const NOTCH: f32 = 40.0;

/// Points of the window between slices.
const GAP: f32 = 6.0;

/// The panel of slices.
#[derive(Default)]
pub(super) struct SlicesPanel {
    /// The pictures that are shown, of the axial, the coronal and the sagittal slice.
    shown: [Option<ShownSlice>; 3],
    /// Points of the wheel that are not yet a slice.
    turned: f32,
    /// Whether values have their colours in the function.
    is_colored: bool,
}

/// The picture of a slice.
struct ShownSlice {
    data: Arc<VolumeData>,
    /// None: grey.
    colors: Option<Arc<ValueColors>>,
    k: usize,
    texture: TextureHandle,
}

impl Panel for SlicesPanel {
    fn title(&self) -> &'static str {
        "Slices"
    }

    fn ui(&mut self, ui: &mut Ui, session: &mut Session) {
        let Some(data) = session.data().cloned() else {
            ui.weak("The volume is being read.");
            return;
        };
        let grid = data.volume.grid();
        let index = grid.to_index(session.cross.unwrap_or_else(|| grid.centre()));
        let voxel: [usize; 3] = std::array::from_fn(|axis| {
            let last = grid.dims()[axis].saturating_sub(1);
            (index[axis].round().max(0.0) as usize).min(last)
        });
        let [i, j, k] = voxel;
        let value = short(data.volume.value(voxel));
        ui.horizontal(|ui| {
            ui.checkbox(&mut self.is_colored, "In the function's colours");
            ui.label(format!("Voxel {i}, {j}, {k}: {value}")).on_hover_text(
                "A click in the picture or in a slice moves the cross-hair, and the wheel goes through the slices.",
            );
        });
        let colors = session.colors.clone().filter(|_| self.is_colored);
        let area = ui.available_rect_before_wrap();
        let is_wide = area.width() > area.height();
        for (n, plane) in SlicePlane::all(grid, data.volume.anatomy()).iter().enumerate() {
            let share = if is_wide { vec2(1.0 / 3.0, 1.0) } else { vec2(1.0, 1.0 / 3.0) };
            let step = area.size() * if is_wide { vec2(share.x, 0.0) } else { vec2(0.0, share.y) };
            let cell = Rect::from_min_size(area.min + step * n as f32, area.size() * share).shrink(GAP / 2.0);
            let spacing = grid.spacing();
            let lengths = [0, 1].map(|side| (plane.size()[side] as f64 * spacing[plane.axes[side]]) as f32);
            let scale = (cell.width() / lengths[0]).min(cell.height() / lengths[1]).max(0.0);
            let rect = Rect::from_center_size(cell.center(), Vec2::from(lengths) * scale);
            let k = voxel[plane.axes[2]];
            let texture = self.texture(ui, n, (plane, k), &data, colors.as_ref());
            if let Some(to) = self.slice(ui, plane, rect, texture, index, k) {
                session.cross = Some(grid.to_world(to));
            }
        }
    }
}

impl SlicesPanel {
    /// Returns the texture of slice `k`, which is made anew if another one was shown.
    fn texture(
        &mut self,
        ui: &Ui,
        n: usize,
        (plane, k): (&SlicePlane, usize),
        data: &Arc<VolumeData>,
        colors: Option<&Arc<ValueColors>>,
    ) -> TextureHandle {
        let is_shown = |shown: &&ShownSlice| {
            let same_colors = shown.colors.as_ref().map(Arc::as_ptr) == colors.map(Arc::as_ptr);
            shown.k == k && same_colors && Arc::ptr_eq(&shown.data, data)
        };
        if let Some(shown) = self.shown[n].as_ref().filter(is_shown) {
            return shown.texture.clone();
        }
        let [width, height, _] = plane.size();
        let step = width.max(height).div_ceil(ui.input(|input| input.max_texture_side).max(1));
        let grey = ValueColors::grey([data.histogram.lo, data.histogram.hi]);
        let image = plane.picture(&data.volume, k, colors.map_or(&grey, Arc::as_ref), step.max(1));
        let texture = ui.ctx().load_texture(plane.name, image, TextureOptions::NEAREST);
        self.shown[n] =
            Some(ShownSlice { data: Arc::clone(data), colors: colors.cloned(), k, texture: texture.clone() });
        texture
    }

    /// Shows a slice with the cross-hair at a position in index space. Returns the position that the user moves it to.
    fn slice(
        &mut self,
        ui: &mut Ui,
        plane: &SlicePlane,
        rect: Rect,
        texture: TextureHandle,
        index: DVec3,
        k: usize,
    ) -> Option<DVec3> {
        let [width, height, slices] = plane.size();
        let response = ui.allocate_rect(rect, Sense::click_and_drag());
        let name = format!("{} slice", plane.name);
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Canvas, true, &name));
        let painter = ui.painter_at(rect);
        painter.image(texture.id(), rect, Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0)), Color32::WHITE);
        let pixels = vec2(width as f32, height as f32);
        let [x, y] = plane.point_of(index).map(|x| x as f32);
        let at = rect.min + vec2(x, y) * rect.size() / pixels;
        for (width, color) in [(3.0, Color32::from_black_alpha(120)), (1.0, Color32::from_rgb(255, 196, 64))] {
            painter.vline(at.x, rect.y_range(), Stroke::new(width, color));
            painter.hline(rect.x_range(), at.y, Stroke::new(width, color));
        }
        let write = |align: Align2, text: &str| {
            let at = align.pos_in_rect(&rect.shrink(3.0));
            let font = FontId::proportional(12.0);
            painter.text(at + Vec2::splat(1.0), align, text, font.clone(), Color32::BLACK);
            painter.text(at, align, text, font, Color32::WHITE);
        };
        write(Align2::LEFT_TOP, &format!("{} {k} of {slices}", plane.name));
        if let Some(sides) = plane.sides {
            let places = [Align2::LEFT_CENTER, Align2::RIGHT_CENTER, Align2::CENTER_TOP, Align2::CENTER_BOTTOM];
            places.into_iter().zip(sides).for_each(|(place, side)| write(place, side));
        }
        if response.hovered() {
            self.turned += ui.input(|input| input.smooth_scroll_delta().y);
            let notches = (self.turned / NOTCH).trunc();
            if notches != 0.0 {
                self.turned -= notches * NOTCH;
                let mut to = index;
                to[plane.axes[2]] = (k as f64 + f64::from(notches)).clamp(0.0, slices.saturating_sub(1) as f64);
                return Some(to);
            }
        }
        let is_moved = response.clicked() || response.dragged_by(egui::PointerButton::Primary);
        let at = response.interact_pointer_pos().filter(|_| is_moved)?;
        let point = (at - rect.min) / rect.size() * pixels;
        let pixel =
            [(point.x, width), (point.y, height)].map(|(x, side)| (x.max(0.0) as usize).min(side.saturating_sub(1)));
        Some(DVec3::from_array(plane.voxel(pixel, k).map(|n| n as f64)))
    }
}
