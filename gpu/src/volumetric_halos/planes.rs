//! The passes of a picture with halos, one group of planes after the other ([HALO-1], [HALO-8], [HALO-9]).

use super::groups::{PlaneGroup, SeedBoxes, groups, reached, seed_planes};
use super::stages::{SOURCE, Stages, TILE, TILE_BYTES, dispatches};
use crate::buffers::{buffer, check_bytes, entry, list_entry, pipeline};
use crate::canvas::Canvas;
use crate::place::anchor;
use crate::shader::Shader;
use crate::{Gpu, GpuError, Precision, ray};
use drypoint_scene::glam::DVec3;
use drypoint_scene::mesh::TriangleMesh;
use drypoint_scene::picture::LayerKind;
use drypoint_scene::shot::halo::{split_distance, tap_distance};
use drypoint_scene::shot::{HaloParams, Shot};
use drypoint_scene::space::Grid;

/// Pixels along the side of a workgroup of rays.
const GROUP: u32 = 8;

/// About the largest number of pixels that the passes of one submission write. It keeps drivers from assuming a fault.
const PIXELS_AT_ONCE: u64 = 1 << 26;

/// Bytes of a group of planes as a shader reads it.
const GROUP_BYTES: u64 = 60;

/// Lists of a pass over images, beside the scene's: scalars and the picture, groups of planes, states of rays and tiles, taps,
/// and three images.
pub(crate) const LISTS: usize = 2 + 8 + 3;

/// The name of the list of groups in errors.
const GROUP_LIST: &str = "the groups of planes";

/// Rays across and down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct ImageSize {
    /// Rays of the picture.
    rays: [usize; 2],
    /// Rays of the images, with the guard band.
    image: [usize; 2],
    /// Rays of the guard band on each side.
    guard: usize,
    /// Tiles across and down.
    tiles: [usize; 2],
}

impl ImageSize {
    /// The size of a shot's images.
    fn new(shot: &Shot) -> Self {
        let guard = ray::guard(shot);
        let rays = shot.view.size.map(|n| n * shot.rays_across);
        // Images that do not fit are refused by their bytes.
        let image = rays.map(|n| n.saturating_add(guard.saturating_mul(2)));
        Self { rays, image, guard, tiles: image.map(|n| n.div_ceil(TILE)) }
    }

    /// The distance of taps, as whole rays and a fraction.
    fn taps(&self, halo: &HaloParams, exponent: u32) -> (usize, f64) {
        split_distance(tap_distance(halo.spread.stretch, exponent), self.image[0].max(self.image[1]))
    }

    /// Rays that the taps of each pass of a halo reach, by their exponents.
    fn reaches(&self, halo: &HaloParams) -> Vec<usize> {
        let taps = (0..halo.spread.passes).map(|exponent| self.taps(halo, exponent));
        taps.map(|(whole, fraction)| whole + usize::from(fraction > 0.0)).collect()
    }

    /// The list of taps as a shader reads it: N of each halo, then whole rays and fractions by their exponents.
    fn tap_list(&self, halos: &[HaloParams]) -> Vec<f64> {
        let of_halo = |halo: &HaloParams| {
            let taps = (0..SOURCE).map(|exponent| self.taps(halo, exponent));
            let numbers = taps.flat_map(|(whole, fraction)| [whole as f64, fraction]);
            std::iter::once(f64::from(halo.spread.passes)).chain(numbers).collect::<Vec<_>>()
        };
        halos.iter().flat_map(of_halo).collect()
    }
}

/// The corners of the box about a mesh.
pub(crate) fn corners(mesh: &TriangleMesh) -> [DVec3; 8] {
    let all = || mesh.positions().iter().copied();
    let ends = [all().reduce(DVec3::min), all().reduce(DVec3::max)].map(Option::unwrap_or_default);
    std::array::from_fn(|i| DVec3::new(ends[i & 1].x, ends[i >> 1 & 1].y, ends[i >> 2].z))
}

/// Places that decide which planes rays visit.
pub(crate) struct Extent {
    /// Corners of boxes about all that can be seen beside the volume.
    pub(crate) others: Vec<DVec3>,
    /// Boxes about all samples that can seed; none if any sample can.
    pub(crate) seeds: Option<SeedBoxes>,
}

