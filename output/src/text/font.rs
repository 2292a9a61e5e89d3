//! Lines of text in the bundled font, Open Sans Regular (Apache License 2.0): shaping, extents and outlines.
//!
//! A line is shaped as one run. Its direction is that of the first script in it. A line that mixes left-to-right and
//! right-to-left scripts keeps the order of that one direction, because the bidirectional algorithm is not applied.
//! Control characters, such as tabs and line breaks, are drawn as spaces.

use super::contour::{Contour, ContourPen};
use drypoint_scene::glam::DVec2;
use drypoint_scene::marks::Text;
use harfrust::font::glyph::outline::{DrawMemory, DrawOptions, PathSink};
use harfrust::{Buffer, Font, GlyphId, ShapeOptions, ShaperFont};
use std::borrow::Cow;
use std::sync::OnceLock;

/// The bytes of the font's file.
pub(crate) const FONT_FILE: &[u8] = include_bytes!("../../fonts/OpenSans-Regular.ttf");

/// Name of the font's family.
pub const FONT_FAMILY: &str = "Open Sans";

/// The glyph that stands for characters that the font lacks, an empty box.
pub(crate) const MISSING_GLYPH: u16 = 0;

/// The extent of a line of text, in the unit of its size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextExtent {
    /// Distance from the start of the baseline to its end.
    pub advance: f64,
    /// Height of the font's line above the baseline. Accented capitals fit.
    pub ascent: f64,
    /// Depth of the font's line below the baseline, positive.
    pub descent: f64,
}

/// Measures of the whole font, in font units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FontMetrics {
    /// Font units of an em.
    pub(crate) em: f64,
    /// Height of a line above the baseline.
    pub(crate) ascent: f64,
    /// Depth of a line below the baseline, positive.
    pub(crate) descent: f64,
    /// Height of capitals.
    pub(crate) cap_height: f64,
    /// Least and largest x and y of all glyphs, y up.
    pub(crate) bounds: [f64; 4],
}

/// A glyph of a shaped line.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PlacedGlyph {
    /// Number of the glyph in the font.
    pub(crate) id: u16,
    /// Origin of the glyph in font units, y up, from the start of the baseline.
    pub(crate) at: [i64; 2],
    /// Characters that the glyph shows. The first glyph of several that show the same characters has them.
    pub(crate) characters: String,
}

/// A shaped line of text.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ShapedLine {
    /// Glyphs from left to right.
    pub(crate) glyphs: Vec<PlacedGlyph>,
    /// Distance from the start of the baseline to its end, in font units.
    pub(crate) advance: i64,
}

/// Returns the extent of a line of text whose em has that size. An extent of size 1 is in ems.
pub fn extent(characters: &str, size: f64) -> TextExtent {
    let metrics = metrics();
    let scale = size / metrics.em;
    let advance = scale * shaped(characters).advance as f64;
    TextExtent { advance, ascent: scale * metrics.ascent, descent: scale * metrics.descent }
}

/// Returns the height of capitals of text whose em has that size.
pub fn cap_height(size: f64) -> f64 {
    let metrics = metrics();
    size / metrics.em * metrics.cap_height
}

/// Returns the characters that the font lacks, each once, in their order. Text shows an empty box in their place.
pub fn missing_characters(characters: &str) -> Vec<char> {
    let Some(font) = font() else { return Vec::new() };
    let mut missing = Vec::new();
    let line = shaped(characters);
    let boxes = line.glyphs.iter().filter(|glyph| glyph.id == MISSING_GLYPH);
    for character in boxes.flat_map(|glyph| glyph.characters.chars()) {
        if font.charmap().map_unicode(character).is_none() && !missing.contains(&character) {
            missing.push(character);
        }
    }
    // The boxes stand from left to right, also in a line that runs from right to left.
    missing.sort_by_key(|&character| characters.find(character));
    missing
}

/// Returns the parts of a text that a line break does not divide, in their order: a character with its marks, or a
/// ligature.
pub(crate) fn clusters(characters: &str) -> Vec<String> {
    let own = shaped(characters).glyphs.into_iter().map(|glyph| glyph.characters);
    let mut parts: Vec<String> = own.filter(|own| !own.is_empty()).collect();
    // Glyphs stand from left to right, also in a line that runs from right to left.
    if parts.concat() != printable(characters) {
        parts.reverse();
    }
    parts
}

/// Returns the outlines of a line of text as closed polygons, in mm on the page, y down. They are filled by the nonzero
/// rule.
///
/// A polygon stays within 0.001 mm, the step of places, of the glyph's curve, for sizes up to a metre. The polygons are
/// equal to the bit on every machine.
pub fn outlines(text: &Text) -> Vec<Vec<DVec2>> {
    contours(text).iter().map(Contour::flattened).collect()
}

