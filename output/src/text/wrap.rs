//! Text in several lines.

use super::font::extent;

/// Returns text in lines of at most a width, in the unit of its size. Lines end between words. A longer word has a line of
/// its own. A line break of the text ends a line.
pub fn wrapped(text: &str, size: f64, width: f64) -> Vec<String> {
    let mut lines = Vec::new();
    for paragraph in text.lines() {
        let mut line = String::new();
        for word in paragraph.split_whitespace() {
            let longer = if line.is_empty() { word.to_owned() } else { format!("{line} {word}") };
            if line.is_empty() || extent(&longer, size).advance <= width {
                line = longer;
            } else {
                lines.push(std::mem::replace(&mut line, word.to_owned()));
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
        let width = 22.0;
        let lines = wrapped(text, 3.0, width);
        assert_eq!(lines.join(" "), "The quick brown fox jumps over the incomprehensibly lazy dog");
        for pair in lines.windows(2).filter(|pair| !pair[0].ends_with("fox")) {
            let next = pair[1].split(' ').next().unwrap();
            assert!(extent(&format!("{} {next}", pair[0]), 3.0).advance > width, "{lines:?}");
        }
        let is_narrow = |line: &&String| extent(line, 3.0).advance <= width;
        assert!(lines.iter().all(|line| is_narrow(&line) || !line.contains(' ')), "{lines:?}");
        assert_eq!(wrapped("", 3.0, width), [""; 0]);
    }
}
