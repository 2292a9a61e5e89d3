//! `metal`: turned steel.

use super::light::{KEY, highlight, outline, radius, smoothstep};
use super::paint::{Paint, Ramp};
use crate::number::Vec3;

/// Metal shows its surroundings: a bright sky above, a dark horizon and a warm floor. The reflected ray
/// R = 2N_z N − v is looked up in bands over its height, tilted so that the horizon falls below the middle. Towards the
/// edge all of it pales, as at grazing angles.
pub(super) fn shade(n: Vec3<f64>) -> (Paint, f64) {
    let (rx, ry, rz) = (2.0 * n.z * n.x, 2.0 * n.z * n.y, 2.0 * n.z * n.z - 1.0);
    let height = 0.5 + 0.5 * (0.76 * ry + 0.42 * rz - 0.20 * rx).clamp(-1.0, 1.0);
    let room = Ramp::new(&[
        (0.0, 0x6f6a64),
        (0.14, 0xaaa59c),
        (0.25, 0x8b8884),
        (0.325, 0x45484e),
        (0.39, 0x343941),
        (0.50, 0x68717b),
        (0.66, 0xa3adb6),
        (0.84, 0xdbe1e6),
        (1.0, 0xf6f9fa),
    ]);
    let limb = smoothstep(0.72, 0.93, radius(n));
    let paint = room
        .at(height)
        .over(Paint::hex(0xb4bec8), 0.5 * limb)
        .over(Paint::hex(0xf4f7f9), 0.30 * highlight(n, KEY, 16.0))
        .over(Paint::hex(0xffffff), 0.90 * highlight(n, KEY, 140.0));
    (outline(paint, n, 0x131316, 0x33363c), 1.0)
}
