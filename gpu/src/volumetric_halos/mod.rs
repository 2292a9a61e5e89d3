//! Bruckner and Gröller, *Enhancing Depth-Perception with Flexible Volumetric Halos*, IEEE TVCG 13(6), 2007.
//!
//! Rays wait for each other after each group of planes. [`planes`] runs the passes of each group.

mod groups;
pub(crate) mod planes;
mod stages;

use crate::field::Scales;
use crate::inputs::ObjectInputs;
use crate::module::module;
use crate::number::{ELEMENTARY, NUMBER};
use crate::place::GridPlacement;
use crate::ray::{EYE_NORMAL, ends_rays, layers, rounding};
use crate::shader::{Constant, Data, HaloStages, Kept, Shader};
use crate::{GpuError, Precision, transfer, volumeshop};
use drypoint_scene::glam::DVec3;
use drypoint_scene::math;
use drypoint_scene::measured::Measured;
use drypoint_scene::picture::LayerKind;
use drypoint_scene::shot::{
    HaloAccumulation, HaloKind, HaloParams, HaloSource, Object, SampleQuery, SeedSide, SeedValue, Shot,
};
use drypoint_scene::transfer::can_be_above_zero;
use drypoint_scene::volume::{BRICK, Bricks};
use stages::{TILE, TILE_BYTES};

/// The margin of the largest |n·v| of a seed, for the rounding of its powers.
const FRONTAL_MARGIN: f64 = 1e-5;

/// Lists of numbers that the halos of a shader read.
#[derive(Default)]
struct Lists {
    numbers: Vec<f64>,
    labels: Vec<u32>,
}

impl Lists {
    /// Appends numbers and returns the index of the first one.
    fn place(&mut self, numbers: Vec<f64>) -> f64 {
        let first = self.numbers.len() as f64;
        self.numbers.extend(numbers);
        first
    }
}

