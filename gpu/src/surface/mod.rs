//! Iso-surfaces, where rays end ([HATCH-14]).

use crate::field::Scales;
use crate::module::module;
use crate::shader::{Constant, Data, Shader};
use drypoint_scene::measured::Measured;
use drypoint_scene::shot::{Kernel, OpaqueSurface, Outside, Shot};

/// The largest number that kernels make of numbers in [−1, 1], and more.
const LARGEST: f64 = 8.0;

/// Adds the search for the first root of a value on a ray. `slack` is the rounding of a value. If there is a mask, it
/// must be bound before.
pub(crate) fn add_search(
    shader: &mut Shader,
    kernel: Kernel,
    iso: f64,
    measured: &Measured,
    scales: &Scales,
    slack: f64,
    has_mask: bool,
) {
    shader.add(&[module!("traversal"), module!("first_root"), module!("cubic_bracket")]);
    match kernel {
        Kernel::Trilinear => shader.add(&[module!("cubic"), module!("first_root_trilinear")]),
        Kernel::Bspline | Kernel::BsplineSmooth | Kernel::Bspline5 | Kernel::CatmullRom => {
            shader.add(&[module!("first_root_stepped")]);
        }
    }
    if let Some(bricks) = &measured.bricks {
        let mut words = vec![0u32; bricks.ranges.len().div_ceil(32)];
        for (i, [lo, hi]) in bricks.ranges.iter().enumerate() {
            words[i / 32] |= u32::from(lo - slack <= iso && iso <= hi + slack) << (i % 32);
        }
        shader.add(&[module!("active")]);
        shader.bind(23, "the bricks of the surface", Data::Words(words));
        shader.stages.passed.push("pass_brick");
    }
    if has_mask {
        shader.add(&[module!("masked")]);
        shader.stages.passed.push("pass_masked");
    }
    shader.block.number("iso", scales.value(iso).clamp(-LARGEST, LARGEST));
}

/// Adds the test for the inside of the surface, for cuts by planes.
pub(crate) fn add_inside(shader: &mut Shader, outside: Outside, has_mask: bool) {
    shader.add(&[module!("clipped_inside"), if has_mask { module!("unmasked_cells") } else { module!("every_cell") }]);
    shader.constant("OUTSIDE_IS_LOW", Constant::Bool(outside == Outside::Low));
}

/// Adds an iso-surface and the end of rays at it. Its search must have been added.
pub(crate) fn add(shader: &mut Shader, shot: &Shot, surface: &OpaqueSurface, has_mask: bool) {
    let object = shot.background();
    shader.add(&[module!("../ray/surface")]);
    if shot.clipping.planes.is_empty() {
        shader.add(&[module!("whole")]);
    } else {
        add_inside(shader, object.reconstruction.outside, has_mask);
        shader.add(&[module!("clipped")]);
        shader.stages.ends.push("cut_surface");
    }
    shader.block.vector("surface_rgb", surface.rgb.into());
    shader.stages.begin_ray.push("find_surface");
    if surface.alone {
        shader.add(&[module!("alone")]);
        shader.stages.samples_left.push("no_samples");
    }
    shader.stages.ends.push("meet_surface");
    if !shot.clipping.planes.is_empty() {
        shader.stages.ends.push("leave_surface");
    }
}

/// Adds κ along the ray, before cuts are measured.
pub(crate) fn add_curvature_along_ray(shader: &mut Shader) {
    shader.add(&[module!("curvature_along_ray")]);
    shader.stages.measured.push("measure_along_ray_at_surface");
}

/// Adds the caps of cuts, after the light. `in_styles` tells whether some caps are styles.
pub(crate) fn add_caps(shader: &mut Shader, in_styles: bool) {
    shader.add(&[module!("under_cap"), module!("capped")]);
    shader.stages.on_surface.push("cap_surface");
    if in_styles {
        shader.add(&[module!("capped_by_style")]);
        shader.stages.on_surface.push("cap_surface_by_style");
    }
}
