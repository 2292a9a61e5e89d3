//! Halo seeding (3.1): the halo transfer function h and the seed intensity s ([HALO-2], [HALO-3]).

use super::{DirectionInfluence, FocusInfluence};
use crate::transfer::{NodesError, Piecewise};
use drypoint_scene::glam::DVec3;
use drypoint_scene::math;
use drypoint_scene::shot::{HaloParams, SeedSide, SeedValue};

/// The seeding of one halo.
#[derive(Clone, Debug)]
pub struct Seeding {
    value: ValueInfluence,
    direction: Option<DirectionInfluence>,
    pub(crate) focus: Option<FocusInfluence>,
    pub(crate) labels: Option<Vec<u32>>,
    /// a.
    gradient_exponent: f64,
    side: SeedSide,
    floor: f64,
    /// |n·v| beyond which s is below the floor, whatever h and |g| are.
    most_frontal: f64,
}

/// h_v.
#[derive(Clone, Debug)]
enum ValueInfluence {
    /// 1.
    One,
    /// α_u of the transfer function.
    Opacity,
    /// A function given by nodes; none stands for 0. The values of its nodes stand beside it.
    Nodes(Box<Piecewise<f64>>, Vec<f64>),
}

/// A sample before its gradient is known.
#[derive(Clone, Copy, Debug)]
pub struct SeedPlace {
    /// The value.
    pub value: f64,
    /// α_u of the transfer function; 0 if it is not needed.
    pub alpha_u: f64,
    /// The place in world space; 0 if it is not needed.
    pub world: DVec3,
    /// The label; 0 if it is not needed.
    pub label: u32,
}

/// A sample's normal and related quantities.
#[derive(Clone, Copy, Debug)]
pub struct SeedNormal {
    /// N to the right and upwards in eye space.
    pub in_picture: [f64; 2],
    /// |n·v|.
    pub n_dot_v: f64,
    /// |g| in [0, 1].
    pub magnitude: f64,
    /// τ of the halo's own T ([STF-7]); 0 if [`Seeding::thickness`] is none.
    pub tau: f64,
}

impl Seeding {
    /// Prepares the seeding of a halo.
    ///
    /// # Errors
    /// The nodes of h_v do not make a function.
    pub fn new(halo: &HaloParams) -> Result<Self, NodesError> {
        let seed = &halo.seed;
        let value = match &seed.value {
            None => ValueInfluence::One,
            Some(SeedValue::Opacity) => ValueInfluence::Opacity,
            Some(SeedValue::Nodes(nodes)) => {
                let (at, h): (Vec<f64>, Vec<f64>) = nodes.iter().map(|&[at, h]| (at, h)).unzip();
                ValueInfluence::Nodes(Box::new(Piecewise::new(&at, &h)?), at)
            }
        };
        let most_frontal = match seed.side {
            // (1 − x)^b < floor for x > 1 − floor^(1/b), with a margin for the rounding of both powers.
            SeedSide::Power { exponent } if exponent > 0.0 && halo.floor > 0.0 => {
                1.0 - math::pow(halo.floor, 1.0 / exponent) + 1e-9
            }
            SeedSide::Power { .. } | SeedSide::Curvature { .. } => 1.0,
        };
        Ok(Self {
            value,
            direction: seed.direction.and_then(DirectionInfluence::new),
            focus: seed.focus.as_ref().map(FocusInfluence::new),
            labels: seed.labels.clone(),
            gradient_exponent: seed.gradient_exponent,
            side: seed.side,
            floor: halo.floor,
            most_frontal,
        })
    }

    /// Whether h_v is α_u of the transfer function.
    pub fn reads_opacity(&self) -> bool {
        matches!(self.value, ValueInfluence::Opacity)
    }

    /// T of the halo's own τ, if its seeds are by curvature.
    pub fn thickness(&self) -> Option<f64> {
        match self.side {
            SeedSide::Curvature { thickness } => Some(thickness),
            SeedSide::Power { .. } => None,
        }
    }

    /// h_v·h_l·h_p, which need no gradient. It is 0 if s is below the floor whatever the gradient is.
    #[inline]
    pub fn before_gradient(&self, at: &SeedPlace) -> f64 {
        let h_v = self.by_value(at.value, at.alpha_u);
        if h_v <= 0.0 || self.labels.as_ref().is_some_and(|labels| !labels.contains(&at.label)) {
            return 0.0;
        }
        let h = self.focus.as_ref().map_or(h_v, |focus| h_v * focus.at(at.world));
        // The other factors are at most 1.
        if h < self.floor { 0.0 } else { h }
    }

    /// h_v.
    #[inline]
    fn by_value(&self, value: f64, alpha_u: f64) -> f64 {
        match &self.value {
            ValueInfluence::One => 1.0,
            ValueInfluence::Opacity => alpha_u,
            ValueInfluence::Nodes(nodes, _) => nodes.locate(value).map_or(0.0, |place| place.alpha_u),
        }
    }

