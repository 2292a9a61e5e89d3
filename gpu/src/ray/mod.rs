//! Rays: their samples, what samples show, and the pixels made of them.

mod brick_distances;
pub(crate) mod layers;
pub(crate) mod lines;
pub(crate) mod passes;
pub(crate) mod present;

use crate::block::ParamBlock;
use crate::field::Scales;
use crate::module::{Module, module};
use crate::number::{COLOR, ELEMENTARY, NUMBER};
use crate::place::GridPlacement;
use crate::shader::{Constant, Data, Shader};
use crate::{GpuError, Precision};
use drypoint_scene::backdrop::Backdrop;
use drypoint_scene::clip::{ClipPlane, ClipPlanes};
use drypoint_scene::color::premultiply;
use drypoint_scene::measured::Measured;
use drypoint_scene::shot::{BlendSpace, Cap, Clipping, KappaSource, SampleQuery, Shot, StepAlong};
use drypoint_scene::volume::{BRICK, Bricks};

/// The largest number of sample planes on either side of the middle of the volume. Up to it, integers and halves are
/// exact in f32.
const MOST_PLANES: f64 = 4_000_000.0;

/// Rays, and the box of the volume.
pub(crate) const RAY: Module = module!("ray");

/// N in eye space.
pub(crate) const EYE_NORMAL: Module = module!("eye_normal");

/// Adds rays and their samples.
pub(crate) fn add_lattice(shader: &mut Shader, shot: &Shot, place: &GridPlacement) -> Result<(), GpuError> {
    let Shot { view, lattice, .. } = shot;
    shader.add(&[RAY, module!("lattice")]);
    shader.constant("PERSPECTIVE", Constant::Bool(view.perspective));
    shader.constant("BY_RAY", Constant::Bool(view.perspective && lattice.along == StepAlong::Ray));
    add_view(&mut shader.block, shot, place)
}

/// Adds the numbers of the camera. Rays begin at the anchor, a plane in the middle of the volume, so that numbers of
/// f32 are of the volume's size.
pub(crate) fn add_view(block: &mut ParamBlock, shot: &Shot, place: &GridPlacement) -> Result<(), GpuError> {
    let (Shot { view, lattice, .. }, GridPlacement { grid, anchor, .. }) = (shot, place);
    let planes = lattice.planes(view, grid);
    if planes > MOST_PLANES {
        return Err(GpuError::TooManyPlanes { planes: planes as u64, most: MOST_PLANES as u64 });
    }
    let steps = anchor + 0.5;
    let first = match lattice.first(view) {
        i64::MIN => -MOST_PLANES,
        first => (first as f64 - anchor).clamp(-MOST_PLANES, MOST_PLANES),
    };
    let inverse = grid.inverse_axes();
    let [low, high] = place.index_box;
    block.number("step", lattice.step);
    block.number("anchor_steps", steps);
    block.number("first_plane", first);
    block.number("pixel", view.pixel);
    block.vector("view_right", view.right);
    block.vector("view_up", view.up);
    block.vector("view_forward", view.forward);
    block.vector("index_eye", grid.to_index(view.eye));
    block.vector("index_forward", inverse * view.forward);
    block.vector("pixel_right", inverse * view.right * view.pixel);
    block.vector("pixel_up", inverse * view.up * view.pixel);
    block.vector("anchor_middle", grid.to_index(view.eye + view.forward * (steps * lattice.step)));
    block.vector("box_low", low);
    block.vector("box_high", high);
    Ok(())
}

/// Adds the near distance, before which no surface or funnel begins.
pub(crate) fn add_near(block: &mut ParamBlock, shot: &Shot, place: &GridPlacement) {
    let Shot { view, lattice, .. } = shot;
    let near = if view.perspective { lattice.near / lattice.step - (place.anchor + 0.5) } else { -MOST_PLANES };
    block.number("near_steps", near.max(-MOST_PLANES));
}

/// Width in rays of the band about the picture from which halos reach into it.
pub(crate) fn guard(shot: &Shot) -> usize {
    shot.halos.list.iter().map(|halo| halo.spread.guard()).max().unwrap_or(0)
}

