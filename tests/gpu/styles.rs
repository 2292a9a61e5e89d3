//! Style transfer functions (Bruckner and Gröller 2007): shaders in f64 equal the reference to 10⁻⁹.

use crate::double::agrees;

/// A torus of a few styles, one of them translucent, in perspective.
const TORUS: &str = r##"
drypoint = 1
[volume]
phantom = { name = "torus", size = 32 }
[picture]
size = [64, 48]
samples = 1
background = "#203040"
"##;

/// The nodes of most scenes.
const NODES: &str = r##"nodes = [{ at = 100, style = "wax", opacity = 0 }, { at = 124, style = "glass", opacity = 0.35 },
         { at = 128, style = "metal", opacity = 0.8 }, { at = 140, style = "bone", opacity = 1 }]
"##;

/// Waves that rays go in and out of, at all strengths of the gradient.
const WAVES: &str = r##"
drypoint = 1
[volume]
phantom = { name = "marschner-lobb", size = 24 }
[picture]
size = [48, 40]
samples = 1
"##;

/// Their nodes: layers with gaps between them, whose borders are gradual or steps.
const LAYERS: &str = r##"unit = "normalized"
nodes = [{ at = 0.1, style = "wax", opacity = 0.02 }, { at = 0.3, style = "glass", opacity = 0 },
         { at = 0.45, style = "glass", opacity = 0 }, { at = 0.45, style = "ink", opacity = 0.2 },
         { at = 0.6, style = "metal", opacity = 0.05 }, { at = 0.6, style = "metal", opacity = 0 },
         { at = 0.8, style = "wax", opacity = 0 }, { at = 0.9, style = "bone", opacity = 0.1 }]
"##;

/// A scene of further tables and of keys of `[transfer]`: a torus or waves.
pub(crate) fn scene(waves: bool, transfer: &str, tables: &str) -> String {
    let (volume, nodes) = if waves { (WAVES, LAYERS) } else { (TORUS, NODES) };
    let nodes = if transfer.contains("nodes") { "" } else { nodes };
    format!("{volume}[transfer]\n{transfer}\n{nodes}{tables}")
}

/// Compares scenes of a torus and of waves.
fn check(scenes: &[(&str, &str, &str)]) {
    for (name, transfer, tables) in scenes {
        for (volume, waves) in [("torus", false), ("waves", true)] {
            agrees(&format!("{name}, {volume}"), &scene(waves, transfer, tables));
        }
    }
}

#[test]
fn lookups_of_styles() {
    check(&[
        ("plain", "", ""),
        ("printed mix", "mix = \"printed\"", ""),
        ("frame of the view", "sphere_frame = \"view\"", ""),
        ("orthographic", "", "[camera]\nprojection = \"orthographic\"\n"),
        ("plain transparency", "transparency = \"plain\"", ""),
        ("table", "table = 64", ""),
        ("facing", "", "[sampling]\nnormal = \"facing\"\n"),
        ("encoded", "", "[sampling]\nstep_along = \"ray\"\n"),
        // Two nodes of one style: the index function; a step; one node.
        (
            "index",
            "nodes = [{ at = 110, style = \"wax\", opacity = 0.1 }, { at = 124, style = \"glass\", opacity = 0.3 },
                      { at = 128, style = \"wax\", opacity = 0.3 }, { at = 128, style = \"ink\", opacity = 0.6 }]",
            "",
        ),
        ("one node", "nodes = [{ at = 110, style = \"glass\", opacity = 0.1 }]", ""),
    ]);
}

#[test]
fn contours() {
    let contours = |more: &str| format!("[contours]\nthickness = \"1.5 voxels\"\n{more}");
    let all = [
        ("ray", contours("")),
        ("constant", contours("kappa = \"none\"\nthreshold = 0.4\n")),
        ("fade", contours("fade = [0.2, 0.8]\n")),
        ("step", contours("fade = [0.5, 0.5]\n")),
        ("facing", contours("[sampling]\nnormal = \"facing\"\n")),
        ("literal", contours("sign_flip = \"literal\"\n[sampling]\nnormal = \"facing\"\n")),
        ("shells", contours("[sampling]\nstep_along = \"ray\"\n")),
        // Normals that are flipped towards the eye from one sample to the next.
        ("wide steps", contours("[sampling]\nnormal = \"facing\"\nstep = \"2 voxels\"\n")),
    ];
    let scenes: Vec<(&str, &str, &str)> = all.iter().map(|(name, tables)| (*name, "", tables.as_str())).collect();
    check(&scenes);
}

#[test]
fn mip_maps_of_styles() {
    check(&[
        ("mip-maps", "", "[style_mipmaps]\n"),
        ("biased", "", "[style_mipmaps]\ngradient_bias = 3\ncurvature_bias = 4\n[contours]\n"),
        ("orthographic", "", "[style_mipmaps]\nturn = 0.3\n[camera]\nprojection = \"orthographic\"\n"),
        ("no turn", "", "[style_mipmaps]\nturn = 0\ngradient_bias = 0\ncurvature_bias = 0\n"),
    ]);
}

/// Layers of a picture of styles; κ along the ray of samples that no contour asks for.
#[test]
fn layers_of_styles() {
    for (name, tables) in [
        ("layers", ""),
        ("layers and contours", "[contours]\n"),
        (
            "layers and a cut",
            "[contours]\n[[clip]]\npoint = [12, 13, 14]\nnormal = [1, 0.3, -0.2]\nspace = \"index\"\n",
        ),
    ] {
        for waves in [false, true] {
            let scene = scene(waves, "", tables).replace(
                "samples = 1\n",
                "samples = 1\nlayers = [\"beauty\", \"normal\", \"curvature.KV\", \"first.curvature.KV\", \"Z\"]\n",
            );
            agrees(&format!("{name}, waves {waves}"), &scene);
        }
    }
}

/// A cut in a style.
pub(crate) fn cut(style: &str) -> String {
    format!("[[clip]]\npoint = [14, 13, 14]\nnormal = [1, -0.2, 0.4]\nspace = \"index\"\nstyle = \"{style}\"\n")
}

/// Cuts in a style, of styles and of colours.
#[test]
fn styles_of_cuts() {
    let (opaque, clear) = (cut("engraving"), cut("glass"));
    let colors = "kind = \"regular\"\nnodes = [{ at = 100, color = \"#804020\", opacity = 0.1 }, { at = 140, color = \"#88ccff\", opacity = 0.9 }]";
    check(&[
        ("cut", "", &opaque),
        ("cut and contours", "", &format!("{clear}[contours]\n")),
        ("cut of colours", colors, &clear),
        ("cut in the frame of the view", "sphere_frame = \"view\"", &clear),
        ("cut with mip-maps", "", &format!("{opaque}[style_mipmaps]\n")),
    ]);
}
