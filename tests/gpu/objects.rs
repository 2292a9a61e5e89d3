//! Objects on the card: selections, ghosts, intersections and cutaways (Bruckner and Gröller 2005), as the reference draws
//! them.

use crate::double::differences;
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
pub(crate) const MOVED: &str =
    "move = [9, -4, 3]\nrotate = { axis = [1, 2, 0.5], angle = 40 }\nscale = [0.9, 1.2, 0.8]";

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
        (
            "two selections",
            shells(&(files.soft(MOVED) + &object("c", "value = [[90, 0], [130, 0.7]]\nmove = [0, 0, 6]"))),
        ),
        ("two by products", shells(&(product.to_owned() + &files.soft(MOVED) + &files.own("")))),
        ("perspective off", shells(&(files.soft(MOVED) + "[camera]\nprojection = \"orthographic\"\n"))),
        ("along rays", shells(&(files.soft(MOVED) + "[sampling]\nstep_along = \"ray\"\n"))),
        ("four rays", shells(&files.soft(MOVED)).replace("samples = 1", "samples = 2")),
        ("rays at edges", shells(&files.soft(MOVED)).replace("samples = 1\n", "")),
        ("out of sight", shells(&files.soft("move = [900, 0, 0]"))),
    ]);
}

#[test]
fn intersections() {
    let files = Files::new();
    let meet = |with: &str, more: &str| format!("[[intersection]]\nobject = \"a\"\nwith = \"{with}\"\n{more}\n");
    let both = meet("ghost", "color = \"#ff4010c0\"\nopacity = \"over\"")
        + &meet("background", "opacity = \"plus\"\nswap = true");
    let near = "move = [2, -1, 1]\nrotate = { axis = [1, 2, 0.5], angle = 30 }";
    compare(vec![
        ("colour and mean", shells(&(files.soft(near) + &both))),
        ("by products", shells(&("[combine]\nfuzzy = \"product\"\n".to_owned() + &files.soft(near) + &both))),
        ("styles", styled(&(files.soft(near) + &both))),
    ]);
}

#[test]
fn cutaways() {
    let files = Files::new();
    let behind = "move = [2, 3, 1]\nghosting = 0.8\nghosting_of_ghost = 0.3";
    compare(vec![
        ("by boxes", shells(&files.soft(behind))),
        ("by objects", shells(&files.soft(&format!("{behind}\ncut = \"object\"")))),
        ("of styles", styled(&files.soft(behind))),
        ("smooth", shells(&files.soft(&format!("{behind}\nfunnel = \"3.2 px\"")))),
        (
            "smooth along rays, two",
            shells(
                &(files.soft(&format!("{behind}\nfunnel = \"2 px\""))
                    + &files.own("move = [3, 0, 0]\nghosting = 0.5\nfunnel = \"1.3 px\"\ncut = \"object\"")
                    + "[sampling]\nstep_along = \"ray\"\n"),
            ),
        ),
        ("gone", shells(&files.soft("move = [2, 3, 1]\nghosting = 1"))),
        (
            "of a lighting function",
            shells(&files.soft(behind))
                .replace("[shading]", "[shading]\nmodel = \"lighting-function\"\npreset = \"metal-contours\""),
        ),
    ]);
}

#[test]
fn looks_of_parts() {
    let files = Files::new();
    let own_look = "[object.transfer]\nkind = \"regular\"\nnodes = [{ at = 30, color = \"#30ff60\", opacity = 0.2 }, { at = 240, color = \"#ffffff\", opacity = 0.9 }]\n\
                    [object.shading]\nmodel = \"toon\"\n[object.ghost.shading]\nmodel = \"lighting-function\"\npreset = \"tone\"\n";
    let clip = "[[clip]]\npoint = [12, 12, 12]\nnormal = [0, -1, 0]\nspace = \"index\"\ncap = \"#ff3010c0\"\napplies = [\"background\", \"a\"]\n";
    let layers = "layers = [\"beauty\", \"normal\", \"depth\", \"gradient\", \"first\", \"first.normal\", \"curvature\", \"counts\"]";
    compare(vec![
        ("of their own", shells(&(files.soft(&format!("{MOVED}\n{own_look}")) + &files.own("")))),
        ("cut", shells(&(files.soft(MOVED) + clip))),
        ("layers", SHELLS.replace("LAYERS", layers) + &files.soft(MOVED) + &files.own("move = [3, 0, 0]")),
        ("an iso-surface", shells(&(files.soft(MOVED) + "[surface]\niso = 110\ncolor = \"#c0c0c0\"\n"))),
        ("mipmaps and Hessians", styled(&files.soft(MOVED)).replace("kappa = \"ray\"", "kappa = \"exact\"")),
        ("gradient magnitudes", two_quantities(&files.soft(MOVED))),
    ]);
}

/// The shells in illustrative styles with contours by κ along the ray.
fn styled(more: &str) -> String {
    let nodes = "[transfer]\nnodes = [{ at = 20, style = \"wax\", opacity = 0 }, { at = 255, style = \"skin\", opacity = 0.5 }]\n\
                 [contours]\nkappa = \"ray\"\n";
    let scene = shells("");
    let (before, _) = scene.split_once("[transfer]").unwrap();
    format!("{before}{nodes}{more}")
}

/// The shells by their value and their gradient magnitude.
fn two_quantities(more: &str) -> String {
    let scene = shells("");
    let (before, _) = scene.split_once("[transfer]").unwrap();
    format!(
        "{before}[transfer]\nkind = \"regular\"\nover = [\"value\", \"gradient-magnitude\"]\n\
         rows = [{{ at = 0, nodes = [{{ at = 20, color = \"#c08040\", opacity = 0 }}, {{ at = 255, color = \"#4080c0\", opacity = 0.2 }}] }}, \
         {{ at = 20, nodes = [{{ at = 20, color = \"#80ff40\", opacity = 0 }}, {{ at = 255, color = \"#ff80c0\", opacity = 0.6 }}] }}]\n[shading]\n{more}"
    )
}
