//! Characters that must not reach a terminal as they are.

/// Whether a character could change what a terminal shows around it: a control character such as ESC, or one of
/// Unicode's marks of writing direction, which reorder a line.
pub fn is_unprintable(c: char) -> bool {
    let is_direction = matches!(
        c,
        '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
    );
    c.is_control() || is_direction
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn controls_and_directions_and_nothing_else() {
        for c in "\0\n\t\r\u{1b}\u{7f}\u{9b}\u{61c}\u{200e}\u{200f}\u{202a}\u{202e}\u{2066}\u{2069}".chars() {
            assert!(is_unprintable(c), "{c:?}");
        }
        for c in " ~aé×κ▁\u{200d}\u{2029}\u{202f}\u{2065}\u{206a}漢🦴".chars() {
            assert!(!is_unprintable(c), "{c:?}");
        }
    }
}
