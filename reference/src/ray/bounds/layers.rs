//! Layers of a ray with bounds of their errors ([IO-6]).
//!
//! Sums follow the reference's, operation by operation. Two layers jump where the picture does not: the first visible
//! sample, if errors leave open whether an earlier one is visible, and the depth at which A reaches ½. Their numbers then
//! have no bound, an infinite error, and the pixel stays decided. So do the numbers of samples behind lines through which
//! nothing may be seen in f32.

use crate::number::{Arithmetic, Bounded, Real};
use crate::ray::sample::{EyeAxes, SampleAttributes, ViewDirs};
use drypoint_scene::math;
use drypoint_scene::picture::LayerKind;

/// The quantities of a sample that layers show, beside its depth.
#[derive(Clone, Copy, Debug)]
pub(super) struct Quantities {
    value: Bounded,
    /// N in eye space, or v if there is no normal.
    normal: [Bounded; 3],
    /// World gradient, times the power of two of [SPACE-4].
    gradient: [Bounded; 3],
    /// The scene's κ.
    kappa: Bounded,
}

/// Sums along a ray, or over the rays of a pixel.
#[derive(Clone, Debug)]
pub(super) struct LayerSums {
    /// A of the samples alone.
    opacity: Bounded,
    weight: Bounded,
    /// Depth and quantities of the first visible sample.
    first: Option<(Bounded, Quantities)>,
    /// Whether errors leave open which sample is the first visible one.
    is_first_open: bool,
    /// The depth at which A reaches ½; +∞ if it does not.
    half: f64,
    /// The error of `half`; infinite where errors leave open which sample it is.
    half_error: f64,
    depth: Bounded,
    normal: [Bounded; 3],
    gradient: [Bounded; 3],
    kappa: Bounded,
    /// Σw of the background, times 1 − A of the lines before.
    coverage: Bounded,
}

impl Quantities {
    /// The quantities of a sample with its value.
    pub(super) fn new(
        value: Bounded,
        attributes: &SampleAttributes<Bounded>,
        (eye_axes, dirs): (&EyeAxes<Bounded>, &ViewDirs<Bounded>),
    ) -> Self {
        let (n, g) = (eye_axes.normal(attributes, dirs), attributes.gradient);
        Self { value, normal: [n.x, n.y, n.z], gradient: [g.x, g.y, g.z], kappa: attributes.kappa }
    }

    /// The quantities with bounds that also cover those of another way.
    pub(super) fn joined(&self, other: &Self) -> Self {
        let all = |a: [Bounded; 3], b: [Bounded; 3]| [0, 1, 2].map(|i| a[i].joined(b[i]));
        Self {
            value: self.value.joined(other.value),
            normal: all(self.normal, other.normal),
            gradient: all(self.gradient, other.gradient),
            kappa: self.kappa.joined(other.kappa),
        }
    }

    /// The quantities without a bound of κ.
    pub(super) fn with_open_kappa(mut self) -> Self {
        self.kappa = Bounded::new(self.kappa.value(), f64::INFINITY);
        self
    }
}

impl LayerSums {
    /// The sums before the first sample.
    pub(super) fn new() -> Self {
        let none = [Bounded::ZERO; 3];
        Self {
            opacity: Bounded::ZERO,
            weight: Bounded::ZERO,
            first: None,
            is_first_open: false,
            half: f64::INFINITY,
            half_error: 0.0,
            depth: Bounded::ZERO,
            normal: none,
            gradient: none,
            kappa: Bounded::ZERO,
            coverage: Bounded::ZERO,
        }
    }

    /// Whether no sample has been visible.
    pub(super) fn is_empty(&self) -> bool {
        self.first.is_none()
    }

