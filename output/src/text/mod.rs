//! Text: filled letters of the bundled [`font`], and single strokes, where every letter is a few polylines for a round
//! pen.
//!
//! The alphabet of strokes is our own, made of straight lines and arcs of ellipses. It serves labels of sheets, and
//! plotters, whose pen draws a letter's middle line. Lengths are in font units: capitals are [`CAP_HEIGHT`] high, y
//! goes up from the baseline, x goes right from the pen position.

mod accents;
mod alphabet;
pub(crate) mod contour;
mod elements;
pub mod font;
mod wrap;

use alphabet::{glyph_of, is_known};
use elements::polyline;

pub(crate) use alphabet::GAP;
pub use wrap::wrapped;

/// Height of capitals and digits.
pub const CAP_HEIGHT: f64 = 20.0;
/// Depth of small letters below the baseline.
pub const DESCENT: f64 = 6.0;
/// Pen width that gives an even, readable weight.
pub const WEIGHT: f64 = 2.6;

/// One character.
#[derive(Clone, Debug, PartialEq)]
pub struct Glyph {
    /// Distance to the next pen position.
    pub advance: f64,
    /// Strokes; one of two equal points is a dot.
    pub strokes: Vec<Vec<[f64; 2]>>,
}

/// Returns the strokes of a character, or an empty box if the alphabet does not have it.
pub fn glyph(character: char) -> Glyph {
    let (letter, accent) = accents::parts(character);
    let (advance, strokes) = glyph_of(letter);
    let accent = accents::placed(accent, letter, advance - GAP);
    Glyph { advance, strokes: strokes.iter().map(|stroke| polyline(stroke)).chain(accent).collect() }
}

/// Returns the characters that the alphabet of strokes lacks, each once, in their order.
pub fn missing_strokes(text: &str) -> Vec<char> {
    let mut missing = Vec::new();
    for character in text.chars().filter(|&c| !c.is_control() && !is_known(accents::parts(c).0)) {
        if !missing.contains(&character) {
            missing.push(character);
        }
    }
    missing
}

/// Returns the width of a line of text in font units, without the space after its last character.
pub fn width(text: &str) -> f64 {
    (advance(text) - GAP).max(0.0)
}

/// Returns the width of a line of text in font units, with the space after its last character.
pub(crate) fn advance(text: &str) -> f64 {
    text.chars().map(|c| glyph_of(accents::parts(c).0).0).sum()
}

/// Returns the strokes of a line of text that begins at x = 0 on the baseline y = 0.
pub fn strokes(text: &str) -> Vec<Vec<[f64; 2]>> {
    let mut pen = 0.0;
    let mut strokes = Vec::new();
    for glyph in text.chars().map(glyph) {
        strokes.extend(
            glyph.strokes.into_iter().map(|stroke| stroke.into_iter().map(|[x, y]| [x + pen, y]).collect::<Vec<_>>()),
        );
        pen += glyph.advance;
    }
    strokes
}

/// Returns the text. If it is wider than `limit` font units, three dots replace its middle, since the ends of file
/// names tell more.
pub fn fit(text: &str, limit: f64) -> String {
    if width(text) <= limit {
        return text.into();
    }
    let characters: Vec<char> = text.chars().collect();
    (0..characters.len())
        .rev()
        .map(|kept| {
            let end = kept / 2;
            let begin = &characters[..kept - end];
            let end = &characters[characters.len() - end..];
            begin.iter().chain(['.'; 3].iter()).chain(end).collect::<String>()
        })
        .find(|short| width(short) <= limit)
        .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_character_is_there_and_keeps_its_lines() {
        let unknown = glyph('\u{2603}');
        for c in (' '..='~').chain("×°…–−µ".chars()) {
            let glyph = glyph(c);
            assert_ne!(glyph.strokes, unknown.strokes, "{c:?}");
            for [x, y] in glyph.strokes.into_iter().flatten() {
                assert!((-1.5..=glyph.advance).contains(&x), "{c:?} reaches {x} of {}", glyph.advance);
                assert!((-DESCENT..=CAP_HEIGHT + 3.0).contains(&y), "{c:?} reaches {y}");
            }
        }
    }

    #[test]
    fn capitals_and_digits_are_of_one_height() {
        for c in ('A'..='Z').chain('0'..='9') {
            let ys: Vec<f64> = glyph(c).strokes.into_iter().flatten().map(|[_, y]| y).collect();
            let top = ys.iter().copied().fold(f64::MIN, f64::max);
            let bottom = ys.iter().copied().fold(f64::MAX, f64::min);
            // The points of an arc of radius 10 may miss its top by 10·(1 − cos 4.1°) = 0.026.
            assert!((top - CAP_HEIGHT).abs() < 0.03, "{c}: {top}");
            assert!(bottom.abs() < 0.03 || c == 'Q', "{c}: {bottom}");
        }
    }

    /// German, French and Spanish, with their quotation marks.
    const EUROPEAN: &str = "ÄÖÜäöüßÀÂÇÈÉÊËÎÏÔŒÙÛŸàâçèéêëîïôœùûÿÁÍÓÚÑáíóúñ¿¡«»„“”‘’—·€æÆ";

    #[test]
    fn european_letters_are_there() {
        assert_eq!(missing_strokes(EUROPEAN), []);
        assert_eq!(missing_strokes("a☃\tñ猫☃"), ['☃', '猫']);
        let all: Vec<char> = EUROPEAN.chars().chain(' '..='~').collect();
        for (i, &c) in all.iter().enumerate() {
            assert!(all[..i].iter().all(|&b| glyph(c).strokes != glyph(b).strokes), "{c}");
            for [x, y] in glyph(c).strokes.into_iter().flatten() {
                assert!((-3.0..=glyph(c).advance).contains(&x), "{c:?} reaches {x} of {}", glyph(c).advance);
                assert!((-DESCENT..=CAP_HEIGHT + 7.0).contains(&y), "{c:?} reaches {y}");
            }
        }
        let (plain, accented) = (glyph('e'), glyph('é'));
        assert_eq!((accented.advance, &accented.strokes[..plain.strokes.len()]), (plain.advance, &plain.strokes[..]));
        assert_eq!(advance("é"), plain.advance);
    }

    #[test]
    fn digits_are_of_one_width() {
        assert!(('1'..='9').all(|c| glyph(c).advance == glyph('0').advance));
    }

    #[test]
    fn no_two_characters_look_alike() {
        let all: Vec<char> = (' '..='~').collect();
        for (i, a) in all.iter().enumerate() {
            assert!(all[..i].iter().all(|b| glyph(*a).strokes != glyph(*b).strokes), "{a}");
        }
    }

    #[test]
    fn text_is_laid_out_by_advances() {
        assert_eq!(width(""), 0.0);
        let (h, i) = (glyph('H'), glyph('i'));
        assert_eq!(width("Hi"), h.advance + i.advance - alphabet::GAP);
        let laid = strokes("Hi");
        assert_eq!(laid[..h.strokes.len()], h.strokes);
        assert_eq!(laid[h.strokes.len()][0][0], i.strokes[0][0][0] + h.advance);
    }

    #[test]
    fn long_text_loses_its_middle() {
        let long = "abdomen_ct_labels.nii.gz";
        assert_eq!(fit(long, width(long)), long);
        let short = fit(long, 0.6 * width(long));
        assert!(width(&short) <= 0.6 * width(long));
        assert!(short.starts_with("abd") && short.contains("...") && short.ends_with(".gz"), "{short}");
        assert_eq!(fit(long, 0.0), "");
    }
}
