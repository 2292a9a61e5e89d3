//! Text in several lines.

use super::font::{clusters, extent};

/// Returns text in lines of at most a width, in the unit of its size. Lines end between words, and a wider word is broken
/// between characters. A line break of the text ends a line. Each line has a character, even if it is wider.
pub fn wrapped(text: &str, size: f64, width: f64) -> Vec<String> {
    let fits = |line: &str| extent(line, size).advance <= width;
    let mut lines = Vec::new();
    for paragraph in text.lines() {
        let mut line = String::new();
        for word in paragraph.split_whitespace() {
            let longer = if line.is_empty() { word.to_owned() } else { format!("{line} {word}") };
            if fits(&longer) {
                line = longer;
                continue;
            }
            if !line.is_empty() {
                lines.push(std::mem::take(&mut line));
            }
            let parts = if fits(word) { vec![word.to_owned()] } else { clusters(word) };
            for part in parts {
                let longer = format!("{line}{part}");
                if line.is_empty() || fits(&longer) {
                    line = longer;
                } else {
                    lines.push(std::mem::replace(&mut line, part));
                }
            }
        }
        lines.push(line);
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_as_full_as_they_can_be() {
        let text = "The quick brown fox\njumps over  the incomprehensibly lazy dog";
        let width = 26.0;
        let lines = wrapped(text, 3.0, width);
        assert_eq!(lines.join(" "), "The quick brown fox jumps over the incomprehensibly lazy dog");
        for pair in lines.windows(2).filter(|pair| !pair[0].ends_with("fox")) {
            let next = pair[1].split(' ').next().unwrap();
            assert!(extent(&format!("{} {next}", pair[0]), 3.0).advance > width, "{lines:?}");
        }
        assert!(lines.iter().all(|line| extent(line, 3.0).advance <= width), "{lines:?}");
        assert_eq!(wrapped("", 3.0, width), [""; 0]);
    }

    /// A line of a broken word is narrow, and too wide with the next character. Marks stay with their letters.
    #[test]
    fn a_word_wider_than_a_line_is_broken_between_characters() {
        let word = "Donaudampfschifffahrtsgesellschaft";
        for text in [word.to_owned(), "e\u{301}".repeat(40), "א".repeat(40) + "בג"] {
            let lines = wrapped(&format!("a {text} b"), 3.0, 12.0);
            assert_eq!(lines.concat().replace(' ', ""), format!("a{text}b"), "{lines:?}");
            assert!(lines.len() > 3 && lines.iter().all(|line| extent(line, 3.0).advance <= 12.0), "{lines:?}");
            assert!(lines.iter().all(|line| !line.starts_with('\u{301}')), "{lines:?}");
            for pair in lines[1..lines.len() - 1].windows(2) {
                assert!(extent(&format!("{}{}", pair[0], clusters(&pair[1])[0]), 3.0).advance > 12.0, "{lines:?}");
            }
        }
        assert_eq!(wrapped("abc d", 3.0, 0.1), ["a", "b", "c", "d"]);
    }
}
