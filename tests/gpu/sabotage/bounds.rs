//! Small faults of f32, each at one stage, exceed the bounds of pixels: no bound is so wide that it hides one.

use crate::gpu;
use crate::halo_scenes;
use crate::mesh_scenes::{self, Meshes};
use crate::object_scenes::{Files, shells};
use drypoint::gpu::Gpu;
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
    let table = "table = 256\n";
    let surface = "[surface]\niso = 134\nlook = \"phong\"\n";
    let smooth = "[surface]\niso = 134\nlook = \"phong\"\n[sampling]\nkernel = \"bspline\"\n";
    let cut =
        "[surface]\niso = 120\n[[clip]]\npoint = [12.3, 12.2, 12.1]\nnormal = [0.1, -1, 0.2]\nspace = \"index\"\n";
    let lines = "[hatching]\niso = 128\nhidden = \"merged\"\n";
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
        ("position", colors, "", "return ray.origin + ray.along * (steps * ray.depth_step@);", 1.0005),
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
        (
            "entries of a table",
            colors,
            table,
            "i = min(lerp(i, nodes[entry.node + 1].index, entry.w)@, params.last_node);",
            1.002,
        ),
        ("contrast of edges", colors, "", "if (any(apart > vec4<real>(params.contrast@))) {", 1.1),
        ("root of a cubic", colors, surface, "return cubic_at(cell_cubic, u@);", 1.001),
        ("root of a smooth kernel", colors, smooth, "return value_at(Place(cell_walk.cell, w))@ - params.iso;", 1.0005),
        ("place of a cut", colors, cut, "planes[plane].z), p) - planes[plane].offset@;", 1.002),
        (
            "share of a sample between lines",
            colors,
            lines,
            "let alpha = corrected(shaded.alpha, ratio * steps@);",
            1.001,
        ),
        ("mean depth", colors, shaded, "ray_sums.depth += w * depth@;", 1.0005),
        (
            "value of the first sample",
            colors,
            shaded,
            "ray_sums.first = FirstSample(depth, sample.s@, normal, curvature);",
            1.0005,
        ),
    ] {
        let samples = if stage == "contrast of edges" { "\"auto\"" } else { "1" };
        let text = format!(
            "drypoint = 1\n[volume]\nphantom = {{ name = \"torus\", size = 25 }}\n[picture]\nsize = [64, 48]\n\
             samples = {samples}\n[transfer]\n{function}{more}"
        );
        notice(&gpu, stage, &text, (place, fault));
    }
}

/// Checks that a fault exceeds bounds of a scene.
fn notice(gpu: &Gpu, stage: &str, text: &str, (place, fault): (&str, f64)) {
    let scene = parse(text, "scene.toml".as_ref(), &Overrides::default()).unwrap_or_else(|e| panic!("{stage}: {e}"));
    let job = Job::load(scene).unwrap_or_else(|failures| panic!("{stage}: {failures}"));
    let [old, new] = with_fault(place, fault);
    let edit = |text: String| {
        // f64 and stages are those of the shader without a fault.
        assert_eq!(text.matches(&old).count(), 1, "{stage}: {old}");
        text.replace(&old, &new)
    };
    let found = validate_edited(&job, gpu, &edit).unwrap_or_else(|failure| panic!("{stage}: {failure}"));
    let bounded = found.bounded.as_ref().unwrap_or_else(|| panic!("{stage}: {:?}", found.unbounded));
    // Colours notice it, or a layer where only layers can.
    let of_layers = found.stages.iter().filter_map(|stage| stage.share).fold(0.0, f64::max);
    let is_of_layers = ["depth", "normal", "first"].iter().any(|word| stage.contains(word));
    let share = if is_of_layers { of_layers } else { bounded.share };
    println!("{stage}, {fault}: up to {share:.1} of a bound");
    assert!(share > 1.0 && found.is_wrong(), "{stage}: the fault hides below the bounds: {share:.2}");
}

/// Faults of 0.1 % to 2 % in what objects, meshes and halos add to a picture.
#[test]
fn bounds_of_objects_meshes_and_halos_notice_small_faults() {
    let Some(gpu) = gpu() else { return };
    let (files, meshes) = (Files::new(), Meshes::new());
    let near = "move = [2, -1, 1]\nrotate = { axis = [1, 2, 0.5], angle = 30 }";
    let meet = "[[intersection]]\nobject = \"a\"\nwith = \"background\"\nopacity = \"plus\"\n";
    let moved = shells(&files.soft(near));
    let ghosted = shells(&files.soft("move = [2, 3, 1]\nghosting = 0.3"));
    let met = shells(&(files.soft(near) + meet));
    let with_meshes = mesh_scenes::scene("", &meshes.both());
    let occlusive = halo_scenes::scene("", "[[halo]]\nevery = 2\n");
    let emissive = halo_scenes::scene("", "[[halo]]\nevery = 2\nkind = \"emissive\"\n");
    for (stage, text, place, fault) in [
        ("colour of sets", &moved, "return Shaded(sum / weight@, opacity);", 1.001),
        ("opacity of sets", &moved, "opacity = either(opacity, sets[i].mu@);", 1.002),
        ("ghosting", &ghosted, "return max(1.0 - gamma@ * (2.0 - enhancement), 0.0);", 1.005),
        ("mean of two colours", &met, "return Shaded((a.rgb * a.alpha + b.rgb * b.alpha) / sum@, alpha);", 1.005),
        ("colour of a mesh", &with_meshes, "+ MESH_TRIANGLES + met_mesh)@;", 1.001),
        ("place of a mesh", &with_meshes, "    hit = found.t@;", 1.02),
        ("spreading", &occlusive, "let part = delta * f@;", 1.005),
        ("tint", &occlusive, "return tint.keep@ * rgb + tint.add;", 1.002),
        ("gradient of seeds", &occlusive, "return min(sqrt(dx * dx + dy * dy)@, 1.0);", 1.005),
        ("glow", &emissive, "return vec4<real>(front.rgb, front.opacity@);", 1.005),
    ] {
        notice(&gpu, stage, text, (place, fault));
    }
}
