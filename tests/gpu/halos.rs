//! Volumetric halos (Bruckner and Gröller 2007): shaders in f64 equal the reference to 10⁻⁹.

use crate::double::differences;

/// A torus seen from the side, so that it lies before itself.
const TORUS: &str = r##"
drypoint = 1
[volume]
phantom = { name = "torus", size = 32 }
[camera]
direction = [0.3, 1, -0.4]
[picture]
size = [64, 48]
PICTURE
[transfer]
kind = "regular"
nodes = [{ at = 100, color = "#804020", opacity = 0 }, { at = 128, color = "#ffcc88", opacity = 0.3 },
         { at = 140, color = "#88ccff", opacity = 0.9 }]
[shading]
"##;

/// Scenes of a torus with further tables, and keys in the place of `samples`.
fn scene(picture: &str, tables: &str) -> String {
    let samples = if picture.contains("samples") { "" } else { "samples = 1\n" };
    let background = if picture.contains("background") { "" } else { "background = \"#d0c8b0\"\n" };
    TORUS.replace("PICTURE\n", &format!("{samples}{background}{picture}\n")) + tables
}

/// Compares scenes: a name, keys of the picture, further tables.
fn check(scenes: &[(&str, &str, &str)]) {
    for (name, picture, tables) in scenes {
        let Some(found) = differences(&scene(picture, tables)) else { return };
        println!("{name}: f64 {:.1e}, f32 {:.1e}", found[0], found[1]);
        assert!(found[0] < 1e-9, "{name}: {found:?}");
    }
}

#[test]
fn one_occlusive_halo() {
    check(&[("occlusive", "", "[[halo]]\n")]);
}

#[test]
fn emissive_halos() {
    check(&[
        ("emissive", "", "[[halo]]\nkind = \"emissive\"\n"),
        ("emissive, M = 4", "", "[[halo]]\nkind = \"emissive\"\nevery = 4\n"),
        ("encoded", "blend_space = \"srgb\"", "[[halo]]\nkind = \"emissive\"\n[[halo]]\nseed.by = \"curvature\"\n"),
        ("coarse", "", "[[halo]]\nkind = \"emissive\"\nevery = 3\n[sampling]\nstep = \"0.8 voxel\"\n"),
    ]);
}

#[test]
fn groups_of_planes() {
    check(&[
        ("M = 2", "", "[[halo]]\nevery = 2\n"),
        ("M = 4, mean", "", "[[halo]]\nevery = 4\naccumulate = \"mean\"\n"),
        ("M = 7, maximum", "", "[[halo]]\nkind = \"emissive\"\nevery = 7\naccumulate = \"max\"\n"),
        (
            "groups that end apart",
            "",
            "[[halo]]\nevery = 3\n[[halo]]\nkind = \"emissive\"\nevery = 4\n[[halo]]\nkind = \"emissive\"\n",
        ),
    ]);
}

/// Five halos of both kinds: more than a vector of the images has channels.
pub(crate) const FIVE: &str = r##"
[[halo]]
name = "rim"
kind = "emissive"
seed.by = "curvature"
profile = [{ at = 0.1, color = "white", opacity = 0 }, { at = 0.3, color = "white" }]
[[halo]]
name = "shade"
seed = { by = "curvature", thickness = "2 voxels" }
profile = [{ at = 0, color = "black", opacity = 0 }, { at = 1, color = "black", opacity = 0.9 }]
tints = ["rim", "glow"]
[[halo]]
exponents = [0.5, 3]
profile = [{ at = 0, color = "red", opacity = 0.1 }, { at = 0.5, color = "blue", opacity = 0.8 }]
opacity = 0.5
spread = { passes = 2, delta = 0.95 }
[[halo]]
name = "glow"
kind = "emissive"
exponents = "printed"
spread = { passes = 3, from = "seeds" }
[[halo]]
spread = { passes = 0, delta = 0.7 }
seed.value = [[90, 0], [128, 1], [150, 0.5]]
"##;

#[test]
fn several_halos() {
    check(&[
        (
            "two occlusive ones",
            "",
            "[[halo]]\nprofile = [{ at = 0, color = \"red\", opacity = 0.5 }]\n[[halo]]\nseed.by = \"curvature\"\n",
        ),
        ("five", "", FIVE),
        ("five, encoded", "blend_space = \"srgb\"", FIVE),
    ]);
}

