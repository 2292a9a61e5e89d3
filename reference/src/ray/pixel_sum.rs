//! The mean of a pixel over its rays ([RAY-6]).

use super::composite::{Cast, Sums};
use super::prepared::Prepared;
use crate::accumulator::Accumulator;
use crate::number::Real;
use drypoint_scene::color::{self, Rgba};
use drypoint_scene::picture::LayerKind;

/// The rays of a pixel so far.
#[derive(Default)]
pub(super) struct PixelSum {
    /// Number of rays.
    rays: u32,
    /// Σ of the beauty. It is divided by the number of rays at the end, so that a mean of opacities is at most 1.
    beauty: Rgba,
    /// The sums and the number of samples of the first ray.
    first: Option<(Option<Box<Sums>>, u64)>,
    /// The sums of all rays.
    pub(super) all: Option<Box<Sums>>,
    /// Σ of the intensities of halos.
    intensities: Vec<f64>,
}

impl PixelSum {
    /// Adds a ray that has `behind` as its background.
    pub(super) fn add<R: Real>(&mut self, prepared: &Prepared<'_, R>, cast: Cast, behind: Rgba) {
        self.add_means(over(cast.rgba, behind, prepared.encode), cast.sums.as_deref());
        self.intensities.resize(cast.intensities.len(), 0.0);
        for (sum, h) in self.intensities.iter_mut().zip(&cast.intensities) {
            *sum += h;
        }
        self.first.get_or_insert((cast.sums, cast.samples));
    }

    /// Adds a ray to the beauty and to the layers that are means. `color` is the ray's colour over the background.
    pub(super) fn add_means(&mut self, color: Rgba, sums: Option<&Sums>) {
        self.rays += 1;
        for (sum, c) in self.beauty.iter_mut().zip(color) {
            *sum += c;
        }
        if let Some(sums) = sums {
            self.all.get_or_insert_with(|| Box::new(Sums::new())).pool(sums);
        }
    }

    /// The beauty: the mean over the rays. There is at least one ray.
    fn mean(&self) -> Rgba {
        self.beauty.map(|sum| sum / f64::from(self.rays))
    }

    /// Appends the channels of layers. The beauty, halos and objects are means over the rays. Other layers that are
    /// means are means over all samples of the pixel. The remaining layers are the first ray's.
    pub(super) fn append<R: Real>(&self, prepared: &Prepared<'_, R>, layers: &[LayerKind], pixels: &mut Vec<f64>) {
        // A pixel has at least one ray, and a refined one no layers of its first.
        let (first, samples) = self.first.as_ref().map_or((None, 0), |(sums, samples)| (sums.as_deref(), *samples));
        let none = Sums::new();
        let [first, all] = [first, self.all.as_deref()].map(|sums| sums.unwrap_or(&none));
        for &kind in layers {
            if kind == LayerKind::Beauty {
                pixels.extend(self.mean());
            } else if let LayerKind::Halo(halo) = kind {
                let place = prepared.halos.as_ref().and_then(|halos| halos.watched_place(halo));
                pixels.push(
                    place.and_then(|place| self.intensities.get(place)).map_or(0.0, |sum| sum / f64::from(self.rays)),
                );
            } else if let LayerKind::Part(object) = kind {
                pixels.push(all.coverage(object) / f64::from(self.rays));
            } else {
                let sums = if kind.is_mean() { all } else { first };
                sums.channels(kind, samples, prepared.object.field.scale_exponent(), pixels);
            }
        }
    }
}

/// A ray's colour over the background ([IO-6]). With encoded compositing, the ray's colour is encoded. The background's
/// straight colour is then encoded and premultiplied, and the result is decoded ([VAL-3]).
pub(super) fn over([r, g, b, a]: Rgba, behind: Rgba, encode: bool) -> Rgba {
    let add = |behind: Rgba| {
        let mut front = Accumulator { rgb: [r, g, b], opacity: a };
        front.over_premultiplied(behind);
        let Accumulator { rgb: [r, g, b], opacity } = front;
        [r, g, b, opacity]
    };
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

    /// 1/9 is rounded, and nine of it are more than 1.
    #[test]
    fn a_mean_of_opaque_rays_is_opaque() {
        for n in 1..8 {
            let mut sum = PixelSum::default();
            (0..n * n).for_each(|_| sum.add_means([1.0, 0.5, 0.0, 1.0], None));
            assert_eq!(sum.mean(), [1.0, 0.5, 0.0, 1.0]);
        }
    }

    #[test]
    fn over_by_hand() {
        assert_eq!(over([0.25, 0.0, 0.0, 0.5], [1.0; 4], false), [0.75, 0.5, 0.5, 1.0]);
        assert_eq!(over([0.25, 0.0, 0.0, 0.5], [0.0; 4], false), [0.25, 0.0, 0.0, 0.5]);
        // Half black over white, encoded: ½ in sRGB is 0.2140 in linear light.
        let got = over([0.0, 0.0, 0.0, 0.5], [1.0; 4], true);
        assert!((got[0] - 0.214_041_140_5).abs() < 1e-9 && got[3] == 1.0, "{got:?}");
    }
}
