// N in eye space; a sample without a normal has N = v ([PREC-3]).
// Glue: Queries of samples.

fn eye_normal(ray: Ray, a: Attributes) -> vec3<real> {
    if (!a.has_normal) {
        return ray.v_eye;
    }
    return vec3<real>(dot(a.normal, view_right()), dot(a.normal, view_up()), -dot(a.normal, view_forward()));
}