    /// Adds a sample by its α(Δ). It is invisible if α = 0. `through` is 1 − A of the lines before it.
    #[inline]
    pub(super) fn add(&mut self, alpha: Bounded, depth: Bounded, quantities: &Quantities, through: Bounded) {
        let [least, most] = alpha.ends();
        if most <= 0.0 {
            return;
        }
        if self.first.is_none() {
            self.is_first_open |= least <= 0.0;
            self.first = (alpha.value() > 0.0).then_some((depth, *quantities));
        }
        let (weight, opacity) = self.opacity.laid_before(alpha);
        let before = self.opacity.ends();
        self.opacity = if alpha.value() < 1.0 { opacity } else { Bounded::new(1.0, opacity.error()) };
        // f32 may reach ½ here and not before, or not here.
        let [lo, hi] = self.opacity.ends();
        if before[0] < 0.5 && hi >= 0.5 && (lo < 0.5 || before[1] >= 0.5) {
            self.half_error = f64::INFINITY;
        }
        if self.half == f64::INFINITY && self.opacity.value() >= 0.5 {
            self.half = depth.value();
            self.half_error = self.half_error.max(depth.error());
        }
        let add = |sum: &mut [Bounded; 3], q: [Bounded; 3]| {
            for (sum, q) in sum.iter_mut().zip(q) {
                *sum += weight * q;
            }
        };
        self.weight += weight;
        self.depth += weight * depth;
        add(&mut self.normal, quantities.normal);
        add(&mut self.gradient, quantities.gradient);
        self.kappa += weight * quantities.kappa;
        self.coverage += weight * through;
    }

    /// Adds another ray of the same pixel to the means ([RAY-6]).
    #[inline]
    pub(super) fn pool(&mut self, other: &Self) {
        let add = |sum: &mut [Bounded; 3], other: [Bounded; 3]| {
            for (sum, other) in sum.iter_mut().zip(other) {
                *sum += other;
            }
        };
        self.weight += other.weight;
        add(&mut self.normal, other.normal);
        add(&mut self.gradient, other.gradient);
        self.kappa += other.kappa;
        self.coverage += other.coverage;
    }

    /// A mean over the samples; 0 if there are none.
    fn mean(&self, sum: Bounded) -> Bounded {
        if self.weight.value() > 0.0 {
            sum / self.weight
        } else {
            Bounded::new(0.0, if self.weight.error() > 0.0 { f64::INFINITY } else { 0.0 })
        }
    }

    /// Appends the channels of a layer. See [`Sums::channels`](crate::ray::composite::Sums::channels).
    #[inline]
    pub(super) fn channels(&self, kind: LayerKind, exponent: i32, rays: usize, out: &mut Vec<Bounded>) {
        let of_first = |q: Bounded| if self.is_first_open { Bounded::new(q.value(), f64::INFINITY) } else { q };
        let first = |q: fn(&Quantities) -> [Bounded; 3]| {
            self.first.map_or([Bounded::ZERO; 3], |(_, quantities)| q(&quantities)).map(of_first)
        };
        let nowhere = Bounded::exact(f64::INFINITY);
        let half = Bounded::new(self.half, self.half_error);
        match kind {
            LayerKind::Z => out.push(half),
            LayerKind::Depth => {
                let depth = self.first.map_or(nowhere, |(depth, _)| depth);
                let mean = if self.weight.value() > 0.0 { self.mean(self.depth) } else { of_first(nowhere) };
                out.extend([of_first(depth), half, mean]);
            }
            LayerKind::Normal => out.extend(self.normal.map(|sum| self.mean(sum))),
            LayerKind::Gradient => {
                let scaled = |x: f64| math::scale_by_power_of_two(x, exponent);
                let world = |g: Bounded| Bounded::new(scaled(g.value()), scaled(g.error()));
                out.extend(self.gradient.map(|sum| world(self.mean(sum))));
            }
            LayerKind::CurvatureAlongView => out.push(self.mean(self.kappa)),
            LayerKind::First => out.push(first(|q| [q.value; 3])[0]),
            LayerKind::FirstNormal => out.extend(first(|q| q.normal)),
            LayerKind::FirstCurvatureAlongView => out.push(first(|q| [q.kappa; 3])[0]),
            LayerKind::Part(0) => out.push(self.coverage / Bounded::from_index(rays)),
            // The others have no bounds, and are not asked for here.
            LayerKind::Beauty
            | LayerKind::Curvature
            | LayerKind::FirstCurvature
            | LayerKind::Counts
            | LayerKind::Part(_)
            | LayerKind::Halo(_) => {}
        }
    }
}
