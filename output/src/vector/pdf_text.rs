//! Text of PDF files: a subset of the bundled font, and strings in it. Every glyph stands where shaping puts it.

use super::decimals::{number, push};
use crate::grid::micrometres;
use crate::text::font::{FONT_FILE, MISSING_GLYPH, PlacedGlyph, glyph_width, metrics, shaped};
use drypoint_scene::marks::{Marks, Text};
use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::{CidFontType, FontFlags, SystemInfo, UnicodeCmap};
use pdf_writer::{Filter, Finish, Name, Pdf, Rect, Ref, Str};
use std::collections::BTreeMap;
use std::io::Write;
use subsetter::{GlyphRemapper, subset};

/// PostScript name of the bundled font.
const POSTSCRIPT_NAME: &str = "OpenSans";

/// Width of the font's upright stems, in thousandths of an em, for viewers that imitate the font: that of the letter l.
const STEM: f32 = 81.0;

/// Character collection of codes that are glyphs.
const COLLECTION: SystemInfo = SystemInfo { registry: Str(b"Adobe"), ordering: Str(b"Identity"), supplement: 0 };

/// The glyphs that a page needs, as a font of their own.
pub(super) struct EmbeddedFont {
    /// The bytes of the font's file.
    file: Vec<u8>,
    /// The code of each glyph in strings, by the glyph's number in the bundled font.
    codes: BTreeMap<u16, u16>,
    /// The characters that a reader takes each glyph for.
    characters: BTreeMap<u16, String>,
}

impl EmbeddedFont {
    /// Returns the font of all text on a page; none without text.
    pub(super) fn of(marks: &Marks) -> Option<Self> {
        let mut characters = BTreeMap::new();
        for text in marks.layers.iter().flat_map(|layer| &layer.texts) {
            for glyph in shaped(&text.characters).glyphs {
                let known: &mut String = characters.entry(glyph.id).or_default();
                // The box for missing characters stands for none of them.
                if known.is_empty() && glyph.id != MISSING_GLYPH {
                    *known = glyph.characters;
                }
            }
        }
        if characters.is_empty() {
            return None;
        }
        characters.entry(MISSING_GLYPH).or_default();
        let glyphs: Vec<u16> = characters.keys().copied().collect();
        let remapper = GlyphRemapper::new_from_glyphs_sorted(&glyphs);
        // A file that cannot be reduced is embedded whole, and codes are the glyphs' own numbers.
        let (file, codes) = match subset(FONT_FILE, 0, &remapper) {
            Ok(file) => (file, glyphs.iter().map(|&id| (id, remapper.get(id).unwrap_or_default())).collect()),
            Err(_) => (FONT_FILE.to_vec(), glyphs.iter().map(|&id| (id, id)).collect()),
        };
        Some(Self { file, codes, characters })
    }

    /// Appends operators that show a line of text in the current colour, with the page in millimetres, y down.
    pub(super) fn show(&self, text: &Text, out: &mut Vec<u8>) {
        let line = shaped(&text.characters);
        let size = micrometres(text.size);
        if line.glyphs.is_empty() || size <= 0 {
            return;
        }
        // The size of the font is 1, and the text's matrix scales and flips it.
        out.extend_from_slice(b"BT /F 1 Tf ");
        for (value, end) in [(size, " 0 0 "), (-size, " ")] {
            push(out, value);
            out.extend_from_slice(end.as_bytes());
        }
        for value in text.at.to_array().map(micrometres) {
            push(out, value);
            out.push(b' ');
        }
        out.extend_from_slice(b"Tm ");
        self.glyphs(&line.glyphs, out);
        out.extend_from_slice(b"ET\n");
    }

    /// Whether a reader takes glyphs that show the same characters for these characters.
    fn tells(&self, glyphs: &[PlacedGlyph]) -> bool {
        let read = glyphs.iter().filter_map(|glyph| self.characters.get(&glyph.id));
        read.flat_map(|read| read.chars()).eq(glyphs.iter().flat_map(|glyph| glyph.characters.chars()))
    }

