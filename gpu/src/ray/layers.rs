//! Layers of a picture ([IO-6]).

use crate::field::Scales;
use crate::module::module;
use crate::ray::EYE_NORMAL;
use crate::shader::HaloStages;
use crate::shader::{Channel, Shader};
use drypoint_scene::math::scale_by_power_of_two;
use drypoint_scene::picture::LayerKind;
use drypoint_scene::shot::Shot;

/// A depth from here on stands for a missing one.
const NOWHERE: f64 = 1e37;

/// The sums along a ray, from `begin_sums` on.
pub(crate) const KEPT: [&str; 21] = [
    "ray_sums.opacity",
    "ray_sums.weight",
    "ray_sums.first.depth",
    "ray_sums.first.value",
    "ray_sums.first.normal.x",
    "ray_sums.first.normal.y",
    "ray_sums.first.normal.z",
    "ray_sums.first.curvature.x",
    "ray_sums.first.curvature.y",
    "ray_sums.first.curvature.z",
    "ray_sums.half",
    "ray_sums.depth",
    "ray_sums.normal.x",
    "ray_sums.normal.y",
    "ray_sums.normal.z",
    "ray_sums.gradient.x",
    "ray_sums.gradient.y",
    "ray_sums.gradient.z",
    "ray_sums.curvature.x",
    "ray_sums.curvature.y",
    "ray_sums.curvature.z",
];

/// Adds the channels of layers of a shot, and the sums that they need.
pub(crate) fn add(shader: &mut Shader, layers: &[LayerKind], shot: &Shot) {
    let ends = layers.iter().map(|layer| if let LayerKind::Part(n) = layer { n + 1 } else { 0 });
    shader.stages.covering = ends.max().unwrap_or(0);
    if shader.stages.covering > 0 {
        let lines = match shader.stages.begin_part.contains(&"begin_lines") {
            true => module!("layers_behind_lines"),
            false => module!("layers_without_lines"),
        };
        shader.add(&[lines, module!("layers_objects")]);
        shader.stages.begin_ray.push("begin_coverage");
        shader.stages.end_ray.push("pool_coverage");
        // Objects say what samples show where there are some.
        if shot.combination.is_none() {
            shader.add(&[module!("layers_background")]);
        }
        if shot.meshes.is_empty() {
            shader.stages.collect.push("collect_coverage");
        } else {
            shader.add(&[module!("layers_without_meshes")]);
            shader.stages.collect.push("collect_coverage_without_meshes");
        }
    }
    if layers.iter().any(|&layer| !matches!(layer, LayerKind::Beauty | LayerKind::Counts)) {
        shader.add(&[EYE_NORMAL, module!("layers")]);
        shader.stages.begin_ray.push("begin_sums");
        shader.stages.collect.push("collect_layers");
        shader.stages.end_ray.push("pool_sums");
    }
    if layers.contains(&LayerKind::Counts) {
        shader.add(&[module!("counts")]);
        shader.stages.begin_ray.push("begin_count");
        shader.stages.visited.push("count_sample");
        shader.stages.end_ray.push("end_count");
    }
    for &layer in layers {
        let expressions = expressions(layer);
        let is_of_one_ray = !(layer == LayerKind::Beauty || layer.is_mean());
        let channel = |expression| Channel { expression, is_of_one_ray };
        shader.stages.channels.extend(expressions.into_iter().map(channel));
    }
}

/// Expressions for the channels of a layer.
fn expressions(layer: LayerKind) -> Vec<String> {
    let mean = |name: &str| ["x", "y", "z"].map(|axis| format!("mean_of(pixel_sums.{name}.{axis})")).to_vec();
    let first = |name: &str| ["x", "y", "z"].map(|axis| format!("pixel_sums.first.{name}.{axis}")).to_vec();
    let one = |expression: &str| vec![expression.to_owned()];
    match layer {
        LayerKind::Beauty => ["mean.r", "mean.g", "mean.b", "mean.a"].map(str::to_owned).to_vec(),
        LayerKind::Z => one("pixel_sums.half"),
        LayerKind::Depth => ["first.depth", "half", "depth"].map(|name| format!("pixel_sums.{name}")).to_vec(),
        LayerKind::Normal => mean("normal"),
        LayerKind::Gradient => mean("gradient"),
        LayerKind::Curvature => mean("curvature"),
        LayerKind::CurvatureAlongView => one("mean_of(pixel_sums.curvature.z)"),
        LayerKind::First => one("pixel_sums.first.value"),
        LayerKind::FirstNormal => first("normal"),
        LayerKind::FirstCurvature => first("curvature"),
        LayerKind::FirstCurvatureAlongView => one("pixel_sums.first.curvature.z"),
        LayerKind::Counts => one("real(samples_of_pixel)"),
        LayerKind::Halo(halo) => vec![HaloStages::intensity(halo)],
        LayerKind::Part(object) => vec![format!("pixel_coverage[{object}] / rays_of_pixel")],
    }
}

/// Converts a number of a layer from the shader's units to the picture's.
pub(crate) fn in_picture_units(layer: LayerKind, number: f64, scales: &Scales) -> f64 {
    match layer {
        LayerKind::Z | LayerKind::Depth if number >= NOWHERE => f64::INFINITY,
        LayerKind::First if number >= NOWHERE => 0.0,
        LayerKind::First => scales.to_value(number),
        LayerKind::Gradient => scale_by_power_of_two(number, scales.gradient),
        _ => number,
    }
}
