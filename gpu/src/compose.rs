//! The shader of a shot: which modules it is put together from, and what they read.

use crate::field::Scales;
use crate::shader::{Constant, Shader};
use crate::{GpuError, Inputs, Precision, field, interactive_volume_illustration, ray, shading, transfer};
use drypoint_scene::picture::LayerKind;
use drypoint_scene::shot::{Cap, Illumination, KappaSource, Lighting, Material, Shot};
use drypoint_scene::transfer::Function;

/// The share of a gradient that is rounding ([PREC-3]).
fn no_normal(precision: Precision) -> f64 {
    match precision {
        Precision::Single => 1.0 / (1u64 << 20) as f64,
        Precision::Double => 1.0 / (1u64 << 46) as f64,
    }
}

/// Puts the shader of a shot together, for layers in their order.
pub(crate) fn shader(
    shot: &Shot,
    layers: &[LayerKind],
    inputs: &Inputs<'_>,
    precision: Precision,
) -> Result<(Shader, Scales), GpuError> {
    let ([object], measured, grid) = (&shot.objects, inputs.measured, inputs.volume.grid());
    refuse(shot, inputs)?;
    let mut shader = Shader::default();
    let scales = Scales::new(measured, grid);
    // The field and its rays.
    field::kernel::add(&mut shader, object.reconstruction.kernel, measured, grid);
    ray::add_lattice(&mut shader, shot, grid)?;
    // Samples.
    transfer::add_nodes(&mut shader, &object.function, &scales)?;
    ray::add_cast(&mut shader, shot);
    if let Some(bricks) = &measured.bricks {
        ray::add_bricks(&mut shader, shot, bricks, &scales, precision);
    }
    let clips = !shot.clipping.planes.is_empty();
    if clips {
        ray::add_clip(&mut shader, &shot.clipping);
    }
    // Quantities of layers `first.*` are measured at every visible sample.
    let query = object.first.map_or(object.query, |first| object.query.and(first));
    if query.kappa == KappaSource::AlongRay {
        return Err(GpuError::Missing { what: "curvatures along the ray", key: "contours.kappa" });
    }
    if query.gradient {
        field::gradient::add(&mut shader, object, measured, &scales, no_normal(precision));
        ray::add_gradient(&mut shader, measured, &scales);
    }
    if query.hessian {
        let is_integer = inputs.volume.voxels().voxel_type().is_integer();
        field::hessian::add(&mut shader, object, is_integer, measured, &scales, precision)?;
        ray::add_curvature(&mut shader, query);
    }
    match (&*object.function, &object.material) {
        (Function::Regular(nodes), Material::Regular(lit)) => {
            transfer::add_colors(&mut shader, &nodes.color);
            add_light(&mut shader, lit);
        }
        (Function::Style { .. }, Material::Style(_)) => {
            return Err(GpuError::Missing { what: "styles", key: "transfer.nodes" });
        }
        _ => return Err(GpuError::Material),
    }
    if clips {
        ray::add_cuts(&mut shader);
    }
    // Pixels.
    ray::add_pixels(&mut shader, shot, inputs.background);
    ray::layers::add(&mut shader, layers)?;
    shader.constant("CHANNELS", Constant::Int(shader.stages.channels.len() as i64));
    Ok((shader, scales))
}

/// Refuses what no module draws.
fn refuse(shot: &Shot, inputs: &Inputs<'_>) -> Result<(), GpuError> {
    let missing = |is: bool, what, key| if is { Err(GpuError::Missing { what, key }) } else { Ok(()) };
    missing(!shot.halos.list.is_empty(), "halos", "halo")?;
    missing(shot.surface.is_some(), "iso-surfaces", "surface")?;
    let has_style = shot.clipping.caps.iter().any(|cap| matches!(cap, Cap::Style(_)));
    missing(has_style, "styles on cuts", "clip.style")?;
    missing(inputs.volume.mask().is_some(), "volumes with values that are not numbers", "volume")
}

/// Adds the light of a regular function.
fn add_light(shader: &mut Shader, lit: &Illumination) {
    match &lit.lighting {
        Lighting::Flat => {}
        Lighting::Phong(phong) => shading::add(shader, phong),
        Lighting::Toon(toon) => interactive_volume_illustration::add_toon(shader, toon),
    }
    if let Some(offset) = lit.silhouette {
        interactive_volume_illustration::add_silhouette(shader, offset);
    }
    if lit.view_opacity > 0.0 {
        interactive_volume_illustration::add_view_opacity(shader, lit.view_opacity);
    }
}
