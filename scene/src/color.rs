//! sRGB (IEC 61966-2-1) and linear light ([VAL-3]).

use crate::math;

/// Linear red, green, blue and opacity. The owner's documentation says whether they are straight or premultiplied.
pub type Rgba = [f64; 4];

/// Linear red, green and blue.
pub type Rgb = [f64; 3];

/// Decodes one sRGB channel in [0, 1] to linear light: c/12.92 for c ≤ 0.04045, else ((c + 0.055)/1.055)^2.4.
pub fn srgb_to_linear(c: f64) -> f64 {
    if c <= 0.04045 { c / 12.92 } else { math::pow((c + 0.055) / 1.055, 2.4) }
}

/// Encodes one linear channel to sRGB: 12.92 c for c ≤ 0.0031308, else 1.055 c^(1/2.4) − 0.055.
pub fn linear_to_srgb(c: f64) -> f64 {
    if c <= 0.0031308 { 12.92 * c } else { 1.055 * math::pow(c, 1.0 / 2.4) - 0.055 }
}

/// Converts a linear sRGB colour to L, a and b of OKLab (Ottosson 2020), where equal distances look alike.
pub fn linear_to_oklab([r, g, b]: [f64; 3]) -> [f64; 3] {
    let cone = [
        0.412_221_470_8 * r + 0.536_332_536_3 * g + 0.051_445_992_9 * b,
        0.211_903_498_2 * r + 0.680_699_545_1 * g + 0.107_396_956_6 * b,
        0.088_302_461_9 * r + 0.281_718_837_6 * g + 0.629_978_700_5 * b,
    ];
    let [l, m, s] = cone.map(math::cbrt);
    [
        0.210_454_255_3 * l + 0.793_617_785_0 * m - 0.004_072_046_8 * s,
        1.977_998_495_1 * l - 2.428_592_205_0 * m + 0.450_593_709_9 * s,
        0.025_904_037_1 * l + 0.782_771_766_2 * m - 0.808_675_766_0 * s,
    ]
}

/// Straight RGBA times its opacity.
pub fn premultiply([r, g, b, a]: Rgba) -> Rgba {
    [r * a, g * a, b * a, a]
}

/// Premultiplied RGBA divided by its opacity; 0 where the opacity is 0.
pub fn unpremultiply([r, g, b, a]: Rgba) -> Rgba {
    if a == 0.0 { [0.0; 4] } else { [r / a, g / a, b / a, a] }
}

/// The colour of three sRGB bytes: linear, opaque.
pub(crate) fn opaque(bytes: [f64; 3]) -> Rgba {
    let [r, g, b] = bytes.map(|byte| srgb_to_linear(byte / 255.0));
    [r, g, b, 1.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_hand_values() {
        assert_eq!(srgb_to_linear(0.0), 0.0);
        assert!((srgb_to_linear(1.0) - 1.0).abs() < 1e-15);
        // Mid grey 0x80: 0.5019607843 is 0.2158605001 in linear light.
        assert!((srgb_to_linear(128.0 / 255.0) - 0.215_860_500_1).abs() < 1e-9);
        assert!((linear_to_srgb(0.0031308) - 0.040_449_936).abs() < 1e-9);
    }

    /// The published coefficients give white L = 1 and no hue, and red what their author prints.
    #[test]
    fn oklab_hand_values() {
        let near = |rgb, lab: [f64; 3], by: f64| {
            let found = linear_to_oklab(rgb);
            assert!(found.iter().zip(lab).all(|(a, b)| (a - b).abs() < by), "{found:?}");
        };
        near([1.0; 3], [1.0, 0.0, 0.0], 1e-7);
        near([0.125; 3], [0.5, 0.0, 0.0], 1e-7);
        near([1.0, 0.0, 0.0], [0.628, 0.225, 0.126], 5e-4);
    }

    #[test]
    fn there_and_back() {
        for i in 0..=255 {
            let c = f64::from(i) / 255.0;
            assert!((linear_to_srgb(srgb_to_linear(c)) - c).abs() < 1e-7, "{i}");
        }
    }
}
