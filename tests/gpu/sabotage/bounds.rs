//! Small faults of f32, each at one stage, exceed the bounds of pixels: no bound is so wide that it hides one.

use crate::gpu;
use drypoint::job::Job;
use drypoint::scene::file::{Overrides, parse};
use drypoint::validate::validate_edited;

/// Numbers of a shader with a relative fault: in the text, @ stands for it.
fn with_fault(place: &str, fault: f64) -> [String; 2] {
    [place.replace('@', ""), place.replace('@', &format!(" * {fault}"))]
}

/// Relative faults of 0.05 % to 5 %: f32 rounds by 6·10⁻⁸, and pixels of these scenes have bounds around 10⁻⁴.
#[test]
fn bounds_notice_small_faults() {
    let Some(gpu) = gpu() else { return };
    let colors = "kind = \"regular\"\nnodes = [{ at = 100, color = \"#804020\", opacity = 0 }, \
                  { at = 128, color = \"#ffcc88\", opacity = 0.3 }, { at = 140, color = \"#88ccff\", opacity = 0.9 }]\n";
    let shaded = "[shading]\n";
    let styles = "nodes = [{ at = 100, style = \"wax\", opacity = 0 }, { at = 140, style = \"wax\", opacity = 0.5 }]\n";
    let contours = "[contours]\nthickness = \"1 voxel\"\n";
    for (stage, function, more, place, fault) in [
        ("value", colors, "", "sample.s = value_at(sample.at)@;", 1.001),
        ("place between nodes", colors, "", "let w = (s - nodes[k].at) / nodes[k].width@;", 1.002),
        (
            "colour between nodes",
            colors,
            "",
            "return lerp3(color_of(place.node), color_of(place.node + 1), place.w@);",
            1.01,
        ),
        ("opacity of a step", colors, "", "return one_minus_exp(ratio * ln_one_minus(alpha)@);", 1.001),
        ("colours over each other", colors, "", "return Front(front.rgb + w * rgb@, front.opacity + w);", 1.001),
        ("position", colors, "", "return ray.origin + ray.along * (real(k) * ray.depth_step@);", 1.0005),
        ("light", colors, shaded, "let n_l = dot(n, lit.light)@;", 1.002),
        ("highlight", colors, shaded, "let n_h = max(dot(n, sum) / length@, 0.0);", 1.002),
        ("place on a sphere", styles, "", "let half_side = real(side) * 0.5@;", 1.002),
        (
            "curvature",
            styles,
            contours,
            "return angle(sqrt(dot(sine, sine)), turn_cosine(dot(n, before))) / way@;",
            1.05,
        ),
    ] {
        let text = format!(
            "drypoint = 1\n[volume]\nphantom = {{ name = \"torus\", size = 25 }}\n[picture]\nsize = [64, 48]\nsamples = 1\n\
             [transfer]\n{function}{more}"
        );
        let scene =
            parse(&text, "scene.toml".as_ref(), &Overrides::default()).unwrap_or_else(|e| panic!("{stage}: {e}"));
        let job = Job::load(scene).unwrap_or_else(|failures| panic!("{stage}: {failures}"));
        let [old, new] = with_fault(place, fault);
        let edit = |text: String| {
            // f64 and stages are those of the shader without a fault.
            assert_eq!(text.matches(&old).count(), 1, "{stage}: {old}");
            text.replace(&old, &new)
        };
        let found = validate_edited(&job, &gpu, &edit).unwrap_or_else(|failure| panic!("{stage}: {failure}"));
        let bounded = found.bounded.unwrap_or_else(|| panic!("{stage}: {:?}", found.unbounded));
        println!("{stage}, {fault}: {} pixels over, up to {:.1} of their bound", bounded.exceeded, bounded.share);
        assert!(bounded.exceeded > 0, "{stage}: the fault hides below the bounds: {:.2}", bounded.share);
    }
}
