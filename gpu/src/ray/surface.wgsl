// The iso-surface, at which a ray ends ([HATCH-14]).
// Glue: Ends of rays.

// Composites the surface, of opacity 1, at its own depth.
fn meet_surface(ray: Ray, seen: Front) -> Front {
    if (hit >= NO_HIT || seen.opacity >= params.stop_at) {
        return seen;
    }
    var sample: Sample;
    sample.k = last_before_surface();
    sample.offset = hit - real(sample.k);
    sample.position = min(max(ray.origin + ray.along * (hit * ray.depth_step), box_low()), box_high());
    sample.at = locate(sample.position);
    sample.s = params.iso;
    let attributes = measured_rest(ray, sample, measured_first(ray, sample));
    let shaded = on_surface(ray, sample, attributes, Shaded(surface_rgb(), 1.0));
    collect(ray, sample, attributes, 1.0);
    return opaque_behind(seen, in_blend_space(shaded.rgb));
}
