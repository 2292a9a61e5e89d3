// A root between two places on a line whose values differ in sign.
// Twin: reference/src/surface/cubic.rs

// Steps after which a bracket has no number inside: each third one halves it at least.
const MOST_STEPS = 200;

// A place with the value 0, or the first of two neighbouring numbers between which the sign of along_cell changes. Secant
// steps, with a bisection at every third; an end that stays gets half its value (Illinois).
fn bracketed(from_u: real, from_value: real, to_u: real, to_value: real) -> real {
    var lo = from_u;
    var hi = to_u;
    var at_lo = from_value;
    var at_hi = to_value;
    var left = from_value;
    var right = to_value;
    let below = from_value < 0.0;
    for (var i = 0; i < MOST_STEPS; i++) {
        var at = lo + 0.5 * (hi - lo);
        let secant = lo + (hi - lo) * (left / (left - right));
        if (i % 3 != 2 && secant > lo && secant < hi) {
            at = secant;
        }
        if (at <= lo || at >= hi) {
            break;
        }
        let value = along_cell(at);
        if (value == 0.0) {
            return at;
        }
        if ((value < 0.0) == below) {
            lo = at;
            at_lo = value;
            left = value;
            right = right * 0.5;
        } else {
            hi = at;
            at_hi = value;
            left = left * 0.5;
            right = value;
        }
    }
    return select(lo, hi, abs(at_hi) < abs(at_lo));
}
