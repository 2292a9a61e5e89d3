//! A shot prepared for drawing any number of frames.

use crate::buffers::{buffer, check_lists, list_entry, read, shader_module};
use crate::canvas::Canvas;
use crate::clock::Clock;
use crate::compose::objects::PlacesOfObjects;
use crate::field::Scales;
use crate::picture_buffers::PictureBuffers;
use crate::place::GridPlacement;
use crate::ray::layers::in_picture_units;
use crate::ray::lines::{LINE_STARTS, LINES, LinesOnRays};
use crate::ray::passes::RayPasses;
use crate::ray::present::Presentation;
use crate::shader::{Data, Shader};
use crate::volumeshop::funnel::{FunnelPasses, MAPS};
use crate::volumetric_halos::planes::{self, Extent, HaloPlanes, corners};
use crate::volumetric_halos::seed_boxes;
use crate::{CardInputs, Gpu, GpuError, Precision, UploadedVolume, compose, ray, volumeshop};
use drypoint_scene::fragments::Fragments;
use drypoint_scene::picture::{Layer, LayerKind, Picture};
use drypoint_scene::shot::Shot;
use drypoint_scene::space::Grid;
use std::cell::Cell;
use std::ops::Range;
use std::sync::atomic::AtomicBool;

/// An upper bound on the first channel of a pixel whose rays the driver ended.
const UNFINISHED: f64 = -1.5e30;

/// The order in which rays are drawn.
enum Rays {
    /// Each ray alone, band by band.
    Alone(RayPasses),
    /// All rays together, plane by plane.
    Together(Box<HaloPlanes>),
}

/// A shot that is prepared for drawing any number of times.
pub struct CardRenderer {
    gpu: Gpu,
    precision: Precision,
    shader: Shader,
    /// The text of the pipelines.
    text: String,
    scales: Scales,
    rays: Rays,
    params: wgpu::Buffer,
    data_layout: wgpu::BindGroupLayout,
    data: BoundData,
    picture: PictureBuffers,
    presentation: Option<Presentation>,
    clock: Option<Clock>,
    /// Lines inside the volume; none if no frame can have any.
    lines: Option<LinesOnRays>,
    /// The funnels of smooth cutaways, which are mapped before everything else.
    funnels: Option<FunnelPasses>,
    /// The places of the shot's objects.
    objects: PlacesOfObjects,
    /// The layers that the shot asks for.
    asked: Vec<LayerKind>,
    /// The drawn layers: `asked`, with the beauty first if edges are found in it.
    layers: Vec<LayerKind>,
    size: [usize; 2],
}

impl CardRenderer {
    /// Prepares a shot for volumes that are already uploaded: the picture's, and those that objects have of their own.
    ///
    /// # Errors
    /// An effect has no shader, data do not fit, or the driver refuses.
    pub fn new(gpu: &Gpu, volumes: &[UploadedVolume], shot: &Shot, inputs: &CardInputs<'_>) -> Result<Self, GpuError> {
        Self::edited(gpu, volumes, shot, inputs, &|text| text)
    }

    /// Prepares a shot with an edited shader. Tests use it to check that a comparison notices a fault.
    ///
    /// # Errors
    /// See [`CardRenderer::new`].
    pub fn edited(
        gpu: &Gpu,
        volumes: &[UploadedVolume],
        shot: &Shot,
        inputs: &CardInputs<'_>,
        edit: &dyn Fn(String) -> String,
    ) -> Result<Self, GpuError> {
        let precision = volumes.first().ok_or(GpuError::Material)?.precision;
        let (shader, scales) = compose::shader(shot, &drawn_layers(shot), inputs, precision, gpu.interpolation())?;
        let text = edit(shader.text(precision));
        Self::compiled(gpu, volumes, shot, inputs, (shader, scales, text))
    }

    /// Returns the text of a shot's shader.
    ///
    /// # Errors
    /// An effect has no shader, or data do not fit.
    pub fn text(gpu: &Gpu, precision: Precision, shot: &Shot, inputs: &CardInputs<'_>) -> Result<String, GpuError> {
        let composed = compose::shader(shot, &drawn_layers(shot), inputs, precision, gpu.interpolation());
        composed.map(|(shader, _)| shader.text(precision))
    }