    /// s = clamp₀₁(h·|g|^a·(1 − |n·v|)^b), or with clamp₀₁(1 − |n·v|/τ) in place of the power. It is 0 below the floor.
    /// `h` is [`before_gradient`](Self::before_gradient).
    #[inline]
    pub fn strength(&self, h: f64, normal: &SeedNormal) -> f64 {
        let h_d = self.direction.map_or(1.0, |direction| direction.at(normal.in_picture));
        if normal.n_dot_v > self.most_frontal {
            return 0.0;
        }
        let s = self.product(h, h_d, normal);
        if s < self.floor { 0.0 } else { s }
    }

    /// s without the floor, in a direction with this h_d.
    #[inline]
    fn product(&self, h: f64, h_d: f64, normal: &SeedNormal) -> f64 {
        let sideways = match self.side {
            // For unit vectors, the product can exceed 1 by an ulp.
            SeedSide::Power { exponent } => power((1.0 - normal.n_dot_v).max(0.0), exponent),
            SeedSide::Curvature { .. } if normal.tau > 0.0 => (1.0 - normal.n_dot_v / normal.tau).max(0.0),
            SeedSide::Curvature { .. } => 0.0,
        };
        (h * h_d * power(normal.magnitude, self.gradient_exponent) * sideways).min(1.0)
    }
}

/// The least and largest numbers that errors leave of the quantities of a sample that seeds ([GPU-2]).
#[derive(Clone, Copy, Debug)]
pub(crate) struct SeedRanges {
    pub(crate) value: [f64; 2],
    pub(crate) alpha_u: [f64; 2],
    /// The largest displacement of the place in world space.
    pub(crate) displaced: f64,
    /// The largest displacement of N in eye space.
    pub(crate) turned: f64,
    pub(crate) n_dot_v: [f64; 2],
    pub(crate) magnitude: [f64; 2],
    pub(crate) tau: [f64; 2],
}

impl Seeding {
    /// The least and the largest s of a sample whose quantities have errors. s rises with h, h_d, |g| and τ, and falls
    /// with |n·v|, so its ends are at the corners. h_v is linear between nodes, so its ends are at nodes or at the ends.
    pub(crate) fn range(&self, at: &SeedPlace, normal: &SeedNormal, ranges: &SeedRanges) -> [f64; 2] {
        /// Roundings of s in f32, relative to it: those of products, and of two powers down to the floor, whose exponents
        /// y ln x are above −6.
        const ROUNDINGS: f64 = 128.0 * f32::EPSILON as f64;
        let hull = |[a, b]: [f64; 2], x: f64| [a.min(x), b.max(x)];
        let mut h = [f64::INFINITY, f64::NEG_INFINITY];
        let [low, high] = ranges.value;
        let inside: Vec<f64> = match &self.value {
            ValueInfluence::Nodes(_, nodes) => {
                nodes.iter().flat_map(|&at| [at.next_down(), at]).filter(|at| low < *at && *at < high).collect()
            }
            ValueInfluence::One | ValueInfluence::Opacity => Vec::new(),
        };
        for value in inside.into_iter().chain(ranges.value) {
            for alpha_u in ranges.alpha_u {
                // Without the focus, which has errors of its own.
                h = hull(h, self.by_value(value, alpha_u));
            }
        }
        if self.labels.as_ref().is_some_and(|labels| !labels.contains(&at.label)) {
            return [0.0; 2];
        }
        let of_focus = self.focus.as_ref().map_or([1.0; 2], |focus| focus.range(at.world, ranges.displaced));
        let rounded = [1.0 - ROUNDINGS, 1.0 + ROUNDINGS];
        let h = [0, 1].map(|end| h[end].max(0.0) * of_focus[end]);
        let directions = self.direction.map_or([1.0; 2], |d| d.range(normal.in_picture, ranges.turned));
        let ends = |end: usize| {
            let corner = SeedNormal {
                in_picture: normal.in_picture,
                n_dot_v: ranges.n_dot_v[1 - end],
                magnitude: ranges.magnitude[end],
                tau: ranges.tau[end],
            };
            // A threshold in f32 may be passed by a rounding.
            let [h, s] = [h[end], self.product(h[end], directions[end], &corner)].map(|x| x * rounded[end]);
            let is_frontal = corner.n_dot_v > self.most_frontal + [-ROUNDINGS, ROUNDINGS][end];
            if is_frontal || h <= 0.0 || h < self.floor || s < self.floor { 0.0 } else { s.min(1.0) }
        };
        [ends(0), ends(1)]
    }
}

