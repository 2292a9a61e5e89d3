//! Numbers as text: micrometres as the shortest decimal of millimetres, without rounding.

use std::io::Write;

/// Appends `n` thousandths, without a zero before the point or at the end.
pub(super) fn push(out: &mut Vec<u8>, n: i64) {
    if n < 0 {
        out.push(b'-');
    }
    let (whole, part) = (n.unsigned_abs() / 1000, n.unsigned_abs() % 1000);
    if whole > 0 || part == 0 {
        // A Vec takes whatever is written to it.
        let _ = write!(out, "{whole}");
    }
    if part > 0 {
        let digits = [part / 100, part / 10 % 10, part % 10].map(|d| b'0' + d as u8);
        let length = digits.iter().rposition(|&d| d != b'0').map_or(0, |last| last + 1);
        out.push(b'.');
        out.extend_from_slice(&digits[..length]);
    }
}

/// Appends a pair of numbers. A space separates them unless a sign does.
pub(super) fn push_pair(out: &mut Vec<u8>, [x, y]: [i64; 2]) {
    push(out, x);
    if y >= 0 {
        out.push(b' ');
    }
    push(out, y);
}

/// Returns a share or a size as text, with at most six decimals.
pub(super) fn number(x: f64) -> String {
    format!("{}", (x * 1e6).round_ties_even() / 1e6)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::micrometres;

    fn text(n: i64) -> String {
        let mut out = Vec::new();
        push(&mut out, n);
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn hand_worked_numbers() {
        for (n, expected) in [
            (0, "0"),
            (1, ".001"),
            (10, ".01"),
            (100, ".1"),
            (-120, "-.12"),
            (1000, "1"),
            (12_345, "12.345"),
            (-297_000, "-297"),
            (1_050_030, "1050.03"),
            (i64::MIN, "-9223372036854775.808"),
        ] {
            assert_eq!(text(n), expected);
        }
    }

    #[test]
    fn every_step_is_read_back() {
        for n in (-30_000..30_000).step_by(7) {
            assert_eq!(micrometres(text(n).parse().unwrap()), n);
        }
    }

    #[test]
    fn pairs_and_shares() {
        let mut out = Vec::new();
        push_pair(&mut out, [1500, -20]);
        push_pair(&mut out, [-1, 20]);
        assert_eq!(String::from_utf8(out).unwrap(), "1.5-.02-.001 .02");
        assert_eq!(number(25.4 / 300.0), "0.084667");
        assert_eq!(number(0.0625), "0.0625");
    }
}
