//! Pictures of meshes, and of a further volume on another grid, in f32 within their bounds.

use crate::mesh_scenes::{Meshes, scene};
use crate::object_scenes::Files;
use crate::texts::{Measured, Text};

/// The largest share of pixels at a decision.
const MOST_UNDECIDED: f64 = 0.03;

fn compare(scenes: Vec<(&str, String)>) {
    for (name, text) in scenes {
        let Measured { median, measured, undecided, .. } = Text(&text).compared(name);
        assert!(measured > 0.0 && median < 1e-3 && undecided < MOST_UNDECIDED, "{name}");
    }
}

#[test]
fn meshes() {
    let meshes = Meshes::new();
    let flat = meshes.mesh("flat.ply", "color = \"#d04030\"\nscale = 5\nmove = [11.2, 5.3, 9.7]");
    let surface = "[surface]\niso = 150\ncolor = \"#c0c0c0\"\n";
    let part = "[[object]]\nname = \"a\"\nvalue = [[90, 0], [130, 1]]\nmove = [0, -4, 2]\n";
    compare(vec![
        ("smooth, and a cube", scene("", &meshes.both())),
        ("flat, orthographic", scene("", &flat).replace("[camera]\n", "[camera]\nprojection = \"orthographic\"\n")),
        ("along rays", scene("", &(flat.clone() + "[sampling]\nstep_along = \"ray\"\n"))),
        ("beside an iso-surface", scene("", &(meshes.both() + surface))),
        ("among objects", scene("", &(meshes.both() + part))),
    ]);
}

/// A function over the value and that of a volume of 12³ coarser voxels.
#[test]
fn a_further_volume_on_another_grid() {
    let files = Files::new();
    let path = files.path("own.nrrd").display().to_string();
    let row = |at: f64, opacity: f64| {
        format!(
            "{{ at = {at}, nodes = [{{ at = 90, color = \"#804020\", opacity = 0 }}, {{ at = 140, color = \"#88ccff\", \
             opacity = {opacity} }}] }}"
        )
    };
    let text = format!(
        "drypoint = 1\n[volume]\nphantom = {{ name = \"torus\", size = 24 }}\n[picture]\nsize = [40, 32]\nsamples = 1\n\
         [camera]\ndirection = [0.4, 1, -0.3]\n[transfer]\nkind = \"regular\"\nover = [\"value\", {{ volume = {path:?} }}]\n\
         rows = [{}, {}]\n[shading]\n",
        row(40.0, 0.1),
        row(200.0, 0.7)
    );
    compare(vec![("a further volume", text)]);
}
