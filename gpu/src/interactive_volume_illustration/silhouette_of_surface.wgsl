// Silhouettes of an iso-surface, with an offset of its own (4.4, [HATCH-15]).
// Twin: reference/src/interactive_volume_illustration/tone/silhouette.rs

fn shade_surface_silhouette(ray: Ray, sample: Sample, a: Attributes, shaded: Shaded) -> Shaded {
    return black_on_silhouettes(ray, a, shaded, params.surface_silhouette_offset);
}
