//! Ways of drawing, as a photographer has them: gels, hard light, prints and films.

use super::super::light::{BOUNCE, KEY, dab, edge, mirrored, outline, radius, smoothstep, wrapped};
use super::super::noise::{Draw, fractal};
use super::super::paint::{Paint, Ramp, linear};
use super::super::room::{diffuse, exposed, flagged, fresnel, lamps, room};
use drypoint::scene::math;
use drypoint_reference::number::Vec3;

/// A white ball between two gels: amber from the key, blue from the other side.
pub(super) fn tone(n: Vec3<f64>) -> (Paint, f64) {
    let warm = wrapped(n, KEY, 0.35);
    let cool = wrapped(n, Vec3::new(0.60, -0.64, 0.48), 0.30);
    let rose = wrapped(n, Vec3::new(0.0, 0.0, 1.0), 0.2);
    let [a, b, c] = [linear(0xffb066), linear(0x3a6cff), linear(0xd06a9a)];
    let coat = fresnel(n, 0.035).min(0.4);
    let seen = room(mirrored(n), 0.12);
    let light = std::array::from_fn(|k| {
        0.95 * warm * warm * a[k] + 0.62 * cool * cool * b[k] + 0.10 * rose * c[k] + 0.8 * coat * seen[k]
    });
    (flagged(exposed(light), n, 0x14102c), 1.0)
}

/// A silver print: hard light from the upper left, deep blacks, the grain of the film.
pub(super) fn ink(n: Vec3<f64>) -> (Paint, f64) {
    let lit = diffuse(n, [0.02; 3])[1];
    let grain = 1.0 + 0.05 * fractal(30.0 * n.x, 30.0 * n.y, 2, Draw::Tooth);
    let print = smoothstep(-0.05, 1.15, lit * grain);
    let paint = Ramp::new(&[(0.0, 0x0d0d0e), (0.3, 0x4c4c4d), (0.65, 0xc2c1bf), (1.0, 0xfcfbf8)]).at(print);
    (paint.over(Paint::hex(0x050506), edge(n)), 1.0)
}

/// A vinyl toy: three flat tones and the soft box as a stroke of light.
pub(super) fn cartoon(n: Vec3<f64>) -> (Paint, f64) {
    let lit = n.dot(KEY);
    let border = |at: f64| smoothstep(at - 0.022, at + 0.022, lit);
    let paint = Paint::hex(0x3b2f7a)
        .over(Paint::hex(0x6f63c6), border(-0.05))
        .over(Paint::hex(0xa9a4ee), border(0.50))
        .over(Paint::hex(0xffffff), dab(n, 0.62, 0.085, 0.34, 0.14));
    (outline(paint, n, 0x17113d, 0x17113d), 1.0)
}

/// Cut paper: coral and its shadow.
pub(super) fn cartoon_2(n: Vec3<f64>) -> (Paint, f64) {
    let paint = Paint::hex(0x8c2f4f).over(Paint::hex(0xff8f78), smoothstep(0.128, 0.172, n.dot(KEY)));
    (outline(paint, n, 0x2b0a1e, 0x2b0a1e), 1.0)
}

/// A flat grey, the photographer's card.
pub(super) fn constant(_: Vec3<f64>) -> (Paint, f64) {
    (Paint::hex(0xb8b8b8), 1.0)
}

/// Frosted gelatine lit from behind and from the side.
pub(super) fn watercolour(n: Vec3<f64>) -> (Paint, f64) {
    let through = linear(0x35b5c4);
    let way = n.z;
    let lit = diffuse(n, [0.75, 0.8, 0.85]);
    let back = wrapped(n, BOUNCE, 0.7);
    let seen = room(mirrored(n), 0.10);
    let coat = fresnel(n, 0.04).min(0.4);
    let light = std::array::from_fn(|c| {
        let tint = math::exp((0.35 + 0.9 * way) * math::ln(through[c]));
        (1.0 - coat) * tint * (0.75 * lit[c] + 0.75 * back) + coat * seen[c]
    });
    (flagged(exposed(light), n, 0x06303a), 1.0)
}

/// A radiograph on a light box: steel blue film, denser with the way through the shell.
pub(super) fn xray(n: Vec3<f64>) -> (Paint, f64) {
    let way = 1.0 - n.z;
    let body = Ramp::new(&[(0.0, 0x9fd0cf), (0.3, 0x4f9aa3), (0.7, 0x1b525f), (1.0, 0x072028)]);
    let alpha = 0.03 + 0.97 * smoothstep(0.0, 1.0, way * (0.50 + 0.50 * way));
    let paint = outline(body.at(way), n, 0x04161c, 0x0b2a33);
    (paint, alpha + (1.0 - alpha) * smoothstep(0.93, 0.985, radius(n)))
}

/// Clear crystal: the room mirrored on its front, upside down and dim through its body, black flags at its edge.
pub(super) fn glass(n: Vec3<f64>) -> (Paint, f64) {
    let coat = fresnel(n, 0.06).min(0.6);
    let front = lamps(mirrored(n), 0.02);
    let through = room(Vec3::new(-n.x * 0.9, -n.y * 0.9, (1.0 - 0.81 * (n.x * n.x + n.y * n.y)).sqrt()), 0.35);
    let tint = linear(0x8fb4c4);
    let shine = (coat * front[1] * 1.4).min(1.0);
    let shell = 0.05 + 0.88 * math::pow(1.0 - n.z, 1.1);
    let alpha = shine + (1.0 - shine) * shell;
    let body = exposed(std::array::from_fn(|c| tint[c] * (0.30 + 0.55 * through[c])));
    let paint = body.over(Paint::hex(0xffffff), shine / alpha);
    (flagged(paint, n, 0x0a151c), alpha + (1.0 - alpha) * edge(n))
}
