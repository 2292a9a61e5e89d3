//! A plain caster on the card, as textbooks have it, beside which ours is timed: voxels of 8 bits in a texture, fixed steps through
//! the whole box, a table of colours, Phong shading with a light at the eye. Its picture differs from ours by the table and by
//! where on a ray its samples lie.

use drypoint::gpu::{Gpu, Interpolation, wgpu};
use drypoint::job::Job;
use drypoint::scene::color::{Rgba, srgb_to_linear};
use drypoint::scene::glam::DVec3;
use drypoint::scene::picture::Picture;

/// Colours in the table, for each of the 256 values.
const FINE: usize = 16;

/// The nodes of the scene: values, sRGB colours, and opacities of a voxel's length.
const NODES: [(f64, [u8; 3], f64); 5] = [
    (12.0, [0xcd, 0xe4, 0xea], 0.0),
    (26.0, [0xcd, 0xe4, 0xea], 0.05),
    (40.0, [0xcd, 0xe4, 0xea], 0.0),
    (165.0, [0xec, 0xe2, 0xcc], 0.0),
    (200.0, [0xec, 0xe2, 0xcc], 0.9),
];

/// A pipeline with all that a frame of it reads and writes.
pub(crate) struct Plain {
    device: wgpu::Device,
    queue: wgpu::Queue,
    pipeline: wgpu::ComputePipeline,
    data: wgpu::BindGroup,
    picture: wgpu::Buffer,
    groups: [u32; 2],
}

