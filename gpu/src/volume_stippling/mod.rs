//! Lu, Morris, Ebert, Rheingans, Hansen, *Non-Photorealistic Volume Rendering Using Stippling Techniques*, VIS 2002:
//! the test for points that an iso-surface hides ([STIP-15]).

use crate::block::ParamBlock;
use crate::buffers::{buffer, entry, list_entry, pipeline, read, shader_module};
use crate::field::Scales;
use crate::module::module;
use crate::ray::RAY;
use crate::renderer::{bind_data, data_layout};
use crate::shader::{Constant, Shader};
use crate::{Gpu, GpuError, Precision, UploadedVolume, compose, field, ray, surface};
use drypoint_scene::clip::ClipPlanes;
use drypoint_scene::glam::DVec3;
use drypoint_scene::measured::Measured;
use drypoint_scene::points::SurfacePoint;
use drypoint_scene::shot::{NormalDirection, Reconstruction};
use drypoint_scene::space::Grid;
use drypoint_scene::view::View;

/// Number of points in one submission. Each costs three searches through the volume.
const AT_ONCE: usize = 1 << 16;

/// Points of a workgroup.
const GROUP: u32 = 64;

/// An iso-surface that may hide points.
#[derive(Clone, Copy, Debug)]
pub struct Hiding<'a> {
    /// The volume: its grid and its mask.
    pub volume: &'a drypoint_scene::volume::Volume,
    /// The facts of the volume.
    pub measured: &'a Measured,
    /// The reconstruction of the field.
    pub reconstruction: Reconstruction,
    /// The value of the surface.
    pub iso: f64,
    /// Planes that cut the surface.
    pub clip: &'a ClipPlanes,
    /// Whether the camera is perspective.
    pub perspective: bool,
    /// The near distance of a perspective camera, in world units.
    pub near: f64,
}

/// A test for points that an iso-surface hides, for any number of cameras with one projection.
pub struct HiddenPoints {
    gpu: Gpu,
    precision: Precision,
    shader: Shader,
    pipeline: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
    data: wgpu::BindGroup,
    params: wgpu::Buffer,
    grid: Grid,
}

impl HiddenPoints {
    /// Prepares the test for a volume that is already uploaded.
    ///
    /// # Errors
    /// Data do not fit, or the driver refuses.
    pub fn new(gpu: &Gpu, volume: &UploadedVolume, hiding: &Hiding<'_>) -> Result<Self, GpuError> {
        Self::edited(gpu, volume, hiding, &|text| text)
    }

    /// Prepares the test with an edited shader. Tests use it to check that a comparison notices a fault.
    ///
    /// # Errors
    /// See [`HiddenPoints::new`].
    pub fn edited(
        gpu: &Gpu,
        volume: &UploadedVolume,
        hiding: &Hiding<'_>,
        edit: &dyn Fn(String) -> String,
    ) -> Result<Self, GpuError> {
        let precision = volume.precision;
        let shader = shader(hiding, precision);
        let text = edit(shader.text_of_search(precision));
        let data_layout = data_layout(gpu, &shader)?;
        let data = bind_data(gpu, std::slice::from_ref(volume), &shader, &data_layout, precision, None)?.group;
        let entries = [list_entry(0, true), list_entry(1, false), list_entry(2, true)];
        let layout = gpu.attempt("the shader", || {
            gpu.device
                .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("test"), entries: &entries })
        })?;
        let pipeline = pipeline(gpu, &shader_module(gpu, &text)?, "test", &[&layout, &data_layout])?;
        let params = buffer(gpu, "the parameters", &shader.block.bytes(precision), wgpu::BufferUsages::STORAGE)?;
        let grid = hiding.volume.grid().clone();
        Ok(Self { gpu: gpu.clone(), precision, shader, pipeline, layout, data, params, grid })
    }

    /// Returns whether the surface hides each point. A point near the surface is tested at its foot, `in_front` of it in
    /// world units along the outward normal.
    ///
    /// # Errors
    /// Errors of the adapter.
    pub fn hidden(&mut self, view: &View, in_front: f64, points: &[SurfacePoint]) -> Result<Vec<bool>, GpuError> {
        let (gpu, grid) = (&self.gpu, &self.grid);
        let voxel = grid.voxel();
        let block = &mut self.shader.block;
        block.set("in_front", in_front / voxel);
        set_camera(block, view, grid);
        let mut hidden = Vec::with_capacity(points.len());
        for points in points.chunks(AT_ONCE) {
            block.set("points", points.len() as f64);
            let numbers: Vec<f64> = points
                .iter()
                .flat_map(|point| {
                    let [x, y, z] = grid.to_index(point.at).to_array();
                    let [a, b, c] = point.normal.to_array();
                    [x, y, z, a, b, c, point.reach / voxel]
                })
                .collect();
            let storage = wgpu::BufferUsages::STORAGE;
            let list = buffer(gpu, "the points", &self.precision.bytes(&numbers), storage)?;
            let bytes = (points.len() * size_of::<u32>()) as u64;
            let zeros = vec![0; bytes as usize];
            let results = buffer(gpu, "the points", &zeros, storage | wgpu::BufferUsages::COPY_SRC)?;
            let back = gpu.attempt("the points", || {
                gpu.device.create_buffer(&wgpu::BufferDescriptor {
                    label: Some("results"),
                    size: bytes,
                    usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
                    mapped_at_creation: false,
                })
            })?;
            gpu.attempt("the points", || {
                gpu.queue.write_buffer(&self.params, 0, &block.bytes(self.precision));
                let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                    label: Some("test"),
                    layout: &self.layout,
                    entries: &[entry(0, &self.params), entry(1, &results), entry(2, &list)],
                });
                let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
                {
                    let mut run = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
                    run.set_bind_group(0, &group, &[]);
                    run.set_bind_group(1, &self.data, &[]);
                    gpu.dispatch(&mut run, &self.pipeline, [(points.len() as u32).div_ceil(GROUP), 1, 1]);
                }
                encoder.copy_buffer_to_buffer(&results, 0, &back, 0, bytes);
                gpu.queue.submit([encoder.finish()]);
            })?;
            let found = read(gpu, &back, bytes)?;
            for &result in bytemuck::cast_slice::<u8, u32>(&found) {
                match result {
                    1 => hidden.push(false),
                    2 => hidden.push(true),
                    _ => return Err(GpuError::Unfinished { adapter: gpu.name().to_owned() }),
                }
            }
        }
        Ok(hidden)
    }
}

