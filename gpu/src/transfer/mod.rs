//! Transfer functions: from a value to a place between nodes ([STF-3]).

use crate::GpuError;
use crate::field::Scales;
use crate::shader::{Constant, Data, Shader, module};
use drypoint_scene::transfer::Function;

/// Adds the nodes of a function, and where it is read from a table its entries.
pub(crate) fn add_nodes(shader: &mut Shader, function: &Function, scales: &Scales) -> Result<(), GpuError> {
    let (at, opacity, rows) = function.nodes();
    if rows.is_some() {
        return Err(GpuError::Missing { what: "functions over two quantities", key: "transfer.over" });
    }
    let at: Vec<f64> = at.iter().map(|&at| scales.value(at)).collect();
    let end = at.len() - 1;
    let index = function.table().map(|(index, _)| index);
    let node = |k: usize| {
        let next = (k + 1).min(end);
        let width = if k < end { at[next] - at[k] } else { 1.0 };
        [at[k], width, opacity[k], opacity[next], index.map_or(k as f64, |index| index[k])]
    };
    shader.add(&[module!("piecewise")]);
    shader.constant("NODES", Constant::Int(at.len() as i64));
    shader.bind(2, "the transfer function", Data::Reals((0..=end).flat_map(node).collect()));
    if let Some((_, nodes)) = function.table() {
        shader.add(&[module!("table")]);
        shader.block.number("last_node", nodes.saturating_sub(1) as f64);
        shader.stages.nodes.push("between_nodes");
    }
    Ok(())
}

/// Adds the colours of nodes.
pub(crate) fn add_colors(shader: &mut Shader, colors: &[[f64; 3]]) {
    shader.add(&[module!("colors")]);
    shader.bind(3, "the transfer function's colours", Data::Reals(colors.iter().flatten().copied().collect()));
    shader.stages.shown.push("node_color");
}
