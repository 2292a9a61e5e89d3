// Operators of fuzzy sets after Zadeh ([VS-3]).

// The intersection and the union of two sets.
fn both(a: real, b: real) -> real {
    return min(a, b);
}

fn either(a: real, b: real) -> real {
    return max(a, b);
}

// The share that several selections take together, with one more.
fn taken_with(taken: real, f: real) -> real {
    return max(taken, f);
}

// The share of the background's selection set, and the factor of each selection's (eq. 1).
fn share_of_background(taken: real) -> real {
    return 1.0 - taken;
}

fn share_of_each(taken: real) -> real {
    return 1.0;
}

// The union of sets that share what is at a place, with one more.
fn shared_with(sum: real, mu: real) -> real {
    return max(sum, mu);
}
