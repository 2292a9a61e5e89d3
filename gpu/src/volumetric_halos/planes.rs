//! The passes of a picture with halos, one group of planes after the other ([HALO-1], [HALO-8], [HALO-9]).

use crate::buffers::{buffer, check_bytes, entry, list_entry, pipeline};
use crate::canvas::Canvas;
use crate::place::anchor;
use crate::shader::Shader;
use crate::{Gpu, GpuError, Precision, ray};
use drypoint_scene::glam::DVec3;
use drypoint_scene::mesh::TriangleMesh;
use drypoint_scene::picture::LayerKind;
use drypoint_scene::shot::halo::{split_distance, tap_distance};
use drypoint_scene::shot::{HaloKind, HaloParams, Shot};
use drypoint_scene::space::Grid;

/// Pixels along the side of a workgroup.
const GROUP: u32 = 8;

/// About the largest number of pixels that the passes of one submission write. It keeps drivers from assuming a fault.
const PIXELS_AT_ONCE: u64 = 1 << 26;

/// Bytes of a group of planes as a shader reads it.
const GROUP_BYTES: u64 = 24;

/// Lists of a pass over images, beside the scene's: scalars and the picture, groups of planes, states of rays and tiles, and
/// three images.
pub(crate) const LISTS: usize = 2 + 8 + 3;

/// The name of the list of groups in errors.
const GROUP_LIST: &str = "the groups of planes";

/// The largest number of tiles in each direction over which seeds of a tile spread.
const TILE_REACH: usize = 1;

/// Rays across and down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ImageSize {
    /// Rays of the picture.
    pub(crate) rays: [usize; 2],
    /// Rays of the images, with the guard band.
    pub(crate) image: [usize; 2],
    /// Rays of the guard band on each side.
    pub(crate) guard: usize,
    /// Rays along the side of a tile of the images: whole workgroups.
    pub(crate) tile: usize,
    /// Tiles across and down.
    pub(crate) tiles: [usize; 2],
    /// Tiles in each direction that the guard band reaches.
    pub(crate) tile_reach: usize,
}

/// The size of a shot's images.
pub(crate) fn image_size(shot: &Shot) -> ImageSize {
    let guard = ray::guard(shot);
    let rays = shot.view.size.map(|n| n * shot.rays_across);
    // Images that do not fit are refused by their bytes.
    let image = rays.map(|n| n.saturating_add(guard.saturating_mul(2)));
    let tile = guard.div_ceil(TILE_REACH * GROUP as usize).max(1) * GROUP as usize;
    ImageSize { rays, image, guard, tile, tiles: image.map(|n| n.div_ceil(tile)), tile_reach: guard.div_ceil(tile) }
}

/// The largest N.
pub(crate) fn most_passes(list: &[HaloParams]) -> u32 {
    list.iter().map(|halo| halo.spread.passes).max().unwrap_or(0)
}

/// The distance of taps, as whole rays and a fraction.
pub(crate) fn taps(halo: &HaloParams, exponent: u32, size: ImageSize) -> [f64; 2] {
    let side = size.image[0].max(size.image[1]);
    let (j, f) = split_distance(tap_distance(halo.spread.stretch, exponent), side);
    [j as f64, f]
}

/// Planes that rays visit together: M of some halo, or fewer if groups of several halos end at different planes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct PlaneGroup {
    /// The first plane and the last one, counted from the eye.
    planes: [i64; 2],
    /// Whether the groups of all halos end here.
    all_end: bool,
    /// Whether a later plane needs the intensities.
    is_asked: bool,
}

/// The groups of planes of a picture whose samples lie on the planes first..=last.
fn groups(halos: &[HaloParams], is_watched: impl Fn(usize) -> bool, [first, last]: [i64; 2]) -> Vec<PlaneGroup> {
    let end_of = |halo: &HaloParams, k: i64| {
        let every = halo.every.max(1);
        (k.div_euclid(every) + 1) * every - 1
    };
    // Emissive halos go on through the group behind the last seeds.
    let goes_on = |(i, halo): (usize, &HaloParams)| match halo.kind == HaloKind::Emissive || is_watched(i) {
        true => end_of(halo, end_of(halo, last) + 1),
        false => last,
    };
    let end_of_all = halos.iter().enumerate().map(goes_on).max().unwrap_or(last);
    let mut groups = Vec::new();
    let mut next = first;
    while next <= end_of_all {
        let end = halos.iter().map(|halo| end_of(halo, next)).min().unwrap_or(end_of_all).min(end_of_all);
        let all_end = halos.iter().all(|halo| end_of(halo, end) == end);
        groups.push(PlaneGroup { planes: [next, end], all_end, is_asked: end < end_of_all });
        next = end + 1;
    }
    groups
}