/// Halos of a picture on a graphics card: images and states of rays, and the passes over them.
pub(crate) struct HaloPlanes {
    precision: Precision,
    size: ImageSize,
    pixels: [usize; 2],
    halos: Vec<HaloParams>,
    watched: Vec<bool>,
    extent: Extent,
    groups: Vec<PlaneGroup>,
    /// The dispatches after each group.
    stages: Vec<Stages>,
    anchor: i64,
    start: wgpu::ComputePipeline,
    visit: wgpu::ComputePipeline,
    spread: wgpu::ComputePipeline,
    finish: wgpu::ComputePipeline,
    params_layout: wgpu::BindGroupLayout,
    state_layout: wgpu::BindGroupLayout,
    image_layout: wgpu::BindGroupLayout,
    /// Numbers that rays of the picture keep, and those of seeds' rays.
    kept: [usize; 2],
    images: Images,
}

/// Images and states of rays.
struct Images {
    /// Numbers of rays, numbers of seeds' rays, then S, H and O.
    state: [wgpu::Buffer; 5],
    /// From the seeds to H₀.
    source: wgpu::BindGroup,
    /// From H₀ to the first of two images that passes write in turn.
    first: wgpu::BindGroup,
    /// From the first image to the second one, and back.
    turns: [wgpu::BindGroup; 2],
}

