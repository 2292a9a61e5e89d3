//! The frame in the window: a texture of egui, from bytes or from a texture of the shared device.

use crate::canvas::Pixels;
use crate::frames::Frame;
use drypoint::gpu::wgpu;
use eframe::egui::{self, Color32, ColorImage, TextureHandle, TextureId, TextureOptions};
use eframe::egui_wgpu::RenderState;

/// The last frame, as egui shows it.
#[derive(Default)]
pub struct Screen {
    render: Option<RenderState>,
    /// The texture that is registered with egui for frames of a card, and its content.
    registered: Option<(TextureId, wgpu::Texture)>,
    /// The texture for frames in memory.
    loaded: Option<(TextureHandle, ColorImage)>,
    is_card: bool,
}

impl Screen {
    /// A screen of a window that draws with wgpu, or of one without textures of its own.
    pub fn new(render: Option<RenderState>) -> Self {
        Self { render, ..Self::default() }
    }

    /// Takes a frame.
    pub fn show(&mut self, ctx: &egui::Context, frame: Frame) {
        match (frame.pixels, &self.render) {
            (Pixels::Texture(texture), Some(render)) => {
                let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
                let mut renderer = render.renderer.write();
                let filter = wgpu::FilterMode::Linear;
                let id = match &self.registered {
                    Some((id, _)) => {
                        renderer.update_egui_texture_from_wgpu_texture(&render.device, &view, filter, *id);
                        *id
                    }
                    None => renderer.register_native_texture(&render.device, &view, filter),
                };
                self.registered = Some((id, texture));
                self.is_card = true;
            }
            // A card's frames are for the window whose device it has.
            (Pixels::Texture(_), None) => {}
            (Pixels::Bytes(bytes), _) => {
                let image = ColorImage::from_rgba_unmultiplied(frame.size, &bytes);
                match &mut self.loaded {
                    Some((handle, shown)) => {
                        handle.set(image.clone(), TextureOptions::LINEAR);
                        *shown = image;
                    }
                    None => {
                        self.loaded = Some((ctx.load_texture("frame", image.clone(), TextureOptions::LINEAR), image))
                    }
                }
                self.is_card = false;
            }
        }
    }

    /// Returns the texture of the last frame, if there is one.
    pub fn texture(&self) -> Option<TextureId> {
        match (self.is_card, &self.registered, &self.loaded) {
            (true, Some((id, _)), _) => Some(*id),
            (false, _, Some((handle, _))) => Some(handle.id()),
            _ => None,
        }
    }

    /// Returns the pixels of the last frame. Those of a card are read back.
    pub fn image(&self) -> Option<ColorImage> {
        match (self.is_card, &self.registered, &self.loaded, &self.render) {
            (true, Some((_, texture)), _, Some(render)) => read_back(render, texture),
            (false, _, Some((_, image)), _) => Some(image.clone()),
            _ => None,
        }
    }
}

/// Reads a texture of premultiplied codes.
fn read_back(render: &RenderState, texture: &wgpu::Texture) -> Option<ColorImage> {
    let [width, height] = [texture.width(), texture.height()];
    let bytes_per_row = (width * 4).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = render.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("copy of the picture"),
        size: u64::from(bytes_per_row * height),
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(bytes_per_row), rows_per_image: None };
    let mut encoder = render.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.copy_texture_to_buffer(
        texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo { buffer: &buffer, layout },
        texture.size(),
    );
    render.queue.submit([encoder.finish()]);
    // If it cannot be mapped there are no bytes below.
    buffer.slice(..).map_async(wgpu::MapMode::Read, |_| ());
    render.device.poll(wgpu::PollType::wait_indefinitely()).ok()?;
    let bytes = buffer.slice(..).get_mapped_range().ok()?.to_vec();
    let rows = bytes.chunks_exact(bytes_per_row as usize).flat_map(|row| row[..4 * width as usize].as_chunks::<4>().0);
    let pixels = rows.map(|&[r, g, b, a]| Color32::from_rgba_premultiplied(r, g, b, a)).collect();
    Some(ColorImage::new([width as usize, height as usize], pixels))
}
