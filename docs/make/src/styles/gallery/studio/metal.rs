//! Metals: all that is seen of them is the room.

use super::super::light::{KEY, mirrored, smoothstep};
use super::super::noise::{Draw, fractal};
use super::super::paint::{Linear, Paint, linear};
use super::super::room::{exposed, flagged, room};
use drypoint_reference::number::Vec3;

/// What chrome shows of the room beyond its lights: a bright wall above, a hard dark horizon, a floor.
fn stage(r: Vec3<f64>, blur: f64) -> Linear {
    let height = r.y + 0.18 * r.x;
    let wall = smoothstep(-0.15 - 0.5 * blur, -0.11 + 0.5 * blur, height);
    let sky = smoothstep(-0.25, 0.85, height);
    let floor = smoothstep(-0.16, -0.85, height);
    let lights = room(r, blur);
    let tone = wall * (0.06 + 0.50 * sky) + (1.0 - wall) * (0.006 + 0.30 * floor);
    std::array::from_fn(|c| 0.30 * lights[c] + tone * [0.93, 0.98, 1.08][c])
}

/// Mirror-bright chrome.
pub(super) fn metal(n: Vec3<f64>) -> (Paint, f64) {
    let seen = stage(mirrored(n), 0.03);
    (flagged(exposed(seen.map(|c| 0.95 * c)), n, 0x0b0d10), 1.0)
}

/// Brushed copper: scratches along one direction smear every light across it.
pub(super) fn copper(n: Vec3<f64>) -> (Paint, f64) {
    let own = linear(0xe8946a);
    let mut sum = [0.0; 3];
    const PARTS: i32 = 9;
    for part in 0..PARTS {
        // The normals of a scratch's walls lean to both sides of it.
        let lean = f64::from(2 * part + 1 - PARTS) / f64::from(PARTS);
        let leaned = Vec3::new(n.x + 0.20 * lean, n.y + 0.05 * lean, n.z);
        let leaned = leaned * (1.0 / leaned.length());
        let seen = stage(mirrored(leaned), 0.14);
        for c in 0..3 {
            sum[c] += seen[c] / f64::from(PARTS);
        }
    }
    let scratches = 1.0 + 0.10 * fractal(3.0 * n.x, 44.0 * (n.y - 0.2 * n.x), 2, Draw::Fibre);
    let grazing = 1.0 - n.z;
    let light =
        std::array::from_fn(|c| sum[c] * scratches * (own[c] + (1.0 - own[c]) * grazing * grazing * grazing * 0.4));
    (flagged(exposed(light), n, 0x210a05), 1.0)
}

/// Machined aluminium: fine grooves around the axis that the tool turned on, which catch the light in two fans.
pub(super) fn engraving(n: Vec3<f64>) -> (Paint, f64) {
    let away = (n.x * n.x + n.y * n.y).sqrt();
    let grooves = 1.0 + 0.11 * fractal(40.0 * away, 0.7, 2, Draw::Fibre);
    let fan = if away > 0.0 { (n.x * KEY.x + n.y * KEY.y) / (away * 0.8) } else { 0.0 };
    let fans = smoothstep(0.45, 1.0, fan.abs()) * smoothstep(0.05, 0.5, away);
    let seen = stage(mirrored(n), 0.5);
    let light = std::array::from_fn(|c| grooves * (0.50 * seen[c] + (0.50 + 0.5 * fan.max(0.0)) * fans * 0.9 + 0.12));
    (flagged(exposed(light), n, 0x101216), 1.0)
}