#[test]
fn seeds_of_halos() {
    check(&[
        ("printed exponents", "", "[[halo]]\nexponents = \"printed\"\n"),
        ("exponents", "", "[[halo]]\nexponents = [0.7, 4]\n"),
        ("no exponents", "", "[[halo]]\nexponents = [0, 0]\n"),
        ("curvature", "", "[[halo]]\nseed.by = \"curvature\"\n"),
        (
            "curvature from Hessians",
            "",
            "[[halo]]\nseed = { by = \"curvature\", thickness = \"2 voxels\" }\n[contours]\nkappa = \"exact\"\n",
        ),
        ("nodes", "", "[[halo]]\nseed.value = [[100, 0], [128, 1], [128, 0.5], [150, 0]]\n"),
        ("every value", "", "[[halo]]\nseed.by = \"curvature\"\nseed.value = [[0, 1]]\n"),
        ("direction", "", "[[halo]]\nseed.direction = { toward = 135, width = 90, softness = 40 }\n"),
        ("direction without softness", "", "[[halo]]\nseed.direction = { toward = -20, width = 120, softness = 0 }\n"),
        ("focus", "", "[[halo]]\nseed.focus = { at = [[20, 10, 15]], inner = 4, falloff = 8 }\n"),
        (
            "polyline",
            "",
            "[[halo]]\nkind = \"emissive\"\nseed.focus = { at = [[5, 6, 7], [20, 10, 15], [20, 30, 15]], inner = 2, falloff = 5 }\n",
        ),
        ("focus with a step", "", "[[halo]]\nseed.focus = { at = [[20, 10, 15]], inner = 7, falloff = 0 }\n"),
        ("no floor", "", "[[halo]]\nfloor = 0\n"),
    ]);
}

#[test]
fn spreading_of_halos() {
    check(&[
        ("seeds", "", "[[halo]]\nspread.from = \"seeds\"\n"),
        ("median", "", "[[halo]]\nspread.median = true\nexponents = [0.2, 2]\n"),
        (
            "median of one of two",
            "",
            "[[halo]]\nspread.median = true\nexponents = [0.2, 2]\n[[halo]]\nkind = \"emissive\"\n",
        ),
        ("delta 1", "", "[[halo]]\nspread.delta = 1\n"),
        ("reach", "", "[[halo]]\nspread.reach = \"31 %\"\n"),
        ("short reach", "", "[[halo]]\nspread.reach = \"5 %\"\n"),
        ("print", "dpi = 300", "[[halo]]\nspread.reach = \"3 mm\"\n"),
        ("four rays", "samples = 2", "[[halo]]\n[[halo]]\nkind = \"emissive\"\n"),
        ("automatic rays", "samples = \"auto\"", "[[halo]]\n"),
        ("nine rays and reach", "samples = 3", "[[halo]]\nspread.reach = \"11 %\"\nkind = \"emissive\"\n"),
    ]);
}

#[test]
fn halos_beside_other_effects() {
    let layers = "layers = [\"beauty\", \"halo0\", \"Z\", \"normal\", \"gradient\", \"depth\", \"first\", \"first.normal\", \"halo1\"]";
    check(&[
        ("layers", layers, "[[halo]]\n[[halo]]\nkind = \"emissive\"\nevery = 2\n"),
        ("layers of four rays", &format!("samples = 2\n{layers}"), "[[halo]]\n[[halo]]\nkind = \"emissive\"\n"),
        (
            "cut",
            "",
            "[[halo]]\nseed.by = \"curvature\"\n[[halo]]\nkind = \"emissive\"\n[[clip]]\npoint = [15, 15, 15]\nnormal = [0.2, -1, 0]\nspace = \"index\"\ncap = \"#ff3010c0\"\n",
        ),
        ("no background", "background = \"none\"", "[[halo]]\nkind = \"emissive\"\n"),
        ("silhouettes", "", "[[halo]]\n[shading.silhouette]\n"),
        (
            "kernel",
            "",
            "[[halo]]\nseed.by = \"curvature\"\n[sampling]\nkernel = \"bspline-smooth\"\ngradient = \"sobel\"\n",
        ),
        ("surface", "", "[[halo]]\n[[halo]]\nkind = \"emissive\"\n[surface]\niso = 132\n"),
    ]);
}

/// The volume is met at once in parallel projection, and planes lie on both sides of the eye.
#[test]
fn cameras() {
    for (name, camera) in
        [("orthographic", "projection = \"orthographic\"\nheight = 40\n"), ("inside", "eye = [16, 10, 15]\n")]
    {
        for kind in ["emissive", "occlusive"] {
            let scene = scene("", &format!("[[halo]]\nkind = \"{kind}\"\nevery = 2\n"));
            let scene = scene.replace("[camera]\n", &format!("[camera]\n{camera}"));
            let Some(found) = differences(&scene) else { return };
            println!("{name}, {kind}: f64 {:.1e}, f32 {:.1e}", found[0], found[1]);
            assert!(found[0] < 1e-9, "{name}: {found:?}");
        }
    }
}
