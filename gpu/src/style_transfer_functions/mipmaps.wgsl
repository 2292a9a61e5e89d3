// The level of detail at which a style is looked up ([STF-10]).
// Twin: reference/src/style_transfer_functions/mipmaps.rs

// Of a style log2 S, of a mip-map its lambda = log2(S/side).
@group(1) @binding(12) var<storage, read> lambdas: array<real>;

// lambda - log2 S = log2(max(omega_0, b_kappa min(|kappa| voxel, 1)) / 2 p) + b_g (1 - |g|), not yet clamped: how many
// levels the lookup lies below a style's last one. p counts the rays side by side in a voxel's picture.
fn level_below_last(ray: Ray, sample: Sample, a: Attributes) -> real {
    let bend = params.curvature_bias * min(abs(a.kappa) * params.mip_voxel, 1.0);
    var p = params.rays_in_voxel;
    if (PERSPECTIVE) {
        p = p / (depth_of(ray, sample.k) + sample.offset * ray.depth_step);
    }
    let per_ray = 0.5 * max(params.assumed_turn, bend) / p;
    // Past every style's first level, where there is no normal number.
    if (!(per_ray > 1.0e-37)) {
        return -1.0e4;
    }
    return log2_of(per_ray) + params.gradient_bias * (1.0 - a.magnitude);
}

// Style j at lambda = clamp(level + log2 S, 0, log2 S): bilinear in the two levels about lambda, linear between them.
fn sft(j: i32, n: vec2<real>, level: real) -> vec4<real> {
    let lambda = min(max(level + lambdas[j], 0.0), lambdas[j]);
    let levels = i32(sphere_maps[j].levels);
    let count = i32(sphere_maps[j].level_count);
    var above = 0;
    while (above < count && lambdas[levels + above] <= lambda) {
        above++;
    }
    var lower = j;
    var start = real(0.0);
    if (above > 0) {
        lower = levels + above - 1;
        start = lambdas[lower];
    }
    let first = sample_sphere(lower, n);
    // The last level's lambda is log2 S, so past it there is no way left.
    if (lambda == start) {
        return first;
    }
    let upper = levels + above;
    return mix_texels(first, sample_sphere(upper, n), (lambda - start) / (lambdas[upper] - start));
}
