//! A picture, ray by ray.

use super::cast::cast;
use super::gradient_range::quantile_of_norms;
use super::lattice::{IndexRay, Lattice, MOST_PLANES};
use super::layers::{Sums, pooled};
use super::over_two::OverTwo;
use super::prepared::{Calls, KappaSource, Prepared, Side};
use super::sample::{EyeAxes, Look, Styled};
use super::skip::{Beam, Boxes, Skip};
use crate::field::{Exact, Field, FieldError, Reconstruction, Rung, Sampler};
use crate::labels::Labels;
use crate::number::{Real, Vec3};
use crate::shading::Phong;
use crate::style_transfer_functions::curvature_along_ray::Turn;
use crate::style_transfer_functions::{Contour, Detail, Footprint, Spheres, StyleIndex};
use crate::transfer::{NodesError, Piecewise, Table, gate};
use crate::with_sampler;
use drypoint_scene::color::{self, Rgba};
use drypoint_scene::counts::Counts;
use drypoint_scene::phantom::Phantom;
use drypoint_scene::picture::{Layer, LayerKind, Picture};
use drypoint_scene::plan::{Pass, Plan, Quantity};
use drypoint_scene::style::Style;
use drypoint_scene::tables::{
    Axis, BlendSpace, GradientRange, Kappa, Length, Mix, Number, Scene, SignFlip, SphereFrame, StyleMipmaps,
    Transparency,
};
use drypoint_scene::transfer::Function;
use drypoint_scene::view::{View, ViewError};
use drypoint_scene::volume::labels::LabelVolume;
use drypoint_scene::volume::{BRICK, Volume};
use rayon::prelude::*;
use std::time::Instant;

/// Pixels along the side of a tile, the work of one thread at a time.
const TILE: usize = 16;

/// Pixels that are drawn before they are gathered, so that a huge picture is not in memory twice.
const BATCH: usize = 1 << 20;

/// What a picture is made of.
#[derive(Clone, Copy, Debug)]
pub struct Inputs<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// What it calls for.
    pub plan: &'a Plan,
    /// Its volume.
    pub volume: &'a Volume,
    /// Its transfer function, over the volume's values.
    pub function: &'a Function,
    /// The labels beside the volume, where the plan needs them ([STF-13]).
    pub labels: Option<&'a LabelVolume>,
    /// The further volumes that the function is over, one for each of its quantities that is one ([STF-4]).
    pub further: [Option<&'a Volume>; 2],
    /// The styles that the function names, in the order of [`Function::Style::names`].
    pub styles: &'a [Style],
    /// What lies behind.
    pub background: Backdrop<'a>,
}

/// What lies behind the volume, linear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Backdrop<'a> {
    /// Nothing.
    None,
    /// One straight colour.
    Color(Rgba),
    /// Premultiplied pixels of the picture's size, row by row from the top.
    Pixels(&'a [Rgba]),
}

/// A picture that cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RenderError {
    /// The field cannot be reconstructed as the scene asks.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// The camera sees nothing.
    #[error(transparent)]
    View(#[from] ViewError),
    /// A length of the scene has no size in the world.
    #[error("{key} is a length on the page, not in the volume")]
    Length {
        /// The scene key.
        key: &'static str,
    },
    /// Sample planes that fall together ([RAY-1]): k + ½ has no half from 2⁵² on.
    #[error("the volume reaches {planes:.1e} steps from the eye, where sample planes are not told apart any more")]
    TooManyPlanes {
        /// The largest distance from the eye, in steps.
        planes: f64,
    },
    /// The nodes make no function.
    #[error(transparent)]
    Nodes(#[from] NodesError),
    /// A quantity of the function is a volume that was not handed over.
    #[error("the transfer function is over a further volume, and none was loaded")]
    NoFurtherVolume,
    /// A quantity of the function reads labels, and there are none.
    #[error("the transfer function reads labels, and there are none")]
    NoLabels,
    /// A distance to a label that no voxel has.
    #[error("no voxel has the label {id}")]
    NoSuchLabel {
        /// The label.
        id: u32,
    },
    /// The function's nodes and the styles do not fit.
    #[error("the transfer function names {named} styles, {given} were loaded")]
    Styles {
        /// Styles that the function names.
        named: usize,
        /// Styles that were handed over.
        given: usize,
    },
}

/// A scene that is ready to be rendered any number of times.
pub struct Renderer<'a> {
    ready: Ready<'a>,
    background: Backdrop<'a>,
    counts: Counts,
    tile: usize,
}

