//! The halo profile (3.3, [HALO-6]), which maps intensity to colour and opacity.

use drypoint_scene::color;
use drypoint_scene::shot::ProfileNode;

/// Colour and opacity as functions of the intensity: piecewise linear, constant beyond both ends.
#[derive(Clone, Debug, PartialEq)]
pub struct HaloProfile {
    nodes: Vec<ProfileNode>,
    /// The factor of all opacities.
    opacity: f64,
    /// Whether colours are encoded after interpolation ([VAL-3]).
    encode: bool,
}

impl HaloProfile {
    /// Prepares nodes in ascending order of the intensity, with a factor of their opacities. `encode` tells whether
    /// compositing is encoded.
    pub fn new(nodes: &[ProfileNode], opacity: f64, encode: bool) -> Self {
        Self { nodes: nodes.to_vec(), opacity, encode }
    }

    /// The intensities of the nodes.
    pub(crate) fn nodes(&self) -> impl Iterator<Item = f64> {
        self.nodes.iter().map(|node| node.at)
    }

    /// The straight colour in the blend space, and the opacity. Returns none if the halo is invisible. An intensity of
    /// 0 is transparent whatever the nodes.
    #[inline]
    pub fn at(&self, intensity: f64) -> Option<([f64; 3], f64)> {
        if intensity <= 0.0 {
            return None;
        }
        let next = self.nodes.iter().position(|node| intensity < node.at).unwrap_or(self.nodes.len());
        let (rgb, opacity) = match (next.checked_sub(1).map(|i| &self.nodes[i]), self.nodes.get(next)) {
            (Some(a), Some(b)) => {
                let w = (intensity - a.at) / (b.at - a.at);
                let mix = |a: f64, b: f64| a + w * (b - a);
                (std::array::from_fn(|c| mix(a.rgb[c], b.rgb[c])), mix(a.opacity, b.opacity))
            }
            (Some(end), None) | (None, Some(end)) => (end.rgb, end.opacity),
            (None, None) => return None,
        };
        let opacity = self.opacity * opacity;
        let rgb = if self.encode { rgb.map(color::linear_to_srgb) } else { rgb };
        (opacity > 0.0).then_some((rgb, opacity))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn node(at: f64, red: f64, opacity: f64) -> ProfileNode {
        ProfileNode { at, rgb: [red, 0.0, 0.0], opacity }
    }

    #[test]
    fn between_and_beyond_nodes() {
        let nodes = [node(0.2, 1.0, 0.0), node(0.6, 0.0, 0.8)];
        let at = |h: f64| HaloProfile::new(&nodes, 0.5, false).at(h);
        assert_eq!(at(0.1), None);
        assert_eq!(at(0.2), None);
        let (rgb, opacity) = at(0.4).unwrap();
        assert!((rgb[0] - 0.5).abs() < 1e-15 && (opacity - 0.2).abs() < 1e-15);
        assert_eq!([0.6, 1.0].map(|h| at(h).unwrap()), [([0.0; 3], 0.4); 2]);
    }

    /// A constant profile has a sharp border, and intensity 0 is transparent whatever the nodes say.
    #[test]
    fn a_constant_profile_ends_at_zero() {
        let constant = HaloProfile::new(&[node(0.0, 1.0, 0.5)], 1.0, false);
        assert_eq!(constant.at(0.0), None);
        assert_eq!(constant.at(1e-300), Some(([1.0, 0.0, 0.0], 0.5)));
        assert_eq!(HaloProfile::new(&[], 1.0, false).at(0.5), None);
    }

    /// Two nodes at one intensity make a step: from there on the second holds.
    #[test]
    fn a_step() {
        let nodes = [node(0.5, 0.0, 0.1), node(0.5, 1.0, 0.9)];
        let profile = HaloProfile::new(&nodes, 1.0, false);
        assert_eq!([0.4, 0.5].map(|h| profile.at(h).unwrap().1), [0.1, 0.9]);
    }

    #[test]
    fn encoded_after_mixing() {
        let nodes = [node(0.0, 0.0, 1.0), node(1.0, 0.428_228_2, 1.0)];
        let (rgb, _) = HaloProfile::new(&nodes, 1.0, true).at(0.5).unwrap();
        // 0.2141141 in linear light is ½ in sRGB.
        assert!((rgb[0] - 0.5).abs() < 1e-4, "{rgb:?}");
    }
}
