//! Widths of strokes ([HATCH-13], not in the paper).

use drypoint_scene::glam::DVec3;
use drypoint_scene::math;
use drypoint_scene::philox::uniform;
use drypoint_scene::space::Grid;
use drypoint_scene::view::View;

/// Returns the tone τ = 1 − clamp(ambient + N·L) of a surface with the unit normal N under the unit light L.
pub fn surface_tone(ambient: f64, normal: DVec3, light: DVec3) -> f64 {
    1.0 - (ambient + normal.dot(light)).clamp(0.0, 1.0)
}

/// Factors of a stroke's width at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WidthShares {
    /// The tone τ and its exponent γ.
    pub tone: (f64, f64),
    /// The place u in [0, 1] along the stroke, and the length b of each tapered end on that scale: 0 without taper.
    pub taper: (f64, f64),
    /// The random factor of the stroke. See [`scatter`].
    pub scatter: f64,
    /// The relative depth z in [0, 1], and the share k of its width that a stroke loses at z = 1.
    pub depth: (f64, f64),
}

impl WidthShares {
    /// Returns the width W·τ^γ·min(1, u/b, (1 − u)/b)·scatter·(1 − k·z) for the largest width W.
    pub fn width(&self, widest: f64) -> f64 {
        let Self { tone: (tone, gamma), taper: (u, b), scatter, depth: (z, k) } = *self;
        widest * math::pow(tone, gamma) * taper(u, b) * scatter * (1.0 - k * z)
    }
}

fn taper(u: f64, b: f64) -> f64 {
    if b == 0.0 { 1.0 } else { (u / b).min((1.0 - u) / b).clamp(0.0, 1.0) }
}

/// Returns the random factor of a stroke's width, evenly distributed in 1 ± jitter.
pub fn scatter(jitter: f64, seed: u64, key: u64) -> f64 {
    let key = [key as u32, (key >> 32) as u32, 0];
    if jitter == 0.0 { 1.0 } else { 1.0 + jitter * (2.0 * uniform(seed, key, 3) - 1.0) }
}

/// Eye depths of the nearest and the farthest corner of a volume's voxels, in world units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthRange([f64; 2]);

impl DepthRange {
    /// Measures the depths from a camera.
    pub fn new(view: &View, grid: &Grid) -> Self {
        let last = grid.dims().map(|n| n as f64 - 1.0);
        let corner =
            |i: usize| DVec3::from_array(std::array::from_fn(|axis| if i >> axis & 1 == 1 { last[axis] } else { 0.0 }));
        let depths = (0..8).map(|i| -view.to_eye(grid.to_world(corner(i))).z);
        Self(depths.fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], depth| [lo.min(depth), hi.max(depth)]))
    }

    /// Returns the relative depth: 0 at the nearest corner, 1 at the farthest.
    pub fn share(&self, view: &View, world: DVec3) -> f64 {
        let [near, far] = self.0;
        if far > near { ((-view.to_eye(world).z - near) / (far - near)).clamp(0.0, 1.0) } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_width_by_hand() {
        let whole = WidthShares { tone: (0.5, 0.0), taper: (0.0, 0.0), scatter: 1.0, depth: (1.0, 0.0) };
        assert_eq!(whole.width(0.5), 0.5);
        assert_eq!(WidthShares { tone: (0.5, 2.0), ..whole }.width(0.5), 0.125);
        let tapered = [0.0, 0.125, 0.25, 0.5, 0.875, 1.0].map(|u| WidthShares { taper: (u, 0.25), ..whole }.width(1.0));
        assert_eq!(tapered, [0.0, 0.5, 1.0, 1.0, 0.5, 0.0]);
        assert_eq!(WidthShares { scatter: 0.75, depth: (0.5, 0.5), ..whole }.width(1.0), 0.5625);
    }

    #[test]
    fn light_and_chance_stay_in_their_ranges() {
        let tones = [-1.0, 0.0, 0.5, 1.0].map(|z| surface_tone(0.25, DVec3::new(0.0, 0.0, z), DVec3::Z));
        assert_eq!(tones, [1.0, 0.75, 0.25, 0.0]);
        let factors = (0..1000).map(|key| scatter(0.5, 1, key << 20));
        let [lo, hi] = factors.fold([2.0, 0.0], |[lo, hi], x| [f64::min(lo, x), f64::max(hi, x)]);
        assert!((0.5..0.51).contains(&lo) && (1.49..=1.5).contains(&hi), "{lo} {hi}");
        assert_eq!(scatter(0.0, 1, 5), 1.0);
    }
}
