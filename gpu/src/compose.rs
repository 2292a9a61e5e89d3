//! The shader of a shot: the modules from which it is composed, and the data that they read.

pub(crate) mod objects;

use crate::block::ParamBlock;
use crate::field::Scales;
use crate::inputs::ObjectInputs;
use crate::place::GridPlacement;
use crate::shader::{Constant, Shader};
use crate::shading::LitColors;
use crate::{
    CardInputs, GpuError, Interpolation, Precision, field, interactive_volume_illustration, mesh, ray, shading,
    style_transfer_functions, surface, transfer, volumeshop, volumetric_halos,
};
use drypoint_scene::glam::DVec3;
use drypoint_scene::mesh::TriangleMesh;
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
    } else {
        shader.add(&[ray::UNCLIPPED]);
    }
    // Derivatives. Quantities of layers `first.*` and of looks that the volume meets are measured at every visible sample.
    let beyond = [object.first, object.meeting].into_iter().flatten();
    let query = beyond.fold(object.query, SampleQuery::and);
    let own = shot.surface.as_ref().map_or(query, |surface| query.and(surface.query).and(surface.first));
    let has_halos = !shot.halos.list.is_empty();
    let query = if has_halos { own.and(shot.halos.query) } else { own };
    add_derivatives(&mut shader, (shot, query), &own_inputs, place, &scales, precision)?;
    // Colours, of the function and of cut faces.
    let with_levels = add_material(&mut shader, shot, &own_inputs, styles.len(), place, &scales)?;
    if clips {
        ray::add_cuts(&mut shader);
    }
    style_transfer_functions::add_spheres(&mut shader, &shot.clipping, [styles, of_caps], with_levels);
    // The depths at which rays end.
    let has_caps = !of_caps.is_empty();
    add_ends(&mut shader, shot, (inputs.data.meshes, &own_inputs), (has_lines, has_caps), &scales, precision)?;
    // Pixels.
    ray::add_pixels(&mut shader, shot, inputs.data.background);
    ray::layers::add(&mut shader, layers, shot);
    if has_halos {
        volumetric_halos::add(&mut shader, (shot, is_part), own, (&own_inputs, place), &scales, precision)?;
    }
    shader.constant("CHANNELS", Constant::Int(shader.stages.channels.len() as i64));
    Ok((shader, scales))
}

/// Adds the gradient and the Hessian, and curvatures from them, as far as a query asks for them.
fn add_derivatives(
    shader: &mut Shader,
    (shot, query): (&Shot, SampleQuery),
    inputs: &ObjectInputs<'_>,
    place: &GridPlacement,
    scales: &Scales,
    precision: Precision,
) -> Result<(), GpuError> {
    let object = shot.background();
    if query.gradient {
        field::gradient::add(
            shader,
            object.reconstruction,
            object.normal,
            inputs.measured,
            scales,
            no_normal(precision),
            place.moved,
        );
        ray::add_gradient(shader, inputs.measured, scales);
    }
    if query.hessian {
        let is_integer = inputs.data.volume.is_integer();
        field::hessian::add(shader, object, is_integer, inputs.measured, scales, precision)?;
        ray::add_curvature(shader, query);
    }
    if query.kappa == KappaSource::AlongRay {
        style_transfer_functions::add_curvature_along_ray(shader, object.turn);
        if shot.surface.is_some() {
            surface::add_curvature_along_ray(shader);
        }
    }
    Ok(())
}

/// Adds the colours of a function and its material, over the value or over two quantities. `styles` is the number of the
/// function's styles. Returns whether styles have levels of detail.
fn add_material(
    shader: &mut Shader,
    shot: &Shot,
    inputs: &ObjectInputs<'_>,
    styles: usize,
    place: &GridPlacement,
    scales: &Scales,
) -> Result<bool, GpuError> {
    let object = shot.background();
    let rows = object.function.nodes().2;
    if let Some(rows) = rows {
        transfer::over::add(shader, shot, rows, inputs, scales)?;
    }
    let between = |over_value, over_two| if rows.is_some() { over_two } else { over_value };
    match (&*object.function, &object.material) {
        (Function::Regular(nodes), Material::Regular(lit)) => {
            let between = between(transfer::COLORS_OVER_VALUE, transfer::over::COLORS);
            transfer::add_colors(shader, &nodes.color, between);
            add_light(shader, lit, LitColors::Samples);
            Ok(false)
        }
        (Function::Style { nodes, names }, Material::Style(params)) if names.len() == styles => {
            let between = between(style_transfer_functions::OVER_VALUE, transfer::over::STYLES);
            style_transfer_functions::add(shader, shot, params, &nodes.color, place.voxel, between);
            Ok(params.level_of_detail.is_some())
        }
        _ => Err(GpuError::Material),
    }
}

/// Adds meshes and the iso-surface, at which rays end.
fn add_ends(
    shader: &mut Shader,
    shot: &Shot,
    (meshes, inputs): (&[TriangleMesh], &ObjectInputs<'_>),
    (has_lines, has_caps): (bool, bool),
    scales: &Scales,
    precision: Precision,
) -> Result<(), GpuError> {
    if ray::ends_rays(shot) {
        ray::add_end(shader);
    }
    if !shot.meshes.is_empty() {
        mesh::add(shader, shot, (meshes, inputs), scales.value(0.0), precision)?;
    }
    if let Some(surface) = &shot.surface {
        let has_mask = inputs.data.volume.mask().is_some();
        let (kernel, slack) = (shot.background().reconstruction.kernel, ray::rounding(scales, precision));
        surface::add_search(shader, kernel, surface.iso, inputs.measured, scales, slack, has_mask);
        surface::add(shader, shot, surface, has_mask);
        add_light(shader, &surface.lit, LitColors::Surface);
        if !shot.clipping.planes.is_empty() {
            surface::add_caps(shader, has_caps);
        }
    }
    if !shot.meshes.is_empty() {
        mesh::add_search(shader);
    }
    if ray::ends_rays(shot) && has_lines {
        ray::lines::add_surface(shader);
    }
    Ok(())
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
