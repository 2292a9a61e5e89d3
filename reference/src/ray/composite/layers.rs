//! Layers of a picture, from the samples of its rays ([IO-6]).

use drypoint_scene::math;
use drypoint_scene::picture::LayerKind;

/// The quantities of a visible sample that layers show.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LayerSample {
    /// w = (1 − A)·α(Δ).
    pub(crate) weight: f64,
    /// Eye depth of the sample's plane.
    pub(crate) depth: f64,
    /// The value.
    pub(crate) value: f64,
    /// N in eye space, or v if there is no normal.
    pub(crate) normal: [f64; 3],
    /// World gradient, times the power of two of [SPACE-4].
    pub(crate) gradient: [f64; 3],
    /// κ₁, κ₂ and the scene's κ.
    pub(crate) curvature: [f64; 3],
}

/// The number of objects whose coverage is needed: up to the last object that a layer names.
pub(crate) fn covering_objects(layers: &[LayerKind]) -> usize {
    let end = |layer: &LayerKind| if let LayerKind::Part(n) = layer { n + 1 } else { 0 };
    layers.iter().map(end).max().unwrap_or(0)
}

/// Sums along one ray.
#[derive(Clone, Debug)]
pub(crate) struct Sums {
    weight: f64,
    first: Option<LayerSample>,
    half: f64,
    depth: f64,
    normal: [f64; 3],
    gradient: [f64; 3],
    curvature: [f64; 3],
    /// Σw·w_N of each object that layers show, times 1 − A of the lines before. Missing entries are 0.
    coverage: Vec<f64>,
}

impl Sums {
    /// The sums before the first sample.
    pub(crate) fn new() -> Self {
        let none = [0.0; 3];
        Self {
            weight: 0.0,
            first: None,
            half: f64::INFINITY,
            depth: 0.0,
            normal: none,
            gradient: none,
            curvature: none,
            coverage: Vec::new(),
        }
    }

    /// Adds a sample with α > 0. `opacity` is A with this sample included. `fractions` are the w_N of the sample,
    /// times 1 − A of the lines before it.
    pub(crate) fn add(&mut self, sample: &LayerSample, opacity: f64, fractions: impl ExactSizeIterator<Item = f64>) {
        self.weight += sample.weight;
        self.first.get_or_insert(*sample);
        if self.half == f64::INFINITY && opacity >= 0.5 {
            self.half = sample.depth;
        }
        self.depth += sample.weight * sample.depth;
        for axis in 0..3 {
            self.normal[axis] += sample.weight * sample.normal[axis];
            self.gradient[axis] += sample.weight * sample.gradient[axis];
            self.curvature[axis] += sample.weight * sample.curvature[axis];
        }
        self.cover(fractions.map(|fraction| sample.weight * fraction));
    }

    /// Adds to the coverage of the first objects.
    fn cover(&mut self, each: impl ExactSizeIterator<Item = f64>) {
        self.coverage.resize(self.coverage.len().max(each.len()), 0.0);
        self.coverage.iter_mut().zip(each).for_each(|(sum, w)| *sum += w);
    }

    /// Σw·w_N of object N.
    pub(crate) fn coverage(&self, object: usize) -> f64 {
        self.coverage.get(object).copied().unwrap_or(0.0)
    }

    /// Adds another ray of the same pixel to the means ([RAY-6]). They become means over the samples of both rays, so
    /// each ray counts with its opacity. Depths and the quantities of the first sample remain those of this ray.
    pub(crate) fn pool(&mut self, other: &Self) {
        self.weight += other.weight;
        for axis in 0..3 {
            self.normal[axis] += other.normal[axis];
            self.gradient[axis] += other.gradient[axis];
            self.curvature[axis] += other.curvature[axis];
        }
        self.cover(other.coverage.iter().copied());
    }

    /// The channels of a layer other than the beauty. Means are Σwq/Σw. If Σw = 0, means are 0 and depths are +∞.
    ///
    /// The mean gradient is multiplied by 2^`exponent`, which cancels the power of two of [SPACE-4]. Multiplying the
    /// mean is safe, whereas a sum of overflowing terms could be NaN.
    pub(crate) fn channels(&self, kind: LayerKind, samples: u64, exponent: i32, out: &mut Vec<f64>) {
        let mean = |sum: f64| if self.weight > 0.0 { sum / self.weight } else { 0.0 };
        let first = self.first.unwrap_or_default();
        match kind {
            LayerKind::Beauty => {}
            LayerKind::Z => out.push(self.half),
            LayerKind::Depth => {
                let depth = if self.weight > 0.0 { self.depth / self.weight } else { f64::INFINITY };
                out.extend([self.first.map_or(f64::INFINITY, |f| f.depth), self.half, depth]);
            }
            LayerKind::Normal => out.extend(self.normal.map(mean)),
            LayerKind::Gradient => {
                out.extend(self.gradient.map(|g| math::scale_by_power_of_two(mean(g), exponent)));
            }
            LayerKind::Curvature => out.extend(self.curvature.map(mean)),
            LayerKind::CurvatureAlongView => out.push(mean(self.curvature[2])),
            LayerKind::First => out.push(first.value),
            LayerKind::FirstNormal => out.extend(first.normal),
            LayerKind::FirstCurvature => out.extend(first.curvature),
            LayerKind::FirstCurvatureAlongView => out.push(first.curvature[2]),
            LayerKind::Counts => out.push(samples as f64),
            // These layers are sums over the rays of a pixel.
            LayerKind::Halo(_) | LayerKind::Part(_) => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_and_depths_by_hand() {
        let mut sums = Sums::new();
        let near =
            LayerSample { weight: 0.25, depth: 2.0, value: 7.0, normal: [0.0, 0.0, 1.0], ..LayerSample::default() };
        let gradient = [3.0, 0.0, 0.0];
        let far = LayerSample {
            weight: 0.5,
            depth: 5.0,
            value: 9.0,
            normal: [1.0, 0.0, 0.0],
            gradient,
            ..LayerSample::default()
        };
        sums.add(&near, 0.25, [1.0].into_iter());
        sums.add(&far, 0.75, [0.25, 0.75].into_iter());
        assert_eq!([0, 1, 2].map(|object| sums.coverage(object)), [0.375, 0.375, 0.0]);
        let channels = |kind| {
            let mut out = Vec::new();
            sums.channels(kind, 3, 2, &mut out);
            out
        };
        assert_eq!(channels(LayerKind::Z), [5.0]);
        assert_eq!(channels(LayerKind::Depth), [2.0, 5.0, 4.0]);
        assert_eq!(channels(LayerKind::First), [7.0]);
        assert_eq!(channels(LayerKind::Normal), [2.0 / 3.0, 0.0, 1.0 / 3.0]);
        assert_eq!(channels(LayerKind::Gradient), [4.0 * 2.0, 0.0, 0.0]);
        assert_eq!(channels(LayerKind::Counts), [3.0]);
    }

    #[test]
    fn a_ray_that_hits_nothing() {
        let mut out = Vec::new();
        Sums::new().channels(LayerKind::Depth, 0, 0, &mut out);
        Sums::new().channels(LayerKind::Normal, 0, 0, &mut out);
        Sums::new().channels(LayerKind::First, 0, 0, &mut out);
        assert_eq!(out, [f64::INFINITY, f64::INFINITY, f64::INFINITY, 0.0, 0.0, 0.0, 0.0]);
    }
}
