//! The shader of a shot: the modules from which it is composed, and the data that they read.

pub(crate) mod objects;

use crate::block::ParamBlock;
use crate::field::Scales;
use crate::place::GridPlacement;
use crate::shader::{Constant, Shader};
use crate::shading::LitColors;
use crate::{
    CardInputs, GpuError, Interpolation, Precision, field, interactive_volume_illustration, mesh, ray, shading,
    style_transfer_functions, surface, transfer, volumeshop, volumetric_halos,
};
use drypoint_scene::glam::DVec3;
use drypoint_scene::picture::LayerKind;
use drypoint_scene::shot::{Illumination, KappaSource, Lighting, Material, SampleQuery, Shot};
use drypoint_scene::transfer::Function;

/// The share of a gradient that is rounding error ([PREC-3]).
pub(crate) fn no_normal(precision: Precision) -> f64 {
    match precision {
        Precision::Single => 1.0 / (1u64 << 20) as f64,
        Precision::Double => 1.0 / (1u64 << 46) as f64,
    }
}

/// Composes the shader of a shot, for layers in their order.
pub(crate) fn shader(
    shot: &Shot,
    layers: &[LayerKind],
    inputs: &CardInputs<'_>,
    precision: Precision,
    interpolation: Interpolation,
) -> Result<(Shader, Scales), GpuError> {
    if inputs.has_lines && !shot.halos.list.is_empty() {
        return Err(GpuError::Missing { what: "lines inside a volume with halos", key: "hatching.hidden" });
    }
    let place = GridPlacement::own(shot, inputs.data.main.volume.grid());
    let (mut shader, scales) = of_volume((shot, layers, false), (inputs, 0), &place, precision, interpolation)?;
    objects::add(&mut shader, shot, inputs, &scales, precision)?;
    Ok((shader, scales))
}