    /// Appends strings of glyphs. Numbers between them, in thousandths of an em, move the next glyph to the left. A
    /// reader that cannot tell characters from their glyphs is told them.
    fn glyphs(&self, glyphs: &[PlacedGlyph], out: &mut Vec<u8>) {
        let (mut pen, mut rise) = (0.0, 0);
        // The first glyph of several that show the same characters has them.
        let same: Vec<&[PlacedGlyph]> = glyphs.chunk_by(|_, next| next.characters.is_empty()).collect();
        for run in same.chunk_by(|a, b| self.tells(a) && self.tells(b)) {
            let is_told = !run.iter().all(|glyphs| self.tells(glyphs));
            let run = run.iter().flat_map(|glyphs| glyphs.iter());
            if is_told {
                out.extend_from_slice(b"/Span <</ActualText <FEFF");
                let characters = run.clone().flat_map(|glyph| glyph.characters.encode_utf16());
                characters.for_each(|unit| push_hex(out, unit));
                out.extend_from_slice(b">>> BDC ");
            }
            self.strings(run, &mut pen, &mut rise, out);
            out.extend_from_slice(if is_told { b" EMC " } else { b" " });
        }
    }

    /// Appends strings of glyphs, with the pen's place along the line and above it in font units.
    fn strings<'a>(
        &self,
        glyphs: impl Iterator<Item = &'a PlacedGlyph>,
        pen: &mut f64,
        rise: &mut i64,
        out: &mut Vec<u8>,
    ) {
        let em = metrics().em;
        out.extend_from_slice(b"[<");
        for glyph in glyphs {
            let [x, y] = glyph.at;
            if y != *rise {
                *rise = y;
                add(out, format_args!(">] TJ {} Ts [<", number(y as f64 / em)));
            }
            let shift = x as f64 - *pen;
            if shift != 0.0 {
                add(out, format_args!("> {} <", number(-1000.0 * shift / em)));
            }
            push_hex(out, self.codes.get(&glyph.id).copied().unwrap_or_default());
            *pen = x as f64 + glyph_width(glyph.id);
        }
        out.extend_from_slice(b">] TJ");
    }

    /// Writes the font's five objects, from the first reference on. The first object is the font that pages name.
    pub(super) fn write(&self, pdf: &mut Pdf, first: Ref, level: u8) {
        let [font, descendant, descriptor, file, map] = [0, 1, 2, 3, 4].map(|i| Ref::new(first.get() + i));
        let name = format!("{}+{POSTSCRIPT_NAME}", self.tag());
        let name = Name(name.as_bytes());
        let metrics = metrics();
        let thousandths = |units: f64| (1000.0 * units / metrics.em) as f32;
        let mut composite = pdf.type0_font(font);
        composite.base_font(name).encoding_predefined(Name(b"Identity-H")).descendant_font(descendant).to_unicode(map);
        composite.finish();
        let mut cid = pdf.cid_font(descendant);
        cid.subtype(CidFontType::Type2).base_font(name).system_info(COLLECTION).font_descriptor(descriptor);
        cid.cid_to_gid_map_predefined(Name(b"Identity"));
        let mut widths = cid.widths();
        for (&glyph, &code) in &self.codes {
            widths.consecutive(code, [thousandths(glyph_width(glyph))]);
        }
        widths.finish();
        cid.finish();
        let [left, bottom, right, top] = metrics.bounds.map(thousandths);
        pdf.font_descriptor(descriptor)
            .name(name)
            .flags(FontFlags::SYMBOLIC)
            .bbox(Rect::new(left, bottom, right, top))
            .italic_angle(0.0)
            .ascent(thousandths(metrics.ascent))
            .descent(-thousandths(metrics.descent))
            .cap_height(thousandths(metrics.cap_height))
            .stem_v(STEM)
            .font_file2(file);
        let packed = compress_to_vec_zlib(&self.file, level);
        pdf.stream(file, &packed).filter(Filter::FlateDecode).pair(Name(b"Length1"), self.file.len() as i32);
        let mut characters = UnicodeCmap::<u16>::new(Name(b"Drypoint-UCS"), COLLECTION);
        for (glyph, said) in self.characters.iter().filter(|(_, said)| !said.is_empty()) {
            characters.pair_with_multiple(self.codes.get(glyph).copied().unwrap_or_default(), said.chars());
        }
        let packed = compress_to_vec_zlib(characters.finish().as_slice(), level);
        pdf.cmap(map, &packed).filter(Filter::FlateDecode);
    }

    /// Returns six capitals that tell the subset from others of the font, from a hash of its glyphs.
    fn tag(&self) -> String {
        // FNV-1a.
        let mix = |hash: u64, &glyph: &u16| (hash ^ u64::from(glyph)).wrapping_mul(0x0100_0000_01b3);
        let mut rest = self.codes.keys().fold(0xcbf2_9ce4_8422_2325, mix);
        let mut letter = || {
            let letter = b'A' + (rest % 26) as u8;
            rest /= 26;
            char::from(letter)
        };
        (0..6).map(|_| letter()).collect()
    }
}

