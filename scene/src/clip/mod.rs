//! Clip planes: sides of planes that are cut away from a volume and from everything drawn of it ([RAY-8]).

mod line;
mod plane;

pub use line::{ClippedParts, ClippedRange};
pub use plane::ClipPlane;

use glam::DVec3;
use serde::{Deserialize, Serialize};

/// Clip planes. The kept region lies on no plane's cut side, and is convex.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct ClipPlanes(pub Vec<ClipPlane>);

/// No planes.
pub static NO_PLANES: ClipPlanes = ClipPlanes(Vec::new());

impl ClipPlanes {
    /// Whether nothing is cut away.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether a place in index space is cut away.
    #[inline]
    pub fn cut(&self, index: DVec3) -> bool {
        self.0.iter().any(|plane| plane.beyond(index) > 0.0)
    }

    /// Whether a place in world space is cut away.
    #[inline]
    pub fn cut_in_world(&self, world: DVec3) -> bool {
        self.0.iter().any(|plane| plane.beyond_in_world(world) > 0.0)
    }
}
