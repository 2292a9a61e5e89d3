//! A rendered picture as plain layers, before any file format.

use crate::color::Rgba;
use serde::{Deserialize, Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;

/// Named layers of one size; row 0 is the top. The layer `beauty` is linear, premultiplied, background included
/// ([IO-6]).
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Picture {
    /// Pixels from left to right.
    pub width: usize,
    /// Pixels from top to bottom.
    pub height: usize,
    /// The layers, in the order in which the scene asked for them.
    pub layers: Vec<Layer>,
}

/// Pixels that are laid over a part of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Overlay {
    /// Column and row of the upper left pixel in the picture.
    pub corner: [usize; 2],
    /// Pixels from left to right.
    pub width: usize,
    /// Pixels row by row from the top, linear and premultiplied.
    pub pixels: Vec<Rgba>,
}

/// One layer of a picture: channels of `width · height` numbers, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// Which layer it is.
    pub kind: LayerKind,
    /// The samples of each channel, in the order of [`LayerKind::channels`].
    pub channels: Vec<Vec<f64>>,
}

/// The layers that a scene can ask for ([IO-6]).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Deserialize)]
#[serde(try_from = "String")]
pub enum LayerKind {
    /// The picture: linear premultiplied RGBA with the background behind.
    Beauty,
    /// Eye depth where accumulated opacity first reaches ½; the channel is `Z`.
    Z,
    /// `depth.FIRST`, `depth.HALF`, `depth.MEAN`.
    Depth,
    /// Opacity-weighted mean of the eye-space outward normal N.
    Normal,
    /// Opacity-weighted mean of the world gradient.
    Gradient,
    /// Opacity-weighted means of `K1`, `K2` and `KV`.
    Curvature,
    /// Only the scene's κ: `curvature.KV`; computes no Hessian by itself.
    CurvatureAlongView,
    /// The value at the first visible sample, which has α > 0: `first.VALUE`.
    First,
    /// N at the first visible sample, in eye space: `first.normal.X` and so on.
    FirstNormal,
    /// `K1`, `K2` and `KV` at the first visible sample: `first.curvature.K1` and so on.
    FirstCurvature,
    /// Only the scene's κ at the first visible sample: `first.curvature.KV`; computes no Hessian by itself.
    FirstCurvatureAlongView,
    /// Samples evaluated on the ray: `counts.SAMPLES`.
    Counts,
    /// The largest intensity of halo n of the scene on the ray, before its profile: `halo0.H` of the first.
    Halo(usize),
    /// The coverage of object n of the shot: `part0.A` of the first, which is the background. A sample covers a pixel by
    /// its weight (1 − A)·α(Δ), and each object by its fraction of what the sample shows. The sum over objects is A of the
    /// samples and the iso-surface; that surface is the background's. Meshes, lines and glows belong to no object.
    Part(usize),
}

/// The beginning of the names of halos' layers, before the halo's place in the list.
const HALO: &str = "halo";

/// The beginning of the names of objects' layers, before the object's place in the list.
const PART: &str = "part";

impl Serialize for LayerKind {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.name())
    }
}

impl TryFrom<String> for LayerKind {
    type Error = String;

    fn try_from(name: String) -> Result<Self, String> {
        Self::from_name(&name).ok_or_else(|| format!("there is no layer {name:?}"))
    }
}

impl LayerKind {
    /// Every layer but those of halos and objects, in the order of the documentation.
    pub const ALL: [Self; 12] = [
        Self::Beauty,
        Self::Z,
        Self::Depth,
        Self::Normal,
        Self::Gradient,
        Self::Curvature,
        Self::CurvatureAlongView,
        Self::First,
        Self::FirstNormal,
        Self::FirstCurvature,
        Self::FirstCurvatureAlongView,
        Self::Counts,
    ];

