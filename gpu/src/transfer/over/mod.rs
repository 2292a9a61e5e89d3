//! Transfer functions over two quantities ([STF-4]).

use crate::field::Scales;
use crate::number::NUMBER;
use crate::shader::{Constant, Data, Module, Shader, module};
use crate::{GpuError, Inputs};
use drypoint_scene::glam::DVec3;
use drypoint_scene::other_grid::OtherGrid;
use drypoint_scene::shot::{Axis, KappaSource, LabelLookup, Object, SampleQuery};
use drypoint_scene::space::Grid;
use drypoint_scene::transfer::Rows;
use drypoint_scene::volume::labels::LabelVolume;

/// The colours of a place between nodes.
pub(crate) const COLORS: Module = module!("colors_over_two");
/// The styles of a place between nodes.
pub(crate) const STYLES: Module = module!("styles_over_two");

/// Adds a function over two quantities, after everything that samples are asked for. Both quantities are asked first, and
/// the rest only where α_u > 0.
pub(crate) fn add(
    shader: &mut Shader,
    object: &Object,
    rows: &Rows,
    inputs: &Inputs<'_>,
    scales: &Scales,
) -> Result<(), GpuError> {
    let (at, opacity, _) = object.function.nodes();
    let scaled = |axis: usize, at: &[f64]| at.iter().map(|&at| scaled(&rows.over[axis], rows, scales, at)).collect();
    let numbers: [Vec<f64>; 3] = [scaled(0, at), opacity.to_vec(), scaled(1, &rows.at)];
    let ids = |axis: usize, at: &[f64]| -> Vec<u32> {
        if rows.over[axis].is_id() { at.iter().map(|&id| id as u32).collect() } else { Vec::new() }
    };
    let first = rows.first.iter().chain([&at.len()]).map(|&first| first as u32).collect();
    let words: [Vec<u32>; 3] = [first, ids(0, at), ids(1, &rows.at)];
    shader.add(&[NUMBER, module!("plane")]);
    shader.constant("PLANE_NODES", Constant::Int(at.len() as i64));
    shader.constant("PLANE_ROWS", Constant::Int(rows.at.len() as i64));
    shader.constant("ACROSS_IS_ID", Constant::Bool(rows.over[0].is_id()));
    shader.constant("DOWN_IS_ID", Constant::Bool(rows.over[1].is_id()));
    shader.bind(13, "the transfer function's places", Data::Reals(numbers.concat()));
    shader.bind(14, "the transfer function's rows", Data::Words(words.concat()));
    for (axis, name) in rows.over.iter().zip(["point_across", "point_down"]) {
        let expression = coordinate(shader, axis, name, rows.normalized, object, inputs)?;
        shader.stages.coordinates.push(expression);
    }
    shader.stages.is_seen.push("is_in_plane");
    let (first, _) = object.query.split(&rows.over);
    let (first, rest) = shader.stages.measured.iter().partition(|stage| is_of(stage, first));
    (shader.stages.measured_first, shader.stages.measured) = (first, rest);
    Ok(())
}

/// A place along an axis as the shader has it.
fn scaled(axis: &Axis<u32>, rows: &Rows, scales: &Scales, at: f64) -> f64 {
    match axis {
        Axis::Value => scales.value(at),
        Axis::GradientMagnitude if !rows.normalized => scales.gradient(at),
        _ => at,
    }
}

/// Whether a stage measures something of a query.
fn is_of(stage: &str, query: SampleQuery) -> bool {
    match stage {
        "measure_gradient" | "measure_magnitude" => query.gradient,
        "measure_along_ray" => query.kappa == KappaSource::AlongRay,
        // Everything that needs a Hessian.
        _ => query.hessian,
    }
}

