//! Pictures of a shot, any number of them.

use crate::buffers::{buffer, entry, list_entry, pipeline, read};
use crate::shader::{Data, Shader};
use crate::{Gpu, GpuError, Precision, Volume, compose};
use drypoint_scene::backdrop::Backdrop;
use drypoint_scene::measured::Measured;
use drypoint_scene::picture::{Layer, LayerKind, Picture};
use drypoint_scene::shot::Shot;
use drypoint_scene::style::Style;
use drypoint_scene::volume::labels::LabelVolume;

/// Pixels along the side of a workgroup.
const GROUP: u32 = 8;

/// About the most samples of one submission, so that no driver takes it for a fault.
const SAMPLES_AT_ONCE: f64 = (1u64 << 26) as f64;

/// The data that a shot names, beside the volume's numbers.
#[derive(Clone, Copy, Debug)]
pub struct Inputs<'a> {
    /// The volume: its grid and its mask.
    pub volume: &'a drypoint_scene::volume::Volume,
    /// The facts of the volume.
    pub measured: &'a Measured,
    /// The labels beside the volume, where the function reads them ([STF-13]).
    pub labels: Option<&'a LabelVolume>,
    /// The further volumes that the function is over, one for each of its quantities that is one ([STF-4]).
    pub further: [Option<&'a drypoint_scene::volume::Volume>; 2],
    /// The styles that the function names, then those of caps.
    pub styles: &'a [Style],
    /// The background.
    pub background: Backdrop<'a>,
}

/// A shot that is ready to be drawn any number of times.
pub struct Renderer<'g> {
    gpu: &'g Gpu,
    precision: Precision,
    shader: Shader,
    pipeline: wgpu::ComputePipeline,
    params: wgpu::Buffer,
    params_layout: wgpu::BindGroupLayout,
    data: wgpu::BindGroup,
    layers: Vec<LayerKind>,
    size: [usize; 2],
    /// Samples of a row of pixels, roughly.
    samples_a_row: f64,
}

impl<'g> Renderer<'g> {
    /// Prepares a shot for a volume that is already uploaded.
    ///
    /// # Errors
    /// An effect without a shader, data that do not fit, a driver that refuses.
    pub fn new(gpu: &'g Gpu, volume: &Volume, shot: &Shot, inputs: &Inputs<'_>) -> Result<Self, GpuError> {
        Self::edited(gpu, volume, shot, inputs, &|text| text)
    }

    /// Prepares a shot with an edited shader, for tests of whether a comparison notices a fault.
    ///
    /// # Errors
    /// See [`Renderer::new`].
    pub fn edited(
        gpu: &'g Gpu,
        volume: &Volume,
        shot: &Shot,
        inputs: &Inputs<'_>,
        edit: &dyn Fn(String) -> String,
    ) -> Result<Self, GpuError> {
        let precision = volume.precision;
        let shader = compose::shader(shot, inputs, precision)?;
        let text = edit(shader.text(precision));
        let (params_layout, data_layout) = (params_layout(gpu), data_layout(gpu, &shader));
        let data = bind_data(gpu, volume, &shader, &data_layout, precision)?;
        let pipeline = pipeline(gpu, text, "draw", &[&params_layout, &data_layout])?;
        let params = buffer(
            gpu,
            "the parameters",
            &shader.block.bytes(precision),
            wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
        )?;
        let rays = (shot.rays_across * shot.rays_across) as f64;
        let planes = shot.lattice.planes(&shot.view, inputs.volume.grid());
        Ok(Self {
            gpu,
            precision,
            shader,
            pipeline,
            params,
            params_layout,
            data,
            layers: shot.layers.clone(),
            size: shot.view.size,
            samples_a_row: shot.view.size[0] as f64 * rays * planes.max(1.0),
        })
    }

