//! Letters with accents, composed of a letter of the alphabet and strokes above or below it.

use super::elements::StrokeElement::{self, P};
use super::elements::{arc, polyline};

/// Letters of one accent, their letters without it in the same order, and the accent's strokes. The strokes are about
/// the letter's middle x = 0, over a small letter.
type Accented = (&'static str, &'static str, &'static [&'static [StrokeElement]]);

/// Height of capitals above small letters.
const CAPITAL: f64 = 6.5;

/// The accents of French, German, Portuguese, Spanish and Swedish.
const ACCENTED: &[Accented] = &[
    ("áéíóúýÁÉÍÓÚÝ", "aeıouyAEIOUY", &[&[P(-1.2, 16.5), P(1.8, 20.0)]]),
    ("àèìòùÀÈÌÒÙ", "aeıouAEIOU", &[&[P(1.2, 16.5), P(-1.8, 20.0)]]),
    ("âêîôûÂÊÎÔÛ", "aeıouAEIOU", &[&[P(-2.8, 16.5), P(0.0, 19.7), P(2.8, 16.5)]]),
    ("äëïöüÿÄËÏÖÜŸ", "aeıouyAEIOUY", &[&[P(-2.4, 17.7), P(-2.4, 18.5)], &[P(2.4, 17.7), P(2.4, 18.5)]]),
    (
        "ãñõÃÑÕ",
        "anoANO",
        &[&[arc((-1.75, 17.5), (1.75, 1.5), 180.0, 0.0), arc((1.75, 17.5), (1.75, 1.5), 180.0, 360.0)]],
    ),
    ("åÅ", "aA", &[&[arc((0.0, 18.2), (1.9, 1.9), 90.0, 450.0)]]),
    ("çÇ", "cC", &[&[P(0.8, 0.0), P(0.2, -1.6), arc((-0.2, -3.2), (1.7, 1.6), 80.0, -130.0)]]),
];

/// Returns the letter without its accent, and the accent's strokes; the character itself if it has none.
pub(super) fn parts(character: char) -> (char, &'static [&'static [StrokeElement]]) {
    let found = ACCENTED.iter().find_map(|(letters, plain, strokes)| {
        let place = letters.chars().position(|letter| letter == character)?;
        Some((plain.chars().nth(place)?, *strokes))
    });
    found.unwrap_or((character, &[]))
}

/// Returns the points of an accent's strokes on a letter of that width. A capital raises the accents above it.
pub(super) fn placed(accent: &[&[StrokeElement]], letter: char, width: f64) -> Vec<Vec<[f64; 2]>> {
    let place = |[x, y]: [f64; 2]| [x + width / 2.0, if letter.is_uppercase() && y > 10.0 { y + CAPITAL } else { y }];
    accent.iter().map(|stroke| polyline(stroke).into_iter().map(place).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_letter_has_its_plain_one() {
        for (letters, plain, _) in ACCENTED {
            assert_eq!(letters.chars().count(), plain.chars().count(), "{letters}");
        }
        assert_eq!(["é", "Ñ", "ï", "a"].map(|c| parts(c.chars().next().unwrap_or_default()).0), ['e', 'N', 'ı', 'a']);
        assert!(parts('a').1.is_empty() && !parts('ä').1.is_empty());
    }
}
