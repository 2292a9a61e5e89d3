// The objects on a ray: what the sets at a sample make of its colour and opacity ([VS-2], [VS-3]).
// Twin: reference/src/ray/composite/object_ray.rs

// Attributes, colour and memberships of an object at a sample.
struct Found {
    a: Attributes,
    // Straight, linear.
    rgb: vec3<real>,
    // The membership of its selection set (eq. 2), and that of its object set (eq. 3).
    weight: real,
    mu: real,
    // The factor by which ghosting faded its opacity.
    faded: real,
}

// The colour and opacity of objects together at a sample, and the sample and the attributes of the largest set.
struct Together {
    shaded: Shaded,
    sample: Sample,
    a: Attributes,
}

// The findings of the background, and of each part.
var<private> found: array<Found, OBJECTS>;
var<private> shares: Shares;
// The largest mu up to here.
var<private> largest_mu: real;

// Eq. 1 at sample k.
fn find_shares(k: i32) {
    take_selections(k);
    shares = shares_beside();
}

// The membership of the selection set of an object that is taken from the background.
fn selection_share(object: i32) -> real {
    return memberships[object] * shares.of_each;
}

fn keep_found(object: i32, of_object: Found, shares: bool) {
    found[object] = of_object;
    sets[object] = ObjectSet(of_object.rgb, of_object.mu, shares);
}

// Takes an object as the largest set up to here if it is; of equal ones the last. Returns whether it was taken.
fn take_if_largest(object: i32) -> bool {
    let mu = found[object].mu;
    let is = mu > 0.0 && mu >= largest_mu;
    largest_mu = select(largest_mu, mu, is);
    return is;
}

// The sets at sample k together.
fn together(k: i32) -> Together {
    find_shares(k);
    // Eqs. 2 and 3.
    keep_found(0, background_set(k, shares.background), true);
    find_parts(k);
    // Eqs. 6 and 7: intersections, taken out of the sets that meet.
    meet_objects(k);
    // Eqs. 4 and 5.
    let shaded = combined();
    largest_mu = found[0].mu;
    return seen_object(largest_object(), shaded);
}
