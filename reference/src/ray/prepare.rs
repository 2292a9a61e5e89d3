//! From a scene to what its samples need: everything that is decided once a picture.

use super::cells::Cells;
use super::gradient_range::quantile_of_norms;
use super::lattice::{Lattice, MOST_PLANES, MOST_SAMPLES};
use super::lit::Lit;
use super::need::Needs;
use super::over_two::OverTwo;
use super::prepared::{Calls, KappaSource, Prepared, Side};
use super::render::{Inputs, RenderError};
use super::sample::{EyeAxes, Illustrated, Look, Styled};
use super::skip::Skip;
use super::surface::Surface;
use crate::field::{Field, Reconstruction, Rung, Sampler};
use crate::interactive_volume_illustration::ViewOpacity;
use crate::labels::Labels;
use crate::number::{Real, Vec3};
use crate::shading::Phong;
use crate::style_transfer_functions::curvature_along_ray::Turn;
use crate::style_transfer_functions::{Contour, Detail, Footprint, Spheres, StyleIndex};
use crate::transfer::{Piecewise, Table, gate};
use crate::with_sampler;
use drypoint_scene::counts::Counts;
use drypoint_scene::picture::LayerKind;
use drypoint_scene::plan::{Pass, Plan, Quantity};
use drypoint_scene::space::Grid;
use drypoint_scene::tables::{
    Axis, BlendSpace, GradientRange, Kappa, Length, Mix, Scene, Shading, ShadingModel, SignFlip, SphereFrame,
    StyleMipmaps, Transparency,
};
use drypoint_scene::transfer::Function;
use drypoint_scene::view::View;
use drypoint_scene::volume::BRICK;

/// Decides everything that samples need not decide.
pub(super) fn prepare<'a, R: Real>(inputs: &Inputs<'a>, counts: &mut Counts) -> Result<Prepared<'a, R>, RenderError> {
    let Inputs { scene, plan, volume, function, .. } = *inputs;
    let grid = volume.grid();
    let sampling = &scene.sampling;
    let world = |length: Length, key| length.world(grid).ok_or(RenderError::Length { key });
    let step = world(sampling.step, "sampling.step")?;
    let (calls, first) = calls(scene, plan, function);
    let rung = if plan.needs_at_first(Quantity::Hessian) {
        Rung::Hessian
    } else if plan.reads_gradients() {
        Rung::Gradient
    } else {
        Rung::Value
    };
    let how = Reconstruction {
        kernel: sampling.kernel,
        gradient: sampling.gradient,
        hessian: sampling.hessian,
        scale: world(sampling.scale, "sampling.scale")?,
        outside: scene.volume.outside,
    };
    let field = Field::<R>::new(volume, how, rung)?;
    counts.bytes.extend(field.bytes());
    let view = View::new(&scene.camera, grid, scene.picture.size)?;
    let near = scene.camera.near.map_or(Ok(step), |near| world(near, "camera.near"))?;
    let lattice = Lattice { step, along: sampling.step_along, near };
    within_planes(&lattice, &view, grid, inputs.scene.picture.samples)?;
    let bricks = plan.has_pass(Pass::Bricks).then(|| field.bricks());
    if let Some(bricks) = &bricks {
        counts.bytes.insert("bricks".into(), bricks.bytes() as u64);
    }
    let surface = Surface::new(inputs, &field, bricks.as_ref(), &view, counts);
    let skip = bricks.as_ref().map(|bricks| {
        let labels = labels_of(inputs);
        // The cells of the volume; an axis of length 1 has one.
        let cells = volume.dims().map(|n| n.max(2) - 1);
        let occurring = |brick: [usize; 3]| {
            let end = std::array::from_fn(|a| ((brick[a] + 1) * BRICK).min(cells[a]));
            labels.as_ref().map(|labels| labels.ids_in(brick.map(|i| i * BRICK), end))
        };
        let rounded = |at| R::from_f64(at).to_f64();
        // What labels occur takes a look at each voxel, so it is asked last.
        let can_be = |range, among: Option<&[u32]>| function.can_be_visible(range, among, rounded);
        Skip::new(bricks, |brick, range| can_be(range, None) && can_be(range, occurring(brick).as_deref()))
    });
    let cells = bricks.as_ref().and_then(|bricks| Cells::new(bricks, sampling.kernel, function));
    if let Some(cells) = &cells {
        counts.bytes.insert("cells".into(), cells.bytes() as u64);
    }
    if let Some(labels) = inputs.labels {
        counts.bytes.insert("labels".into(), labels.bytes() as u64);
    }
    if let Some(skip) = &skip {
        counts.bytes.insert("skip".into(), skip.bytes() as u64);
    }
    let gradient_range = plan
        .needs(Quantity::GradientMagnitudeRange)
        .then(|| with_sampler!(field, |s| gradient_range(s, &field, inputs, counts)));
    let (at, opacity, rows) = function.nodes();
    let (over_value, over_two) = match rows {
        None => (Piecewise::new(at, opacity)?, None),
        Some(rows) => {
            let over_two = OverTwo::new((at, opacity), rows, inputs, &field, calls, counts)?;
            (gate::over_value(at, opacity, rows)?, Some(over_two))
        }
    };
    let table = function.table().map(|(index, nodes)| Table::new(index, nodes));
    if let Some(table) = &table {
        counts.bytes.insert("table".into(), table.bytes() as u64);
    }
    let look = look(inputs, &view)?;
    if let Look::Style(styled) = &look
        && let Some(bytes) = styled.spheres.mipmap_bytes()
    {
        counts.bytes.insert("style_mipmaps".into(), bytes as u64);
    }
    let layers = if scene.picture.layers.is_empty() { vec![LayerKind::Beauty] } else { scene.picture.layers.clone() };
    let collects = layers.iter().any(|&l| l != LayerKind::Beauty && l != LayerKind::Counts);
    let encode = scene.picture.blend_space == BlendSpace::Srgb;
    let plain = matches!(look, Look::Regular { .. });
    let more = !plain || table.is_some() || over_two.is_some() || gradient_range.is_some() || collects || encode;
    Ok(Prepared {
        volume,
        lattice,
        ends: grid.index_box().map(Vec3::from_glam),
        skip,
        cells,
        lines: None,
        surface,
        function: over_value,
        table,
        over_two,
        look,
        calls,
        needs: Needs::new(calls, more),
        first,
        gradient_range,
        reference_length: world(sampling.reference_length, "sampling.reference_length")?,
        stop_at: R::from_f64(stop_at(sampling.stop_below, scene.picture.blend_space)),
        encode,
        collects,
        layers,
        outside: scene.volume.outside,
        side: Side::new(sampling.normal, scene.volume.outside),
        turn: Turn::new(sampling.normal, scene.contours.as_ref().map_or(SignFlip::TwoSided, |c| c.sign_flip)),
        no_normal_below: field.no_normal_below(),
        eye_axes: eye_axes(&view),
        samples: scene.picture.samples,
        field,
        view,
    })
}