/// The planes, counted from the eye, on which any ray can have a sample, an iso-surface or something inside the boxes
/// with the corners `others`.
fn reached(shot: &Shot, grid: &Grid, others: &[DVec3]) -> [i64; 2] {
    let Shot { view, lattice, .. } = shot;
    let corners = grid.world_corners().into_iter().chain(others.iter().copied());
    let corners: Vec<DVec3> = corners.map(|corner| view.to_eye(corner)).collect();
    let [near, far] = [f64::min, f64::max].map(|end| corners.iter().map(|p| -p.z).reduce(end).unwrap_or(0.0));
    let plane = |depth: f64| (depth / lattice.step).floor() as i64;
    [(plane(near) - 1).max(lattice.first(view)), plane(far) + 2]
}

/// The corners of the box about a mesh.
pub(crate) fn corners(mesh: &TriangleMesh) -> [DVec3; 8] {
    let all = || mesh.positions().iter().copied();
    let ends = [all().reduce(DVec3::min), all().reduce(DVec3::max)].map(Option::unwrap_or_default);
    std::array::from_fn(|i| DVec3::new(ends[i & 1].x, ends[i >> 1 & 1].y, ends[i >> 2].z))
}

/// Halos of a picture on a graphics card: images and states of rays, and the passes over them.
pub(crate) struct HaloPlanes {
    size: ImageSize,
    /// Number of vectors of the images. Each vector holds four halos.
    fours: u32,
    pixels: [u32; 2],
    halos: Vec<HaloParams>,
    /// The largest N.
    passes: u32,
    watched: Vec<bool>,
    groups: Vec<PlaneGroup>,
    anchor: i64,
    /// Corners of boxes about meshes and the data of objects.
    other_corners: Vec<DVec3>,
    start: wgpu::ComputePipeline,
    visit: wgpu::ComputePipeline,
    tiles: wgpu::ComputePipeline,
    median: Option<wgpu::ComputePipeline>,
    source: wgpu::ComputePipeline,
    spread: wgpu::ComputePipeline,
    end: wgpu::ComputePipeline,
    finish: wgpu::ComputePipeline,
    params_layout: wgpu::BindGroupLayout,
    state_layout: wgpu::BindGroupLayout,
    /// Numbers of rays, numbers of seeds' rays, then S, H and O.
    state: [wgpu::Buffer; 5],
    /// The tiles that passes visit.
    tile_list: wgpu::Buffer,
    images: Images,
}

/// H₀ and two alternating images, as passes read and write them.
struct Images {
    /// Filtered seeds: written to the first image.
    median: wgpu::BindGroup,
    /// H₀ from the seeds, or from the first image.
    source: wgpu::BindGroup,
    /// From H₀ to the first image.
    first: wgpu::BindGroup,
    /// From the first image to the second one, and back.
    turns: [wgpu::BindGroup; 2],
}

