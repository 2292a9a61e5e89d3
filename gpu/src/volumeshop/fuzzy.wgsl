// Operators of fuzzy sets ([VS-3]; Zadeh 1965).
// Twin: reference/src/volumeshop/fuzzy.rs

// The intersection of two sets: min(a, b), or ab.
fn both(a: real, b: real) -> real {
    if (PRODUCT) {
        return a * b;
    }
    return min(a, b);
}

// The union of two sets: max(a, b), or a + b - ab. Rounding may lead above 1.
fn either(a: real, b: real) -> real {
    if (PRODUCT) {
        return min(a + b - a * b, 1.0);
    }
    return max(a, b);
}

// The difference of two sets: the intersection with 1 - b.
fn without(a: real, b: real) -> real {
    return both(a, 1.0 - b);
}
