// Intersections of objects on a ray (eqs. 6 and 7; [VS-4]).
// Twin: reference/src/ray/composite/object_ray.rs

// The memberships that intersections take out of each object.
var<private> taken_out: array<real, OBJECTS>;
// The unshaded opacities of a selection and of the object that it met last.
var<private> met_opacities: vec2<real>;

// The colour and the membership of intersection i, of selection s with object o.
fn meeting(i: i32, s: i32, o: i32, preset: i32, swaps: bool) -> Shaded {
    if (!(both(found[o].mu, found[s].mu) > 0.0)) {
        return Shaded();
    }
    // Unshaded colours and opacities, both by the attributes of the set with the larger mu; a tie is the selection's.
    let wins = found[s].mu >= found[o].mu;
    var a = found[o].a;
    if (wins) {
        a = found[s].a;
    }
    let own = unlit_object(s, a);
    var other = unlit_object(o, a);
    other.alpha *= found[o].faded;
    // The opacity, and the colour.
    met_opacities = vec2<real>(own.alpha, other.alpha);
    var alpha = met_opacities;
    if (swaps) {
        alpha = alpha.yx;
    }
    let opacity = opacity_of_both(preset, alpha.x, alpha.y);
    var lit = painted_meeting(i, own, other, opacity, vec2<real>(value_of_object(o), value_of_object(s)));
    // Shaded once, by the winner.
    if (wins) {
        lit = light_object(s, a, lit);
    } else {
        lit = light_object(o, a, lit);
    }
    return Shaded(lit.rgb, both(both(found[o].weight, found[s].weight), lit.alpha));
}

// Adds the set of intersection i and takes it out of object o; what is taken out of selection s waits for further ones.
fn meet(i: i32, s: i32, o: i32, preset: i32, swaps: bool) {
    let met = meeting(i, s, o, preset, swaps);
    sets[OBJECTS + i] = ObjectSet(met.rgb, met.alpha, false);
    if (met.alpha > 0.0) {
        taken_out[s] = either(taken_out[s], met.alpha);
        sets[o].mu = without(sets[o].mu, met.alpha);
    }
}

fn take_out_of_selections() {
    for (var i = 0; i < OBJECTS; i++) {
        if (taken_out[i] > 0.0) {
            sets[i].mu = without(sets[i].mu, taken_out[i]);
        }
        taken_out[i] = 0.0;
    }
}