impl HaloPlanes {
    /// Makes the images and the passes of a shot. `text` is the whole shader, and `others` are corners of boxes about all that
    /// can be seen beside the volume on `grid`. `further` is a further binding that rays of the picture read.
    pub(crate) fn new(
        gpu: &Gpu,
        shot: &Shot,
        (grid, others): (&Grid, Vec<DVec3>),
        further: Option<u32>,
        (shader, text): (&Shader, &str),
        data_layout: &wgpu::BindGroupLayout,
        precision: Precision,
    ) -> Result<Self, GpuError> {
        let size = image_size(shot);
        let halos = shot.halos.list.clone();
        let fours = halos.len().div_ceil(4);
        let pixels = (size.image[0] as u64).saturating_mul(size.image[1] as u64);
        let rays = (size.rays[0] as u64).saturating_mul(size.rays[1] as u64);
        let stages = shader.stages.halos.clone().unwrap_or_default();
        // Buffers.
        let storage = wgpu::BufferUsages::STORAGE;
        let new = |what, numbers: u64, usage| empty(gpu, what, numbers.saturating_mul(precision.size()), usage);
        let image = || new("an image of halos", pixels.saturating_mul(4 * fours as u64), storage);
        let state = [
            new("the list of rays", rays.saturating_mul(6 + stages.kept_numbers() as u64), storage)?,
            new("the list of rays that seed", pixels.saturating_mul(2 + stages.seed_kept.len() as u64), storage)?,
            image()?,
            image()?,
            image()?,
        ];
        let tile_list = empty(gpu, "the list of tiles", 4 * (size.tiles[0] as u64) * size.tiles[1] as u64, storage)?;
        let [width, height] = shot.view.size;
        // Layouts and passes.
        let layout = |label, entries: &[wgpu::BindGroupLayoutEntry]| {
            let descriptor = wgpu::BindGroupLayoutDescriptor { label: Some(label), entries };
            gpu.attempt("the shader", || gpu.device.create_bind_group_layout(&descriptor))
        };
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
        let entries: Vec<_> = std::iter::once(group).chain((1..=7).map(|binding| list_entry(binding, false))).collect();
        let state_layout = layout("rays", &entries)?;
        let image_layout = layout("images", &[list_entry(0, true), list_entry(1, true), list_entry(2, false)])?;
        let pass = |entry_point, with_images: bool| {
            let mut groups = vec![&params_layout, data_layout, &state_layout];
            groups.extend(with_images.then_some(&image_layout));
            pipeline(gpu, text.to_owned(), entry_point, &groups)
        };
        let has_median = halos.iter().any(|halo| halo.spread.median);
        let images = Images::new(gpu, &image_layout, [image()?, image()?, image()?])?;
        let watched = (0..halos.len()).map(|i| shot.layers.contains(&LayerKind::Halo(i))).collect();
        let mut planes = Self {
            size,
            fours: fours as u32,
            pixels: [width as u32, height as u32],
            passes: most_passes(&halos),
            halos,
            watched,
            groups: Vec::new(),
            anchor: 0,
            other_corners: others,
            start: pass("halo_start", false)?,
            visit: pass("halo_planes", false)?,
            tiles: pass("halo_tiles", false)?,
            median: has_median.then(|| pass("halo_median", true)).transpose()?,
            source: pass("halo_source", true)?,
            spread: pass("halo_spread", true)?,
            end: pass("halo_end", true)?,
            finish: pass("halo_pixels", false)?,
            params_layout,
            state_layout,
            state,
            tile_list,
            images,
        };
        planes.turn(shot, grid);
        Ok(planes)
    }

    /// Whether the images and the passes serve another shot with the same text and layers.
    pub(crate) fn fit(&self, shot: &Shot) -> bool {
        let list = &shot.halos.list;
        image_size(shot) == self.size
            && list.len() == self.halos.len()
            && list.iter().any(|halo| halo.spread.median) == self.median.is_some()
    }

    /// Takes another shot, which [fits](Self::fit).
    pub(crate) fn change(&mut self, shot: &Shot, grid: &Grid, others: Vec<DVec3>) {
        self.halos.clone_from(&shot.halos.list);
        (self.passes, self.other_corners) = (most_passes(&self.halos), others);
        self.turn(shot, grid);
    }

    /// Takes the camera of another shot.
    pub(crate) fn turn(&mut self, shot: &Shot, grid: &Grid) {
        self.groups = groups(&self.halos, |i| self.watched[i], reached(shot, grid, &self.other_corners));
        self.anchor = anchor(shot, grid) as i64;
    }

