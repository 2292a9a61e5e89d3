//! Pictures of a shot, any number of them.

use crate::buffers::{buffer, entry, list_entry, pipeline, read};
use crate::field::Scales;
use crate::ray::layers::in_picture_units;
use crate::ray::lines::LinesOnRays;
use crate::shader::{Data, Shader};
use crate::{Gpu, GpuError, Precision, Volume, compose};
use drypoint_scene::backdrop::Backdrop;
use drypoint_scene::fragments::Fragments;
use drypoint_scene::measured::Measured;
use drypoint_scene::picture::{Layer, LayerKind, Picture};
use drypoint_scene::shot::Shot;
use drypoint_scene::space::Grid;
use drypoint_scene::style::Style;
use drypoint_scene::volume::labels::LabelVolume;

/// Pixels along the side of a workgroup.
const GROUP: u32 = 8;

/// About the most samples of one submission, so that no driver takes it for a fault.
const SAMPLES_AT_ONCE: f64 = (1u64 << 26) as f64;

/// The first channel of a pixel that is not refined lies below.
const STAYS: f64 = -1e29;

/// The first channel of a pixel whose rays the driver ended lies below.
const UNFINISHED: f64 = -1.5e30;

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
    /// Whether frames can have lines inside the volume ([HATCH-14] d).
    pub has_lines: bool,
}

