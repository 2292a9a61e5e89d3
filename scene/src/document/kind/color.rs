//! Colours: sRGB in the file, linear in the scene ([SCN-2], [VAL-3]).

use crate::color::{linear_to_srgb, srgb_to_linear};
use crate::document::check::Check;
use crate::document::css::{CSS_COLORS, css_color};
use crate::document::describe::{Kind, Shape};
use crate::document::item::Item;
use crate::document::out::Out;
use crate::nearest::nearest;
use serde_json::{Value as Json, json};

/// A colour: linear, straight red, green, blue and opacity.
pub(crate) struct Colors;

/// Reads `#rgb`, `#rrggbb`, `#rrggbbaa` or the name of a CSS colour. A channel is a byte over 255, decoded from sRGB;
/// the opacity is never decoded.
pub(crate) fn parse_color(text: &str) -> Option<[f64; 4]> {
    let bytes = match text.strip_prefix('#') {
        Some(digits) => hex(digits)?,
        None => {
            let [r, g, b] = css_color(text)?;
            [r, g, b, 255]
        }
    };
    let [r, g, b, a] = bytes.map(|byte| f64::from(byte) / 255.0);
    Some([srgb_to_linear(r), srgb_to_linear(g), srgb_to_linear(b), a])
}

fn hex(digits: &str) -> Option<[u8; 4]> {
    let digits: Vec<u8> = digits.chars().map(|c| c.to_digit(16).map(|d| d as u8)).collect::<Option<_>>()?;
    match digits[..] {
        [r, g, b] => Some([r * 17, g * 17, b * 17, 255]),
        [r1, r0, g1, g0, b1, b0] => Some([r1 * 16 + r0, g1 * 16 + g0, b1 * 16 + b0, 255]),
        [r1, r0, g1, g0, b1, b0, a1, a0] => Some([r1 * 16 + r0, g1 * 16 + g0, b1 * 16 + b0, a1 * 16 + a0]),
        _ => None,
    }
}

/// The nearest colour that a scene file can say, as `#rrggbb`, or `#rrggbbaa` if it is not opaque. A colour from
/// [`parse_color`] has a text that gives the same numbers again.
pub(crate) fn format_color([r, g, b, a]: [f64; 4]) -> String {
    let byte = |x: f64| (x.clamp(0.0, 1.0) * 255.0).round_ties_even() as u8;
    let [red, green, blue] = [r, g, b].map(|c| byte(linear_to_srgb(c)));
    match byte(a) {
        255 => format!("#{red:02x}{green:02x}{blue:02x}"),
        alpha => format!("#{red:02x}{green:02x}{blue:02x}{alpha:02x}"),
    }
}

/// The CSS colour that a misspelt name probably meant.
pub(crate) fn nearest_color(name: &str) -> Option<String> {
    nearest(name, CSS_COLORS.iter().map(|(name, _)| *name)).map(Into::into)
}

impl Shape for Colors {
    fn expected(&self) -> String {
        "a colour: \"#rrggbb\", \"#rrggbbaa\" or a CSS name such as \"white\"".into()
    }

    fn schema(&self) -> Json {
        let names: Vec<&str> = CSS_COLORS.iter().map(|(name, _)| *name).collect();
        let digits = json!({ "type": "string", "pattern": "^#([0-9a-fA-F]{3}|[0-9a-fA-F]{6}|[0-9a-fA-F]{8})$" });
        json!({ "anyOf": [digits, { "enum": names }] })
    }
}

impl Kind for Colors {
    type Of = [f64; 4];

    fn read(&self, item: &Item, check: &mut Check) -> Option<[f64; 4]> {
        match item.text() {
            Some(text) => parse_color(text).or_else(|| check.wrong_name(item, self.expected(), nearest_color(text))),
            None => check.wrong(item, self.expected()),
        }
    }

    fn write(&self, value: &[f64; 4]) -> Out {
        Out::Text(format_color(*value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_notations_of_one_colour() {
        let red = [1.0, 0.0, 0.0, 1.0];
        for text in ["#f00", "#FF0000", "#ff0000ff", "red", "Red"] {
            assert_eq!(parse_color(text), Some(red), "{text}");
        }
        // 0x80/255 decoded is 0.2158605001; the opacity 0x33 is 51/255 = 1/5 as it is.
        let [grey, _, _, a] = parse_color("#80808033").unwrap();
        assert!((grey - 0.215_860_500_1).abs() < 1e-10);
        assert_eq!(a, 0.2);
    }

    #[test]
    fn what_is_no_colour() {
        for text in ["", "#", "#ff", "#ffff", "#ggg", "#fffff", "#ff00000", "rot", " red", "#+f00000"] {
            assert_eq!(parse_color(text), None, "{text}");
        }
        assert_eq!(nearest_color("gren"), Some("green".into()));
    }

    #[test]
    fn every_byte_comes_back_to_the_same_number() {
        for byte in 0..=255u8 {
            let text = format!("#{byte:02x}00ff{byte:02x}");
            let color = parse_color(&text).unwrap();
            assert_eq!(parse_color(&format_color(color)), Some(color));
        }
    }
}