/// Whether a shot has an opaque surface at which rays end: an iso-surface or a mesh.
pub(crate) fn ends_rays(shot: &Shot) -> bool {
    shot.surface.is_some() || !shot.meshes.is_empty()
}

/// A ray through the volume alone.
pub(crate) const CAST_ALONE: &[Module] = &[module!("cast_alone")];

/// Adds the loop over samples and its functions. `cast` is the order in which a ray visits samples.
pub(crate) fn add_cast(shader: &mut Shader, shot: &Shot, cast: &[Module], has_lines: bool) {
    let object = shot.background();
    shader.add(&[ELEMENTARY, module!("opacity"), module!("accumulator"), module!("sample"), module!("cast")]);
    shader.add(cast);
    if has_lines {
        lines::add(shader);
    } else {
        shader.add(&[module!("path_whole")]);
    }
    shader.block.number("reference_length", object.reference_length);
    shader.block.number("stop_at", shot.stop_at);
    match shot.blend_space {
        BlendSpace::Linear => shader.add(&[module!("blend_linear")]),
        BlendSpace::Srgb => shader.add(&[COLOR, module!("blend_srgb")]),
    }
}

/// Adds the measures of gradients in the query of samples.
pub(crate) fn add_gradient(shader: &mut Shader, measured: &Measured, scales: &Scales) {
    shader.add(&[module!("evaluate_normal")]);
    shader.stages.measured.push("measure_gradient");
    if let Some([low, width]) = measured.gradient_range {
        shader.add(&[module!("evaluate_magnitude")]);
        shader.block.number("gradient_low", scales.gradient(low));
        shader.block.number("gradient_width", scales.gradient(width));
        shader.stages.measured.push("measure_magnitude");
    }
}

/// Adds the curvatures from Hessians in the query of samples.
pub(crate) fn add_curvature(shader: &mut Shader, query: SampleQuery) {
    shader.add(&[module!("evaluate_curvature")]);
    shader.constant("EXACT_KAPPA", Constant::Bool(query.kappa == KappaSource::Exact));
    shader.constant("PRINCIPAL", Constant::Bool(query.principal));
    shader.stages.measured.push("measure_curvature");
}

/// Adds the skipping of samples in masked cells.
pub(crate) fn add_mask(shader: &mut Shader) {
    shader.add(&[module!("skip_masked")]);
    shader.stages.next_plane.push("skip_masked");
    shader.stages.next_number.push("skip_masked");
}

/// Adds clip planes alone. The spheres of caps follow those of `styles`.
pub(crate) fn add_planes(shader: &mut Shader, planes: &ClipPlanes, caps: &[Cap], styles: usize) {
    let plane = |plane: &ClipPlane| {
        let cap = match plane.cap.and_then(|cap| caps.get(cap).copied()) {
            Some(Cap::Color { rgb: [r, g, b], opacity }) => [1.0, r, g, b, opacity],
            Some(Cap::Style(place)) => [2.0, (styles + place) as f64, 0.0, 0.0, 0.0],
            None => [0.0; 5],
        };
        let (n, world) = (plane.index_normal, plane.normal);
        [[n.x, n.y, n.z, plane.index_offset, world.x, world.y].as_slice(), &[world.z], &cap].concat()
    };
    shader.add(&[module!("plane")]);
    shader.constant("PLANES", Constant::Int(planes.0.len() as i64));
    shader.bind(7, "the clip planes", Data::Reals(planes.0.iter().flat_map(plane).collect()));
}

/// Adds clip planes and the ranges of rays that they leave, before shading is added.
pub(crate) fn add_clip(shader: &mut Shader, clipping: &Clipping, styles: usize) {
    add_planes(shader, &clipping.planes, &clipping.caps, styles);
    shader.add(&[module!("clipped_samples")]);
    shader.stages.samples_left.push("clip_run");
}

/// Samples that no plane cuts.
pub(crate) const UNCLIPPED: Module = module!("clipped_samples_none");

