//! Scenes with halos as texts.

// Each binary uses its own part.
#![allow(dead_code)]

/// A torus seen from the side, so that it lies before itself.
pub(crate) const TORUS: &str = r##"
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
pub(crate) fn scene(picture: &str, tables: &str) -> String {
    let samples = if picture.contains("samples") { "" } else { "samples = 1\n" };
    let background = if picture.contains("background") { "" } else { "background = \"#d0c8b0\"\n" };
    // As few planes as tell them apart: images of all of them are spread.
    let sampling = if tables.contains("[sampling]") { "" } else { "[sampling]\nstep = \"1 voxel\"\n" };
    let start = TORUS.replace("PICTURE\n", &format!("{samples}{background}{picture}\n"));
    [&start, tables, sampling].concat()
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
