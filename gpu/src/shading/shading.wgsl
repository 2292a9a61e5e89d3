// Blinn-Phong shading of a regular transfer function ([STF-11]).
// Twin: reference/src/shading.rs

struct Phong {
    // L, towards the light.
    light: vec3<real>,
    ambient: real,
    diffuse: real,
    specular: real,
    shininess: real,
    // Whether the shininess is a whole number of at most 64.
    is_whole: bool,
}

// c (k_a + k_d max(0, N.L)) + k_s max(0, N.H)^s, the specular term 0 where N.L <= 0.
fn phong(c_u: vec3<real>, n: vec3<real>, v: vec3<real>, lit: Phong) -> vec3<real> {
    let n_l = dot(n, lit.light);
    if (n_l <= 0.0) {
        return c_u * lit.ambient;
    }
    let sum = lit.light + v;
    let length = sqrt(dot(sum, sum));
    var highlight = real(0.0);
    if (length > 0.0) {
        let n_h = max(dot(n, sum) / length, 0.0);
        if (lit.is_whole) {
            highlight = lit.specular * pow_whole(n_h, u32(lit.shininess));
        } else if (n_h > 0.0) {
            highlight = lit.specular * power(n_h, lit.shininess);
        }
    } else if (lit.is_whole && lit.shininess == 0.0) {
        highlight = lit.specular;
    }
    return c_u * (lit.ambient + lit.diffuse * n_l) + highlight;
}

// Shades what has a normal.
fn shaded_by_phong(ray: Ray, a: Attributes, shaded: Shaded, lit: Phong) -> Shaded {
    if (!a.has_normal) {
        return shaded;
    }
    return Shaded(phong(shaded.rgb, a.normal, ray.v, lit), shaded.alpha);
}
