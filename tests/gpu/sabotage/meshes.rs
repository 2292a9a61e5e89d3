//! Faults that are planted in meshes: each must be noticed.

use crate::double::{difference_among_with, difference_with};
use crate::gpu;
use crate::lines::lines;
use crate::meshes::{LAYERS, Meshes, alone_beside_an_object, rays_unmet, scene};
use drypoint::gpu::Precision;

/// The smallest difference that is noticed.
const NOTICED: f64 = 1e-6;

#[test]
fn faults_of_meshes_are_noticed() {
    let meshes = Meshes::new();
    let both = scene(LAYERS, &format!("[shading]\n{}", meshes.both()));
    let surface = scene(
        LAYERS,
        &format!("[shading]\n[surface]\niso = 150\nlook = \"phong\"\ncolor = \"#d8b4cc\"\n{}", meshes.both()),
    );
    for (text, old, new) in [
        (&both, "if (size.z > size[z]) {", "if (size.z < size[z]) {\n        return ShearedRay();"),
        (&both, "let weights = areas / sum;", "let weights = areas.yzx / sum;"),
        (&both, "any(areas < vec3<real>()) && any", "any"),
        (&both, "            i = behind;\n", "            i++;\n            if (i < behind) { i = behind + 1; }\n"),
        (&both, "let is_nearer = found.t < best.t ||", "let is_nearer = found.t > best.t ||"),
        (&both, "2 * MESH_BOXES + 4 * triangle + word", "2 * MESH_BOXES + 4 * triangle + (word & 1)"),
        (&both, "mesh_vector(MESH_VERTICES + triangle_word(found.triangle, corner))", "mesh_normal"),
        (&both, "2 * MESH_VERTICES + MESH_TRIANGLES + met_mesh", "2 * MESH_VERTICES + MESH_TRIANGLES"),
        (&both, "sample.s = params.mesh_value;", "sample.s = params.mesh_value + 0.01;"),
        (&both, "        params.mesh_specular,\n", "        params.mesh_diffuse,\n"),
        (&both, "        mesh_light(),\n", "        light().yxz,\n"),
        (
            &surface,
            "min(hit, FARTHEST_MESH));\n    if (found.triangle < 0 || found.t >= hit) {",
            "FARTHEST_MESH);\n    if (found.triangle < 0) {",
        ),
        (&surface, "    met_mesh = -1;\n", "    met_mesh = 0;\n"),
    ] {
        let Some(difference) = difference_with(text, (old, new)) else { return };
        println!("{new}: {difference:.1e}");
        assert!(difference > NOTICED, "{old} → {new}: {difference:e}");
    }
    let alone = alone_beside_an_object(&meshes);
    let run = "fn all_left(ray: Ray, run: vec2<i32>) -> vec2<i32> {\n    var left = ";
    let fault = (&*format!("{run}run;"), &*format!("{run}no_samples(ray, run);"));
    let Some(difference) = difference_with(&alone, fault) else { return };
    assert!(difference > NOTICED, "{difference:e}");
    let text = crate::lines::scene("samples = 1", &format!("[shading]\n{}", meshes.both()));
    let fault = ("!(fragments[end_line - 1].t < hit)", "!(fragments[end_line - 1].t < hit + 20.0)");
    let Some(difference) = difference_among_with(&text, lines, Some(fault)) else { return };
    assert!(difference > NOTICED, "{difference:e}");
}

#[test]
fn faults_of_meshes_under_halos_are_noticed() {
    let meshes = Meshes::new();
    let text = scene("", &format!("[[halo]]\nevery = 3\n{}", meshes.both()));
    let fault =
        ("return select(last_before_surface() + 1, NO_PLANE", "return select(last_before_surface() + 9, NO_PLANE");
    let Some(difference) = difference_with(&text, fault) else { return };
    assert!(difference > NOTICED, "{difference:e}");
}

/// Triangles without their edges: rays of the middle row and of the middle column pass.
#[test]
fn holes_between_triangles_are_noticed() {
    let Some(gpu) = gpu() else { return };
    let (old, new) = ("any(areas > vec3<real>())", "any(areas >= vec3<real>())");
    let edit = |text: String| {
        assert_eq!(text.matches(old).count(), 1);
        text.replace(old, new)
    };
    assert_eq!(rays_unmet(&gpu, Precision::Single, &edit), 2 * 255 - 1);
}
