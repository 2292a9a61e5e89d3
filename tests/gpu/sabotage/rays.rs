//! Faults that are planted in rays, samples and light: each must be noticed, and first at the stage that it breaks.

use crate::gpu;
use drypoint::gpu::{GpuJob, Precision};
use drypoint::job::Job;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::picture::{LayerKind, Picture};

/// Stages in the order in which they are computed.
const STAGES: [(&str, LayerKind); 5] = [
    ("value", LayerKind::First),
    ("normal", LayerKind::FirstNormal),
    ("opacity", LayerKind::Depth),
    ("mean normal", LayerKind::Normal),
    ("colour", LayerKind::Beauty),
];

/// The share of a layer's largest number by which a stage must part.
const NOTICED: f64 = 1e-6;

/// The scene; `more` are its further tables.
fn scene(more: &str) -> String {
    format!(
        "drypoint = 1\n[volume]\nphantom = {{ name = \"torus\", size = 24 }}\n[camera]\ndirection = [0.4, 1, -0.3]\n\
         [picture]\nsize = [48, 40]\nsamples = 1\nbackground = \"#203040\"\n\
         layers = [\"beauty\", \"depth\", \"first\", \"first.normal\", \"normal\"]\n\
         [transfer]\nkind = \"regular\"\nnodes = [{{ at = 90, color = \"#804020\", opacity = 0 }}, \
         {{ at = 128, color = \"#ffcc88\", opacity = 0.3 }}, {{ at = 140, color = \"#88ccff\", opacity = 0.9 }}]\n{more}"
    )
}

/// The first stage at which a picture parts from the reference's.
fn parts_at(truth: &Picture, drawn: &Picture) -> Option<&'static str> {
    STAGES.into_iter().find_map(|(stage, layer)| {
        let channels = |picture: &Picture| picture.layer(layer).unwrap().channels.concat();
        let (a, b) = (channels(truth), channels(drawn));
        let largest = a.iter().filter(|c| c.is_finite()).fold(0.0, |largest: f64, c| largest.max(c.abs()));
        let same = |(a, b): (&f64, &f64)| a == b || (a - b).abs() <= NOTICED * largest;
        (!a.iter().zip(&b).all(same)).then_some(stage)
    })
}