    /// Draws a frame. `further` is the list of the further binding.
    pub(crate) fn draw(&self, canvas: &Canvas<'_>, further: Option<(u32, &wgpu::Buffer)>) -> Result<(), GpuError> {
        let gpu = canvas.gpu;
        let stride = u64::from(gpu.device.limits().min_storage_buffer_offset_alignment).max(GROUP_BYTES);
        let count = self.groups.len() as u64 * u64::from(self.passes.max(1));
        check_bytes(gpu, GROUP_LIST, count.saturating_mul(stride))?;
        let (records, firsts) = self.records(stride);
        let group_list = buffer(gpu, GROUP_LIST, &records, wgpu::BufferUsages::STORAGE)?;
        let tiles = self.size.tiles[0] * self.size.tiles[1];
        let flags = vec![0; 4 * (4 * tiles + self.groups.len())];
        let flags = buffer(gpu, "the list of tiles", &flags, wgpu::BufferUsages::STORAGE)?;
        let [params, state] = gpu.attempt("the halos", || {
            let mut params_entries = vec![entry(0, canvas.params), entry(1, &canvas.picture.out)];
            params_entries.extend(further.map(|(binding, list)| entry(binding, list)));
            let planes =
                wgpu::BufferBinding { buffer: &group_list, offset: 0, size: wgpu::BufferSize::new(GROUP_BYTES) };
            let planes = wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::Buffer(planes) };
            let state = (1..).zip(&self.state).map(|(binding, buffer)| entry(binding, buffer));
            let tiles = [entry(6, &flags), entry(7, &self.tile_list)];
            let state_entries: Vec<_> = std::iter::once(planes).chain(state).chain(tiles).collect();
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
                let group = &self.groups[end];
                let planes = (group.planes[1] - group.planes[0] + 1).unsigned_abs();
                written += image_pixels * (2 * planes + u64::from((self.passes + 2) * self.fours));
                end += 1;
            }
            let is_first = at == 0;
            let is_last = end >= self.groups.len();
            let run = |run: &mut wgpu::ComputePass<'_>| {
                run.set_bind_group(0, &params, &[]);
                run.set_bind_group(1, canvas.data, &[]);
                run.set_bind_group(2, &state, &[0]);
                if is_first {
                    run.set_pipeline(&self.start);
                    run.dispatch_workgroups(of_image[0], of_image[1], 1);
                }
                for (group, first) in self.groups[at..end].iter().zip(&firsts[at..end]) {
                    let record = |exponent: u32| ((first + u64::from(exponent)) * stride) as u32;
                    run.set_bind_group(2, &state, &[record(0)]);
                    run.set_pipeline(&self.visit);
                    run.dispatch_workgroups(of_image[0], of_image[1], 1);
                    if group.is_asked {
                        self.generate(run, &state, record);
                    }
                }
                if is_last {
                    let of_pixels = across(self.pixels.map(|n| n as usize));
                    run.set_pipeline(&self.finish);
                    run.dispatch_workgroups(of_pixels[0], of_pixels[1], 1);
                }
            };
            canvas.submit([is_first, is_last], run, |picture, encoder| {
                if is_last {
                    picture.copy_back(encoder, 0, self.pixels[1] as usize);
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

    /// Converts the seeds of groups that end to intensities.
    fn generate(&self, run: &mut wgpu::ComputePass<'_>, state: &wgpu::BindGroup, record: impl Fn(u32) -> u32) {
        let [across, down] = self.size.tiles.map(|n| n as u32);
        run.set_pipeline(&self.tiles);
        run.dispatch_workgroups(across.div_ceil(GROUP), down.div_ceil(GROUP), 1);
        let side = self.size.tile as u32 / GROUP;
        let [x, y, z] = [across * side, down * side, self.fours];
        if let Some(median) = &self.median {
            run.set_pipeline(median);
            run.set_bind_group(3, &self.images.median, &[]);
            run.dispatch_workgroups(x, y, z);
        }
        run.set_pipeline(&self.source);
        run.set_bind_group(3, &self.images.source, &[]);
        run.dispatch_workgroups(x, y, z);
        let last = self.passes.saturating_sub(1);
        for i in 0..=last {
            run.set_pipeline(if i == last { &self.end } else { &self.spread });
            run.set_bind_group(2, state, &[record(last - i)]);
            let images = if i == 0 { &self.images.first } else { &self.images.turns[(i as usize - 1) % 2] };
            run.set_bind_group(3, images, &[]);
            run.dispatch_workgroups(x, y, z);
        }
    }

    /// The groups of planes as shaders read them, one record for each exponent of taps, and the offset of each group's
    /// first record.
    fn records(&self, stride: u64) -> (Vec<u8>, Vec<u64>) {
        let mut firsts = Vec::new();
        let mut records = Vec::new();
        for (number, group) in (0..).zip(&self.groups) {
            firsts.push(records.len() as u64 / stride);
            for exponent in 0..self.passes.max(1) {
                let [first, last] = group.planes;
                let all_end = i64::from(group.all_end);
                // Planes are counted in 23 bits.
                let words = [first - self.anchor, last - self.anchor, last, i64::from(exponent), number, all_end];
                let words = words.map(|word| word as i32);
                records.extend(words.iter().flat_map(|word| word.to_le_bytes()));
                records.resize(records.len().next_multiple_of(stride as usize), 0);
            }
        }
        records.resize(records.len().max(stride as usize), 0);
        (records, firsts)
    }
}

impl Images {
    fn new(
        gpu: &Gpu,
        layout: &wgpu::BindGroupLayout,
        [source, first, second]: [wgpu::Buffer; 3],
    ) -> Result<Self, GpuError> {
        // H₀, the image that is read, the image that is written.
        let group = |[h0, before, after]: [&wgpu::Buffer; 3]| {
            let entries = [entry(0, h0), entry(1, before), entry(2, after)];
            let descriptor = wgpu::BindGroupDescriptor { label: Some("images"), layout, entries: &entries };
            gpu.device.create_bind_group(&descriptor)
        };
        gpu.attempt("the halos", || Self {
            median: group([&second, &second, &first]),
            source: group([&first, &first, &source]),
            first: group([&source, &source, &first]),
            turns: [group([&source, &first, &second]), group([&source, &second, &first])],
        })
    }
}

/// A buffer that shaders fill.
fn empty(gpu: &Gpu, what: &'static str, bytes: u64, usage: wgpu::BufferUsages) -> Result<wgpu::Buffer, GpuError> {
    check_bytes(gpu, what, bytes)?;
    let descriptor = wgpu::BufferDescriptor {
        label: Some(what),
        size: bytes.max(16).next_multiple_of(16),
        usage,
        mapped_at_creation: false,
    };
    gpu.attempt(what, || gpu.device.create_buffer(&descriptor))
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::shot::{HaloAccumulation, HaloSeed, HaloSource, HaloSpread, SeedSide};

    fn halo(kind: HaloKind, every: i64) -> HaloParams {
        let side = SeedSide::Power { exponent: 1.0 };
        HaloParams {
            name: "halo".into(),
            kind,
            seed: HaloSeed { value: None, direction: None, focus: None, labels: None, gradient_exponent: 1.0, side },
            spread: HaloSpread { from: HaloSource::Gradient, passes: 4, delta: 0.8, stretch: 1.0, median: false },
            profile: Vec::new(),
            opacity: 1.0,
            floor: 0.0,
            every,
            accumulate: HaloAccumulation::Max,
            tints: Vec::new(),
        }
    }

    /// Groups follow each other without a gap, end where some halo's do, and go on until no halo shines any more.
    #[test]
    fn groups_of_planes_by_hand() {
        let planes = |halos: &[HaloParams], ends: [i64; 2]| {
            groups(halos, |_| false, ends).iter().map(|group| group.planes).collect::<Vec<_>>()
        };
        let (dark, bright) = (|every| halo(HaloKind::Occlusive, every), |every| halo(HaloKind::Emissive, every));
        assert_eq!(planes(&[dark(4)], [-3, 6]), [[-3, -1], [0, 3], [4, 6]]);
        // Seeds of plane 6 shine behind the planes 8 to 11.
        assert_eq!(planes(&[bright(4)], [2, 6]), [[2, 3], [4, 7], [8, 11]]);
        assert_eq!(planes(&[dark(2), bright(3)], [0, 3]), [[0, 1], [2, 2], [3, 3], [4, 5], [6, 7], [8, 8]]);
        let all = groups(&[dark(2), bright(3)], |_| false, [0, 3]);
        assert_eq!(
            all.iter().map(|group| group.all_end).collect::<Vec<_>>(),
            [false, false, false, true, false, false]
        );
        assert_eq!(all.iter().map(|group| group.is_asked).collect::<Vec<_>>(), [true, true, true, true, true, false]);
        // Nothing is reached.
        assert_eq!(planes(&[dark(4)], [5, 2]), [[0; 2]; 0]);
    }
}
