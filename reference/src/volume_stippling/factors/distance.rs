//! Eq. 8: fewer and smaller points in the far parts of the volume ([STIP-10]).

use drypoint_scene::math::pow;
use drypoint_scene::shot::stipples::Distance;

/// T_d = ½(1 + sign(k)·sign(z)·|z/a|^|k|), k = k_de, in [0, 1]. `z` is the depth from the volume's centre towards the
/// eye over the radius of its bounding sphere. k = 0 turns the factor off; the formula would give one half.
pub(super) fn distance(t: &Distance, z: f64) -> f64 {
    if t.de == 0.0 {
        return 1.0;
    }
    let way = if (t.de < 0.0) == (z < 0.0) { 1.0 } else { -1.0 };
    // A box of voxels at the border may reach beyond the sphere.
    (0.5 * (1.0 + way * pow(z.abs(), t.de.abs()))).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hand_worked() {
        let at = |de: f64, z: f64| distance(&Distance { de }, z);
        assert_eq!([-1.0, -0.5, 0.0, 0.5, 1.0].map(|z| at(2.0, z)), [0.0, 0.375, 0.5, 0.625, 1.0]);
        // Turned round, not divided by zero.
        assert_eq!([-1.0, -0.5, 0.0, 0.5, 1.0].map(|z| at(-2.0, z)), [1.0, 0.625, 0.5, 0.375, 0.0]);
        assert_eq!([-1.0, 0.0, 0.3].map(|z| at(0.0, z)), [1.0; 3]);
        // ½(1 + 0.25^1.5) = 0.5625.
        assert_eq!(at(1.5, 0.25), 0.5625);
        assert_eq!([at(1.0, 1.2), at(1.0, -1.2)], [1.0, 0.0]);
    }
}
