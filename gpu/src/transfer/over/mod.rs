//! Transfer functions over two quantities ([STF-4]).

use crate::GpuError;
use crate::field::{Scales, mask};
use crate::inputs::ObjectInputs;
use crate::module::{Module, module};
use crate::number::NUMBER;
use crate::shader::{Constant, Data, Shader};
use drypoint_scene::glam::{DMat3, DVec3};
use drypoint_scene::math;
use drypoint_scene::other_grid::OtherGrid;
use drypoint_scene::shot::{Axis, KappaSource, LabelLookup, SampleQuery, Shot};
use drypoint_scene::space::Grid;
use drypoint_scene::transfer::Rows;
use drypoint_scene::volume::labels::LabelVolume;
use drypoint_scene::volume::{Anatomy, Volume};

/// The colours of a place between nodes.
pub(crate) const COLORS: Module = module!("colors_over_two");
/// The styles of a place between nodes.
pub(crate) const STYLES: Module = module!("lookup_over_two");

/// Adds a function over two quantities, after all measures of samples. Both quantities are evaluated first, the rest
/// only if α_u > 0.
pub(crate) fn add(
    shader: &mut Shader,
    shot: &Shot,
    rows: &Rows,
    inputs: &ObjectInputs<'_>,
    scales: &Scales,
) -> Result<(), GpuError> {
    let object = shot.background();
    let (at, opacity, _) = object.function.nodes();
    let further = [0, 1].map(|axis| inputs.data.further[axis].map(Further::new));
    let scaled = |axis: usize, at: &[f64]| -> Vec<f64> {
        let place = |&at: &f64| match (&rows.over[axis], &further[axis]) {
            (Axis::Value, _) => scales.value(at),
            (Axis::GradientMagnitude, _) if !rows.normalized => scales.gradient(at),
            (Axis::Volume(_), Some(further)) => further.number(at),
            _ => at,
        };
        at.iter().map(place).collect()
    };
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
    let (mut numbers, mut masks) = (Vec::new(), Vec::new());
    for axis in 0..2 {
        let expression = match (&rows.over[axis], &further[axis]) {
            (Axis::DistanceToLabel(_), _) => {
                let distances = inputs.measured.label_distances[axis].as_ref().ok_or(GpuError::Material)?;
                let call = call("on_grid", numbers.len(), inputs.data.volume.dims(), "sample.at");
                numbers.extend_from_slice(distances);
                call
            }
            (Axis::Volume(_), Some(further)) => {
                let (first, dims) = (numbers.len(), further.volume.dims());
                further.append(&mut numbers, inputs);
                shader.add(&[module!("grid_numbers"), module!("other_volume")]);
                match further.volume.mask() {
                    None => call("further_value", first, dims, "sample.position"),
                    Some(mask) => {
                        let first_word = masks.len();
                        masks.extend(mask::words(mask, dims));
                        shader.add(&[module!("other_volume_masked")]);
                        call("further_value_unmasked", first, dims, &format!("{first_word}, sample.position"))
                    }
                }
            }
            _ => coordinate(shader, axis, rows, shot, inputs)?,
        };
        shader.stages.coordinates.push(expression);
    }
    if !numbers.is_empty() {
        shader.add(&[module!("grid_numbers")]);
        shader.block.number("grid_slack", OtherGrid::SLACK);
        shader.bind(16, "numbers of the transfer function's quantities", Data::Reals(numbers));
    }
    if !masks.is_empty() {
        shader.bind(17, "the masks of further volumes", Data::Words(masks));
    }
    shader.stages.is_seen.push("is_in_plane");
    let (first, _) = object.query.split(&rows.over);
    let (first, rest) = shader.stages.measured.iter().partition(|stage| is_of(stage, first));
    (shader.stages.measured_first, shader.stages.measured) = (first, rest);
    Ok(())
}

/// Whether a stage measures a quantity of a query.
pub(crate) fn is_of(stage: &str, query: SampleQuery) -> bool {
    match stage {
        "measure_gradient" | "measure_magnitude" => query.gradient,
        "measure_along_ray" | "measure_along_ray_at_surface" => query.kappa == KappaSource::AlongRay,
        // Everything that needs a Hessian.
        _ => query.hessian,
    }
}

/// A further volume over which a function is, in numbers of the shader.
struct Further<'a> {
    volume: &'a Volume,
    low: f64,
    /// e: values minus the lowest one are divided by 2^e.
    exponent: i32,
}

impl<'a> Further<'a> {
    fn new(volume: &'a Volume) -> Self {
        let [low, high] = volume.range();
        Self { volume, low, exponent: math::exponent(high - low) }
    }

