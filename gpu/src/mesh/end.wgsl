// Meshes as surfaces at which rays end ([VS-12]).
// Glue: The end of a ray at a mesh.

// The mesh at which the ray ends, -1 for none, and its normal there on the side of the eye, 0 for none.
var<private> met_mesh: i32;
var<private> mesh_normal: vec3<real>;

// Ends the ray at the nearest mesh, where it lies before the iso-surface.
fn find_mesh(ray: Ray) {
    met_mesh = -1;
    let found = nearest_triangle(ray, max(params.near_steps, -FARTHEST_MESH), min(hit, FARTHEST_MESH));
    if (found.triangle < 0 || found.t >= hit) {
        return;
    }
    hit = found.t;
    met_mesh = triangle_word(found.triangle, 3);
    var sum = vec3<real>();
    for (var corner = 0; corner < 3; corner++) {
        sum += mesh_vector(MESH_VERTICES + triangle_word(found.triangle, corner)) * found.weights[corner];
    }
    mesh_normal = seen_normal(mesh_vector(2 * MESH_VERTICES + found.triangle), sum, ray.v);
}

// Composites the mesh, of opacity 1, at its own depth. It has no value, gradient or curvature: in layers they are 0.
fn meet_mesh(ray: Ray, seen: Front) -> Front {
    if (met_mesh < 0 || seen.opacity >= params.stop_at) {
        return seen;
    }
    var sample: Sample;
    sample.k = last_before_surface();
    sample.offset = hit - real(sample.k);
    sample.s = params.mesh_value;
    var a: Attributes;
    a.has_normal = any(mesh_normal != vec3<real>());
    a.normal = mesh_normal;
    let rgb = mesh_vector(2 * MESH_VERTICES + MESH_TRIANGLES + met_mesh);
    let shaded = shade_mesh(ray, a, Shaded(rgb, 1.0));
    collect(ray, sample, a, 1.0);
    return opaque_behind(seen, in_blend_space(shaded.rgb));
}
