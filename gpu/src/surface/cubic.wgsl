// The first root of a cubic on [0, 1], from its Bernstein coefficients: the value never leaves their range.
// Twin: reference/src/surface/cubic.rs

// a + u(b - a) for u in [0, 1], from the nearer end: exact at both, and for a = b.
fn mix_ends(a: real, b: real, u: real) -> real {
    if (u <= 0.5) {
        return a + u * (b - a);
    }
    return b - (1.0 - u) * (b - a);
}

// The value at u by de Casteljau's scheme.
fn cubic_at(b: vec4<real>, u: real) -> real {
    let low = mix_ends(b.x, b.y, u);
    let middle = mix_ends(b.y, b.z, u);
    let high = mix_ends(b.z, b.w, u);
    return mix_ends(mix_ends(low, middle, u), mix_ends(middle, high, u), u);
}

// A place of an extremum, or 2 where it is not in (0, 1).
fn inside_or_2(over: real, under: real) -> real {
    if (under == 0.0) {
        return 2.0;
    }
    let u = over / under;
    return select(real(2.0), u, u > 0.0 && u < 1.0);
}

// Zeros of the derivative in (0, 1), in ascending order; 2 where there is none.
fn extrema(b: vec4<real>) -> vec2<real> {
    let d = vec3<real>(b.y - b.x, b.z - b.y, b.w - b.z);
    let largest = max(abs(d.x), max(abs(d.y), abs(d.z)));
    if (largest == 0.0) {
        return vec2<real>(2.0, 2.0);
    }
    let d0 = d.x / largest;
    let d1 = d.y / largest;
    let d2 = d.z / largest;
    // (d0 - 2 d1 + d2) u^2 + 2 (d1 - d0) u + d0.
    let square = d0 - 2.0 * d1 + d2;
    let half = d1 - d0;
    let discriminant = d1 * d1 - d0 * d2;
    if (discriminant < 0.0) {
        return vec2<real>(2.0, 2.0);
    }
    // Numbers of the same sign are added; the product of both roots gives the other one.
    let root = sqrt(discriminant);
    let q = select(-root - half, root - half, half < 0.0);
    let u = inside_or_2(q, square);
    let v = inside_or_2(d0, q);
    return vec2<real>(min(u, v), max(u, v));
}

// The smallest u in [0, 1] with the value 0; 2 if there is none.
fn first_root_of(b: vec4<real>) -> real {
    if (b.x == 0.0) {
        return 0.0;
    }
    let above = b.x > 0.0;
    if ((above && b.y > 0.0 && b.z > 0.0 && b.w > 0.0) || (!above && b.y < 0.0 && b.z < 0.0 && b.w < 0.0)) {
        return 2.0;
    }
    // The cubic is monotonic between its extrema.
    let turns = extrema(b);
    var start = real(0.0);
    var before = b.x;
    for (var i = 0; i < 3; i++) {
        var end = real(1.0);
        var value = b.w;
        if (i < 2) {
            end = turns[i];
            if (end >= 1.0) {
                continue;
            }
            value = cubic_at(b, end);
        }
        if (value == 0.0) {
            return end;
        }
        if ((value > 0.0) != above) {
            return bracketed(start, before, end, value);
        }
        start = end;
        before = value;
    }
    return 2.0;
}
