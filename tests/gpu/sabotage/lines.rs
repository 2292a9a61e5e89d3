//! Faults that are planted in lines inside the volume: each must be noticed.

use crate::double::difference_among_with;
use crate::lines::{lines, scene};

#[test]
fn faults_of_lines_are_noticed() {
    let text = scene("samples = 2", "[shading]\n");
    let surface = scene("samples = 1", "[shading]\n[surface]\niso = 150\nlook = \"phong\"\n");
    let covering = scene("samples = 1\nlayers = [\"part0\"]", "[shading]\n");
    for (text, old, new) in [
        (&text, "var start = real(sample.k) - 0.5;", "var start = real(sample.k);"),
        (&text, "ratio, t - start);", "ratio, 1.0);"),
        (&text, "ratio, until - start);", "ratio, 1.0);"),
        (&text, "fragments[next_line].t <= start", "fragments[next_line].t <= start + 1.0"),
        (
            &text,
            "let rgb = in_blend_space(vec3<real>(line.r, line.g, line.b));",
            "let rgb = vec3<real>(line.g, line.r, line.b);",
        ),
        (&text, "let ray = pixel * rays_across() + within;", "let ray = pixel * rays_across() + within.yx;"),
        (&text, "front = meet_line(front);", "next_line++;"),
        (&covering, "through_lines *= 1.0 - line.opacity;", ""),
        (&surface, "!(fragments[end_line - 1].t < hit)", "!(fragments[end_line - 1].t < hit + 2.0)"),
    ] {
        let Some(difference) = difference_among_with(text, lines, Some((old, new))) else { return };
        println!("{new}: {difference:.1e}");
        assert!(difference > 1e-6, "{old} → {new}: {difference:e}");
    }
}