    /// Compiles the pipelines of a shot and uploads its data.
    fn compiled(
        gpu: &Gpu,
        volumes: &[UploadedVolume],
        shot: &Shot,
        inputs: &CardInputs<'_>,
        (shader, scales, text): (Shader, Scales, String),
    ) -> Result<Self, GpuError> {
        let precision = volumes.first().ok_or(GpuError::Material)?.precision;
        let layers = drawn_layers(shot);
        let data_layout = data_layout(gpu, &shader)?;
        let data = bind_data(gpu, volumes, &shader, &data_layout, precision, None)?;
        let grid = inputs.data.main.volume.grid();
        let lines = inputs.has_lines.then(|| LinesOnRays::new(shot, grid));
        let objects = PlacesOfObjects::new(shot, inputs)?;
        let module = shader_module(gpu, &text)?;
        let funnels = FunnelPasses::new(gpu, shot, &module, &data_layout, precision)?;
        let of_data = shader.data.iter().filter(|(_, _, data)| data.is_list()).count();
        let rays = if shot.halos.list.is_empty() {
            let of_lines = lines.iter().flat_map(|_| [LINE_STARTS, LINES]);
            let further: Vec<u32> = of_lines.chain(funnels.as_ref().map(|_| MAPS)).collect();
            // Scalars, the picture, and the picture before refinement.
            check_lists(gpu, of_data + 2 + usize::from(shot.refine_above.is_some()) + further.len())?;
            Rays::Alone(RayPasses::new(gpu, (shot, grid), &module, &data_layout, &layers, &further)?)
        } else {
            let extent = extent(shot, inputs, &objects, (&scales, precision))?;
            let (shader, further) = ((&shader, &module), funnels.as_ref().map(|_| MAPS));
            check_lists(gpu, of_data + planes::LISTS + usize::from(further.is_some()))?;
            let planes = HaloPlanes::new(gpu, shot, (grid, extent), further, shader, &data_layout, precision)?;
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
            gpu: gpu.clone(),
            precision,
            shader,
            text,
            scales,
            rays,
            params,
            data_layout,
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

    /// Takes another shot for the following frames, by the arguments of [`CardRenderer::new`]. Lines inside the volume
    /// are removed.
    ///
    /// Pipelines are compiled only if the text of the shader, the layers or funnels differ, or the size of a picture that
    /// [has one](Self::takes_sizes). Other numbers and colours, and moved clip planes, are uploaded: scalars, and the lists that
    /// differ.
    ///
    /// # Errors
    /// See [`CardRenderer::new`]. The renderer then keeps its previous shot.
    pub fn change(&mut self, volumes: &[UploadedVolume], shot: &Shot, inputs: &CardInputs<'_>) -> Result<(), GpuError> {
        let layers = drawn_layers(shot);
        let (shader, scales) = compose::shader(shot, &layers, inputs, self.precision, self.gpu.interpolation())?;
        let text = shader.text(self.precision);
        let stays = text == self.text
            && layers == self.layers
            && (shot.view.size == self.size || self.takes_sizes())
            && shader.binds_as(&self.shader)
            && inputs.has_lines == self.lines.is_some()
            && FunnelPasses::fit(self.funnels.as_ref(), shot)
            && match &self.rays {
                Rays::Alone(passes) => shot.halos.list.is_empty() && passes.fit(shot),
                Rays::Together(_) => true,
            };
        if !stays {
            *self = Self::compiled(&self.gpu, volumes, shot, inputs, (shader, scales, text))?;
            return Ok(());
        }
        let objects = PlacesOfObjects::new(shot, inputs)?;
        let before = Some((&self.shader, &self.data));
        let data = bind_data(&self.gpu, volumes, &shader, &self.data_layout, self.precision, before)?;
        let grid = inputs.data.main.volume.grid();
        match &mut self.rays {
            Rays::Alone(passes) => passes.turn(shot, grid),
            Rays::Together(planes) => {
                let extent = extent(shot, inputs, &objects, (&scales, self.precision))?;
                planes.turn(&self.gpu, shot, (grid, Some(extent)))?;
            }
        }
        self.lines = inputs.has_lines.then(|| LinesOnRays::new(shot, grid));
        self.data = data;
        (self.shader, self.scales, self.objects) = (shader, scales, objects);
        self.asked.clone_from(&shot.layers);
        self.resize(shot)
    }

    /// Whether pictures of other sizes and other rays of pixels need no other pipelines. Maps of funnels have one size, and so
    /// has a picture behind the volume.
    pub fn takes_sizes(&self) -> bool {
        let has_pixels = self.shader.data.iter().any(|(binding, ..)| *binding == ray::BACKGROUND);
        self.funnels.is_none() && !has_pixels
    }

    /// Takes the size and the rays of a shot, with buffers of their own if the size differs.
    fn resize(&mut self, shot: &Shot) -> Result<(), GpuError> {
        if shot.view.size != self.size {
            let refines = self.picture.before.is_some();
            let bytes_a_row = self.picture.bytes_a_row / self.size[0] as u64 * shot.view.size[0] as u64;
            self.picture = PictureBuffers::new(&self.gpu, refines, bytes_a_row, shot.view.size[1])?;
            self.size = shot.view.size;
        }
        self.shader.block.update(&ray::size(shot));
        Ok(())
    }

    /// Takes the camera and the lights of another shot for the following frames, and its size and rays if the renderer
    /// [takes](Self::takes_sizes) them. Nothing else may differ between the shots.
    ///
    /// # Errors
    /// There are more sample planes than the shader can count, or images of halos do not fit.
    pub fn turn(&mut self, shot: &Shot, grid: &Grid) -> Result<(), GpuError> {
        let place = GridPlacement::own(shot, grid);
        let blocks = [compose::camera(shot, &place)?, compose::objects::camera(shot, &self.objects, &place)?];
        match &mut self.rays {
            Rays::Alone(passes) => passes.turn(shot, grid),
            Rays::Together(planes) => planes.turn(&self.gpu, shot, (grid, None))?,
        }
        blocks.iter().for_each(|block| self.shader.block.update(block));
        let is_lighting = |(_, _, data): &(u32, &str, Data)| matches!(data, Data::Lighting(_));
        let tables = self.shader.data.iter().zip(&self.data.lists).filter(|(data, _)| is_lighting(data));
        for (table, cells) in
            tables.filter_map(|(_, list)| list.as_ref()).zip(volumeshop::lighting_cells(self.objects.drawn(shot)))
        {
            self.gpu.queue.write_buffer(table, 0, &self.precision.bytes(&cells));
        }
        if let Some(lines) = &mut self.lines {
            lines.turn(shot, grid);
        }
        self.resize(shot)
    }

    /// Puts lines for the current camera inside the following frames, or removes them ([HATCH-14] d).
    ///
    /// # Errors
    /// The shot was prepared without lines.
    pub fn merge(&mut self, lines: Option<Fragments>) -> Result<(), GpuError> {
        match &mut self.lines {
            Some(on_rays) => on_rays.lines = lines,
            None if lines.is_some() => return Err(GpuError::NoLines),
            None => {}
        }
        Ok(())
    }

    /// Draws one frame. `progress` receives the share of the picture that is done.
    ///
    /// # Errors
    /// The device is lost, or has no memory for the picture.
    pub fn frame(&mut self, progress: &dyn Fn(f64)) -> Result<Picture, GpuError> {
        let picture = self.frame_until(progress, &AtomicBool::new(false))?;
        Ok(picture.unwrap_or_else(|| unreachable!("nothing stops the frame")))
    }

    /// Draws one frame. Returns none if `stop` becomes true before the last band of rows or the last planes.
    ///
    /// # Errors
    /// See [`CardRenderer::frame`].
    pub fn frame_until(&mut self, progress: &dyn Fn(f64), stop: &AtomicBool) -> Result<Option<Picture>, GpuError> {
        let [width, height] = self.size;
        let kinds: Vec<LayerKind> =
            self.layers.iter().flat_map(|&layer| std::iter::repeat_n(layer, layer.channels().len())).collect();
        let mut planes = vec![vec![0.0; width * height]; kinds.len()];
        if matches!(self.rays, Rays::Together(_)) {
            self.fits_whole()?;
        }
        for first in (0..height).step_by(self.picture.rows) {
            let rows = first..(first + self.picture.rows).min(height);
            if !self.draw_rows(rows.clone(), Some((progress, stop)))? {
                return Ok(None);
            }
            let bytes = self.picture.bytes_a_row * rows.len() as u64;
            let numbers = self.precision.numbers(&read(&self.gpu, &self.picture.back, bytes)?);
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
        Ok(Some(Picture { width, height, layers }))
    }

    /// Draws one frame into a viewer's texture, without waiting for it: the beauty in premultiplied linear light. The texture
    /// is of `Rgba16Float`, at least as large as the picture, and allows `STORAGE_BINDING`.
    ///
    /// # Errors
    /// The shot has no beauty, the picture does not fit in one buffer, or the device is lost.
    pub fn frame_into(&mut self, target: &wgpu::TextureView) -> Result<(), GpuError> {
        self.fits_whole()?;
        self.draw_rows(0..self.size[1], None)?;
        let presentation = match self.presentation.take() {
            Some(presentation) => presentation,
            None => {
                let size = self.shader.block.place(ray::WIDTH).ok_or(GpuError::Material)?;
                Presentation::new(&self.gpu, self.precision, size, &self.layers)?
            }
        };
        presentation.run(&self.gpu, [&self.picture.out, &self.params], self.size, target)?;
        self.presentation = Some(presentation);
        Ok(())
    }

    /// Waits for the last frame and returns its seconds by the adapter's clock, from the first ray to the last. Returns
    /// none if the adapter has no such clock.
    ///
    /// # Errors
    /// The device is lost.
    pub fn seconds(&self) -> Result<Option<f64>, GpuError> {
        self.clock.as_ref().map(|clock| clock.seconds(&self.gpu)).transpose()
    }

    /// Draws rows into the picture's buffer, and copies them to the buffer that is read back. Returns whether all were
    /// drawn. `steps` are a listener and a flag that stops the frame.
    fn draw_rows(&mut self, rows: Range<usize>, steps: Option<(&dyn Fn(f64), &AtomicBool)>) -> Result<bool, GpuError> {
        let Self { gpu, params, data: BoundData { group: data, .. }, picture, clock, .. } = self;
        let (gpu, stopped) = (&*gpu, Cell::new(false));
        let canvas = Canvas { gpu, params, data, picture, clock: clock.as_ref(), steps, stopped: &stopped };
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
                passes.draw(&canvas, (&mut self.shader.block, self.precision), &further, rows)?;
            }
            Rays::Together(planes) => {
                canvas.write_params(&self.shader.block, self.precision)?;
                planes.draw(&canvas, maps)?;
            }
        }
        Ok(!stopped.get())
    }

    /// Fails for a picture that does not fit in one buffer.
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

/// The layers that a shader draws. If edges are found in the beauty, it comes first.
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

/// The extent of everything visible beside the volume, and of seeds.
fn extent(
    shot: &Shot,
    inputs: &CardInputs<'_>,
    objects: &PlacesOfObjects,
    (scales, precision): (&Scales, Precision),
) -> Result<Extent, GpuError> {
    Ok(Extent {
        others: inputs.data.meshes.iter().flat_map(corners).chain(objects.corners()).collect(),
        seeds: seed_boxes(shot, inputs.object(0)?.measured, scales, precision),
    })
}

/// The data that a shader reads, on the card.
pub(crate) struct BoundData {
    /// Group 1.
    pub(crate) group: wgpu::BindGroup,
    /// The lists among the shader's data; none for other data.
    lists: Vec<Option<wgpu::Buffer>>,
}

/// Uploads the data that a shader reads. `before` is a shader with the same bindings and its data, whose equal lists
/// are kept.
pub(crate) fn bind_data(
    gpu: &Gpu,
    volumes: &[UploadedVolume],
    shader: &Shader,
    layout: &wgpu::BindGroupLayout,
    precision: Precision,
    before: Option<(&Shader, &BoundData)>,
) -> Result<BoundData, GpuError> {
    enum Resource<'v> {
        Texture(&'v wgpu::TextureView),
        Sampler(wgpu::Sampler),
        List(wgpu::Buffer),
    }
    let volume = |place: usize| volumes.get(place).ok_or(GpuError::Material);
    let mut resources = Vec::new();
    for (i, (binding, what, data)) in shader.data.iter().enumerate() {
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
        let same = before.filter(|(of, _)| data.is_constant() && of.data[i].2 == *data);
        if let Some(list) = same.and_then(|(_, bound)| bound.lists[i].clone()) {
            resources.push((*binding, Resource::List(list)));
            continue;
        }
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
            Data::Reals(values) | Data::Lighting(values) => list(&precision.bytes(values))?,
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
    let lists = resources.into_iter().map(|(_, resource)| match resource {
        Resource::List(list) => Some(list),
        Resource::Texture(_) | Resource::Sampler(_) => None,
    });
    Ok(BoundData { group, lists: lists.collect() })
}