enum Ready<'a> {
    F64(Box<Prepared<'a, f64>>),
    F32(Box<Prepared<'a, f32>>),
    Exact(Box<Prepared<'a, f64>>, &'a dyn Phantom),
}

impl<'a> Renderer<'a> {
    /// Prepares a scene: reconstruction, ranges, visible bricks.
    ///
    /// # Errors
    /// A reconstruction that does not exist, a camera without direction, a length without size.
    pub fn new(inputs: Inputs<'a>) -> Result<Self, RenderError> {
        let start = Instant::now();
        let mut counts = Counts::default();
        let ready = match inputs.scene.sampling.number {
            Number::F64 => Ready::F64(Box::new(prepare(&inputs, &mut counts)?)),
            Number::F32 => Ready::F32(Box::new(prepare(&inputs, &mut counts)?)),
        };
        Ok(Self::of(ready, &inputs, counts, start))
    }

    /// Prepares the picture that reconstructions converge to: of a phantom's own formula and its derivatives in place of
    /// the voxels, in f64, with every other key as the scene has it ([COST-2]). The volume says the grid, and is where
    /// labels and further quantities belong.
    ///
    /// # Errors
    /// As [`Renderer::new`].
    pub fn exact(inputs: Inputs<'a>, phantom: &'a dyn Phantom) -> Result<Self, RenderError> {
        let start = Instant::now();
        let mut counts = Counts::default();
        let mut prepared: Prepared<'a, f64> = prepare(&inputs, &mut counts)?;
        // Ranges of bricks are those of the voxels.
        prepared.skip = None;
        let exact = Exact::new(phantom, inputs.volume.grid(), prepared.field.scale_exponent());
        if prepared.gradient_range.is_some() {
            prepared.gradient_range = Some(gradient_range(&exact, &prepared.field, &inputs, &mut counts));
        }
        Ok(Self::of(Ready::Exact(Box::new(prepared), phantom), &inputs, counts, start))
    }

    fn of(ready: Ready<'a>, inputs: &Inputs<'a>, mut counts: Counts, start: Instant) -> Self {
        counts.bytes.insert("volume".into(), inputs.volume.voxels().bytes() as u64);
        if let Some(mask) = inputs.volume.mask() {
            counts.bytes.insert("mask".into(), mask.bytes() as u64);
        }
        counts.seconds.insert("prepare".into(), start.elapsed().as_secs_f64());
        Self { ready, background: inputs.background, counts, tile: TILE }
    }

    /// The same with tiles of another side, from 1 to 1024 pixels; it shows nowhere ([RAY-3]).
    pub fn with_tiles(self, side: usize) -> Self {
        Self { tile: side.clamp(1, 1024), ..self }
    }

    /// Renders one frame. `progress` hears the share of the picture that is done, from any thread.
    pub fn frame(&self, progress: &(dyn Fn(f64) + Sync)) -> (Picture, Counts) {
        let start = Instant::now();
        let (picture, mut counts) = match &self.ready {
            Ready::F64(p) => with_sampler!(p.field, |s| draw(p, s, self.background, self.tile, progress)),
            Ready::F32(p) => with_sampler!(p.field, |s| draw(p, s, self.background, self.tile, progress)),
            Ready::Exact(p, phantom) => {
                let exact = Exact::new(*phantom, p.volume.grid(), p.field.scale_exponent());
                draw(p, &exact, self.background, self.tile, progress)
            }
        };
        counts.seconds.insert("rays".into(), start.elapsed().as_secs_f64());
        counts.add(&self.counts);
        let channels: usize = picture.layers.iter().map(|l| l.channels.len()).sum();
        counts.bytes.insert("picture".into(), (channels * picture.width * picture.height * 8) as u64);
        (picture, counts)
    }
}

/// Decides everything that samples need not decide.
fn prepare<'a, R: Real>(inputs: &Inputs<'a>, counts: &mut Counts) -> Result<Prepared<'a, R>, RenderError> {
    let Inputs { scene, plan, volume, function, .. } = *inputs;
    let grid = volume.grid();
    let sampling = &scene.sampling;
    let world = |length: Length, key| length.world(grid).ok_or(RenderError::Length { key });
    let step = world(sampling.step, "sampling.step")?;
    let (calls, first) = calls(scene, plan, function);
    let rung = if plan.needs_at_first(Quantity::Hessian) {
        Rung::Hessian
    } else if plan.needs_at_first(Quantity::Gradient) {
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
    let planes = lattice.planes(&view, grid);
    if planes >= MOST_PLANES {
        return Err(RenderError::TooManyPlanes { planes });
    }
    let skip = plan.has_pass(Pass::Bricks).then(|| {
        let bricks = field.bricks();
        counts.bytes.insert("bricks".into(), bricks.bytes() as u64);
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
        Skip::new(&bricks, |brick, range| can_be(range, None) && can_be(range, occurring(brick).as_deref()))
    });
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
    Ok(Prepared {
        volume,
        lattice,
        ends: grid.index_box().map(Vec3::from_glam),
        skip,
        function: over_value,
        table,
        over_two,
        look,
        calls,
        first,
        gradient_range,
        reference_length: world(sampling.reference_length, "sampling.reference_length")?,
        stop_at: R::from_f64(stop_at(sampling.stop_below, scene.picture.blend_space)),
        encode: scene.picture.blend_space == BlendSpace::Srgb,
        collects: layers.iter().any(|&l| l != LayerKind::Beauty && l != LayerKind::Counts),
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

/// lo and hi − lo of |g| ([VAL-2]), times the power of two of [SPACE-4].
fn gradient_range<R: Real, S: Sampler<R>>(
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
        Function::Regular(nodes) => Ok(Look::Regular {
            colors: nodes.color.iter().map(|c| c.map(R::from_f64)).collect(),
            phong: scene.shading.as_ref().map(|s| Phong::new(s, scene.light, view)),
        }),
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

/// The channels of a tile, pixel by pixel.
struct Tile {
    x: usize,
    y: usize,
    width: usize,
    pixels: Vec<f64>,
    counts: Counts,
}

/// Casts all rays of a picture. Each pixel is a function of its place alone, so neither threads nor the order of tiles
/// show ([RAY-3]).
fn draw<R: Real, S: Sampler<R>>(
    prepared: &Prepared<'_, R>,
    sampler: &S,
    background: Backdrop<'_>,
    tile: usize,
    progress: &(dyn Fn(f64) + Sync),
) -> (Picture, Counts) {
    let [width, height] = prepared.view.size;
    let (across, down) = (width.div_ceil(tile), height.div_ceil(tile));
    let batch = BATCH / (tile * tile);
    let done = std::sync::atomic::AtomicUsize::new(0);
    let per_pixel: usize = prepared.layers.iter().map(|l| l.channels().len()).sum();
    let mut counts = Counts::default();
    let mut channels = vec![vec![0.0; width * height]; per_pixel];
    for first in (0..across * down).step_by(batch) {
        let tiles: Vec<Tile> = (first..(first + batch).min(across * down))
            .into_par_iter()
            .map(|t| {
                let at = [t % across * tile, t / across * tile];
                let drawn = draw_tile(prepared, sampler, background, at, tile);
                let n = 1 + done.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
                progress(n as f64 / (across * down) as f64);
                drawn
            })
            .collect();
        for tile in &tiles {
            counts.add(&tile.counts);
            for (i, pixel) in tile.pixels.chunks_exact(per_pixel).enumerate() {
                let at = (tile.y + i / tile.width) * width + tile.x + i % tile.width;
                for (channel, value) in channels.iter_mut().zip(pixel) {
                    channel[at] = *value;
                }
            }
        }
    }
    let mut channels = channels.into_iter();
    let layers = prepared
        .layers
        .iter()
        .map(|&kind| Layer { kind, channels: channels.by_ref().take(kind.channels().len()).collect() })
        .collect();
    (Picture { width, height, layers }, counts)
}

/// Casts the rays of one tile.
fn draw_tile<R: Real, S: Sampler<R>>(
    prepared: &Prepared<'_, R>,
    sampler: &S,
    background: Backdrop<'_>,
    [x, y]: [usize; 2],
    side: usize,
) -> Tile {
    let [width, height] = prepared.view.size;
    let (right, bottom) = ((x + side).min(width), (y + side).min(height));
    let mut tile = Tile { x, y, width: right - x, pixels: Vec::new(), counts: Counts::default() };
    let mut boxes = prepared.skip.as_ref().map(|skip| {
        let corner = |i: usize, j: usize| {
            let ray = prepared.view.ray(i as f64, j as f64);
            IndexRay::<R>::new(&ray, &prepared.view, &prepared.lattice, prepared.volume.grid()).line()
        };
        let corners = [corner(x, y), corner(right, y), corner(right, bottom), corner(x, bottom)];
        skip.boxes_in(&Beam::new(corners, R::EPSILON.to_f64()))
    });
    for j in y..bottom {
        for i in x..right {
            let behind = match background {
                Backdrop::None => [0.0; 4],
                Backdrop::Color(c) => color::premultiply(c),
                Backdrop::Pixels(pixels) => pixels[j * width + i],
            };
            draw_pixel(prepared, sampler, [i, j], behind, &mut boxes, &mut tile);
        }
    }
    tile
}

/// Casts the n×n rays of one pixel through the centres of its parts and appends its channels ([RAY-6]): of the beauty the
/// mean; of the layers that are means themselves the mean over all samples of the pixel; of the others the first ray's.
fn draw_pixel<R: Real, S: Sampler<R>>(
    prepared: &Prepared<'_, R>,
    sampler: &S,
    [i, j]: [usize; 2],
    behind: Rgba,
    boxes: &mut Option<Boxes>,
    tile: &mut Tile,
) {
    let n = prepared.samples;
    let share = 1.0 / (n * n) as f64;
    let mut beauty = [0.0; 4];
    let (mut first, mut all) = (None, Sums::new());
    for part in 0..n * n {
        let centre = |whole: usize, part: usize| whole as f64 + (part as f64 + 0.5) / n as f64;
        let at = [centre(i, part % n), centre(j, part / n)];
        let cast = cast(prepared, sampler, at, boxes.as_mut(), &mut tile.counts);
        for (mean, c) in beauty.iter_mut().zip(over(cast.rgba, behind, prepared.encode)) {
            *mean += c * share;
        }
        all.pool(&cast.sums);
        first.get_or_insert((cast.sums, cast.samples));
    }
    // A pixel has at least one part.
    let (first, samples) = first.unwrap_or((Sums::new(), 0));
    for &kind in &prepared.layers {
        if kind == LayerKind::Beauty {
            tile.pixels.extend(beauty);
        } else {
            let sums = if pooled(kind) { &all } else { &first };
            sums.channels(kind, samples, prepared.field.scale_exponent(), &mut tile.pixels);
        }
    }
}

/// C + (1 − A)·B, A + (1 − A)·A_B ([IO-6]). With encoded compositing the colour comes in encoded; the background's
/// straight colour is encoded and premultiplied, and the result is decoded ([VAL-3]).
fn over([r, g, b, a]: Rgba, behind: Rgba, encode: bool) -> Rgba {
    let through = 1.0 - a;
    let add = |[br, bg, bb, ba]: Rgba| [r + through * br, g + through * bg, b + through * bb, a + through * ba];
    if !encode {
        return add(behind);
    }
    let map = |[r, g, b, a]: Rgba, f: fn(f64) -> f64| [f(r), f(g), f(b), a];
    let behind = color::premultiply(map(color::unpremultiply(behind), color::linear_to_srgb));
    color::premultiply(map(color::unpremultiply(add(behind)), color::srgb_to_linear))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn over_by_hand() {
        assert_eq!(over([0.25, 0.0, 0.0, 0.5], [1.0; 4], false), [0.75, 0.5, 0.5, 1.0]);
        assert_eq!(over([0.25, 0.0, 0.0, 0.5], [0.0; 4], false), [0.25, 0.0, 0.0, 0.5]);
        // Half black over white, encoded: ½ in sRGB is 0.2140 in linear light.
        let got = over([0.0, 0.0, 0.0, 0.5], [1.0; 4], true);
        assert!((got[0] - 0.214_041_140_5).abs() < 1e-9 && got[3] == 1.0, "{got:?}");
    }
}