/// Returns the outlines of a line of text as curves, in mm on the page, y down.
pub(crate) fn contours(text: &Text) -> Vec<Contour> {
    let Some(font) = font() else { return Vec::new() };
    let scale = text.size / metrics().em;
    let glyphs = font.outline_glyphs();
    let mut contours = Vec::new();
    for glyph in shaped(&text.characters).glyphs {
        let [x, y] = glyph.at.map(|units| units as f64 * scale);
        let mut pen = ContourPen::new(text.at + DVec2::new(x, -y), scale);
        if let Some(outline) = glyphs.get(GlyphId::from(glyph.id)) {
            let sink: &mut dyn PathSink = &mut pen;
            // A glyph of the bundled font that fails to draw would be a broken file: it has no outline then.
            let _ = outline.draw(&DrawOptions::new(), DrawMemory::Scratch, sink);
        }
        contours.extend(pen.finish());
    }
    contours
}

/// Returns the text without control characters, each of which becomes a space.
pub(crate) fn printable(characters: &str) -> Cow<'_, str> {
    if characters.contains(char::is_control) {
        return characters.replace(char::is_control, " ").into();
    }
    characters.into()
}

/// Shapes a line of text with kerning and ligatures. Its direction is guessed from its first script.
pub(crate) fn shaped(characters: &str) -> ShapedLine {
    let Some(font) = font() else { return ShapedLine::default() };
    let characters = printable(characters);
    let mut buffer = Buffer::new();
    buffer.push_str(&characters);
    buffer.guess_segment_properties();
    if harfrust::shape(&ShaperFont::new(font), &mut buffer, ShapeOptions::new()).is_err() {
        return ShapedLine::default();
    }
    // A cluster is the place of its first byte, and ends where the next cluster begins.
    let mut starts: Vec<usize> = buffer.glyph_infos().iter().map(|info| info.cluster as usize).collect();
    starts.push(characters.len());
    starts.sort_unstable();
    starts.dedup();
    let mut line = ShapedLine::default();
    let mut last = None;
    for (info, position) in buffer.glyph_infos().iter().zip(buffer.glyph_positions()) {
        let start = info.cluster as usize;
        let end = starts.get(starts.partition_point(|&s| s <= start)).copied();
        // Glyphs of one cluster follow each other.
        let is_first = last.replace(start) != Some(start);
        let own = end.filter(|_| is_first).and_then(|end| characters.get(start..end)).unwrap_or_default();
        line.glyphs.push(PlacedGlyph {
            id: u16::try_from(info.glyph_id).unwrap_or(MISSING_GLYPH),
            at: [line.advance + i64::from(position.x_offset), i64::from(position.y_offset)],
            characters: own.into(),
        });
        line.advance += i64::from(position.x_advance);
    }
    line
}

/// Returns the width of a glyph, in font units, without kerning.
pub(crate) fn glyph_width(id: u16) -> f64 {
    font().map_or(0.0, |font| f64::from(font.glyph_metrics().h_advance(GlyphId::from(id))))
}

/// Returns the measures of the whole font.
pub(crate) fn metrics() -> FontMetrics {
    let none = FontMetrics { em: 1.0, ascent: 0.0, descent: 0.0, cap_height: 0.0, bounds: [0.0; 4] };
    let Some(found) = font().map(Font::metrics) else { return none };
    let line = found.h_line();
    let bounds = &found.bounds;
    FontMetrics {
        em: f64::from(found.units_per_em.max(1)),
        ascent: line.map_or(0.0, |line| line.ascender.to_f64()),
        descent: line.map_or(0.0, |line| -line.descender.to_f64()),
        cap_height: found.cap_height.map_or(0.0, |height| height.to_f64()),
        bounds: [bounds.x_min, bounds.y_min, bounds.x_max, bounds.y_max].map(|x| x.to_f64()),
    }
}

