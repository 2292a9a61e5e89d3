//! Smooth cutaways ([VS-7]): the maps of their funnels, found before the picture is drawn.

use crate::buffers::{buffer, entry, list_entry, pipeline};
use crate::canvas::Canvas;
use crate::module::module;
use crate::shader::{Constant, Data, Shader};
use crate::{Gpu, GpuError, Precision, ray};
use drypoint_scene::math;
use drypoint_scene::shot::Shot;

/// Pixels along the side of a workgroup.
const GROUP: u32 = 8;

/// The binding of the maps where a picture reads them.
pub(crate) const MAPS: u32 = 5;

/// The funnel of a cutaway.
#[derive(PartialEq)]
struct Funnel {
    sigma: f64,
    /// Pixels of its map across and down.
    size: [usize; 2],
}

impl Funnel {
    /// Pixels of the guard band: ⌊4σ⌋ + ⌊1.5σ⌋.
    fn guard(&self) -> usize {
        self.reach() + self.radius()
    }

    /// Taps to each side.
    fn reach(&self) -> usize {
        (4.0 * self.sigma) as usize
    }

    /// Pixels by which depths are dilated.
    fn radius(&self) -> usize {
        (1.5 * self.sigma) as usize
    }

    /// For each row of the dilation, from the middle on, the pixels to each side.
    fn halves(&self) -> impl Iterator<Item = u32> {
        let r = 1.5 * self.sigma;
        (0..=self.radius()).map(move |y| (r * r - (y * y) as f64).max(0.0).sqrt() as u32)
    }

    /// The weights of the Gaussian, of sum 1.
    fn taps(&self) -> Vec<f64> {
        let (reach, sigma) = (self.reach() as i64, self.sigma);
        let weight = |i: i64| math::exp(-0.5 * (i as f64 / sigma) * (i as f64 / sigma));
        let sum: f64 = (-reach..=reach).map(weight).sum();
        (-reach..=reach).map(|i| weight(i) / sum).collect()
    }

    /// Pixels across and down with the guard band.
    fn banded(&self) -> [usize; 2] {
        self.size.map(|n| n + 2 * self.guard())
    }
}

/// The funnels of a shot, one for each smooth cutaway.
fn funnels<'s>(shot: &'s Shot) -> impl Iterator<Item = Funnel> + 's {
    let cutaways = shot.combination.iter().flat_map(super::cutaways);
    let smooth = cutaways.filter(|cutaway| cutaway.funnel > 0.0);
    let size = map_size(shot);
    smooth.map(move |cutaway| Funnel { sigma: cutaway.funnel, size })
}

/// Width in pixels of the band about the picture that maps of funnels cover: the guard band of halos, whose seeds are
/// cut as in a larger picture.
fn margin(shot: &Shot) -> usize {
    ray::guard(shot).div_ceil(shot.rays_across.max(1))
}

/// Pixels across and down of maps of funnels.
fn map_size(shot: &Shot) -> [usize; 2] {
    shot.view.size.map(|n| n + 2 * margin(shot))
}

/// The share of a step by which a sample must lie before the end of a funnel to be cut, so that rounding does not
/// decide.
fn slack(precision: Precision) -> f64 {
    match precision {
        Precision::Single => 1.0 / (1u64 << 10) as f64,
        Precision::Double => 1.0 / (1u64 << 32) as f64,
    }
}

/// Adds the funnels of a shot to its shader.
pub(super) fn add(shader: &mut Shader, shot: &Shot, precision: Precision) {
    let mut first = 0;
    let mut bands = Vec::new();
    let [across, down] = map_size(shot);
    for (name, n) in [("FUNNEL_X", across), ("FUNNEL_Y", down), ("FUNNEL_MARGIN", margin(shot))] {
        shader.constant(name, Constant::Int(n as i64));
    }
    for funnel in funnels(shot) {
        bands.extend([funnel.guard() as u32, first as u32]);
        first += funnel.banded().iter().product::<usize>();
    }
    shader.add(&[module!("funnel"), module!("funnel_depths"), module!("funnel_maps")]);
    shader.stages.begin_part.push("begin_funnel");
    shader.block.number("funnel_slack", slack(precision));
    shader.bind(26, "the bands of funnels", Data::Words(bands));
}

/// Passes that map the funnels of a shot, with their buffers.
pub(crate) struct FunnelPasses {
    find: wgpu::ComputePipeline,
    find_layout: wgpu::BindGroupLayout,
    /// Dilation, smoothing along rows, and the rest.
    smooth: [wgpu::ComputePipeline; 3],
    group: wgpu::BindGroup,
    depths: wgpu::Buffer,
    maps: wgpu::Buffer,
    funnels: Vec<Funnel>,
    /// Workgroups across and down of the widest guard band, and the number of funnels.
    groups: [u32; 3],
}

