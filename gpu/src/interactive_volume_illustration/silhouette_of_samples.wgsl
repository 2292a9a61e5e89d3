// Silhouettes of samples (4.4, [HATCH-15]).
// Twin: reference/src/interactive_volume_illustration/tone/silhouette.rs

fn shade_silhouette(ray: Ray, sample: Sample, a: Attributes, shaded: Shaded) -> Shaded {
    return black_on_silhouettes(ray, a, shaded, params.silhouette_offset);
}
