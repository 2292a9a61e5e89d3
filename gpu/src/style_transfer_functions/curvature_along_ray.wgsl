// kappa_v from two normals along a ray (3.3, Fig. 6; [STF-5]).
// Twin: reference/src/style_transfer_functions/curvature_along_ray.rs

// The last sample of the ray that was asked for its normal, and the normal; its plane is before every other at first.
var<private> asked_plane: i32;
var<private> asked_has_normal: bool;
var<private> asked_normal: vec3<real>;

fn forget_normal(ray: Ray) {
    asked_plane = -0x7fffffff;
}

// The normal of sample k - 1, also if it was skipped or transparent; into `asked_normal`.
fn ask_before(ray: Ray, k: i32) {
    if (asked_plane == k - 1) {
        return;
    }
    asked_has_normal = false;
    if (has_sample(ray, k - 1)) {
        let g = gradient_at(locate(position(ray, k - 1)));
        asked_has_normal = has_normal(g);
        if (asked_has_normal) {
            asked_normal = normal_of(g, ray.v);
        }
    }
}

// The angle between two normals over the distance between them.
fn turn_along_ray(n: vec3<real>, before: vec3<real>, way: real) -> real {
    let sine = cross(n, before);
    return angle(sqrt(dot(sine, sine)), turn_cosine(dot(n, before))) / way;
}

// kappa is 0 unless both normals are known.
fn measure_along_ray(ray: Ray, sample: Sample, known: Attributes) -> Attributes {
    var a = known;
    if (a.has_normal) {
        ask_before(ray, sample.k);
        a.kappa = 0.0;
        if (asked_has_normal) {
            a.kappa = turn_along_ray(a.normal, asked_normal, ray.step);
        }
    }
    // The next sample looks back to the lattice, which a cut is beside.
    asked_plane = select(sample.k, -0x7fffffff, sample.offset != 0.0);
    asked_has_normal = a.has_normal;
    asked_normal = a.normal;
    return a;
}
