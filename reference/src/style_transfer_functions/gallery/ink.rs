//! `ink`: washes of Indian ink on white paper.

use super::light::{KEY, edge, reflected, smoothstep};
use super::paint::Paint;
use crate::number::Vec3;

/// Three washes, each with a soft border that dries a little darker than its inside, and a firm line round it all.
pub(super) fn shade(n: Vec3<f64>) -> (Paint, f64) {
    let lit = n.dot(KEY);
    let mut paint = Paint::hex(0xfefcf8);
    for (at, colour, strength) in [(0.74, 0xd8d2c9, 0.9), (0.36, 0x9c958d, 0.75), (-0.04, 0x3a3531, 0.92)] {
        let wash = smoothstep(at + 0.10, at - 0.10, lit);
        let dry = smoothstep(at - 0.34, at - 0.06, lit);
        paint = paint.over(Paint::hex(colour), wash * strength * (0.86 + 0.14 * dry));
    }
    paint = paint.over(Paint::hex(0x8f8880), 0.6 * reflected(n));
    (paint.over(Paint::hex(0x14100e), edge(n)), 1.0)
}
