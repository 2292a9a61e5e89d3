//! Text of SVG files, as elements that viewers search and select.

use super::decimals;
use super::svg::{escaped, opacity, text as write_text};
use crate::encode::hex;
use crate::grid::micrometres;
use crate::text::font::{FONT_FAMILY, extent, printable};
use drypoint_scene::marks::{Layer, Text};

/// Families that a viewer tries in turn. Noto Sans has nearly the letters of Open Sans.
const FALLBACKS: &str = "'Noto Sans', Arial, Helvetica, sans-serif";

/// Writes a layer's text as elements, in order. Lines without a visible size or width are left out.
pub(super) fn write_texts(layer: &Layer, out: &mut Vec<u8>) {
    let mut texts = layer.texts.iter().filter_map(|text| Some((text, lengths(text)?))).peekable();
    if texts.peek().is_none() {
        return;
    }
    let color = hex(layer.pen.color);
    write_text(
        out,
        format_args!("<g fill=\"{color}\" stroke=\"none\" font-family=\"'{FONT_FAMILY}', {FALLBACKS}\">\n"),
    );
    for (text, [size, width]) in texts {
        let [x, y] = text.at.to_array().map(micrometres);
        for (name, value) in [("<text x", x), ("\" y", y), ("\" font-size", size), ("\" textLength", width)] {
            write_text(out, format_args!("{name}=\""));
            decimals::push(out, value);
        }
        let characters = printable(&text.characters);
        // Without this a viewer joins spaces and drops those at the ends.
        let has_odd_spaces = characters.starts_with(' ') || characters.ends_with(' ') || characters.contains("  ");
        let space = if has_odd_spaces { " xml:space=\"preserve\"" } else { "" };
        let faint = opacity("fill-opacity", text.opacity * layer.pen.color[3]);
        let characters = escaped(&characters);
        write_text(out, format_args!("\" lengthAdjust=\"spacingAndGlyphs\"{faint}{space}>{characters}</text>\n"));
    }
    out.extend_from_slice(b"</g>\n");
}

/// Returns the size of a text and its width, in micrometres; none if one of them is not above 0.
fn lengths(text: &Text) -> Option<[i64; 2]> {
    let lengths = [text.size, extent(&text.characters, text.size).advance].map(micrometres);
    lengths.iter().all(|&length| length > 0).then_some(lengths)
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::glam::DVec2;
    use drypoint_scene::marks::Pen;

    fn written(texts: &[(&str, f64, f64)]) -> String {
        let pen = Pen { number: 1, name: "red".into(), width: 0.3, color: [1.0, 0.0, 0.0, 0.5] };
        let text = |&(characters, size, opacity): &(&str, f64, f64)| Text {
            characters: characters.into(),
            at: DVec2::new(1.5, 20.25),
            size,
            opacity,
        };
        let mut out = Vec::new();
        write_texts(&Layer { texts: texts.iter().map(text).collect(), ..Layer::new(pen) }, &mut out);
        String::from_utf8(out).unwrap()
    }

    /// A unit is 0.002 mm. Widths are l 518, space 532, < 1171, & 1495 units.
    #[test]
    fn text_has_its_place_and_width() {
        assert_eq!(
            written(&[("l", 4.096, 1.0), (" l  <&", 4.096, 0.5)]),
            "<g fill=\"#ff0000\" stroke=\"none\" font-family=\"'Open Sans', 'Noto Sans', Arial, Helvetica, sans-serif\">\n\
             <text x=\"1.5\" y=\"20.25\" font-size=\"4.096\" textLength=\"1.036\" lengthAdjust=\"spacingAndGlyphs\" \
             fill-opacity=\"0.5\">l</text>\n\
             <text x=\"1.5\" y=\"20.25\" font-size=\"4.096\" textLength=\"9.56\" lengthAdjust=\"spacingAndGlyphs\" \
             fill-opacity=\"0.25\" xml:space=\"preserve\"> l  &lt;&amp;</text>\n\
             </g>\n"
        );
    }

    #[test]
    fn text_that_cannot_be_seen_is_not_written() {
        assert_eq!(written(&[]), "");
        assert_eq!(written(&[("", 4.0, 1.0), ("a", 0.0, 1.0), ("a", 0.0001, 1.0)]), "");
        assert!(written(&[("a\tb\u{1}", 4.0, 1.0)]).contains(">a b </text>"));
    }
}
