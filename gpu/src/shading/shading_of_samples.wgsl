// Samples by Blinn-Phong ([STF-11]).
// Twin: reference/src/shading.rs

fn shade_phong(ray: Ray, sample: Sample, a: Attributes, shaded: Shaded) -> Shaded {
    let lit = Phong(light(), params.ambient, params.diffuse, params.specular, params.shininess, WHOLE_SHININESS);
    return shaded_by_phong(ray, a, shaded, lit);
}
