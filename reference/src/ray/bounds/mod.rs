//! Bounds of the errors of an f32 renderer, pixel by pixel ([GPU-2]).
//!
//! The picture has the same bits as ever, but is computed on numbers that carry their errors ([`Bounded`]). If a
//! [`Decision`] is open and shows, the pixel is undecided, and no renderer is held to its bound there.
//!
//! Functions here that evaluate samples are `#[inline]`. The code of samples for [`Bounded`] is then compiled in the
//! crates that ask for bounds, and not in this one, whose pictures do not need it.

mod cast;
mod moved_ray;
mod positions;
mod surface;

pub use positions::RayOrigin;

use super::draw::behind;
use super::error::RenderError;
use super::prepare::prepare;
use super::prepared::Prepared;
use super::render::Renderer;
use crate::accumulator::Accumulator;
use crate::field::Kernel;
use crate::number::{Bounded, Decision, Real};
use cast::Traced;
use drypoint_scene::color::{self, Rgba};
use drypoint_scene::counts::Counts;
use drypoint_scene::inputs::Inputs;
use drypoint_scene::parallel;
use drypoint_scene::picture::{Layer, LayerKind, Picture};
use drypoint_scene::shot::Shot;
use drypoint_scene::volume::Volume;
use surface::SurfaceErrors;

/// A picture with bounds.
#[derive(Clone, Debug)]
pub struct Bounds {
    /// The reference's picture.
    pub values: Picture,
    /// The largest distance of an f32 renderer's picture from each number of [`values`](Self::values).
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
}

impl Renderer<'_> {
    /// Renders a shot with bounds of the errors of an f32 renderer whose rays begin at `origin`.
    ///
    /// # Errors
    /// See [`Renderer::new`]. There are no bounds for halos, further layers, functions that are read from a table, and
    /// rays that are added at edges.
    #[inline]
    pub fn bounds(shot: &Shot, inputs: Inputs<'_>, origin: RayOrigin) -> Result<Bounds, BoundsError> {
        let mut prepared: Prepared<'_, Bounded> = prepare(shot, &inputs, &mut Counts::default())?;
        let is_elsewhere = |further: &&Volume| further.grid() != inputs.main.volume.grid();
        let (has_surface, kernel) = (prepared.surface.is_some(), prepared.object.field.reconstruction().kernel);
        let unknown = [
            (inputs.main.further.iter().flatten().any(is_elsewhere), "a further volume on another grid"),
            (prepared.halos.is_some(), "halos"),
            (prepared.combination.is_some(), "objects"),
            (prepared.meshes.is_some(), "meshes"),
            (prepared.refine_above.is_some(), "rays that are added at edges"),
            (prepared.object.table.is_some(), "a transfer function that is read from a table"),
            (has_surface && !prepared.object.clip.planes.is_empty(), "an iso-surface under clip planes"),
            (has_surface && kernel != Kernel::Trilinear, "an iso-surface of a kernel other than trilinear"),
            (prepared.layers != [LayerKind::Beauty], "layers beyond the beauty"),
        ];
        if let Some((_, what)) = unknown.into_iter().find(|(is_there, _)| *is_there) {
            return Err(BoundsError::Unknown { what });
        }
        // Nothing is skipped, because an f32 renderer may evaluate samples that show nothing.
        (prepared.skip, prepared.cells) = (None, None);
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
    let pixels: Vec<BoundedPixel> = parallel::map(width * height, &|at| {
        let at = [at % width, at / width];
        draw_pixel(prepared, (at, behind(at)), origin, surface.as_ref())
    });
    let picture = |number: fn(Bounded) -> f64| {
        let channels = (0..4).map(|c| pixels.iter().map(|pixel| number(pixel.rgba[c])).collect()).collect();
        Picture { width, height, layers: vec![Layer { kind: LayerKind::Beauty, channels }] }
    };
    Bounds {
        values: picture(Bounded::value),
        errors: picture(Bounded::error),
        undecided: pixels.iter().map(|pixel| pixel.undecided).collect(),
    }
}

/// Draws a pixel: the mean of its rays over the background.
#[inline]
fn draw_pixel(
    prepared: &Prepared<'_, Bounded>,
    ([i, j], behind): ([usize; 2], Rgba),
    origin: RayOrigin,
    surface: Option<&SurfaceErrors>,
) -> BoundedPixel {
    let n = prepared.rays_across;
    let mut sum = [Bounded::ZERO; 4];
    let mut undecided = None;
    for part in 0..n * n {
        let centre = |pixel: usize, part: usize| pixel as f64 + (part as f64 + 0.5) / n as f64;
        let Traced { front, undecided: of_ray } =
            cast::trace(prepared, [centre(i, part % n), centre(j, part / n)], origin, surface);
        undecided = undecided.or(of_ray);
        for (sum, c) in sum.iter_mut().zip(over(front, behind, prepared.encode)) {
            *sum += c;
        }
    }
    BoundedPixel { rgba: sum.map(|sum| sum / Bounded::from_index(n * n)), undecided }
}

/// A ray's colour over the background ([IO-6]), decoded if compositing is encoded ([VAL-3]).
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