/// Adds the shading of samples on cuts, after measures and shading are added.
pub(crate) fn add_cuts(shader: &mut Shader) {
    shader.stages.measured.push("measure_cut");
    shader.stages.cut.push("show_cap");
}

/// Adds the end of rays at an opaque surface, before the search for it.
pub(crate) fn add_end(shader: &mut Shader) {
    shader.add(&[module!("end")]);
    shader.stages.begin_ray.push("forget_surface");
    shader.stages.samples_left.push("end_at_surface");
    shader.stages.all_left.push("end_at_surface");
    shader.stages.steps.push("share_before_surface");
}

/// The rounding of a value.
pub(crate) fn rounding(scales: &Scales, precision: Precision) -> f64 {
    let share = match precision {
        Precision::Single => 1.0 / (1u64 << 18) as f64,
        Precision::Double => 1.0 / (1u64 << 44) as f64,
    };
    share * drypoint_scene::math::scale_by_power_of_two(1.0, scales.value)
}

/// Adds the skipping of bricks that can show nothing.
pub(crate) fn add_bricks(shader: &mut Shader, shot: &Shot, bricks: &Bricks, scales: &Scales, precision: Precision) {
    let object = shot.background();
    let slack = rounding(scales, precision);
    let can_show = |&[lo, hi]: &[f64; 2]| object.function.can_be_visible([lo - slack, hi + slack], None, |at| at);
    let visible: Vec<bool> = bricks.ranges.iter().map(can_show).collect();
    let mut words = vec![0u32; visible.len().div_ceil(4)];
    for (i, far) in brick_distances::distances(&visible, bricks.dims).into_iter().enumerate() {
        words[i / 4] |= u32::from(far) << (8 * (i % 4));
    }
    shader.add(&[module!("brick_occupancy")]);
    add_brick_sizes(shader, bricks);
    shader.bind(5, "the distances of bricks", Data::Words(words));
    shader.stages.next_plane.push("skip_brick");
}

/// Adds the numbers of bricks.
pub(crate) fn add_brick_sizes(shader: &mut Shader, bricks: &Bricks) {
    shader.constant("BRICKS_X", Constant::Int(bricks.dims[0] as i64));
    shader.constant("BRICKS_Y", Constant::Int(bricks.dims[1] as i64));
    shader.constant("BRICK", Constant::Int(BRICK as i64));
}

/// The binding of a picture behind the volume.
pub(crate) const BACKGROUND: u32 = 4;

/// The name of the picture's width among the scalars; its height follows.
pub(crate) const WIDTH: &str = "picture_width";

/// The size of a picture, and the rays of its pixels.
pub(crate) fn size(shot: &Shot) -> ParamBlock {
    let mut block = ParamBlock::default();
    let [width, height] = shot.view.size.map(|n| n as f64);
    block.number(WIDTH, width);
    block.number("picture_height", height);
    block.number("rays_across", shot.rays_across as f64);
    block
}

/// Adds pixels and their background.
pub(crate) fn add_pixels(shader: &mut Shader, shot: &Shot, background: Backdrop<'_>) {
    shader.add(&[module!("pixel_sum")]);
    shader.block.append(&size(shot), "");
    if let Some(contrast) = shot.refine_above {
        shader.add(&[NUMBER, ELEMENTARY, COLOR, module!("refinement")]);
        shader.block.number("contrast", contrast);
    }
    shader.block.number("first_part", 0.0);
    shader.block.number("end_part", 0.0);
    shader.block.number("top_row", 0.0);
    shader.block.number("first_row", 0.0);
    shader.block.number("end_row", 0.0);
    let color = match background {
        Backdrop::None => [0.0; 4],
        Backdrop::Color(color) => premultiply(color),
        Backdrop::Pixels(pixels) => {
            shader.add(&[module!("background_pixels")]);
            let data = Data::Reals(pixels.iter().flatten().copied().collect());
            return shader.bind(BACKGROUND, "the background", data);
        }
    };
    shader.add(&[module!("background_color")]);
    for (name, value) in ["r", "g", "b", "a"].into_iter().zip(color) {
        shader.block.number(format!("background_{name}"), value);
    }
}