/// Turns the camera of what is prepared: all that depends on where it stands, with the same lens and picture.
pub(super) fn turn<R: Real>(prepared: &mut Prepared<'_, R>, scene: &Scene, view: View) -> Result<(), RenderError> {
    within_planes(&prepared.lattice, &view, prepared.volume.grid(), prepared.samples)?;
    prepared.eye_axes = eye_axes(&view);
    match &mut prepared.look {
        Look::Regular { phong, .. } => *phong = scene.shading.as_ref().map(|s| Phong::new(s, scene.light, &view)),
        Look::Illustrated(illustrated) => {
            if let Some(shading) = &scene.shading {
                illustrated.lit = Lit::of_shading(shading, scene, &view);
            }
        }
        Look::Style(styled) => styled.eye_axes = eye_axes(&view),
    }
    if let Some(surface) = &mut prepared.surface {
        surface.turn(scene, &view);
    }
    prepared.view = view;
    Ok(())
}

/// Whether sample planes are told apart all the way ([RAY-1]), and the picture's samples have an end.
fn within_planes(lattice: &Lattice, view: &View, grid: &Grid, rays: usize) -> Result<(), RenderError> {
    let planes = lattice.planes(view, grid);
    if planes >= MOST_PLANES {
        return Err(RenderError::TooManyPlanes { planes });
    }
    let samples = lattice.samples(view, grid) * (rays * rays) as f64;
    if samples > MOST_SAMPLES { Err(RenderError::Endless { samples }) } else { Ok(()) }
}

/// lo and hi − lo of |g| ([VAL-2]), times the power of two of [SPACE-4].
pub(super) fn gradient_range<R: Real, S: Sampler<R>>(
    sampler: &S,
    field: &Field<'_, R>,
    inputs: &Inputs<'_>,
    counts: &mut Counts,
) -> (R, R) {
    let Inputs { scene, volume, .. } = *inputs;
    let scaled = |g: f64| drypoint_scene::math::scale_by_power_of_two(g, -field.scale_exponent());
    let [lo, hi] = match scene.volume.gradient_range {
        GradientRange::Fixed(range) => range.map(scaled),
        GradientRange::Quantile(q) => {
            let (hi, voxels) = quantile_of_norms(sampler, volume, scene.sampling.gradient, field.no_normal_below(), q);
            counts.preprocess.insert("gradients".into(), voxels);
            [0.0, hi]
        }
    };
    (R::from_f64(lo), R::from_f64(hi - lo))
}

/// The labels at the data's positions, where the function over the value has a row for each.
fn labels_of<'a>(inputs: &Inputs<'a>) -> Option<Labels<'a>> {
    let over = &inputs.function.nodes().2?.over;
    let data = inputs.volume;
    let new = |labels| Labels::new(labels, data.grid(), data.anatomy(), inputs.scene.volume.label_lookup);
    inputs.labels.filter(|_| *over == [Axis::Value, Axis::Label]).map(new)
}

