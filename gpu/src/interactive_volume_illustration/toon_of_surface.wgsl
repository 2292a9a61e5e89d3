// An iso-surface in tones of its own (4.4, [HATCH-15]).
// Twin: reference/src/interactive_volume_illustration/tone/toon.rs

fn shade_surface_by_toon(ray: Ray, sample: Sample, a: Attributes, shaded: Shaded) -> Shaded {
    let lit = Toon(surface_light(), params.surface_toon_offset, FIRST_SURFACE_TONE, SURFACE_TONES);
    return shaded_in_tones(ray, a, shaded, lit);
}
