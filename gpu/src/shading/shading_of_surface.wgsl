// An iso-surface by Blinn-Phong, with numbers of its own ([HATCH-14]).
// Twin: reference/src/shading.rs

fn shade_surface_by_phong(ray: Ray, sample: Sample, a: Attributes, shaded: Shaded) -> Shaded {
    let lit = Phong(
        surface_light(),
        params.surface_ambient,
        params.surface_diffuse,
        params.surface_specular,
        params.surface_shininess,
        SURFACE_WHOLE_SHININESS,
    );
    return shaded_by_phong(ray, a, shaded, lit);
}
