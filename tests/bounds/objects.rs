//! Pictures of objects in f32 within their bounds: selections, ghosts, intersections and cutaways.

use crate::object_scenes::{Files, MOVED, PRODUCT, object, quoted, shells, styled, two_quantities};
use crate::texts::{Measured, Text};

/// The largest share of pixels at a decision.
const MOST_UNDECIDED: f64 = 0.03;

/// Compares scenes with the reference in f32, and prints their figures.
fn compare(scenes: Vec<(&str, String)>) {
    for (name, text) in scenes {
        let Measured { median, measured, undecided, .. } = Text(&text).compared(name);
        assert!(measured > 0.0 && median < 1e-3 && undecided < MOST_UNDECIDED, "{name}");
    }
}

#[test]
fn selections_and_ghosts() {
    let files = Files::new();
    let by_value = |more: &str| object("c", &format!("value = [[90, 0], [130, 0.8], [200, 0.3]]\n{more}"));
    compare(vec![
        ("not moved", shells(&files.soft(""))),
        (
            "moved, by products, orthographic",
            shells(&(PRODUCT.to_owned() + &files.soft(MOVED) + "[camera]\nprojection = \"orthographic\"\n")),
        ),
        (
            "mirrored, along rays",
            shells(&(object("a", "scale = [-1, 1, 1]\nmove = [14, 2, 0]") + "[sampling]\nstep_along = \"ray\"\n")),
        ),
        ("by value, and of its own", shells(&(by_value(MOVED) + &files.own("move = [3, 0, 0]")))),
        ("three by products", shells(&(PRODUCT.to_owned() + &files.soft("") + &by_value("") + &files.own("")))),
        ("of styles", styled(&files.soft(MOVED))),
        ("by gradient magnitudes", two_quantities(&files.soft(MOVED))),
    ]);
}

#[test]
fn intersections() {
    let files = Files::new();
    let picture = files.picture();
    let meet = |with: &str, more: &str| format!("[[intersection]]\nobject = \"a\"\nwith = \"{with}\"\n{more}\n");
    let near = files.soft("move = [2, -1, 1]\nrotate = { axis = [1, 2, 0.5], angle = 30 }");
    let mean = meet("background", "opacity = \"plus\"\nswap = true");
    let color = meet("ghost", "color = \"#ff4010c0\"\nopacity = \"over\"");
    let from_picture = meet("ghost", &format!("color = {}", quoted(&picture)));
    let dabs = "dabs = [{ at = [110, 90], width = [30, 50], color = \"#20ff40c0\" }, \
                { at = [140, 150], width = 40, color = \"#4020ff\" }]";
    compare(vec![
        ("the mean", shells(&(near.clone() + &mean))),
        ("a colour with dabs", shells(&(near.clone() + &color + dabs + "\n"))),
        ("a picture, by products", shells(&(PRODUCT.to_owned() + &near + &from_picture))),
    ]);
}

#[test]
fn cutaways_and_cuts() {
    let files = Files::new();
    let behind = "move = [2, 3, 1]\nghosting = 0.8\nghosting_of_ghost = 0.3";
    let clip = "[[clip]]\npoint = [12.3, 12.2, 12.1]\nnormal = [0.1, -1, 0.2]\nspace = \"index\"\n\
                applies = [\"background\", \"a\"]\n";
    compare(vec![
        ("by boxes", shells(&files.soft(behind))),
        ("by objects", shells(&files.soft(&format!("{behind}\ncut = \"object\"")))),
        ("a clip plane", shells(&(files.soft(MOVED) + clip))),
        ("before an iso-surface", shells(&(files.soft(MOVED) + "[surface]\niso = 110\ncolor = \"#c0c0c0\"\n"))),
    ]);
}

/// Smooth cutaways have no bound, and say so.
#[test]
fn smooth_cutaways_are_unknown() {
    let files = Files::new();
    let text = shells(&files.soft("ghosting = 0.8\nfunnel = \"2 px\""));
    assert_eq!(Text(&text).unknown(), Some("a smooth cutaway"));
}
