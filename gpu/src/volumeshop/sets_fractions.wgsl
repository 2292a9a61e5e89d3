// Fractions of objects in what their sets show together, whose sum is 1 (eq. 4; [VS-3], [VS-4]).
// Twin: reference/src/volumeshop/sets.rs

// The sums of mu up to here, and the fractions at the last sample of objects together.
var<private> mu_of_objects: array<real, OBJECTS>;
var<private> fractions: array<real, OBJECTS>;
var<private> fractions_k: i32;

// Deals the mu of an intersection to selection s and object o by their unshaded opacities.
fn deal_meeting(s: i32, o: i32, mu: real, opacities: vec2<real>) {
    let sum = opacities.x + opacities.y;
    var of_selection = mu * 0.5;
    if (sum > 0.0) {
        of_selection = mu * (opacities.x / sum);
    }
    mu_of_objects[s] += of_selection;
    mu_of_objects[o] += mu - of_selection;
}

// Finds the fractions at sample k, of sets out of which intersections are taken.
fn find_fractions(k: i32) {
    var sum = real(0.0);
    for (var i = 0; i < OBJECTS; i++) {
        mu_of_objects[i] += sets[i].mu;
        sum += mu_of_objects[i];
    }
    for (var i = 0; i < OBJECTS; i++) {
        fractions[i] = mu_of_objects[i] / select(real(1.0), sum, sum > 0.0);
        mu_of_objects[i] = 0.0;
    }
    fractions_k = k;
}

fn forget_fractions(ray: Ray) {
    fractions_k = NO_SAMPLE;
}

// Other samples are the background's alone.
fn fraction_of_object(object: i32, k: i32) -> real {
    if (k == fractions_k) {
        return fractions[object];
    }
    return select(real(0.0), real(1.0), object == 0);
}
