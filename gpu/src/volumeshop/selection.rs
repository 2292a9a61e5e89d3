//! Selections on rays ([VS-2]).

use crate::field::Scales;
use crate::module::module;
use crate::number::NUMBER;
use crate::shader::{Constant, Data, Shader};
use crate::transfer;
use drypoint_scene::glam::DVec3;
use drypoint_scene::shot::{Membership, SelectionParams};
use drypoint_scene::volume::Selection;

/// The names that the shader of a part calls.
pub(crate) const NAMES: &[&str] = &["aim_selection", "selection_range", "is_in_selection", "membership_at", "far_side"];

/// Adds a selection to a shader with the rays of its memberships' grid. `scales` are those of the data's values.
pub(crate) fn add(shader: &mut Shader, selection: &SelectionParams, memberships: Option<&Selection>, scales: &Scales) {
    shader.add(&[module!("selection_ray")]);
    // An empty selection has no box, and no cutaway asks for it.
    let [low, high] = selection.index_box.unwrap_or_default();
    shader.block.vector("selected_low", low);
    shader.block.vector("selected_high", high);
    match (&selection.membership, memberships) {
        (Membership::Value(pairs), _) => {
            let at: Vec<f64> = pairs.iter().map(|pair| scales.value(pair[0])).collect();
            let f: Vec<f64> = pairs.iter().map(|pair| pair[1]).collect();
            shader.add(&[NUMBER]);
            transfer::add_piecewise(shader, [&at, &f], None);
            shader.add(&[module!("membership_of_value")]);
        }
        (Membership::Voxels, Some(memberships)) => add_voxels(shader, selection, memberships),
        (Membership::Everything | Membership::Voxels, _) => shader.add(&[module!("membership_everything")]),
    }
}

/// Adds a selection volume: the voxels of its box.
fn add_voxels(shader: &mut Shader, selection: &SelectionParams, memberships: &Selection) {
    let volume = &memberships.memberships;
    let last = volume.dims().map(|n| n - 1);
    let [lo, hi] = selection.index_box.unwrap_or_default();
    // Axes of one voxel reach half a voxel each way.
    let voxel = |end: DVec3| -> [usize; 3] {
        let [x, y, z] = end.to_array().map(|x| x.round().max(0.0) as usize);
        [x.min(last[0]), y.min(last[1]), z.min(last[2])]
    };
    let (first, end) = (voxel(lo), voxel(hi));
    let dims: [usize; 3] = std::array::from_fn(|axis| end[axis] - first[axis] + 1);
    let mut members = Vec::with_capacity(dims.iter().product());
    for z in first[2]..=end[2] {
        for y in first[1]..=end[1] {
            members.extend((first[0]..=end[0]).map(|x| volume.value([x, y, z])));
        }
    }
    shader.add(&[NUMBER, module!("../field/place"), module!("../transfer/over/grid_numbers")]);
    shader.add(&[module!("membership_of_voxels")]);
    for (name, n) in ["MEMBERS_X", "MEMBERS_Y", "MEMBERS_Z"].into_iter().zip(dims) {
        shader.constant(name, Constant::Int(n as i64));
    }
    shader.block.vector("first_member", DVec3::from_array(first.map(|i| i as f64)));
    shader.block.vector("last_cell", DVec3::from_array(dims.map(|n| (n.max(2) - 2) as f64)));
    shader.block.vector("long_axes", DVec3::from_array(dims.map(|n| if n == 1 { 0.0 } else { 1.0 })));
    shader.bind(16, "a selection", Data::Reals(members));
}
