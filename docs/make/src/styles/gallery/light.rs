//! Terms of light on a sphere that the styles are put together from.
//!
//! N is the unit normal with N_z ≥ 0, x to the right, y up, the eye at +z.

use super::paint::Paint;
use drypoint::scene::math;
use drypoint_reference::number::Vec3;

/// Towards the key light: from the upper left and in front, as plates in books are lit.
pub(super) const KEY: Vec3<f64> = Vec3 { x: -0.48, y: 0.64, z: 0.6 };

/// Towards the light that comes back from the page, at the lower right and somewhat behind.
pub(super) const BOUNCE: Vec3<f64> = Vec3 { x: 0.64, y: -0.6, z: -0.48 };

/// clamp₀₁((N·L + w)/(1 + w)): Lambert's cosine, wrapped round the sphere by w as in translucent matter.
pub(super) fn wrapped(n: Vec3<f64>, light: Vec3<f64>, w: f64) -> f64 {
    ((n.dot(light) + w) / (1.0 + w)).clamp(0.0, 1.0)
}

/// Blinn's highlight max(0, N·Ĥ)^s.
pub(super) fn highlight(n: Vec3<f64>, light: Vec3<f64>, s: f64) -> f64 {
    let h = light + Vec3::new(0.0, 0.0, 1.0);
    math::pow((n.dot(h) / h.length()).max(0.0), s)
}

/// A highlight as one stroke of the brush, an ellipse bent round the middle at that radius: half its width, half its
/// length in radians, and the share of both in which it fades.
pub(super) fn dab(n: Vec3<f64>, at: f64, across: f64, along: f64, soft: f64) -> f64 {
    let turn = math::atan2(n.y * KEY.x - n.x * KEY.y, n.x * KEY.x + n.y * KEY.y);
    let (u, v) = ((radius(n) - at) / across, turn / along);
    smoothstep(1.0 + soft, 1.0 - soft, (u * u + v * v).sqrt())
}