/// Appends four hexadecimal digits.
fn push_hex(out: &mut Vec<u8>, number: u16) {
    add(out, format_args!("{number:04X}"));
}

fn add(out: &mut Vec<u8>, said: std::fmt::Arguments) {
    // A Vec takes whatever is written to it.
    let _ = out.write_fmt(said);
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::glam::DVec2;
    use drypoint_scene::marks::{Layer, Page, Pen};

    fn text(characters: &str) -> Text {
        Text { characters: characters.into(), at: DVec2::new(3.0, 4.5), size: 2.5, opacity: 1.0 }
    }

    fn marks(lines: &[&str]) -> Marks {
        let pen = Pen { number: 1, name: "black".into(), width: 0.3, color: [0.0, 0.0, 0.0, 1.0] };
        let layer = Layer { texts: lines.iter().map(|line| text(line)).collect(), ..Layer::new(pen) };
        Marks { page: Page::in_millimetres(DVec2::new(20.0, 10.0), 2.0, 300.0), layers: vec![layer] }
    }

    fn shown(font: &EmbeddedFont, characters: &str) -> String {
        let mut out = Vec::new();
        font.show(&text(characters), &mut out);
        String::from_utf8(out).unwrap()
    }

    /// Glyphs A 36, H 43, V 57, é 171 have the codes 1 to 4. The pair AV is 82 units closer, which is 1000·82/2048 =
    /// 40.0390625 thousandths of an em; six decimals round to even.
    #[test]
    fn glyphs_stand_where_shaping_puts_them() {
        let font = EmbeddedFont::of(&marks(&["AVHé"])).unwrap();
        assert_eq!(shown(&font, "HA"), "BT /F 1 Tf 2.5 0 0 -2.5 3 4.5 Tm [<00020001>] TJ ET\n");
        assert_eq!(shown(&font, "AV"), "BT /F 1 Tf 2.5 0 0 -2.5 3 4.5 Tm [<0001> 40.039062 <0003>] TJ ET\n");
        assert_eq!(shown(&font, ""), "");
    }

    #[test]
    fn a_reader_is_told_what_glyphs_do_not_tell() {
        let font = EmbeddedFont::of(&marks(&["a☃"])).unwrap();
        assert_eq!(
            shown(&font, "a☃a"),
            "BT /F 1 Tf 2.5 0 0 -2.5 3 4.5 Tm [<0001>] TJ /Span <</ActualText <FEFF2603>>> BDC [<0000>] TJ EMC \
             [<0001>] TJ ET\n"
        );
        assert!(!shown(&font, "a").contains("Span"));
    }

    #[test]
    fn a_font_holds_the_page_s_glyphs_alone() {
        assert!(EmbeddedFont::of(&marks(&[])).is_none());
        assert!(EmbeddedFont::of(&marks(&["", ""])).is_none());
        let font = EmbeddedFont::of(&marks(&["label", "a label"])).unwrap();
        assert_eq!(font.codes.len(), 6);
        assert!(font.codes.values().copied().eq(0..6));
        assert!(font.file.len() < FONT_FILE.len() / 20, "{}", font.file.len());
        let read: Vec<&str> = font.characters.values().map(String::as_str).collect();
        assert_eq!(read, ["", " ", "a", "b", "e", "l"]);
        let other = EmbeddedFont::of(&marks(&["labels"])).unwrap();
        assert!(font.tag() != other.tag() && font.tag().bytes().all(|letter| letter.is_ascii_uppercase()));
    }
}
