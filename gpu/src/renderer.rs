//! Pictures of a shot, any number of them.

use crate::buffers::{buffer, list_entry, read};
use crate::canvas::Canvas;
use crate::clock::Clock;
use crate::compose::objects::PlacesOfObjects;
use crate::field::Scales;
use crate::picture_buffers::PictureBuffers;
use crate::place::Place;
use crate::ray::layers::in_picture_units;
use crate::ray::lines::{LINE_STARTS, LINES, LinesOnRays};
use crate::ray::passes::RayPasses;
use crate::ray::present::Presentation;
use crate::shader::{Data, Shader};
use crate::volumeshop::funnel::{FunnelPasses, MAPS};
use crate::volumetric_halos::planes::{HaloPlanes, corners};
use crate::{CardInputs, Gpu, GpuError, Precision, Volume, compose, volumeshop};
use drypoint_scene::fragments::Fragments;
use drypoint_scene::picture::{Layer, LayerKind, Picture};
use drypoint_scene::shot::Shot;
use drypoint_scene::space::Grid;
use std::ops::Range;

/// The first channel of a pixel whose rays the driver ended lies below.
const UNFINISHED: f64 = -1.5e30;

/// The order in which rays are drawn.
enum Rays {
    /// Each ray alone, band by band.
    Alone(RayPasses),
    /// All rays together, plane by plane.
    Together(Box<HaloPlanes>),
}

/// A shot that is ready to be drawn any number of times.
pub struct Renderer<'g> {
    gpu: &'g Gpu,
    precision: Precision,
    shader: Shader,
    scales: Scales,
    rays: Rays,
    params: wgpu::Buffer,
    data: BoundData,
    picture: PictureBuffers,
    presentation: Option<Presentation>,
    clock: Option<Clock>,
    /// Lines inside the volume; none where no frame can have any.
    lines: Option<LinesOnRays>,
    /// The funnels of smooth cutaways, which are mapped before all else.
    funnels: Option<FunnelPasses>,
    /// The places of the shot's objects.
    objects: PlacesOfObjects,
    /// The layers that the shot asks for.
    asked: Vec<LayerKind>,
    /// Those, with the beauty first where edges are found by it.
    layers: Vec<LayerKind>,
    size: [usize; 2],
}

impl<'g> Renderer<'g> {
    /// Prepares a shot for volumes that are already uploaded: the picture's, and those that objects have of their own.
    ///
    /// # Errors
    /// An effect without a shader, data that do not fit, a driver that refuses.
    pub fn new(gpu: &'g Gpu, volumes: &[Volume], shot: &Shot, inputs: &CardInputs<'_>) -> Result<Self, GpuError> {
        Self::edited(gpu, volumes, shot, inputs, &|text| text)
    }

    /// Prepares a shot with an edited shader, for tests of whether a comparison notices a fault.
    ///
    /// # Errors
    /// See [`Renderer::new`].
    pub fn edited(
        gpu: &'g Gpu,
        volumes: &[Volume],
        shot: &Shot,
        inputs: &CardInputs<'_>,
        edit: &dyn Fn(String) -> String,
    ) -> Result<Self, GpuError> {
        let precision = volumes.first().ok_or(GpuError::Material)?.precision;
        let layers = drawn_layers(shot);
        let (shader, scales) = compose::shader(shot, &layers, inputs, precision, gpu.interpolation())?;
        let text = edit(shader.text(precision));
        let data_layout = data_layout(gpu, &shader)?;
        let data = bind_data(gpu, volumes, &shader, &data_layout, precision)?;
        let grid = inputs.data.main.volume.grid();
        let lines = inputs.has_lines.then(|| LinesOnRays::new(shot, grid));
        let objects = PlacesOfObjects::new(shot, inputs)?;
        let funnels = FunnelPasses::new(gpu, shot, &text, &data_layout, precision)?;
        let rays = if shot.halos.list.is_empty() {
            let of_lines = lines.iter().flat_map(|_| [LINE_STARTS, LINES]);
            let further: Vec<u32> = of_lines.chain(funnels.as_ref().map(|_| MAPS)).collect();
            Rays::Alone(RayPasses::new(gpu, (shot, grid), &text, &data_layout, &layers, &further)?)
        } else {
            let others = inputs.data.meshes.iter().flat_map(corners).chain(objects.corners()).collect();
            let (shader, further) = ((&shader, text.as_str()), funnels.as_ref().map(|_| MAPS));
            let planes = HaloPlanes::new(gpu, shot, (grid, others), further, shader, &data_layout, precision)?;
            Rays::Together(Box::new(planes))
        };
        let params = buffer(
            gpu,
            "the parameters",
            &shader.block.bytes(precision),
            wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
        )?;
        let channels: usize = layers.iter().map(|layer| layer.channels().len()).sum();
        let bytes_a_row = (shot.view.size[0] * channels) as u64 * precision.size();
        let refines = shot.refine_above.is_some();
        Ok(Self {
            gpu,
            precision,
            shader,
            scales,
            rays,
            params,
            data,
            picture: PictureBuffers::new(gpu, refines, bytes_a_row, shot.view.size[1])?,
            presentation: None,
            clock: Clock::new(gpu)?,
            lines,
            objects,
            funnels,
            asked: shot.layers.clone(),
            layers,
            size: shot.view.size,
        })
    }