/// A shot that is ready to be drawn any number of times.
pub struct Renderer<'g> {
    gpu: &'g Gpu,
    precision: Precision,
    shader: Shader,
    scales: Scales,
    draw: Pass,
    /// Further rays at edges; none: no pixel is refined.
    refinement: Option<Pass>,
    params: wgpu::Buffer,
    data: wgpu::BindGroup,
    /// Lines inside the volume; none where no frame can have any.
    lines: Option<LinesOnRays>,
    /// The layers that the shot asks for.
    asked: Vec<LayerKind>,
    /// Those, with the beauty first where edges are found by it.
    layers: Vec<LayerKind>,
    size: [usize; 2],
    /// n of the n×n rays of a pixel, before it is refined.
    rays_across: usize,
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
        let layers = drawn_layers(shot);
        let (shader, scales) = compose::shader(shot, &layers, inputs, precision)?;
        let text = edit(shader.text(precision));
        let data_layout = data_layout(gpu, &shader)?;
        let data = bind_data(gpu, volume, &shader, &data_layout, precision)?;
        let lines = inputs.has_lines.then(|| LinesOnRays::new(shot, inputs.volume.grid()));
        let pass = |entry_point, reads: &[u32]| {
            let of_lines: &[u32] = if lines.is_some() { &[3, 4] } else { &[] };
            Pass::new(gpu, &text, entry_point, &[reads, of_lines].concat(), &data_layout)
        };
        let draw = pass("draw", &[0])?;
        let refinement = shot.refine_above.map(|_| pass("refine", &[0, 2])).transpose()?;
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
            scales,
            draw,
            refinement,
            params,
            data,
            lines,
            asked: shot.layers.clone(),
            layers,
            size: shot.view.size,
            rays_across: shot.rays_across,
            samples_a_row: shot.view.size[0] as f64 * rays * planes.max(1.0),
        })
    }

    /// Takes the camera and the lights of another shot for the frames that follow. The shots may differ in nothing else.
    ///
    /// # Errors
    /// More sample planes than the shader counts.
    pub fn turn(&mut self, shot: &Shot, grid: &Grid) -> Result<(), GpuError> {
        self.shader.block.update(&compose::camera(shot, grid)?);
        if let Some(lines) = &mut self.lines {
            lines.turn(shot, grid);
        }
        Ok(())
    }

    /// Puts lines inside the frames that follow, or takes them out: those of the camera of these frames ([HATCH-14] d).
    ///
    /// # Errors
    /// Lines in a shot that was prepared without them.
    pub fn merge(&mut self, lines: Option<Fragments>) -> Result<(), GpuError> {
        match &mut self.lines {
            Some(on_rays) => on_rays.lines = lines,
            None if lines.is_some() => return Err(GpuError::NoLines),
            None => {}
        }
        Ok(())
    }

    /// Draws one frame. `progress` hears the share of the picture that is done.
    ///
    /// # Errors
    /// A device that is lost, or has no memory for the picture.
    pub fn frame(&mut self, progress: &dyn Fn(f64)) -> Result<Picture, GpuError> {
        let [width, height] = self.size;
        let kinds: Vec<LayerKind> =
            self.layers.iter().flat_map(|&layer| std::iter::repeat_n(layer, layer.channels().len())).collect();
        let mut planes = vec![vec![0.0; width * height]; kinds.len()];
        let half = if self.refinement.is_some() { 0.5 } else { 1.0 };
        self.bands(None, &|share| progress(half * share), &mut |at, pixel| {
            for (plane, &number) in planes.iter_mut().zip(pixel) {
                plane[at] = number;
            }
        })?;
        if self.refinement.is_some() {
            let first: Vec<f64> = (0..width * height).flat_map(|at| [0, 1, 2, 3].map(|c| planes[c][at])).collect();
            self.bands(Some(&first), &|share| progress(0.5 + 0.5 * share), &mut |at, pixel| {
                // Layers of one ray keep that of the first picture.
                let refined = kinds.iter().map(|&kind| kind == LayerKind::Beauty || kind.is_mean());
                for ((plane, &number), is_refined) in planes.iter_mut().zip(pixel).zip(refined) {
                    if is_refined && pixel[0] > STAYS {
                        plane[at] = number;
                    }
                }
            })?;
        }
        for (plane, &kind) in planes.iter_mut().zip(&kinds) {
            plane.iter_mut().for_each(|number| *number = in_picture_units(kind, *number, &self.scales));
        }
        let mut planes = planes.into_iter();
        let mut layers: Vec<Layer> = self
            .layers
            .iter()
            .map(|&kind| Layer { kind, channels: planes.by_ref().take(kind.channels().len()).collect() })
            .collect();
        let place = |layer: &Layer| self.asked.iter().position(|&asked| asked == layer.kind);
        layers.retain(|layer| place(layer).is_some());
        layers.sort_by_key(place);
        Ok(Picture { width, height, layers })
    }

    /// Runs the shader for bands of rows; of a refinement with the beauty of the first picture. `take` hears the place of
    /// each pixel and its numbers.
    fn bands(
        &mut self,
        first_picture: Option<&[f64]>,
        progress: &dyn Fn(f64),
        take: &mut dyn FnMut(usize, &[f64]),
    ) -> Result<(), GpuError> {
        let (gpu, [width, height]) = (self.gpu, self.size);
        let channels: usize = self.layers.iter().map(|layer| layer.channels().len()).sum();
        let (pass, samples, parts) = match (&self.refinement, first_picture) {
            (Some(pass), Some(_)) => (pass, 9.0 * self.samples_a_row, 9),
            _ => (&self.draw, self.samples_a_row, self.rays_across * self.rays_across),
        };
        // Sums of layers stay in a shader; a beauty alone is drawn ray by ray.
        let parts_at_once = if self.layers == [LayerKind::Beauty] { 1 } else { parts };
        // Rows whose samples are few enough and whose numbers fit in a buffer.
        let bytes_a_row = (width * channels.max(4)) as u64 * self.precision.size();
        let most = gpu.device.limits().max_storage_buffer_binding_size;
        let fit = ((most / bytes_a_row.max(1)) as usize).saturating_sub(2).max(1);
        let rows = ((SAMPLES_AT_ONCE / samples) as usize).max(GROUP as usize).min(fit).min(height);
        let new = |rows: usize, usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("picture"),
                size: bytes_a_row * rows as u64,
                usage,
                mapped_at_creation: false,
            })
        };
        let usage = wgpu::BufferUsages::STORAGE;
        let (out, back, before) = gpu.attempt("the picture", || {
            let out = new(rows, usage | wgpu::BufferUsages::COPY_SRC);
            let back = new(rows, wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
            (out, back, first_picture.map(|_| new(rows + 2, usage | wgpu::BufferUsages::COPY_DST)))
        })?;
        let lines = self.lines.as_ref().map(|lines| lines.buffers(gpu, self.precision)).transpose()?;
        let mut entries = vec![entry(0, &self.params), entry(1, &out)];
        entries.extend(lines.iter().flat_map(|[starts, fragments]| [entry(3, starts), entry(4, fragments)]));
        entries.extend(before.iter().map(|before| entry(2, before)));
        let group = gpu.attempt("the picture", || {
            gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("draw"),
                layout: &pass.layout,
                entries: &entries,
            })
        })?;
        for first in (0..height).step_by(rows) {
            let end = (first + rows).min(height);
            self.shader.block.set("first_row", first as f64);
            self.shader.block.set("end_row", end as f64);
            if let (Some(before), Some(picture)) = (&before, first_picture) {
                // The row above the band may be missing; what stands in its place is not read.
                let above = first.saturating_sub(1);
                let numbers = &picture[4 * width * above..4 * width * (end + 1).min(height)];
                let offset = (above + 1 - first) * 4 * width;
                let offset = offset as u64 * self.precision.size();
                gpu.attempt("the picture", || {
                    gpu.queue.write_buffer(before, offset, &self.precision.bytes(numbers));
                })?;
            }
            let bytes = (width * channels * (end - first)) as u64 * self.precision.size();
            for part in (0..parts).step_by(parts_at_once) {
                self.shader.block.set("first_part", part as f64);
                self.shader.block.set("end_part", (part + parts_at_once) as f64);
                gpu.attempt("the picture", || {
                    gpu.queue.write_buffer(&self.params, 0, &self.shader.block.bytes(self.precision));
                    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
                    {
                        let groups = [width, end - first].map(|n| (n as u32).div_ceil(GROUP));
                        let mut run = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
                        run.set_pipeline(&pass.pipeline);
                        run.set_bind_group(0, &group, &[]);
                        run.set_bind_group(1, &self.data, &[]);
                        run.dispatch_workgroups(groups[0], groups[1], 1);
                    }
                    if part + parts_at_once >= parts {
                        encoder.copy_buffer_to_buffer(&out, 0, &back, 0, bytes);
                    }
                    gpu.queue.submit([encoder.finish()]);
                })?;
            }
            let numbers = self.precision.numbers(&read(gpu, &back, bytes)?);
            for (i, pixel) in numbers.chunks_exact(channels).enumerate() {
                if pixel[0] < UNFINISHED {
                    return Err(GpuError::Unfinished { adapter: gpu.name().to_owned() });
                }
                take(first * width + i, pixel);
            }
            progress(end as f64 / height as f64);
        }
        Ok(())
    }
}

