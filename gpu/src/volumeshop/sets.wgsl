// Object sets at a place, and their colour and opacity (eqs. 2 to 5; [VS-3]).

// An object's set at a sample.
struct Found {
    a: Attributes,
    // Straight, linear.
    rgb: vec3<real>,
    // The membership of its selection set (eq. 2), and that of the set (eq. 3).
    weight: real,
    mu: real,
    // The factor by which ghosting faded its opacity.
    faded: real,
}

// The colour and opacity of objects together at a sample, and the sample and the attributes of the set that counts for most.
struct Together {
    shaded: Shaded,
    sample: Sample,
    a: Attributes,
}

// Sums over sets: of mu c and of mu, the union of sets that share what is there, and that of the others in their order.
struct Sets {
    rgb: vec3<real>,
    weight: real,
    shared_mu: real,
    union_mu: real,
}

fn with_shared(sets: Sets, rgb: vec3<real>, mu: real) -> Sets {
    if (!(mu > 0.0)) {
        return sets;
    }
    return Sets(sets.rgb + rgb * mu, sets.weight + mu, shared_with(sets.shared_mu, mu), sets.union_mu);
}

// Sets that share come before all others.
fn with_other(sets: Sets, rgb: vec3<real>, mu: real) -> Sets {
    if (!(mu > 0.0)) {
        return sets;
    }
    return Sets(sets.rgb + rgb * mu, sets.weight + mu, sets.shared_mu, either(sets.union_mu, mu));
}

// Sum c mu / sum mu, and the membership of the union. A place without members is transparent.
fn combined(sets: Sets) -> Shaded {
    if (!(sets.weight > 0.0)) {
        return Shaded();
    }
    return Shaded(sets.rgb / sets.weight, sets.union_mu);
}

// A - B.
fn without(mu: real, taken: real) -> real {
    return both(mu, 1.0 - taken);
}
