//! Encoding of linear premultiplied light as the integers of a PNG ([VAL-3]). Pictures are encoded nowhere else.

use drypoint_scene::color::{Rgba, linear_to_srgb, unpremultiply};

/// Returns a pixel as straight sRGB codes in [0, 1]. Colours are divided by α (α = 0 gives 0) and encoded; α stays
/// linear; all are clamped.
pub fn straight_srgb(pixel: Rgba) -> Rgba {
    let [r, g, b, a] = unpremultiply(pixel);
    [linear_to_srgb(r), linear_to_srgb(g), linear_to_srgb(b), a].map(|c| c.clamp(0.0, 1.0))
}

/// Rounds a code in [0, 1] to the nearest of the integers 0 … `largest`. Ties go to even.
pub fn quantize(code: f64, largest: u16) -> u16 {
    (code * f64::from(largest)).round_ties_even() as u16
}

/// Returns red, green and blue of a linear colour as sRGB bytes.
pub fn srgb_bytes([r, g, b, _]: Rgba) -> [u8; 3] {
    [r, g, b].map(|c| quantize(linear_to_srgb(c).clamp(0.0, 1.0), 255) as u8)
}

/// Returns a linear colour as `#rrggbb`.
pub fn hex(color: Rgba) -> String {
    let [r, g, b] = srgb_bytes(color);
    format!("#{r:02x}{g:02x}{b:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::color::srgb_to_linear;

    fn codes(pixel: Rgba, largest: u16) -> [u16; 4] {
        straight_srgb(pixel).map(|c| quantize(c, largest))
    }

    #[test]
    fn hand_worked_pixels() {
        // Opaque: black, white; 0.2158605 is sRGB 128/255 = 0.50196, which is 32896 of 65535.
        assert_eq!(codes([0.0, 1.0, 0.215_860_500_1, 1.0], 255), [0, 255, 128, 255]);
        assert_eq!(codes([0.0, 1.0, 0.215_860_500_1, 1.0], 65535), [0, 65535, 32896, 65535]);
        // Half covered: straight red is 1, green ½, whose code is 1.055·0.5^(1/2.4) − 0.055 = 0.735357: 187.5, 48192.
        assert_eq!(codes([0.5, 0.25, 0.0, 0.5], 255), [255, 188, 0, 128]);
        assert_eq!(codes([0.5, 0.25, 0.0, 0.5], 65535), [65535, 48192, 0, 32768]);
        // Nothing there: all 0, whatever the colour says.
        assert_eq!(codes([0.3, 0.2, 0.1, 0.0], 255), [0; 4]);
        // The linear foot: 0.001·12.92 = 0.01292, times 255 = 3.29, times 65535 = 846.7.
        assert_eq!(codes([0.001, 0.001, 0.001, 1.0], 255), [3, 3, 3, 255]);
        assert_eq!(codes([0.001, 0.001, 0.001, 1.0], 65535), [847, 847, 847, 65535]);
    }

    #[test]
    fn out_of_gamut_is_clamped() {
        assert_eq!(codes([-0.5, 1.5, 7.0, 1.0], 255), [0, 255, 255, 255]);
        assert_eq!(codes([0.6, 0.0, 0.0, 0.5], 65535), [65535, 0, 0, 32768]);
        assert_eq!(codes([0.0, 0.0, 0.0, 1.25], 255), [0, 0, 0, 255]);
    }

    #[test]
    fn ties_go_to_the_even_number() {
        // ½·255 = 127.5 and ½·65535 = 32767.5, both exact in binary: up to the even 128 and 32768.
        assert_eq!((quantize(0.5, 255), quantize(0.5, 65535)), (128, 32768));
        // ⅒·255 = 25.5 up to 26; 0.3·255 = 76.5 down to 76; 0.7·255 = 178.5 down to 178.
        for (code, times, expected) in [(0.1, 25.5, 26), (0.3, 76.5, 76), (0.7, 178.5, 178), (0.9, 229.5, 230)] {
            assert_eq!(code * 255.0, times, "the product is exact");
            assert_eq!(quantize(code, 255), expected);
        }
    }

    #[test]
    fn every_code_survives_decoding_and_encoding() {
        // The two branches of the standard meet within 1e-7, far below half a step of 16 bits.
        for code in 0..=65535u16 {
            let c = srgb_to_linear(f64::from(code) / 65535.0);
            assert_eq!(codes([c, c, c, 1.0], 65535)[0], code);
        }
    }
}
