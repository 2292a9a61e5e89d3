//! The clock of an adapter.

use crate::buffers::read;
use crate::{Gpu, GpuError};

/// Bytes of two timestamps.
const BYTES: u64 = 16;

/// Timestamps at the beginning and at the end of a frame.
pub(crate) struct Clock {
    stamps: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    back: wgpu::Buffer,
}

impl Clock {
    /// A clock. Returns none if the adapter has none.
    pub(crate) fn new(gpu: &Gpu) -> Result<Option<Self>, GpuError> {
        if !gpu.device.features().contains(wgpu::Features::TIMESTAMP_QUERY) {
            return Ok(None);
        }
        let label = Some("clock");
        let buffer = |usage| {
            let descriptor = wgpu::BufferDescriptor { label, size: BYTES, usage, mapped_at_creation: false };
            gpu.device.create_buffer(&descriptor)
        };
        let new = || Self {
            stamps: gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label,
                ty: wgpu::QueryType::Timestamp,
                count: 2,
            }),
            resolved: buffer(wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC),
            back: buffer(wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST),
        };
        gpu.attempt("the clock", new).map(Some)
    }

    /// The timestamps of a frame's first or last pass.
    pub(crate) fn stamps(&self, begins: bool, ends: bool) -> Option<wgpu::ComputePassTimestampWrites<'_>> {
        (begins || ends).then_some(wgpu::ComputePassTimestampWrites {
            query_set: &self.stamps,
            beginning_of_pass_write_index: begins.then_some(0),
            end_of_pass_write_index: ends.then_some(1),
        })
    }

    /// Makes the timestamps readable, after the last pass.
    pub(crate) fn resolve(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.resolve_query_set(&self.stamps, 0..2, &self.resolved, 0);
        encoder.copy_buffer_to_buffer(&self.resolved, 0, &self.back, 0, BYTES);
    }

    /// Seconds between the timestamps of the last frame.
    pub(crate) fn seconds(&self, gpu: &Gpu) -> Result<f64, GpuError> {
        let bytes = read(gpu, &self.back, BYTES)?;
        let stamps: Vec<u64> = bytes.as_chunks().0.iter().map(|&bytes| u64::from_le_bytes(bytes)).collect();
        Ok(stamps[1].saturating_sub(stamps[0]) as f64 * f64::from(gpu.queue.get_timestamp_period()) * 1e-9)
    }
}
