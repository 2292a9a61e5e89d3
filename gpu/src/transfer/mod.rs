//! Transfer functions, which map a value to a place between nodes ([STF-3]).

pub(crate) mod over;

use crate::Precision;
use crate::field::Scales;
use crate::module::{Module, module};
use crate::shader::{Constant, Data, Shader};
use drypoint_scene::transfer::{Function, Rows, gate};

/// The colours of a place between the nodes of a function over the value.
pub(crate) const COLORS_OVER_VALUE: Module = module!("colors_over_value");

/// Adds the nodes of a function, and its entries if it is read from a table. For a function over two quantities, these
/// are the values at which it can be visible.
pub(crate) fn add_nodes(shader: &mut Shader, function: &Function, scales: &Scales, precision: Precision) {
    let (at, opacity, rows) = function.nodes();
    let scaled = |at: &[f64]| -> Vec<f64> { at.iter().map(|&at| scales.value(at)).collect() };
    let [at, opacity] = match rows {
        None => [scaled(at), opacity.to_vec()],
        Some(rows) => {
            let rounded = |at: f64| if precision == Precision::Single { f64::from(at as f32) } else { at };
            gate::over_value(&scaled(at), opacity, &Rows { at: scaled(&rows.at), ..rows.clone() }, rounded)
        }
    };
    add_piecewise(shader, [&at, &opacity], function.table().map(|(index, _)| index));
    if let Some((_, nodes)) = function.table() {
        shader.add(&[module!("table")]);
        shader.block.number("last_node", nodes.saturating_sub(1) as f64);
        shader.stages.nodes.push("between_nodes");
    }
}

/// Adds a piecewise-linear function over numbers: places and values of nodes. For a table it adds the places of its
/// entries.
pub(crate) fn add_piecewise(shader: &mut Shader, [at, opacity]: [&[f64]; 2], index: Option<&[f64]>) {
    let end = at.len() - 1;
    let node = |k: usize| {
        let next = (k + 1).min(end);
        let width = if k < end { at[next] - at[k] } else { 1.0 };
        [at[k], width, opacity[k], opacity[next], index.map_or(k as f64, |index| index[k])]
    };
    shader.add(&[module!("piecewise")]);
    shader.constant("NODES", Constant::Int(at.len() as i64));
    shader.bind(2, "the transfer function", Data::Reals((0..=end).flat_map(node).collect()));
}

/// Adds the colours of nodes. `between` finds the colour and the opacity of a sample.
pub(crate) fn add_colors(shader: &mut Shader, colors: &[[f64; 3]], between: Module) {
    shader.add(&[module!("colors"), between]);
    shader.bind(3, "the transfer function's colours", Data::Reals(colors.iter().flatten().copied().collect()));
    shader.stages.unlit.push("node_color");
}