    /// Converts a value to the shader's scale.
    fn number(&self, value: f64) -> f64 {
        math::scale_by_power_of_two(value - self.low, -self.exponent)
    }

    /// Appends the map from the data's index space, row by row, and the voxels.
    fn append(&self, numbers: &mut Vec<f64>, inputs: &ObjectInputs<'_>) {
        let Self { volume, .. } = self;
        let own = Anatomy::between(volume.grid(), volume.anatomy(), inputs.data.volume.anatomy());
        let map = OtherGrid::new(inputs.data.volume.grid(), &own);
        let (linear, offset) = map.map_or((DMat3::IDENTITY, DVec3::ZERO), |map| map.parts());
        for row in 0..3 {
            numbers.extend(linear.row(row).to_array());
            numbers.push(offset[row]);
        }
        let value = |i: usize| volume.slope() * volume.voxels().get(i) + volume.intercept();
        numbers.extend((0..volume.grid().len()).map(|i| self.number(value(i))));
    }
}

/// The expression of a coordinate that is interpolated from numbers on a grid. `more` are the arguments after its size.
fn call(function: &str, first: usize, [x, y, z]: [usize; 3], more: &str) -> String {
    format!("coordinate({function}({first}, vec3({x}, {y}, {z}), {more}))")
}

/// The expression of a sample's coordinate along an axis. The functions that it calls are added.
fn coordinate(
    shader: &mut Shader,
    axis: usize,
    rows: &Rows,
    shot: &Shot,
    inputs: &ObjectInputs<'_>,
) -> Result<String, GpuError> {
    let grid = inputs.data.volume.grid();
    let number = match &rows.over[axis] {
        Axis::Value => "sample.s".to_owned(),
        Axis::GradientMagnitude => {
            shader.add(&[module!("sample_quantities")]);
            if rows.normalized { "magnitude_in_range(a)" } else { "magnitude_of_gradient(a)" }.to_owned()
        }
        Axis::K1 => "a.principal.x".to_owned(),
        Axis::K2 => "a.principal.y".to_owned(),
        Axis::Mean => "(a.principal.x + a.principal.y) * 0.5".to_owned(),
        Axis::Gaussian => "a.principal.x * a.principal.y".to_owned(),
        Axis::AlongView if shot.clipping.planes.is_empty() => "a.kappa".to_owned(),
        // On a cut there is no curvature ([RAY-8]).
        Axis::AlongView => "select(a.kappa, real(0.0), cut_plane >= 0 && sample.k == cut_k)".to_owned(),
        Axis::Distance(p) => {
            if !shader.modules.contains(&module!("point")) {
                shader.add(&[module!("point")]);
                add_columns(shader, ["world_axis_x", "world_axis_y", "world_axis_z"], grid.axes().to_cols_array_2d());
            }
            let point = ["point_across", "point_down"][axis];
            shader.block.vector(point, grid.origin() - *p);
            format!("distance_from(sample.position, {point}())")
        }
        Axis::Label => {
            add_label_lookup(shader, shot, inputs)?;
            return Ok("Coordinate(0.0, label_at(sample.position))".to_owned());
        }
        // A further volume that was not handed over.
        Axis::DistanceToLabel(_) | Axis::Volume(_) => return Err(GpuError::Material),
    };
    Ok(format!("coordinate({number})"))
}

/// Adds the labels of positions, once.
pub(crate) fn add_label_lookup(shader: &mut Shader, shot: &Shot, inputs: &ObjectInputs<'_>) -> Result<(), GpuError> {
    if shader.modules.contains(&module!("labels")) {
        return Ok(());
    }
    let labels = inputs.data.labels.ok_or(GpuError::Material)?;
    let own = labels.grid_in(inputs.data.volume.anatomy());
    add_labels(shader, labels, &own, shot.objects[0].label_lookup);
    add_map(shader, inputs.data.volume.grid(), &own);
    Ok(())
}

/// Adds three vectors.
fn add_columns(shader: &mut Shader, names: [&'static str; 3], columns: [[f64; 3]; 3]) {
    for (name, column) in names.into_iter().zip(columns) {
        shader.block.vector(name, DVec3::from_array(column));
    }
}

/// Adds the ids of voxels, which lie on a grid of their own ([STF-13]).
fn add_labels(shader: &mut Shader, labels: &LabelVolume, own: &Grid, lookup: LabelLookup) {
    shader.add(&[module!("labels")]);
    shader.add(&[match lookup {
        LabelLookup::Nearest => module!("labels_nearest"),
        LabelLookup::Smooth => module!("labels_smooth"),
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
    let Some(map) = OtherGrid::new(data, own) else { return shader.add(&[module!("labels_same_grid")]) };
    shader.add(&[module!("labels_other_grid")]);
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
