//! Pictures with halos in f32 within their bounds.

use crate::halo_scenes::{FIVE, scene};
use crate::mesh_scenes::Meshes;
use crate::object_scenes::{Files, shells};
use crate::texts::{Measured, Text};

/// The largest share of pixels at a decision.
const MOST_UNDECIDED: f64 = 0.02;

/// Compares scenes: a name, keys of the picture, further tables.
fn compare(scenes: &[(&str, &str, &str)]) {
    for (name, picture, tables) in scenes {
        let Measured { median, measured, undecided } = Text(&scene(picture, tables)).compared(name);
        assert!(measured > 0.0 && median < 1e-3 && undecided < MOST_UNDECIDED, "{name}");
    }
}

#[test]
fn occlusive_and_emissive_halos() {
    compare(&[
        ("occlusive", "", "[[halo]]\n"),
        ("emissive", "", "[[halo]]\nkind = \"emissive\"\n"),
        ("by curvature, encoded", "blend_space = \"srgb\"", "[[halo]]\nseed.by = \"curvature\"\n"),
        ("five", "", FIVE),
    ]);
}

#[test]
fn groups_of_planes_and_spreading() {
    compare(&[
        ("M = 4, mean", "", "[[halo]]\nevery = 4\naccumulate = \"mean\"\n"),
        ("M = 7, maximum", "", "[[halo]]\nkind = \"emissive\"\nevery = 7\naccumulate = \"max\"\n"),
        (
            "groups that end apart",
            "",
            "[[halo]]\nevery = 3\n[[halo]]\nkind = \"emissive\"\nevery = 4\n[[halo]]\nkind = \"emissive\"\n",
        ),
        ("a median", "", "[[halo]]\nevery = 2\nspread = { passes = 3, median = true }\n"),
        ("two rays across", "samples = 4", "[[halo]]\nevery = 4\n"),
    ]);
}

#[test]
fn seeds() {
    compare(&[
        (
            "by value and focus",
            "",
            "[[halo]]\nevery = 2\nseed = { value = [[90, 0], [128, 1], [150, 0.5]], focus = { at = [[8, 10, 15]], inner = 4, \
             falloff = 9 } }\n",
        ),
        ("by direction", "", "[[halo]]\nevery = 2\nseed.direction = { toward = 30, width = 120, softness = 40 }\n"),
        (
            "on a cut",
            "",
            "[[halo]]\nevery = 2\n[[clip]]\npoint = [15.3, 15.2, 15.1]\nnormal = [0.1, -1, 0.2]\nspace = \"index\"\n",
        ),
        ("before an iso-surface", "", "[[halo]]\nevery = 2\n[surface]\niso = 145\n"),
    ]);
    let meshes = Meshes::new();
    let text = scene("", &(meshes.both() + "[[halo]]\nevery = 4\nkind = \"emissive\"\n"));
    assert!(Text(&text).compared("before meshes").undecided < MOST_UNDECIDED);
}

/// Halos of objects have no bound, and say so.
#[test]
fn halos_of_objects_are_unknown() {
    let files = Files::new();
    assert_eq!(Text(&shells(&(files.soft("") + "[[halo]]\n"))).unknown(), Some("halos of objects"));
}