impl HaloPlanes {
    /// Makes the images and the passes of a shot. `further` is a further binding that rays of the picture
    /// read.
    pub(crate) fn new(
        gpu: &Gpu,
        shot: &Shot,
        (grid, extent): (&Grid, Extent),
        further: Option<u32>,
        (shader, module): (&Shader, &wgpu::ShaderModule),
        data_layout: &wgpu::BindGroupLayout,
        precision: Precision,
    ) -> Result<Self, GpuError> {
        let (size, halos) = (ImageSize::new(shot), shot.halos.list.clone());
        let kept = shader.stages.halos.as_ref().map(|stages| [stages.kept_numbers(), stages.seed_kept.len()]);
        let (kept, stages) = (kept.unwrap_or_default(), stages(&halos, size, precision));
        let layout = |label, entries: &[wgpu::BindGroupLayoutEntry]| {
            let descriptor = wgpu::BindGroupLayoutDescriptor { label: Some(label), entries };
            gpu.attempt("the shader", || gpu.device.create_bind_group_layout(&descriptor))
        };
        let image_layout = layout("images", &[list_entry(0, true), list_entry(1, true), list_entry(2, false)])?;
        let images = Images::new(gpu, &image_layout, (size, precision), halos.len(), stages.len(), kept)?;
        let mut of_picture = vec![list_entry(0, true), list_entry(1, false)];
        of_picture.extend(further.map(|binding| list_entry(binding, true)));
        let params_layout = layout("parameters", &of_picture)?;
        let group = wgpu::BindGroupLayoutEntry {
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Storage { read_only: true },
                has_dynamic_offset: true,
                min_binding_size: wgpu::BufferSize::new(GROUP_BYTES),
            },
            ..list_entry(0, true)
        };
        let of_state = (1..=7).map(|binding| list_entry(binding, binding == 7));
        let state_layout = layout("rays", &std::iter::once(group).chain(of_state).collect::<Vec<_>>())?;
        let groups = [&params_layout, data_layout, &state_layout, &image_layout];
        let pass = |entry_point| pipeline(gpu, module, entry_point, &groups[..3]);
        let watched = (0..halos.len()).map(|i| shot.layers.contains(&LayerKind::Halo(i))).collect();
        let mut planes = Self {
            precision,
            size,
            pixels: shot.view.size,
            halos,
            watched,
            extent,
            groups: Vec::new(),
            stages,
            anchor: 0,
            start: pass("halo_start")?,
            visit: pass("halo_planes")?,
            spread: pipeline(gpu, module, "halo_spread", &groups)?,
            finish: pass("halo_pixels")?,
            params_layout,
            state_layout,
            image_layout,
            kept,
            images,
        };
        planes.look(shot, grid);
        Ok(planes)
    }

    /// Takes another shot with the same text and layers, and places of its own if it is not only seen from another camera.
    pub(crate) fn turn(
        &mut self,
        gpu: &Gpu,
        shot: &Shot,
        (grid, extent): (&Grid, Option<Extent>),
    ) -> Result<(), GpuError> {
        let (size, halos) = (ImageSize::new(shot), &shot.halos.list);
        let stages = stages(halos, size, self.precision);
        if size != self.size || stages.len() != self.stages.len() {
            let of = (size, self.precision);
            self.images = Images::new(gpu, &self.image_layout, of, halos.len(), stages.len(), self.kept)?;
        }
        self.halos.clone_from(halos);
        (self.size, self.stages, self.pixels) = (size, stages, shot.view.size);
        if let Some(extent) = extent {
            self.extent = extent;
        }
        self.look(shot, grid);
        Ok(())
    }

    /// Groups the planes that a camera sees.
    fn look(&mut self, shot: &Shot, grid: &Grid) {
        let seeds = self.extent.seeds.as_ref().map(|boxes| seed_planes(shot, grid, boxes));
        let can_seed = |[near, far]: [i64; 2]| {
            let meets = |&[first, last]: &[i64; 2]| near <= last && first <= far;
            seeds.as_ref().is_none_or(|ranges| ranges.iter().any(meets))
        };
        self.groups = groups(&self.halos, |i| self.watched[i], reached(shot, grid, &self.extent.others), can_seed);
        self.anchor = anchor(shot, grid) as i64;
    }

    /// Draws a frame. `further` is the list of the further binding.
    pub(crate) fn draw(&self, canvas: &Canvas<'_>, further: Option<(u32, &wgpu::Buffer)>) -> Result<(), GpuError> {
        let gpu = canvas.gpu;
        let stride = GROUP_BYTES.next_multiple_of(gpu.device.limits().min_storage_buffer_offset_alignment.into());
        let count = (self.groups.len() * self.stages.len()) as u64;
        check_bytes(gpu, GROUP_LIST, count.saturating_mul(stride))?;
        let storage = wgpu::BufferUsages::STORAGE;
        let group_list = buffer(gpu, GROUP_LIST, &self.records(stride), storage)?;
        let flags = vec![0; 4 * (2 + self.halos.len()) * self.size.tiles[0] * self.size.tiles[1]];
        let flags = buffer(gpu, "the list of tiles", &flags, storage)?;
        let taps = buffer(gpu, "the taps", &self.precision.bytes(&self.size.tap_list(&self.halos)), storage)?;
        let [params, state] = gpu.attempt("the halos", || {
            let mut params_entries = vec![entry(0, canvas.params), entry(1, &canvas.picture.out)];
            params_entries.extend(further.map(|(binding, list)| entry(binding, list)));
            let planes =
                wgpu::BufferBinding { buffer: &group_list, offset: 0, size: wgpu::BufferSize::new(GROUP_BYTES) };
            let planes = wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::Buffer(planes) };
            let state = (1..).zip(self.images.state.iter().chain([&flags, &taps]));
            let state = state.map(|(binding, buffer)| entry(binding, buffer));
            let state_entries: Vec<_> = std::iter::once(planes).chain(state).collect();
            let group = |layout, entries: &[wgpu::BindGroupEntry<'_>]| {
                gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some("halos"), layout, entries })
            };
            [group(&self.params_layout, &params_entries), group(&self.state_layout, &state_entries)]
        })?;
        let across = |[x, y]: [usize; 2]| [(x as u32).div_ceil(GROUP), (y as u32).div_ceil(GROUP), 1];
        let of_image = across(self.size.image);
        let image_pixels = (self.size.image[0] * self.size.image[1]) as u64;
        let mut at = 0;
        while !canvas.is_stopped() {
            // The groups of one submission.
            let mut end = at;
            let mut written = 0;
            while end < self.groups.len() && written < PIXELS_AT_ONCE {
                let PlaneGroup { planes: [first, last], spreads } = self.groups[end];
                let of_halo = |halo: &HaloParams| if spreads { u64::from(halo.spread.passes) + 2 } else { 0 };
                let spread: u64 = self.halos.iter().map(of_halo).sum();
                written += image_pixels.saturating_mul(2 * (last - first + 1).unsigned_abs() + spread);
                end += 1;
            }
            let is_first = at == 0;
            let is_last = end >= self.groups.len();
            let run = |run: &mut wgpu::ComputePass<'_>| {
                run.set_bind_group(0, &params, &[]);
                run.set_bind_group(1, canvas.data, &[]);
                run.set_bind_group(2, &state, &[0]);
                if is_first {
                    gpu.dispatch(run, &self.start, of_image);
                }
                for number in at..end {
                    let record = |stage: usize| [((number * self.stages.len() + stage) as u64 * stride) as u32];
                    run.set_bind_group(2, &state, &record(0));
                    gpu.dispatch(run, &self.visit, of_image);
                    if self.groups[number].spreads {
                        self.spread(gpu, run, |run, stage| run.set_bind_group(2, &state, &record(stage)));
                    }
                }
                if is_last {
                    gpu.dispatch(run, &self.finish, across(self.pixels));
                }
            };
            canvas.submit([is_first, is_last], run, |picture, encoder| {
                if is_last {
                    picture.copy_back(encoder, 0, self.pixels[1]);
                }
            })?;
            canvas.report(end as f64 / self.groups.len().max(1) as f64)?;
            if is_last {
                break;
            }
            at = end;
        }
        Ok(())
    }

    /// Converts the seeds of a group that ends to intensities.
    fn spread(&self, gpu: &Gpu, run: &mut wgpu::ComputePass<'_>, bind: impl Fn(&mut wgpu::ComputePass<'_>, usize)) {
        let Images { source, first, turns, .. } = &self.images;
        let [across, down] = self.size.tiles.map(|n| n as u32);
        for stage in 0..self.stages.len() {
            bind(run, stage);
            run.set_bind_group(3, [source, first].get(stage).copied().unwrap_or(&turns[stage % 2]), &[]);
            gpu.dispatch(run, &self.spread, [across, down, self.halos.len() as u32]);
        }
    }

    /// The groups of planes as shaders read them, one record for each dispatch of spreading.
    fn records(&self, stride: u64) -> Vec<u8> {
        // Sizes are read where nothing is visited, too.
        let none = [PlaneGroup { planes: [0, -1], spreads: false }];
        let groups = if self.groups.is_empty() { &none[..] } else { &self.groups };
        let begin = groups[0].planes[0];
        let ImageSize { rays, image, guard, tiles } = self.size;
        let sizes = [rays[0], rays[1], image[0], image[1], guard, tiles[0], tiles[1], guard.div_ceil(TILE)];
        let mut records = Vec::new();
        for (number, PlaneGroup { planes: [first, last], .. }) in (0..).zip(groups) {
            for Stages { from, to } in &self.stages {
                // Planes are counted in 23 bits.
                let planes = [first - self.anchor, last - self.anchor, *last, begin, number];
                let stages = [from, to].map(|&stage| i64::from(stage));
                let words = planes.into_iter().chain(stages).chain(sizes.map(|n| n as i64));
                records.extend(words.flat_map(|word| (word as i32).to_le_bytes()));
                records.resize(records.len().next_multiple_of(stride as usize), 0);
            }
        }
        records
    }
}

