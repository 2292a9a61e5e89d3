//! Buffers and pipelines of a device.

use crate::{Gpu, GpuError};
use std::sync::mpsc;

/// A shader that the device has read. All entry points of a text share it.
pub(crate) fn shader_module(gpu: &Gpu, text: &str) -> Result<wgpu::ShaderModule, GpuError> {
    gpu.attempt("the shader", || {
        let source = wgpu::ShaderSource::Wgsl(text.into());
        gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source })
    })
}

/// A pipeline of a shader's entry point.
pub(crate) fn pipeline(
    gpu: &Gpu,
    module: &wgpu::ShaderModule,
    entry_point: &'static str,
    groups: &[&wgpu::BindGroupLayout],
) -> Result<wgpu::ComputePipeline, GpuError> {
    let groups: Vec<_> = groups.iter().map(|&group| Some(group)).collect();
    gpu.count_pipeline();
    gpu.attempt("the shader", || {
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(entry_point),
            bind_group_layouts: &groups,
            immediate_size: 0,
        });
        gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(entry_point),
            layout: Some(&layout),
            module,
            entry_point: Some(entry_point),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &[],
                // Workgroups write their memory before they read it.
                zero_initialize_workgroup_memory: false,
            },
            cache: None,
        })
    })
}

/// Reads a buffer back.
pub(crate) fn read(gpu: &Gpu, buffer: &wgpu::Buffer, bytes: u64) -> Result<Vec<u8>, GpuError> {
    let slice = buffer.slice(..bytes);
    let (send, receive) = mpsc::channel();
    slice.map_async(wgpu::MapMode::Read, move |result| {
        // The receiver is there until it has heard.
        let _ = send.send(result);
    });
    gpu.wait()?;
    match receive.try_recv() {
        Ok(Ok(())) => {}
        Ok(Err(error)) => return Err(gpu.lost_for(error.to_string())),
        Err(error) => return Err(gpu.lost_for(error.to_string())),
    }
    let copy = slice.get_mapped_range().map(|range| range.to_vec()).map_err(|error| gpu.lost_for(error.to_string()));
    buffer.unmap();
    copy
}

/// Bytes of the longest entry of any list, rounded up.
const LONGEST_ENTRY: u64 = 256;

/// Checks that a shader can read this many bytes. It is called before a list is made that may be large.
pub(crate) fn check_bytes(gpu: &Gpu, what: &'static str, bytes: u64) -> Result<(), GpuError> {
    let limits = gpu.device.limits();
    let most = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
    let refused = || GpuError::TooManyBytes { what, bytes, most, adapter: gpu.name().to_owned() };
    if bytes > most { Err(refused()) } else { Ok(()) }
}

/// Checks that a shader can have this many lists.
pub(crate) fn check_lists(gpu: &Gpu, lists: usize) -> Result<(), GpuError> {
    let most = gpu.device.limits().max_storage_buffers_per_shader_stage;
    let refused = || GpuError::TooManyLists { lists, most, adapter: gpu.name().to_owned() };
    if lists > most as usize { Err(refused()) } else { Ok(()) }
}

/// A buffer with contents.
pub(crate) fn buffer(
    gpu: &Gpu,
    what: &'static str,
    contents: &[u8],
    usage: wgpu::BufferUsages,
) -> Result<wgpu::Buffer, GpuError> {
    // A list without entries is as long as the longest entry: what is bound holds one.
    let bytes = (contents.len() as u64).max(LONGEST_ENTRY);
    check_bytes(gpu, what, bytes)?;
    gpu.attempt(what, || {
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(what),
            size: bytes.next_multiple_of(16),
            usage: usage | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        gpu.queue.write_buffer(&buffer, 0, contents);
        buffer
    })
}

pub(crate) fn entry(binding: u32, buffer: &wgpu::Buffer) -> wgpu::BindGroupEntry<'_> {
    wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() }
}

/// A storage buffer of a layout.
pub(crate) fn list_entry(binding: u32, read_only: bool) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    }
}
