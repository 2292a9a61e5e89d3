// Object sets at a place, and their colour and opacity (eqs. 3 to 5; [VS-3]).
// Twin: reference/src/volumeshop/sets.rs

struct ObjectSet {
    // Straight, linear.
    rgb: vec3<real>,
    mu: real,
    // Whether the set and others of its kind share what is at a place: with products their memberships are added.
    shares: bool,
}

// The sets at a sample: those of objects, and those of intersections.
var<private> sets: array<ObjectSet, SETS>;

// Sum c mu / sum mu, and the membership of the union. A place without members is transparent.
fn combined() -> Shaded {
    var sum = vec3<real>();
    var weight = real(0.0);
    var shared_mu = real(0.0);
    for (var i = 0; i < SETS; i++) {
        let each = sets[i];
        if (each.mu > 0.0) {
            sum += each.rgb * each.mu;
            weight += each.mu;
            if (each.shares) {
                shared_mu = select(max(shared_mu, each.mu), shared_mu + each.mu, PRODUCT);
            }
        }
    }
    if (!(weight > 0.0)) {
        return Shaded();
    }
    var opacity = min(shared_mu, 1.0);
    for (var i = 0; i < SETS; i++) {
        if (!sets[i].shares && sets[i].mu > 0.0) {
            opacity = either(opacity, sets[i].mu);
        }
    }
    return Shaded(sum / weight, opacity);
}
