//! Pictures in f32 within their derived bounds, effect by effect.

use crate::gpu;
use drypoint::job::Job;
use drypoint::scene::file::{Overrides, parse};
use drypoint::validate::{Verdict, validate};

/// The largest share of pixels at a decision or without a finite bound.
const MOST_UNDECIDED: f64 = 0.02;

#[test]
fn every_effect_keeps_its_bounds() {
    let Some(gpu) = gpu() else { return };
    let colors = "kind = \"regular\"\nnodes = [{ at = 100, color = \"#804020\", opacity = 0 }, \
                  { at = 128, color = \"#ffcc88\", opacity = 0.3 }, { at = 140, color = \"#88ccff\", opacity = 0.9 }]\n";
    let styles = "nodes = [{ at = 100, style = \"wax\", opacity = 0 }, { at = 140, style = \"wax\", opacity = 0.5 }]\n";
    for (name, function, more) in [
        ("colours", colors, ""),
        ("Phong", colors, "[shading]\n"),
        ("orthographic", colors, "[shading]\n[camera]\nprojection = \"orthographic\"\n"),
        ("shells", colors, "[shading]\n[sampling]\nstep_along = \"ray\"\n"),
        ("tones and silhouettes", colors, "[shading]\nmodel = \"toon\"\n[shading.silhouette]\n"),
        ("view-dependent opacity", colors, "[shading]\nview_opacity = 0.7\n"),
        (
            "a cut",
            colors,
            "[shading]\n[[clip]]\npoint = [12.3, 12.2, 12.1]\nnormal = [0.1, -1, 0.2]\nspace = \"index\"\n",
        ),
        ("a smooth kernel", colors, "[shading]\n[sampling]\nkernel = \"bspline-smooth\"\ngradient = \"sobel\"\n"),
        ("styles", styles, ""),
        ("contours", styles, "[contours]\nthickness = \"1 voxel\"\n"),
        ("contours of exact κ", styles, "[contours]\nthickness = \"1 voxel\"\nkappa = \"exact\"\n"),
        ("mip-maps", styles, "[contours]\nthickness = \"1 voxel\"\n[style_mipmaps]\n"),
    ] {
        let text = format!(
            "drypoint = 1\n[volume]\nphantom = {{ name = \"torus\", size = 25 }}\n[picture]\nsize = [64, 48]\nsamples = 1\n\
             [transfer]\n{function}{more}"
        );
        let scene =
            parse(&text, "scene.toml".as_ref(), &Overrides::default()).unwrap_or_else(|e| panic!("{name}: {e}"));
        let job = Job::load(scene).unwrap_or_else(|failures| panic!("{name}: {failures}"));
        let found = validate(&job, &gpu).unwrap_or_else(|failure| panic!("{name}: {failure}"));
        println!("{name}\n{found}");
        assert_eq!(found.verdict(), Verdict::Kept, "{name}: {found}");
        let bounded = found.bounded.unwrap_or_else(|| panic!("{name}: {:?}", found.unbounded));
        assert!(bounded.undecided + bounded.endless <= MOST_UNDECIDED, "{name}: {:?}", bounded.decisions);
    }
}
