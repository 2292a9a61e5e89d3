// The seeds of halos at a sample (3.1, [HALO-2], [HALO-3]).
// Twin: reference/src/volumetric_halos/seed.rs

// The attributes of a sample that alpha_u depends on, and alpha_u itself.
var<private> seed_known: Attributes;
var<private> seed_alpha_u: real;

// x^y for x in [0, 1]; 0^0 = 1. Whole exponents are repeated products. Below the normal numbers of f32 x counts as 0.
fn seed_power(x: real, y: real) -> real {
    if (y == 0.0 || x >= 1.0) {
        return 1.0;
    }
    if (floor(y) == y && y <= 64.0) {
        return pow_whole(x, u32(y));
    }
    if (x < 1.2e-38) {
        return 0.0;
    }
    return power(x, y);
}

// sqrt(x (2 - x)), x = T kappa clamped to [0, 1]: the threshold of [STF-7] for the halo's own T.
fn seed_tau(t_kappa: real) -> real {
    let x = clamp_01(t_kappa);
    return sqrt(x * (2.0 - x));
}

// (1 - |n.v|)^b, or clamp(1 - |n.v|/tau).
fn seed_side(halo: i32, n_dot_v: real, kappa: real) -> real {
    if (halos[halo].by_curvature == 0.0) {
        // The product of unit vectors can be more than 1 by its rounding.
        return seed_power(max(1.0 - n_dot_v, 0.0), halos[halo].side);
    }
    let tau = seed_tau(abs(kappa) * halos[halo].side);
    if (!(tau > 0.0)) {
        return 0.0;
    }
    return max(1.0 - n_dot_v / tau, 0.0);
}

// s = clamp(h |g|^a side); 0 below the floor.
fn seed_strength(halo: i32, h: real, n_dot_v: real, magnitude: real, kappa: real) -> real {
    if (n_dot_v > halos[halo].most_frontal) {
        return 0.0;
    }
    let side = seed_side(halo, n_dot_v, kappa);
    let s = min(h * seed_power(magnitude, halos[halo].gradient_exponent) * side, 1.0);
    return select(s, real(0.0), s < halos[halo].floor);
}

// Adds the seeds of a sample.
fn sow(ray: Ray, sample: Sample, place: i32) {
    seed_known = Attributes();
    seed_alpha_u = 0.0;
    ask_opacity(ray, sample);
    var a = seed_known;
    var is_asked = false;
    for (var halo = 0; halo < HALOS; halo++) {
        let h = seed_height(halo, sample);
        // The other factors are at most 1.
        if (!(h > 0.0) || h < halos[halo].floor) {
            continue;
        }
        if (!is_asked) {
            is_asked = true;
            a = seed_rest(ray, sample, a);
            // Only the field's own normal makes a seed; on a cut the cut's counts then.
            if (!a.has_normal) {
                return;
            }
            a = seed_on_cut(ray, sample, a);
        }
        let s = seed_strength(halo, seed_direction(halo, h, ray, a), abs(dot(a.normal, ray.v)), a.magnitude, a.kappa);
        if (s > 0.0) {
            add_seed(halo, place, s);
        }
    }
}
