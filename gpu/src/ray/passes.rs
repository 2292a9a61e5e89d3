//! The passes of rays that are drawn independently: all pixels, then those at edges once more.

use crate::block::ParamBlock;
use crate::buffers::{list_entry, pipeline};
use crate::canvas::Canvas;
use crate::{Gpu, GpuError, Precision};
use drypoint_scene::picture::LayerKind;
use drypoint_scene::shot::Shot;
use drypoint_scene::space::Grid;
use std::ops::Range;

/// Pixels along the side of a workgroup.
const GROUP: u32 = 8;

/// About the largest number of samples in one submission. For a card it keeps drivers from assuming a fault; for
/// software it keeps progress reports coming.
const SAMPLES_AT_ONCE: [f64; 2] = [(1u64 << 28) as f64, (1u64 << 26) as f64];

/// The most rays of a pixel at an edge ([RAY-7]).
const MOST_AT_EDGES: usize = 9;

/// Passes over the pixels of a picture.
pub(crate) struct RayPasses {
    draw: Pass,
    /// Further rays at edges; none if no pixel is refined.
    refinement: Option<Pass>,
    size: [usize; 2],
    rays_across: usize,
    /// Whether pixels at edges get further rays.
    refines: bool,
    /// About how many samples a row of pixels has with one ray for each pixel.
    samples_a_row: f64,
    is_beauty_alone: bool,
}

impl RayPasses {
    /// Compiles the passes of a shot with its whole shader. `further` are the bindings of further lists of group 0.
    pub(crate) fn new(
        gpu: &Gpu,
        (shot, grid): (&Shot, &Grid),
        module: &wgpu::ShaderModule,
        data: &wgpu::BindGroupLayout,
        layers: &[LayerKind],
        further: &[u32],
    ) -> Result<Self, GpuError> {
        let pass = |entry_point, reads: &[u32]| Pass::new(gpu, module, entry_point, &[reads, further].concat(), data);
        let mut passes = Self {
            draw: pass("draw", &[0])?,
            refinement: shot.refine_above.map(|_| pass("refine", &[0, 2])).transpose()?,
            size: shot.view.size,
            rays_across: shot.rays_across,
            refines: false,
            samples_a_row: 0.0,
            is_beauty_alone: layers == [LayerKind::Beauty],
        };
        passes.turn(shot, grid);
        Ok(passes)
    }

    /// Whether the passes serve another shot with the same text.
    pub(crate) fn fit(&self, shot: &Shot) -> bool {
        self.refinement.is_some() == shot.refine_above.is_some()
    }

    /// Takes the camera, the size and the rays of another shot. Without the pass for edges no pixel is refined.
    pub(crate) fn turn(&mut self, shot: &Shot, grid: &Grid) {
        (self.size, self.rays_across, self.refines) = (shot.view.size, shot.rays_across, shot.refine_above.is_some());
        self.samples_a_row = self.size[0] as f64 * shot.lattice.planes(&shot.view, grid).max(1.0);
    }

    /// Draws rows into the picture's buffer, and copies them to the buffer that is read back. `further` holds further
    /// lists with their bindings.
    pub(crate) fn draw(
        &self,
        canvas: &Canvas<'_>,
        (block, precision): (&mut ParamBlock, Precision),
        further: &[(u32, &wgpu::Buffer)],
        rows: Range<usize>,
    ) -> Result<(), GpuError> {
        let [width, height] = self.size;
        // Edges are found in the rows around those that are refined, too.
        let around = canvas.picture.rows_around(&rows, height);
        block.set("top_row", around.start as f64);
        let parts = self.rays_across * self.rays_across;
        // Sums of layers stay in a shader; a beauty alone is drawn ray by ray. A pixel at an edge is drawn at once.
        let draw = (&self.draw, around.clone(), [parts, if self.is_beauty_alone { 1 } else { parts }]);
        let refine = self.refinement.as_ref().filter(|_| self.refines);
        let refine = refine.map(|pass| (pass, rows.clone(), [MOST_AT_EDGES; 2]));
        let passes = 1 + usize::from(refine.is_some());
        for (number, (pass, pass_rows, [parts, at_once])) in std::iter::once(draw).chain(refine).enumerate() {
            let group = canvas.group(&pass.layout, number > 0, further)?;
            let most = SAMPLES_AT_ONCE[usize::from(canvas.gpu.is_software())];
            let band = ((most / (self.samples_a_row * at_once as f64)) as usize).max(GROUP as usize);
            for first in pass_rows.clone().step_by(band) {
                if canvas.is_stopped() {
                    return Ok(());
                }
                let end = (first + band).min(pass_rows.end);
                let groups = [width, end - first].map(|n| (n as u32).div_ceil(GROUP));
                block.set("first_row", first as f64);
                block.set("end_row", end as f64);
                for part in (0..parts).step_by(at_once) {
                    block.set("first_part", part as f64);
                    block.set("end_part", (part + at_once) as f64);
                    let is_end_of_pass = end == pass_rows.end && part + at_once >= parts;
                    let is_end_of_rows = is_end_of_pass && number + 1 == passes;
                    let begins = number == 0 && first == 0 && part == 0;
                    let ends = is_end_of_rows && rows.end == height;
                    let run = |run: &mut wgpu::ComputePass<'_>| {
                        run.set_bind_group(0, &group, &[]);
                        run.set_bind_group(1, canvas.data, &[]);
                        canvas.gpu.dispatch(run, &pass.pipeline, [groups[0], groups[1], 1]);
                    };
                    canvas.write_params(block, precision)?;
                    canvas.submit([begins, ends], run, |picture, encoder| {
                        if is_end_of_rows {
                            picture.copy_back(encoder, rows.start - around.start, rows.len());
                        } else if is_end_of_pass {
                            picture.keep_first(encoder);
                        }
                    })?;
                }
                canvas.report((number as f64 + end as f64 / height as f64) / passes as f64)?;
            }
        }
        Ok(())
    }
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
        module: &wgpu::ShaderModule,
        entry_point: &'static str,
        reads: &[u32],
        data: &wgpu::BindGroupLayout,
    ) -> Result<Self, GpuError> {
        let lists = reads.iter().map(|&binding| list_entry(binding, true));
        let entries: Vec<_> = lists.chain([list_entry(1, false)]).collect();
        let descriptor = wgpu::BindGroupLayoutDescriptor { label: Some(entry_point), entries: &entries };
        let layout = gpu.attempt("the shader", || gpu.device.create_bind_group_layout(&descriptor))?;
        Ok(Self { pipeline: pipeline(gpu, module, entry_point, &[&layout, data])?, layout })
    }
}
