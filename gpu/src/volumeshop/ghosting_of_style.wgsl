// The enhancement of illustrative styles: boundaries and contours ([VS-7]).
// Twin: reference/src/volumeshop/ghosting.rs

fn enhancement(ray: Ray, a: Attributes) -> real {
    if (!a.has_normal) {
        return 0.0;
    }
    return enhancement_of(max(abs(dot(a.normal, ray.v)) - contour_threshold(a), 0.0), a.magnitude);
}
