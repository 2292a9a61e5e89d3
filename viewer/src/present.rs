//! Frames of a graphics card as the window shows them: straight sRGB over the window, on the card alone.

use drypoint::Failure;
use drypoint::gpu::{Gpu, wgpu};

/// The pass from premultiplied linear light to the window's codes: sRGB of the straight colour, premultiplied, as PNG
/// viewers blend a picture.
const SHADER: &str = "
@group(0) @binding(0) var picture: texture_2d<f32>;

@vertex
fn corner(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
    return vec4f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

fn srgb(c: vec3f) -> vec3f {
    let high = 1.055 * pow(max(c, vec3f(0.0031308)), vec3f(1.0 / 2.4)) - 0.055;
    return select(high, 12.92 * c, c <= vec3f(0.0031308));
}

@fragment
fn encoded(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let c = textureLoad(picture, vec2u(at.xy), 0);
    let a = clamp(c.a, 0.0, 1.0);
    return vec4f(srgb(clamp(c.rgb / max(a, 1e-6), vec3f(), vec3f(1.0))) * a, a);
}
";

/// Makes textures for the window of frames on a card.
pub(crate) struct Presenter {
    gpu: Gpu,
    pipeline: wgpu::RenderPipeline,
}

impl Presenter {
    /// Compiles the pass.
    pub(crate) fn new(gpu: Gpu) -> Self {
        let device = gpu.device();
        let source = wgpu::ShaderSource::Wgsl(SHADER.into());
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some("present"), source });
        let vertex = wgpu::VertexState {
            module: &module,
            entry_point: Some("corner"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        };
        let fragment = wgpu::FragmentState {
            module: &module,
            entry_point: Some("encoded"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(FORMAT.into())],
        };
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("present"),
            layout: None,
            vertex,
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(fragment),
            multiview_mask: None,
            cache: None,
        });
        Self { gpu, pipeline }
    }

    /// The card.
    pub(crate) fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// Returns a new texture with the codes of a frame. The window may still show the texture before it.
    ///
    /// # Errors
    /// The device is lost.
    pub(crate) fn present(&self, frame: &wgpu::Texture) -> Result<wgpu::Texture, Failure> {
        let (device, queue) = (self.gpu.device(), self.gpu.queue());
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("shown"),
            size: frame.size(),
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                | wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let view = |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("present"),
            layout: &self.pipeline.get_bind_group_layout(0),
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(&view(frame)) }],
        });
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let target = view(&texture);
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("present"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &target,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Store,
                },
            })],
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..3, 0..1);
        drop(pass);
        queue.submit([encoder.finish()]);
        let waited = self.gpu.wait();
        waited.map_err(|error| Failure::new(error, "the graphics card", "start the window again"))?;
        Ok(texture)
    }
}

/// The format of textures that the window shows: codes, which it does not decode.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
