//! Faults that are planted in iso-surfaces: each must be noticed.

use crate::double::difference_with;
use crate::field::scene;

/// The smallest difference that is noticed.
const NOTICED: f64 = 1e-6;

/// An iso-surface in a volume, with further tables.
fn surface(more: &str) -> String {
    scene(
        [9, 8, 10],
        "float",
        &format!("[shading]\n[surface]\niso = 150\nlook = \"phong\"\ncolor = \"#d8b4cc\"\n{more}"),
    )
}

const CUT: &str = "[[clip]]\npoint = [4.3, 3.1, 4.2]\nnormal = [0.3, -0.3, 1]\nspace = \"index\"\n";

fn all_are_noticed(scene: &str, faults: &[(&str, &str)]) {
    for (old, new) in faults {
        let Some(difference) = difference_with(scene, (old, new)) else { return };
        println!("{new}: {difference:.1e}");
        assert!(difference > NOTICED, "{old} → {new}: {difference:e}");
    }
}

#[test]
fn faults_of_cuts_of_surfaces_are_noticed() {
    all_are_noticed(
        &surface(&format!("{CUT}cap = \"#ff3010a0\"\n")),
        &[
            ("select(over <= 0.0, over >= 0.0, OUTSIDE_IS_LOW)", "select(over >= 0.0, over <= 0.0, OUTSIDE_IS_LOW)"),
            ("if (b < 0.0 && t > kept.start) {", "if (b > 0.0 && t > kept.start) {"),
            ("        hit = kept.start;\n", "        hit = kept.start + 0.5;\n"),
            ("first_root(ray, kept.start, NO_HIT)", "first_root(ray, params.near_steps, NO_HIT)"),
            ("    cut_plane = hit_plane;\n", "    cut_plane = -1;\n"),
            ("lerp3(own.rgb, cap.rgb, cap.alpha)", "lerp3(own.rgb, cap.rgb, 1.0)"),
        ],
    );
    // A plane behind which a part of the surface lies.
    let far = CUT.replace("[0.3, -0.3, 1]", "[-0.3, 0.3, -1]");
    all_are_noticed(&surface(&far), &[("if (root <= kept.end) {", "if (root <= NO_HIT) {")]);
}

#[test]
fn faults_of_curvature_along_the_ray_at_surfaces_are_noticed() {
    let text = scene(
        [9, 8, 10],
        "float",
        "layers = [\"beauty\", \"curvature.KV\", \"first.curvature.KV\"]\n[shading]\n[surface]\niso = 150\nlook = \"phong\"\n",
    );
    all_are_noticed(
        &text,
        &[
            ("let t = hit - 1.0;", "let t = hit - 0.5;"),
            ("if (sample.offset <= 0.0 || !a.has_normal)", "if (sample.offset > 0.0 || !a.has_normal)"),
            ("a.kappa = turn_along_ray(a.normal, normal_of(g, ray.v), ray.step);", "a.kappa = 0.0;"),
        ],
    );
}

#[test]
fn faults_of_lights_of_surfaces_are_noticed() {
    let tones = "tones = [[0, \"#503020\"], [0.6, \"#ffe0c0\"]]\n";
    let toon = format!("[shading]\nmodel = \"toon\"\n[surface]\niso = 150\nlook = \"toon\"\n[surface.toon]\n{tones}");
    let with = |more: &str| scene([9, 8, 10], "float", more);
    all_are_noticed(
        &with(&toon),
        &[
            ("params.surface_toon_offset, FIRST_SURFACE_TONE, SURFACE_TONES", "params.toon_offset, 0, TONES"),
            ("Toon(surface_light(), params.surface_toon_offset", "Toon(-surface_light(), params.surface_toon_offset"),
        ],
    );
    all_are_noticed(
        &with(
            "[shading]\nmodel = \"toon\"\n[surface]\niso = 150\nlook = \"phong\"\n[surface.silhouette]\noffset = 0.3\n",
        ),
        &[
            ("        params.surface_specular,\n", "        params.surface_diffuse,\n"),
            ("params.surface_silhouette_offset);", "0.4);"),
            ("        surface_light(),\n", "        light().yxz,\n"),
        ],
    );
}
