// Clip planes, and cuts: places where a ray comes out of what they cut away ([RAY-8]).
// Twin: reference/src/ray/clipped_samples.rs

// The first sample behind a cut, the plane that the ray crosses last before it, and where it does, in steps from the anchor;
// plane -1 if it crosses none.
var<private> cut_k: i32;
var<private> cut_plane: i32;
var<private> cut_steps: real;

// The place at which sample k is evaluated, in steps from the anchor: on a cut that of the plane.
fn steps_to(k: i32) -> real {
    return select(real(k), cut_steps, cut_plane >= 0 && k == cut_k);
}

// The samples of a run that no plane cuts away, and the cut that it begins with. A sample is cut away if its position is.
fn clip_run(ray: Ray, run: vec2<i32>) -> vec2<i32> {
    cut_plane = -1;
    cut_k = 0;
    var left = run;
    // The crossings, and a sample beyond them.
    for (var i = 0; i < PLANES; i++) {
        let b = growth(i, ray);
        if (abs(b) > 1.0e-20) {
            let crossing = min(max(-beyond(i, ray.origin) / b, -4.0e6), 4.0e6);
            if (b < 0.0) {
                left.x = max(left.x, i32(floor(crossing)) - 1);
            } else {
                left.y = min(left.y, i32(ceil(crossing)) + 1);
            }
        }
    }
    while (left.x <= left.y && is_cut(position(ray, left.x))) {
        left.x++;
    }
    while (left.y >= left.x && is_cut(position(ray, left.y))) {
        left.y--;
    }
    if (left.x > left.y || left.x == run.x) {
        return left;
    }
    // Of planes that are crossed together the first one counts.
    let before = position(ray, left.x - 1);
    var last = real(-4.0e6);
    for (var i = 0; i < PLANES; i++) {
        if (beyond(i, before) > 0.0 && abs(growth(i, ray)) > 1.0e-20) {
            let crossing = -beyond(i, ray.origin) / growth(i, ray);
            if (cut_plane < 0 || crossing > last) {
                last = crossing;
                cut_plane = i;
                cut_k = left.x;
                cut_steps = clamp(crossing, real(cut_k - 1), real(cut_k));
            }
        }
    }
    return left;
}

// On a cut N is the plane's normal, turned to the eye, and there is no curvature.
fn measure_cut(ray: Ray, sample: Sample, known: Attributes) -> Attributes {
    var a = known;
    if (cut_plane >= 0 && sample.k == cut_k) {
        let n = vec3<real>(planes[cut_plane].world_x, planes[cut_plane].world_y, planes[cut_plane].world_z);
        a.has_normal = true;
        a.normal = select(n, -n, dot(n, ray.v) < 0.0);
        a.kappa = 0.0;
    }
    return a;
}

// The cap's colour in place of a cut's own; its opacity is a factor.
fn show_cap(ray: Ray, sample: Sample, a: Attributes, shaded: Shaded) -> Shaded {
    if (cut_plane >= 0 && sample.k == cut_k && planes[cut_plane].has_cap == 1.0) {
        let rgb = vec3<real>(planes[cut_plane].r, planes[cut_plane].g, planes[cut_plane].b);
        return Shaded(rgb, shaded.alpha * planes[cut_plane].opacity);
    }
    return shaded;
}
