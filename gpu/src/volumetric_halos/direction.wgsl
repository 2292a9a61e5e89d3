// h_d over the angle of a normal in the picture (3.1, [HALO-2]).
// Twin: reference/src/volumetric_halos/direction.rs

// The angle in degrees between a normal's direction in the picture and that of (toward_x, toward_y).
fn degrees_apart(n: vec2<real>, toward: vec2<real>) -> real {
    let cosine = n.x * toward.x + n.y * toward.y;
    let sine = abs(n.x * toward.y - n.y * toward.x);
    return angle(sine, cosine) * (180.0 / PI);
}

// 1 up to half the width, then 1 - smoothstep to 0 over the softness. Along v, up to 2^-26, there is no direction.
fn direction_at(n: vec2<real>, toward: vec2<real>, half_width: real, softness: real) -> real {
    if (sqrt(n.x * n.x + n.y * n.y) <= 1.0 / 67108864.0) {
        return 0.0;
    }
    let beyond = degrees_apart(n, toward) - half_width;
    if (beyond <= 0.0) {
        return 1.0;
    }
    if (beyond >= softness) {
        return 0.0;
    }
    let t = beyond / softness;
    return 1.0 - t * t * (3.0 - 2.0 * t);
}

fn seed_direction(halo: i32, h: real, ray: Ray, a: Attributes) -> real {
    if (halos[halo].has_direction == 0.0) {
        return h;
    }
    let toward = vec2<real>(halos[halo].toward_x, halos[halo].toward_y);
    return h * direction_at(eye_normal(ray, a).xy, toward, halos[halo].half_width, halos[halo].softness);
}