    /// The name in a scene and on the command line.
    pub fn name(self) -> Cow<'static, str> {
        Cow::Borrowed(match self {
            Self::Halo(n) => return Cow::Owned(format!("{HALO}{n}")),
            Self::Part(n) => return Cow::Owned(format!("{PART}{n}")),
            Self::Beauty => "beauty",
            Self::Z => "Z",
            Self::Depth => "depth",
            Self::Normal => "normal",
            Self::Gradient => "gradient",
            Self::Curvature => "curvature",
            Self::CurvatureAlongView => "curvature.KV",
            Self::First => "first",
            Self::FirstNormal => "first.normal",
            Self::FirstCurvature => "first.curvature",
            Self::FirstCurvatureAlongView => "first.curvature.KV",
            Self::Counts => "counts",
        })
    }

    /// The layer of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        let numbered = |prefix: &str, kind: fn(usize) -> Self| {
            let kind = kind(name.strip_prefix(prefix)?.parse().ok()?);
            // Leading zeros and signs make no second name.
            (kind.name() == name).then_some(kind)
        };
        let one = Self::ALL.into_iter().find(|kind| kind.name() == name);
        one.or_else(|| numbered(HALO, Self::Halo)).or_else(|| numbered(PART, Self::Part))
    }

    /// Whether a pixel of several rays has the mean over its rays. The mean is plain for objects, and weighted by
    /// opacity for other layers. Layers that are neither means nor the beauty have one ray's numbers ([RAY-6]).
    pub fn is_mean(self) -> bool {
        matches!(self, Self::Normal | Self::Gradient | Self::Curvature | Self::CurvatureAlongView | Self::Part(_))
    }

    /// Full channel names as an EXR file has them.
    pub fn channels(self) -> Vec<Cow<'static, str>> {
        let names: &[&str] = match self {
            Self::Halo(n) => return vec![Cow::Owned(format!("{HALO}{n}.H"))],
            Self::Part(n) => return vec![Cow::Owned(format!("{PART}{n}.A"))],
            Self::Beauty => &["R", "G", "B", "A"],
            Self::Z => &["Z"],
            Self::Depth => &["depth.FIRST", "depth.HALF", "depth.MEAN"],
            Self::Normal => &["normal.X", "normal.Y", "normal.Z"],
            Self::Gradient => &["gradient.X", "gradient.Y", "gradient.Z"],
            Self::Curvature => &["curvature.K1", "curvature.K2", "curvature.KV"],
            Self::CurvatureAlongView => &["curvature.KV"],
            Self::First => &["first.VALUE"],
            Self::FirstNormal => &["first.normal.X", "first.normal.Y", "first.normal.Z"],
            Self::FirstCurvature => &["first.curvature.K1", "first.curvature.K2", "first.curvature.KV"],
            Self::FirstCurvatureAlongView => &["first.curvature.KV"],
            Self::Counts => &["counts.SAMPLES"],
        };
        names.iter().copied().map(Cow::Borrowed).collect()
    }
}

impl fmt::Display for LayerKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name())
    }
}

impl Picture {
    /// The layer of that kind, if the picture has it.
    pub fn layer(&self, kind: LayerKind) -> Option<&Layer> {
        self.layers.iter().find(|layer| layer.kind == kind)
    }
}

/// The origin of a picture, for the picture's file ([IO-2]). There is no date, so that the same scene gives the same
/// bytes.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Provenance {
    /// Name and version of the program.
    pub software: String,
    /// A hash of the scene with every default filled in.
    pub scene_hash: String,
    /// The plan, as text.
    pub plan: String,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_have_names_and_channels_of_their_own() {
        for kind in LayerKind::ALL.into_iter().chain([LayerKind::Halo(0), LayerKind::Halo(12), LayerKind::Part(7)]) {
            assert_eq!(LayerKind::from_name(&kind.name()), Some(kind));
            assert!(!kind.channels().is_empty());
        }
        assert_eq!(
            (LayerKind::Halo(3).name(), &LayerKind::Halo(3).channels()[..]),
            ("halo3".into(), &["halo3.H".into()][..])
        );
        assert_eq!(LayerKind::Part(3).channels(), ["part3.A"]);
        for none in
            ["halo", "halo01", "halo+1", "halo-1", "halo1.H", "halo99999999999999999999", "Halo0", "part", "part1.A"]
        {
            assert_eq!(LayerKind::from_name(none), None, "{none}");
        }
    }
}