/// x^y for x in [0, 1]; 0⁰ = 1. Small integer exponents use repeated products.
fn power(x: f64, y: f64) -> f64 {
    /// The largest exponent that uses repeated products.
    const MOST_PRODUCTS: f64 = 64.0;
    if y == 0.0 || x >= 1.0 {
        1.0
    } else if y.fract() == 0.0 && y <= MOST_PRODUCTS {
        math::pow_whole(x, 1.0, y as u32)
    } else if y <= 1.0 && x > 0.0 {
        math::power(x, y)
    } else {
        math::pow(x, y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::shot::{
        HaloAccumulation, HaloKind, HaloSeed, HaloSource, HaloSpread, SeedDirection, SeedFocus,
    };

    fn halo(side: SeedSide, a: f64) -> HaloParams {
        HaloParams {
            name: "halo".into(),
            kind: HaloKind::Occlusive,
            seed: HaloSeed { value: None, direction: None, focus: None, labels: None, gradient_exponent: a, side },
            spread: HaloSpread { from: HaloSource::Gradient, passes: 4, delta: 0.8, stretch: 1.0, median: false },
            profile: Vec::new(),
            opacity: 1.0,
            floor: 0.0,
            every: 1,
            accumulate: HaloAccumulation::Max,
            tints: Vec::new(),
        }
    }

    fn normal(n_dot_v: f64, magnitude: f64) -> SeedNormal {
        SeedNormal { in_picture: [0.0, 1.0], n_dot_v, magnitude, tau: 0.0 }
    }

    fn seeding(halo: &HaloParams) -> Seeding {
        Seeding::new(halo).unwrap()
    }

    #[test]
    fn powers_by_hand() {
        let contour = seeding(&halo(SeedSide::Power { exponent: 2.0 }, 0.5));
        assert_eq!(contour.strength(0.5, &normal(0.5, 0.25)), 0.5 * 0.5 * 0.25);
        assert_eq!(contour.strength(1.0, &normal(0.0, 1.0)), 1.0);
        assert_eq!(contour.strength(1.0, &normal(1.0 + f64::EPSILON, 1.0)), 0.0);
        // The printed exponents: of |g| = ½ nothing is left, and the angle hardly counts.
        let printed = seeding(&halo(SeedSide::Power { exponent: 0.125 }, 32.0));
        assert_eq!(printed.strength(1.0, &normal(0.0, 0.5)), 0.5f64.powi(32));
        assert!((printed.strength(1.0, &normal(0.5, 1.0)) - 0.917_004_043_204_671_2).abs() < 1e-15);
        assert_eq!(printed.strength(1.0, &normal(0.0, 1e-300)), 0.0);
    }

    #[test]
    fn an_exponent_of_0_is_a_factor_of_1() {
        let flat = seeding(&halo(SeedSide::Power { exponent: 0.0 }, 0.0));
        assert_eq!(flat.strength(0.25, &normal(1.0, 0.0)), 0.25);
    }

    #[test]
    fn curvature_by_hand() {
        let curved = seeding(&halo(SeedSide::Curvature { thickness: 1.0 }, 0.0));
        let at = |n_dot_v, tau| curved.strength(1.0, &SeedNormal { tau, ..normal(n_dot_v, 1.0) });
        assert_eq!([at(0.0, 0.5), at(0.25, 0.5), at(0.5, 0.5), at(0.75, 0.5)], [1.0, 0.5, 0.0, 0.0]);
        assert_eq!(at(0.0, 0.0), 0.0);
    }

    /// The test of |n·v| before the power takes nothing away that the floor would leave.
    #[test]
    fn the_floor_and_the_test_before_the_power() {
        let floor = 1.0 / 255.0;
        let (with, without) = (halo(SeedSide::Power { exponent: 32.0 }, 0.125), 0.0);
        let (with, without) =
            (seeding(&HaloParams { floor, ..with.clone() }), seeding(&HaloParams { floor: without, ..with }));
        for i in 0..=100_000 {
            let at = normal(f64::from(i) / 100_000.0, 1.0);
            let whole = without.strength(1.0, &at);
            assert_eq!(with.strength(1.0, &at), if whole < floor { 0.0 } else { whole });
        }
    }

    #[test]
    fn factors_multiply() {
        let mut params = halo(SeedSide::Power { exponent: 1.0 }, 0.0);
        params.seed.value = Some(SeedValue::Nodes(vec![[80.0, 0.0], [120.0, 1.0]]));
        params.seed.labels = Some(vec![12, 13]);
        params.seed.focus = Some(SeedFocus { at: vec![DVec3::ZERO], inner: 0.0, falloff: 4.0 });
        params.seed.direction = Some(SeedDirection { toward: 0.0, width: 0.0, softness: 180.0 });
        let seeding = seeding(&params);
        let place = SeedPlace { value: 100.0, alpha_u: 0.0, world: DVec3::X, label: 13 };
        assert_eq!(seeding.before_gradient(&place), 0.5 * 0.75);
        assert_eq!(seeding.before_gradient(&SeedPlace { label: 11, ..place }), 0.0);
        assert_eq!(seeding.before_gradient(&SeedPlace { value: 80.0, ..place }), 0.0);
        assert_eq!(seeding.before_gradient(&SeedPlace { value: 1e9, ..place }), 0.75);
        let right = SeedNormal { in_picture: [1.0, 0.0], ..normal(0.0, 1.0) };
        assert!((seeding.strength(0.375, &right) - 0.1875).abs() < 1e-15);
    }
}