/// The dispatches after a group of planes.
fn stages(halos: &[HaloParams], size: ImageSize, precision: Precision) -> Vec<Stages> {
    let reaches: Vec<Vec<usize>> = halos.iter().map(|halo| size.reaches(halo)).collect();
    dispatches(&reaches, TILE_BYTES / precision.size() as usize)
}

impl Images {
    /// Images of a size for some halos, with those that this many dispatches hand on to each other. `kept` are numbers that
    /// rays keep.
    fn new(
        gpu: &Gpu,
        layout: &wgpu::BindGroupLayout,
        (size, precision): (ImageSize, Precision),
        halos: usize,
        dispatches: usize,
        kept: [usize; 2],
    ) -> Result<Self, GpuError> {
        let [rays, pixels] = [size.rays, size.image].map(|[x, y]| (x as u64).saturating_mul(y as u64));
        let new = |what, numbers: u64| empty(gpu, what, numbers.saturating_mul(precision.size()));
        let image = |layers: usize| new("an image of halos", pixels.saturating_mul(layers as u64));
        let state = [
            new("the list of rays", rays.saturating_mul(6 + kept[0] as u64))?,
            new("the list of rays that seed", pixels.saturating_mul(2 + kept[1] as u64))?,
            image(2 * halos)?,
            image(halos)?,
            image(halos)?,
        ];
        // H₀ and two more: an image that no dispatch reads is as small as can be.
        let between = |number: usize| image(if number < dispatches { halos } else { 0 });
        let (source, first, second) = (between(1)?, between(2)?, between(3)?);
        // H₀, the image that is read, the image that is written.
        let group = |[h0, before, after]: [&wgpu::Buffer; 3]| {
            let entries = [entry(0, h0), entry(1, before), entry(2, after)];
            let descriptor = wgpu::BindGroupDescriptor { label: Some("images"), layout, entries: &entries };
            gpu.device.create_bind_group(&descriptor)
        };
        gpu.attempt("the halos", || Self {
            state,
            source: group([&first, &first, &source]),
            first: group([&source, &source, &first]),
            turns: [group([&source, &first, &second]), group([&source, &second, &first])],
        })
    }
}

/// A buffer that shaders fill.
fn empty(gpu: &Gpu, what: &'static str, bytes: u64) -> Result<wgpu::Buffer, GpuError> {
    check_bytes(gpu, what, bytes)?;
    let descriptor = wgpu::BufferDescriptor {
        label: Some(what),
        size: bytes.max(16).next_multiple_of(16),
        usage: wgpu::BufferUsages::STORAGE,
        mapped_at_creation: false,
    };
    gpu.attempt(what, || gpu.device.create_buffer(&descriptor))
}
