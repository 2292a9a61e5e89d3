//! The buffers of a picture that is being drawn.

use crate::{Gpu, GpuError};
use std::ops::Range;

/// Buffers for rows of a picture, kept from frame to frame.
pub(crate) struct PictureBuffers {
    /// The largest number of rows that are finished together.
    pub(crate) rows: usize,
    /// Bytes of a row of pixels with all channels.
    pub(crate) bytes_a_row: u64,
    /// The numbers of the rows.
    pub(crate) out: wgpu::Buffer,
    /// Numbers that are copied to the host.
    pub(crate) back: wgpu::Buffer,
    /// The numbers before pixels are refined; none if no pixel is.
    pub(crate) before: Option<wgpu::Buffer>,
}

impl PictureBuffers {
    /// Buffers for as many of a picture's `height` rows as a shader can write.
    pub(crate) fn new(gpu: &Gpu, refines: bool, bytes_a_row: u64, height: usize) -> Result<Self, GpuError> {
        // One more row is drawn on either side of those that are refined.
        let around = if refines { 2 } else { 0 };
        let most = gpu.device.limits().max_storage_buffer_binding_size;
        let fit = usize::try_from(most / bytes_a_row.max(1)).unwrap_or(usize::MAX);
        let rows = if fit < height { fit.saturating_sub(around).max(1) } else { height };
        let bytes = bytes_a_row * (rows + around).min(height) as u64;
        let new = |usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("picture"),
                size: bytes,
                usage,
                mapped_at_creation: false,
            })
        };
        let storage = wgpu::BufferUsages::STORAGE;
        let (out, back, before) = gpu.attempt("the picture", || {
            let out = new(storage | wgpu::BufferUsages::COPY_SRC);
            let back = new(wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
            (out, back, refines.then(|| new(storage | wgpu::BufferUsages::COPY_DST)))
        })?;
        Ok(Self { rows, bytes_a_row, out, back, before })
    }

    /// The rows that must be drawn to finish some rows.
    pub(crate) fn rows_around(&self, rows: &Range<usize>, height: usize) -> Range<usize> {
        match self.before {
            Some(_) => rows.start.saturating_sub(1)..(rows.end + 1).min(height),
            None => rows.clone(),
        }
    }

    /// Keeps the drawn numbers for the refinement.
    pub(crate) fn keep_first(&self, encoder: &mut wgpu::CommandEncoder) {
        if let Some(before) = &self.before {
            encoder.copy_buffer_to_buffer(&self.out, 0, before, 0, self.out.size());
        }
    }

    /// Copies finished rows. The first of them is `skipped` rows from the top.
    pub(crate) fn copy_back(&self, encoder: &mut wgpu::CommandEncoder, skipped: usize, rows: usize) {
        let [offset, bytes] = [skipped, rows].map(|rows| self.bytes_a_row * rows as u64);
        encoder.copy_buffer_to_buffer(&self.out, offset, &self.back, 0, bytes);
    }
}
