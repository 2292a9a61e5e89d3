// Operators of fuzzy sets by products ([VS-3]).

// The intersection and the union of two sets. Rounding may lead above 1.
fn both(a: real, b: real) -> real {
    return a * b;
}

fn either(a: real, b: real) -> real {
    return min(a + b - a * b, 1.0);
}

// The share that several selections take together, with one more.
fn taken_with(taken: real, f: real) -> real {
    return taken + f;
}

// The share of the background's selection set, and the factor of each selection's (eq. 1).
fn share_of_background(taken: real) -> real {
    return max(1.0 - taken, 0.0);
}

fn share_of_each(taken: real) -> real {
    return 1.0 / max(taken, 1.0);
}

// The union of sets that share what is at a place, with one more.
fn shared_with(sum: real, mu: real) -> real {
    return sum + mu;
}
