// Blinn-Phong shading of a regular transfer function ([STF-11]).

// c (k_a + k_d max(0, N.L)) + k_s max(0, N.H)^s, the specular term 0 where N.L <= 0.
fn phong(c_u: vec3<real>, n: vec3<real>, v: vec3<real>) -> vec3<real> {
    let n_l = dot(n, light());
    if (n_l <= 0.0) {
        return c_u * params.ambient;
    }
    let sum = light() + v;
    let length = sqrt(dot(sum, sum));
    var highlight = real(0.0);
    if (length > 0.0) {
        let n_h = max(dot(n, sum) / length, 0.0);
        if (WHOLE_SHININESS) {
            highlight = params.specular * pow_whole(n_h, u32(params.shininess));
        } else if (n_h > 0.0) {
            highlight = params.specular * power(n_h, params.shininess);
        }
    } else if (WHOLE_SHININESS && params.shininess == 0.0) {
        highlight = params.specular;
    }
    return c_u * (params.ambient + params.diffuse * n_l) + highlight;
}

// Shades samples that have a normal.
fn shade_phong(ray: Ray, sample: Sample, a: Attributes, shaded: Shaded) -> Shaded {
    if (!a.has_normal) {
        return shaded;
    }
    return Shaded(phong(shaded.rgb, a.normal, ray.v), shaded.alpha);
}