/// The expression of a sample's coordinate along an axis, and what it calls.
fn coordinate(
    shader: &mut Shader,
    axis: &Axis<u32>,
    point: &'static str,
    normalized: bool,
    object: &Object,
    inputs: &Inputs<'_>,
) -> Result<String, GpuError> {
    let grid = inputs.volume.grid();
    let number = match axis {
        Axis::Value => "sample.s".to_owned(),
        Axis::GradientMagnitude => {
            shader.add(&[module!("gradient_magnitude")]);
            if normalized { "magnitude_in_range(a)" } else { "magnitude_of_gradient(a)" }.to_owned()
        }
        Axis::K1 => "a.principal.x".to_owned(),
        Axis::K2 => "a.principal.y".to_owned(),
        Axis::Mean => "(a.principal.x + a.principal.y) * 0.5".to_owned(),
        Axis::Gaussian => "a.principal.x * a.principal.y".to_owned(),
        Axis::AlongView => "a.kappa".to_owned(),
        Axis::Distance(p) => {
            if !shader.modules.contains(&module!("point_distance")) {
                shader.add(&[module!("point_distance")]);
                add_columns(shader, ["world_axis_x", "world_axis_y", "world_axis_z"], grid.axes().to_cols_array_2d());
            }
            shader.block.vector(point, grid.origin() - *p);
            format!("distance_from(sample.position, {point}())")
        }
        Axis::Label => {
            let labels = inputs.labels.ok_or(GpuError::Material)?;
            let own = labels.grid_in(inputs.volume.anatomy());
            add_labels(shader, labels, &own, object.label_lookup);
            add_map(shader, grid, &own);
            return Ok("Coordinate(0.0, label_at(sample.position))".to_owned());
        }
        Axis::DistanceToLabel(_) | Axis::Volume(_) => {
            return Err(GpuError::Missing {
                what: "functions over distances to labels or further volumes",
                key: "transfer.over",
            });
        }
    };
    Ok(format!("coordinate({number})"))
}

/// Adds three vectors.
fn add_columns(shader: &mut Shader, names: [&'static str; 3], columns: [[f64; 3]; 3]) {
    for (name, column) in names.into_iter().zip(columns) {
        shader.block.vector(name, DVec3::from_array(column));
    }
}

/// Adds the ids of voxels on their own grid ([STF-13]).
fn add_labels(shader: &mut Shader, labels: &LabelVolume, own: &Grid, lookup: LabelLookup) {
    shader.add(&[module!("label")]);
    shader.add(&[match lookup {
        LabelLookup::Nearest => module!("label_nearest"),
        LabelLookup::Smooth => module!("label_smooth"),
    }]);
    let dims = own.dims();
    let bits = 8 * labels.bytes() / own.len();
    let in_word = 32 / bits;
    let mut words = vec![0u32; own.len().div_ceil(in_word)];
    for i in 0..own.len() {
        words[i / in_word] |= labels.id(i) << (i % in_word * bits);
    }
    shader.constant("LABEL_BITS", Constant::Int(bits as i64));
    shader.constant("LABELS_X", Constant::Int(dims[0] as i64));
    shader.constant("LABELS_Y", Constant::Int(dims[1] as i64));
    shader.block.vector("label_last_cell", DVec3::from_array(dims.map(|n| (n.max(2) - 2) as f64)));
    shader.block.vector("label_long_axes", DVec3::from_array(dims.map(|n| if n == 1 { 0.0 } else { 1.0 })));
    shader.bind(15, "the labels", Data::Words(words));
}

/// Adds the map from the data's grid to that of the labels.
fn add_map(shader: &mut Shader, data: &Grid, own: &Grid) {
    let Some(map) = OtherGrid::new(data, own) else { return shader.add(&[module!("label_same_grid")]) };
    shader.add(&[module!("label_other_grid")]);
    let (linear, offset) = map.parts();
    add_columns(shader, ["to_labels_x", "to_labels_y", "to_labels_z"], linear.to_cols_array_2d());
    let ([low, high], [reach_low, reach_high]) = (map.own_box(), map.reach());
    for (name, value) in [
        ("to_labels", offset),
        ("label_box_low", low),
        ("label_box_high", high),
        ("label_reach_low", reach_low),
        ("label_reach_high", reach_high),
    ] {
        shader.block.vector(name, value);
    }
}