#[test]
fn faults_of_rays_and_light_are_noticed_at_their_stage() {
    let Some(gpu) = gpu() else { return };
    if !gpu.has_double() {
        return println!("skipped: {} has no f64", gpu.name());
    }
    let mut wrong = Vec::new();
    let phong = "[shading]\n";
    let toon = "[shading]\nmodel = \"toon\"\n[shading.silhouette]\n";
    let growing = "[shading]\nview_opacity = 0.8\n";
    let by_table = "[shading]\nmodel = \"lighting-function\"\npreset = \"metal-contours\"\nlight = [-0.6, 0.4, 0.7]\n";
    let clip = "[shading]\n[[clip]]\npoint = [11.3, 11.2, 11.1]\nnormal = [0.2, -1, 0.3]\nspace = \"index\"\ncap = \"#ff0000\"\n";
    for (more, old, new, stage) in [
        // Rays and positions.
        (phong, "(steps * ray.depth_step)", "((steps + 0.5) * ray.depth_step)", "value"),
        (phong, "ray.origin = anchor_middle() + off *", "ray.origin = anchor_middle() - off *", "value"),
        (phong, "return vec2<real>(x, -y);", "return vec2<real>(x, y);", "value"),
        (
            phong,
            "(real(k) + params.anchor_steps) * ray.depth_step",
            "(real(k) + params.anchor_steps + 1.0) * ray.depth_step",
            "opacity",
        ),
        (
            phong,
            "return all(p >= box_low()) && all(p <= box_high());",
            "return all(p >= box_low() + 6.0) && all(p <= box_high());",
            "value",
        ),
        // The field.
        (phong, "let cell = vec3<i32>(floor(", "let cell = vec3<i32>(round(", "value"),
        (
            phong,
            "return to_world_x() * g.x + to_world_y() * g.y",
            "return to_world_x() * g.y + to_world_y() * g.x",
            "normal",
        ),
        (phong, "let outward = g *", "let outward = -g *", "normal"),
        // The function.
        (phong, "return lerp3(color_of(place.node)", "return lerp3(color_of(place.node + 1)", "colour"),
        (phong, "let k = max(low - 1, 0);", "let k = max(low - 2, 0);", "opacity"),
        // Opacities and compositing.
        (phong, "corrected(shaded.alpha, ratio *", "corrected(shaded.alpha, 2.0 * ratio *", "opacity"),
        (phong, "let w = (1.0 - front.opacity) * alpha;", "let w = alpha;", "opacity"),
        (phong, "let through = 1.0 - front.opacity;", "let through = front.opacity;", "colour"),
        (phong, "if (front.opacity >= params.stop_at)", "if (front.opacity >= 0.7 * params.stop_at)", "opacity"),
        // Light.
        (phong, "lit.ambient + lit.diffuse * n_l", "lit.ambient - lit.diffuse * n_l", "colour"),
        (phong, "let n_l = dot(n, lit.light);", "let n_l = dot(n, -lit.light);", "colour"),
        (phong, "pow_whole(n_h, u32(lit.shininess))", "pow_whole(n_h, u32(lit.shininess) + 1u)", "colour"),
        (toon, "if (!(x > tones[i].at))", "if (x > tones[i].at)", "colour"),
        (toon, "dot(n, lit.light) + lit.offset", "dot(n, lit.light) + lit.offset + 0.1", "colour"),
        (toon, "n_dot_v * n_dot_v + offset <= 0.5", "n_dot_v + offset <= 0.5", "colour"),
        (
            growing,
            "(1.0 / min(max(abs(n_dot_v), 0.015625), 1.0) - 1.0)",
            "(1.0 / min(max(abs(n_dot_v), 0.015625), 1.0))",
            "opacity",
        ),
        // Lighting functions: a column's place, a row's side, the row below, eq. 8.
        (by_table, "texel_cell((x + 1.0) *", "texel_cell((x + 1.01) *", "opacity"),
        (by_table, "texel_cell((1.0 - y) *", "texel_cell((1.0 + y) *", "opacity"),
        (by_table, "lighting_row(below, column.w)", "lighting_row(at, column.w)", "opacity"),
        (by_table, "s_alpha + (1.0 - magnitude)", "s_alpha + magnitude", "opacity"),
        (by_table, "(s.x + s.y) + s.z", "(s.x - s.y) + s.z", "colour"),
        // Clip planes.
        (clip, "p) - planes[plane].offset", "p) + planes[plane].offset", "value"),
        (clip, "if (beyond(i, p) > 0.0)", "if (beyond(i, p) > 1.0)", "value"),
        (clip, "select(n, -n, dot(n, ray.v) < 0.0)", "select(n, -n, dot(n, ray.v) > 0.0)", "normal"),
        (clip, "shaded.alpha * planes[cut_plane].opacity", "shaded.alpha * 0.5", "opacity"),
        (clip, "clamp(crossing, real(cut_k - 1), real(cut_k))", "real(cut_k)", "value"),
        // Layers.
        (phong, "ray_sums.normal += w * normal;", "ray_sums.normal += alpha * normal;", "mean normal"),
        (
            phong,
            "ray_sums.half == NOWHERE && ray_sums.opacity >= 0.5",
            "ray_sums.half == NOWHERE && ray_sums.opacity >= 0.6",
            "opacity",
        ),
    ] {
        let scene = parse(&scene(more), "scene.toml".as_ref(), &Overrides::default()).unwrap_or_else(|e| panic!("{e}"));
        let job = Job::load(scene).unwrap_or_else(|failures| panic!("{failures}"));
        let (truth, _) = job.renderer().unwrap_or_else(|failure| panic!("{failure}")).frame(&|_| ());
        let drawn = GpuJob::new(&job, &gpu, Precision::Double).unwrap_or_else(|failure| panic!("{failure}"));
        let edit = |text: String| {
            assert!(text.contains(old), "{old}");
            text.replacen(old, new, 1)
        };
        let picture = drawn.edited(&edit).unwrap_or_else(|failure| panic!("{new}: {failure}")).frame(&|_| ());
        let picture = picture.unwrap_or_else(|error| panic!("{error}"));
        let found = parts_at(&truth, &picture);
        println!("{new}: {found:?}");
        wrong.extend((found != Some(stage)).then(|| format!("{old} → {new}: {found:?}, not {stage}")));
    }
    assert_eq!(wrong, [""; 0]);
}
