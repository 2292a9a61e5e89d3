// Silhouettes of samples (4.4, [HATCH-15]).

fn shade_silhouette(ray: Ray, sample: Sample, a: Attributes, shaded: Shaded) -> Shaded {
    return black_on_silhouettes(ray, a, shaded, params.silhouette_offset);
}