/// The A at which a ray ends, so that what is left out is at most ε·c_max in linear light ([RAY-2]). What is left out of
/// an encoded sum, at most the encoded c_max times its weight, is decoded with it; and sRGB's curve f, of which shading can
/// make the part above 1 count too, has c·f′(c) ≤ 2.4 f(c).
fn stop_at(epsilon: f64, blend_space: BlendSpace) -> f64 {
    match blend_space {
        BlendSpace::Linear => 1.0 - epsilon,
        BlendSpace::Srgb => 1.0 - epsilon / 2.4,
    }
}

/// What visible samples have to know, by the plan, and what the first of a ray has to know beyond that.
fn calls(scene: &Scene, plan: &Plan, function: &Function) -> (Calls, Option<Calls>) {
    let kappa = |needs: &dyn Fn(Quantity) -> bool| {
        if needs(Quantity::PreviousNormal) {
            KappaSource::AlongRay
        } else if needs(Quantity::Hessian) && scene.contours.as_ref().is_some_and(|c| c.kappa == Kappa::Exact) {
            KappaSource::Exact
        } else {
            KappaSource::None
        }
    };
    let asks_for = |layer| scene.picture.layers.contains(&layer);
    let calls = Calls {
        gradient: plan.needs(Quantity::Gradient),
        hessian: plan.needs(Quantity::Hessian),
        principal: asks_for(LayerKind::Curvature)
            || function.nodes().2.is_some_and(|rows| rows.over.iter().any(Axis::is_principal)),
        kappa: kappa(&|quantity| plan.needs(quantity)),
    };
    let principal = asks_for(LayerKind::FirstCurvature) && !calls.principal;
    let kappa = match calls.kappa {
        KappaSource::None => kappa(&|quantity| plan.needs_at_first(quantity)),
        KappaSource::AlongRay | KappaSource::Exact => KappaSource::None,
    };
    let first = Calls {
        gradient: plan.needs_at_first(Quantity::Gradient) && !calls.gradient,
        hessian: principal || kappa == KappaSource::Exact,
        principal,
        kappa,
    };
    (calls, (first.gradient || first.hessian || first.kappa != KappaSource::None).then_some(first))
}

/// The rows of the rotation from world to eye space.
fn eye_axes<R: Real>(view: &View) -> EyeAxes<R> {
    EyeAxes([view.right, view.up, -view.forward].map(Vec3::from_glam))
}

/// How visible samples are coloured.
fn look<R: Real>(inputs: &Inputs<'_>, view: &View) -> Result<Look<R>, RenderError> {
    let Inputs { scene, volume, styles, .. } = *inputs;
    match inputs.function {
        Function::Regular(nodes) => {
            let colors = nodes.color.iter().map(|c| c.map(R::from_f64)).collect();
            let shading = scene.shading.as_ref();
            Ok(match shading.filter(|shading| is_illustrated(shading)) {
                None => Look::Regular { colors, phong: shading.map(|s| Phong::new(s, scene.light, view)) },
                Some(shading) => Look::Illustrated(Illustrated {
                    colors,
                    lit: Lit::of_shading(shading, scene, view),
                    view_opacity: ViewOpacity::new(shading.view_opacity),
                }),
            })
        }
        Function::Style { nodes, names } => {
            if names.len() != styles.len() {
                return Err(RenderError::Styles { named: names.len(), given: styles.len() });
            }
            let contour = scene
                .contours
                .as_ref()
                .map(|c| {
                    let thickness = c.thickness.world(volume.grid());
                    let thickness = thickness.ok_or(RenderError::Length { key: "contours.thickness" })?;
                    Ok::<_, RenderError>(Contour::new(thickness, c.kappa, c.fade))
                })
                .transpose()?;
            let transfer = scene.transfer.as_ref();
            let spheres = Spheres::new(styles, transfer.map_or(Mix::Premultiplied, |t| t.mix));
            let mipmaps = scene.style_mipmaps.as_ref();
            Ok(Look::Style(Styled {
                index: StyleIndex::new(&nodes.color),
                spheres: if mipmaps.is_some() { spheres.with_mipmaps(styles) } else { spheres },
                detail: mipmaps.map(|table| detail(table, scene, view, volume.grid().voxel())),
                contour,
                transparency: transfer.map_or(Transparency::Illustrative, |t| t.transparency),
                frame: transfer.map_or(SphereFrame::Eye, |t| t.sphere_frame),
                eye_axes: eye_axes(view),
            }))
        }
    }
}

/// Whether shading is more than Phong.
fn is_illustrated(shading: &Shading) -> bool {
    shading.model != ShadingModel::Phong || shading.silhouette.is_some() || shading.view_opacity > 0.0
}

/// The level of detail of styles ([STF-10]), in rays of the picture.
fn detail<R: Real>(table: &StyleMipmaps, scene: &Scene, view: &View, voxel: f64) -> Detail<R> {
    let rays = R::from_f64(voxel * scene.picture.samples as f64 / view.pixel);
    Detail {
        curvature_bias: R::from_f64(table.measured_curvature_bias(scene)),
        gradient_bias: R::from_f64(table.gradient_bias),
        turn: R::from_f64(table.turn),
        voxel: R::from_f64(voxel),
        footprint: if view.perspective { Footprint::Perspective(rays) } else { Footprint::Orthographic(rays) },
    }
}