/// t²(3 − 2t) of t = clamp₀₁((x − lo)/(hi − lo)); from 1 to 0 where hi < lo.
pub(super) fn smoothstep(lo: f64, hi: f64, x: f64) -> f64 {
    let t = ((x - lo) / (hi - lo)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// How dark a draughtsman sees a place, in [0, 1]: the shade of a cosine wrapped by w, less the share `lift` of what the
/// page's light takes from it.
pub(super) fn darkness(n: Vec3<f64>, w: f64, lift: f64) -> f64 {
    ((1.0 - wrapped(n, KEY, w)) * (1.0 - lift * reflected(n))).clamp(0.0, 1.0)
}

/// The mirrored direction of the eye, R = 2N_z N − v.
pub(super) fn mirrored(n: Vec3<f64>) -> Vec3<f64> {
    Vec3::new(2.0 * n.z * n.x, 2.0 * n.z * n.y, 2.0 * n.z * n.z - 1.0)
}

/// How high the mirrored direction points, about [−1, 1], in a room that is tilted so that its horizon falls below the
/// middle of the sphere and runs down to the right.
pub(super) fn mirrored_height(n: Vec3<f64>) -> f64 {
    let r = mirrored(n);
    0.76 * r.y + 0.42 * r.z - 0.20 * r.x
}

/// Light that comes back from the page into the shadow's edge.
pub(super) fn reflected(n: Vec3<f64>) -> f64 {
    smoothstep(0.10, 0.84, n.dot(BOUNCE))
}

/// The distance from the middle of the sphere's picture, 1 on the circumference.
pub(super) fn radius(n: Vec3<f64>) -> f64 {
    (n.x * n.x + n.y * n.y).sqrt()
}

/// How much of the contour's colour a place takes: 1 from just inside the circumference on. The line is weighted as
/// draughtsmen weight it, heavier in the shade than in the light.
pub(super) fn edge(n: Vec3<f64>) -> f64 {
    let shade = smoothstep(0.8, -0.6, n.dot(KEY));
    smoothstep(0.948 - 0.030 * shade, 0.985, radius(n))
}

/// The contour's colour laid over `paint`: `dark`, and up to `lit` where the key light falls. Style contours are pushed
/// to the circumference, so this ring is what they are drawn with.
pub(super) fn outline(paint: Paint, n: Vec3<f64>, dark: u32, lit: u32) -> Paint {
    let line = Paint::hex(dark).over(Paint::hex(lit), smoothstep(-0.2, 0.9, n.dot(KEY)));
    paint.over(line, edge(n))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lights_are_directions() {
        for light in [KEY, BOUNCE] {
            assert!((light.length() - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn by_hand() {
        let front = Vec3::new(0.0, 0.0, 1.0);
        // (0.6 + 0.5)/1.5; a highlight is 1 halfway between light and eye.
        assert!((wrapped(front, Vec3::new(0.8, 0.0, 0.6), 0.5) - 1.1 / 1.5).abs() < 1e-15);
        assert_eq!(wrapped(front, Vec3::new(0.0, 0.0, -1.0), 0.5), 0.0);
        let side = Vec3::new(1.0, 0.0, 0.0);
        let half = Vec3::new(0.5f64.sqrt(), 0.0, 0.5f64.sqrt());
        assert!((highlight(half, side, 100.0) - 1.0).abs() < 1e-13);
        // cos⁴ 45° = ¼.
        assert!((highlight(front, side, 4.0) - 0.25).abs() < 1e-15);
        assert_eq!([0.0, 0.5, 1.0].map(|x| smoothstep(0.0, 1.0, x)), [0.0, 0.5, 1.0]);
        assert_eq!([0.0, 0.5, 1.0].map(|x| smoothstep(1.0, 0.0, x)), [1.0, 0.5, 0.0]);
        assert_eq!((edge(front), edge(side)), (0.0, 1.0));
    }

    #[test]
    fn mirrors_turn_the_eyes_ray_about_the_normal() {
        let n = Vec3::new(0.48, -0.6, 0.64);
        let r = mirrored(n);
        // The same angle on the other side, at length 1; the eye itself in the middle.
        assert!((r.length() - 1.0).abs() < 1e-15 && (r.dot(n) - n.z).abs() < 1e-15);
        assert_eq!(mirrored(Vec3::new(0.0, 0.0, 1.0)), Vec3::new(0.0, 0.0, 1.0));
        assert!((mirrored_height(Vec3::new(0.0, 0.0, 1.0)) - 0.42).abs() < 1e-15);
    }

    #[test]
    fn the_dark_lies_away_from_the_light() {
        assert_eq!((darkness(KEY, 0.3, 0.4), darkness(KEY * -1.0, 0.3, 0.0)), (0.0, 1.0));
        // Bounced light lifts it where it falls, and nowhere else.
        let shade = Vec3::new(0.48, -0.64, 0.6);
        assert!(darkness(shade, 0.3, 0.4) < darkness(shade, 0.3, 0.0));
        assert_eq!(darkness(Vec3::new(0.0, 0.0, 1.0), 0.3, 0.4), darkness(Vec3::new(0.0, 0.0, 1.0), 0.3, 0.0));
    }

    #[test]
    fn a_dab_lies_towards_the_light() {
        // KEY's direction in the picture is (−0.6, 0.8); the dab's middle is 0.66 from the sphere's.
        let at = |x: f64, y: f64| dab(Vec3::new(x, y, (1.0 - x * x - y * y).sqrt()), 0.66, 0.1, 0.4, 0.2);
        assert_eq!((at(-0.396, 0.528), at(0.396, -0.528), at(0.0, 0.0)), (1.0, 0.0, 0.0));
        // As far to one side as to the other: 0.2 radians each.
        let beside = |turn: f64| {
            let (s, c) = turn.sin_cos();
            at(0.66 * (-0.6 * c - 0.8 * s), 0.66 * (0.8 * c - 0.6 * s))
        };
        assert!((beside(0.2) - beside(-0.2)).abs() < 1e-12 && beside(0.5) == 0.0);
    }
}