/// Composes the shader of the test. Lengths are in voxels of the volume.
pub(crate) fn shader(hiding: &Hiding<'_>, precision: Precision) -> Shader {
    let &Hiding { volume, measured, reconstruction, iso, clip, perspective, near } = hiding;
    let (grid, mask) = (volume.grid(), volume.mask());
    let mut shader = Shader::default();
    let scales = Scales::new(measured, grid);
    field::kernel::add(&mut shader, reconstruction.kernel, measured, grid);
    let no_normal = compose::no_normal(precision);
    field::gradient::add(&mut shader, reconstruction, NormalDirection::Outward, measured, &scales, no_normal, None);
    shader.add(&[RAY]);
    if let Some(mask) = mask {
        field::mask::add(&mut shader, mask, grid);
    }
    if let Some(bricks) = &measured.bricks {
        ray::add_brick_sizes(&mut shader, bricks);
    }
    let (slack, has_mask) = (ray::rounding(&scales, precision), mask.is_some());
    surface::add_search(&mut shader, reconstruction.kernel, iso, measured, &scales, slack, has_mask);
    if clip.is_empty() {
        shader.add(&[module!("hidden_whole")]);
    } else {
        ray::add_planes(&mut shader, clip, &[], 0);
        surface::add_inside(&mut shader, reconstruction.outside, has_mask);
        shader.add(&[module!("hidden_clipped")]);
    }
    shader.add(&[module!("hidden")]);
    shader.constant("PERSPECTIVE", Constant::Bool(perspective));
    let block = &mut shader.block;
    let ([low, high], voxel) = (grid.index_box(), grid.voxel());
    block.vector("box_low", low);
    block.vector("box_high", high);
    let along = grid.inverse_axes() * voxel;
    for (name, column) in [("voxel_x", 0), ("voxel_y", 1), ("voxel_z", 2)] {
        block.vector(name, along.col(column));
    }
    for name in ["index_eye", "index_forward", "depth_of_index"] {
        block.vector(name, DVec3::ZERO);
    }
    block.number("near", near / voxel);
    block.number("in_front", 0.0);
    block.number("points", 0.0);
    shader
}

/// Sets the numbers of a camera.
fn set_camera(block: &mut ParamBlock, view: &View, grid: &Grid) {
    let voxel = grid.voxel();
    let mut camera = ParamBlock::default();
    camera.vector("index_eye", grid.to_index(view.eye));
    camera.vector("index_forward", grid.inverse_axes() * view.forward * voxel);
    camera.vector("depth_of_index", grid.axes().transpose() * view.forward / voxel);
    block.update(&camera);
}