    /// Draws one frame. `progress` hears the share of the picture that is done.
    ///
    /// # Errors
    /// A device that is lost, or has no memory for the picture.
    pub fn frame(&mut self, progress: &dyn Fn(f64)) -> Result<Picture, GpuError> {
        let [width, height] = self.size;
        let channels: usize = self.layers.iter().map(|layer| layer.channels().len()).sum();
        let bytes_a_row = (width * channels) as u64 * self.precision.size();
        let most = u64::from(self.gpu.device.limits().max_storage_buffer_binding_size as u32).max(1 << 27);
        let fit = (most / bytes_a_row.max(1)).max(1) as usize;
        let rows = ((SAMPLES_AT_ONCE / self.samples_a_row) as usize)
            .clamp(GROUP as usize, fit.max(GROUP as usize))
            .min(height);
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let (out, back) = self.gpu.attempt("the picture", || {
            let new = |usage| {
                let size = bytes_a_row * rows as u64;
                self.gpu.device.create_buffer(&wgpu::BufferDescriptor {
                    label: Some("picture"),
                    size,
                    usage,
                    mapped_at_creation: false,
                })
            };
            (new(usage), new(wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST))
        })?;
        let group = self.gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("draw"),
            layout: &self.params_layout,
            entries: &[entry(0, &self.params), entry(1, &out)],
        });
        let mut planes = vec![vec![0.0; width * height]; channels];
        for first in (0..height).step_by(rows) {
            let end = (first + rows).min(height);
            self.shader.block.set("first_row", first as f64);
            self.shader.block.set("end_row", end as f64);
            self.gpu.queue.write_buffer(&self.params, 0, &self.shader.block.bytes(self.precision));
            let bytes = bytes_a_row * (end - first) as u64;
            self.gpu.attempt("the picture", || {
                let mut encoder = self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
                {
                    let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
                    pass.set_pipeline(&self.pipeline);
                    pass.set_bind_group(0, &group, &[]);
                    pass.set_bind_group(1, &self.data, &[]);
                    pass.dispatch_workgroups((width as u32).div_ceil(GROUP), ((end - first) as u32).div_ceil(GROUP), 1);
                }
                encoder.copy_buffer_to_buffer(&out, 0, &back, 0, bytes);
                self.gpu.queue.submit([encoder.finish()]);
            })?;
            let numbers = self.precision.numbers(&read(self.gpu, &back, bytes)?);
            for (i, pixel) in numbers.chunks_exact(channels).enumerate() {
                for (plane, &number) in planes.iter_mut().zip(pixel) {
                    plane[first * width + i] = number;
                }
            }
            progress(end as f64 / height as f64);
        }
        let mut planes = planes.into_iter();
        let layers = self
            .layers
            .iter()
            .map(|&kind| Layer { kind, channels: planes.by_ref().take(kind.channels().len()).collect() });
        Ok(Picture { width, height, layers: layers.collect() })
    }
}

/// The layout of group 0: parameters and the picture.
fn params_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("parameters"),
        entries: &[list_entry(0, true), list_entry(1, false)],
    })
}

/// The layout of group 1: the data of the scene's effects.
fn data_layout(gpu: &Gpu, shader: &Shader) -> wgpu::BindGroupLayout {
    let entry = |(binding, _, data): &(u32, &'static str, Data)| match data {
        Data::Numbers | Data::Voxels | Data::Smoothed => wgpu::BindGroupLayoutEntry {
            binding: *binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable: false },
                view_dimension: wgpu::TextureViewDimension::D3,
                multisampled: false,
            },
            count: None,
        },
        Data::Reals(_) | Data::Words(_) | Data::Texels(_) => list_entry(*binding, true),
    };
    let entries: Vec<_> = shader.data.iter().map(entry).collect();
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("data"), entries: &entries })
}

/// Uploads what a shader reads.
fn bind_data(
    gpu: &Gpu,
    volume: &Volume,
    shader: &Shader,
    layout: &wgpu::BindGroupLayout,
    precision: Precision,
) -> Result<wgpu::BindGroup, GpuError> {
    enum Resource<'v> {
        Texture(&'v wgpu::TextureView),
        List(wgpu::Buffer),
    }
    let mut resources = Vec::new();
    for (binding, what, data) in &shader.data {
        let list = |bytes: &[u8]| buffer(gpu, what, bytes, wgpu::BufferUsages::STORAGE).map(Resource::List);
        let resource = match data {
            Data::Numbers => Resource::Texture(&volume.numbers),
            Data::Voxels => Resource::Texture(volume.voxels.as_ref().unwrap_or(&volume.numbers)),
            Data::Smoothed => Resource::Texture(volume.smoothed.as_ref().unwrap_or(&volume.numbers)),
            Data::Reals(values) => list(&precision.bytes(values))?,
            Data::Words(words) => list(bytemuck::cast_slice(words))?,
            Data::Texels(texels) => list(bytemuck::cast_slice(texels))?,
        };
        resources.push((*binding, resource));
    }
    let mut entries = Vec::new();
    for (binding, resource) in &resources {
        let resource = match resource {
            Resource::Texture(view) => wgpu::BindingResource::TextureView(view),
            Resource::List(buffer) => buffer.as_entire_binding(),
        };
        entries.push(wgpu::BindGroupEntry { binding: *binding, resource });
    }
    gpu.attempt("the scene", || {
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some("data"), layout, entries: &entries })
    })
}