/// Adds the halos of a shot, after all measures of samples. `own` is the query of samples without halos. A part of a
/// picture has only seeds.
pub(crate) fn add(
    shader: &mut Shader,
    (shot, is_part): (&Shot, bool),
    own: SampleQuery,
    (inputs, place): (&ObjectInputs<'_>, &GridPlacement),
    scales: &Scales,
    precision: Precision,
) -> Result<(), GpuError> {
    let (halos, object) = (&shot.halos, shot.background());
    let list = &halos.list;
    let mut lists = Lists::default();
    let mut numbers = Vec::new();
    for halo in list {
        numbers.extend(parameters(halo, list.len(), &mut lists, place, scales));
    }
    shader.add(&[NUMBER, ELEMENTARY, module!("halos"), module!("seed"), module!("seed_value")]);
    shader.constant("HALOS", Constant::Int(list.len() as i64));
    if !is_part {
        add_images(shader, shot, precision);
    }
    // The seeds of a sample.
    let any = |is: fn(&HaloParams) -> bool| list.iter().any(is);
    let mut height = vec!["by_value"];
    if any(|halo| halo.seed.labels.is_some()) {
        transfer::over::add_label_lookup(shader, shot, inputs)?;
        shader.add(&[module!("seed_labels")]);
        shader.bind(32, "the labels of halos", Data::Words(lists.labels));
        height.push("by_label");
    }
    if any(|halo| halo.seed.focus.is_some()) {
        let axes = place.grid.axes();
        for (name, axis) in [("halo_axis_x", axes.x_axis), ("halo_axis_y", axes.y_axis), ("halo_axis_z", axes.z_axis)] {
            shader.block.vector(name, axis);
        }
        shader.add(&[module!("focus")]);
        height.push("by_focus");
    }
    shader.add(&[EYE_NORMAL]);
    shader.add(&[match any(|halo| halo.seed.direction.is_some_and(|direction| direction.width < 360.0)) {
        true => module!("direction"),
        false => module!("direction_none"),
    }]);
    let reads_opacity = any(|halo| matches!(halo.seed.value, Some(SeedValue::Opacity)));
    let is_over_two = object.function.nodes().2.is_some();
    shader.add(&[match (reads_opacity, is_over_two) {
        (false, _) => module!("seed_no_opacity"),
        (true, false) => module!("seed_opacity"),
        (true, true) => module!("seed_opacity_over_two"),
    }]);
    let mut next = Vec::new();
    if inputs.data.volume.mask().is_some() {
        next.push("skip_masked");
    }
    if let Some(bricks) = &inputs.measured.bricks {
        add_bricks(shader, &seeding(list, object, bricks, rounding(scales, precision)));
        next.push("skip_seed_brick");
    }
    if measures_once(shot, is_part) {
        shader.add(&[module!("measure_once")]);
    }
    shader.bind(30, "the halos", Data::Reals(numbers));
    shader.bind(31, "the numbers of halos", Data::Reals(lists.numbers));
    if shader.stages.collect.contains(&"collect_layers") {
        shader.add(&[module!("sums_go_on")]);
    }
    add_stages(shader, (shot, is_part), own, reads_opacity && is_over_two, height, next);
    Ok(())
}

/// Adds the images that halos spread in, and the rays that visit planes.
fn add_images(shader: &mut Shader, shot: &Shot, precision: Precision) {
    let list = &shot.halos.list;
    shader.add(&[
        module!("halo_planes_images"),
        module!("tiles"),
        module!("profile"),
        module!("halo_planes_tint"),
        module!("halo_planes_glow"),
    ]);
    shader.add(&[module!("plane_order"), module!("seed_rays"), module!("planes"), module!("spreading")]);
    shader.add(&[if shot.combination.is_some() { module!("among") } else { module!("alone") }]);
    shader.add(&[if ends_rays(shot) { module!("end_at_surface") } else { module!("no_end") }]);
    let emits = list.iter().any(|halo| halo.kind == HaloKind::Emissive);
    shader.constant("EMISSIVE", Constant::Bool(emits));
    shader.constant("TILE", Constant::Int(TILE as i64));
    shader.constant("TILE_NUMBERS", Constant::Int((TILE_BYTES as u64 / precision.size()) as i64));
    shader.add(&[match list.iter().any(|halo| halo.spread.median) {
        true => module!("median"),
        false => module!("plain_seeds"),
    }]);
    shader.add(&[module!("gradient_image")]);
}

/// The parameters of a halo, in the order of the shader's struct.
fn parameters(halo: &HaloParams, halos: usize, lists: &mut Lists, place: &GridPlacement, scales: &Scales) -> Vec<f64> {
    let (seed, spread) = (&halo.seed, &halo.spread);
    let flag = |is: bool| f64::from(u8::from(is));
    let mut parameters = vec![
        flag(halo.kind == HaloKind::Occlusive),
        halo.every.max(1) as f64,
        flag(halo.accumulate == HaloAccumulation::Mean),
    ];
    // h_v.
    let nodes: &[[f64; 2]] = if let Some(SeedValue::Nodes(nodes)) = &seed.value { nodes } else { &[] };
    let node = |(i, &[at, h]): (usize, &[f64; 2])| {
        let [next, next_h] = nodes[(i + 1).min(nodes.len() - 1)];
        [scales.value(at), scales.value(next) - scales.value(at), h, next_h]
    };
    let value = match &seed.value {
        None => 0.0,
        Some(SeedValue::Opacity) => 1.0,
        Some(SeedValue::Nodes(_)) => 2.0,
    };
    let first = lists.place(nodes.iter().enumerate().flat_map(node).collect());
    parameters.extend([value, first, nodes.len() as f64]);
    // h_l; a negative number of labels: all.
    parameters.push(lists.labels.len() as f64);
    parameters.push(seed.labels.as_ref().map_or(-1.0, |labels| labels.len() as f64));
    lists.labels.extend(seed.labels.iter().flatten());
    // h_p, from voxel (0, 0, 0).
    let origin = place.grid.origin();
    let points: Vec<f64> =
        seed.focus.iter().flat_map(|focus| &focus.at).flat_map(|p: &DVec3| (*p - origin).to_array()).collect();
    let count = (points.len() / 3) as f64;
    parameters.extend([lists.place(points), count]);
    parameters.extend(seed.focus.as_ref().map_or([0.0; 2], |focus| [focus.inner, focus.falloff]));
    // h_d.
    parameters.extend(match seed.direction.filter(|direction| direction.width < 360.0) {
        None => [0.0; 5],
        Some(direction) => {
            let toward = direction.toward.rem_euclid(360.0).to_radians();
            [1.0, math::sin(toward), math::cos(toward), 0.5 * direction.width, direction.softness]
        }
    });
    // s.
    let (by_curvature, side) = match seed.side {
        SeedSide::Power { exponent } => (false, exponent),
        SeedSide::Curvature { thickness } => (true, thickness),
    };
    let most_frontal = match seed.side {
        SeedSide::Power { exponent } if exponent > 0.0 && halo.floor > 0.0 => {
            1.0 - math::pow(halo.floor, 1.0 / exponent) + FRONTAL_MARGIN
        }
        SeedSide::Power { .. } | SeedSide::Curvature { .. } => 2.0,
    };
    parameters.extend([seed.gradient_exponent, flag(by_curvature), side, most_frontal, halo.floor]);
    // Spreading.
    let from_gradient = flag(spread.from == HaloSource::Gradient);
    parameters.extend([spread.delta, from_gradient, flag(spread.median)]);
    // The profile.
    let node =
        |node: &drypoint_scene::shot::ProfileNode| [node.at, node.rgb[0], node.rgb[1], node.rgb[2], node.opacity];
    parameters.extend([
        lists.place(halo.profile.iter().flat_map(node).collect()),
        halo.profile.len() as f64,
        halo.opacity,
    ]);
    parameters.push(lists.place((0..halos).map(|i| flag(halo.tints.contains(&i))).collect()));
    parameters
}

/// Whether a sample that is composited and seeds keeps its gradient. Among objects it does not, since several sets are
/// measured in turn.
fn measures_once(shot: &Shot, is_part: bool) -> bool {
    shot.combination.is_none() && !is_part
}

/// Whether values seed, for each brick of an object.
fn seeding(list: &[HaloParams], object: &Object, bricks: &Bricks, slack: f64) -> Vec<bool> {
    let in_range = |&[lo, hi]: &[f64; 2]| {
        let range = [lo - slack, hi + slack];
        let seeds = |halo: &HaloParams| match &halo.seed.value {
            None => true,
            Some(SeedValue::Opacity) => object.function.can_be_visible(range, None, |at| at),
            Some(SeedValue::Nodes(nodes)) => {
                let (at, h): (Vec<f64>, Vec<f64>) = nodes.iter().map(|&[at, h]| (at, h)).unzip();
                can_be_above_zero(&at, &h, range, |at| at)
            }
        };
        list.iter().any(seeds)
    };
    bricks.ranges.iter().map(in_range).collect()
}

/// Adds the skipping of bricks in which no value seeds.
fn add_bricks(shader: &mut Shader, seeding: &[bool]) {
    let mut words = vec![0u32; seeding.len().div_ceil(32)];
    for (i, &seeds) in seeding.iter().enumerate() {
        words[i / 32] |= u32::from(seeds) << (i % 32);
    }
    shader.add(&[module!("seed_bricks")]);
    shader.bind(33, "the bricks of seeds", Data::Words(words));
}

/// Boxes about all samples that can seed, one for each layer of bricks. Returns none if any sample can: without bricks, or with
/// objects, whose own data seed, too.
pub(crate) fn seed_boxes(
    shot: &Shot,
    measured: &Measured,
    scales: &Scales,
    precision: Precision,
) -> Option<groups::SeedBoxes> {
    let bricks = measured.bricks.as_ref().filter(|_| shot.combination.is_none())?;
    let seeding = seeding(&shot.halos.list, shot.background(), bricks, rounding(scales, precision));
    let [across, down, _] = bricks.dims;
    let of_layer = |(z, layer): (usize, &[bool])| {
        let places = layer.iter().enumerate().filter(|(_, seeds)| **seeds);
        let boxes = places.map(|(i, _)| {
            let low = DVec3::new((i % across) as f64, (i / across) as f64, z as f64) * BRICK as f64;
            // Samples beyond the outer voxels belong to the bricks at the border.
            [low - 1.0, low + (BRICK + 1) as f64]
        });
        boxes.reduce(|[low, high], [other_low, other_high]| [low.min(other_low), high.max(other_high)])
    };
    Some(seeding.chunks((across * down).max(1)).enumerate().filter_map(of_layer).collect())
}

/// Adds the functions that rays and seeds call at each step. From the shader's own functions, those that halos need are
/// taken.
fn add_stages(
    shader: &mut Shader,
    (shot, is_part): (&Shot, bool),
    own: SampleQuery,
    asks_first: bool,
    height: Vec<&'static str>,
    next: Vec<&'static str>,
) {
    let stages = &mut shader.stages;
    // Seeds have their own query, and so has what is composited.
    let is_asked = |stage: &&str| transfer::over::is_of(stage, shot.halos.query) && *stage != "measure_cut";
    let first = if asks_first { &[][..] } else { &stages.measured_first };
    let mut measured: Vec<&'static str> = first.iter().chain(&stages.measured).copied().filter(is_asked).collect();
    stages.measured.retain(|stage| *stage == "measure_cut" || transfer::over::is_of(stage, own));
    let has = |list: &[&'static str], name: &'static str| list.contains(&name).then_some(name);
    let mut kept: Vec<Kept> = Vec::new();
    let clips = has(&stages.samples_left, "clip_run");
    if clips.is_some() {
        kept.extend([Kept::whole("cut_k"), Kept::whole("cut_plane"), Kept::real("cut_steps")]);
    }
    let mut seed_kept = kept.clone();
    let cutaways = shot.combination.iter().flat_map(volumeshop::cutaways).count();
    seed_kept.extend((0..cutaways).map(|i| Kept::whole(volumeshop::objects::cut_end(i))));
    if ends_rays(shot) {
        kept.push(Kept::real("hit"));
    }
    if shot.surface.is_some() {
        kept.extend(clips.map(|_| Kept::whole("hit_plane")));
    }
    if !shot.meshes.is_empty() {
        kept.push(Kept::whole("met_mesh"));
        kept.extend(["mesh_normal.x", "mesh_normal.y", "mesh_normal.z"].map(Kept::real));
    }
    if stages.visited.contains(&"count_sample") {
        kept.push(Kept::whole("samples_of_ray"));
    }
    if stages.collect.contains(&"collect_layers") {
        kept.extend(layers::KEPT.map(Kept::real));
        kept.extend((0..stages.covering).map(|object| Kept::real(format!("ray_coverage[{object}]"))));
    }
    let watched = |layer: &LayerKind| if let LayerKind::Halo(halo) = layer { Some(*halo) } else { None };
    for stage in stages.measured_first.iter_mut().chain(&mut stages.measured).chain(&mut measured) {
        if *stage == "measure_gradient" && measures_once(shot, is_part) {
            *stage = "measure_gradient_once";
        }
    }
    stages.halos = Some(HaloStages {
        kept,
        seed_kept,
        resume: has(&stages.begin_ray, "forget_normal").into_iter().collect(),
        after_resume: has(&stages.begin_ray, "begin_sums").map(|_| "sums_go_on").into_iter().collect(),
        left: clips.into_iter().collect(),
        next,
        height,
        measured,
        on_cut: clips.map(|_| "measure_cut").into_iter().collect(),
        watched: shot.layers.iter().filter_map(watched).filter(|&halo| halo < shot.halos.list.len()).collect(),
    });
}