/// The shader of a shot without its objects, for the data of the object `which` at a place. `is_part` tells whether the
/// object is a part of the picture.
fn of_volume(
    (shot, layers, is_part): (&Shot, &[LayerKind], bool),
    (inputs, which): (&CardInputs<'_>, usize),
    place: &GridPlacement,
    precision: Precision,
    interpolation: Interpolation,
) -> Result<(Shader, Scales), GpuError> {
    // The grid of the data is not that of the place.
    let (object, own_inputs) = (shot.background(), inputs.object(which)?);
    let (data, measured) = (own_inputs.data, own_inputs.measured);
    let (grid, has_lines) = (data.volume.grid(), inputs.has_lines && !is_part);
    let mut shader = Shader { interpolation, ..Shader::default() };
    let scales = Scales::new(measured, grid);
    // The field and its rays.
    field::kernel::add(&mut shader, object.reconstruction.kernel, measured, grid);
    ray::add_lattice(&mut shader, shot, place)?;
    add_near(&mut shader.block, shot, place);
    // Samples.
    transfer::add_nodes(&mut shader, &object.function, &scales, precision);
    let cast = if shot.combination.is_some() { volumeshop::CAST_AMONG } else { ray::CAST_ALONE };
    ray::add_cast(&mut shader, shot, cast, has_lines);
    if let Some(mask) = data.volume.mask() {
        field::mask::add(&mut shader, mask, grid);
        ray::add_mask(&mut shader);
    }
    if let Some(bricks) = &measured.bricks {
        ray::add_bricks(&mut shader, shot, bricks, &scales, precision);
    }
    // The styles of caps follow those of the function.
    let of_function = data.styles.len().checked_sub(shot.clipping.styles.len()).ok_or(GpuError::Material)?;
    let (styles, of_caps) = data.styles.split_at(of_function);
    let clips = !shot.clipping.planes.is_empty();
    if clips {
        ray::add_clip(&mut shader, &shot.clipping, styles.len());
    }
    // Quantities of layers `first.*` and of looks that the volume meets are measured at every visible sample.
    let beyond = [object.first, object.meeting].into_iter().flatten();
    let query = beyond.fold(object.query, SampleQuery::and);
    let own = shot.surface.as_ref().map_or(query, |surface| query.and(surface.query).and(surface.first));
    let has_halos = !shot.halos.list.is_empty();
    let query = if has_halos { own.and(shot.halos.query) } else { own };
    if query.gradient {
        field::gradient::add(
            &mut shader,
            object.reconstruction,
            object.normal,
            measured,
            &scales,
            no_normal(precision),
            place.moved,
        );
        ray::add_gradient(&mut shader, measured, &scales);
    }
    if query.hessian {
        let is_integer = data.volume.is_integer();
        field::hessian::add(&mut shader, object, is_integer, measured, &scales, precision)?;
        ray::add_curvature(&mut shader, query);
    }
    if query.kappa == KappaSource::AlongRay {
        style_transfer_functions::add_curvature_along_ray(&mut shader, object.turn);
        if shot.surface.is_some() {
            surface::add_curvature_along_ray(&mut shader);
        }
    }
    let rows = object.function.nodes().2;
    if let Some(rows) = rows {
        transfer::over::add(&mut shader, shot, rows, &own_inputs, &scales)?;
    }
    let between = |over_value, over_two| if rows.is_some() { over_two } else { over_value };
    let mut with_levels = false;
    match (&*object.function, &object.material) {
        (Function::Regular(nodes), Material::Regular(lit)) => {
            let between = between(transfer::COLORS_OVER_VALUE, transfer::over::COLORS);
            transfer::add_colors(&mut shader, &nodes.color, between);
            add_light(&mut shader, lit, LitColors::Samples);
        }
        (Function::Style { nodes, names }, Material::Style(params)) if names.len() == styles.len() => {
            let between = between(style_transfer_functions::OVER_VALUE, transfer::over::STYLES);
            style_transfer_functions::add(&mut shader, shot, params, &nodes.color, place.voxel, between);
            with_levels = params.level_of_detail.is_some();
        }
        _ => return Err(GpuError::Material),
    }
    if clips {
        ray::add_cuts(&mut shader);
    }
    style_transfer_functions::add_spheres(&mut shader, &shot.clipping, [styles, of_caps], with_levels);
    if ray::ends_rays(shot) {
        ray::add_end(&mut shader);
    }
    if !shot.meshes.is_empty() {
        mesh::add(&mut shader, shot, (inputs.data.meshes, &own_inputs), scales.value(0.0), precision)?;
    }
    if let Some(surface) = &shot.surface {
        let has_mask = data.volume.mask().is_some();
        let (kernel, slack) = (object.reconstruction.kernel, ray::rounding(&scales, precision));
        surface::add_search(&mut shader, kernel, surface.iso, measured, &scales, slack, has_mask);
        surface::add(&mut shader, shot, surface, has_mask);
        add_light(&mut shader, &surface.lit, LitColors::Surface);
        if clips {
            surface::add_caps(&mut shader, !of_caps.is_empty());
        }
    }
    if !shot.meshes.is_empty() {
        mesh::add_search(&mut shader);
    }
    if ray::ends_rays(shot) && has_lines {
        ray::lines::add_surface(&mut shader);
    }
    // Pixels.
    ray::add_pixels(&mut shader, shot, inputs.data.background);
    ray::layers::add(&mut shader, layers, shot);
    if has_halos {
        volumetric_halos::add(&mut shader, (shot, is_part), own, (&own_inputs, place), &scales, precision)?;
    }
    shader.constant("CHANNELS", Constant::Int(shader.stages.channels.len() as i64));
    Ok((shader, scales))
}

/// The numbers of a shader that depend on the camera, for a shot of a volume at a place.
pub(crate) fn camera(shot: &Shot, place: &GridPlacement) -> Result<ParamBlock, GpuError> {
    let object = shot.background();
    let mut block = ParamBlock::default();
    ray::add_view(&mut block, shot, place)?;
    add_near(&mut block, shot, place);
    let of_samples = if let Material::Regular(lit) = &object.material { light_of(lit) } else { None };
    let of_surface = shot.surface.as_ref().and_then(|surface| light_of(&surface.lit));
    let of_meshes = shot.meshes.first().and_then(|mesh| light_of(&mesh.lit));
    let names = [LitColors::Samples.light(), LitColors::Surface.light(), shading::MESH_LIGHT];
    for (name, light) in names.into_iter().zip([of_samples, of_surface, of_meshes]) {
        if let Some(light) = light {
            block.vector(name, light);
        }
    }
    Ok(block)
}

/// Adds the near distance if surfaces or funnels need it.
fn add_near(block: &mut ParamBlock, shot: &Shot, place: &GridPlacement) {
    if ray::ends_rays(shot) || volumeshop::has_funnel(shot) {
        ray::add_near(block, shot, place);
    }
}

/// The direction to the light. Returns none if nothing is lit.
fn light_of(lit: &Illumination) -> Option<DVec3> {
    match &lit.lighting {
        Lighting::Flat => None,
        Lighting::Phong(phong) => Some(phong.light),
        Lighting::Toon(toon) => Some(toon.light),
        Lighting::Function(function) => Some(function.light),
    }
}

/// Adds the light of colours.
fn add_light(shader: &mut Shader, lit: &Illumination, of: LitColors) {
    match &lit.lighting {
        Lighting::Flat => {}
        Lighting::Phong(phong) => shading::add(shader, phong, of),
        Lighting::Toon(toon) => interactive_volume_illustration::add_toon(shader, toon, of),
        Lighting::Function(function) => volumeshop::add_lighting(shader, function),
    }
    if let Some(offset) = lit.silhouette {
        interactive_volume_illustration::add_silhouette(shader, offset, of);
    }
    if lit.view_opacity > 0.0 {
        interactive_volume_illustration::add_view_opacity(shader, lit.view_opacity);
    }
}

#[cfg(test)]
mod tests;
