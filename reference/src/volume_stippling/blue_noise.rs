//! The mask by which whole points are spread over voxels ([STIP-5], `ink = "opaque"`).
use std::sync::LazyLock;
const SIDE: usize = 32;
static T: LazyLock<Vec<u16>> = LazyLock::new(|| (0..32768).map(|i: u32| (i.wrapping_mul(20011) % 32768) as u16).collect());
pub(super) fn at(c: [u32; 3]) -> f64 {
    let [x, y, z] = c.map(|i| i as usize % SIDE);
    (f64::from(T[(z * SIDE + y) * SIDE + x]) + 0.5) / 32768.0
}
