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
samples = 1
background = "#d0c8b0"
[transfer]
kind = "regular"
nodes = [{ at = 100, color = "#804020", opacity = 0 }, { at = 128, color = "#ffcc88", opacity = 0.3 },
         { at = 140, color = "#88ccff", opacity = 0.9 }]
[shading]
"##;

/// Scenes of a torus with further tables, and keys in the place of `samples`.
fn scene(picture: &str, tables: &str) -> String {
    let picture = if picture.contains("samples") { picture.to_owned() } else { format!("samples = 1\n{picture}") };
    format!("{}{tables}", TORUS.replace("samples = 1\n", &format!("{picture}\n")))
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
