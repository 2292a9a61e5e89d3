//! The finished picture in a viewer's texture.

use crate::buffers::{entry, list_entry, pipeline, shader_module};
use crate::module::{Module, module};
use crate::{Gpu, GpuError, Precision, number};
use drypoint_scene::picture::LayerKind;

const PRESENT: Module = module!("present");

/// Pixels along the side of a workgroup.
const GROUP: u32 = 8;

/// The pass that writes a picture's beauty into a texture.
pub(crate) struct Presentation {
    pipeline: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
}

impl Presentation {
    /// Prepares the pass for pictures with layers, of any size. `size` is the place of width and height among the scalars.
    pub(crate) fn new(gpu: &Gpu, precision: Precision, size: usize, layers: &[LayerKind]) -> Result<Self, GpuError> {
        let missing = GpuError::Missing { what: "a picture without a beauty in a viewer", key: "picture.layers" };
        let beauty = layers.iter().position(|&layer| layer == LayerKind::Beauty).ok_or(missing)?;
        let channels = |layers: &[LayerKind]| layers.iter().map(|layer| layer.channels().len()).sum::<usize>();
        let text = text(precision, size, channels(layers), channels(&layers[..beauty]));
        let target = wgpu::BindGroupLayoutEntry {
            binding: 1,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::StorageTexture {
                access: wgpu::StorageTextureAccess::WriteOnly,
                format: wgpu::TextureFormat::Rgba16Float,
                view_dimension: wgpu::TextureViewDimension::D2,
            },
            count: None,
        };
        let entries = [list_entry(0, true), target, list_entry(2, true)];
        let descriptor = wgpu::BindGroupLayoutDescriptor { label: Some("present"), entries: &entries };
        let layout = gpu.attempt("the shader", || gpu.device.create_bind_group_layout(&descriptor))?;
        let pipeline = pipeline(gpu, &shader_module(gpu, &text)?, "present", &[&layout])?;
        Ok(Self { pipeline, layout })
    }

    /// Writes the numbers of a picture of `size` pixels into a texture. `numbers` are the scalars of its shader.
    pub(crate) fn run(
        &self,
        gpu: &Gpu,
        [picture, numbers]: [&wgpu::Buffer; 2],
        size: [usize; 2],
        target: &wgpu::TextureView,
    ) -> Result<(), GpuError> {
        gpu.attempt("the picture", || {
            let target = wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(target) };
            let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("present"),
                layout: &self.layout,
                entries: &[entry(0, picture), target, entry(2, numbers)],
            });
            let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            {
                let mut run = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
                run.set_bind_group(0, &group, &[]);
                let [x, y] = size.map(|n| (n as u32).div_ceil(GROUP));
                gpu.dispatch(&mut run, &self.pipeline, [x, y, 1]);
            }
            gpu.queue.submit([encoder.finish()]);
        })
    }
}

/// The shader for pixels of `channels` channels. The beauty begins at channel `first`.
pub(crate) fn text(precision: Precision, size: usize, channels: usize, first: usize) -> String {
    let number = number::of(precision);
    format!(
        "{}\nconst SIZE = {size};\nconst CHANNELS = {channels};\nconst BEAUTY = {first};\n{}",
        number.text, PRESENT.text
    )
}
