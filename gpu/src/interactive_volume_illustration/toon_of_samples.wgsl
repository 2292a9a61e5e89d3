// Samples in tones (4.4, [HATCH-15]).
// Twin: reference/src/interactive_volume_illustration/tone/toon.rs

fn shade_toon(ray: Ray, sample: Sample, a: Attributes, shaded: Shaded) -> Shaded {
    return shaded_in_tones(ray, a, shaded, Toon(light(), params.toon_offset, 0, TONES));
}