/// The layers that a shader draws. Edges are found by the beauty, which comes first then.
pub(crate) fn drawn_layers(shot: &Shot) -> Vec<LayerKind> {
    let (mut first, mut layers) = (Vec::new(), shot.layers.clone());
    if shot.refine_above.is_some() {
        first.push(LayerKind::Beauty);
        layers.retain(|&layer| layer != LayerKind::Beauty);
    }
    first.append(&mut layers);
    first
}

/// An entry point of the shader, with the layout of group 0.
struct Pass {
    pipeline: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
}

impl Pass {
    /// An entry point that writes the picture and reads lists of group 0, by their bindings.
    fn new(
        gpu: &Gpu,
        text: &str,
        entry_point: &'static str,
        reads: &[u32],
        data: &wgpu::BindGroupLayout,
    ) -> Result<Self, GpuError> {
        let lists = reads.iter().map(|&binding| list_entry(binding, true));
        let entries: Vec<_> = lists.chain([list_entry(1, false)]).collect();
        let descriptor = wgpu::BindGroupLayoutDescriptor { label: Some(entry_point), entries: &entries };
        let layout = gpu.attempt("the shader", || gpu.device.create_bind_group_layout(&descriptor))?;
        Ok(Self { pipeline: pipeline(gpu, text.to_owned(), entry_point, &[&layout, data])?, layout })
    }
}

/// The layout of group 1: the data of the scene's effects.
pub(crate) fn data_layout(gpu: &Gpu, shader: &Shader) -> Result<wgpu::BindGroupLayout, GpuError> {
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
    let descriptor = wgpu::BindGroupLayoutDescriptor { label: Some("data"), entries: &entries };
    gpu.attempt("the scene", || gpu.device.create_bind_group_layout(&descriptor))
}

/// Uploads what a shader reads.
pub(crate) fn bind_data(
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
