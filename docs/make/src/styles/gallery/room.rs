//! A photographer's room: what polished things reflect, and how light falls on dull ones.
//!
//! A large soft box at the upper left, a strip light behind at the right, a card below that throws light back, a pale
//! room all around, and black flags just outside the picture, whose reflections draw a dark edge around glossy things.

use super::light::{KEY, edge, radius, smoothstep};
use super::paint::{Linear, Paint};
use drypoint::scene::math;
use drypoint_reference::number::Vec3;

/// A rectangular light with soft sides.
struct Panel {
    /// Towards its middle, of length 1.
    middle: Vec3<f64>,
    /// Half its width and height, as tangents.
    half: [f64; 2],
    /// How far its sides fade, as a tangent.
    soft: [f64; 2],
    light: Linear,
}

const SOFT_BOX: Panel = Panel {
    middle: Vec3 { x: -0.57, y: 0.63, z: 0.5276 },
    half: [0.40, 0.40],
    soft: [0.03, 0.03],
    light: [13.0, 12.6, 11.8],
};
const STRIP: Panel = Panel {
    middle: Vec3 { x: 0.93, y: 0.18, z: -0.3207 },
    half: [0.20, 1.1],
    soft: [0.06, 0.7],
    light: [2.6, 2.9, 3.3],
};
const CARD: Panel = Panel {
    middle: Vec3 { x: 0.34, y: -0.86, z: 0.3805 },
    half: [0.45, 0.25],
    soft: [0.6, 0.35],
    light: [1.5, 1.35, 1.2],
};

impl Panel {
    /// How much of a bundle of rays around `r`, `blur` wide as a tangent, falls on the light.
    fn seen(&self, r: Vec3<f64>, blur: f64) -> f64 {
        let ahead = r.dot(self.middle);
        if ahead <= 0.05 {
            return 0.0;
        }
        let right = Vec3::new(self.middle.z, 0.0, -self.middle.x);
        let right = right * (1.0 / right.length());
        let up = self.middle.cross(right);
        let across = |axis: Vec3<f64>, k: usize| {
            let at = (r.dot(axis) / ahead).abs();
            let soft = self.soft[k] + blur;
            // A bundle wider than the light is never filled by it.
            smoothstep(self.half[k] + soft, self.half[k] - soft, at) * (self.half[k] / soft).min(1.0)
        };
        across(right, 0) * across(up, 1)
    }
}

/// The lamps' light from the direction `r`, seen through a surface that spreads it by `blur`.
pub(super) fn lamps(r: Vec3<f64>, blur: f64) -> Linear {
    let lights = [&SOFT_BOX, &STRIP, &CARD].map(|light| (light.seen(r, blur), light.light));
    std::array::from_fn(|c| lights.iter().map(|(seen, light)| seen * light[c]).sum::<f64>())
}

/// All light from the direction `r`: the lamps', and the pale walls'.
pub(super) fn room(r: Vec3<f64>, blur: f64) -> Linear {
    let sky = smoothstep(-0.25 - blur, 0.75 + blur, r.y);
    let walls: Linear = [0.05 + 0.40 * sky, 0.055 + 0.41 * sky, 0.065 + 0.44 * sky];
    let lamps = lamps(r, blur);
    std::array::from_fn(|c| walls[c] + lamps[c])
}

/// Schlick's approximation of Fresnel's reflectance: f₀ head on, 1 at grazing angles.
pub(super) fn fresnel(n: Vec3<f64>, f0: f64) -> f64 {
    f0 + (1.0 - f0) * math::pow(1.0 - n.z, 5.0)
}