    /// Takes the camera and the lights of another shot for the frames that follow. The shots may differ in nothing else.
    ///
    /// # Errors
    /// More sample planes than the shader counts.
    pub fn turn(&mut self, shot: &Shot, grid: &Grid) -> Result<(), GpuError> {
        let place = Place::own(shot, grid);
        self.shader.block.update(&compose::camera(shot, &place)?);
        self.shader.block.update(&compose::objects::camera(shot, &self.objects, &place)?);
        for (table, cells) in self.data.lighting.iter().zip(volumeshop::lighting_cells(shot)) {
            self.gpu.queue.write_buffer(table, 0, &self.precision.bytes(&cells));
        }
        if let Some(lines) = &mut self.lines {
            lines.turn(shot, grid);
        }
        if let Rays::Together(planes) = &mut self.rays {
            planes.turn(shot, grid);
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
        if matches!(self.rays, Rays::Together(_)) {
            self.fits_whole()?;
        }
        for first in (0..height).step_by(self.picture.rows) {
            let rows = first..(first + self.picture.rows).min(height);
            self.draw_rows(rows.clone(), Some(progress))?;
            let bytes = self.picture.bytes_a_row * rows.len() as u64;
            let numbers = self.precision.numbers(&read(self.gpu, &self.picture.back, bytes)?);
            for (i, pixel) in numbers.chunks_exact(kinds.len()).take(width * rows.len()).enumerate() {
                if pixel[0] < UNFINISHED {
                    return Err(GpuError::Unfinished { adapter: self.gpu.name().to_owned() });
                }
                for (plane, &number) in planes.iter_mut().zip(pixel) {
                    plane[first * width + i] = number;
                }
            }
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

    /// Draws one frame into a viewer's texture, without waiting for it: the beauty in premultiplied linear light. The texture
    /// is of `Rgba16Float`, at least as large as the picture, and allows `STORAGE_BINDING`.
    ///
    /// # Errors
    /// A shot without a beauty, a picture that does not fit in one buffer, and a device that is lost.
    pub fn frame_into(&mut self, target: &wgpu::TextureView) -> Result<(), GpuError> {
        self.fits_whole()?;
        self.draw_rows(0..self.size[1], None)?;
        let presentation = match self.presentation.take() {
            Some(presentation) => presentation,
            None => Presentation::new(self.gpu, self.precision, self.size, &self.layers)?,
        };
        presentation.run(self.gpu, &self.picture.out, target)?;
        self.presentation = Some(presentation);
        Ok(())
    }

    /// Waits for the last frame and returns its seconds by the adapter's clock, from the first ray to the last; none where
    /// the adapter has no such clock.
    ///
    /// # Errors
    /// A device that is lost.
    pub fn seconds(&self) -> Result<Option<f64>, GpuError> {
        self.clock.as_ref().map(|clock| clock.seconds(self.gpu)).transpose()
    }

    /// Draws rows into the picture's buffer, and copies them to the one that is read back.
    fn draw_rows(&mut self, rows: Range<usize>, progress: Option<&dyn Fn(f64)>) -> Result<(), GpuError> {
        let Self { gpu, params, data: BoundData { group: data, .. }, picture, clock, .. } = self;
        let canvas = Canvas { gpu, params, data, picture, clock: clock.as_ref(), progress };
        if let Some(funnels) = &self.funnels {
            canvas.write_params(&self.shader.block, self.precision)?;
            funnels.draw(&canvas)?;
        }
        let maps = self.funnels.as_ref().map(|funnels| (MAPS, funnels.maps()));
        match &self.rays {
            Rays::Alone(passes) => {
                let lines = self.lines.as_ref().map(|lines| lines.buffers(gpu, self.precision)).transpose()?;
                let of_lines = lines.iter().flat_map(|[starts, lines]| [(LINE_STARTS, starts), (LINES, lines)]);
                let further: Vec<_> = of_lines.chain(maps).collect();
                passes.draw(&canvas, (&mut self.shader.block, self.precision), &further, rows)
            }
            Rays::Together(planes) => {
                canvas.write_params(&self.shader.block, self.precision)?;
                planes.draw(&canvas, maps)
            }
        }
    }

    /// Refuses a picture that does not fit in one buffer.
    fn fits_whole(&self) -> Result<(), GpuError> {
        let [_, height] = self.size;
        if self.picture.rows >= height {
            return Ok(());
        }
        Err(GpuError::TooManyBytes {
            what: "the picture",
            bytes: self.picture.bytes_a_row * height as u64,
            most: self.gpu.device.limits().max_storage_buffer_binding_size,
            adapter: self.gpu.name().to_owned(),
        })
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

/// The layout of group 1: the data of the scene's effects.
pub(crate) fn data_layout(gpu: &Gpu, shader: &Shader) -> Result<wgpu::BindGroupLayout, GpuError> {
    let filters = shader.data.iter().any(|(_, _, data)| *data == Data::Sampler);
    let entry = |(binding, _, data): &(u32, &'static str, Data)| {
        let ty = match data {
            Data::Numbers(_) | Data::Voxels(_) | Data::Smoothed(_) => wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable: filters },
                view_dimension: wgpu::TextureViewDimension::D3,
                multisampled: false,
            },
            Data::Sampler => wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
            Data::Reals(_) | Data::Lighting(_) | Data::Words(_) | Data::Texels(_) => return list_entry(*binding, true),
        };
        wgpu::BindGroupLayoutEntry { binding: *binding, visibility: wgpu::ShaderStages::COMPUTE, ty, count: None }
    };
    let entries: Vec<_> = shader.data.iter().map(entry).collect();
    let descriptor = wgpu::BindGroupLayoutDescriptor { label: Some("data"), entries: &entries };
    gpu.attempt("the scene", || gpu.device.create_bind_group_layout(&descriptor))
}

/// The data that a shader reads, on the card.
pub(crate) struct BoundData {
    /// Group 1.
    pub(crate) group: wgpu::BindGroup,
    /// The cells of the lighting tables that the shader reads.
    lighting: Vec<wgpu::Buffer>,
}

/// Uploads what a shader reads.
pub(crate) fn bind_data(
    gpu: &Gpu,
    volumes: &[Volume],
    shader: &Shader,
    layout: &wgpu::BindGroupLayout,
    precision: Precision,
) -> Result<BoundData, GpuError> {
    enum Resource<'v> {
        Texture(&'v wgpu::TextureView),
        Sampler(wgpu::Sampler),
        List(wgpu::Buffer),
    }
    let volume = |place: usize| volumes.get(place).ok_or(GpuError::Material);
    let (mut resources, mut lighting) = (Vec::new(), Vec::new());
    for (binding, what, data) in &shader.data {
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
        let list = |bytes: &[u8]| buffer(gpu, what, bytes, usage).map(Resource::List);
        let resource = match data {
            Data::Numbers(place) => Resource::Texture(&volume(*place)?.numbers),
            Data::Voxels(place) => {
                let volume = volume(*place)?;
                Resource::Texture(volume.voxels.as_ref().unwrap_or(&volume.numbers))
            }
            Data::Smoothed(place) => {
                let volume = volume(*place)?;
                Resource::Texture(volume.smoothed.as_ref().unwrap_or(&volume.numbers))
            }
            Data::Sampler => Resource::Sampler(gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some(what),
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                ..Default::default()
            })),
            Data::Reals(values) => list(&precision.bytes(values))?,
            Data::Lighting(cells) => {
                let table = list(&precision.bytes(cells))?;
                lighting.extend(if let Resource::List(table) = &table { Some(table.clone()) } else { None });
                table
            }
            Data::Words(words) => list(bytemuck::cast_slice(words))?,
            Data::Texels(texels) => list(bytemuck::cast_slice(texels))?,
        };
        resources.push((*binding, resource));
    }
    let mut entries = Vec::new();
    for (binding, resource) in &resources {
        let resource = match resource {
            Resource::Texture(view) => wgpu::BindingResource::TextureView(view),
            Resource::Sampler(sampler) => wgpu::BindingResource::Sampler(sampler),
            Resource::List(buffer) => buffer.as_entire_binding(),
        };
        entries.push(wgpu::BindGroupEntry { binding: *binding, resource });
    }
    let group = gpu.attempt("the scene", || {
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some("data"), layout, entries: &entries })
    })?;
    Ok(BoundData { group, lighting })
}
