//! Lines inside a volume ([HATCH-14] d).

use crate::buffers::buffer;
use crate::module::module;
use crate::place::anchor;
use crate::shader::Shader;
use crate::{Gpu, GpuError, Precision};
use drypoint_scene::fragments::Fragments;
use drypoint_scene::shot::{Shot, StepAlong};
use drypoint_scene::space::Grid;
use drypoint_scene::view::View;

/// The bindings of the first fragment of each ray, and of fragments.
pub(crate) const LINE_STARTS: u32 = 3;
pub(crate) const LINES: u32 = 4;

/// Adds lines, before an iso-surface.
pub(crate) fn add(shader: &mut Shader) {
    shader.add(&[module!("path_lines")]);
    shader.stages.begin_part.push("begin_lines");
    shader.stages.ends.push("meet_lines_left");
}

/// Ends lines at the iso-surface or the meshes that were added after them.
pub(crate) fn add_surface(shader: &mut Shader) {
    shader.add(&[module!("lines_before_surface")]);
    shader.stages.begin_ray.push("end_lines_at_surface");
}

/// The rays of a frame, and the lines that they meet.
pub(crate) struct LinesOnRays {
    view: View,
    rays_across: usize,
    step: f64,
    /// Whether steps are counted along rays.
    by_ray: bool,
    anchor_steps: f64,
    /// The lines, if the frame has any.
    pub(crate) lines: Option<Fragments>,
}

impl LinesOnRays {
    /// The rays of a shot, without lines.
    pub(crate) fn new(shot: &Shot, grid: &Grid) -> Self {
        Self {
            view: shot.view.clone(),
            rays_across: shot.rays_across,
            step: shot.lattice.step,
            by_ray: shot.view.perspective && shot.lattice.along == StepAlong::Ray,
            anchor_steps: anchor(shot, grid) + 0.5,
            lines: None,
        }
    }

    /// Takes the camera of another shot.
    pub(crate) fn turn(&mut self, shot: &Shot, grid: &Grid) {
        *self = Self { lines: self.lines.take(), ..Self::new(shot, grid) };
    }

    /// The index of each ray's first fragment, with the end of the last ray, and the fragments as shaders read them.
    fn numbers(&self) -> (Vec<u32>, Vec<f64>) {
        let n = self.rays_across as f64;
        let [width, height] = self.view.size.map(|side| side * self.rays_across);
        let (mut starts, mut numbers) = (Vec::with_capacity(width * height + 1), Vec::new());
        let mut found = 0;
        for (row, column) in (0..height).flat_map(|row| (0..width).map(move |column| (row, column))) {
            starts.push(found);
            let [x, y] = [column, row].map(|i| (i as f64 + 0.5) / n);
            let fragments = self.lines.as_ref().map_or(&[][..], |lines| lines.at([x, y]));
            if fragments.is_empty() {
                continue;
            }
            found += fragments.len() as u32;
            let step = if self.by_ray { self.step * self.view.ray(x, y).cos_phi } else { self.step };
            for fragment in fragments {
                numbers.push(fragment.depth / step - self.anchor_steps);
                numbers.extend(fragment.rgb);
                numbers.push(fragment.opacity);
            }
        }
        starts.push(found);
        (starts, numbers)
    }

    /// The numbers as the lists that shaders read.
    pub(crate) fn buffers(&self, gpu: &Gpu, precision: Precision) -> Result<[wgpu::Buffer; 2], GpuError> {
        let (starts, numbers) = self.numbers();
        let list = |bytes: &[u8]| buffer(gpu, "the lines inside the volume", bytes, wgpu::BufferUsages::STORAGE);
        Ok([list(bytemuck::cast_slice(&starts))?, list(&precision.bytes(&numbers))?])
    }
}
