//! Layers of a picture ([IO-6]).

use crate::GpuError;
use crate::field::Scales;
use crate::ray::EYE_NORMAL;
use crate::shader::{Shader, module};
use crate::volumetric_halos::Stages;
use drypoint_scene::math::scale_by_power_of_two;
use drypoint_scene::picture::LayerKind;

/// From here on a depth stands for none.
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

/// Adds the channels of layers, and the sums that they need.
pub(crate) fn add(shader: &mut Shader, layers: &[LayerKind]) -> Result<(), GpuError> {
    if layers.iter().any(|&layer| layer != LayerKind::Beauty) {
        shader.add(&[EYE_NORMAL, module!("layers")]);
        shader.stages.begin_ray.push("begin_sums");
        shader.stages.collect.push("collect_layers");
        shader.stages.end_ray.push("pool_sums");
    }
    let mean = |name: &str| ["x", "y", "z"].map(|axis| format!("mean_of(pixel_sums.{name}.{axis})"));
    let first = |name: &str| ["x", "y", "z"].map(|axis| format!("pixel_sums.first.{name}.{axis}"));
    for &layer in layers {
        let channels = &mut shader.stages.channels;
        match layer {
            LayerKind::Beauty => channels.extend(["mean.r", "mean.g", "mean.b", "mean.a"].map(str::to_owned)),
            LayerKind::Z => channels.push("pixel_sums.half".to_owned()),
            LayerKind::Depth => {
                channels.extend(["first.depth", "half", "depth"].map(|name| format!("pixel_sums.{name}")));
            }
            LayerKind::Normal => channels.extend(mean("normal")),
            LayerKind::Gradient => channels.extend(mean("gradient")),
            LayerKind::Curvature => channels.extend(mean("curvature")),
            LayerKind::CurvatureAlongView => channels.push("mean_of(pixel_sums.curvature.z)".to_owned()),
            LayerKind::First => channels.push("pixel_sums.first.value".to_owned()),
            LayerKind::FirstNormal => channels.extend(first("normal")),
            LayerKind::FirstCurvature => channels.extend(first("curvature")),
            LayerKind::FirstCurvatureAlongView => channels.push("pixel_sums.first.curvature.z".to_owned()),
            LayerKind::Counts => {
                return Err(GpuError::Missing { what: "counts of samples", key: "picture.layers" });
            }
            LayerKind::Halo(halo) => channels.push(Stages::intensity(halo)),
        }
    }
    Ok(())
}

/// A number of a layer in the units of the picture, of one in those of the shader.
pub(crate) fn in_picture_units(layer: LayerKind, number: f64, scales: &Scales) -> f64 {
    match layer {
        LayerKind::Z | LayerKind::Depth if number >= NOWHERE => f64::INFINITY,
        LayerKind::First if number >= NOWHERE => 0.0,
        LayerKind::First => scales.to_value(number),
        LayerKind::Gradient => scale_by_power_of_two(number, scales.gradient),
        _ => number,
    }
}