impl Plain {
    /// A caster with the camera and the volume of a job.
    pub(crate) fn new(gpu: &Gpu, interpolation: Interpolation, job: &Job, lit: bool) -> Self {
        let (device, queue) = (gpu.device().clone(), gpu.queue().clone());
        let view = job.view().expect("the bench's camera");
        let volume = &job.volume;
        let (grid, dims) = (volume.grid(), volume.dims());
        let text = format!("const BY_UNIT = {};\n{}", interpolation == Interpolation::Fast, include_str!("plain.wgsl"));
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("plain"),
            source: wgpu::ShaderSource::Wgsl(text.into()),
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("plain"),
            layout: None,
            module: &module,
            entry_point: Some("draw"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        // The volume.
        let [x, y, z] = dims.map(|n| n as u32);
        let size = wgpu::Extent3d { width: x, height: y, depth_or_array_layers: z };
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("plain"),
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D3,
            format: wgpu::TextureFormat::R8Unorm,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let voxel = |i: usize| volume.value([i % dims[0], i / dims[0] % dims[1], i / dims[0] / dims[1]]) as u8;
        let voxels: Vec<u8> = (0..dims.iter().product()).map(voxel).collect();
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(x), rows_per_image: Some(y) };
        queue.write_texture(texture.as_image_copy(), &voxels, layout, size);
        // The table, with opacities of a step.
        let step = 0.5;
        let entry = |i: usize| {
            let s = i as f64 / FINE as f64;
            let [r, g, b, a] = between(&NODES, s);
            [r, g, b, 1.0 - (1.0 - a).powf(step)].map(|c| c as f32)
        };
        let table: Vec<u8> = (0..=255 * FINE).flat_map(entry).flat_map(f32::to_le_bytes).collect();
        // The camera in index space, where a voxel is a unit.
        let inverse = grid.inverse_axes();
        let [width, height] = view.size;
        let vectors = [
            grid.to_index(view.eye),
            inverse * view.forward,
            inverse * view.right * view.pixel,
            inverse * view.up * view.pixel,
            DVec3::from_array(dims.map(|n| n as f64)),
        ];
        let mut params: Vec<f64> = vectors.iter().flat_map(|v| [v.x, v.y, v.z, 0.0]).collect();
        params.extend([0.3, 0.6, 0.3, 30.0, width as f64, height as f64, step, f64::from(u8::from(lit))]);
        let params: Vec<u8> = params.iter().flat_map(|&c| (c as f32).to_le_bytes()).collect();
        let new = |usage, bytes: &[u8]| {
            let descriptor = wgpu::BufferDescriptor {
                label: Some("plain"),
                size: bytes.len() as u64,
                usage: usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            };
            let buffer = device.create_buffer(&descriptor);
            queue.write_buffer(&buffer, 0, bytes);
            buffer
        };
        let params = new(wgpu::BufferUsages::UNIFORM, &params);
        let table = new(wgpu::BufferUsages::STORAGE, &table);
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let picture = new(usage, &vec![0; 16 * width * height]);
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let filter = wgpu::FilterMode::Linear;
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            mag_filter: filter,
            min_filter: filter,
            ..wgpu::SamplerDescriptor::default()
        });
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        let entries = [
            entry(0, params.as_entire_binding()),
            entry(1, wgpu::BindingResource::TextureView(&view)),
            entry(2, wgpu::BindingResource::Sampler(&sampler)),
            entry(3, table.as_entire_binding()),
            entry(4, picture.as_entire_binding()),
        ];
        let layout = pipeline.get_bind_group_layout(0);
        let data =
            device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &entries });
        let groups = [width, height].map(|n| n.div_ceil(8) as u32);
        Self { device, queue, pipeline, data, picture, groups }
    }

    /// Draws a frame and waits for it.
    pub(crate) fn frame(&self) {
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &self.data, &[]);
            pass.dispatch_workgroups(self.groups[0], self.groups[1], 1);
        }
        self.queue.submit([encoder.finish()]);
        self.device.poll(wgpu::PollType::wait_indefinitely()).expect("the card answers");
    }

    /// The mean difference to a picture of the same scene whose first pixel shows the background.
    pub(crate) fn distance(&self, picture: &Picture) -> f64 {
        let channels = &picture.layers[0].channels;
        let own = self.picture();
        let apart = |(i, own): (usize, &[f32])| {
            let through = 1.0 - f64::from(own[3]);
            let of = |c: usize| (f64::from(own[c]) + through * channels[c][0] - channels[c][i]).abs();
            (of(0) + of(1) + of(2)) / 3.0
        };
        own.chunks_exact(4).enumerate().map(apart).sum::<f64>() / channels[0].len() as f64
    }

    /// Premultiplied colours and opacities of the frame, on the host.
    fn picture(&self) -> Vec<f32> {
        let bytes = self.picture.size();
        let back = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("plain"),
            size: bytes,
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_buffer_to_buffer(&self.picture, 0, &back, 0, bytes);
        self.queue.submit([encoder.finish()]);
        back.slice(..).map_async(wgpu::MapMode::Read, |_| ());
        self.device.poll(wgpu::PollType::wait_indefinitely()).expect("the card answers");
        let numbers = back.slice(..).get_mapped_range().expect("the buffer is mapped");
        numbers.chunks_exact(4).map(|c| f32::from_le_bytes([c[0], c[1], c[2], c[3]])).collect()
    }
}

/// The straight linear colour and the opacity at a value.
fn between(nodes: &[(f64, [u8; 3], f64)], s: f64) -> Rgba {
    let of = |&(_, rgb, a): &(f64, [u8; 3], f64)| {
        let [r, g, b] = rgb.map(|c| srgb_to_linear(f64::from(c) / 255.0));
        [r, g, b, a]
    };
    let next = nodes.partition_point(|node| node.0 <= s);
    match (next.checked_sub(1).map(|i| &nodes[i]), nodes.get(next)) {
        (Some(a), Some(b)) => {
            let t = (s - a.0) / (b.0 - a.0);
            let (a, b) = (of(a), of(b));
            std::array::from_fn(|c| a[c] + t * (b[c] - a[c]))
        }
        (Some(node), None) | (None, Some(node)) => of(node),
        (None, None) => [0.0; 4],
    }
}