impl FunnelPasses {
    /// The passes of a shot with its whole shader. Returns none without funnels.
    pub(crate) fn new(
        gpu: &Gpu,
        shot: &Shot,
        module: &wgpu::ShaderModule,
        data: &wgpu::BindGroupLayout,
        precision: Precision,
    ) -> Result<Option<Self>, GpuError> {
        let funnels: Vec<Funnel> = funnels(shot).collect();
        if funnels.is_empty() {
            return Ok(None);
        }
        // The lists.
        let (mut numbers, mut halves, mut taps, mut depths) = (Vec::new(), Vec::new(), Vec::new(), 0);
        let mut most = [0; 2];
        for funnel in &funnels {
            let (own_halves, own_taps): (Vec<u32>, _) = (funnel.halves().collect(), funnel.taps());
            let of_pixels = [funnel.guard(), depths, funnel.radius(), halves.len()];
            numbers
                .extend(of_pixels.into_iter().chain([funnel.reach(), taps.len() + funnel.reach()]).map(|n| n as u32));
            halves.extend(own_halves);
            taps.extend(own_taps);
            let banded = funnel.banded();
            depths += banded[0] * banded[1];
            most = [most[0].max(banded[0]), most[1].max(banded[1])];
        }
        let [width, height] = map_size(shot);
        let list = |bytes: &[u8]| buffer(gpu, "the funnels", bytes, wgpu::BufferUsages::STORAGE);
        let room = |reals: usize| list(&vec![0; reals * precision.size() as usize]);
        let (funnel_list, half_list) = (list(bytemuck::cast_slice(&numbers))?, list(bytemuck::cast_slice(&halves))?);
        let lists = [funnel_list, half_list, list(&precision.bytes(&taps))?, room(depths)?];
        let maps = [room(2 * depths)?, room(2 * depths)?, room(2 * width * height * funnels.len())?];
        // The passes.
        let find_layout = gpu.attempt("the shader", || {
            let entries = [list_entry(0, true), list_entry(6, false)];
            let descriptor = wgpu::BindGroupLayoutDescriptor { label: Some("funnels"), entries: &entries };
            gpu.device.create_bind_group_layout(&descriptor)
        })?;
        let layout = gpu.attempt("the shader", || {
            let entries: Vec<_> = (0..7).map(|binding| list_entry(binding, binding < 4)).collect();
            let descriptor = wgpu::BindGroupLayoutDescriptor { label: Some("funnels"), entries: &entries };
            gpu.device.create_bind_group_layout(&descriptor)
        })?;
        let smooth = |entry_point| pipeline(gpu, module, entry_point, &[&layout]);
        let smooth = [smooth("dilate")?, smooth("smooth_rows")?, smooth("map_funnels")?];
        let group = gpu.attempt("the funnels", || {
            let buffers = lists.iter().chain(&maps);
            let entries: Vec<_> = buffers.enumerate().map(|(i, buffer)| entry(i as u32, buffer)).collect();
            let descriptor = wgpu::BindGroupDescriptor { label: Some("funnels"), layout: &layout, entries: &entries };
            gpu.device.create_bind_group(&descriptor)
        })?;
        let ([.., depths], [.., maps]) = (lists, maps);
        let [across, down] = most.map(|n| (n as u32).div_ceil(GROUP));
        Ok(Some(Self {
            find: pipeline(gpu, module, "find_depths", &[&find_layout, data])?,
            find_layout,
            smooth,
            group,
            depths,
            maps,
            groups: [across, down, funnels.len() as u32],
            funnels,
        }))
    }

    /// Whether passes, or their absence, serve another shot.
    pub(crate) fn fit(passes: Option<&Self>, shot: &Shot) -> bool {
        funnels(shot).collect::<Vec<_>>() == passes.map_or(&[][..], |passes| &passes.funnels)
    }

    /// The maps, as they stand after [`draw`](Self::draw).
    pub(crate) fn maps(&self) -> &wgpu::Buffer {
        &self.maps
    }

    /// Maps the funnels as the camera of the scalars sees them.
    pub(crate) fn draw(&self, canvas: &Canvas<'_>) -> Result<(), GpuError> {
        let device = &canvas.gpu.device;
        canvas.gpu.attempt("the funnels", || {
            let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("funnels"),
                layout: &self.find_layout,
                entries: &[entry(0, canvas.params), entry(6, &self.depths)],
            });
            let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            {
                let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
                pass.set_bind_group(0, &group, &[]);
                pass.set_bind_group(1, canvas.data, &[]);
                canvas.gpu.dispatch(&mut pass, &self.find, self.groups);
                for pipeline in &self.smooth {
                    pass.set_bind_group(0, &self.group, &[]);
                    canvas.gpu.dispatch(&mut pass, pipeline, self.groups);
                }
            }
            canvas.gpu.queue.submit([encoder.finish()]);
        })
    }
}
