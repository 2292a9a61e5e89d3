//! The colour spaces of FLIP (section 4.1): linear sRGB, YCxCz, L*a*b* with Hunt's adjustment.

use drypoint_scene::math;

/// Rows of linear sRGB to XYZ for the D65 white, as the fractions that the primaries give.
const TO_XYZ: [[f64; 3]; 3] = [
    [10_135_552.0 / 24_577_794.0, 8_788_810.0 / 24_577_794.0, 4_435_075.0 / 24_577_794.0],
    [2_613_072.0 / 12_288_897.0, 8_788_810.0 / 12_288_897.0, 887_015.0 / 12_288_897.0],
    [1_425_312.0 / 73_733_382.0, 8_788_810.0 / 73_733_382.0, 70_074_185.0 / 73_733_382.0],
];

/// XYZ of the D65 white: the row sums of [`TO_XYZ`].
const WHITE: [f64; 3] = [31_271.0 / 32_902.0, 1.0, 35_827.0 / 32_902.0];

/// Relative XYZ (each divided by the white's) to linear sRGB: the exact inverse, rounded once.
const FROM_RELATIVE_XYZ: [[f64; 3]; 3] = [
    [3.080_341_988_280_461, -1.537_398_969_488_785_5, -0.542_943_018_791_675_1],
    [-0.921_178_396_165_123_6, 1.875_929_983_695_176, 0.045_248_412_469_947_58],
    [0.052_881_292_875_543_25, -0.204_011_206_123_909_97, 1.151_129_913_248_366_8],
];

/// The largest argument of the straight part of L*a*b*'s root: δ³, δ = 6/29.
const DELTA: f64 = 6.0 / 29.0;

fn times(matrix: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// Linear sRGB to relative XYZ: each divided by the white's, so that white is (1, 1, 1).
fn linear_to_relative_xyz(rgb: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = times(&TO_XYZ, rgb);
    [x / WHITE[0], y / WHITE[1], z / WHITE[2]]
}

/// Linear sRGB to YCxCz: L*a*b* without the root, so that filters act on light. Y from −16 to 100.
pub(super) fn linear_to_ycxcz(rgb: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = linear_to_relative_xyz(rgb);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// YCxCz to linear sRGB.
pub(super) fn ycxcz_to_linear([luminance, cx, cz]: [f64; 3]) -> [f64; 3] {
    let y = (luminance + 16.0) / 116.0;
    times(&FROM_RELATIVE_XYZ, [y + cx / 500.0, y, y - cz / 200.0])
}

/// Linear sRGB to L*a*b*, with a* and b* multiplied by 0.01 L*. Dark colours look less colourful (Hunt's effect).
pub(super) fn hunt_lab(rgb: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = linear_to_relative_xyz(rgb).map(root);
    let l = 116.0 * y - 16.0;
    [l, 0.01 * l * 500.0 * (x - y), 0.01 * l * 200.0 * (y - z)]
}

/// L*a*b*'s root: ∛t, continued below δ³ by its tangent.
fn root(t: f64) -> f64 {
    if t > DELTA * DELTA * DELTA { math::pow(t, 1.0 / 3.0) } else { t / (3.0 * DELTA * DELTA) + 4.0 / 29.0 }
}

/// HyAB distance |ΔL*| + √(Δa*² + Δb*²), made for large differences.
pub(super) fn lab_distance(p: [f64; 3], q: [f64; 3]) -> f64 {
    let [l, a, b] = [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
    l.abs() + (a * a + b * b).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(found: [f64; 3], expected: [f64; 3], tolerance: f64) {
        for (f, e) in found.into_iter().zip(expected) {
            assert!((f - e).abs() <= tolerance, "{found:?} for {expected:?}");
        }
    }

    #[test]
    fn black_white_and_there_and_back() {
        // Rounding of numbers up to 116.
        near(linear_to_ycxcz([0.0; 3]), [-16.0, 0.0, 0.0], 0.0);
        near(linear_to_ycxcz([1.0; 3]), [100.0, 0.0, 0.0], 1e-12);
        near(hunt_lab([1.0; 3]), [100.0, 0.0, 0.0], 1e-12);
        near(hunt_lab([0.0; 3]), [0.0; 3], 1e-13);
        for rgb in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.2, 0.7, 0.05]] {
            near(ycxcz_to_linear(linear_to_ycxcz(rgb)), rgb, 1e-14);
        }
    }

    #[test]
    fn primaries_in_lab() {
        // Published L*a*b* of the sRGB primaries (D65): red 53.24, 80.09, 67.20; green 87.73, −86.18, 83.18; blue
        // 32.30, 79.19, −107.86, two digits each; chroma is then multiplied by L*/100.
        for (rgb, [l, a, b]) in [
            ([1.0, 0.0, 0.0], [53.24, 80.09, 67.20]),
            ([0.0, 1.0, 0.0], [87.73, -86.18, 83.18]),
            ([0.0, 0.0, 1.0], [32.30, 79.19, -107.86]),
        ] {
            near(hunt_lab(rgb), [l, a * l / 100.0, b * l / 100.0], 0.02);
        }
    }

    #[test]
    fn the_root_is_smooth_where_its_parts_meet() {
        let t = DELTA * DELTA * DELTA;
        assert!((root(t) - DELTA).abs() < 1e-15);
        assert!((root(t * (1.0 + 1e-9)) - root(t)).abs() < 1e-9);
    }

    #[test]
    fn distances_by_hand() {
        assert_eq!(lab_distance([10.0, 3.0, 4.0], [7.0, 0.0, 0.0]), 8.0);
        assert_eq!(lab_distance([1.0, 2.0, 3.0], [1.0, 2.0, 3.0]), 0.0);
    }
}
