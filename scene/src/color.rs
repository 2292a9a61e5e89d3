//! sRGB (IEC 61966-2-1) and linear light ([VAL-3]).

use crate::math;

/// Linear red, green, blue and opacity; straight or premultiplied as the owner says.
pub type Rgba = [f64; 4];

/// Decodes one sRGB channel in [0, 1] to linear light: c/12.92 for c ≤ 0.04045, else ((c + 0.055)/1.055)^2.4.
pub fn srgb_to_linear(c: f64) -> f64 {
    if c <= 0.04045 { c / 12.92 } else { math::pow((c + 0.055) / 1.055, 2.4) }
}

/// Encodes one linear channel to sRGB: 12.92 c for c ≤ 0.0031308, else 1.055 c^(1/2.4) − 0.055.
pub fn linear_to_srgb(c: f64) -> f64 {
    if c <= 0.0031308 { 12.92 * c } else { 1.055 * math::pow(c, 1.0 / 2.4) - 0.055 }
}

/// Straight RGBA times its opacity.
pub fn premultiply([r, g, b, a]: Rgba) -> Rgba {
    [r * a, g * a, b * a, a]
}

/// Premultiplied RGBA divided by its opacity; 0 where the opacity is 0.
pub fn unpremultiply([r, g, b, a]: Rgba) -> Rgba {
    if a == 0.0 { [0.0; 4] } else { [r / a, g / a, b / a, a] }
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

    #[test]
    fn there_and_back() {
        for i in 0..=255 {
            let c = f64::from(i) / 255.0;
            assert!((linear_to_srgb(srgb_to_linear(c)) - c).abs() < 1e-7, "{i}");
        }
    }
}
