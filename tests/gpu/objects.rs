//! Objects on the card: selections, ghosts, intersections and cutaways (Bruckner and Gröller 2005), as the reference draws
//! them.

use crate::double::{difference_with, differences};
use std::path::{Path, PathBuf};

/// A scene of shells under Blinn–Phong.
const SHELLS: &str = r##"
drypoint = 1
[volume]
phantom = { name = "shells", size = 24 }
[picture]
size = [40, 32]
samples = 1
background = "#203040"
LAYERS
[transfer]
kind = "regular"
nodes = [{ at = 20, color = "#c08040", opacity = 0 }, { at = 255, color = "#4080c0", opacity = 0.4 }]
[shading]
"##;

/// A selection volume with soft memberships, and a volume of its own beside it, each on another grid than the picture's volume.
pub(crate) struct Files {
    folder: tempfile::TempDir,
}

impl Files {
    pub(crate) fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let files = Self { folder };
        // A ball whose membership falls from 1 to 0, on 12³ voxels over the middle of the shells.
        let ball = |[x, y, z]: [f64; 3]| {
            let r = [x - 5.0, y - 6.0, z - 5.5].map(|d| d * d).iter().sum::<f64>().sqrt();
            (1.6 - r / 3.5).clamp(0.0, 1.0)
        };
        files.write("soft.nrrd", ball, 1.5, [4.0, 3.0, 3.5]);
        files.write("own.nrrd", |at| 40.0 + 200.0 * ball(at), 0.8, [10.0, 5.0, 9.0]);
        files
    }

    /// Writes a volume of 12³ voxels of f32.
    fn write(&self, name: &str, value: impl Fn([f64; 3]) -> f64, spacing: f64, [x, y, z]: [f64; 3]) {
        let mut bytes = format!(
            "NRRD0005\ntype: float\ndimension: 3\nspace dimension: 3\nsizes: 12 12 12\nencoding: raw\nendian: little\n\
             space directions: ({spacing},0,0) (0,{spacing},0) (0,0,{spacing})\nspace origin: ({x},{y},{z})\n\n"
        )
        .into_bytes();
        for i in 0..12 * 12 * 12 {
            let at = [i % 12, i / 12 % 12, i / 144].map(f64::from);
            bytes.extend_from_slice(&(value(at) as f32).to_le_bytes());
        }
        std::fs::write(self.path(name), bytes).unwrap();
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// A table of an object that selects with the soft volume.
    pub(crate) fn soft(&self, more: &str) -> String {
        object("a", &format!("selection = {}\n{more}", quoted(&self.path("soft.nrrd"))))
    }

    /// A table of an object with data of its own.
    pub(crate) fn own(&self, more: &str) -> String {
        object("b", &format!("volume = {}\n{more}", quoted(&self.path("own.nrrd"))))
    }
}

fn quoted(path: &Path) -> String {
    format!("{:?}", path.display().to_string())
}

fn object(name: &str, rest: &str) -> String {
    format!("[[object]]\nname = \"{name}\"\n{rest}\n")
}

pub(crate) fn shells(more: &str) -> String {
    SHELLS.replace("LAYERS\n", "") + more
}

/// A motion that turns, shrinks and shifts.
pub(crate) const MOVED: &str = "move = [9, -4, 3]\nrotate = { axis = [1, 2, 0.5], angle = 40 }\nscale = [0.9, 1.2, 0.8]";

/// Compares scenes: shaders in f64 with the reference.
fn compare(variants: Vec<(&str, String)>) {
    for (name, scene) in variants {
        let Some([double, single]) = differences(&scene) else { return };
        println!("{name}: f64 {double:.1e}, f32 {single:.1e}");
        assert!(double < 1e-9, "{name}: {double:e}");
    }
}

#[test]
fn selections_and_ghosts() {
    let files = Files::new();
    let by_value = object("a", "value = [[90, 0], [130, 1], [200, 0.3]]");
    let by_value_moved = object("a", &format!("value = [[90, 0], [130, 1], [200, 0.3]]\n{MOVED}"));
    let product = "[combine]\nfuzzy = \"product\"\n";
    compare(vec![
        ("not moved", shells(&files.soft(""))),
        ("moved", shells(&files.soft(MOVED))),
        ("mirrored", shells(&files.soft("scale = [-1, 1, 1]\nmove = [0, 8, 0]"))),
        ("product", shells(&(product.to_owned() + &files.soft(MOVED)))),
        ("by value", shells(&by_value)),
        ("by value, moved", shells(&by_value_moved)),
        ("everything", shells(&object("a", "move = [14, 0, 0]"))),
        ("own volume", shells(&files.own(""))),
        ("own volume, moved", shells(&files.own(MOVED))),
        ("two selections", shells(&(files.soft(MOVED) + &object("c", "value = [[90, 0], [130, 0.7]]\nmove = [0, 0, 6]")))),
        ("two by products", shells(&(product.to_owned() + &files.soft(MOVED) + &files.own("")))),
        ("perspective off", shells(&(files.soft(MOVED) + "[camera]\nprojection = \"orthographic\"\n"))),
        ("along rays", shells(&(files.soft(MOVED) + "[sampling]\nstep_along = \"ray\"\n"))),
        ("four rays", shells(&files.soft(MOVED)).replace("samples = 1", "samples = 2")),
        ("rays at edges", shells(&files.soft(MOVED)).replace("samples = 1\n", "")),
        ("out of sight", shells(&files.soft("move = [900, 0, 0]"))),
    ]);
}
