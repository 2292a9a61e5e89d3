// Lighting transfer functions: colours and opacities from a table over (N.L, N.H) (5, eq. 8; [VS-5]).
// Twin: reference/src/volumeshop/lighting.rs

// The cells, row by row from the top: s_a, s_d, s_s and s_alpha.
@group(1) @binding(24) var<storage, read> lighting_cells: array<vec4<real>>;

// Two neighbouring cells of a row, mixed. A single column has no second one, and the weight is 0.
fn lighting_row(at: i32, w: real) -> vec4<real> {
    return mix_texels(lighting_cells[at], lighting_cells[at + min(LIGHTING_WIDTH - 1, 1)], w);
}

// The table at (x, y), both clamped to [-1, 1]: bilinear, x then y.
fn reflectance_at(x: real, y: real) -> vec4<real> {
    let column = texel_cell((x + 1.0) * (real(LIGHTING_WIDTH - 1) * 0.5), LIGHTING_WIDTH);
    let row = texel_cell((1.0 - y) * (real(LIGHTING_HEIGHT - 1) * 0.5), LIGHTING_HEIGHT);
    let at = row.i * LIGHTING_WIDTH + column.i;
    let below = at + LIGHTING_WIDTH * min(LIGHTING_HEIGHT - 1, 1);
    return mix_texels(lighting_row(at, column.w), lighting_row(below, column.w), row.w);
}

// The reflectance of a normal: the table at (N.L, N.H), N.H = 0 where L = -v.
fn reflectance(n: vec3<real>, v: vec3<real>) -> vec4<real> {
    let sum = light() + v;
    let length = sqrt(dot(sum, sum));
    var n_h = real(0.0);
    if (length > 0.0) {
        n_h = dot(n, sum * (1.0 / length));
    }
    return reflectance_at(dot(n, light()), n_h);
}

// alpha_u / max(s_min, min(1, s_alpha + (1 - |N|))), clamped to [0, 1].
fn enhanced(alpha_u: real, s_alpha: real, magnitude: real) -> real {
    let divisor = min(s_alpha + (1.0 - magnitude), 1.0);
    return clamp_01(alpha_u / max(divisor, params.divisor_floor));
}

// A sample without a normal keeps its colour and its opacity.
fn shade_by_table(ray: Ray, sample: Sample, a: Attributes, shaded: Shaded) -> Shaded {
    if (!a.has_normal) {
        return shaded;
    }
    let s = reflectance(a.normal, ray.v);
    return Shaded(shaded.rgb * (s.x + s.y) + s.z, enhanced(shaded.alpha, s.w, a.magnitude));
}