/// Returns the bundled font. It is read once.
fn font() -> Option<&'static Font> {
    static FONT: OnceLock<Option<Font>> = OnceLock::new();
    FONT.get_or_init(|| Font::new(FONT_FILE, 0)).as_ref()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(characters: &str, size: f64) -> Text {
        Text { characters: characters.into(), at: DVec2::new(10.0, 20.0), size, opacity: 1.0 }
    }

    /// Twice the area of polygons, positive where they turn right on a page with y down.
    fn area(outlines: &[Vec<DVec2>]) -> f64 {
        let of = |points: &Vec<DVec2>| -> f64 {
            let next = points.iter().cycle().skip(1);
            points.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f64>() / 2.0
        };
        outlines.iter().map(of).sum()
    }

    /// Numbers of the font's tables `head`, `hhea`, `OS/2` and `head` again.
    #[test]
    fn measures_are_those_of_the_tables() {
        let bounds = metrics().bounds;
        let wanted = FontMetrics { em: 2048.0, ascent: 2189.0, descent: 600.0, cap_height: 1462.0, bounds };
        assert_eq!(metrics(), wanted);
        assert!(bounds[0] < 0.0 && bounds[1] < -500.0 && bounds[2] > 2000.0 && bounds[3] > 1900.0, "{bounds:?}");
        assert_eq!(cap_height(2048.0), 1462.0);
    }

    /// Advances of `hmtx`: A 1296, V 1219, T 1133, o 1237. Pairs of `kern`: AV −82, To −143.
    #[test]
    fn advances_are_kerned() {
        for (characters, units) in [("", 0.0), ("A", 1296.0), ("AA", 2592.0), ("AV", 1296.0 + 1219.0 - 82.0)] {
            let found = extent(characters, 2048.0);
            assert_eq!(found, TextExtent { advance: units, ascent: 2189.0, descent: 600.0 }, "{characters}");
        }
        assert_eq!(extent("To", 4.0).advance, extent("To", 1.0).advance * 4.0);
        assert_eq!(shaped("AV").glyphs[1].at, [1296 - 82, 0]);
    }

    /// The letter l is a rectangle from 176 to 342 and from 0 to 1556 font units.
    #[test]
    fn the_outline_of_a_letter_lies_where_the_font_says() {
        let found = outlines(&text("l", 20.48));
        assert_eq!(found.len(), 1);
        let mut points: Vec<[i64; 2]> =
            found[0].iter().map(|p| p.to_array().map(|x| (x * 1000.0).round() as i64)).collect();
        points.sort_unstable();
        assert_eq!(points, [[11_760, 4_440], [11_760, 20_000], [13_420, 4_440], [13_420, 20_000]]);
        // The next one begins an advance of 518 later.
        let pair = outlines(&text("ll", 20.48));
        let shift = pair[1][0] - found[0][0];
        assert!((shift - DVec2::new(5.18, 0.0)).length() < 1e-9, "{shift}");
    }

    #[test]
    fn counters_turn_the_other_way() {
        let found = outlines(&text("o", 100.0));
        assert_eq!(found.len(), 2);
        let [a, b] = [0, 1].map(|i| area(&found[i..=i]));
        assert!(a * b < 0.0, "{a} {b}");
        // Between the ellipses of the letter's box, 1007 × 1136 units, and of its counter.
        let ring = (a + b).abs() / (100.0 * 100.0);
        assert!((0.08..0.16).contains(&ring), "{ring}");
    }

    #[test]
    fn an_accent_stands_over_its_letter_however_it_is_written() {
        let (one, two) = (outlines(&text("é", 10.0)), outlines(&text("e\u{301}", 10.0)));
        assert_eq!(one.len(), two.len());
        assert!((area(&one) - area(&two)).abs() < 1e-9);
        assert_eq!(shaped("e\u{301}").advance, shaped("é").advance);
    }

    #[test]
    fn a_missing_character_is_a_box_and_is_named() {
        assert_eq!(missing_characters("Größe 3 µm, façade, ¿niño? Ωж"), []);
        assert_eq!(missing_characters("a☃b☃ 猫"), ['☃', '猫']);
        let snowman = outlines(&text("☃", 10.0));
        assert_eq!(snowman.len(), 2);
        assert!(area(&snowman).abs() > 0.0);
        // Right to left: the first character stands rightmost.
        assert_eq!(missing_characters("שלום"), ['ש', 'ל', 'ו', 'ם']);
        let line = shaped("של");
        assert_eq!(line.glyphs.iter().map(|glyph| &*glyph.characters).collect::<Vec<_>>(), ["ל", "ש"]);
    }

    #[test]
    fn a_line_has_neither_tabs_nor_breaks() {
        assert_eq!(shaped("a\tb\nc\u{7f}"), shaped("a b c "));
        assert_eq!(missing_characters("\r\n\t"), []);
    }

    #[test]
    fn every_character_belongs_to_one_glyph() {
        for characters in ["", "fi ffi", "e\u{301}", "שלום", "a\u{200d}b", "1⁄2", "\u{1f468}\u{200d}\u{1f469}", "لا"]
        {
            let line = shaped(characters);
            let mut found: Vec<char> = line.glyphs.iter().flat_map(|glyph| glyph.characters.chars()).collect();
            let mut wanted: Vec<char> = characters.chars().collect();
            found.sort_unstable();
            wanted.sort_unstable();
            assert_eq!(found, wanted, "{characters:?}");
        }
    }

    #[test]
    fn odd_sizes_do_not_panic() {
        for size in [0.0, -1.0, 1e-300, 1e300, f64::NAN, f64::INFINITY] {
            outlines(&text("Aé☃", size));
            extent("Aé☃", size);
        }
    }

    /// The sum of the bits of all places is what it was when this was written, on every machine.
    #[test]
    fn outlines_have_the_same_bits_everywhere() {
        let mut hash = 0xcbf2_9ce4_8422_2325_u64;
        for x in outlines(&text("Größe: 12,5 µm – AVATAR ☃", 3.7)).into_iter().flatten().flat_map(|p| p.to_array())
        {
            hash = (hash ^ x.to_bits()).wrapping_mul(0x0100_0000_01b3);
        }
        assert_eq!(hash, 3_928_534_558_488_091_426);
    }
}
