// Meshes by Blinn-Phong ([VS-12]).
// Twin: reference/src/shading.rs

fn shade_mesh(ray: Ray, a: Attributes, shaded: Shaded) -> Shaded {
    let lit = Phong(
        mesh_light(),
        params.mesh_ambient,
        params.mesh_diffuse,
        params.mesh_specular,
        params.mesh_shininess,
        MESH_WHOLE_SHININESS,
    );
    return shaded_by_phong(ray, a, shaded, lit);
}
