//! The shader of a shot: which modules it is put together from, and what they read.

use crate::shader::{Constant, Shader};
use crate::{GpuError, Inputs, Precision, field, ray, shading, style_transfer_functions, transfer};
use drypoint_scene::picture::LayerKind;
use drypoint_scene::shot::{Illumination, KappaSource, Lighting, Material, Shot};
use drypoint_scene::transfer::Function;

/// The share of a gradient that is rounding ([PREC-3]).
fn no_normal(precision: Precision) -> f64 {
    match precision {
        Precision::Single => 1.0 / (1u64 << 20) as f64,
        Precision::Double => 1.0 / (1u64 << 46) as f64,
    }
}

/// Puts the shader of a shot together.
pub(crate) fn shader(shot: &Shot, inputs: &Inputs<'_>, precision: Precision) -> Result<Shader, GpuError> {
    let ([object], measured, grid) = (&shot.objects, inputs.measured, inputs.volume.grid());
    refuse(shot, inputs)?;
    let mut shader = Shader::default();
    let scales = field::Scales::new(measured, grid);
    // The field and its rays.
    field::add_kernel(&mut shader, object, measured, grid)?;
    ray::add_lattice(&mut shader, shot, grid)?;
    // Samples.
    transfer::add_nodes(&mut shader, &object.function, &scales, precision);
    ray::add_cast(&mut shader, shot);
    if let Some(bricks) = &measured.bricks {
        ray::add_bricks(&mut shader, shot, bricks, &scales, precision);
    }
    if object.query.gradient {
        field::add_gradient(&mut shader, object, measured, &scales, no_normal(precision))?;
        ray::add_gradient(&mut shader, measured, &scales);
    }
    if object.query.kappa == KappaSource::AlongRay {
        style_transfer_functions::add_curvature_along_ray(&mut shader, object.turn);
    }
    let rows = object.function.nodes().2;
    if let Some(rows) = rows {
        transfer::over::add(&mut shader, object, rows, inputs, &scales)?;
    }
    let between = |over_value, over_two| if rows.is_some() { over_two } else { over_value };
    match (&*object.function, &object.material) {
        (Function::Regular(nodes), Material::Regular(lit)) => {
            let between = between(transfer::COLORS_OVER_VALUE, transfer::over::COLORS);
            transfer::add_colors(&mut shader, &nodes.color, between);
            add_light(&mut shader, lit)?;
        }
        (Function::Style { nodes, names }, Material::Style(params)) => {
            let styles = inputs.styles.get(..names.len()).ok_or(GpuError::Material)?;
            let between = between(style_transfer_functions::OVER_VALUE, transfer::over::STYLES);
            let of_nodes = (nodes.color.as_slice(), styles);
            style_transfer_functions::add(&mut shader, shot, params, of_nodes, grid.voxel(), between);
        }
        _ => return Err(GpuError::Material),
    }
    // Pixels.
    ray::add_pixels(&mut shader, shot, inputs.background);
    for layer in &shot.layers {
        match layer {
            LayerKind::Beauty => {
                shader.stages.channels.extend(["mean.r", "mean.g", "mean.b", "mean.a"].map(str::to_owned));
            }
            _ => return Err(GpuError::Missing { what: "layers beyond the beauty", key: "picture.layers" }),
        }
    }
    shader.constant("CHANNELS", Constant::Int(shader.stages.channels.len() as i64));
    Ok(shader)
}

/// Refuses what no module draws.
fn refuse(shot: &Shot, inputs: &Inputs<'_>) -> Result<(), GpuError> {
    let missing = |is: bool, what, key| if is { Err(GpuError::Missing { what, key }) } else { Ok(()) };
    missing(!shot.halos.list.is_empty(), "halos", "halo")?;
    missing(shot.surface.is_some(), "iso-surfaces", "surface")?;
    missing(!shot.clipping.planes.is_empty(), "clip planes", "clip")?;
    missing(shot.objects[0].query.hessian, "second derivatives", "sampling.hessian")?;
    missing(shot.refine_above.is_some(), "rays at edges", "picture.samples")?;
    missing(inputs.volume.mask().is_some(), "volumes with values that are not numbers", "volume")
}

/// Adds the light of a regular function.
fn add_light(shader: &mut Shader, lit: &Illumination) -> Result<(), GpuError> {
    match &lit.lighting {
        Lighting::Flat => {}
        Lighting::Phong(phong) => shading::add(shader, phong),
        Lighting::Toon(_) => return Err(GpuError::Missing { what: "toon shading", key: "shading.look" }),
    }
    if !lit.is_plain() {
        return Err(GpuError::Missing { what: "silhouettes", key: "shading.silhouette" });
    }
    Ok(())
}
