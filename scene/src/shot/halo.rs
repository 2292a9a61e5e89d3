//! Volumetric halos of a picture (Bruckner and Gröller 2007), with nothing left to decide.

use super::{HaloAccumulation, HaloKind, HaloSource, SampleQuery};
use glam::DVec3;
use serde::Serialize;

/// The halos of a picture; an empty list where there are none.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Halos {
    /// The halos, in the scene's order: of emissive ones the first lies in front, of occlusive ones the first is mixed
    /// last ([HALO-7]).
    pub list: Vec<HaloParams>,
    /// The query of every sample that is asked for its seeds.
    pub query: SampleQuery,
}

/// One halo.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HaloParams {
    /// Its name.
    pub name: String,
    /// Emissive or occlusive ([HALO-7]).
    pub kind: HaloKind,
    /// Which samples are seeds, and how strong ones ([HALO-2], [HALO-3]).
    pub seed: HaloSeed,
    /// From seeds to intensities on a plane ([HALO-4], [HALO-5]).
    pub spread: HaloSpread,
    /// Colour and opacity over the intensity, in ascending order of `at`; constant beyond both ends ([HALO-6]).
    pub profile: Vec<ProfileNode>,
    /// The factor of the profile's opacities, in [0, 1].
    pub opacity: f64,
    /// Seeds and intensities below it are 0 ([HALO-6]).
    pub floor: f64,
    /// M: the planes of a group ([HALO-8]).
    pub every: i64,
    /// How the seeds of a group's planes come together.
    pub accumulate: HaloAccumulation,
    /// The emissive halos that an occlusive one tints, as their places in the list.
    pub tints: Vec<usize>,
}

/// A node of a halo's profile.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ProfileNode {
    /// The intensity H, in [0, 1].
    pub at: f64,
    /// Linear straight colour.
    pub rgb: [f64; 3],
    /// Opacity: per reference length if emissive, else a weight of mixing.
    pub opacity: f64,
}

/// The halo transfer function h = h_v·h_d·h_p·h_l, and the exponents of s ([HALO-2], [HALO-3]).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HaloSeed {
    /// h_v; none: 1.
    pub value: Option<SeedValue>,
    /// h_d; none: 1.
    pub direction: Option<SeedDirection>,
    /// h_p; none: 1.
    pub focus: Option<SeedFocus>,
    /// h_l: 1 for samples of these labels, else 0; none: 1.
    pub labels: Option<Vec<u32>>,
    /// a of |g|^a.
    pub gradient_exponent: f64,
    /// The factor that is large where the surface is seen from the side.
    pub side: SeedSide,
}

/// h_v.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SeedValue {
    /// α_u of the object's transfer function.
    Opacity,
    /// Pairs of a value and h_v, linear between them, constant beyond both ends; in non-decreasing order of the value.
    Nodes(Vec<[f64; 2]>),
}

/// h_d: the angle θ between N in the picture and up, in degrees, 0 up and 90 right.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SeedDirection {
    /// The middle of the range.
    pub toward: f64,
    /// The width of the range in which h_d = 1.
    pub width: f64,
    /// The width of the fall on each side of it.
    pub softness: f64,
}

/// h_p = clamp₀₁(1 − (dist − inner)/falloff), of the distance to a point or a polyline.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SeedFocus {
    /// A point or the vertices of a polyline, in world space; at least one.
    pub at: Vec<DVec3>,
    /// The distance up to which h_p = 1, in world units.
    pub inner: f64,
    /// The length over which it falls to 0, in world units; 0: a step.
    pub falloff: f64,
}

/// The factor of a seed that is large where a surface is seen from the side ([HALO-3]).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SeedSide {
    /// (1 − |n·v|)^b.
    Power {
        /// b.
        exponent: f64,
    },
    /// clamp₀₁(1 − |n·v|/τ), τ of [STF-7].
    Curvature {
        /// T in world units.
        thickness: f64,
    },
}

/// From seeds to intensities on a plane.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct HaloSpread {
    /// Whether the gradient of the seeds is spread, or the seeds themselves ([HALO-4]).
    pub from: HaloSource,
    /// N.
    pub passes: u32,
    /// δ, in [0, 1].
    pub delta: f64,
    /// q: the distance of the taps of the last pass, in rays; at least 1 ([HALO-5]).
    pub stretch: f64,
    /// Whether a 3×3 median is taken of the seeds before.
    pub median: bool,
}
