//! Bounds of the errors of an f32 renderer, pixel by pixel ([GPU-2]).
//!
//! The picture has the same bits as ever, but is computed on numbers that carry their errors ([`Bounded`]). If a
//! [`Decision`] is open and shows, the pixel is undecided, and no renderer is held to its bound there.
//!
//! Functions here that evaluate samples are `#[inline]`. The code of samples for [`Bounded`] is then compiled in the
//! crates that ask for bounds, and not in this one, whose pictures do not need it.

mod aimed_ray;
mod cast;
mod edges;
mod halos;
mod layers;
mod lines;
mod meshes;
mod moved_ray;
mod objects;
mod positions;
mod ray_halos;
mod seeds;
mod stepped_root;
mod surface;
mod trace;

pub use positions::RayOrigin;

use super::draw::behind;
use super::error::RenderError;
use super::prepare::prepare;
use super::prepared::Prepared;
use super::prepared_combination::PreparedCombination;
use super::refinement::ACROSS;
use super::render::Renderer;
use crate::accumulator::Accumulator;
use crate::number::{Bounded, Decision, Real};
use drypoint_scene::color::{self, Rgba};
use drypoint_scene::counts::Counts;
use drypoint_scene::fragments::Fragments;
use drypoint_scene::inputs::Inputs;
use drypoint_scene::parallel;
use drypoint_scene::picture::{Layer, LayerKind, Picture};
use drypoint_scene::shot::Shot;
use halos::BandHalos;
use layers::LayerSums;
use surface::SurfaceErrors;

/// Rays whose halos are in memory together.
const BAND: usize = 1 << 14;

/// A picture with bounds.
#[derive(Clone, Debug)]
pub struct Bounds {
    /// The reference's picture.
    pub values: Picture,
    /// The largest distance of an f32 renderer's picture from each number of [`values`](Self::values); infinite for a
    /// number of a layer that jumps where the picture does not.
    pub errors: Picture,
    /// The open decision of each pixel, row by row from the top; none if the pixel is held to its bound.
    pub undecided: Vec<Option<Decision>>,
}

/// Errors of bounds.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BoundsError {
    /// The picture cannot be made.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// Bounds for a part of the shot are not known.
    #[error("{what}: no bound of f32 errors is known for it yet")]
    Unknown {
        /// The part.
        what: &'static str,
    },
}

/// A pixel with its errors.
struct BoundedPixel {
    rgba: [Bounded; 4],
    undecided: Option<Decision>,
    /// The channels of the other layers, in their order.
    more: Vec<Bounded>,
    /// Whether the errors enclose the results of all outcomes of open decisions.
    is_enclosed: bool,
}

impl Renderer<'_> {
    /// Renders a shot, with lines inside the volume, with bounds of the errors of an f32 renderer whose rays begin at
    /// `origin`.
    ///
    /// # Errors
    /// See [`Renderer::new`]. There are no bounds for halos of objects, smooth cutaways, and layers of counts or principal
    /// curvatures. Beside objects, meshes and halos there are none for lines and further layers.
    #[inline]
    pub fn bounds(
        shot: &Shot,
        inputs: Inputs<'_>,
        lines: Option<Fragments>,
        origin: RayOrigin,
    ) -> Result<Bounds, BoundsError> {
        let mut prepared: Prepared<'_, Bounded> = prepare(shot, &inputs, &mut Counts::default())?;
        let is_principal = |layer: &LayerKind| matches!(layer, LayerKind::Curvature | LayerKind::FirstCurvature);
        let (has_halos, has_objects) = (prepared.halos.is_some(), prepared.combination.is_some());
        let has_funnel = prepared.combination.as_ref().is_some_and(PreparedCombination::has_funnel);
        let is_rich = has_halos || has_objects || prepared.meshes.is_some();
        let unknown = [
            (has_halos && has_objects, "halos of objects"),
            (has_funnel, "a smooth cutaway"),
            (prepared.layers.contains(&LayerKind::Counts), "a layer of counts"),
            (prepared.layers.iter().any(is_principal), "a layer of principal curvatures"),
            (is_rich && lines.is_some(), "lines beside objects, meshes or halos"),
            (is_rich && prepared.layers != [LayerKind::Beauty], "further layers of objects, meshes or halos"),
        ];
        if let Some((_, what)) = unknown.into_iter().find(|(is_there, _)| *is_there) {
            return Err(BoundsError::Unknown { what });
        }
        // Nothing is skipped, because an f32 renderer may evaluate samples that show nothing.
        (prepared.skip, prepared.cells, prepared.lines) = (None, None, lines);
        prepared.combination.iter_mut().for_each(PreparedCombination::skip_nothing);
        Ok(draw(&prepared, inputs, origin))
    }
}