/// Light on a dull surface. Light that enters and wanders before it leaves wraps round by `scatter`, per channel, as
/// in skin, wax and jade, where red goes farthest.
pub(super) fn diffuse(n: Vec3<f64>, scatter: Linear) -> Linear {
    let key = n.dot(KEY);
    let strip = smoothstep(0.2, 1.0, n.dot(STRIP.middle));
    let card = (0.5 + 0.5 * n.dot(CARD.middle)).max(0.0);
    std::array::from_fn(|c| {
        let w = scatter[c];
        let wrapped = ((key + w) / (1.0 + w)).max(0.0);
        // The share that wraps counts squared: its tail is long and thin.
        let lit = wrapped * ((1.0 - w) + w * wrapped);
        1.10 * lit + 0.055 * strip * STRIP.light[c] + 0.055 * card * card * CARD.light[c] + 0.022 + 0.016 * n.y
    })
}

/// Exposure: light as film records it, with a shoulder instead of a clip.
pub(super) fn exposed(light: Linear) -> Paint {
    Paint::linear(light.map(|c| 1.0 - math::exp(-2.1 * c.max(0.0))))
}

/// The black flags' reflection: `paint` turns to the dark of its own colour at the edge, in the shade sooner.
pub(super) fn flagged(paint: Paint, n: Vec3<f64>, dark: u32) -> Paint {
    let dim = 0.40 * smoothstep(0.76, 0.97, radius(n)) * smoothstep(0.9, -0.3, n.dot(KEY));
    paint.over(Paint::hex(dark), dim).over(Paint::hex(dark), edge(n))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lamps_are_seen_where_they_stand() {
        for lamp in [SOFT_BOX, STRIP, CARD] {
            assert!((lamp.middle.length() - 1.0).abs() < 1e-4);
            assert_eq!(lamp.seen(lamp.middle * -1.0, 0.1), 0.0);
            // Dimmer where it is smeared, and brightest in its middle.
            assert!(lamp.seen(lamp.middle, 0.5) < lamp.seen(lamp.middle, 0.0));
            let beside = lamp.middle + Vec3::new(0.1, 0.2, 0.1);
            assert!(lamp.seen(beside * (1.0 / beside.length()), 0.1) <= lamp.seen(lamp.middle, 0.1));
        }
        assert_eq!(SOFT_BOX.seen(SOFT_BOX.middle, 0.0), 1.0);
    }

    #[test]
    fn a_smeared_lamp_gives_no_more_light() {
        // Over the tangent plane, along one axis: the integral of the profile is the lamp's width, 2·half, as long as
        // the blur is narrower than the lamp.
        let profile = |blur: f64| {
            let right = Vec3::new(SOFT_BOX.middle.z, 0.0, -SOFT_BOX.middle.x);
            let right = right * (1.0 / right.length());
            (-2000..2000)
                .map(|k| SOFT_BOX.seen(SOFT_BOX.middle + right * (f64::from(k) * 1e-3), blur) * 1e-3)
                .sum::<f64>()
        };
        assert!((profile(0.0) - 0.8).abs() < 2e-3 && (profile(0.3) - 0.8).abs() < 2e-3);
    }

    #[test]
    fn fresnel_and_exposure_keep_their_ends() {
        let (front, side) = (Vec3::new(0.0, 0.0, 1.0), Vec3::new(1.0, 0.0, 0.0));
        assert_eq!((fresnel(front, 0.04), fresnel(side, 0.04)), (0.04, 1.0));
        assert_eq!(exposed([0.0; 3]), Paint::hex(0x000000));
        // However bright, never past white: 1 − e^(−2.1·20) is 1 to 18 digits.
        assert_eq!(exposed([20.0; 3]), Paint::hex(0xffffff));
    }

    #[test]
    fn what_scatters_has_the_softer_shadow() {
        // On the shadow line, N·L = 0, dull matter has only the room's light and wax some of the lamp's.
        let n = Vec3::new(0.8, 0.6, 0.0);
        let [dull, wax] = [[0.0; 3], [0.6; 3]].map(|scatter| diffuse(n, scatter)[0]);
        assert!(wax > dull + 0.1 && diffuse(KEY, [0.0; 3])[0] > 1.0);
    }
}
