//! `[shading]`: Blinn–Phong for a regular transfer function ([STF-11]).

use glam::DVec3;

/// The table `[shading]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Shading {
    /// k_a.
    pub ambient: f64,
    /// k_d.
    pub diffuse: f64,
    /// k_s.
    pub specular: f64,
    /// s, the exponent.
    pub shininess: f64,
    /// Towards the light; none: the scene's.
    pub light: Option<LightDirection>,
}

/// Towards the light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightDirection {
    /// Eye space (0, 0, 1) at every sample.
    Head,
    /// Eye space, any length.
    Eye(DVec3),
    /// World space, any length.
    World(DVec3),
}

impl Default for Shading {
    fn default() -> Self {
        Self { ambient: 0.3, diffuse: 0.6, specular: 0.3, shininess: 30.0, light: None }
    }
}