/// Draws all pixels.
#[inline]
fn draw(prepared: &Prepared<'_, Bounded>, inputs: Inputs<'_>, origin: RayOrigin) -> Bounds {
    let [width, height] = prepared.view.size;
    let surface = prepared.surface.as_ref();
    let surface = surface.map(|surface| SurfaceErrors::new(&prepared.object.field, surface.roots.iso()));
    let behind = behind(inputs.background, width);
    let pixel = |at: usize, across: usize, band: Option<&BandHalos<'_>>| {
        let at = [at % width, at / width];
        let parts: Vec<usize> = (0..across * across).collect();
        draw_pixel(prepared, (at, behind(at)), (across, &parts), origin, surface.as_ref(), band).0
    };
    // Halos are in memory for some rows at a time.
    let n = prepared.rays_across;
    let rows = if prepared.halos.is_some() { (BAND / (width * n * n)).max(1) } else { height };
    let mut pixels: Vec<BoundedPixel> = Vec::with_capacity(width * height);
    for first in (0..height).step_by(rows.max(1)) {
        let end = (first + rows).min(height);
        let band = prepared.halos.as_ref();
        let band = band.map(|halos| BandHalos::new((prepared, halos), origin, [first * n, end * n]));
        pixels.extend(parallel::map(width * (end - first), &|at| pixel(first * width + at, n, band.as_ref())));
    }
    // With halos no pixel is refined.
    if let Some(contrast) = prepared.refine_above.filter(|_| prepared.halos.is_none()) {
        let further = prepared.layers.iter().filter(|layer| **layer != LayerKind::Beauty);
        let is_mean = further.flat_map(|layer| layer.channels().into_iter().map(|_| layer.is_mean())).collect();
        let refinement = edges::Refinement { size: prepared.view.size, contrast, is_mean };
        pixels = refinement.refined(pixels, &|at, parts| {
            let at = [at % width, at / width];
            draw_pixel(prepared, (at, behind(at)), (ACROSS, parts), origin, surface.as_ref(), None)
        });
    }
    let picture = |number: fn(Bounded) -> f64| {
        let mut more = 0..;
        let mut layer = |kind: LayerKind| {
            let channel =
                |of: &dyn Fn(&BoundedPixel) -> Bounded| pixels.iter().map(|pixel| number(of(pixel))).collect();
            let channels = match kind {
                LayerKind::Beauty => (0..4).map(|c| channel(&|pixel| pixel.rgba[c])).collect(),
                _ => more.by_ref().take(kind.channels().len()).map(|c| channel(&|pixel| pixel.more[c])).collect(),
            };
            Layer { kind, channels }
        };
        Picture { width, height, layers: prepared.layers.iter().map(|&kind| layer(kind)).collect() }
    };
    Bounds {
        values: picture(Bounded::value),
        errors: picture(Bounded::error),
        undecided: pixels.iter().map(|pixel| pixel.undecided).collect(),
    }
}

/// Draws a pixel: the mean over the rays of some of its n×n parts, over the background. Returns also how they are
/// displayed.
#[inline]
fn draw_pixel(
    prepared: &Prepared<'_, Bounded>,
    ([i, j], behind): ([usize; 2], Rgba),
    (n, parts): (usize, &[usize]),
    origin: RayOrigin,
    surface: Option<&SurfaceErrors>,
    band: Option<&BandHalos<'_>>,
) -> (BoundedPixel, Vec<edges::Displayed>) {
    let mut sum = [Bounded::ZERO; 4];
    let mut displayed = Vec::with_capacity(parts.len());
    let (mut undecided, mut is_enclosed) = (None, true);
    // The sums of the first ray, and those of all rays.
    let (mut first, mut all) = (None, LayerSums::new());
    for &part in parts {
        let centre = |pixel: usize, part: usize| pixel as f64 + (part as f64 + 0.5) / n as f64;
        let point = [centre(i, part % n), centre(j, part / n)];
        let halos = band.map(|band| (band, [i * n + part % n, j * n + part / n]));
        let traced = trace::trace(prepared, point, origin, surface, halos);
        undecided = undecided.or(traced.undecided);
        is_enclosed &= traced.is_enclosed;
        if let Some(sums) = traced.sums {
            all.pool(&sums);
            first.get_or_insert(sums);
        }
        let color = over(traced.front, behind, prepared.encode);
        displayed.push(edges::Displayed::new(color, traced.is_enclosed));
        for (sum, c) in sum.iter_mut().zip(color) {
            *sum += c;
        }
    }
    let mut more = Vec::new();
    let exponent = prepared.object.field.scale_exponent();
    for &kind in prepared.layers.iter().filter(|_| prepared.collects) {
        let sums = if kind.is_mean() { &all } else { first.as_ref().unwrap_or(&all) };
        sums.channels(kind, exponent, parts.len(), &mut more);
    }
    let rgba = sum.map(|sum| sum / Bounded::from_index(parts.len()));
    (BoundedPixel { rgba, more, undecided, is_enclosed }, displayed)
}

/// A ray's colour over the background ([IO-6]), decoded if compositing is encoded ([VAL-3]).
#[inline]
fn over(front: Accumulator<Bounded>, behind: Rgba, encode: bool) -> [Bounded; 4] {
    let add = |mut front: Accumulator<Bounded>, behind: Rgba| {
        front.over_premultiplied(behind.map(Bounded::from_f64));
        let Accumulator { rgb: [r, g, b], opacity } = front;
        [r, g, b, opacity]
    };
    if !encode {
        return add(front, behind);
    }
    let [r, g, b, a] = color::unpremultiply(behind);
    let encoded = [r, g, b].map(color::linear_to_srgb);
    let [r, g, b, a] = add(front, color::premultiply([encoded[0], encoded[1], encoded[2], a]));
    if a.value() == 0.0 {
        return [r, g, b, a];
    }
    // The decoded straight colour, times a. A straight colour is at most 1, so where a is smaller than its own bound,
    // the error is that of a.
    let decoded = |c: Bounded| Bounded::monotone([c / a], |[c]| color::srgb_to_linear(c)) * a;
    [decoded(r), decoded(g), decoded(b), a]
}
