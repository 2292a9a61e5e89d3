//! Selections and ghosts as they are drawn (eqs. 2, 3; [VS-2]).

use crate::field::{Scales, gradient};
use crate::module::module;
use crate::shader::{Constant, Shader};
use drypoint_scene::math::scale_by_power_of_two;
use drypoint_scene::shot::{Membership, SelectionParams};

/// The names that the picture's shader calls.
pub(crate) const NAMES: &[&str] = &[
    "aim_part",
    "part_range",
    "selection_range",
    "part_sample",
    "part_takes",
    "part_membership",
    "part_set",
    "unlit_part",
    "light_part",
    "seen_part",
    "far_side",
    "last_member",
    "sow_part",
    "sow_beside",
];

/// Adds a part to the shader of its look. `is_of_volume` tells whether its samples are those of the picture's volume,
/// and `takes` whether the selection is taken from that volume. `has_last_member` tells whether a cutaway needs it, and
/// `seeds` whether halos do.
pub(crate) fn add(
    shader: &mut Shader,
    selection: &SelectionParams,
    is_of_volume: bool,
    takes: bool,
    (has_last_member, seeds): (bool, bool),
    [own, main]: [&Scales; 2],
) {
    shader.stages.objects = Some(String::new());
    // A part without gradients has none to move.
    if !shader.modules.iter().any(|module| module.text.contains("fn moved_gradient")) {
        shader.add(&[gradient::STILL]);
    }
    shader.add(&[module!("part_ray")]);
    shader.add(&[if is_of_volume { module!("part_ray_shared") } else { module!("part_ray_own") }]);
    if takes {
        shader.add(&[module!("part_takes")]);
    }
    if has_last_member {
        shader.add(&[module!("part_ray_last")]);
    }
    if seeds {
        shader.add(&[module!("object_seeds")]);
    }
    shader.constant("BY_VALUE", Constant::Bool(matches!(selection.membership, Membership::Value(_))));
    // Its numbers in those of the picture's volume.
    let block = &mut shader.block;
    block.number("value_factor", scale_by_power_of_two(1.0, own.value - main.value));
    block.number("value_offset", main.value(own.to_value(0.0)));
    block.number("gradient_factor", scale_by_power_of_two(1.0, own.gradient - main.gradient));
}
