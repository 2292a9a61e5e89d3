//! Layers of a picture ([IO-6]).

use crate::GpuError;
use crate::field::Scales;
use crate::ray::EYE_NORMAL;
use crate::shader::{Shader, module};
use drypoint_scene::math::scale_by_power_of_two;
use drypoint_scene::picture::LayerKind;

/// From here on a depth stands for none.
const NOWHERE: f64 = 1e37;

/// Adds the channels of layers, and the sums that they need.
pub(crate) fn add(shader: &mut Shader, layers: &[LayerKind]) -> Result<(), GpuError> {
    if layers.iter().any(|&layer| !matches!(layer, LayerKind::Beauty | LayerKind::Counts)) {
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
                channels.push("real(samples_of_pixel)".to_owned());
                shader.add(&[module!("counts")]);
                shader.stages.begin_ray.push("begin_count");
                shader.stages.visited.push("count_sample");
                shader.stages.end_ray.push("end_count");
            }
            LayerKind::Halo(_) => {
                return Err(GpuError::Missing { what: "intensities of halos", key: "picture.layers" });
            }
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
