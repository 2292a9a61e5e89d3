// The enhancement of a lighting function ([VS-5], [VS-7]).
// Twin: reference/src/volumeshop/ghosting.rs

fn enhancement(ray: Ray, a: Attributes) -> real {
    if (!a.has_normal) {
        return 0.0;
    }
    return enhancement_of(reflectance(a.normal, ray.v).w, a.magnitude);
}
